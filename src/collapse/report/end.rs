//! What the structure bears ends at: one governing load factor an end, with the state that belongs to it.

use super::{CollapseReport, FallingMotion, Outcome, PathEnd};
use crate::collapse::{Direction, tolerances};

/// Crushing this close to falling does not govern, as a share of the load factor.
const SAME: f64 = tolerances::SAME_FAILURE;

/// Which end of the load factors that the structure bears.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "server", derive(serde::Serialize, utoipa::ToSchema))]
#[cfg_attr(feature = "server", serde(rename_all = "snake_case"))]
pub enum WhichEnd {
    /// The lowest load factor.
    Lowest,
    /// The highest load factor.
    Highest,
}

/// What an end is governed by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "server", derive(serde::Serialize, utoipa::ToSchema))]
#[cfg_attr(feature = "server", serde(rename_all = "snake_case"))]
pub enum GovernedBy {
    /// A mechanism of rigid stones.
    Instability,
    /// Such a mechanism in which joints slide: the least load of its range counts, where there is one.
    Sliding,
    /// A mechanism in which joints crush, at a lower load than stone bears that does not crush.
    Crushing,
}

/// One end.
#[derive(Debug, Clone, Copy)]
pub struct End<'r> {
    /// Which one.
    pub which: WhichEnd,
    /// What governs.
    pub governed_by: GovernedBy,
    /// The state that governs.
    pub state: &'r PathEnd,
    /// The end of the load path of stone that does not crush; none where it has none in reach, and where crushing is in the path.
    pub uncrushed: Option<&'r PathEnd>,
    /// Load factor with joints of the stone's strength, by limit analysis or by the load path, where that ends first; none where it was
    /// not computed or has no end.
    pub crushing: Option<f64>,
    /// How the structure moves on from `uncrushed`, where asked.
    pub motion: Option<&'r FallingMotion>,
}

impl CollapseReport {
    /// The ends that were found, that of the asked direction first; the other one only of an arch that stands in a window.
    pub fn ends(&self) -> Vec<End<'_>> {
        let both = [(&self.end, &self.motion), (&self.other_end, &self.other_motion)];
        let sides = if self.direction == Direction::Increase { [1, 0] } else { [0, 1] };
        let asked = if self.outcome == Outcome::StandsInWindow { 2 } else { 1 };
        both.into_iter()
            .zip(sides)
            .take(asked)
            .filter_map(|((end, motion), side)| self.end_of(side, end.as_ref(), motion.as_ref()))
            .collect()
    }

    /// The lowest (0) or the highest end (1) from what this path came to.
    fn end_of<'r>(
        &'r self,
        side: usize,
        path: Option<&'r PathEnd>,
        motion: Option<&'r FallingMotion>,
    ) -> Option<End<'r>> {
        let which = [WhichEnd::Lowest, WhichEnd::Highest][side];
        let (in_path, sign) = (path.is_some_and(|path| !path.crushed.is_empty()), [-1.0, 1.0][side]);
        let stands = match self.outcome {
            Outcome::Collapse | Outcome::StandsInWindow | Outcome::Stands | Outcome::CannotTell => true,
            Outcome::Crushes => self.safety().is_some(),
            _ => false,
        };
        let plastic = self.crushing.plastic_section.as_ref().filter(|_| stands);
        let at = plastic.and_then(|plastic| plastic.window).map(|window| [window.lowest, window.highest][side]);
        let followed = self.crushing.on_path[side].as_ref();
        let crushing = match followed.or(path.filter(|_| in_path)) {
            Some(followed) => Some(followed.load_factor),
            None => at.filter(|at| at.is_finite()),
        };
        let first = |state: &&PathEnd| {
            let before = |path: &PathEnd| sign * (path.load_factor - state.load_factor) > SAME * path.load_factor.abs();
            self.outcome != Outcome::CannotTell && path.map_or(state.load_factor.abs() <= self.cap, before)
        };
        let crushes = followed.or(plastic.and_then(|plastic| plastic.ends[side].as_ref())).filter(first);
        let (governed_by, state) = match (crushes, path) {
            (Some(state), _) => (GovernedBy::Crushing, state),
            (None, Some(path)) if in_path => (GovernedBy::Crushing, path),
            (None, Some(path)) if path.range.is_some() || path.mechanism.slips() => (GovernedBy::Sliding, path),
            (None, path) => (GovernedBy::Instability, path?),
        };
        Some(End { which, governed_by, state, uncrushed: path.filter(|_| !in_path), crushing, motion })
    }
}
