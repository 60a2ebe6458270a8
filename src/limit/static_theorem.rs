//! The static theorem of any structure: forces round its loops, and what every joint then carries.

use super::interior_point::NewtonPattern;
use super::linear_program::norm;
use super::passive::Soil;
use super::programme::{MOST_DENSE, Objective, Programme, ProgrammeOutcome, Rows};
use super::resultant::{Condition, Resultant, dot, joint_functionals};
use crate::budget::Budget;
use crate::geometry::Vec2;
use crate::structure::{Joint, JointLaw, Loops, PointForce, Structure, Unconnected, resultants};
use nalgebra::{DMatrix, DVector};

/// Iterations after which a singular value decomposition has failed (it needs about ten an unknown at most).
const MOST_SWEEPS: usize = 10_000;
/// Most unknowns for which the dense simplex method is the faster one.
pub(super) const FEW_UNKNOWNS: usize = 60;

/// Equilibrium of the whole structure with the redundants and the load factor left open.
///
/// Unknowns are, for every loop, (F_x, F_y, M) of the force that goes round it through its closing joint, in units of `force`
/// and `force * length` about the loop's middle; the force of every passive element, in units of `force`; and the load factor in
/// units of `factor`. The force round the loop of a single ring is that of the left springing.
#[derive(Debug, Clone)]
pub struct StaticTheorem {
    pub(super) joints: Vec<Joint>,
    pub(super) loops: Loops,
    pub(super) soil: Soil,
    /// Of every loop.
    frames: Vec<Units>,
    /// Of all joints.
    pub(super) frame: Units,
    /// What fixed loads, and scaled loads of load factor 1, add to the three forces of every joint down the tree, N/m.
    pub(super) carried: [Vec<[f64; 3]>; 2],
    /// The same loads on every body: F_x, F_y and M about the middle of all joints.
    pub(super) loads: [Vec<[f64; 3]>; 2],
    /// Centroids of the bodies, m.
    pub(super) centroids: Vec<Vec2>,
    pub(super) limits: Vec<Limit>,
    /// The limits over the unknowns, where these are few.
    pub(super) rows: Option<Rows>,
    /// How bodies hang together, where the unknowns are many.
    pub(super) pattern: Option<NewtonPattern>,
    pub(super) force: f64,
    pub(super) factor: f64,
}

/// Where moments are taken about, and the length that makes forces of them, m.
#[derive(Debug, Clone, Copy)]
pub(super) struct Units {
    pub origin: Vec2,
    pub length: f64,
}

impl Units {
    fn of<'j>(joints: impl Iterator<Item = &'j Joint> + Clone) -> Self {
        let origin = joints.clone().map(Joint::middle).sum::<Vec2>() / joints.clone().count() as f64;
        Units { origin, length: joints.map(|j| (j.middle() - origin).norm()).fold(0.0, f64::max) }
    }
}

/// The half space `weights . (intrados, extrados, shear) + constant >= 0` of one joint's forces, in units of the loads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Limit {
    pub joint: usize,
    pub weights: [f64; 3],
    pub constant: f64,
}

impl Limit {
    /// What is left to the limit; negative where it is violated.
    pub(super) fn slack(&self, forces: &[Resultant]) -> f64 {
        forces[self.joint].weighted(&self.weights) + self.constant
    }
}

/// The linear programme could not be solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unsolved;

/// A point of the static theorem.
#[derive(Debug, Clone, PartialEq)]
pub struct Equilibrium {
    /// Forces of every joint, and behind them those of the passive elements.
    pub(super) forces: Vec<Resultant>,
    /// Load factor.
    pub load_factor: f64,
    /// Unknowns of the static theorem, where it was found over them.
    pub(super) unknowns: Vec<f64>,
}

impl StaticTheorem {
    /// The theorem of a structure under fixed loads and loads scaled by the load factor.
    ///
    /// # Errors
    /// Every body that is not connected to the ground.
    pub fn new(structure: &Structure, fixed: &[PointForce], scaled: &[PointForce]) -> Result<Self, Vec<Unconnected>> {
        let loops = Loops::new(structure)?;
        let joints = structure.joints.clone();
        let dense = 3 * loops.len() + structure.passive.len() < MOST_DENSE;
        let soil = Soil::new(&structure.passive, joints.len(), &loops, dense);
        let frame = Units::of(joints.iter());
        let frames = loops.joints().iter().map(|of| Units::of(of.iter().map(|&k| &joints[k]))).collect();
        let total = |loads: &[PointForce]| loads.iter().map(|l| l.force.norm()).sum::<f64>();
        let (total_fixed, total_scaled) = (total(fixed), total(scaled));
        let force = [total_fixed, total_scaled, 1.0].into_iter().find(|&f| f > 0.0).unwrap_or(1.0);
        let factor = if total_scaled > 0.0 { force / total_scaled } else { 1.0 };
        let loads = [fixed, scaled].map(|loads| resultants(structure.bodies.len(), loads, frame.origin));
        let centroids = structure.bodies.iter().map(|body| body.region.centroid).collect();
        let functionals: Vec<_> = joints.iter().map(|joint| joint_functionals(joint, frame.origin)).collect();
        let carried = [0, 1].map(|which: usize| {
            let carried = loops.carried(&loads[which]);
            functionals.iter().zip(carried).map(|(of, wrench)| of.map(|row| dot(row, wrench))).collect()
        });
        let (limits, rows, pattern) = (Vec::new(), None, None);
        let mut theorem = StaticTheorem {
            joints,
            loops,
            soil,
            frames,
            frame,
            carried,
            loads,
            centroids,
            limits,
            rows,
            pattern,
            force,
            factor,
        };
        theorem.limits = theorem.all_limits();
        if theorem.has_few_unknowns() {
            theorem.rows = Some(Rows::of_laws(&theorem));
        } else {
            theorem.pattern = theorem.find_pattern();
        }
        Ok(theorem)
    }

    /// Joint `k` of the structure.
    pub fn joint(&self, k: usize) -> &Joint {
        &self.joints[k]
    }

    /// Loops of the structure.
    pub fn loops(&self) -> &Loops {
        &self.loops
    }

    /// Number of joints.
    pub fn joints(&self) -> usize {
        self.joints.len()
    }

    /// Three for every loop, one for every passive element, and the load factor.
    pub fn unknowns(&self) -> usize {
        3 * self.loops.len() + self.elements() + 1
    }

    /// Whether there is more than the one loop of a single ring.
    pub fn has_loops(&self) -> bool {
        self.loops.len() > 1
    }

    pub(super) fn has_few_unknowns(&self) -> bool {
        self.unknowns() <= FEW_UNKNOWNS
    }

    /// What the laws of all joints ask, and behind it the bounds of the passive elements.
    pub(super) fn all_limits(&self) -> Vec<Limit> {
        let bounds = (0..self.elements()).flat_map(|e| self.bounds_of(e));
        (0..self.joints.len()).flat_map(|k| self.limits_of(k)).chain(bounds).collect()
    }

    /// What the law of joint `k` asks of its forces.
    fn limits_of(&self, k: usize) -> Vec<Limit> {
        let capacity = |friction: f64, adhesion: f64| [1.0, -1.0].map(|sign| ([friction, friction, sign], adhesion));
        let pressed = [([1.0, 0.0, 0.0], 0.0), ([0.0, 1.0, 0.0], 0.0)];
        let conditions = match self.joints[k].law {
            JointLaw::Dry { friction, cohesion } => {
                [pressed, capacity(friction, cohesion * self.joints[k].length())].concat()
            }
            JointLaw::Wall => [pressed, capacity(0.0, 0.0)].concat(),
            JointLaw::Mirror => capacity(0.0, 0.0).to_vec(),
            JointLaw::Bonded => Vec::new(),
        };
        conditions.into_iter().map(|(weights, constant)| self.limit(k, weights, constant)).collect()
    }

    /// A limit in units of the loads: of unit length as a functional of the force and moment that the joint passes on, in units
    /// of `force` and `force` times the size of the structure, and of what the scaled loads add.
    pub(super) fn limit(&self, joint: usize, weights: [f64; 3], constant: f64) -> Limit {
        let functionals = joint_functionals(&self.joints[joint], self.frame.origin);
        let component = |i: usize| (0..3).map(|c| weights[c] * functionals[c][i]).sum::<f64>() * self.force;
        let grown = dot(weights, self.carried[1][joint]) * self.factor;
        let squares = [component(0), component(1), component(2) * self.frame.length, grown].map(|x| x * x);
        let scale = squares.iter().sum::<f64>().sqrt();
        Limit { joint, weights: weights.map(|w| w / scale), constant: constant / scale }
    }

    /// `weights . (intrados, extrados, shear)` of a joint over (unknowns; 1), added to `row`.
    pub(super) fn add_row(&self, joint: usize, weights: [f64; 3], row: &mut [f64]) {
        let soil = 3 * self.loops.len();
        if joint >= self.joints.len() {
            row[soil + joint - self.joints.len()] += weights[0] * self.force;
            return;
        }
        for (e, forces) in self.soil_at(joint) {
            row[soil + e] += dot(weights, forces) * self.force;
        }
        for &(number, sign) in self.loops.through(joint) {
            let Units { origin, length } = self.frames[number];
            let functionals = joint_functionals(&self.joints[joint], origin);
            let units = [self.force, self.force, self.force * length];
            for i in 0..3 {
                let component = (0..3).map(|c| weights[c] * functionals[c][i]).sum::<f64>();
                row[3 * number + i] += sign * component * units[i];
            }
        }
        let last = self.unknowns() - 1;
        row[last] += dot(weights, self.carried[1][joint]) * self.factor;
        row[last + 1] += dot(weights, self.carried[0][joint]);
    }

    /// Whether some body carries no load at load factor `at`, or loads that cancel to within `slack`, a share of their sizes.
    pub fn leaves_unloaded(&self, at: f64, slack: f64) -> bool {
        let [fixed, scaled] = &self.loads;
        let cancels = |f: f64, s: f64| (f + at * s).abs() <= slack * (f.abs() + (at * s).abs());
        fixed.iter().zip(scaled).any(|(f, s)| (0..3).all(|i| cancels(f[i], s[i])))
    }

    /// True where an equilibrium at load factor `at` violates no condition by more than `slack`, a share of the loads.
    pub fn nearly_stands(&self, at: f64, slack: f64, budget: &Budget) -> bool {
        let mut programme = Programme::new(self);
        programme.bounds = [at - slack * self.factor, at + slack * self.factor];
        programme.slack = slack;
        matches!(
            programme.maximise(&Objective::load_factor(1.0), budget),
            ProgrammeOutcome::At(..) | ProgrammeOutcome::Unbounded(_)
        )
    }

    /// The equilibrium that satisfies all `conditions` (least squares) where every passive element presses as `soil` says, N/m; None
    /// unless they fix all that is left unknown.
    pub fn solve(&self, conditions: &[Condition], soil: &[f64]) -> Option<Equilibrium> {
        let (n, known) = (self.unknowns(), 3 * self.loops.len()..self.unknowns() - 1);
        let left = n - known.len();
        if conditions.len() < left || soil.len() != known.len() {
            return None;
        }
        let carried = self.carried_from(soil);
        let mut rows = vec![0.0; conditions.len() * (left + 1)];
        let mut full = vec![0.0; n + 1];
        for (row, condition) in rows.chunks_exact_mut(left + 1).zip(conditions) {
            full.fill(0.0);
            self.add_row(condition.joint, condition.weights, &mut full);
            full[n] += condition.constant + dot(condition.weights, carried[condition.joint]);
            let others = full[..known.start].iter().chain(&full[known.end..]);
            row.iter_mut().zip(others).for_each(|(x, other)| *x = *other);
            let size = norm(&row[..left]);
            row.iter_mut().for_each(|x| *x /= size);
        }
        if !rows.iter().all(|x| x.is_finite()) {
            return None;
        }
        let a = DMatrix::from_fn(conditions.len(), left, |i, j| rows[i * (left + 1) + j]);
        let b = DVector::from_fn(conditions.len(), |i, _| -rows[i * (left + 1) + left]);
        let svd = a.try_svd(true, true, f64::EPSILON, MOST_SWEEPS)?;
        if svd.rank(1e-9) < left {
            return None;
        }
        let x = svd.solve(&b, 0.0).ok()?;
        let (round, grown) = x.as_slice().split_at(known.start);
        let pressed: Vec<f64> = soil.iter().map(|force| force / self.force).collect();
        Some(self.equilibrium(&[round, &pressed, grown].concat(), true))
    }

    /// The equilibrium of these unknowns, `complete` under the fixed loads too.
    pub(super) fn equilibrium(&self, unknowns: &[f64], complete: bool) -> Equilibrium {
        let n = unknowns.len() - 1;
        let pressed: Vec<f64> = unknowns[3 * self.loops.len()..n].iter().map(|x| self.force * x).collect();
        let from_soil = self.carried_from(&pressed);
        let force = |k: usize| {
            let [fixed, scaled] = [&self.carried[0][k], &self.carried[1][k]];
            let factor = unknowns[n] * self.factor;
            let mut forces: [f64; 3] = std::array::from_fn(|c| f64::from(complete) * fixed[c] + factor * scaled[c]);
            for &(number, sign) in self.loops.through(k) {
                let Units { origin, length } = self.frames[number];
                let x = &unknowns[3 * number..3 * number + 3];
                let wrench = [x[0], x[1], x[2] * length].map(|component| sign * self.force * component);
                let functionals = joint_functionals(&self.joints[k], origin);
                forces = std::array::from_fn(|c| forces[c] + dot(functionals[c], wrench));
            }
            forces = std::array::from_fn(|c| forces[c] + from_soil[k][c]);
            Resultant { intrados: forces[0], extrados: forces[1], shear: forces[2] }
        };
        let element = |&size: &f64| Resultant { intrados: size, ..Resultant::default() };
        Equilibrium {
            forces: (0..self.joints.len()).map(force).chain(pressed.iter().map(element)).collect(),
            load_factor: unknowns[n] * self.factor,
            unknowns: unknowns.to_vec(),
        }
    }

    /// Load factor at which the scaled loads are as large as the fixed ones.
    pub fn load_factor_scale(&self) -> f64 {
        self.factor
    }

    /// Forces of every joint in an equilibrium.
    pub fn resultants(&self, equilibrium: &Equilibrium) -> Vec<Resultant> {
        self.apart(&equilibrium.forces).0
    }

    /// Forces of every passive element in an equilibrium, N/m.
    pub fn soil(&self, equilibrium: &Equilibrium) -> Vec<f64> {
        self.apart(&equilibrium.forces).1
    }

    /// Smallest slack of any inequality in an equilibrium, in units of the loads' scale (negative: violated).
    pub fn slack(&self, equilibrium: &Equilibrium) -> f64 {
        self.limits.iter().map(|limit| limit.slack(&equilibrium.forces)).fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
pub(super) mod tests;
