//! Words of the answer.

use crate::wire::request::MethodRequest;
use serde::Serialize;
use utoipa::ToSchema;

/// What an answer is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum KindWord {
    /// Of one analysis of a structure.
    Analysis,
    /// Of a safety curve.
    SafetyCurve,
    /// Of the curved beam.
    CurvedBeam,
}

/// How the load path was read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum MethodWord {
    /// Exactly, from event to event.
    EventPath,
    /// In fixed steps, for comparison with the paper.
    FixedSteps,
}

/// Where a contact point lies on its joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum PlaceWord {
    /// At the end on the intrados.
    Intrados,
    /// Between the ends.
    Inside,
    /// At the end on the extrados.
    Extrados,
}

impl PlaceWord {
    /// The place at this share of the joint from the intrados.
    pub fn at(share: f64) -> Self {
        match share {
            0.0 => PlaceWord::Intrados,
            1.0 => PlaceWord::Extrados,
            _ => PlaceWord::Inside,
        }
    }
}

impl From<&MethodRequest> for MethodWord {
    fn from(method: &MethodRequest) -> Self {
        match method {
            MethodRequest::EventPath => MethodWord::EventPath,
            MethodRequest::FixedSteps(_) => MethodWord::FixedSteps,
        }
    }
}
