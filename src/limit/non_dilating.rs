//! Mechanisms of sliding joints that do not dilate, and the loads at which their forces are admissible.
//!
//! Limit analysis lets a sliding joint open as it slides (associated friction); masonry does not. Without dilation a
//! mechanism is a full solution wherever the joints that move are at their limits and all others are admissible: no force at
//! the end that opens, shear at its bound against the motion. These are linear conditions on the four unknowns of the
//! static theorem, and what they leave open is a whole range of load factors. Its least value is a linear programme.

use super::linear_program::{Beat, Inequality, Optimum, Row, UNKNOWNS, maximise, multipliers_at_optimum};
use super::static_theorem::{Equilibrium, Resultant, StaticTheorem, Unsolved};
use crate::structure::{Face, Joint, JointLaw};

/// Rates below this share of the fastest are none.
const MOVES: f64 = 1e-9;

/// A relative motion that a joint at its limit allows, of unit rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Release {
    /// Rotation about the end on this face, which opens the other.
    Rotation(Face),
    /// Sliding of the stone after the joint, +1 towards the extrados, -1 towards the intrados.
    Sliding(f64),
}

/// What a joint that carries `forces` lets happen; a corner's force up to `none`, N/m, is none, and shear as near to its capacity
/// is at it.
pub fn releases(joint: &Joint, forces: &Resultant, none: f64) -> Vec<Release> {
    let [friction, cohesion] = match joint.law {
        JointLaw::Dry { friction, cohesion } => [friction, cohesion],
        JointLaw::Wall => [0.0; 2],
        JointLaw::Mirror => return vec![Release::Sliding(1.0), Release::Sliding(-1.0)],
        JointLaw::Bonded => return Vec::new(),
    };
    let normal = forces.normal();
    let capacity = friction * normal + cohesion * joint.length();
    let corners = [(Face::Intrados, forces.extrados), (Face::Extrados, forces.intrados)];
    let rotations = corners.into_iter().filter(|(_, force)| *force <= none).map(|(face, _)| Release::Rotation(face));
    // The shear on the stone after the joint opposes its sliding.
    let slides = [1.0, -1.0].into_iter().filter(|sign| capacity + sign * forces.shear <= none).map(Release::Sliding);
    rotations.chain(slides).collect()
}

impl StaticTheorem {
    /// The equilibrium of the smallest load factor from `start` on, in the direction of `sign`, at which the joints that
    /// `moving` names are at those limits and every other is admissible; None where there is none.
    ///
    /// An end that opens carries nothing. How much of its cohesion a joint that opens has left depends on where along it the
    /// cohesion sits, so where it slides too, anything from none to all is admitted.
    ///
    /// # Errors
    /// When rounding, or `beat`, kept the linear programme from an answer.
    pub fn least_load(
        &self,
        moving: &[(usize, Release)],
        start: f64,
        sign: f64,
        beat: Beat,
    ) -> Result<Option<Equilibrium>, Unsolved> {
        let mut inequalities = self.inequalities.clone();
        for &(joint, release) in moving {
            let turns =
                |&(other, release): &(usize, Release)| other == joint && matches!(release, Release::Rotation(_));
            self.add_limits(joint, release, moving.iter().any(turns), &mut inequalities);
        }
        inequalities.push(Inequality { row: Row::new(0.0, 0.0, 0.0, sign), constant: -sign * start / self.factor });
        match maximise(Row::new(0.0, 0.0, 0.0, -sign), &inequalities, beat) {
            Optimum::At(_, unknowns) => Ok(Some(self.equilibrium(unknowns))),
            Optimum::Infeasible => Ok(None),
            Optimum::Unbounded(_) | Optimum::Lost => Err(Unsolved),
        }
    }

    /// What `joint` at the limit of `release` is held to; `turns`: some end of it opens.
    fn add_limits(&self, joint: usize, release: Release, turns: bool, inequalities: &mut Vec<Inequality>) {
        let Some([friction, cohesion]) = self.joints[joint].law.coulomb() else { return };
        let [intrados, extrados, shear] = self.forces[joint];
        let (row, constant) = match release {
            Release::Rotation(Face::Intrados) => extrados,
            Release::Rotation(Face::Extrados) => intrados,
            // Capacity left when the stone after the joint slides the way of `sign`, which the shear opposes.
            Release::Sliding(sign) => {
                let adhesion = if turns { 0.0 } else { cohesion * self.joints[joint].length() };
                let row = (intrados.0 + extrados.0) * friction + shear.0 * sign;
                (row, (intrados.1 + extrados.1) * friction + shear.1 * sign + adhesion)
            }
        };
        // That none of them is negative is among the inequalities already.
        let norm = row.norm();
        inequalities.push(Inequality { row: -row / norm, constant: -constant / norm });
    }
}

/// Rates x >= 0 of least cost, the costs being positive, at which the `columns` (closure of the chain and power, per unit
/// rate) add up to no gap and power 1: a corner of all such motions, with at most four rates that are not zero. None where
/// there is no motion, or `beat` broke.
///
/// The dual asks for the largest y_4 with a . y <= cost for every column a: a programme in four unknowns again, whose
/// multipliers are the rates.
pub fn cheapest_motion(columns: &[Row], costs: &[f64], beat: Beat) -> Option<Vec<f64>> {
    let size = |column: &Row| column.norm();
    let half_space =
        |(column, cost): (&Row, &f64)| Inequality { row: -column / size(column), constant: cost / size(column) };
    let dual: Vec<Inequality> = columns.iter().zip(costs).map(half_space).collect();
    let rates = multipliers_at_optimum(Row::ith(UNKNOWNS - 1, 1.0), &dual, beat)?;
    let rates: Vec<f64> = rates.iter().zip(columns).map(|(rate, column)| rate / size(column)).collect();
    let fastest = rates.iter().copied().fold(0.0, f64::max);
    Some(rates.into_iter().map(|rate| if rate > MOVES * fastest { rate } else { 0.0 }).collect())
}

#[cfg(test)]
mod tests;
