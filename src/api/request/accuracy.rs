//! How accurate an answer has to be.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Asks for an accuracy: the least model that reaches it is found, and `plan` in the answer says which. At least one of the first
/// two is given. Displacements are not covered.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct AccuracyRequest {
    /// Largest error of the collapse intensity, as a share of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(exclusive_minimum = 0.0, maximum = 1.0)]
    pub collapse_intensity: Option<f64>,
    /// Instead of a mesh: largest error of the stress in all subblocks of every stress field, as a share: the root mean square of the error of
    /// the equivalent stress over that of the equivalent stress itself, as in eq. (5) of the paper. Without
    /// `report.stress_fields` there is one field, at load factor 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(exclusive_minimum = 0.0, maximum = 1.0)]
    pub stress: Option<f64>,
    /// Most subblocks that the model may have, for the sake of `stress`.
    #[serde(default = "AccuracyRequest::default_subblocks")]
    #[schema(minimum = 1, maximum = 100000)]
    pub subblocks: usize,
}

impl AccuracyRequest {
    fn default_subblocks() -> usize {
        5000
    }
}
