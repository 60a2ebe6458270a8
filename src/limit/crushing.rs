//! The limit window where joints crush: plastic sections of finite compressive strength.
//!
//! A normal force N = N_i + N_e at eccentricity e needs N / f of the joint's length t about its line of action, so
//! that t - 2 |e| >= N / f. With N_i = N (1/2 - e / t) and N_e = N (1/2 + e / t) this is N_i, N_e >= N^2 / (2 f t):
//! two parabolas a joint, which bound a convex set. Tangents of them are added to the linear programme of the rigid
//! arch until its answer lies on or within every parabola (cutting planes, Kelley 1960).

use super::linear_program::{Beat, Inequality, Optimum, Row, maximise};
use super::{StaticTheorem, Unsolved};

/// A parabola may be violated by this, relative to the loads and to the size of the point: ten times what the linear
/// programme grants its own rows, so that every cut moves the point.
const VIOLATED: f64 = 1e-11;
/// Where tangents so close together that rounding confuses them defeat the linear programme, its last answer is taken
/// if it violates no parabola by more than this: it is then as close to the end of the window, some 1e-7 of it.
const NEARLY: f64 = 1e-8;
/// A parabola this close is active; ten times the above, so that rounding hides no crushed joint.
const ACTIVE: f64 = 1e-7;
/// A joint crushes only under a normal force above this share of the loads.
const LOADED: f64 = 1e-6;
/// Rounds of cuts after which the method has failed (it needs five to thirty).
const MOST_ROUNDS: usize = 300;
/// Normal forces N / (f t) of the first tangents. The last says N_i, N_e <= f t / 2 and so bounds every force.
const FIRST_CUTS: [f64; 3] = [0.25, 0.5, 1.0];

/// Load factors in equilibrium with joints of finite strength.
#[derive(Debug, Clone, PartialEq)]
pub struct CrushingWindow {
    /// Lowest and highest, infinite where unbounded.
    pub ends: [f64; 2],
    /// Dry joints on their parabola at either end, under a normal force; none where the end is infinite.
    pub joints: [Vec<usize>; 2],
}

/// One dry joint of finite strength.
struct Section {
    joint: usize,
    /// f t, N/m.
    capacity: f64,
    /// Normal force, N/m, at intrados and extrados, over (unknowns; 1).
    corners: [(Row, f64); 2],
    /// Their sum.
    normal: (Row, f64),
}

impl Section {
    /// Half space below the tangent at N = `at` f t, of unit normal: F - a N + a^2 f t / 2 >= 0 for a corner force F.
    fn tangents(&self, at: f64) -> [Inequality; 2] {
        self.corners.map(|corner| {
            let row = corner.0 - self.normal.0 * at;
            let constant = corner.1 - self.normal.1 * at + 0.5 * at * at * self.capacity;
            Inequality { row: row / row.norm(), constant: constant / row.norm() }
        })
    }

    /// Normal force, N/m.
    fn normal(&self, point: &Row) -> f64 {
        self.normal.0.dot(point) + self.normal.1
    }

    /// Tangents at a point's normal force; their value there is that of the parabola.
    fn tangents_at(&self, point: &Row) -> [Inequality; 2] {
        self.tangents(self.normal(point) / self.capacity)
    }
}

/// Slack of an inequality at a point relative to the loads and the size of the point; negative where violated.
fn slack(inequality: &Inequality, point: &Row) -> f64 {
    let size = 1.0 + inequality.row.abs().dot(&point.abs());
    (inequality.row.dot(point) + inequality.constant) / size
}

impl StaticTheorem {
    /// Limit window with dry joints of compressive strength `strength`, Pa; None where nothing is in equilibrium.
    ///
    /// # Errors
    /// When rounding, or `beat`, kept the cutting planes from an answer, or the strength is not positive.
    pub fn crushing_window(&self, strength: f64, beat: Beat) -> Result<Option<CrushingWindow>, Unsolved> {
        if strength.is_nan() || strength <= 0.0 {
            return Err(Unsolved);
        }
        let sections = self.sections(strength);
        let mut inequalities = self.inequalities.clone();
        inequalities.extend(sections.iter().flat_map(|section| FIRST_CUTS.map(|at| section.tangents(at))).flatten());
        let mut window = CrushingWindow { ends: [0.0; 2], joints: [Vec::new(), Vec::new()] };
        for (end, sign) in [-1.0, 1.0].into_iter().enumerate() {
            let objective = Row::new(0.0, 0.0, 0.0, sign);
            match cut_until_inside(objective, &mut inequalities, &sections, beat)? {
                Optimum::At(value, point) => {
                    window.ends[end] = sign * value * self.factor;
                    window.joints[end] = self.crushed(&sections, &point);
                }
                Optimum::Unbounded(_) => window.ends[end] = sign * f64::INFINITY,
                Optimum::Infeasible | Optimum::Lost => return Ok(None),
            }
        }
        Ok(Some(window))
    }

    fn sections(&self, strength: f64) -> Vec<Section> {
        let dry = self.joints.iter().enumerate().filter(|(_, joint)| joint.law.coulomb().is_some());
        dry.map(|(k, joint)| {
            let [intrados, extrados, _] = self.forces[k];
            Section {
                joint: k,
                capacity: strength * joint.length(),
                corners: [intrados, extrados],
                normal: (intrados.0 + extrados.0, intrados.1 + extrados.1),
            }
        })
        .collect()
    }

    /// Joints with a parabola active at a point.
    fn crushed(&self, sections: &[Section], point: &Row) -> Vec<usize> {
        let active = |section: &&Section| {
            section.normal(point) > LOADED * self.force
                && section.tangents_at(point).iter().any(|tangent| slack(tangent, point) < ACTIVE)
        };
        sections.iter().filter(active).map(|section| section.joint).collect()
    }
}

/// Maximises over `inequalities` and the parabolas, adding the tangents that this takes. Never `Lost`.
fn cut_until_inside(
    objective: Row,
    inequalities: &mut Vec<Inequality>,
    sections: &[Section],
    beat: Beat,
) -> Result<Optimum, Unsolved> {
    let mut nearly = None;
    for _ in 0..MOST_ROUNDS {
        let optimum = maximise(objective, inequalities, beat);
        let point = match optimum {
            Optimum::At(_, point) | Optimum::Unbounded(point) => point,
            Optimum::Infeasible => return Ok(optimum),
            Optimum::Lost => return nearly.ok_or(Unsolved),
        };
        let tangents = || sections.iter().flat_map(|section| section.tangents_at(&point));
        let worst = tangents().map(|tangent| slack(&tangent, &point)).fold(0.0, f64::min);
        if worst >= -VIOLATED {
            return Ok(optimum);
        }
        nearly = (worst >= -NEARLY).then_some(optimum);
        inequalities.extend(tangents().filter(|tangent| slack(tangent, &point) < -VIOLATED));
    }
    nearly.ok_or(Unsolved)
}

#[cfg(test)]
mod tests;
