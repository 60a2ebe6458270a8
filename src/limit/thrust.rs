//! The range of horizontal thrusts with which a structure can stand.

use super::programme::{Objective, Programme, ProgrammeOutcome};
use super::{Resultant, StaticTheorem};
use crate::budget::Budget;
use crate::structure::{Joint, Side};

/// An end of a range of thrusts.
#[derive(Debug, Clone, PartialEq)]
pub struct ThrustEnd {
    /// The thrust, N/m; infinite where the range has no end.
    pub thrust: f64,
    /// Forces of every joint in equilibrium there; none where it has no end, or the loads alone fix the thrust.
    pub forces: Option<Vec<Resultant>>,
}

impl StaticTheorem {
    /// Least and greatest horizontal thrust of the first support at load factor `at`, N/m; None when nothing stands.
    pub fn thrust_range(&self, at: f64, budget: &Budget) -> Option<[ThrustEnd; 2]> {
        self.thrust_range_of(0, at, budget)
    }

    /// Least and greatest horizontal force of a support on the structure at load factor `at`, N/m; None when nothing stands.
    /// Whether anything does is not looked into where this support is the only one: it bears what the loads push.
    pub fn thrust_range_of(&self, support: usize, at: f64, budget: &Budget) -> Option<[ThrustEnd; 2]> {
        let sides = || self.joints.iter().flat_map(|joint| joint.between);
        let alone = self.elements() == 0;
        if alone && sides().all(|side| side.body().is_some() || side == Side::Support(support)) {
            let push = |loads: &[[f64; 3]]| loads.iter().map(|load| load[0]).sum::<f64>();
            let thrust = 0.0 - push(&self.loads[0]) - at * push(&self.loads[1]);
            return Some([0, 1].map(|_| ThrustEnd { thrust, forces: None }));
        }
        let mut programme = Programme::new(self);
        programme.bounds = [at; 2];
        let thrust = |sign: f64| {
            let on_support = |(k, joint): (usize, &Joint)| {
                let way = sign
                    * joint
                        .between
                        .iter()
                        .position(|side| *side == Side::Support(support))
                        .map(|at| 1.0 - 2.0 * at as f64)?;
                let (n, t) = (joint.normal(), joint.tangent());
                Some((k, [way * n.x, way * n.x, way * t.x]))
            };
            Objective { load_factor: 0.0, forces: self.joints.iter().enumerate().filter_map(on_support).collect() }
        };
        let end = |sign: f64| match programme.maximise(&thrust(sign), budget) {
            ProgrammeOutcome::At(equilibrium, _) => Some(ThrustEnd {
                thrust: sign * thrust(sign).value(&equilibrium),
                forces: Some(self.resultants(&equilibrium)),
            }),
            ProgrammeOutcome::Unbounded(_) => Some(ThrustEnd { thrust: sign * f64::INFINITY, forces: None }),
            ProgrammeOutcome::Infeasible(_) | ProgrammeOutcome::Lost => None,
        };
        Some([end(-1.0)?, end(1.0)?])
    }
}
