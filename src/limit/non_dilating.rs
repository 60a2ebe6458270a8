//! Mechanisms of sliding joints that do not dilate, and the loads at which their forces are admissible.
//!
//! Limit analysis lets a sliding joint open as it slides (associated friction); masonry does not. Without dilation a
//! mechanism is a full solution wherever the joints that move are at their limits and all others are admissible: no force at
//! the end that opens, shear at its bound against the motion. These are linear conditions on the unknowns of the static
//! theorem, and what they leave open is a whole range of load factors. Its least value is a linear programme.

use super::linear_program::Basis;
use super::passive::SoilEnd;
use super::programme::{Objective, Programme, ProgrammeOutcome};
use super::resultant::Resultant;
use super::static_theorem::{Equilibrium, Limit, StaticTheorem, Unsolved};
use crate::budget::Budget;
use crate::structure::{Face, Joint, JointLaw};

/// Rates below this share of the fastest are none.
const MOVES: f64 = 1e-9;
/// Error of the programme of motions of many loops that is put up with: joints that do not move carry any force, which costs the
/// interior point method its last digits, while the rates tell long before which joints move.
const ROUGH: [f64; 2] = [1e-6, 1e-2];
/// The same of a corner of many loops, of which only what is at its limits counts.
const CORNER: [f64; 2] = [1e-9, 1e-7];
/// A motion may close gaps at so many times the largest cost, and so not at all where there is any other.
const CLOSING: f64 = 1e4;
/// Rates of such a motion below this share of the fastest are none.
const MOVES_ROUGHLY: f64 = 1e-7;

/// A relative motion that a joint at its limit allows, of unit rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Release {
    /// Rotation about the end on this face, which opens the other.
    Rotation(Face),
    /// Sliding of the stone after the joint, +1 towards the extrados, -1 towards the intrados.
    Sliding(f64),
}

/// What a joint that carries `forces` lets happen; a corner's force up to `none`, N/m, is none, and shear as near to its capacity
/// is at it. A joint that may open may have lost its cohesion.
pub fn releases(joint: &Joint, forces: &Resultant, none: f64) -> Vec<Release> {
    let (friction, cohesion) = match joint.law {
        JointLaw::Dry { friction, cohesion } => (friction, cohesion),
        JointLaw::Wall => (0.0, 0.0),
        JointLaw::Mirror => return vec![Release::Sliding(1.0), Release::Sliding(-1.0)],
        JointLaw::Bonded => return Vec::new(),
    };
    let corners = [(Face::Intrados, forces.extrados), (Face::Extrados, forces.intrados)];
    let open = corners.into_iter().filter(|(_, force)| *force <= none);
    let rotations: Vec<Release> = open.map(|(face, _)| Release::Rotation(face)).collect();
    let adhesion = if rotations.is_empty() { cohesion * joint.length() } else { 0.0 };
    let capacity = friction * forces.normal() + adhesion;
    // The shear on the stone after the joint opposes its sliding.
    let slides = [1.0, -1.0].into_iter().filter(|sign| capacity + sign * forces.shear <= none).map(Release::Sliding);
    rotations.into_iter().chain(slides).collect()
}

/// Joints that move, and passive elements, by the limits that they are at.
pub type AtLimits<'m> = (&'m [(usize, Release)], &'m [(usize, SoilEnd)]);

/// The least loads of mechanisms of one structure, of which many are tried.
#[derive(Debug)]
pub struct LeastLoads<'t> {
    theorem: &'t StaticTheorem,
    /// Load factor from which loads grow, and +1 or -1 for their direction.
    start: f64,
    sign: f64,
    /// Where the least load of all equilibria is, whatever moves: the simplex method goes on from there for every mechanism.
    basis: Option<Basis>,
}

impl LeastLoads<'_> {
    /// The equilibrium of the smallest load factor, in the direction of the loads, with these joints and passive elements at their
    /// limits and every other admissible; None where there is none between the start and `end`.
    ///
    /// An end that opens carries nothing. How much of its cohesion a joint that opens has left depends on where along it the
    /// cohesion sits, so where it slides too, anything from none to all is admitted.
    ///
    /// # Errors
    /// When rounding, or `budget`, kept the linear programme from an answer.
    pub fn of(&self, at_limits: AtLimits, end: f64, budget: &Budget) -> Result<Option<Equilibrium>, Unsolved> {
        let mut programme = self.theorem.grown_from(self.start, self.sign);
        programme.limits = self.theorem.at_limits(at_limits);
        programme.cutoff = -self.sign * end / self.theorem.factor;
        let objective = Objective::load_factor(-self.sign);
        let found = programme.maximise_from(&mut self.basis.clone(), &objective, budget).equilibrium()?;
        Ok(found.filter(|equilibrium| self.sign * (equilibrium.load_factor - end) < 0.0))
    }
}

impl StaticTheorem {
    /// The least loads of mechanisms from load factor `start` on, in the direction of `sign`.
    pub fn least_loads(&self, start: f64, sign: f64, budget: &Budget) -> LeastLoads<'_> {
        let mut basis = None;
        if self.has_few_unknowns() {
            self.grown_from(start, sign).maximise_from(&mut basis, &Objective::load_factor(-sign), budget);
        }
        LeastLoads { theorem: self, start, sign, basis }
    }

    /// The equilibrium of the smallest load factor from `start` on, in the direction of `sign`, whatever moves; None where there is none.
    ///
    /// # Errors
    /// When rounding, or `budget`, kept the linear programme from an answer.
    pub fn least(&self, start: f64, sign: f64, budget: &Budget) -> Result<Option<Equilibrium>, Unsolved> {
        self.grown_from(start, sign).maximise(&Objective::load_factor(-sign), budget).equilibrium()
    }

    /// A corner of the equilibria near the smallest load factor from `start` on, in the direction of `sign`, with joints and passive
    /// elements at their limits as for [`LeastLoads::of`]; None where there is none.
    ///
    /// Many equilibria may share the smallest load factor; an interior point method ends in their middle, where as few joints as may be
    /// are at their limits. Slight random `tilts` lead to one of their corners, where as many as may be are: weights on the intrados
    /// force, the extrados force and the shear of every joint, of which 1 counts for all loads as much as the load factor for its
    /// scale. Such an equilibrium is rough.
    ///
    /// `basis`: where a corner was found with the same tilts, and the same limits but for their constants, and then where this one is.
    ///
    /// # Errors
    /// When rounding, or `budget`, kept the linear programme from an answer.
    pub fn corner(
        &self,
        at_limits: AtLimits,
        [start, sign]: [f64; 2],
        tilts: &[[f64; 3]],
        basis: &mut Option<Basis>,
        budget: &Budget,
    ) -> Result<Option<Equilibrium>, Unsolved> {
        let mut programme = self.grown_from(start, sign);
        programme.limits = self.at_limits(at_limits);
        programme.errors = CORNER;
        let objective = Objective { load_factor: -sign, forces: tilts.iter().copied().enumerate().collect() };
        if !self.has_few_unknowns() {
            // A corner that this method does not reach takes the other one up to a second: there are more of them.
            return programme.maximise_sparsely(&objective, budget).equilibrium();
        }
        programme.maximise_from(basis, &objective, budget).equilibrium()
    }

    /// All admissible equilibria from load factor `start` on.
    fn grown_from(&self, start: f64, sign: f64) -> Programme<'_> {
        let mut programme = Programme::new(self);
        programme.bounds[if sign > 0.0 { 0 } else { 1 }] = start;
        programme
    }

    /// What holds where these joints and passive elements are at their limits.
    fn at_limits(&self, (moving, pinned): AtLimits) -> Vec<Limit> {
        let of_joint = |&(joint, release): &(usize, Release)| {
            let turns =
                |&(other, release): &(usize, Release)| other == joint && matches!(release, Release::Rotation(_));
            self.at_limit(joint, release, moving.iter().any(turns))
        };
        let pinned = pinned.iter().map(|&(element, end)| self.pin(element, end));
        pinned.chain(moving.iter().filter_map(of_joint)).collect()
    }

    /// What `joint` at the limit of `release` is held to; `turns`: some end of it opens.
    fn at_limit(&self, joint: usize, release: Release, turns: bool) -> Option<Limit> {
        let (friction, cohesion) = match self.joints[joint].law {
            JointLaw::Dry { friction, cohesion } => (friction, cohesion),
            JointLaw::Wall => (0.0, 0.0),
            JointLaw::Mirror | JointLaw::Bonded => return None,
        };
        // That none of them is negative is among the limits already.
        Some(match release {
            Release::Rotation(Face::Intrados) => self.limit(joint, [0.0, -1.0, 0.0], 0.0),
            Release::Rotation(Face::Extrados) => self.limit(joint, [-1.0, 0.0, 0.0], 0.0),
            // Capacity left when the stone after the joint slides the way of `sign`, which the shear opposes.
            Release::Sliding(sign) => {
                let adhesion = if turns { 0.0 } else { cohesion * self.joints[joint].length() };
                self.limit(joint, [-friction, -friction, -sign], -adhesion)
            }
        })
    }

    /// Rates x >= 0 of least cost, the costs being positive, at which these `releases` move every body without a gap elsewhere
    /// and the scaled loads, in the direction of `sign`, do work: a corner of all such motions, with at most as many rates that
    /// are not zero as there are unknowns. None where there is no motion, or `budget` broke.
    ///
    /// Rates of a structure of many unknowns are rough: they tell which joints move, and roughly how.
    ///
    /// The dual asks for the largest load whose forces do no more work in any release than it costs, the joints carrying
    /// whatever else they may: a programme over the forces again, whose multipliers are the rates.
    pub fn cheapest_motion(
        &self,
        releases: &[(usize, Release)],
        costs: &[f64],
        sign: f64,
        budget: &Budget,
    ) -> Option<Vec<f64>> {
        let (programme, objective) = (self.motion_programme(releases, costs), Objective::load_factor(sign));
        let found = match self.has_loops() {
            true => programme.maximise_sparsely(&objective, budget),
            false => programme.maximise_densely(&objective, budget),
        };
        let ProgrammeOutcome::At(_, dual) = found else { return None };
        let (rates, closing) = dual.multipliers.split_at(releases.len());
        let fastest = rates.iter().copied().fold(0.0, f64::max);
        if closing.iter().any(|rate| *rate > MOVES_ROUGHLY * fastest) {
            return None;
        }
        let moves = if self.has_loops() { MOVES_ROUGHLY } else { MOVES };
        Some(rates.iter().map(|&rate| if rate > moves * fastest { rate } else { 0.0 }).collect())
    }

    /// Forces under the scaled loads that do no more work in any release than it costs.
    pub(super) fn motion_programme(&self, releases: &[(usize, Release)], costs: &[f64]) -> Programme<'_> {
        let mut programme = Programme::unlimited(self);
        let bound = |(&(joint, release), &cost): (&(usize, Release), &f64)| self.work_bound(joint, release, cost);
        programme.limits = releases.iter().zip(costs).map(bound).collect();
        programme.limits.extend(self.closings(releases, costs));
        programme.errors = ROUGH;
        programme
    }

    /// Forces of a joint that do no more work in a release than it costs.
    fn work_bound(&self, joint: usize, release: Release, cost: f64) -> Limit {
        let length = self.joints[joint].length();
        let work = match release {
            Release::Rotation(Face::Intrados) => [0.0, length, 0.0],
            Release::Rotation(Face::Extrados) => [length, 0.0, 0.0],
            Release::Sliding(sign) => [0.0, 0.0, sign],
        };
        Limit { joint, weights: work.map(|w| w / self.force), constant: cost }
    }

    /// Bounds of all other forces, which keep the programme well posed: motions in all other ways, at a cost that only those pay
    /// that cannot move otherwise.
    fn closings(&self, releases: &[(usize, Release)], costs: &[f64]) -> Vec<Limit> {
        if !self.has_loops() {
            return Vec::new();
        }
        let cost = CLOSING * costs.iter().copied().fold(0.0, f64::max);
        let mut released = vec![Vec::new(); self.joints.len()];
        releases.iter().for_each(|&(joint, release)| released[joint].push(release));
        let of_joint = |(joint, released): (usize, &Vec<Release>)| {
            let rotations = [Face::Intrados, Face::Extrados].map(Release::Rotation).map(|release| (release, -1.0));
            let both = [rotations, rotations.map(|(release, _)| (release, 1.0))].concat();
            let slides = [1.0, -1.0].map(|sign| (Release::Sliding(sign), 1.0));
            let others =
                both.into_iter().chain(slides).filter(|(release, way)| *way < 0.0 || !released.contains(release));
            let bound = |(release, way)| {
                let limit = self.work_bound(joint, release, cost);
                Limit { weights: limit.weights.map(|w| way * w), ..limit }
            };
            others.map(bound).collect::<Vec<_>>()
        };
        released.iter().enumerate().flat_map(of_joint).collect()
    }
}

#[cfg(test)]
mod tests;
