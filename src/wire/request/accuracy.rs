//! How accurate an answer has to be.

use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use utoipa::ToSchema;

/// How accurate the answer has to be: the least model that reaches it is found, and `plan` in the answer says which. At least one
/// of `collapse_intensity` and `stress` is given. Displacements are not covered. For method `event_path` on first-order geometry;
/// not with a safety curve or a settlement.
#[skip_serializing_none]
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct AccuracyRequest {
    /// Largest error of the collapse intensity, as a share of it, such as 1e-6.
    #[schema(exclusive_minimum = 0.0, maximum = 1.0)]
    pub collapse_intensity: Option<f64>,
    /// Largest error of the stress, as a share, instead of a mesh. It is the root mean square, by area, of the error
    /// of the stress over that of the stress itself, all components of it, point by point, in the worst of
    /// `report.stress_fields`. Without those there is one field, at load factor 1. Where some body has corners within a side it is that of
    /// the mean of every subblock. What is nearer to a force on a point than a tenth of the body's longest joint, or than a
    /// quarter of its least width where that is less, is not counted: stress has no bound there.
    #[schema(exclusive_minimum = 0.0, maximum = 1.0)]
    pub stress: Option<f64>,
    /// Most subblocks that the model may have, for the sake of `stress`.
    #[schema(required = false, default = 5000, minimum = 1, maximum = 100000)]
    pub subblocks: usize,
}
