//! Joints that take a given shear, however hard they are pressed.
//!
//! Their slides do not dilate, and limit analysis finds the mechanism in which such joints give way. Where the forces that go with it
//! press the joints so that friction is the shear that was given, it is a mechanism of joints with friction, too; what friction is
//! under those forces can be given in a next step (Gilbert, Casapulla and Ahmed, Computers and Structures 84 (2006) 873-887).

use super::linear_program::Basis;
use super::non_dilating::Release;
use super::programme::{Dual, Objective, Programme, ProgrammeOutcome, Rows};
use super::static_theorem::{Equilibrium, Limit, StaticTheorem};
use super::{Resultant, Unsolved};
use crate::budget::Budget;
use crate::structure::{Face, JointLaw};

/// Errors of the interior point method that are asked for and put up with: it is only told what moves.
const ERRORS: [f64; 2] = [1e-10, 1e-6];
/// Rates below this share of the fastest are none: those of the simplex method, and those of the other.
const MOVES: [f64; 2] = [1e-9, 1e-5];

/// A mechanism without dilation.
#[derive(Debug, Clone, PartialEq)]
pub struct GivesWay {
    /// At which load factor.
    pub load_factor: f64,
    /// What moves, and at which rates, in proportion.
    pub moving: Vec<(usize, Release)>,
    /// Rates of those.
    pub rates: Vec<f64>,
}

impl StaticTheorem {
    /// The theorem of the same structure, whose dry joints take the shear that friction and cohesion give them under these `forces`.
    ///
    /// `slack` lets each of a joint's limits (intrados force, extrados force, shear) be violated by so much, as a share of the fixed
    /// loads: of motions that cost the same, random slack chooses one.
    pub fn with_shear_under(&self, forces: &[Resultant], slack: &[[f64; 3]]) -> StaticTheorem {
        let mut given = self.clone();
        for (joint, forces) in given.joints.iter_mut().zip(forces) {
            if let JointLaw::Dry { friction, cohesion } = joint.law {
                let rubs = friction * forces.normal().max(0.0);
                joint.law = JointLaw::Dry { friction: 0.0, cohesion: cohesion + rubs / joint.length() };
            }
        }
        given.limits = given.all_limits();
        for limit in given.limits.iter_mut().filter(|limit| limit.joint < self.joints.len()) {
            let violated: f64 =
                limit.weights.iter().zip(slack[limit.joint]).map(|(weight, by)| weight.abs() * by).sum();
            limit.constant += self.force * violated;
        }
        given.rows = self.rows.as_ref().map(|_| Rows::of_laws(&given));
        given
    }

    /// The equilibrium under the largest loads in the direction of `sign`; None where nothing bounds them, or there is none.
    ///
    /// # Errors
    /// When rounding, or `budget`, kept the linear programme from an answer.
    pub fn at_end(&self, sign: f64, budget: &Budget) -> Result<Option<Equilibrium>, Unsolved> {
        self.end(sign, &mut None, budget).map(|end| end.map(|(equilibrium, _)| equilibrium))
    }

    fn end(
        &self,
        sign: f64,
        basis: &mut Option<Basis>,
        budget: &Budget,
    ) -> Result<Option<(Equilibrium, Dual)>, Unsolved> {
        let programme = Programme { errors: ERRORS, ..Programme::new(self) };
        match programme.maximise_from(basis, &Objective::load_factor(sign), budget) {
            ProgrammeOutcome::At(equilibrium, dual) => Ok(Some((equilibrium, dual))),
            ProgrammeOutcome::Infeasible(_) | ProgrammeOutcome::Unbounded(_) => Ok(None),
            ProgrammeOutcome::Lost => Err(Unsolved),
        }
    }

    /// The mechanism in which joints without friction give way as the loads grow in the direction of `sign`; None where they do not
    /// stand, or never give way. `basis`: where joints of the same structure gave way under other shears, and then where these do; to
    /// go on from there saves time and no more.
    ///
    /// # Errors
    /// When rounding, or `budget`, kept the linear programme from an answer.
    pub fn gives_way(
        &self,
        sign: f64,
        basis: &mut Option<Basis>,
        budget: &Budget,
    ) -> Result<Option<GivesWay>, Unsolved> {
        let Some((equilibrium, dual)) = self.end(sign, basis, budget)? else { return Ok(None) };
        let (moving, rates) = self.moving(&dual.multipliers);
        Ok(Some(GivesWay { load_factor: equilibrium.load_factor, moving, rates }))
    }

    /// What moves, and its rates, from multipliers of the limits of joints without friction, each of which bounds one force alone.
    fn moving(&self, multipliers: &[f64]) -> (Vec<(usize, Release)>, Vec<f64>) {
        // How fast the ends of every joint part, and its faces slide.
        let mut speeds = vec![[0.0; 3]; self.joints.len()];
        let of_joints = |(limit, _): &(&Limit, &f64)| limit.joint < self.joints.len();
        for (limit, y) in self.limits.iter().zip(multipliers).filter(of_joints) {
            (0..3).for_each(|i| speeds[limit.joint][i] += limit.weights[i] * self.force * y);
        }
        let moves = if self.has_few_unknowns() { MOVES[0] } else { MOVES[1] };
        let none = moves * speeds.as_flattened().iter().fold(0.0, |fastest: f64, speed| fastest.max(speed.abs()));
        let of_joint = |(k, [intrados, extrados, slide]): (usize, &[f64; 3])| {
            let length = self.joints[k].length();
            let released = [
                (*intrados, Release::Rotation(Face::Extrados), length),
                (*extrados, Release::Rotation(Face::Intrados), length),
                (slide.abs(), Release::Sliding(slide.signum()), 1.0),
            ];
            let moves = released.into_iter().filter(|(speed, ..)| *speed > none);
            moves.map(|(speed, release, arm)| ((k, release), speed / arm)).collect::<Vec<_>>()
        };
        speeds.iter().enumerate().flat_map(of_joint).unzip()
    }
}

#[cfg(test)]
mod tests;
