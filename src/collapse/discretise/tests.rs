use super::*;
use crate::arch::profile::Profile;
use crate::arch::ring::{JointLines, Line, Ring, Thickness, stations};
use crate::arch::{assemble, straight_voussoirs};
use crate::collapse::{CurvePoint, Mesh, Path, SafetyTask, Task, safety};
use crate::geometry::{Region, perpendicular};
use crate::largest::largest;
use crate::structure::JointLaw;

/// A semicircle of `n` equal stones, cut into `subblocks` each, without loads.
fn semicircle(n: usize, subblocks: [usize; 2], curved: bool) -> Analysis {
    let profile = Profile::circular(10.0, std::f64::consts::PI);
    let ring = Ring {
        stations: stations(profile.length(), &vec![1.0; n]),
        profile,
        line: Line::Axis,
        thickness: Thickness::Linear { crown: 1.5, springing: 1.5 },
        joints: JointLines::Normal,
    };
    let ends = ring.set_out().unwrap();
    let stones = if curved { ring.curved_voussoirs(&ends).unwrap() } else { straight_voussoirs(&ends).unwrap() };
    let law = JointLaw::Dry { friction: 0.6, cohesion: 0.0 };
    let structure = assemble(&ends, stones, Stone::default(), law);
    let mesh = Mesh::of(vec![subblocks; n]);
    Analysis { mesh, ..Analysis::new(structure, Vec::new(), Vec::new()) }
}

fn model<'p>(analysis: &Analysis, budget: &'p Budget<'p>) -> Model<'p> {
    let mut model = discretise(analysis, &Strips::default(), budget).unwrap();
    model.scatter(Attempt::number(0));
    model
}

/// Of so many kinds are its stones.
fn kinds(analysis: &Analysis) -> usize {
    model(analysis, &Budget::unlimited()).assembly.kinds()
}

#[test]
fn stones_of_one_shape_are_condensed_once() {
    for (subblocks, curved) in [([1, 1], false), ([3, 2], false), ([3, 2], true)] {
        let mut analysis = semicircle(61, subblocks, curved);
        assert_eq!(kinds(&analysis), 1);
        // A stone with another mesh is of another kind, and so are its neighbours, whose joints have its points.
        analysis.mesh.subblocks[30] = [5, 2];
        assert_eq!(kinds(&analysis), 4);
    }
}

#[test]
fn another_attempt_other_loads_and_another_abscissa_condense_no_stone_again() {
    let weighed = |push: f64| {
        let stones = semicircle(9, [1, 1], false);
        let on = |force: Vec2| move |body: usize| (body, force);
        let at = |(body, force)| PointForce {
            body,
            at: stones.structure.bodies[body].region.centroid,
            force,
            acts_on: ActsOn::Body,
        };
        let fixed = (0..9).map(on(Vec2::new(0.0, -1e4))).map(at).collect();
        let scaled = [on(Vec2::new(push, -1e3))(3)].map(at).to_vec();
        Analysis { task: Task::Safety(SafetyTask::default()), fixed, scaled, ..stones }
    };
    let updated = |push: f64| Analysis {
        task: Task::Safety(SafetyTask { path: Path::Updated, ..SafetyTask::default() }),
        ..weighed(push)
    };
    let (analyses, budget) = ([weighed(0.0), updated(0.0), updated(100.0)], Budget::unlimited());
    let points = analyses.map(|analysis| CurvePoint { abscissa: 0.0, analysis });
    let mut built = Discretisation::new(&budget);
    assert_eq!(safety::curve(&points, &mut built).unwrap().len(), 3);
    assert_eq!(built.condensed, 1, "all stones are of one shape");
    for (point, i) in points.iter().zip(0..) {
        let (attempt, mut fresh) =
            (Attempt::number(i), discretise(&point.analysis, &Strips::default(), &budget).unwrap());
        fresh.scatter(attempt);
        let model = built.model(&point.analysis, attempt).unwrap();
        assert_eq!(model.assembly.contacts(), fresh.assembly.contacts());
        assert_eq!((&model.fixed, &model.scaled, &model.turned), (&fresh.fixed, &fresh.scaled, &fresh.turned));
        assert_eq!(model.softest, fresh.softest);
    }
    assert_eq!(built.condensed, 1);
    let finer = semicircle(9, [2, 2], false);
    built.model(&finer, Attempt::number(0)).unwrap();
    assert_eq!(built.condensed, 2, "another mesh is another macroblock");
}

#[test]
fn the_subblocks_of_a_stone_tile_it() {
    for curved in [false, true] {
        let analysis = semicircle(7, [5, 4], curved);
        let grids = model(&analysis, &Budget::unlimited()).grids;
        for (grid, stone) in grids.iter().zip(analysis.structure.voussoirs()) {
            let all = grid.cells().map(|(i, j)| grid.region(i, j)).reduce(Region::join).unwrap();
            assert!((all.area / stone.region.area - 1.0).abs() < 1e-12);
            assert!((all.centroid - stone.region.centroid).norm() < 1e-12 * 10.0);
        }
    }
}

/// Displacements of the nodes of an assembly that moves as `field` says.
fn moved(assembly: &Assembly, field: impl Fn(Vec2) -> Vec2) -> Vec<f64> {
    let mut d = vec![0.0; assembly.node_unknowns()];
    for k in 0..assembly.interfaces() {
        for face in assembly.faces(k).into_iter().flatten() {
            for (p, i) in assembly.at_interface(k).zip(face.step_by(2)) {
                let (u, normal) = (field(assembly.place(p)), assembly.normal(p));
                (d[i], d[i + 1]) = (u.dot(&normal), u.dot(&perpendicular(normal)));
            }
        }
    }
    d
}

#[test]
fn the_mirror_image_of_a_motion_is_that_of_an_assembly_and_its_nodes() {
    let budget = Budget::unlimited();
    let model = model(&semicircle(7, [2, 2], false), &budget);
    let assembly = &model.assembly;
    assert!(model.symmetric);
    let turns = |at: Vec2| Vec2::new(2.0 - at.y, at.x);
    let bends = |at: Vec2| Vec2::new(0.1 * at.x * at.y, 0.3 * at.y * at.y - at.x * at.x);
    let right = |_: Vec2| Vec2::x();
    let up = |_: Vec2| Vec2::y();
    let motions: [(&dyn Fn(Vec2) -> Vec2, f64); 4] = [(&right, -1.0), (&up, 1.0), (&turns, -1.0), (&bends, 1.0)];
    for (field, sign) in motions {
        let d = moved(assembly, field);
        let image = assembly.mirrored(&d);
        let apart = largest(image.iter().zip(&d).map(|(there, here)| (there - sign * here).abs()));
        assert!(apart < 1e-11, "{apart:e}");
    }
}

#[test]
fn an_arch_is_its_own_mirror_image_where_nothing_tells_the_sides_apart() {
    let budget = Budget::unlimited();
    let symmetric = |analysis: &Analysis| model(analysis, &budget).symmetric;
    for (n, mesh) in [(7, [1, 1]), (8, [1, 1]), (7, [3, 2]), (8, [2, 3])] {
        assert!(symmetric(&semicircle(n, mesh, false)) && symmetric(&semicircle(n, mesh, true)));
    }
    let [mut rough, mut fine, mut flat] = [(); 3].map(|()| semicircle(7, [1, 1], false));
    rough.structure.joints[2].law = JointLaw::Dry { friction: 0.61, cohesion: 0.0 };
    fine.mesh.subblocks[5] = [1, 2];
    flat.structure.joints[3].extrados.y += 1e-3;
    for analysis in [&rough, &fine, &flat] {
        assert!(!symmetric(analysis));
    }
}

#[test]
fn a_joint_between_two_stones_is_as_soft_as_the_softer() {
    let mut analysis = semicircle(6, [1, 1], false);
    let soft = Stone { youngs_modulus: 2e8, ..Stone::default() };
    analysis.structure.stones.push(soft);
    analysis.structure.bodies[3].stone = 1;
    let normal = |k: usize| penalties(&analysis, &analysis.structure.joints[k])[0];
    let hard = 10.0 * Stone::default().youngs_modulus;
    assert_eq!([2, 3, 4, 5].map(normal), [hard, 2e9, 2e9, hard]);
    // The soft stone is of another kind, and so are its neighbours, which have a soft joint each.
    assert_eq!(kinds(&analysis), 4);
}
