//! The least load at which an arch whose joints slide may fall.
//!
//! Where joints slide without dilating, many loads have a full solution: a mechanism, joint forces at their limits where it
//! moves, and admissible forces everywhere. A load path ends at one of them. From the mechanism in which it ends the least
//! is a linear programme (see [`crate::limit`]). At its optimum more joints are at their limits, so that other mechanisms can
//! move there, each with a programme of its own: mechanisms are exchanged until none is found that gives less. Where there are many
//! loops that is done from every state anew.

mod groups;

use super::mechanism::{Released, all_releases, columns, describe, motions, unknowns};
use super::rigid_parts::RigidParts;
use super::scatter::Scatter;
use super::smallest_motion::nearest_motion;
use super::tolerances;
use super::{Analysis, Mechanism};
use crate::budget::Budget;
use crate::limit::{Equilibrium, Release, Resultant, SoilEnd, StaticTheorem, releases};
use crate::structure::{Face, PassiveElement, PointForce, Structure};
use std::collections::BTreeSet;

/// So many motions in turn that give nothing lower end the search.
const QUIET: usize = 25;
/// Share of a joint's force below which a corner's is none, in forces that a linear programme gives.
const AT_LIMIT: f64 = 1e-9;

/// The same at corners that an interior point method gives. What is let go there too much costs nothing but a vain try: each
/// mechanism has its own programme, in which it is at its limits exactly.
const NEAR_LIMIT: f64 = 1e-6;
/// Random weights on the joint forces that lead to corners of the least equilibria, and, the larger ones, to others near.
const TILTS: [f64; 3] = [1e-1, 1e-2, 1e-3];
/// Random motions of every corner.
const MOTIONS: usize = 2;
/// Random costs that lie apart are between 1 and 10 to the power of minus twice this.
const DECADES: f64 = 2.0;
/// So many corners in turn that give nothing lower, and so many in all, end the search where there are many loops (chosen
/// on walls 2 and 6 of Ferris and Tin-Loi: with 14 seeds each 8 in turn found nothing more than 6).
const QUIET_CORNERS: usize = 6;
const MOST_CORNERS: usize = 48;

/// Random motions of what is at its limits where the search starts.
const STARTS: usize = 4;
/// The same of every group of bodies, and of all (measured on random structures of up to 7 blocks against all mechanisms: without
/// these motions 18 of 514 loads were too high, with them 5 of 392).
const EACH: usize = 4;
const EVERYTHING: usize = 50;
/// Of longer chains of bodies only the motions of joints at their limits are tried (measured: for arches that is enough).
const MOST_CHAINED: usize = 12;

/// A passive element that moves by less than this share of the fastest body is not run into, and not left behind.
const STILL: f64 = 1e-7;

/// Where there are many loops, a load that is lower by less than this share is not worth having.
const WORTH: f64 = 1e-6;

/// What the search starts from, and which way.
pub(super) struct Search<'a> {
    /// Without the passive elements of its structure: they hinder no motion, but press as it says.
    pub analysis: &'a Analysis,
    /// The passive elements.
    pub soil: &'a [PassiveElement],
    /// With them, and without.
    pub theorem: &'a StaticTheorem,
    pub free: &'a StaticTheorem,
    pub budget: &'a Budget<'a>,
    /// Load factor from which the path goes, and +1 or -1 for its direction.
    pub start: f64,
    pub sign: f64,
}

/// A full solution without dilation.
pub(super) struct FullSolution {
    pub load_factor: f64,
    pub forces: Vec<Resultant>,
    /// Forces of the passive elements, N/m.
    pub soil: Vec<f64>,
    pub mechanism: Mechanism,
}

impl Search<'_> {
    /// The least full solution found from joints that are at their limits together, in any of several states; and how many
    /// mechanisms were tried. None where no motion of theirs has admissible forces.
    pub(super) fn least(&self, at_limits: &[Vec<Released>]) -> (Option<FullSolution>, usize) {
        let mut hunt = Hunt { search: self, seen: BTreeSet::new(), best: None, scatter: Scatter::new(0x51DE) };
        if self.theorem.has_loops() {
            at_limits.iter().for_each(|released| hunt.descend(released));
            hunt.wander();
            hunt.round_corners();
        } else {
            at_limits.iter().for_each(|released| hunt.exchange(released));
            hunt.wander();
        }
        let solution = hunt.best.map(|Candidate { equilibrium, moving, rates, .. }| FullSolution {
            load_factor: equilibrium.load_factor,
            forces: self.theorem.resultants(&equilibrium),
            soil: self.theorem.soil(&equilibrium),
            mechanism: describe(&self.analysis.structure, self.theorem.loops(), &moving, &rates)
                .under(&self.analysis.scaled, &self.analysis.structure),
        });
        (solution, hunt.seen.len())
    }

    /// What is at its limits in an equilibrium at the end of the limit window.
    pub(super) fn at_window_end(&self, greatest: f64) -> Option<Vec<Released>> {
        let found = self.theorem.least_load(&[], &[], [greatest, self.far()], self.sign, &[], self.budget);
        found.ok().flatten().filter(|_| greatest.is_finite()).map(|equilibrium| self.at_limits(&equilibrium))
    }

    /// One of the motions that these releases allow at such costs, and in which the scaled loads do work: those that move, at their
    /// rates.
    fn motion(&self, released: &[Released], costs: &[f64]) -> Option<(Vec<Released>, Vec<f64>)> {
        if !self.theorem.has_loops() {
            let rates = self.free.cheapest_motion(released, costs, self.sign, self.budget)?;
            return Some(moving(released, rates));
        }
        let parts = RigidParts::new(&self.analysis.structure, released)?;
        let theorem = StaticTheorem::new(&parts.structure, &[], &parts.loads(&self.analysis.scaled)).ok()?;
        let rates = theorem.cheapest_motion(&parts.released, &parts.of_parts(costs), self.sign, self.budget)?;
        Some(moving(released, parts.of_all(&rates, released.len())))
    }

    fn at_limits(&self, equilibrium: &Equilibrium) -> Vec<Released> {
        let forces = self.theorem.resultants(equilibrium);
        let share = if self.theorem.has_loops() { NEAR_LIMIT } else { AT_LIMIT };
        all_releases(&self.analysis.structure, &forces, &vec![None; forces.len()], share)
    }

    /// At which ends of their ranges passive elements press where the joints move like this: those that are run into, and those
    /// that are left behind. Others may press as they can.
    fn pinned(&self, moving: &[Released], rates: &[f64]) -> Vec<(usize, SoilEnd)> {
        let structure = &self.analysis.structure;
        let motions = motions(structure, self.theorem.loops(), moving, rates);
        let fastest = motions.iter().zip(&structure.bodies).map(|(m, body)| m.at(body.region.centroid).norm());
        let still = STILL * fastest.fold(0.0, f64::max);
        let end = |(e, element): (usize, &PassiveElement)| match -element.way * motions[element.body].at(element.at).x {
            approach if approach > still => Some((e, SoilEnd::Most)),
            approach if approach < -still => Some((e, SoilEnd::Nothing)),
            _ => None,
        };
        self.soil.iter().enumerate().filter_map(end).collect()
    }

    /// The motion of these releases next to rough `rates` that closes to rounding; None where there is none.
    fn closed(&self, moving: &[Released], rates: &[f64]) -> Option<Vec<f64>> {
        let (structure, loops) = (&self.analysis.structure, self.theorem.loops());
        let driving: Vec<PointForce> =
            self.analysis.scaled.iter().map(|load| PointForce { force: load.force * self.sign, ..*load }).collect();
        nearest_motion(&columns(structure, loops, moving, &driving), unknowns(structure, loops), rates)
    }

    /// Beyond all load factors.
    fn far(&self) -> f64 {
        self.sign * f64::INFINITY
    }

    /// The load factor before which one is worth having that has `best` already.
    fn worth(&self, best: f64) -> f64 {
        let share = if self.theorem.has_loops() { WORTH } else { tolerances::SAME_LOAD };
        best - self.sign * share * best.abs().max(self.theorem.load_factor_scale())
    }

    /// True where a load factor lies beyond another, seen from the start, by more than this share of it (or of that at which the
    /// scaled loads are as large as the fixed ones).
    pub(super) fn is_beyond(&self, load_factor: f64, other: f64, share: f64) -> bool {
        self.sign * (load_factor - other) > share * other.abs().max(self.theorem.load_factor_scale())
    }
}

/// The mechanisms tried so far and the best of them.
struct Hunt<'s> {
    search: &'s Search<'s>,
    seen: BTreeSet<Vec<(usize, u8)>>,
    best: Option<Candidate>,
    scatter: Scatter,
}

/// The least equilibrium of a mechanism, and its rates.
struct Candidate {
    equilibrium: Equilibrium,
    moving: Vec<Released>,
    pinned: Vec<(usize, SoilEnd)>,
    rates: Vec<f64>,
}

/// What the motion of a joint costs, at random.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Costs {
    /// Much the same everywhere.
    Even,
    /// What costs much hardly moves, so that the motions differ.
    Apart,
}

/// What comes of a motion of some releases.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Tried {
    /// Its least load lies below all before.
    Lower,
    /// It does not; other motions may.
    InVain,
    /// It does not, and these releases have no other motion.
    Sole,
}

impl Hunt<'_> {
    /// Tries one of the motions of these releases; None where nothing moves.
    fn tries(&mut self, released: &[Released], costs: Costs) -> Option<Tried> {
        let search = self.search;
        let cost = |random: f64| match costs {
            Costs::Even => 1.0 + 0.99 * random,
            Costs::Apart => 10f64.powf(DECADES * (random - 1.0)),
        };
        let costs: Vec<f64> = released.iter().map(|_| cost(self.scatter.next())).collect();
        let (moving, mut rates) = search.motion(released, &costs)?;
        // What moves in a corner of all motions is independent of each other: where everything does, there is no other.
        let vain = if moving.len() == released.len() { Tried::Sole } else { Tried::InVain };
        if !self.seen.insert(key(&moving)) {
            return Some(vain);
        }
        let end = self.best.as_ref().map_or(search.far(), |best| search.worth(best.equilibrium.load_factor));
        let pinned = search.pinned(&moving, &rates);
        let found = search.theorem.least_load(&moving, &pinned, [search.start, end], search.sign, &[], search.budget);
        let Ok(Some(equilibrium)) = found else { return Some(vain) };
        if search.theorem.has_loops() {
            let Some(closed) = search.closed(&moving, &rates) else { return Some(vain) };
            rates = closed;
        }
        self.best = Some(Candidate { equilibrium, moving, pinned, rates });
        Some(Tried::Lower)
    }

    /// From one state on, whose programmes end in a corner of all equilibria.
    fn exchange(&mut self, released: &[Released]) {
        let (mut released, mut quiet) = (released.to_vec(), 0);
        while quiet < QUIET {
            quiet += 1;
            match self.tries(&released, Costs::Even) {
                None | Some(Tried::Sole) => return,
                Some(Tried::InVain) => {}
                Some(Tried::Lower) => {
                    quiet = 0;
                    released = self.best.as_ref().map_or(Vec::new(), |best| self.search.at_limits(&best.equilibrium));
                }
            }
        }
    }

    /// From one state on, as if nothing were known: corners round the best of its mechanisms may lead to less than those round a better
    /// one (measured on 40 walls of 6 to 40 stones: 2 have a lower load by that, by 0.5 and 1.3 %).
    fn descend(&mut self, released: &[Released]) {
        let (best, seen) = (self.best.take(), std::mem::take(&mut self.seen));
        // Rough rates may fail to close: those of other costs need not.
        _ = (0..STARTS).any(|_| self.tries(released, Costs::Apart) == Some(Tried::Lower));
        self.round_corners();
        let least = |found: &Candidate| self.search.sign * found.equilibrium.load_factor;
        self.best = best.into_iter().chain(self.best.take()).min_by(|a, b| least(a).total_cmp(&least(b)));
        self.seen.extend(seen);
    }

    /// From motions of few bodies that touch, and of all, whatever their joints carry: path and window end in few of the mechanisms
    /// that there are.
    fn wander(&mut self) {
        let structure = &self.search.analysis.structure;
        if !self.search.theorem.has_loops() && structure.joints.len() > MOST_CHAINED {
            return;
        }
        for joints in groups::joints_beside(structure) {
            if self.search.budget.ask().is_err() {
                return;
            }
            self.roam(&released_at(joints, structure), EACH);
        }
        self.roam(&released_at(0..structure.joints.len(), structure), EVERYTHING);
    }

    /// So many random motions of these releases; from each that is better, on.
    fn roam(&mut self, released: &[Released], times: usize) {
        for _ in 0..times {
            match self.tries(released, Costs::Apart) {
                Some(Tried::Lower) if !self.search.theorem.has_loops() => {
                    let next = self.best.as_ref().map_or(Vec::new(), |best| self.search.at_limits(&best.equilibrium));
                    self.exchange(&next);
                }
                Some(Tried::Lower | Tried::InVain) => {}
                None | Some(Tried::Sole) => return,
            }
        }
    }

    /// From random corners at and near the least equilibrium of the best mechanism.
    fn round_corners(&mut self) {
        let mut quiet = 0;
        for round in 0..MOST_CORNERS {
            let Some(best) = &self.best else { return };
            let (search, moving, pinned) = (self.search, best.moving.clone(), best.pinned.clone());
            let tilt = TILTS[round % TILTS.len()];
            let tilts: Vec<[f64; 3]> =
                (0..search.theorem.joints()).map(|_| [(); 3].map(|()| tilt * self.scatter.next())).collect();
            let range = [search.start, search.far()];
            let corner = search.theorem.least_load(&moving, &pinned, range, search.sign, &tilts, search.budget);
            let Ok(Some(corner)) = corner else { continue };
            let mut released = search.at_limits(&corner);
            let missing: Vec<Released> = moving.into_iter().filter(|release| !released.contains(release)).collect();
            released.extend(missing);
            let lower = (0..MOTIONS).any(|_| self.tries(&released, Costs::Apart) == Some(Tried::Lower));
            quiet = if lower { 0 } else { quiet + 1 };
            if quiet == QUIET_CORNERS || search.budget.ask().is_err() {
                return;
            }
        }
    }
}

/// All releases of some joints.
fn released_at(joints: impl IntoIterator<Item = usize>, structure: &Structure) -> Vec<Released> {
    let of = |k: usize| {
        releases(&structure.joints[k], &Resultant::default(), f64::INFINITY).into_iter().map(move |r| (k, r))
    };
    joints.into_iter().flat_map(of).collect()
}

/// The releases that move, and their rates.
fn moving(released: &[Released], rates: Vec<f64>) -> (Vec<Released>, Vec<f64>) {
    released.iter().zip(rates).filter(|(_, rate)| *rate > 0.0).unzip()
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
