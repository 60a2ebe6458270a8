use super::super::scenes::{bridge, per_area, seismic};
use super::super::static_theorem::tests::{arch, ferris_tin_loi, loads, wrench};
use super::*;
use crate::largest::{larger, largest};
use crate::structure::{Joint, JointLaw, PointForce, Side, Structure, resultants};

const NEAR: f64 = 1e-9;

fn law(joint: &Joint) -> [f64; 2] {
    let JointLaw::Dry { friction, cohesion } = joint.law else { panic!() };
    [friction, cohesion * joint.length()]
}

/// Largest violation of equilibrium under `factors` times the two loads, or of the joints' law (without its cohesion, where there
/// are no fixed loads), as a share of the loads.
fn unbalanced(structure: &Structure, forces: &[Resultant], loads: &[Vec<[f64; 3]>; 2], factors: [f64; 2]) -> f64 {
    let both = loads[0].iter().zip(&loads[1]);
    let mut sums: Vec<[f64; 3]> =
        both.map(|(f, s)| std::array::from_fn(|i| factors[0] * f[i] + factors[1] * s[i])).collect();
    let mut worst = 0.0f64;
    for (joint, r) in structure.joints.iter().zip(forces) {
        for (side, sign) in joint.between.iter().zip([-1.0, 1.0]) {
            let Side::Body(body) = side else { continue };
            (0..3).for_each(|i| sums[*body][i] += sign * wrench(joint, r)[i]);
        }
        let [friction, adhesion] = law(joint);
        let adhesion = factors[0] * adhesion;
        worst = largest([worst, -r.intrados, -r.extrados, r.shear.abs() - friction * r.normal() - adhesion]);
    }
    let scale = loads.iter().flatten().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
    sums.as_flattened().iter().fold(worst, |m, x| larger(m, x.abs())) / scale
}

/// What the two loads do in a motion, less what cohesion takes; no joint may hinder it.
fn power(structure: &Structure, motion: &[[f64; 3]], loads: [&[PointForce]; 2]) -> [f64; 2] {
    let velocity = |body: usize, p: Vec2| {
        let ([u, v, spin], arm) = (motion[body], p - structure.bodies[body].region.centroid);
        Vec2::new(u - spin * arm.y, v + spin * arm.x)
    };
    let mut power = loads.map(|loads| loads.iter().map(|l| l.force.dot(&velocity(l.body, l.at))).sum::<f64>());
    for joint in &structure.joints {
        let at = |side: Side, p: Vec2| side.body().map_or(Vec2::zeros(), |body| velocity(body, p));
        let opening = |p: Vec2| at(joint.between[1], p) - at(joint.between[0], p);
        let [friction, adhesion] = law(joint);
        let slip = opening(joint.intrados).dot(&joint.tangent()).abs();
        power[0] -= adhesion * slip;
        for p in [joint.intrados, joint.extrados] {
            assert!(opening(p).dot(&joint.normal()) >= friction * slip - NEAR, "hindered");
        }
    }
    power
}

fn check(structure: &Structure, fixed: &[PointForce], scaled: &[PointForce]) -> Window {
    let window = StaticTheorem::new(structure, fixed, scaled).unwrap().window(&Budget::unlimited()).unwrap();
    let sums = [fixed, scaled].map(|loads| resultants(structure.bodies.len(), loads, Vec2::zeros()));
    match &window {
        Window::Falls(motion) => {
            let [work, scaled] = power(structure, motion, [fixed, scaled]);
            assert!(work > 1e-3 && scaled.abs() < NEAR * work, "{work} {scaled}");
        }
        Window::Stands(ends) => {
            for (end, sign) in ends.iter().zip([-1.0, 1.0]) {
                let (WindowEnd::Bounded { load_factor, forces, .. } | WindowEnd::Unbounded { load_factor, forces, .. }) =
                    end;
                assert!(unbalanced(structure, forces, &sums, [1.0, *load_factor]) < NEAR);
                match end {
                    WindowEnd::Bounded { motion, .. } => {
                        let [work, per_unit] = power(structure, motion, [fixed, scaled]);
                        assert!(sign * per_unit > 0.0 && (load_factor * per_unit + work).abs() < 1e-8 * work.abs());
                    }
                    WindowEnd::Unbounded { ray, .. } => {
                        let ray = ray.as_ref().unwrap();
                        assert!(unbalanced(structure, ray, &sums, [0.0, sign]) < NEAR);
                    }
                }
            }
        }
    }
    window
}

#[test]
fn both_ends_are_proved_by_either_solver() {
    let mut arch = arch();
    let [fixed, scaled] = loads(&arch);
    for law in [0.2, 0.4, 0.7].map(|friction| JointLaw::Dry { friction, cohesion: 0.3 }) {
        arch.joints.iter_mut().for_each(|joint| joint.law = law);
        check(&arch, &fixed, &scaled);
    }
    let wall = ferris_tin_loi(3);
    let [down, sideways] = [Vec2::new(0.0, -1.0), Vec2::new(1.0, 0.0)].map(|force| per_area(&wall, force));
    assert!(matches!(
        check(&wall, &down, &sideways),
        Window::Stands([WindowEnd::Bounded { .. }, WindowEnd::Bounded { .. }])
    ));
    let bridge = bridge(3, 9, 1.5, JointLaw::Dry { friction: 0.7, cohesion: 0.0 });
    let [fixed, scaled] = seismic(&bridge);
    check(&bridge, &fixed, &scaled);
}

#[test]
fn what_has_no_end_or_no_equilibrium_is_proved_too() {
    let mut arch = arch();
    arch.joints.iter_mut().for_each(|joint| joint.law = JointLaw::Dry { friction: 0.7, cohesion: 0.01 });
    let wall = ferris_tin_loi(3);
    for structure in [arch, wall] {
        let [down, up] = [-1.0, 1.0].map(|y| per_area(&structure, Vec2::new(0.0, y)));
        assert!(matches!(check(&structure, &up, &down), Window::Stands([_, WindowEnd::Unbounded { .. }])));
        assert!(matches!(check(&structure, &down, &up), Window::Stands([WindowEnd::Unbounded { .. }, _])));
        let sideways = per_area(&structure, Vec2::new(1.0, 0.0));
        assert!(matches!(check(&structure, &up, &sideways), Window::Falls(_)));
        let unscaled = check(&structure, &down, &[]);
        assert_eq!(unscaled.ends(), Some([f64::NEG_INFINITY, f64::INFINITY]));
        // Not even by rounding: a proof has no load to measure that by.
        let Window::Stands(ends) = unscaled else { panic!() };
        for end in ends {
            let WindowEnd::Unbounded { ray: Some(ray), .. } = end else { panic!("{end:?}") };
            assert!(ray.iter().all(|forces| *forces == Resultant::default()), "{ray:?}");
        }
    }
}
