use super::super::scenes::{per_area, ring, sector};
use super::super::static_theorem::tests::{arch, loads};
use super::*;
use crate::budget::Budget;
use crate::geometry::Vec2;
use crate::structure::{ActsOn, JointLaw, PointForce};
use std::f64::consts::FRAC_PI_2;

/// Strength at which nothing crushes, Pa.
const HARD: f64 = 1e30;

/// The same strength in every joint; from the bases of the window of stone that does not crush it is the same.
fn evenly(theorem: &StaticTheorem, strength: f64) -> Result<Option<CrushingWindow>, Unsolved> {
    let (strengths, budget) = (vec![strength; theorem.joints()], Budget::unlimited());
    let found = theorem.crushing_window(&strengths, &budget);
    let (_, bases) = theorem.window_and_bases(&budget).unwrap();
    let from_there = theorem.crushing_window_from(&bases, &strengths, &budget);
    match (&found, from_there) {
        (Ok(Some(found)), Ok(Some(other))) => {
            for (end, other) in found.ends.into_iter().zip(other.ends) {
                assert!(end == other || (end - other).abs() <= 1e-9 * end.abs().max(theorem.factor), "{end} {other}");
            }
            assert_eq!(found.joints, other.joints);
        }
        (found, other) => assert_eq!(*found, other),
    }
    found
}

/// One stone between two level joints of length 1 m, all but smooth, under a load of `factor` 1 N/m at `off` from
/// their middles.
fn column(off: f64, strength: f64) -> CrushingWindow {
    let law = JointLaw::Dry { friction: 1e-3, cohesion: 0.0 };
    let structure = ring(&[0.0, 1.0].map(|y| [Vec2::new(0.5, y), Vec2::new(-0.5, y)]), law);
    let load = PointForce { body: 0, at: Vec2::new(off, 0.5), force: Vec2::new(0.0, -1.0), acts_on: ActsOn::Point };
    evenly(&StaticTheorem::new(&structure, &[], &[load]).unwrap(), strength).unwrap().unwrap()
}

/// Joints below and above bear N and n, P = N - n. Both on their parabolas, e P = t (N + n) / 2 - (N^2 + n^2) / 2 f,
/// which is most for N + n = f t: P = f (sqrt(t^2 + 4 e^2) - 2 e), and f t under a centred load.
#[test]
fn a_column_carries_its_strength_times_what_is_left_of_its_joints() {
    for off in [0.0, 0.05, -0.2, 0.3, -0.45] {
        let window = column(off, 1.0);
        let expected = (1.0 + 4.0 * off * off).sqrt() - 2.0 * f64::abs(off);
        for (end, sign) in [-1.0, 1.0].into_iter().enumerate() {
            assert!((sign * window.ends[end] / expected - 1.0).abs() < 2e-3, "{off}, {expected}: {window:?}");
            assert!(window.joints[end].contains(&(1 - end)), "{window:?}");
        }
    }
    assert_eq!(column(0.1, HARD).ends[1], f64::INFINITY);
}

#[test]
fn a_hard_stone_leaves_the_plain_window() {
    let mut arch = arch();
    let [fixed, scaled] = loads(&arch);
    let hard = |theorem: &StaticTheorem| evenly(theorem, HARD).unwrap().map(|window| window.ends);
    let upwards: Vec<_> = fixed.iter().map(|f| PointForce { force: -f.force * 10.0, ..*f }).collect();
    for (fixed, scaled) in [(&fixed, &scaled), (&fixed, &fixed), (&scaled, &fixed), (&upwards, &vec![])] {
        let theorem = StaticTheorem::new(&arch, fixed, scaled).unwrap();
        assert_eq!(hard(&theorem), theorem.window(&Budget::unlimited()).unwrap().ends());
    }
    arch.joints.iter_mut().for_each(|joint| joint.law = JointLaw::Bonded);
    let bonded = evenly(&StaticTheorem::new(&arch, &fixed, &scaled).unwrap(), 1.0).unwrap().unwrap();
    assert_eq!(bonded.ends, [f64::NEG_INFINITY, f64::INFINITY]);
    assert!(bonded.joints.iter().all(Vec::is_empty));
}

#[test]
fn a_stronger_stone_bears_more() {
    let arch = arch();
    let [fixed, scaled] = loads(&arch);
    let theorem = StaticTheorem::new(&arch, &fixed, &scaled).unwrap();
    let [low, high] = theorem.window(&Budget::unlimited()).unwrap().ends().unwrap();
    let windows: Vec<_> = (0..60).map(|k| evenly(&theorem, 1.2f64.powi(k)).unwrap()).collect();
    assert!(windows[0].is_none());
    let found: Vec<_> = windows.iter().skip_while(|window| window.is_none()).collect();
    assert!(found.len() > 40 && found.iter().all(|window| window.is_some()));
    for pair in found.windows(2) {
        let [[l, h], [l2, h2]] = [pair[0], pair[1]].map(|window| window.as_ref().unwrap().ends);
        assert!(l2 < l && l < h && h < h2, "{pair:?}");
    }
    let last = found[found.len() - 1].as_ref().unwrap().ends;
    assert!(last[0] > low && last[1] < high && (last[1] / high - 1.0).abs() < 0.05);
}

#[test]
fn crushed_joints_leave_just_the_length_they_need() {
    let arch = arch();
    let [fixed, _] = loads(&arch);
    let theorem = StaticTheorem::new(&arch, &fixed, &fixed).unwrap();
    let window = evenly(&theorem, 500.0).unwrap().unwrap();
    assert_eq!(theorem.window(&Budget::unlimited()).unwrap().ends().unwrap()[1], f64::INFINITY);
    assert!(window.ends[1].is_finite() && window.joints[1].len() >= 2, "{window:?}");
}

#[test]
fn a_strength_that_is_none_is_refused() {
    let arch = arch();
    let [fixed, scaled] = loads(&arch);
    let theorem = StaticTheorem::new(&arch, &fixed, &scaled).unwrap();
    for strength in [0.0, -1.0, f64::NAN] {
        assert_eq!(evenly(&theorem, strength), Err(Unsolved));
    }
    assert_eq!(
        evenly(&theorem, f64::INFINITY).unwrap().unwrap().ends,
        theorem.window(&Budget::unlimited()).unwrap().ends().unwrap()
    );
}

/// Of a smooth joint no shear is admissible, of either sign: two constraints that are each other's negative. Beside tangents of one joint that
/// are all but parallel they once led to a basis that rounding turned singular, and to ends that were too low: tangents, from either
/// basis, end where cones do.
#[test]
fn tangents_of_arches_on_a_smooth_springing_end_where_cones_do() {
    // Voussoirs, opening angle in degrees, thickness, abscissa of the load, whether the right springing is smooth, strength.
    let arches = [
        (8, 30.958914015676427, 1.5794251327931588, 0.6183706810339542, true, 1e8),
        (12, 22.05224819274076, 1.5985118908644866, -0.4434369116029013, true, 1e7),
        (11, 21.242685539352827, 1.5487838871857522, -0.5713673523802557, false, 1e7),
        (11, 21.242685539352827, 1.5487838871857522, -0.5713673523802557, false, 3e7),
        (12, 26.507052770359067, 1.1086479415257129, 0.5231150964955706, false, 3e7),
    ];
    for (stones, opening, thickness, x, right, strength) in arches {
        let ([intrados, extrados], half) =
            ([8.9 - 0.5 * thickness, 8.9 + 0.5 * thickness], 0.5 * f64::to_radians(opening));
        let angles = [FRAC_PI_2 + half, FRAC_PI_2 - half];
        let rough = JointLaw::Dry { friction: 30f64.to_radians().tan(), cohesion: 0.0 };
        let mut arch = ring(&sector(Vec2::default(), [intrados, extrados], angles, stones), rough);
        arch.joints[if right { stones } else { 0 }].law = JointLaw::Dry { friction: 0.0, cohesion: 0.0 };
        let at = Vec2::new(x, f64::sqrt(extrados * extrados - x * x));
        let share = (angles[0] - at.y.atan2(at.x)) / (angles[0] - angles[1]);
        let body = (share * stones as f64) as usize;
        let load = PointForce { body, at, force: Vec2::new(0.0, -1000.0), acts_on: ActsOn::Point };
        let weight = per_area(&arch, Vec2::new(0.0, -2300.0 * 9.81));
        let theorem = StaticTheorem::new(&arch, &weight, &[load]).unwrap();
        let window = evenly(&theorem, strength).unwrap().unwrap();
        let mut conic = Programme::new(&theorem);
        conic.sections = theorem.sections(&vec![strength; theorem.joints()]);
        conic.errors[1] = NEARLY_SOLVED;
        for (end, sign) in window.ends.into_iter().zip([-1.0, 1.0]) {
            let cones = conic.maximise_sparsely(&Objective::load_factor(sign), &Budget::unlimited());
            let cones = cones.equilibrium().unwrap().unwrap().load_factor;
            assert!((end / cones - 1.0).abs() < 1e-7, "{stones} stones, {opening} degrees: {end} and {cones}");
        }
    }
}
