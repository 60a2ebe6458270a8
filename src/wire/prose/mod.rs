//! An answer in words.

pub(super) mod assumptions;
mod beam;
pub(super) mod curve;
mod doubts;
mod first_yield;
mod geometric;
mod given;
pub(super) mod joints;
pub(super) mod moving;
mod notes;
mod noun;
mod plan;
mod positions;
mod safety;
mod settlement;
mod shape;
pub(super) mod summary;
mod survey;
mod window;
mod wording;

pub use crate::render::digits::{Digits, Measured, Rounded};
pub use noun::{in_its_words, noun};
pub use survey::smoothed;
pub use wording::{headline, motion, name as name_of_end, unit, word};

use super::response::JobResult;
use std::time::Duration;

/// The answer as an engineer reads it; `wall_time` is what finding it took.
pub fn prose(result: &JobResult, wall_time: Duration) -> String {
    match result {
        JobResult::Analysis(result) => summary::summary(result, wall_time),
        JobResult::SafetyCurve(result) => curve::summary(result, wall_time),
        JobResult::CurvedBeam(result) => beam::summary(result, wall_time),
    }
}
