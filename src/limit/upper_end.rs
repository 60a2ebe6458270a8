//! The upper end of the limit window alone, for who looks at many loads.

use super::programme::{Objective, Programme, ProgrammeOutcome};
use super::{StaticTheorem, Unsolved, WindowBases};
use crate::budget::Budget;

/// The highest load factor in equilibrium, infinite where unbounded and minus infinite where nothing is in equilibrium; and a motion
/// of all bodies (see [`super::WindowEnd`]) that proves it, where it has an end.
pub type UpperEnd = (f64, Option<Vec<[f64; 3]>>);

impl StaticTheorem {
    /// That of stone that does not crush.
    ///
    /// # Errors
    /// When rounding, or `budget`, kept the linear programme from an answer.
    pub fn upper_end(&self, budget: &Budget) -> Result<UpperEnd, Unsolved> {
        match Programme::new(self).maximise(&Objective::load_factor(1.0), budget) {
            ProgrammeOutcome::At(at, dual) => Ok((at.load_factor, Some(self.motion(&dual, &[])))),
            ProgrammeOutcome::Unbounded(_) => Ok((f64::INFINITY, None)),
            ProgrammeOutcome::Infeasible(_) => Ok((f64::NEG_INFINITY, None)),
            ProgrammeOutcome::Lost => Err(Unsolved),
        }
    }

    /// That of joints of the compressive strength `strengths[joint]`, Pa.
    ///
    /// # Errors
    /// As [`StaticTheorem::crushing_window`].
    pub fn crushing_upper_end(&self, strengths: &[f64], budget: &Budget) -> Result<UpperEnd, Unsolved> {
        let Some(window) = self.crushing_ends(strengths, [false, true], &WindowBases::default(), budget)? else {
            return Ok((f64::NEG_INFINITY, None));
        };
        let [_, motion] = window.motions;
        Ok((window.ends[1], Some(motion).filter(|motion| !motion.is_empty())))
    }
}
