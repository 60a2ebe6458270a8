//! Geometric safety factors.

use super::Thrust;

/// Geometric safety of a structure that stands under its fixed loads.
#[derive(Debug, Clone, PartialEq)]
pub struct GeometricSafety {
    /// Joints are shortened about their middles while the loads stay. None where no programme could tell.
    pub loads_held: Option<GeometricLimit>,
    /// The thickness is multiplied everywhere, and the loads are computed anew. None where the structure is no arch of a thickness,
    /// or nothing could tell.
    pub weights_recomputed: Option<GeometricLimit>,
}

/// How thin it may be.
#[derive(Debug, Clone, PartialEq)]
pub struct GeometricLimit {
    /// The least share of the lengths of its joints, or of its thickness, at which limit analysis finds equilibrium.
    pub share: f64,
    /// It stands at the least share that was tried, which this is.
    pub is_least_tried: bool,
    /// Resultants per joint there.
    pub thrust_line: Vec<Thrust>,
}

impl GeometricLimit {
    /// The geometric safety factor: one over the share; none where only its lower bound is known.
    pub fn factor(&self) -> Option<f64> {
        (!self.is_least_tried).then(|| 1.0 / self.share)
    }
}
