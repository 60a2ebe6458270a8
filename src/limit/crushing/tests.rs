use super::super::static_theorem::tests::{loads, skewed};
use super::*;
use crate::arch::{assemble, straight_voussoirs};
use crate::geometry::Vec2;
use crate::limit::unwatched;
use crate::structure::{JointLaw, PointForce, Stone};

/// Strength at which nothing crushes, Pa.
const HARD: f64 = 1e30;

/// One stone between two level joints of length 1 m, all but smooth, under a load of `factor` 1 N/m at `off` from
/// their middles.
fn column(off: f64, strength: f64) -> CrushingWindow {
    let law = JointLaw::Dry { friction: 1e-3, cohesion: 0.0 };
    let ends = [0.0, 1.0].map(|y| [0.5, -0.5].map(|x| Vec2::new(x, y)));
    let structure = assemble(&ends, straight_voussoirs(&ends).unwrap(), Stone::default(), law, Vec2::zeros());
    let load = PointForce { body: 0, at: Vec2::new(off, 0.5), force: Vec2::new(0.0, -1.0), spread: false };
    StaticTheorem::new(&structure, &[], &[load]).crushing_window(strength, &unwatched).unwrap().unwrap()
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
    let mut structure = skewed();
    let [fixed, scaled] = loads(&structure);
    let hard = |theorem: &StaticTheorem| theorem.crushing_window(HARD, &unwatched).unwrap().map(|window| window.ends);
    let upwards: Vec<_> = fixed.iter().map(|f| PointForce { force: -f.force * 10.0, ..*f }).collect();
    for (fixed, scaled) in [(&fixed, &scaled), (&fixed, &fixed), (&scaled, &fixed), (&upwards, &vec![])] {
        let theorem = StaticTheorem::new(&structure, fixed, scaled);
        assert_eq!(hard(&theorem), theorem.window(&unwatched).unwrap());
    }
    structure.joints.iter_mut().for_each(|joint| joint.law = JointLaw::Bonded);
    let bonded = StaticTheorem::new(&structure, &fixed, &scaled).crushing_window(1.0, &unwatched).unwrap().unwrap();
    assert_eq!(bonded.ends, [f64::NEG_INFINITY, f64::INFINITY]);
    assert!(bonded.joints.iter().all(Vec::is_empty));
}

#[test]
fn a_stronger_stone_bears_more() {
    let structure = skewed();
    let [fixed, scaled] = loads(&structure);
    let theorem = StaticTheorem::new(&structure, &fixed, &scaled);
    let [low, high] = theorem.window(&unwatched).unwrap().unwrap();
    let windows: Vec<_> = (0..60).map(|k| theorem.crushing_window(1.2f64.powi(k), &unwatched).unwrap()).collect();
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
    let structure = skewed();
    let [fixed, _] = loads(&structure);
    let theorem = StaticTheorem::new(&structure, &fixed, &fixed);
    let window = theorem.crushing_window(500.0, &unwatched).unwrap().unwrap();
    assert_eq!(theorem.window(&unwatched).unwrap().unwrap()[1], f64::INFINITY);
    assert!(window.ends[1].is_finite() && window.joints[1].len() >= 2, "{window:?}");
}

#[test]
fn a_strength_that_is_none_is_refused() {
    let structure = skewed();
    let [fixed, scaled] = loads(&structure);
    let theorem = StaticTheorem::new(&structure, &fixed, &scaled);
    for strength in [0.0, -1.0, f64::NAN] {
        assert_eq!(theorem.crushing_window(strength, &unwatched), Err(Unsolved));
    }
    assert_eq!(
        theorem.crushing_window(f64::INFINITY, &unwatched).unwrap().unwrap().ends,
        theorem.window(&unwatched).unwrap().unwrap()
    );
}
