use super::*;
use crate::arch::{assemble, straight_voussoirs};
use crate::collapse::{Mechanism, Mode, Slide, Thrust};
use crate::geometry::Vec2;
use crate::structure::{JointLaw, Stone};

/// A stone between two upright joints 1 m high, and a limit window from -1 to `limit`.
fn certificate(limit: f64) -> Certificate {
    let law = JointLaw::Dry { friction: 0.5, cohesion: 0.0 };
    let ends = [0.0, 1.0].map(|x| [0.0, 1.0].map(|y| Vec2::new(x, y)));
    let structure = assemble(&ends, straight_voussoirs(&ends).unwrap(), Stone::default(), law);
    let theorem = StaticTheorem::new(&structure, &[], &[]).unwrap();
    Certificate {
        theorem,
        proof: None,
        bases: WindowBases::default(),
        window: Some([-1.0, limit]),
        solved: true,
        any_fixed: true,
        agrees: [1e-7, 1e-6],
    }
}

/// A path that ends as the last joint slides under 100 N and a shear that opposes the sliding.
fn slid(shear: f64, load_factor: f64) -> PathEnd {
    let thrust = |joint| Thrust { joint, normal: 100.0, shear, eccentricity: 0.0, at: Vec2::zeros() };
    let slides = vec![Slide { joint: 1, at: crate::geometry::Vec2::zeros(), rate: -1.0 }];
    let mechanism =
        Mechanism { mode: Mode::Sliding, hinges: Vec::new(), slides, lift_offs: Vec::new(), velocities: Vec::new() };
    PathEnd {
        load_factor,
        range: None,
        residual: 0.0,
        mechanism,
        thrust_line: vec![thrust(0), thrust(1)],
        soil: Vec::new(),
        crushed: Vec::new(),
    }
}

#[test]
fn sliding_below_the_limit_of_friction_is_no_reason_to_fall_far_short_of_the_window() {
    for limit in [33.0, f64::INFINITY] {
        let compare = |shear| certificate(limit).compare(&slid(shear, 5e-6), 1.0);
        let stray = Doubt::Stray { path: 5e-6, limit };
        assert_eq!(compare(49.0), Err(stray.clone()));
        assert_eq!(compare(-50.0), Err(stray), "shear that drives the sliding");
        assert_eq!(compare(50.0), Ok(true));
    }
}

#[test]
fn a_load_may_fall_shortly_before_joints_that_slide_are_at_their_limits() {
    let short = certificate(33.0).compare(&slid(49.0, 30.0), 1.0);
    assert_eq!(short, Ok(true));
}

#[test]
fn a_load_is_the_only_one_where_the_window_ends_there_and_not_where_it_has_no_end() {
    let note = |greatest| range_note(&LoadRange { least: 12.0, greatest, path: 12.0, mechanisms_tried: 3 });
    assert!(matches!(note(12.0), Note::SoleSlidingLoad(_)));
    for greatest in [13.0, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(matches!(note(greatest), Note::ManySlidingLoads(_)), "{greatest}");
    }
}
