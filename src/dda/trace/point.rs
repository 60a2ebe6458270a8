//! Points of the path, to twice the digits where the geometry moves.

use super::Tracer;
use crate::dda::moving::Twofold;

/// A point of the path: displacements of the nodes and the parameter, and what rounding has taken off each.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PathState {
    pub displacements: Vec<f64>,
    pub parameter: f64,
    rests: Vec<f64>,
    rest: f64,
}

impl PathState {
    /// The point on the line to another one, between whose parameters this one lies.
    pub(super) fn towards(&self, other: &PathState, parameter: f64) -> Self {
        let share = ((parameter - self.parameter) / (other.parameter - self.parameter)).clamp(0.0, 1.0);
        let displacements = self.displacements.iter().zip(&other.displacements).map(|(a, b)| a + share * (b - a));
        PathState { displacements: displacements.collect(), parameter, rests: vec![0.0; self.rests.len()], rest: 0.0 }
    }
}

impl Tracer<'_> {
    /// Where the path is.
    pub(super) fn point(&self) -> PathState {
        let (displacements, rests) = (self.displacements.clone(), self.rests.clone());
        PathState { displacements, parameter: self.parameter, rests, rest: self.parameter_rest }
    }

    /// Goes to a point; forces and rates are not renewed.
    pub(super) fn go_to(&mut self, point: &PathState) {
        self.displacements.clone_from(&point.displacements);
        self.rests.clone_from(&point.rests);
        (self.parameter, self.parameter_rest) = (point.parameter, point.rest);
    }

    /// Takes the parameter to a value.
    pub(super) fn set_parameter(&mut self, parameter: f64) {
        (self.parameter, self.parameter_rest) = (parameter, 0.0);
    }

    /// The parameter, to twice the digits.
    pub(super) fn exact_parameter(&self) -> Twofold {
        Twofold { high: self.parameter, low: self.parameter_rest }
    }

    /// Displaces the nodes by a step along the direction, and by `corrections`, and the parameter with the step.
    pub(super) fn move_by(&mut self, step: f64, corrections: &[f64]) {
        for (i, (d, rest)) in self.displacements.iter_mut().zip(&mut self.rests).enumerate() {
            let by = Twofold::sum(corrections[i], step * self.direction[i]);
            let Twofold { high, low } = Twofold { high: *d, low: *rest }.plus(by);
            (*d, *rest) = (high, low);
        }
        let Twofold { high, low } = self.exact_parameter().plus(Twofold { high: step * self.rate, low: 0.0 });
        (self.parameter, self.parameter_rest) = (high, low);
    }
}
