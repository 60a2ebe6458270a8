//! The least load at which an arch whose joints slide may fall.
//!
//! Where joints slide without dilating, many loads have a full solution: a mechanism, joint forces at their limits where it
//! moves, and admissible forces everywhere. A load path ends at one of them. From the mechanism in which it ends the least
//! is a linear programme (see [`crate::limit`]). At its optimum more joints are at their limits, so that other mechanisms can
//! move there, each with a programme of its own: mechanisms are exchanged until none is found that gives less.

use super::discretise::Scatter;
use super::mechanism::{Released, all_releases, describe};
use super::pulse::Pulse;
use super::{Analysis, Mechanism};
use crate::limit::{Equilibrium, Release, Resultant, StaticTheorem};
use crate::structure::Face;
use std::collections::BTreeSet;

/// So many motions in turn that give nothing lower end the search.
const QUIET: usize = 25;
/// Loads that differ by less than this share are the same.
pub(super) const SAME: f64 = 1e-9;
/// Share of a joint's force below which a corner's is none, in forces that a linear programme gives.
const AT_LIMIT: f64 = 1e-9;

/// What the search starts from, and which way.
pub(super) struct Search<'a> {
    pub analysis: &'a Analysis,
    pub theorem: &'a StaticTheorem,
    pub pulse: &'a Pulse<'a>,
    /// Load factor from which the path goes, and +1 or -1 for its direction.
    pub start: f64,
    pub sign: f64,
}

/// A full solution without dilation.
pub(super) struct FullSolution {
    pub load_factor: f64,
    pub forces: Vec<Resultant>,
    pub mechanism: Mechanism,
}

impl Search<'_> {
    /// The least full solution found from joints that are at their limits together, in any of several states; and how many
    /// mechanisms were tried. None where no motion of theirs has admissible forces.
    pub(super) fn least(&self, at_limits: &[Vec<Released>]) -> (Option<FullSolution>, usize) {
        let mut seen = BTreeSet::new();
        let mut best: Option<(Equilibrium, Vec<Released>, Vec<f64>)> = None;
        let mut costs = Scatter::new(0x51DE);
        for released in at_limits {
            let mut released = released.clone();
            let mut quiet = 0;
            while quiet < QUIET {
                quiet += 1;
                let Some((moving, rates)) = self.motion(&released, &mut costs) else { break };
                if !seen.insert(key(&moving)) {
                    continue;
                }
                let Ok(Some(found)) = self.theorem.least_load(&moving, self.start, self.sign, &|| self.pulse.beat())
                else {
                    continue;
                };
                if best.as_ref().is_none_or(|(least, ..)| self.is_beyond(least.load_factor, found.load_factor, SAME)) {
                    quiet = 0;
                    released = self.at_limits(&found);
                    best = Some((found, moving, rates));
                }
            }
        }
        let solution = best.map(|(equilibrium, moving, rates)| FullSolution {
            load_factor: equilibrium.load_factor,
            forces: self.theorem.resultants(&equilibrium),
            mechanism: describe(&self.analysis.structure, self.theorem.loops(), &moving, &rates),
        });
        (solution, seen.len())
    }

    /// What is at its limits in an equilibrium at the end of the limit window.
    pub(super) fn at_window_end(&self, greatest: f64) -> Option<Vec<Released>> {
        let found = self.theorem.least_load(&[], greatest, self.sign, &|| self.pulse.beat());
        found.ok().flatten().filter(|_| greatest.is_finite()).map(|equilibrium| self.at_limits(&equilibrium))
    }

    /// One of the motions that these releases allow, and in which the scaled loads do work: those that move, at their rates.
    fn motion(&self, released: &[Released], costs: &mut Scatter) -> Option<(Vec<Released>, Vec<f64>)> {
        let costs: Vec<f64> = released.iter().map(|_| 1.0 + 0.99 * costs.next()).collect();
        let rates = self.theorem.cheapest_motion(released, &costs, self.sign, &|| self.pulse.beat())?;
        Some(released.iter().zip(rates).filter(|(_, rate)| *rate > 0.0).unzip())
    }

    fn at_limits(&self, equilibrium: &Equilibrium) -> Vec<Released> {
        let forces = self.theorem.resultants(equilibrium);
        all_releases(&self.analysis.structure, &forces, &vec![None; forces.len()], AT_LIMIT)
    }

    /// True where a load factor lies beyond another, seen from the start, by more than this share of it (or of that at which the
    /// scaled loads are as large as the fixed ones).
    pub(super) fn is_beyond(&self, load_factor: f64, other: f64, share: f64) -> bool {
        self.sign * (load_factor - other) > share * other.abs().max(self.theorem.load_factor_scale())
    }
}

/// A mechanism by the joints that it moves.
fn key(moving: &[Released]) -> Vec<(usize, u8)> {
    let of = |&(joint, release): &Released| {
        let kind = match release {
            Release::Rotation(Face::Intrados) => 0,
            Release::Rotation(Face::Extrados) => 1,
            Release::Sliding(sign) => 2 + u8::from(sign > 0.0),
        };
        (joint, kind)
    };
    moving.iter().map(of).collect()
}
