//! A report before anything has been found but the limit window.

use super::Setup;
use crate::collapse::{CollapseReport, Cost, LimitWindow, Outcome, SafetyFactors, StatesFrom, Task, TaskReport};

impl Setup<'_> {
    /// A report of nothing but the limit window, on a model of so many `unknowns`.
    pub(super) fn blank(&self, unknowns: usize) -> CollapseReport {
        let window = self.rigid;
        CollapseReport {
            outcome: Outcome::CannotTell,
            direction: self.analysis.task.direction(),
            limit_window: window.map(|[lowest, highest]| LimitWindow { lowest, highest }),
            proof: self.certificate.proof.clone(),
            thrust_range: self.thrust.0,
            thrust_range_lines: self.thrust.1.clone(),
            end: None,
            other_end: None,
            start: self.start,
            cap: self.cap,
            share: self.analysis.task.share(),
            near_collapse: None,
            at_unit_load: None,
            at_start: None,
            stress_fields: Vec::new(),
            crushing: self.crushing.clone(),
            updated: None,
            task: match self.analysis.task {
                Task::Collapse(_) => TaskReport::Collapse,
                Task::Safety(_) => TaskReport::Safety(SafetyFactors::UNKNOWN),
                Task::Settlement(_) => TaskReport::Settlement(None),
                Task::GeometricSafety(_) => TaskReport::GeometricSafety(None),
            },
            states_from: StatesFrom::LoadPath,
            history: Vec::new(),
            motion: None,
            other_motion: None,
            plan: None,
            cost: Cost { unknowns, ..Cost::default() },
            notes: Vec::new(),
        }
    }
}
