//! The tolerances of surveyed points.

use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use utoipa::ToSchema;

/// How the load factor moves with surveyed points, and all that is told of a collapse of the arch as surveyed. Every point may lie
/// a tolerance farther out or in, along the normal of its face. Limit analysis is asked of the arch with each point moved alone, both
/// ways, and with all points at their worst together; its stones and loads are computed anew every time. For a `surveyed` profile,
/// not for half an arch; a load is scaled, and the load factor increases.
#[skip_serializing_none]
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(default)]
pub struct SurveyToleranceRequest {
    /// Tolerance of every point of a face that has no list here, m.
    #[schema(minimum = 0.0, maximum = 1e5)]
    pub tolerance_m: f64,
    /// Tolerance of every point of the intrados, from left to right, m; 0 of a point that is certain.
    #[schema(min_items = 3, max_items = 2002)]
    pub intrados_m: Option<Vec<Tolerance>>,
    /// Tolerance of every point of the extrados, from left to right, m; 0 of a point that is certain. Not with `thickness_m`.
    #[schema(min_items = 3, max_items = 2002)]
    pub extrados_m: Option<Vec<Tolerance>>,
}

/// How far a point may lie either way, m.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(minimum = 0.0, maximum = 1e5)]
pub struct Tolerance(pub f64);
