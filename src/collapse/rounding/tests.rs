use super::*;
use crate::collapse::{Cost, LimitWindow, Mechanism, Mode, PathEnd, Reach, SafetyPoint};

/// A report of nothing but its limit window.
fn blank() -> CollapseReport {
    CollapseReport {
        outcome: Outcome::CannotTell,
        limit_window: Some(LimitWindow { lowest: -1.0, highest: f64::INFINITY }),
        thrust_range: None,
        end: None,
        other_end: None,
        start: 0.0,
        cap: 10.0,
        share: 0.999,
        near_collapse: None,
        at_unit_load: None,
        at_start: None,
        stress_fields: Vec::new(),
        crushing: None,
        updated: None,
        settlement: None,
        safety: None,
        history: Vec::new(),
        motion: None,
        other_motion: None,
        plan: None,
        cost: Cost::default(),
        notes: Vec::new(),
    }
}

/// A collapse whose stones move with this velocity.
fn collapse(velocity: f64) -> CollapseReport {
    let velocities = vec![[velocity, 0.0, 0.0]];
    let (hinges, slides, lift_offs) = (Vec::new(), Vec::new(), Vec::new());
    let mechanism = Mechanism { mode: Mode::Sway, hinges, slides, lift_offs, velocities };
    let end = PathEnd { load_factor: 2.0, residual: 0.0, mechanism, thrust_line: Vec::new() };
    CollapseReport { outcome: Outcome::Collapse, end: Some(end), ..blank() }
}

#[test]
fn a_number_that_is_none_leaves_the_window_and_a_reason() {
    assert_eq!(collapse(1.0).or_cannot_tell(blank()), collapse(1.0));
    for velocity in [f64::NAN, f64::INFINITY] {
        let safety = SafetyPoint { governing: Reach::At(2.0), ..SafetyPoint::unknown(None) };
        let report = CollapseReport { safety: Some(safety), ..collapse(velocity) }.or_cannot_tell(blank());
        assert_eq!((report.outcome, &report.end), (Outcome::CannotTell, &None));
        assert_eq!(report.limit_window, blank().limit_window);
        assert_eq!(report.safety, Some(SafetyPoint::unknown(None)));
        assert!(report.notes[0].contains("mechanism"), "{:?}", report.notes);
        assert_eq!(report.check_finite(), Ok(()));
    }
}
