//! The curved beam of section 3.3 of the paper.

use super::{AnalysisError, BeamReport, CurvedBeam};

pub(super) fn solve(_: &CurvedBeam) -> Result<BeamReport, AnalysisError> {
    Err(AnalysisError::NotFinite { what: "curved beam" })
}
