//! Geometric safety factors.

use super::ThrustColumns;
use crate::collapse::{GeometricLimit, GeometricSafety};
use crate::wire::request::ThicknessRequest;
use serde::Serialize;
use utoipa::ToSchema;

/// Geometric safety factors by both definitions. Soil that resists counts in both; crushing in neither.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct GeometricSafetyBody {
    /// All joints are shortened about their middles to one share of their lengths, while all loads stay: each carries
    /// |M| <= share * N * length / 2. Friction and cohesion stay those of the whole joints. Null where no answer was found.
    pub loads_held: Option<GeometricLimitBody>,
    /// The thickness is multiplied everywhere by one share, on the same profile and line, and all loads are computed anew. Null of
    /// an arch whose thickness is not given by numbers (a surveyed one or an extrados circle), of a bridge and of blocks, and where
    /// no answer was found.
    pub weights_recomputed: Option<GeometricLimitBody>,
}

/// How thin it may be.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct GeometricLimitBody {
    /// The geometric safety factor, 1 / `least_share`; null where it is 100 or more: it stands at the least share that is tried.
    pub factor: Option<f64>,
    /// Least share of the joints' lengths, or of the thickness, at which limit analysis finds equilibrium; with recomputed weights
    /// the one below which the arch first falls as it is made thinner in steps of 5 %.
    pub least_share: f64,
    /// `least_share` of the thickness at the crown; null where the thickness is not given by numbers.
    pub least_crown_thickness_m: Option<f64>,
    /// `least_share` of the thickness at the springings; null where the thickness is not given by numbers.
    pub least_springing_thickness_m: Option<f64>,
    /// Resultant per joint in the limiting state: with loads held on the joints as they are, with recomputed weights on those of the
    /// thinner arch.
    pub thrust_line: ThrustColumns,
}

impl GeometricSafetyBody {
    pub(super) fn new(safety: &GeometricSafety, thickness: Option<&ThicknessRequest>) -> Self {
        let thickness = thickness.and_then(ThicknessRequest::at_crown_and_springings);
        let body = |limit: &GeometricLimit| GeometricLimitBody {
            factor: limit.factor(),
            least_share: limit.share,
            least_crown_thickness_m: thickness.map(|[crown, _]| limit.share * crown),
            least_springing_thickness_m: thickness.map(|[_, springing]| limit.share * springing),
            thrust_line: ThrustColumns::new(&limit.thrust_line),
        };
        GeometricSafetyBody {
            loads_held: safety.loads_held.as_ref().map(body),
            weights_recomputed: safety.weights_recomputed.as_ref().map(body),
        }
    }
}
