//! The limit window and why it ends where it does: forces that prove it from below, motions that prove it from above.

use super::linear_program::Basis;
use super::programme::{Dual, Objective, Programme, ProgrammeOutcome};
use super::resultant::joint_functionals;
use super::static_theorem::Limit;
use super::{Equilibrium, Resultant, StaticTheorem, Unsolved};
use crate::budget::Budget;
use crate::geometry::Vec2;

/// Which load factors have an equilibrium.
#[derive(Debug, Clone, PartialEq)]
pub enum Window {
    /// Those between these two ends.
    Stands([WindowEnd; 2]),
    /// None: in this motion (see [`WindowEnd`]), which no joint hinders, the fixed loads do more work than cohesion takes, and the
    /// scaled loads none.
    Falls(Vec<[f64; 3]>),
}

/// One end of the window.
///
/// A motion has the velocity of every body's centroid, m/s, and its spin, rad/s; the fastest is 1.
#[derive(Debug, Clone, PartialEq)]
pub enum WindowEnd {
    /// Forces of every joint in equilibrium at this load factor. In the motion, which no joint hinders, the loads of any load factor
    /// beyond do more work than cohesion and soil take.
    Bounded {
        /// The end.
        load_factor: f64,
        /// Lower bound, by the static theorem.
        forces: Vec<Resultant>,
        /// Forces of the passive elements there, N/m.
        soil: Vec<f64>,
        /// Upper bound, by the kinematic theorem; sliding joints dilate.
        motion: Vec<[f64; 3]>,
    },
    /// Forces of every joint in equilibrium at this load factor, and what each unit of load factor from there on adds to them.
    Unbounded {
        /// A load factor of the window.
        load_factor: f64,
        /// Forces there.
        forces: Vec<Resultant>,
        /// Forces of the passive elements there, N/m.
        soil: Vec<f64>,
        /// What a unit adds; None where rounding kept the linear programme from an answer.
        ray: Option<Vec<Resultant>>,
    },
}

/// The bases at which the simplex method found the lowest and the highest end of a theorem's window, if it was that which did: it goes
/// on from there where more is asked of the joints, which saves time and no more.
#[derive(Debug, Clone, Default)]
pub struct WindowBases(pub(super) [Option<Basis>; 2]);

impl Window {
    /// Lowest and highest load factor, infinite where unbounded; None where nothing stands.
    pub fn ends(&self) -> Option<[f64; 2]> {
        let Window::Stands(ends) = self else { return None };
        Some([0, 1].map(|i| match ends[i] {
            WindowEnd::Bounded { load_factor, .. } => load_factor,
            WindowEnd::Unbounded { .. } => [f64::NEG_INFINITY, f64::INFINITY][i],
        }))
    }
}

impl StaticTheorem {
    /// Lowest and highest load factor in equilibrium, with the proof of either.
    ///
    /// # Errors
    /// When rounding, or `budget`, kept the linear programme from an answer.
    pub fn window(&self, budget: &Budget) -> Result<Window, Unsolved> {
        self.window_and_bases(budget).map(|(window, _)| window)
    }

    /// The same, with the bases of its ends.
    ///
    /// # Errors
    /// As those of [`StaticTheorem::window`].
    pub fn window_and_bases(&self, budget: &Budget) -> Result<(Window, WindowBases), Unsolved> {
        let (mut found, mut bases) = (Vec::new(), WindowBases::default());
        for (end, sign) in [-1.0, 1.0].into_iter().enumerate() {
            let objective = Objective::load_factor(sign);
            found.push(match Programme::new(self).maximise_from(&mut bases.0[end], &objective, budget) {
                ProgrammeOutcome::At(equilibrium, dual) => Some((equilibrium, self.motion(&dual, &[]))),
                ProgrammeOutcome::Unbounded(_) => None,
                ProgrammeOutcome::Infeasible(dual) => return Ok((Window::Falls(self.motion(&dual, &[])), bases)),
                ProgrammeOutcome::Lost => return Err(Unsolved),
            });
        }
        let bounded = |(at, motion): (Equilibrium, Vec<[f64; 3]>)| {
            let (forces, soil) = self.apart(&at.forces);
            WindowEnd::Bounded { load_factor: at.load_factor, forces, soil, motion }
        };
        let (high, low) = (found.pop().flatten(), found.pop().flatten());
        let ends = match (low, high) {
            (Some(low), Some(high)) => [low, high].map(bounded),
            (Some(low), None) => [bounded(low.clone()), self.unbounded(1.0, low.0, budget)],
            (None, Some(high)) => [self.unbounded(-1.0, high.0.clone(), budget), bounded(high)],
            (None, None) => {
                let mut programme = Programme::new(self);
                programme.bounds = [0.0; 2];
                let at_zero = programme.maximise(&Objective::load_factor(0.0), budget);
                let ProgrammeOutcome::At(at, _) = at_zero else { return Err(Unsolved) };
                [self.unbounded(-1.0, at.clone(), budget), self.unbounded(1.0, at, budget)]
            }
        };
        Ok((Window::Stands(ends), bases))
    }

    /// Any load factor from that of `at` in the direction of `sign` is in equilibrium.
    fn unbounded(&self, sign: f64, at: Equilibrium, budget: &Budget) -> WindowEnd {
        let (forces, soil) = self.apart(&at.forces);
        WindowEnd::Unbounded { load_factor: at.load_factor, forces, soil, ray: self.ray(sign, budget) }
    }

    /// What a unit of load factor in the direction of `sign` adds to the forces of every joint, whatever these are; None where rounding
    /// keeps the linear programme from an answer.
    fn ray(&self, sign: f64, budget: &Budget) -> Option<Vec<Resultant>> {
        let nothing = vec![Resultant::default(); self.joints()];
        // Without loads that grow nothing is added, not even rounding.
        if self.loads[1].as_flattened().iter().all(|load| *load == 0.0) {
            return Some(nothing);
        }
        let mut programme = Programme::unlimited(self);
        programme.limits = self.limits.iter().map(|limit| Limit { constant: 0.0, ..*limit }).collect();
        programme.bounds[if sign > 0.0 { 1 } else { 0 }] = sign * self.factor;
        match programme.maximise(&Objective::load_factor(sign), budget) {
            ProgrammeOutcome::At(ray, _) if ray.load_factor != 0.0 => {
                let per_unit = 1.0 / ray.load_factor.abs();
                Some(self.apart(&ray.forces).0.iter().map(|of| of.times(per_unit)).collect())
            }
            ProgrammeOutcome::At(..) | ProgrammeOutcome::Unbounded(_) => Some(nothing),
            ProgrammeOutcome::Infeasible(_) | ProgrammeOutcome::Lost => None,
        }
    }

    /// The motion of every body that no limit hinders: joints yield as the multipliers of their limits, and of those that a
    /// programme has besides, say.
    pub(super) fn motion(&self, dual: &Dual, besides: &[Limit]) -> Vec<[f64; 3]> {
        let about_middle = dual.motion.clone().unwrap_or_else(|| self.motion_of_limits(&dual.multipliers, besides));
        let of_centroid = |([u, v, spin], centroid): ([f64; 3], &Vec2)| {
            let arm = centroid - self.frame.origin;
            [u - spin * arm.y, v + spin * arm.x, spin]
        };
        let mut motion: Vec<_> = about_middle.into_iter().zip(&self.centroids).map(of_centroid).collect();
        let fastest = motion.iter().map(|[u, v, _]| u.hypot(*v)).fold(0.0, f64::max);
        if fastest > 0.0 {
            motion.as_flattened_mut().iter_mut().for_each(|rate| *rate /= fastest);
        }
        motion
    }

    /// Motion about the middle of all joints: down the tree every joint adds what its limits yield.
    fn motion_of_limits(&self, multipliers: &[f64], besides: &[Limit]) -> Vec<[f64; 3]> {
        let mut relative = vec![[0.0; 3]; self.joints()];
        let of_joint = |(limit, y): &(&Limit, &f64)| limit.joint < self.joints() && **y != 0.0;
        for (limit, y) in self.limits.iter().chain(besides).zip(multipliers).filter(of_joint) {
            let functionals = joint_functionals(&self.joints[limit.joint], self.frame.origin);
            for (weight, functional) in limit.weights.iter().zip(functionals) {
                (0..3).for_each(|i| relative[limit.joint][i] += y * weight * functional[i]);
            }
        }
        self.loops.motions(&relative)
    }
}

#[cfg(test)]
mod tests;
