//! Geometric safety: how close to the middles of its joints a structure can carry its loads.

use super::programme::{Objective, Programme, ProgrammeOutcome};
use super::static_theorem::Limit;
use super::{Resultant, StaticTheorem, Unsolved};
use crate::budget::Budget;

/// The least share is known to this much of it.
const SHARE_KNOWN: f64 = 1e-9;
/// Where rounding keeps programmes next to the least share from an answer it may be known to this much only.
const SHARE_PUT_UP_WITH: f64 = 1e-6;
/// By so much, in units of the loads, forces may violate a limit.
const VIOLATED: f64 = 1e-8;

/// The least share of their lengths to which joints can be shortened about their middles.
#[derive(Debug, Clone, PartialEq)]
pub struct ShortenedJoints {
    /// The share; `least` where it stands at that too.
    pub share: f64,
    /// Forces of every joint in equilibrium at this share.
    pub forces: Vec<Resultant>,
}

impl StaticTheorem {
    /// Forces of every joint in equilibrium at load factor `at`; none where nothing stands.
    ///
    /// # Errors
    /// When rounding, or `budget`, kept the linear programme from an answer.
    pub fn forces_at(&self, at: f64, budget: &Budget) -> Result<Option<Vec<Resultant>>, Unsolved> {
        self.on_shortened(at, 1.0, budget)
    }

    /// The least share s, not below `least`, of their lengths to which all joints that can open may be shortened about their
    /// middles, so that `|M| <= s N length / 2`, while there is equilibrium at load factor `at`. Friction and cohesion stay those of
    /// the whole joints. None where nothing stands at s = 1.
    ///
    /// What stands at a share stands at every larger one with the same forces, so halving finds it.
    ///
    /// # Errors
    /// When rounding, or `budget`, kept the linear programmes from an answer.
    pub fn shortened_joints(&self, at: f64, least: f64, budget: &Budget) -> Result<Option<ShortenedJoints>, Unsolved> {
        let Some(forces) = self.forces_at(at, budget)? else { return Ok(None) };
        let mut stands = ShortenedJoints { share: 1.0, forces };
        let (mut below, mut falls, mut share) = (0.0, 0.0, least);
        while stands.share - below > SHARE_KNOWN * stands.share {
            match self.on_shortened(at, share, budget) {
                Ok(Some(forces)) => stands = ShortenedJoints { share, forces },
                Ok(None) => (below, falls) = (share, share),
                // Next to joints of no length at all, and next to the least share, rounding may decide.
                Err(Unsolved) => below = share,
            }
            if stands.share <= least {
                return Ok(Some(stands));
            }
            share = 0.5 * (stands.share + below);
        }
        if stands.share - falls <= SHARE_PUT_UP_WITH * stands.share { Ok(Some(stands)) } else { Err(Unsolved) }
    }

    /// Forces in equilibrium at load factor `at` on joints of this share of their lengths; none where there are none.
    fn on_shortened(&self, at: f64, share: f64, budget: &Budget) -> Result<Option<Vec<Resultant>>, Unsolved> {
        let mut programme = Programme::new(self);
        programme.bounds = [at; 2];
        if share < 1.0 {
            programme.limits = (0..self.joints()).flat_map(|k| self.within(k, share)).collect();
        }
        let objective = Objective::load_factor(0.0);
        match self.admissible(&programme, programme.maximise(&objective, budget)) {
            // The exact method may end far out, where forces without bound leave nothing of the loads.
            Err(Unsolved) if self.has_few_unknowns() => {
                self.admissible(&programme, programme.maximise_sparsely(&objective, budget))
            }
            found => found,
        }
    }

    /// Forces that violate no limit; none where there are none.
    fn admissible(&self, programme: &Programme, found: ProgrammeOutcome) -> Result<Option<Vec<Resultant>>, Unsolved> {
        match found {
            ProgrammeOutcome::At(equilibrium, _) => {
                let slack = |limit: &Limit| limit.slack(&equilibrium.forces);
                let least = self.limits.iter().chain(&programme.limits).map(slack).fold(f64::INFINITY, f64::min);
                if least > -VIOLATED { Ok(Some(self.resultants(&equilibrium))) } else { Err(Unsolved) }
            }
            ProgrammeOutcome::Infeasible(_) => Ok(None),
            ProgrammeOutcome::Unbounded(_) | ProgrammeOutcome::Lost => Err(Unsolved),
        }
    }

    /// The resultant of joint `k` passes within this share of its length about its middle; a joint that cannot open has no limit.
    fn within(&self, k: usize, share: f64) -> impl Iterator<Item = Limit> {
        let opens = self.joint(k).law.coulomb().is_some();
        // N = intrados + extrados, M = (extrados - intrados) length / 2.
        let weights = [[share + 1.0, share - 1.0, 0.0], [share - 1.0, share + 1.0, 0.0]];
        weights.into_iter().filter(move |_| opens).map(move |weights| self.limit(k, weights, 0.0))
    }
}

#[cfg(test)]
mod tests;
