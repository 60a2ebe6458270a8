//! Placeholder.
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
/// R.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AnalysisRequest {
    /// L.
    pub load_factor: LoadFactor,
}
impl Default for AnalysisRequest {
    fn default() -> Self {
        AnalysisRequest { load_factor: LoadFactor { unit: "1".into(), intensity_per_unit: 1.0 } }
    }
}
/// L.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct LoadFactor {
    /// u
    pub unit: String,
    /// i
    pub intensity_per_unit: f64,
}
