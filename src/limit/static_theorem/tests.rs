use super::super::scenes::{self, bridge, mirrored, per_area, ring, seismic, wall};
use super::*;
use crate::budget::Budget;
use crate::geometry::cross;
use crate::structure::{ActsOn, Side};

const DRY: JointLaw = JointLaw::Dry { friction: 0.7, cohesion: 0.0 };

/// A skewed arch of four quadrilaterals, so that nothing is symmetric by accident.
pub(in crate::limit) fn arch() -> Structure {
    let ends = [
        (-2.0, 0.0, -2.6, 0.1),
        (-1.5, 1.2, -1.9, 1.7),
        (-0.2, 1.9, -0.1, 2.6),
        (1.2, 1.4, 1.6, 1.9),
        (1.9, 0.2, 2.5, 0.3),
    ];
    ring(&ends.map(|(xi, yi, xe, ye)| [Vec2::new(xi, yi), Vec2::new(xe, ye)]), DRY)
}

pub(in crate::limit) fn loads(arch: &Structure) -> [Vec<PointForce>; 2] {
    let force = |i: usize, x: f64, y: f64| PointForce {
        body: i,
        at: arch.bodies[i].region.centroid,
        force: Vec2::new(x, y),
        acts_on: ActsOn::Point,
    };
    [
        (0..4).map(|i| force(i, 0.1, -5.0)).collect(),
        vec![PointForce { at: Vec2::new(-0.9, 2.1), ..force(1, 0.0, -1.0) }],
    ]
}

fn theorem(structure: &Structure, fixed: &[PointForce], scaled: &[PointForce]) -> StaticTheorem {
    StaticTheorem::new(structure, fixed, scaled).unwrap()
}

/// Force and moment about the origin that joint `k` exerts on the stone after it, rebuilt from its two corner forces.
pub(in crate::limit) fn wrench(joint: &Joint, r: &Resultant) -> [f64; 3] {
    let (n, t) = (joint.normal(), joint.tangent());
    let corners = [(joint.intrados, n * r.intrados), (joint.extrados, n * r.extrados), (joint.intrados, t * r.shear)];
    corners.iter().fold([0.0; 3], |s, (at, f)| [s[0] + f.x, s[1] + f.y, s[2] + cross(*at, *f)])
}

#[test]
fn every_stone_is_in_equilibrium_whatever_the_unknowns() {
    let arch = arch();
    let [fixed, scaled] = loads(&arch);
    let theorem = theorem(&arch, &fixed, &scaled);
    let free = |joint: usize, face: usize| Condition {
        joint,
        weights: std::array::from_fn(|i| if i == face { 1.0 } else { 0.0 }),
        constant: 0.0,
    };
    let equilibrium = theorem.solve(&[free(0, 0), free(1, 1), free(3, 0), free(4, 1)], &[]).unwrap();
    let resultants = theorem.resultants(&equilibrium);
    assert!(resultants[0].intrados.abs() < 1e-12 && resultants[3].intrados.abs() < 1e-12);
    for i in 0..4 {
        let (left, right) = (wrench(&arch.joints[i], &resultants[i]), wrench(&arch.joints[i + 1], &resultants[i + 1]));
        let loads = fixed.iter().map(|f| (f, 1.0)).chain(scaled.iter().map(|f| (f, equilibrium.load_factor)));
        let mine = loads.filter(|(f, _)| f.body == i);
        let sum = mine
            .fold([0.0; 3], |s, (f, w)| [s[0] + w * f.force.x, s[1] + w * f.force.y, s[2] + w * cross(f.at, f.force)]);
        for c in 0..3 {
            assert!((left[c] + sum[c] - right[c]).abs() < 1e-11, "stone {i} component {c}");
        }
    }
}

#[test]
fn forces_out_of_balance_are_told_as_a_share_of_the_larger_loads() {
    let arch = arch();
    let [fixed, scaled] = loads(&arch);
    let theorem = theorem(&arch, &fixed, &scaled);
    let mut unknowns = vec![0.3, -0.2, 0.1, 2.0];
    for (load_factor, largest) in [(2.0, fixed.iter().map(|f| f.force.norm()).sum()), (500.0, 500.0)] {
        unknowns[3] = load_factor / theorem.load_factor_scale();
        let mut forces = theorem.resultants(&theorem.equilibrium(&unknowns, true));
        assert!(theorem.unbalanced(load_factor, &forces, &[]) < 1e-14);
        forces[4].shear += 1.0;
        let told = theorem.unbalanced(load_factor, &forces, &[]) * largest;
        assert!((0.5f64.sqrt()..=1.0).contains(&told), "{told} of 1 N/m");
        // The last stone lies beside a joint that is not told of.
        assert!(theorem.unbalanced(load_factor, &forces[..4], &[]) < 1e-14);
    }
}

#[test]
fn loads_that_cancel_leave_a_stone_without_any() {
    let arch = arch();
    let [fixed, _] = loads(&arch);
    let theorem = theorem(&arch, &fixed, &[PointForce { force: fixed[1].force * -0.5, ..fixed[1] }]);
    assert_eq!([1.9, 2.0, 2.1].map(|at| theorem.leaves_unloaded(at, 1e-9)), [false, true, false]);
    let bare = StaticTheorem::new(&arch, &fixed[1..], &[]).unwrap();
    assert!(bare.leaves_unloaded(1.0, 1e-9), "the first carries none");
}

#[test]
fn the_window_does_not_depend_on_units() {
    let arch = arch();
    let [fixed, scaled] = loads(&arch);
    let [low, high] = theorem(&arch, &fixed, &scaled).window(&Budget::unlimited()).unwrap().ends().unwrap();
    let larger = |loads: &[PointForce], by: f64| {
        loads.iter().map(|l| PointForce { force: l.force * by, ..*l }).collect::<Vec<_>>()
    };
    let again = theorem(&arch, &larger(&fixed, 1e7), &larger(&scaled, 1e3))
        .window(&Budget::unlimited())
        .unwrap()
        .ends()
        .unwrap();
    assert!((again[0] / (low * 1e4) - 1.0).abs() < 1e-10 && (again[1] / (high * 1e4) - 1.0).abs() < 1e-10);
    assert!(low < 0.0 && high > 0.0 && high.is_finite());
}

#[test]
fn a_bonded_arch_never_falls_and_a_tensile_one_never_stands() {
    let mut arch = arch();
    let [fixed, scaled] = loads(&arch);
    let upwards: Vec<_> = fixed.iter().map(|f| PointForce { force: -f.force * 10.0, ..*f }).collect();
    assert_eq!(theorem(&arch, &upwards, &[]).window(&Budget::unlimited()).unwrap().ends(), None);
    arch.joints.iter_mut().for_each(|j| j.law = JointLaw::Bonded);
    let window = theorem(&arch, &fixed, &scaled).window(&Budget::unlimited()).unwrap().ends().unwrap();
    assert_eq!(window, [f64::NEG_INFINITY, f64::INFINITY]);
}

/// The rows of the walls of Ferris and Tin-Loi (Int. J. Mech. Sci. 43 (2001) 209-224): stones 4 or 2 wide and 1.75 high,
/// friction 0.65; -n is an opening.
pub(in crate::limit) fn ferris_tin_loi(number: usize) -> Structure {
    const F: f64 = 4.0;
    let halves: &[f64] = &[2.0, F, F, F, F, 2.0];
    let wholes: &[f64] = &[F; 5];
    let alternating = |count: usize| (0..count).map(|k| if k % 2 == 0 { halves } else { wholes }).collect::<Vec<_>>();
    let (narrow, narrow_halves): (&[f64], &[f64]) = (&[F; 4], &[2.0, F, F, F, 2.0]);
    let (opened, opened_halves): (&[f64], &[f64]) = (&[F, 2.0, -F, 2.0, F], &[2.0, F, -F, F, 2.0]);
    let (wide, wide_halves): (&[f64], &[f64]) = (&[F; 7], &[2.0, F, F, F, F, F, F, 2.0]);
    let (two, two_halves): (&[f64], &[f64]) = (&[F, 2.0, -F, 2.0, F, 2.0, -F, 2.0, F], &[2.0, F, -F, F, F, -F, F, 2.0]);
    let rows = match number {
        1 => alternating(6),
        2 => alternating(10),
        3 => {
            let openings = [opened_halves, opened, opened_halves, opened, opened_halves];
            [&[narrow, narrow_halves, narrow][..], &openings, &[narrow, narrow_halves, narrow]].concat()
        }
        _ => {
            let openings = [two_halves, two, two_halves, two, two_halves];
            let storey = [&openings[..], &[wide]].concat();
            [
                &[wide_halves, wide, wide_halves, wide][..],
                &storey,
                &[wide_halves, wide],
                &storey,
                &[wide_halves, wide, wide_halves],
            ]
            .concat()
        }
    };
    wall(&rows, 1.75, JointLaw::Dry { friction: 0.65, cohesion: 0.0 })
}

/// The values of the literature with associated friction (0.643, 0.580, 0.404, 0.347), to more digits recomputed twice from the
/// geometry with a general solver.
#[test]
fn walls_stand_as_long_as_published() {
    for (number, bodies, joints, published) in
        [(1, 33, 83, 0.642859), (2, 55, 141, 0.579999), (3, 46, 102, 0.403694), (6, 146, 345, 0.347825)]
    {
        let wall = ferris_tin_loi(number);
        assert_eq!((wall.bodies.len(), wall.joints.len()), (bodies, joints));
        let [fixed, scaled] = seismic(&wall);
        let [_, high] = theorem(&wall, &fixed, &scaled).window(&Budget::unlimited()).unwrap().ends().unwrap();
        assert!((high / published - 1.0).abs() < 2e-6, "wall {number}: {high}");
    }
}

#[test]
fn a_stack_overturns_or_slides() {
    // min(friction, width / height): all blocks turn about the outer edge of the lowest.
    for (n, b, h, friction) in
        [(1, 0.2, 1.0, 0.7), (2, 1.0, 1.0, 0.3), (3, 1.0, 1.0, 0.7), (3, 1.0, 1.0, 0.2), (5, 1.0, 0.5, 0.7)]
    {
        let row = [b];
        let rows = vec![&row[..]; n];
        let stack = wall(&rows, h, JointLaw::Dry { friction, cohesion: 0.0 });
        let [fixed, scaled] = seismic(&stack);
        let expected = f64::min(friction, b / (n as f64 * h));
        let [low, high] = theorem(&stack, &fixed, &scaled).window(&Budget::unlimited()).unwrap().ends().unwrap();
        assert!((high - expected).abs() < 1e-12 && (low + expected).abs() < 1e-12, "{low} {high}");
    }
}

#[test]
fn a_portal_sways() {
    // Columns 1 x 4 under a lintel 6 x 1, no sliding. Both columns turn about their feet and carry the lintel along without
    // turning it: 2 columns of weight 4, levers 0.5 and 2, and a lintel of weight 6, levers 1 and 4, give
    // (2 x 4 x 0.5 + 6 x 1) / (2 x 4 x 2 + 6 x 4) = 0.25.
    let portal = scenes::blocks(
        &[[0.0, 0.0, 1.0, 4.0], [5.0, 0.0, 1.0, 4.0], [0.0, 4.0, 6.0, 1.0]],
        JointLaw::Dry { friction: 50.0, cohesion: 0.0 },
    );
    let [fixed, scaled] = seismic(&portal);
    let [low, high] = theorem(&portal, &fixed, &scaled).window(&Budget::unlimited()).unwrap().ends().unwrap();
    assert!((high - 0.25).abs() < 1e-12 && (low + 0.25).abs() < 1e-12);
}

#[test]
fn a_mirrored_structure_has_the_mirrored_window() {
    let bridges = [1, 2, 3].map(|spans| bridge(spans, 7, 1.5, DRY));
    for structure in bridges.into_iter().chain([ferris_tin_loi(1)]) {
        let [fixed, scaled] = seismic(&structure);
        let skew = PointForce { force: Vec2::new(0.3, -1.0), ..fixed[2] };
        let scaled = [&scaled[..], &[skew]].concat();
        let window = theorem(&structure, &fixed, &scaled).window(&Budget::unlimited()).unwrap().ends().unwrap();
        let turn = |loads: &[PointForce]| -> Vec<PointForce> {
            let force = |f: &PointForce| PointForce {
                at: Vec2::new(-f.at.x, f.at.y),
                force: Vec2::new(-f.force.x, f.force.y),
                ..*f
            };
            loads.iter().map(force).collect()
        };
        let again = theorem(&mirrored(&structure), &turn(&fixed), &turn(&scaled))
            .window(&Budget::unlimited())
            .unwrap()
            .ends()
            .unwrap();
        assert!((0..2).all(|end| (window[end] / again[end] - 1.0).abs() < 1e-9), "{window:?} {again:?}");
    }
}

#[test]
fn the_ground_takes_what_the_arches_push() {
    let bridge = bridge(2, 7, 1.5, DRY);
    let fixed = per_area(&bridge, Vec2::new(0.0, -20.0));
    let theorem = theorem(&bridge, &fixed, &[]);
    let thrusts = [0, 1, 2]
        .map(|support| theorem.thrust_range_of(support, 0.0, &Budget::unlimited()).unwrap().map(|end| end.thrust));
    assert_eq!(theorem.thrust_range(0.0, &Budget::unlimited()).unwrap().map(|end| end.thrust), thrusts[0]);
    // The left springing pushes to the right, the right one as much to the left, and the pier either way.
    assert!(thrusts[0][0] > 0.0 && thrusts[0][1] > thrusts[0][0]);
    assert!((0..2).all(|end| (thrusts[0][end] + thrusts[1][1 - end]).abs() < 1e-9 * thrusts[0][1]));
    assert!((thrusts[2][0] + thrusts[2][1]).abs() < 1e-9 * thrusts[0][1]);
}

#[test]
fn a_body_that_touches_nothing_is_named() {
    let mut wall = ferris_tin_loi(1);
    wall.joints.retain(|joint| !joint.between.contains(&Side::Body(9)));
    assert_eq!(StaticTheorem::new(&wall, &[], &[]).unwrap_err(), vec![Unconnected(9)]);
}
