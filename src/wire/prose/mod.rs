//! An answer in words, and the words under its picture.

mod beam;
mod curve;
mod digits;
mod figure;
mod geometric;
mod given;
mod joints;
mod moving;
mod notes;
mod noun;
mod plan;
mod positions;
mod safety;
mod settlement;
mod summary;
mod survey;
mod wording;

pub use digits::{Digits, Rounded};
pub use figure::figure;
pub use noun::in_its_words;
pub use survey::smoothed;

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
