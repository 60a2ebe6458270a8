//! What rounding takes away: arches too slender for the load path, and answers with numbers that are none.

use super::{CollapseReport, Doubt, Note, Outcome};
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
    /// The report or, where one of the numbers that its outcome rests on is not finite, `blank` with the reason.
    pub(super) fn or_cannot_tell(self, blank: CollapseReport) -> CollapseReport {
        let Some(what) = self.not_finite() else { return self };
        CollapseReport { outcome: Outcome::CannotTell, cost: self.cost, notes: vec![Note::NotFinite(what)], ..blank }
    }

    /// What of the path, its ends and the states on it is not finite.
    fn not_finite(&self) -> Option<&'static str> {
        let found = self.ends();
        let ends = || found.iter().map(|end| end.state).chain(&self.end).chain(&self.other_end);
        let states = || self.near_collapse.iter().chain(&self.at_unit_load).chain(&self.at_start);
        let motions =
            self.motion.iter().chain(&self.other_motion).flat_map(|motion| [motion.load_factor, motion.overload]);
        let loads = ends().flat_map(|end| [end.load_factor, end.residual]).chain([self.start, self.cap]).chain(motions);
        let velocities = ends().flat_map(|end| &end.mechanism.velocities).flatten();
        let thrust = ends().flat_map(|end| &end.thrust_line).flat_map(|at| [at.normal, at.shear, at.eccentricity]);
        let moved =
            self.history.iter().flat_map(|point| [point.load_factor, point.crown.x, point.crown.y, point.largest]);
        let stresses = states().flat_map(|state| &state.blocks).flat_map(|block| block.stress);
        let forces = states().flat_map(|state| &state.contacts).flat_map(|at| [at.normal, at.tangential, at.gap]);
        let quantities = [
            ("collapse load", finite(loads)),
            ("mechanism", finite(velocities.copied())),
            ("thrust line", finite(thrust)),
            ("history", finite(moved)),
            ("stresses", finite(stresses)),
            ("contact forces", finite(forces)),
        ];
        quantities.into_iter().find_map(|(what, finite)| (!finite).then_some(what))
    }
}

fn finite(mut numbers: impl Iterator<Item = f64>) -> bool {
    numbers.all(f64::is_finite)
}

#[cfg(test)]
mod tests;
