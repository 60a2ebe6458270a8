//! The highest point of a path.

use super::Tracer;
use crate::dda::contact::State;

/// The point of the path with the largest parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Peak {
    /// Parameter.
    pub parameter: f64,
    /// Displacements of the nodes.
    pub displacements: Vec<f64>,
    /// What rounding has taken off them, on moving geometry.
    pub rests: Vec<f64>,
    /// And off the parameter.
    pub parameter_rest: f64,
    /// Direction in which the path goes on, its largest entry 1 m.
    pub direction: Vec<f64>,
    /// Change of the parameter in that direction.
    pub rate: f64,
    /// Contact states in which the path goes on.
    pub states: Vec<State>,
    /// Largest equilibrium residual up to there, as a share of the load scale.
    pub residual: f64,
}

impl Tracer<'_> {
    /// Keeps the present point where the path turns down here, and was never higher.
    pub(super) fn note_peak(&mut self, turns_down: bool) {
        let highest = self.peak.as_ref().is_none_or(|peak| self.parameter >= peak.parameter);
        if highest && turns_down {
            self.peak = Some(self.as_peak());
        }
    }

    /// The present point, and how the path goes on.
    pub(super) fn as_peak(&self) -> Peak {
        Peak {
            parameter: self.parameter,
            displacements: self.displacements.clone(),
            rests: self.rests.clone(),
            parameter_rest: self.parameter_rest,
            direction: self.direction.clone(),
            rate: self.rate,
            states: self.states.clone(),
            residual: self.worst_residual,
        }
    }
}
