use super::*;
use crate::collapse::{
    Cost, Crushing, Direction, HistoryPoint, LimitWindow, Reach, SafetyFactors, StatesFrom, TaskReport,
};
use crate::geometry::Vec2;

/// A report of nothing but its limit window.
fn blank() -> CollapseReport {
    CollapseReport {
        outcome: Outcome::CannotTell,
        direction: Direction::Increase,
        proof: None,
        limit_window: Some(LimitWindow { lowest: -1.0, highest: f64::INFINITY }),
        thrust_range: None,
        thrust_range_lines: [None, None],
        end: None,
        other_end: None,
        start: 0.0,
        cap: 10.0,
        share: 0.999,
        near_collapse: None,
        at_unit_load: None,
        at_start: None,
        stress_fields: Vec::new(),
        crushing: Crushing::new(1e7, None),
        updated: None,
        task: TaskReport::Safety(SafetyFactors::UNKNOWN),
        states_from: StatesFrom::LoadPath,
        history: Vec::new(),
        motion: None,
        other_motion: None,
        plan: None,
        cost: Cost::default(),
        notes: Vec::new(),
    }
}

/// A collapse whose crown moved by so much, m.
fn collapse(crown: f64) -> CollapseReport {
    let point = HistoryPoint { load_factor: 2.0, crown: Vec2::new(crown, 0.0), largest: 1.0 };
    CollapseReport { outcome: Outcome::Collapse, history: vec![point], ..blank() }
}

#[test]
fn a_number_that_is_none_leaves_the_window_and_a_reason() {
    assert_eq!(collapse(1.0).or_cannot_tell(blank()), collapse(1.0));
    for crown in [f64::NAN, f64::INFINITY] {
        let task = TaskReport::Safety(SafetyFactors { governing: Reach::At(2.0), ..SafetyFactors::UNKNOWN });
        let report = CollapseReport { task, ..collapse(crown) }.or_cannot_tell(blank());
        assert_eq!((report.outcome, report.history.len()), (Outcome::CannotTell, 0));
        assert_eq!(report.limit_window, blank().limit_window);
        assert_eq!(report.safety(), Some(&SafetyFactors::UNKNOWN));
        assert_eq!(report.notes, [Note::NotFinite("history")]);
        assert_eq!(report.not_finite(), None);
    }
}
