//! The limit window where joints crush: plastic sections of finite compressive strength.
//!
//! A normal force N = N_i + N_e at eccentricity e needs N / f of the joint's length t about its line of action, so
//! that t - 2 |e| >= N / f. With N_i = N (1/2 - e / t) and N_e = N (1/2 + e / t) this is N_i, N_e >= N^2 / (2 f t):
//! two parabolas a joint, which bound a convex set. Where unknowns are few, tangents of them are added to the linear programme of
//! the rigid arch until its answer lies on or within every parabola (cutting planes, Kelley 1960). Where they are many, or
//! tangents so close together that rounding confuses them defeat it, the parabolas are cones of the interior point method; of not
//! too many unknowns tangents help where rounding defeats that one.

use super::linear_program::Basis;
use super::programme::{Dual, MOST_DENSE, Objective, Programme, ProgrammeOutcome};
use super::resultant::Resultant;
use super::static_theorem::{Equilibrium, Limit};
use super::{StaticTheorem, Unsolved, WindowBases};
use crate::budget::Budget;
use crate::geometry::{Vec2, cross};
use crate::structure::{Joint, PointForce, Side};

/// A parabola may be violated by this, relative to the loads and to the size of the point: ten times what the linear
/// programme grants its own rows, so that every cut moves the point.
const VIOLATED: f64 = 1e-11;
/// Error of the interior point method that is put up with: of the order of the above for the end of the window.
const NEARLY_SOLVED: f64 = 1e-8;
/// A parabola this close is active; ten times the above, so that rounding hides no crushed joint.
const ACTIVE: f64 = 1e-7;
/// The block of stress that bears a joint's force takes at least this share of a joint that crushes; less is a hinge. And its parabola lies
/// at this share of the loads at least, a hundred times the above, so that one that is not active is not taken for one.
const BLOCK: f64 = 1e-4;
const TOLD: f64 = 1e-5;
/// Joints that bear so many times the loads crush at none.
const HARD: f64 = 1e12;
/// Forces of so many times the loads, all unknowns added up, are in no structure's reach.
const REACH: f64 = 1e8;
/// Rounds of cuts after which the method has failed (it needs five to thirty).
const MOST_ROUNDS: usize = 300;
/// Normal force N / (f t) of the last tangent: it says N_i, N_e <= f t / 2, which no larger force satisfies.
const LAST_TANGENT: f64 = 1.0;

/// Load factors in equilibrium with joints of finite strength.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CrushingWindow {
    /// Lowest and highest, infinite where unbounded.
    pub ends: [f64; 2],
    /// Dry joints on their parabola at either end whose block of stress takes a ten-thousandth of the joint or more (less is a hinge) and
    /// whose forces rounding tells from those of others; none where the end is infinite.
    pub joints: [Vec<usize>; 2],
    /// Forces of all joints at either end; none where it is infinite.
    pub forces: [Vec<Resultant>; 2],
    /// The same of all passive elements, N/m.
    pub soil: [Vec<f64>; 2],
    /// Motion of all bodies in which the loads of any load factor beyond either end do more work than cohesion and the strength
    /// take (see [`super::WindowEnd`]): on the part of a joint that closes its strength works, and nothing where it opens. None
    /// where the end is infinite.
    pub motions: [Vec<[f64; 3]>; 2],
}

/// One dry joint of finite strength.
#[derive(Debug, Clone, Copy)]
pub(super) struct Section {
    pub joint: usize,
    /// f t, N/m.
    pub capacity: f64,
}

impl Section {
    /// Half spaces below the tangents at N = `at` f t: F - a N + a^2 f t / 2 >= 0 for either corner force F.
    fn tangents(&self, at: f64, theorem: &StaticTheorem) -> [Limit; 2] {
        [[1.0 - at, -at, 0.0], [-at, 1.0 - at, 0.0]]
            .map(|weights| theorem.limit(self.joint, weights, 0.5 * at * at * self.capacity))
    }

    /// Tangents at an equilibrium's normal force, whose slack there is that of the parabola; of larger forces the last.
    fn tangents_at(&self, equilibrium: &Equilibrium, theorem: &StaticTheorem) -> [Limit; 2] {
        let at = equilibrium.forces[self.joint].normal() / self.capacity;
        self.tangents(at.min(LAST_TANGENT), theorem)
    }

    /// Whether an equilibrium violates either parabola at all.
    fn is_violated(&self, equilibrium: &Equilibrium) -> bool {
        let forces = &equilibrium.forces[self.joint];
        let least = forces.normal() * forces.normal() / (2.0 * self.capacity);
        forces.intrados.min(forces.extrados) < least
    }
}

/// Slack of a limit in an equilibrium relative to the loads and to what its parts come to, over the unknowns where these were
/// solved for; negative where violated.
fn slack(limit: &Limit, equilibrium: &Equilibrium, theorem: &StaticTheorem) -> f64 {
    let forces = &equilibrium.forces[limit.joint];
    let size = if equilibrium.unknowns.is_empty() {
        let parts = [forces.intrados, forces.extrados, forces.shear];
        parts.iter().zip(limit.weights).map(|(force, weight)| (force * weight).abs()).sum::<f64>()
    } else {
        let mut row = vec![0.0; theorem.unknowns() + 1];
        theorem.add_row(limit.joint, limit.weights, &mut row);
        row.iter().zip(&equilibrium.unknowns).map(|(a, x)| (a * x).abs()).sum::<f64>()
    };
    limit.slack(&equilibrium.forces) / (1.0 + size)
}

impl StaticTheorem {
    /// Limit window with dry joints of the compressive strength `strengths[joint]`, Pa; None where nothing is in equilibrium.
    ///
    /// # Errors
    /// When rounding, or `budget`, kept the cutting planes from an answer, or a strength is not positive.
    pub fn crushing_window(&self, strengths: &[f64], budget: &Budget) -> Result<Option<CrushingWindow>, Unsolved> {
        self.crushing_window_from(&WindowBases::default(), strengths, budget)
    }

    /// The same, from the bases of this theorem's window.
    ///
    /// # Errors
    /// As those of [`StaticTheorem::crushing_window`].
    pub fn crushing_window_from(
        &self,
        bases: &WindowBases,
        strengths: &[f64],
        budget: &Budget,
    ) -> Result<Option<CrushingWindow>, Unsolved> {
        self.crushing_ends(strengths, [true; 2], bases, budget)
    }

    /// The same with nothing looked for at an end that is not `wanted`: that is infinite.
    pub(super) fn crushing_ends(
        &self,
        strengths: &[f64],
        wanted: [bool; 2],
        WindowBases(from): &WindowBases,
        budget: &Budget,
    ) -> Result<Option<CrushingWindow>, Unsolved> {
        if strengths.len() != self.joints.len() || !strengths.iter().all(|&strength| strength > 0.0) {
            return Err(Unsolved);
        }
        let sections = self.sections(strengths);
        let [mut cut, mut conic] = [Programme::new(self), Programme::new(self)];
        conic.sections = sections.clone();
        conic.errors[1] = NEARLY_SOLVED;
        let ends = [f64::NEG_INFINITY, f64::INFINITY];
        let mut window = CrushingWindow { ends, ..CrushingWindow::default() };
        for (end, sign) in [-1.0, 1.0].into_iter().enumerate().filter(|(end, _)| wanted[*end]) {
            let objective = Objective::load_factor(sign);
            match self.crushing_end(&objective, from[end].as_ref(), &mut cut, &conic, budget) {
                ProgrammeOutcome::At(equilibrium, dual) => {
                    window.ends[end] = equilibrium.load_factor;
                    window.motions[end] = self.motion(&dual, &cut.limits);
                    window.joints[end] = self.crushed(&sections, &equilibrium);
                    (window.forces[end], window.soil[end]) = self.apart(&equilibrium.forces);
                }
                ProgrammeOutcome::Unbounded(_) => {}
                ProgrammeOutcome::Infeasible(_) => return Ok(None),
                ProgrammeOutcome::Lost => return Err(Unsolved),
            }
        }
        Ok(Some(window))
    }

    /// By tangents where unknowns are few, by cones where they are many; where rounding keeps that from an answer, by the other.
    fn crushing_end(
        &self,
        objective: &Objective,
        from: Option<&Basis>,
        cut: &mut Programme,
        conic: &Programme,
        budget: &Budget,
    ) -> ProgrammeOutcome {
        let few = self.has_few_unknowns();
        let tangents = |from, cut: &mut Programme| cut_until_inside(objective, from, cut, &conic.sections, budget);
        let first = match few {
            true => tangents(from, cut),
            false => conic.maximise_sparsely(objective, budget),
        };
        match first {
            ProgrammeOutcome::Infeasible(dual) if few && self.excludes_all(&dual, &cut.limits) => {
                ProgrammeOutcome::Infeasible(dual)
            }
            // A basis that is lost in rounding leads nowhere, and tangents far outside may seem to exclude everything.
            ProgrammeOutcome::Lost | ProgrammeOutcome::Infeasible(_) if few && from.is_some() => {
                self.crushing_end(objective, None, cut, conic, budget)
            }
            ProgrammeOutcome::Lost | ProgrammeOutcome::Infeasible(_) if few => {
                conic.maximise_sparsely(objective, budget)
            }
            // Where nothing crushes, the programme without strength is the same.
            ProgrammeOutcome::Lost if self.unknowns() <= MOST_DENSE && !conic.sections.is_empty() => {
                tangents(None, cut)
            }
            first => first,
        }
    }

    /// Whether multipliers of the joints' laws and these `cuts` prove that no forces in reach violate none of them (Farkas): limits so
    /// added up say that less than nothing is as much as nothing, but for rounding.
    fn excludes_all(&self, dual: &Dual, cuts: &[Limit]) -> bool {
        let n = self.unknowns();
        let mut sum = vec![0.0; n + 1];
        for (limit, y) in self.limits.iter().chain(cuts).zip(&dual.multipliers).filter(|(_, y)| **y != 0.0) {
            let mut row = vec![0.0; n + 1];
            self.add_row(limit.joint, limit.weights, &mut row);
            row[n] += limit.constant;
            sum.iter_mut().zip(row).for_each(|(sum, by)| *sum += y * by);
        }
        let off = sum[..n].iter().fold(0.0, |most: f64, by| most.max(by.abs()));
        off * REACH < -sum[n]
    }

    /// Whether any joint of these strengths, Pa, crushes under loads in reach.
    pub fn crushes(&self, strengths: &[f64]) -> bool {
        !self.sections(strengths).is_empty()
    }

    /// Joints so strong that no load in reach crushes them are none.
    fn sections(&self, strengths: &[f64]) -> Vec<Section> {
        let dry = |(joint, strength): (usize, &f64)| {
            let capacity = strength * self.joints[joint].length();
            let bounded = self.joints[joint].law.coulomb().is_some() && capacity < HARD * self.force;
            bounded.then_some(Section { joint, capacity })
        };
        strengths.iter().enumerate().filter_map(dry).collect()
    }

    /// What forces of joints and elements leave of the loads on any body at a load factor, the moment over the size of the
    /// structure, as a share of all loads that stay or, where these are larger, that grow. Bodies
    /// of joints behind those that `forces` tells of are left out.
    pub fn unbalanced(&self, load_factor: f64, forces: &[Resultant], soil: &[f64]) -> f64 {
        let [fixed, scaled] = &self.loads;
        let mut left: Vec<[f64; 3]> =
            fixed.iter().zip(scaled).map(|(f, s)| [0, 1, 2].map(|i| f[i] + load_factor * s[i])).collect();
        for (joint, of) in self.joints.iter().zip(forces) {
            let on = |at: Vec2, force: Vec2| [force.x, force.y, cross(at - self.frame.origin, force)];
            let parts = [
                on(joint.intrados, joint.normal() * of.intrados + joint.tangent() * of.shear),
                on(joint.extrados, joint.normal() * of.extrados),
            ];
            for (side, sign) in joint.between.into_iter().zip([-1.0, 1.0]) {
                let Some(body) = side.body() else { continue };
                parts.iter().for_each(|part| (0..3).for_each(|i| left[body][i] += sign * part[i]));
            }
        }
        for (element, &size) in self.soil.elements.iter().zip(soil) {
            let PointForce { at, force, .. } = element.force(size);
            let on = [force.x, force.y, cross(at - self.frame.origin, force)];
            (0..3).for_each(|i| left[element.body][i] += on[i]);
        }
        let untold = self.joints[forces.len()..].iter().flat_map(|joint| joint.between).filter_map(Side::body);
        untold.for_each(|body| left[body] = [0.0; 3]);
        let size = self.joints.iter().map(Joint::length).fold(self.frame.length, f64::max);
        let loads = self.loads_at(load_factor);
        let share = |of: [f64; 3]| [of[0], of[1], of[2] / size].map(|part| part.abs() / loads);
        left.into_iter().flat_map(share).fold(0.0, |most, next| if next.is_nan() || next > most { next } else { most })
    }

    /// All loads that stay or, where these are larger, that grow, at a load factor, N/m.
    fn loads_at(&self, load_factor: f64) -> f64 {
        self.force * (load_factor / self.factor).abs().max(1.0)
    }

    /// Joints with a parabola active in an equilibrium.
    fn crushed(&self, sections: &[Section], equilibrium: &Equilibrium) -> Vec<usize> {
        let loads = self.loads_at(equilibrium.load_factor);
        let active = |section: &&Section| {
            let normal = equilibrium.forces[section.joint].normal();
            let crushes = normal > BLOCK * section.capacity && 0.5 * normal * normal > TOLD * loads * section.capacity;
            let tangents = section.tangents_at(equilibrium, self);
            crushes && tangents.iter().any(|tangent| slack(tangent, equilibrium, self) < ACTIVE)
        };
        sections.iter().filter(active).map(|section| section.joint).collect()
    }
}

/// Maximises over the limits and the parabolas, adding the tangents that this takes: from the end of stone that does not crush on.
fn cut_until_inside(
    objective: &Objective,
    from: Option<&Basis>,
    programme: &mut Programme,
    sections: &[Section],
    budget: &Budget,
) -> ProgrammeOutcome {
    let (theorem, mut rows) = (programme.theorem, programme.dense_rows());
    let mut basis = from.cloned().unwrap_or_else(|| Basis::new(programme.over_unknowns(objective)));
    for _ in 0..MOST_ROUNDS {
        let outcome = programme.go_on(&mut basis, &rows, budget);
        let (ProgrammeOutcome::At(equilibrium, _) | ProgrammeOutcome::Unbounded(equilibrium)) = &outcome else {
            return outcome;
        };
        let beyond = sections.iter().filter(|section| section.is_violated(equilibrium));
        let tangents = beyond.flat_map(|section| section.tangents_at(equilibrium, theorem));
        let cuts: Vec<Limit> = tangents.filter(|cut| slack(cut, equilibrium, theorem) < -VIOLATED).collect();
        if cuts.is_empty() {
            return outcome;
        }
        cuts.iter().for_each(|cut| rows.push(theorem, cut, true));
        programme.limits.extend(cuts);
    }
    ProgrammeOutcome::Lost
}

#[cfg(test)]
mod tests;
