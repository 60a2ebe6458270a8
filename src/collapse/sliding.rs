//! The least load at which an arch whose joints slide may fall.
//!
//! Where joints slide without dilating, many loads have a full solution: a mechanism, joint forces at their limits where it
//! moves, and admissible forces everywhere. A load path ends at one of them. From the mechanism in which it ends the least
//! is a linear programme (see [`crate::limit`]). At its optimum more joints are at their limits, so that other mechanisms can
//! move there, each with a programme of its own: mechanisms are exchanged until none is found that gives less. Where there are many
//! loops there are many more mechanisms; those are found from equilibria below the end, also from such in which rings are [`apart`] (see
//! [`shear`]).

mod apart;
mod cohesion;
mod groups;
mod hunt;
mod shear;

use super::mechanism::{Released, all_releases, columns, describe, motions, unknowns};
use super::rigid_parts::RigidParts;
use super::smallest_motion::nearest_motion;
use super::tolerances;
use super::{Analysis, Mechanism};
use crate::budget::Budget;
use crate::limit::{Equilibrium, Resultant, SoilEnd, StaticTheorem};
use crate::structure::{PassiveElement, PointForce};
use hunt::{Candidate, Hunt};

/// Share of a joint's force below which a corner's is none, in forces that a linear programme gives.
const AT_LIMIT: f64 = 1e-9;
/// The same at corners that an interior point method gives. What is let go there too much costs nothing but a vain try: each
/// mechanism has its own programme, in which it is at its limits exactly.
const NEAR_LIMIT: f64 = 1e-6;
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
    /// The least full solution found, from joints that are at their limits together, in any of several states, and from equilibria
    /// below load factor `end`, that of a mechanism; and how many mechanisms were tried. None where no motion of theirs has admissible
    /// forces.
    pub(super) fn least(&self, at_limits: &[Vec<Released>], end: f64) -> (Option<FullSolution>, usize) {
        let mut hunt = Hunt::new(self);
        hunt.try_each(at_limits);
        if self.theorem.has_loops() {
            hunt.give_shear(end);
            hunt.round_corners();
        } else {
            hunt.wander();
            if !self.is_ring() {
                hunt.give_shear(end);
            }
        }
        self.found(hunt)
    }

    /// The least of the mechanisms of these joints alone.
    pub(super) fn least_of(&self, at_limits: &[Vec<Released>]) -> (Option<FullSolution>, usize) {
        let mut hunt = Hunt::new(self);
        hunt.try_each(at_limits);
        self.found(hunt)
    }

    fn found(&self, hunt: Hunt) -> (Option<FullSolution>, usize) {
        let tried = hunt.tried();
        let solution = hunt.best.map(|Candidate { equilibrium, moving, rates, .. }| FullSolution {
            load_factor: equilibrium.load_factor,
            forces: self.theorem.resultants(&equilibrium),
            soil: self.theorem.soil(&equilibrium),
            mechanism: describe(&self.analysis.structure, self.theorem.loops(), &moving, &rates)
                .under(&self.analysis.scaled, &self.analysis.structure),
        });
        (solution, tried)
    }

    /// Whether every body lies between two others, or ground.
    fn is_ring(&self) -> bool {
        self.analysis.structure.joints_of_bodies().iter().all(|joints| joints.len() == 2)
    }

    /// What is at its limits in an equilibrium at the end of the limit window.
    pub(super) fn at_window_end(&self, greatest: f64) -> Option<Vec<Released>> {
        let found = self.theorem.least(greatest, self.sign, self.budget);
        found.ok().flatten().filter(|_| greatest.is_finite()).map(|equilibrium| self.at_limits(&equilibrium))
    }

    /// One of the motions that these releases allow at such costs, and in which the scaled loads do work: those that move, at their
    /// rates.
    fn motion(&self, released: &[Released], costs: &[f64]) -> Option<(Vec<Released>, Vec<f64>)> {
        if !self.theorem.has_loops() {
            let rates = self.free.cheapest_motion(released, costs, self.sign, self.budget)?;
            return Some(hunt::moving(released, rates));
        }
        let parts = RigidParts::new(&self.analysis.structure, released)?;
        let theorem = StaticTheorem::new(&parts.structure, &[], &parts.loads(&self.analysis.scaled)).ok()?;
        let rates = theorem.cheapest_motion(&parts.released, &parts.of_parts(costs), self.sign, self.budget)?;
        Some(hunt::moving(released, parts.of_all(&rates, released.len())))
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
}
