//! What is asked of the motion after collapse.

use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use utoipa::ToSchema;

/// Motion after collapse: rigid stones at loads a little beyond those of collapse, step by step. Any two may touch. Only where
/// `analysis` asks for collapse.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(default)]
pub struct MotionRequest {
    /// Most steps, each a frame of the answer. Frames times stones come to at most 60,000.
    #[schema(minimum = 1, maximum = 3000)]
    pub most_frames: usize,
    /// The motion ends when some corner has moved by this share of the span (the longest; of blocks the longer side of the box
    /// around them).
    #[schema(exclusive_minimum = 0.0, maximum = 1.0)]
    pub share_of_span: f64,
    /// Height of level ground below all stones, m. Without it there is only the ground below the joints of every support, from
    /// the first to the last of those on one line: what falls past it falls on.
    #[schema(exclusive_minimum = -1e5, maximum = 1e5)]
    pub ground_level_m: Option<f64>,
}

impl Default for MotionRequest {
    fn default() -> Self {
        MotionRequest { most_frames: 300, share_of_span: 0.1, ground_level_m: None }
    }
}
