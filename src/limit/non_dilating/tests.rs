use super::super::scenes::ring;
use super::*;
use crate::budget::Budget;
use crate::geometry::Vec2;
use crate::structure::{ActsOn, PointForce, Side};

const FRICTION: f64 = 0.5;

fn joint(x: f64, law: JointLaw) -> Joint {
    Joint { between: [Side::Support(0), Side::Body(0)], intrados: Vec2::new(x, 0.0), extrados: Vec2::new(x, 1.0), law }
}

/// One stone of 1 m x 1 m between two upright walls: 100 N press it down, and scaled loads push it down.
fn wedged(cohesion: f64) -> StaticTheorem {
    let law = JointLaw::Dry { friction: FRICTION, cohesion };
    let ends = [0.0, 1.0].map(|x| [Vec2::new(x, 0.0), Vec2::new(x, 1.0)]);
    let structure = ring(&ends, law);
    let push = |force: f64| {
        vec![PointForce { body: 0, at: Vec2::new(0.5, 0.5), force: Vec2::new(0.0, -force), acts_on: ActsOn::Point }]
    };
    StaticTheorem::new(&structure, &push(100.0), &push(1.0)).unwrap()
}

fn forces(intrados: f64, extrados: f64, shear: f64) -> Resultant {
    Resultant { intrados, extrados, shear }
}

#[test]
fn a_joint_at_its_limits_lets_go_what_it_can_no_longer_hold() {
    use Release::{Rotation, Sliding};
    let dry = joint(0.0, JointLaw::Dry { friction: FRICTION, cohesion: 10.0 });
    let of = |joint: &Joint, n: [f64; 2], shear: f64| releases(joint, &forces(n[0], n[1], shear), 1e-7);
    assert_eq!(of(&dry, [50.0, 50.0], 59.0), vec![]);
    // The shear on the stone after the joint opposes its sliding.
    assert_eq!(of(&dry, [50.0, 50.0], 60.0), vec![Sliding(-1.0)]);
    assert_eq!(of(&dry, [50.0, 50.0], -60.0), vec![Sliding(1.0)]);
    assert_eq!(of(&dry, [100.0, 0.0], 0.0), vec![Rotation(Face::Intrados)]);
    assert_eq!(of(&dry, [0.0, 100.0], 60.0), vec![Rotation(Face::Extrados), Sliding(-1.0)]);
    // Of a joint that opens anything from none to all of its cohesion may be left.
    assert_eq!(of(&dry, [0.0, 100.0], 50.0), vec![Rotation(Face::Extrados), Sliding(-1.0)]);
    assert_eq!(of(&dry, [0.0, 100.0], 49.0), vec![Rotation(Face::Extrados)]);
    assert_eq!(of(&joint(0.0, JointLaw::Bonded), [0.0, 0.0], 0.0), vec![]);
    assert_eq!(of(&joint(0.0, JointLaw::Mirror), [9.0, 9.0], 0.0).len(), 2);
}

/// The least load of a mechanism from load factor `start` on.
fn least_load(theorem: &StaticTheorem, moving: &[(usize, Release)], start: f64) -> Option<Equilibrium> {
    theorem
        .least_loads(start, 1.0, &Budget::unlimited())
        .of((moving, &[]), f64::INFINITY, &Budget::unlimited())
        .unwrap()
}

/// A stone that slides down between two walls may be wedged as little as not at all: then only the cohesion of both joints
/// holds it. Limit analysis, in which the slides push the walls apart, knows no end.
#[test]
fn the_least_load_of_a_stone_between_two_walls_is_that_without_thrust() {
    for cohesion in [100.0, 150.0] {
        let theorem = wedged(cohesion);
        let [_, highest] = theorem.window(&Budget::unlimited()).unwrap().ends().unwrap();
        assert_eq!(highest, f64::INFINITY);
        // The stone after joint 0 goes down: towards the intrados; the wall after joint 1 stays, so that it goes up against it.
        let moving = [(0, Release::Sliding(-1.0)), (1, Release::Sliding(1.0))];
        let least = least_load(&theorem, &moving, 0.0).unwrap();
        assert!((least.load_factor - (2.0 * cohesion - 100.0)).abs() < 1e-9, "{least:?}");
        let [left, right] = theorem.resultants(&least)[..] else { panic!() };
        assert!((left.shear - cohesion).abs() < 1e-9 && (right.shear + cohesion).abs() < 1e-9);
        // From a start beyond it, the start itself is the least: there the stone is wedged.
        let later = least_load(&theorem, &moving, 500.0).unwrap();
        assert!((later.load_factor - 500.0).abs() < 1e-9);
        // Sliding up has no admissible forces at a load that pushes down.
        let up = [(0, Release::Sliding(1.0)), (1, Release::Sliding(-1.0))];
        assert_eq!(least_load(&theorem, &up, 0.0), None);
    }
}

#[test]
fn a_joint_that_opens_may_have_lost_its_cohesion() {
    let theorem = wedged(150.0);
    // Both joints open at the extrados as the stone slides down.
    let moving = [
        (0, Release::Sliding(-1.0)),
        (0, Release::Rotation(Face::Intrados)),
        (1, Release::Sliding(1.0)),
        (1, Release::Rotation(Face::Intrados)),
    ];
    // The least is that without cohesion and thrust: the stone hangs on nothing, so that the load must pull it up.
    let least = least_load(&theorem, &moving, -1000.0).unwrap();
    for forces in theorem.resultants(&least) {
        assert!(forces.extrados.abs() < 1e-9 && forces.intrados.abs() < 1e-9 && forces.shear.abs() < 1e-9);
    }
    assert!((least.load_factor + 100.0).abs() < 1e-9);
}
