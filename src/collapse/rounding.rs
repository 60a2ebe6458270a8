//! What rounding takes away: arches too slender for the load path, and answers with numbers that are none.

use super::{AnalysisError, CollapseReport, Doubt, Note, Outcome};
use crate::structure::Structure;

/// The load path needs joints of at least this share of the arch's extent. Measured on catenaries of 8 and 20 stones: path and
/// limit window agree to 1e-8 down to 2.5e-5, no path was found from 1.3e-5 down, and mechanisms were none from 1e-7 down.
const SLENDEREST: f64 = 1e-5;

/// A doubt about an arch all of whose joints are too short for its size.
pub(super) fn too_slender(structure: &Structure) -> Option<Doubt> {
    let joints = || structure.ring().iter();
    let size = joints().map(|joint| (joint.middle() - structure.joints[0].middle()).norm()).fold(0.0, f64::max);
    let thickest = joints().map(|joint| joint.length()).fold(0.0, f64::max);
    (thickest < SLENDEREST * size).then(|| Doubt::Slender { thickness: thickest, share: thickest / size })
}

impl CollapseReport {
    /// The report or, where one of its numbers is not finite, `blank` with the reason.
    pub(super) fn or_cannot_tell(self, blank: CollapseReport) -> CollapseReport {
        let Err(AnalysisError::NotFinite { what }) = self.check_finite() else { return self };
        CollapseReport { outcome: Outcome::CannotTell, cost: self.cost, notes: vec![Note::NotFinite(what)], ..blank }
    }
}

#[cfg(test)]
mod tests;
