use super::super::scenes::{bridge, per_area, seismic, wall};
use super::super::static_theorem::tests::{arch, ferris_tin_loi, loads};
use super::*;
use crate::budget::Budget;
use crate::limit::Release;
use crate::structure::{ActsOn, Face, JointLaw, PointForce, Structure};

const DRY: JointLaw = JointLaw::Dry { friction: 0.6, cohesion: 0.0 };

fn value(outcome: &ProgrammeOutcome) -> f64 {
    match outcome {
        ProgrammeOutcome::At(equilibrium, _) => equilibrium.load_factor,
        ProgrammeOutcome::Unbounded(_) => f64::INFINITY,
        ProgrammeOutcome::Infeasible(_) => f64::NEG_INFINITY,
        ProgrammeOutcome::Lost => f64::NAN,
    }
}

/// Both ends of the window by both solvers.
fn both(structure: &Structure, [fixed, scaled]: &[Vec<PointForce>; 2]) -> [[f64; 2]; 2] {
    let theorem = StaticTheorem::new(structure, fixed, scaled).unwrap();
    let programme = Programme::new(&theorem);
    [-1.0, 1.0].map(|sign| {
        let objective = Objective::load_factor(sign);
        let dense = value(&programme.maximise_densely(&objective, &Budget::unlimited()));
        let sparse = value(&programme.maximise_sparsely(&objective, &Budget::unlimited()));
        [dense, sparse]
    })
}

fn agree(structure: &Structure, loads: &[Vec<PointForce>; 2]) {
    for [dense, sparse] in both(structure, loads) {
        assert!(dense == sparse || (dense - sparse).abs() < 1e-9 * dense.abs().max(1e-3), "{dense} {sparse}");
    }
}

#[test]
fn both_solvers_agree() {
    agree(&arch(), &loads(&arch()));
    for (spans, stones) in [(1, 5), (1, 20), (2, 9), (3, 7), (4, 10), (5, 11), (7, 11), (10, 11), (14, 11)] {
        let bridge = bridge(spans, stones, 1.5, DRY);
        agree(&bridge, &seismic(&bridge));
        let [fixed, _] = seismic(&bridge);
        let point = PointForce {
            at: bridge.bodies[1].region.centroid,
            force: Vec2::new(0.0, -1.0),
            acts_on: ActsOn::Point,
            ..fixed[1]
        };
        agree(&bridge, &[fixed, vec![point]]);
    }
    for rows in [2, 3, 4, 5] {
        let whole = [1.0; 3];
        let halves = [0.5, 1.0, 1.0, 0.5];
        let rows: Vec<&[f64]> = (0..rows).map(|k| if k % 2 == 0 { &whole[..] } else { &halves[..] }).collect();
        for (friction, cohesion) in [(0.3, 0.0), (0.7, 0.0), (0.5, 0.2), (0.0, 0.1)] {
            let wall = wall(&rows, 0.5, JointLaw::Dry { friction, cohesion });
            agree(&wall, &seismic(&wall));
        }
    }
}

#[test]
fn walls_that_never_fall_or_never_stand_are_told() {
    let mut structure = ferris_tin_loi(3);
    let [down, up] = [-1.0, 1.0].map(|y| per_area(&structure, Vec2::new(0.0, y)));
    let window = |structure: &Structure, fixed: &[PointForce], scaled: &[PointForce]| {
        StaticTheorem::new(structure, fixed, scaled).unwrap().window(&Budget::unlimited()).unwrap().ends()
    };
    assert_eq!(window(&structure, &up, &[]), None);
    let [low, high] = window(&structure, &down, &down).unwrap();
    assert!((low + 1.0).abs() < 1e-9 && high == f64::INFINITY, "{low} {high}");
    let sideways = per_area(&structure, Vec2::new(1.0, 0.0));
    structure.joints.iter_mut().for_each(|joint| joint.law = JointLaw::Bonded);
    assert_eq!(window(&structure, &down, &sideways), Some([f64::NEG_INFINITY, f64::INFINITY]));
}

#[test]
fn an_optimum_is_an_admissible_equilibrium() {
    let structure = ferris_tin_loi(2);
    let [fixed, scaled] = seismic(&structure);
    let theorem = StaticTheorem::new(&structure, &fixed, &scaled).unwrap();
    let outcome = Programme::new(&theorem).maximise_sparsely(&Objective::load_factor(1.0), &Budget::unlimited());
    let ProgrammeOutcome::At(found, _) = outcome else { panic!() };
    assert!(theorem.slack(&found) > -1e-10, "{}", theorem.slack(&found));
    let mut sums = vec![[0.0; 3]; structure.bodies.len()];
    let mut add = |body: usize, at: Vec2, force: Vec2| {
        let arm = at - structure.bodies[body].region.centroid;
        let part = [force.x, force.y, cross(arm, force)];
        sums[body] = std::array::from_fn(|i| sums[body][i] + part[i]);
    };
    fixed.iter().for_each(|load| add(load.body, load.at, load.force));
    scaled.iter().for_each(|load| add(load.body, load.at, load.force * found.load_factor));
    for (joint, forces) in structure.joints.iter().zip(theorem.resultants(&found)) {
        for (side, sign) in joint.between.iter().zip([-1.0, 1.0]) {
            let Some(body) = side.body() else { continue };
            add(body, joint.intrados, sign * (joint.normal() * forces.intrados + joint.tangent() * forces.shear));
            add(body, joint.extrados, sign * joint.normal() * forces.extrados);
        }
    }
    let total: f64 = fixed.iter().map(|load| load.force.norm()).sum();
    assert!(sums.iter().flatten().all(|sum| sum.abs() < 1e-10 * total), "{sums:?}");
}

#[test]
fn both_solvers_find_the_same_cheapest_motion() {
    let bridge = bridge(2, 7, 1.5, DRY);
    let [fixed, scaled] = seismic(&bridge);
    let theorem = StaticTheorem::new(&bridge, &fixed, &scaled).unwrap();
    let faces = [Face::Intrados, Face::Extrados];
    let turns = (0..bridge.joints.len()).flat_map(|k| faces.map(|face| (k, Release::Rotation(face))));
    let slides = (0..bridge.joints.len()).flat_map(|k| [1.0, -1.0].map(|sign| (k, Release::Sliding(sign))));
    let releases: Vec<_> = turns.chain(slides).collect();
    let costs: Vec<f64> = (0..releases.len()).map(|i| 1.0 + 0.9 * (1.7 * i as f64).sin()).collect();
    let programme = Programme { errors: [1e-10, 1e-8], ..theorem.motion_programme(&releases, &costs) };
    let [dense, sparse] = [Programme::maximise_densely, Programme::maximise_sparsely].map(|maximise| {
        let ProgrammeOutcome::At(_, Dual { multipliers: rates, .. }) =
            maximise(&programme, &Objective::load_factor(1.0), &Budget::unlimited())
        else {
            panic!()
        };
        let cost: f64 = rates.iter().zip(&costs).map(|(rate, cost)| rate * cost).sum();
        rates.into_iter().map(|rate| rate / cost).collect::<Vec<_>>()
    });
    assert!(dense.iter().zip(&sparse).all(|(a, b)| (a - b).abs() < 1e-8), "{dense:?} {sparse:?}");
}

/// A larger one, where code is optimised: tests/it/structures.rs.
#[test]
fn a_large_wall_is_solved() {
    let (columns, count) = (20, 10);
    let whole = vec![1.0; columns];
    let halves = [&[0.5][..], &vec![1.0; columns - 1], &[0.5]].concat();
    let rows: Vec<&[f64]> = (0..count).map(|k| if k % 2 == 0 { &whole[..] } else { &halves[..] }).collect();
    let wall = wall(&rows, 0.5, DRY);
    let [fixed, scaled] = seismic(&wall);
    let theorem = StaticTheorem::new(&wall, &fixed, &scaled).unwrap();
    let window = theorem.window(&Budget::unlimited()).unwrap().ends().unwrap();
    assert!((window[0] + window[1]).abs() < 1e-8);
}
