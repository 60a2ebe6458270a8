//! One quasi-static step: the increments of all bodies that balance their loads with contact forces and a resistance
//! proportional to mass, by a primal-dual interior-point method (Mehrotra's predictor and corrector).
//!
//! Unknown are the increments `q` of the bodies and, at every contact, the normal force `N` and the tangential force `T` on
//! the second body:
//!
//! ```text
//! K q = F + G_n' N + G_t' T            K: mass over the square of the time-like step
//! gap + G_n q = w >= 0,  N >= 0,  N w = 0
//! |T| <= b = slope N + constant        T = b where G_t q < 0, T = -b where G_t q > 0
//! ```
//!
//! With `slope` = 0 this is a convex quadratic programme. Everything is in units of the caller's that make loads and lengths
//! about one. The equations of an iteration tie bodies in contact; friction makes them unsymmetric, so that they are solved by
//! the same LU on a tree as those of the load path.

use super::constraint::{Constraint, Pair, Targets};
use crate::budget::Budget;
use crate::dda::elements::{Elements, Pattern};
use crate::dda::factor::Factor;
use crate::dda::tree::Tree;
use nalgebra::{Matrix3, Vector3};
use std::collections::BTreeMap;

/// Iterations after which a step has failed; ten to twenty are usual.
const MOST_STEP_ITERATIONS: usize = 80;
/// Work of one iteration over the number of contacts, in multiplications.
const ITERATED: usize = 1000;
/// Mean product of force and distance left at the end.
const CLOSED: f64 = 1e-10;
/// Largest residual left at the end.
const BALANCED_STEP: f64 = 1e-9;
/// Share of the way to the nearest bound that is gone.
const NEARLY: f64 = 0.995;
/// Forces and distances that the iteration starts from: the first from which it converges, which is nearly always the first.
const STARTS: [[f64; 2]; 3] = [[0.1, 0.01], [1.0, 0.01], [0.1, 1.0]];

/// A step to be made.
#[derive(Debug, Clone)]
pub(super) struct StepProblem {
    /// Resistance of every body, diagonal.
    pub resistance: Vec<Vector3<f64>>,
    /// Load on every body.
    pub load: Vec<Vector3<f64>>,
    /// All contacts.
    pub contacts: Vec<Constraint>,
}

/// A step made.
#[derive(Debug, Clone)]
pub(super) struct Solution {
    /// Increments of every body.
    pub increments: Vec<Vector3<f64>>,
    /// Normal and tangential force of every contact, the latter on the second body.
    pub forces: Vec<[f64; 2]>,
    /// Largest residual of equilibrium.
    pub residual: f64,
}

/// The iteration did not converge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct NotConverged;

/// Sum of products of what complements each other after `share` of the change, and how many they are.
fn products(problem: &StepProblem, pairs: &[Pair], changes: Option<(&[Pair], f64)>) -> (f64, usize) {
    let (mut sum, mut count) = (0.0, 0);
    for (c, contact) in problem.contacts.iter().enumerate() {
        let change = changes.map_or(Pair::NOTHING, |(all, _)| all[c]);
        let share = changes.map_or(0.0, |(_, share)| share);
        let all = contact.positives(&pairs[c], &change).map(|(value, by)| value + share * by);
        let used = if contact.rubs() { 3 } else { 1 };
        sum += all.chunks(2).take(used).map(|two| two[0] * two[1]).sum::<f64>();
        count += used;
    }
    (sum, count)
}

/// The largest share, at most 1, of a change that keeps everything positive.
fn largest_share(problem: &StepProblem, pairs: &[Pair], changes: &[Pair]) -> f64 {
    let mut share: f64 = 1.0;
    for ((contact, pair), change) in problem.contacts.iter().zip(pairs).zip(changes) {
        for (value, by) in contact.positives(pair, change) {
            if by < 0.0 {
                share = share.min(-value / by);
            }
        }
    }
    share
}

impl StepProblem {
    /// Makes the step.
    ///
    /// # Errors
    /// When the iteration converges from none of its starts, or where the budget is spent.
    pub(super) fn solve(&self, budget: &Budget) -> Result<Solution, NotConverged> {
        let (pattern, elements) = self.pattern();
        let tree = Tree::new(&pattern, |_| true, budget).map_err(|_| NotConverged)?;
        let mut system = System { elements, matrix: Elements::zeros(&pattern), factor: Factor::new(&tree) };
        STARTS.iter().find_map(|&start| self.solve_from(start, &mut system, budget).ok()).ok_or(NotConverged)
    }

    fn solve_from(&self, start: [f64; 2], system: &mut System<'_>, budget: &Budget) -> Result<Solution, NotConverged> {
        let mut increments = vec![Vector3::zeros(); self.load.len()];
        let mut pairs: Vec<Pair> = self.contacts.iter().map(|contact| contact.start(start)).collect();
        for _ in 0..MOST_STEP_ITERATIONS {
            budget.work(ITERATED * self.contacts.len()).map_err(|_| NotConverged)?;
            let unbalanced = self.unbalanced(&increments, &pairs);
            let apart: Vec<[f64; 2]> =
                self.contacts.iter().zip(&pairs).map(|(c, p)| c.residuals(p, &increments)).collect();
            let residual = unbalanced.iter().map(Vector3::amax).fold(0.0, f64::max);
            let gaping = apart.iter().flatten().fold(0.0, |most: f64, r| most.max(r.abs()));
            let (sum, count) = products(self, &pairs, None);
            let mean = sum / count.max(1) as f64;
            if mean < CLOSED && residual < BALANCED_STEP && gaping < BALANCED_STEP {
                let forces = pairs.iter().map(|pair| [pair.normal, pair.tangential]).collect();
                return Ok(Solution { increments, forces, residual });
            }
            let (step, changes) = self.direction(&pairs, &apart, &unbalanced, mean, system, budget)?;
            let share = (NEARLY * largest_share(self, &pairs, &changes)).min(1.0);
            if !share.is_finite() || share < 1e-10 {
                return Err(NotConverged);
            }
            increments.iter_mut().zip(&step).for_each(|(q, by)| *q += by * share);
            pairs.iter_mut().zip(&changes).for_each(|(pair, change)| pair.add(change, share));
        }
        Err(NotConverged)
    }

    /// Load and contact forces less resistance, per body.
    fn unbalanced(&self, increments: &[Vector3<f64>], pairs: &[Pair]) -> Vec<Vector3<f64>> {
        let mut left: Vec<Vector3<f64>> = (self.load.iter().zip(&self.resistance).zip(increments))
            .map(|((load, resistance), q)| load - resistance.component_mul(q))
            .collect();
        for (contact, pair) in self.contacts.iter().zip(pairs) {
            contact.spread(&mut left, [pair.normal, pair.tangential]);
        }
        left
    }

    /// Predictor and corrector with one factorisation.
    fn direction(
        &self,
        pairs: &[Pair],
        apart: &[[f64; 2]],
        unbalanced: &[Vector3<f64>],
        mean: f64,
        system: &mut System<'_>,
        budget: &Budget,
    ) -> Result<(Vec<Vector3<f64>>, Vec<Pair>), NotConverged> {
        let to_nothing = |pair: &Pair| -> Targets {
            [-pair.normal * pair.distance, -pair.room[0] * pair.slip[0], -pair.room[1] * pair.slip[1]]
        };
        let mut targets: Vec<Targets> = pairs.iter().map(to_nothing).collect();
        self.fill(pairs, apart, &targets, system);
        let mut solve = |targets: &[Targets], again: bool| {
            let mut step = unbalanced.to_vec();
            for (c, contact) in self.contacts.iter().enumerate() {
                contact.spread(&mut step, contact.linear(&pairs[c], apart[c], &targets[c]).base);
            }
            system.solve(&mut step, again, budget)?;
            let change = |(c, contact): (usize, &Constraint)| contact.change(&pairs[c], apart[c], &targets[c], &step);
            let changes: Vec<Pair> = self.contacts.iter().enumerate().map(change).collect();
            Ok((step, changes))
        };
        let (_, predicted) = solve(&targets, false)?;
        let (sum, count) = products(self, pairs, Some((&predicted, largest_share(self, pairs, &predicted))));
        let centred = mean * (sum / count.max(1) as f64 / mean).clamp(0.0, 1.0).powi(3);
        // Products far below what is asked for only make the equations worse conditioned.
        let centred = centred.max(0.1 * CLOSED);
        for (c, contact) in self.contacts.iter().enumerate() {
            let positives = contact.positives(&pairs[c], &predicted[c]);
            for (target, two) in targets[c].iter_mut().zip(positives.chunks(2)) {
                *target += centred - two[0].1 * two[1].1;
            }
        }
        solve(&targets, true)
    }

    /// What the equations tie: an element for every body, then one for every two that are in contact; and every contact's.
    fn pattern(&self) -> (Pattern, Vec<usize>) {
        let bodies = self.load.len();
        let mut faces: Vec<Vec<usize>> = (0..bodies).map(|body| vec![body]).collect();
        let mut known = BTreeMap::new();
        let element = |contact: &Constraint| match contact.bodies {
            [Some(a), Some(b)] => *known.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                faces.push(vec![a.min(b), a.max(b)]);
                faces.len() - 1
            }),
            [a, b] => a.or(b).unwrap_or(0),
        };
        let elements = self.contacts.iter().map(element).collect();
        (Pattern { start: (0..=bodies).map(|body| 3 * body).collect(), faces }, elements)
    }

    fn fill(&self, pairs: &[Pair], apart: &[[f64; 2]], targets: &[Targets], system: &mut System<'_>) {
        let bodies = self.load.len();
        for element in 0..bodies.max(system.elements.iter().map(|&e| e + 1).max().unwrap_or(0)) {
            system.matrix.get_mut(element).fill(0.0);
            system.factor.invalidate(element);
        }
        for (body, resistance) in self.resistance.iter().enumerate() {
            add(system.matrix.get_mut(body), 3, [0; 2], &Matrix3::from_diagonal(resistance));
        }
        for (c, contact) in self.contacts.iter().enumerate() {
            let stiffness = contact.linear(&pairs[c], apart[c], &targets[c]).stiffness;
            // rows[i]' * stiffness * rows[j]
            let block = |i: usize, j: usize| {
                let ([n, t], [m, s]) = (contact.rows[i], contact.rows[j]);
                n * m.transpose() * stiffness[0][0]
                    + t * (m.transpose() * stiffness[1][0] + s.transpose() * stiffness[1][1])
            };
            let entries = system.matrix.get_mut(system.elements[c]);
            match contact.bodies {
                [Some(a), Some(b)] => {
                    let place = [if a < b { 0 } else { 3 }, if a < b { 3 } else { 0 }];
                    for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                        add(entries, 6, [place[i], place[j]], &block(i, j));
                    }
                }
                [a, _] => {
                    let side = usize::from(a.is_none());
                    add(entries, 3, [0; 2], &block(side, side));
                }
            }
        }
    }
}

/// The equations of an iteration, and the element of every contact.
struct System<'t> {
    elements: Vec<usize>,
    matrix: Elements,
    factor: Factor<'t>,
}

impl System<'_> {
    /// Solves for a right-hand side, in its place; `again` with the factors of the last one.
    fn solve(&mut self, x: &mut [Vector3<f64>], again: bool, budget: &Budget) -> Result<(), NotConverged> {
        let b: Vec<f64> = x.iter().flat_map(|x| [x.x, x.y, x.z]).collect();
        let mut flat = vec![0.0; b.len()];
        let solved = match again {
            true => self.factor.solve(&b, &mut flat, budget),
            false => self.factor.update(&self.matrix, &b, &mut flat, 0, budget),
        };
        solved.map_err(|_| NotConverged)?;
        x.iter_mut().zip(flat.chunks(3)).for_each(|(x, flat)| *x = Vector3::from_column_slice(flat));
        if flat.iter().all(|x| x.is_finite()) { Ok(()) } else { Err(NotConverged) }
    }
}

/// Adds a block into a square matrix whose rows are `size` apart.
fn add(entries: &mut [f64], size: usize, [row, column]: [usize; 2], block: &Matrix3<f64>) {
    for i in 0..3 {
        for j in 0..3 {
            entries[(row + i) * size + column + j] += block[(i, j)];
        }
    }
}
