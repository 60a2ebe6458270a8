//! Safety factors: the first of instability and crushing as the scaled loads grow from their full size.

use super::{AnalysisError, CurvePoint, SafetyPoint, Watch};

/// Safety factors over a list of abscissae.
pub(super) fn curve(_: &[CurvePoint], _: &mut dyn Watch) -> Result<Vec<SafetyPoint>, AnalysisError> {
    Ok(Vec::new())
}
