//! The worst position of vehicles.

use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use utoipa::ToSchema;

/// Where vehicles stand worst, and all that is told of a collapse there. The position is that of every `vehicle` load without `x_m`,
/// all by the same reference; at least one of them is scaled, and the load factor increases. Limit analysis looks for the least load
/// factor at which the structure falls or joints of the stone's strength give way: at positions at most `step_m` apart, and between
/// them wherever it may be lower by the mechanisms found on either side. A mechanism that governs between two positions only is
/// seen where it is like those; of steps longer than the stones it may not be.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(default)]
pub struct WorstPositionRequest {
    /// First abscissa of the reference, m. Left out: from where any of the vehicles' force comes down on the structure.
    #[schema(minimum = -1e5, maximum = 1e5)]
    pub from_m: Option<f64>,
    /// Last abscissa of the reference, m; above `from_m`. Left out: as far as any of it comes down there.
    #[schema(minimum = -1e5, maximum = 1e5)]
    pub to_m: Option<f64>,
    /// Largest distance of two positions that are solved in any case, m. At most 2000 positions in all; times axles times upper faces of
    /// the structure at most 4,000,000.
    #[schema(minimum = 1e-6, maximum = 1e5)]
    pub step_m: f64,
    /// By how much the load factor may be lower between positions by what mechanisms say, as a share of the least one given.
    #[schema(minimum = 1e-9, maximum = 0.1)]
    pub tolerance: f64,
    /// Which way the vehicles drive.
    pub directions: DrivingRequest,
}

impl Default for WorstPositionRequest {
    fn default() -> Self {
        WorstPositionRequest {
            from_m: None,
            to_m: None,
            step_m: 0.1,
            tolerance: 1e-4,
            directions: DrivingRequest::default(),
        }
    }
}

/// Which way vehicles drive.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum DrivingRequest {
    /// As their `reversed` has it, and the other way.
    #[default]
    Both,
    /// As their `reversed` has it.
    AsGiven,
}
