//! The static theorem of one arch in four unknowns.

use super::linear_program::{Beat, Inequality, Optimum, Row, UNKNOWNS, maximise};
use crate::geometry::{Vec2, cross};
use crate::structure::{Joint, JointLaw, PointForce, Structure};
use nalgebra::{DMatrix, DVector};

/// Iterations after which a singular value decomposition of four columns has failed (it needs about ten).
const MOST_SWEEPS: usize = 1000;

/// Forces that one joint carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resultant {
    /// Normal force at the intrados end, compression positive, N/m.
    pub intrados: f64,
    /// Normal force at the extrados end, compression positive, N/m.
    pub extrados: f64,
    /// Shear on the stone after the joint, towards the extrados positive, N/m.
    pub shear: f64,
}

impl Resultant {
    /// Normal force, N/m.
    pub fn normal(&self) -> f64 {
        self.intrados + self.extrados
    }

    /// The larger of normal force and shear, N/m.
    pub fn size(&self) -> f64 {
        self.normal().abs().max(self.shear.abs())
    }
}

/// A linear condition on the forces of one joint: the weighted sum of them and of the constant vanishes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Condition {
    /// Joint number.
    pub joint: usize,
    /// Weights of the normal forces at intrados and extrados and of the shear.
    pub weights: [f64; 3],
    /// Constant, N/m.
    pub constant: f64,
}

/// Equilibrium of the whole arch with the redundants and the load factor left open.
///
/// Unknowns are (F_x, F_y, M) of the force that the left springing exerts on the arch, in units of `force` and
/// `force * length` about `origin`, and the load factor in units of `factor`.
#[derive(Debug, Clone)]
pub struct StaticTheorem {
    pub(super) joints: Vec<Joint>,
    /// Intrados force, extrados force and shear of each joint as rows over (unknowns; 1), N/m.
    pub(super) forces: Vec<[(Row, f64); 3]>,
    pub(super) inequalities: Vec<Inequality>,
    pub(super) force: f64,
    pub(super) factor: f64,
}

/// The linear programme could not be solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unsolved;

/// A point of the static theorem.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Equilibrium {
    unknowns: Row,
    /// Load factor.
    pub load_factor: f64,
}

impl StaticTheorem {
    /// The theorem of an arch under fixed loads and loads scaled by the load factor.
    pub fn new(structure: &Structure, fixed: &[PointForce], scaled: &[PointForce]) -> Self {
        let origin = structure.ring().iter().map(Joint::middle).sum::<Vec2>() / structure.ring().len() as f64;
        let length = structure.ring().iter().map(|j| (j.middle() - origin).norm()).fold(0.0, f64::max);
        let total = |loads: &[PointForce]| loads.iter().map(|l| l.force.norm()).sum::<f64>();
        let (total_fixed, total_scaled) = (total(fixed), total(scaled));
        let force = [total_fixed, total_scaled, 1.0].into_iter().find(|&f| f > 0.0).unwrap_or(1.0);
        let factor = if total_scaled > 0.0 { force / total_scaled } else { 1.0 };

        let (steady, growing) = (cumulative(structure, fixed, origin), cumulative(structure, scaled, origin));
        let mut theorem = StaticTheorem {
            joints: structure.ring().to_vec(),
            forces: Vec::new(),
            inequalities: Vec::new(),
            force,
            factor,
        };
        for (k, joint) in structure.ring().iter().enumerate() {
            let component = |functional: [f64; 3]| {
                let row = Row::new(
                    functional[0] * force,
                    functional[1] * force,
                    functional[2] * force * length,
                    dot(functional, growing[k]) * factor,
                );
                (row, dot(functional, steady[k]))
            };
            theorem.forces.push(joint_functionals(joint, origin).map(component));
            theorem.add_inequalities(k);
        }
        theorem
    }

    /// Joint `k` of the arch.
    pub fn joint(&self, k: usize) -> &Joint {
        &self.joints[k]
    }

    fn add_inequalities(&mut self, k: usize) {
        let [intrados, extrados, shear] = self.forces[k];
        let capacity = |friction: f64, adhesion: f64, sign: f64| {
            (
                (intrados.0 + extrados.0) * friction + shear.0 * sign,
                (intrados.1 + extrados.1) * friction + shear.1 * sign + adhesion,
            )
        };
        let conditions = match self.joints[k].law {
            law @ (JointLaw::Dry { .. } | JointLaw::Wall) => {
                let [friction, cohesion] = law.coulomb().unwrap_or_default();
                let adhesion = cohesion * self.joints[k].length();
                vec![intrados, extrados, capacity(friction, adhesion, 1.0), capacity(friction, adhesion, -1.0)]
            }
            JointLaw::Mirror => vec![capacity(0.0, 0.0, 1.0), capacity(0.0, 0.0, -1.0)],
            JointLaw::Bonded => Vec::new(),
        };
        for (row, constant) in conditions {
            let norm = row.norm();
            self.inequalities.push(Inequality { row: row / norm, constant: constant / norm });
        }
    }

    /// Lowest and highest load factor in equilibrium, infinite where unbounded; None when there is none at all.
    ///
    /// # Errors
    /// When rounding, or `beat`, kept the linear programme from an answer.
    pub fn window(&self, beat: Beat) -> Result<Option<[f64; 2]>, Unsolved> {
        let end = |sign: f64| match maximise(Row::new(0.0, 0.0, 0.0, sign), &self.inequalities, beat) {
            Optimum::At(value, _) => Ok(Some(sign * value * self.factor)),
            Optimum::Unbounded(_) => Ok(Some(sign * f64::INFINITY)),
            Optimum::Infeasible => Ok(None),
            Optimum::Lost => Err(Unsolved),
        };
        Ok(end(-1.0)?.zip(end(1.0)?).map(|(low, high)| [low, high]))
    }

    /// True where an equilibrium at load factor `at` violates no condition by more than `slack`, a share of the loads.
    pub fn nearly_stands(&self, at: f64, slack: f64, beat: Beat) -> bool {
        let mut relaxed = self.pinned(at);
        relaxed.iter_mut().for_each(|inequality| inequality.constant += slack);
        matches!(maximise(Row::new(1.0, 0.0, 0.0, 0.0), &relaxed, beat), Optimum::At(..) | Optimum::Unbounded(_))
    }

    /// The inequalities with the load factor held at `at`.
    fn pinned(&self, at: f64) -> Vec<Inequality> {
        let mut inequalities = self.inequalities.clone();
        let row = Row::new(0.0, 0.0, 0.0, 1.0);
        inequalities.push(Inequality { row, constant: -at / self.factor });
        inequalities.push(Inequality { row: -row, constant: at / self.factor });
        inequalities
    }

    /// Least and greatest horizontal thrust of the left springing at load factor `at`, N/m; None when nothing stands.
    pub fn thrust_range(&self, at: f64, beat: Beat) -> Option<[f64; 2]> {
        let inequalities = self.pinned(at);
        let end = |sign: f64| match maximise(Row::new(sign, 0.0, 0.0, 0.0), &inequalities, beat) {
            Optimum::At(value, _) => Some(sign * value * self.force),
            Optimum::Unbounded(_) => Some(sign * f64::INFINITY),
            Optimum::Infeasible | Optimum::Lost => None,
        };
        Some([end(-1.0)?, end(1.0)?])
    }

    /// The equilibrium that satisfies all `conditions` (least squares); None unless they fix all four unknowns.
    pub fn solve(&self, conditions: &[Condition]) -> Option<Equilibrium> {
        let rows: Vec<(Row, f64)> = conditions
            .iter()
            .map(|condition| {
                let parts = self.forces[condition.joint].iter().zip(condition.weights);
                let (row, constant) = parts
                    .fold((Row::zeros(), condition.constant), |(row, c), (part, w)| (row + part.0 * w, c + part.1 * w));
                (row / row.norm(), constant / row.norm())
            })
            .collect();
        if rows.len() < UNKNOWNS || rows.iter().any(|(row, _)| !row.iter().all(|x| x.is_finite())) {
            return None;
        }
        let a = DMatrix::from_fn(rows.len(), UNKNOWNS, |i, j| rows[i].0[j]);
        let b = DVector::from_fn(rows.len(), |i, _| -rows[i].1);
        let svd = a.try_svd(true, true, f64::EPSILON, MOST_SWEEPS)?;
        if svd.rank(1e-9) < UNKNOWNS {
            return None;
        }
        let x = svd.solve(&b, 0.0).ok()?;
        Some(self.equilibrium(Row::from_fn(|i, _| x[i])))
    }

    pub(super) fn equilibrium(&self, unknowns: Row) -> Equilibrium {
        Equilibrium { unknowns, load_factor: unknowns[3] * self.factor }
    }

    /// Load factor at which the scaled loads are as large as the fixed ones.
    pub fn load_factor_scale(&self) -> f64 {
        self.factor
    }

    /// Forces of every joint in an equilibrium.
    pub fn resultants(&self, equilibrium: &Equilibrium) -> Vec<Resultant> {
        let value = |(row, constant): &(Row, f64)| row.dot(&equilibrium.unknowns) + constant;
        let joint = |[i, e, s]: &[(Row, f64); 3]| Resultant { intrados: value(i), extrados: value(e), shear: value(s) };
        self.forces.iter().map(joint).collect()
    }

    /// Smallest slack of any inequality in an equilibrium, in units of the loads' scale (negative: violated).
    pub fn slack(&self, equilibrium: &Equilibrium) -> f64 {
        let slack = |i: &Inequality| i.row.dot(&equilibrium.unknowns) + i.constant;
        self.inequalities.iter().map(slack).fold(f64::INFINITY, f64::min)
    }
}

/// What the loads on stones 0..k add to (F_x, F_y, M about `origin`) at joint k.
fn cumulative(structure: &Structure, loads: &[PointForce], origin: Vec2) -> Vec<[f64; 3]> {
    let mut sums = vec![[0.0; 3]; structure.ring().len()];
    for load in loads {
        let part = [load.force.x, load.force.y, cross(load.at - origin, load.force)];
        let after = &mut sums[load.body + 1];
        *after = std::array::from_fn(|i| after[i] + part[i]);
    }
    for k in 1..sums.len() {
        sums[k] = std::array::from_fn(|i| sums[k][i] + sums[k - 1][i]);
    }
    sums
}

/// Intrados force, extrados force and shear as functionals of the resultant (F_x, F_y, M about `origin`) that the
/// stone before the joint exerts on the stone after it.
fn joint_functionals(joint: &Joint, origin: Vec2) -> [[f64; 3]; 3] {
    let (t, length) = (joint.tangent(), joint.length());
    // Moment about a point p is M - (p - origin) x F; the extrados force has the lever `length` about the intrados end.
    let moment_about = |p: Vec2| {
        let r = p - origin;
        [r.y, -r.x, 1.0]
    };
    let intrados = moment_about(joint.extrados).map(|f| f / length);
    let extrados = moment_about(joint.intrados).map(|f| -f / length);
    [intrados, extrados, [t.x, t.y, 0.0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
pub(super) mod tests;
