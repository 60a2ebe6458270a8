//! The answer on moving geometry.

use super::Scale;
use super::mechanism::MechanismBody;
use crate::collapse::{CollapseReport, Outcome, UpdatedEnd, UpdatedGeometry};
use serde::Serialize;
use utoipa::ToSchema;

/// It depends on Young's modulus and the penalty: as they grow it tends to the first-order one,
/// unless joints slide and the path takes another turn.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct UpdatedBody {
    /// How the path on moving geometry ended.
    pub end: UpdatedEnd,
    /// Why there is no answer, in words; null where there is one.
    pub why: Option<String>,
    /// Intensity there: at collapse, or the highest at which the arch is known to stand; null where it falls as loaded, or where
    /// nothing grows.
    pub intensity: Option<f64>,
    /// `intensity` as a load factor.
    pub load_factor: Option<f64>,
    /// Load factor over that of the first-order collapse of stone that does not crush; null where either is missing, and for an arch that stands in a
    /// window only.
    pub over_first_order: Option<f64>,
    /// Share of the loads at the start of the path under which the arch falls as they come on together; null otherwise.
    pub share_of_loads: Option<f64>,
    /// Displacement of the crown at that load, to the right and upwards.
    pub crown_displacement_m: Option<[f64; 2]>,
    /// Largest displacement of a stone's centroid at that load.
    pub largest_displacement_m: Option<f64>,
    /// How the arch begins to fall; null where it does not.
    pub mechanism: Option<MechanismBody>,
    /// Intensity at which the arch first snaps into another shape: the path dips there by more than a hundredth of what it
    /// rose, then goes on rising; null where it does not.
    pub snap_intensity: Option<f64>,
    /// Largest equilibrium residual on the path, as a share of the loads.
    pub residual: f64,
}

impl UpdatedBody {
    pub(super) fn new(updated: &UpdatedGeometry, report: &CollapseReport, scale: &Scale<'_>) -> Self {
        let first_order = report.end.as_ref().map(|end| end.load_factor);
        let over = updated.load_factor.zip(first_order).map(|(updated, first)| updated / first);
        UpdatedBody {
            end: updated.end,
            why: updated.why.map(|why| why.to_string()),
            intensity: updated.load_factor.map(|factor| scale.intensity(factor)),
            load_factor: updated.load_factor,
            // In a window both may be negative, and a ratio would read the wrong way round.
            over_first_order: over.filter(|over| over.is_finite() && report.outcome != Outcome::StandsInWindow),
            share_of_loads: updated.share_of_loads,
            crown_displacement_m: updated.crown.map(Into::into),
            largest_displacement_m: updated.largest,
            mechanism: updated.mechanism.as_ref().map(Into::into),
            snap_intensity: updated.snap.map(|at| scale.intensity(at)),
            residual: updated.residual,
        }
    }
}
