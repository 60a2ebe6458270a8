//! One constraint of a basis exchanged for another, and what depends on which are in it.

use super::inverse::invert_transposed;
use super::{Basis, Facet, HalfSpaces, corner_sign, dot, largest};

/// A row that enters with a weight below this share of the largest all but depends on what stays in the basis.
const DEPENDENT: f64 = 1e-9;
/// Weights below this share of the largest are none.
const NO_WEIGHT: f64 = 1e-13;
/// Ratios of a multiplier to a weight that differ by less than this share of them are equal.
const TIE: f64 = 1e-11;
/// So are those that differ by rounding, of few unknowns and of more, whose multipliers gather it over many pivots.
const EQUAL_RATIO: [f64; 2] = [1e-15, 1e-14];
const FEW: usize = 4;
/// Weights of an inverse that was carried on may be rounding from this share of the largest on, up to [`DEPENDENT`].
const ROUNDING: f64 = 1e-14;
/// Corrections of point and multipliers, each by no more than such a share of the largest, after which they are exact.
const CORRECTIONS: usize = 2;
const GOOD: f64 = 1e-10;

impl Basis {
    /// Weights with which the entering row is a combination of the rows in the basis.
    pub(super) fn weigh(&mut self, entering: Facet, half_spaces: &HalfSpaces) {
        let n = self.objective.len();
        for j in 0..n {
            self.row[j] = self.entry(half_spaces, entering, j);
        }
        for (weight, column) in self.weights.iter_mut().zip(self.inverse.chunks_exact(n)) {
            *weight = dot(column, &self.row);
        }
    }

    /// Whether the inverse was carried on and some weight may be rounding.
    pub(super) fn is_doubtful(&self) -> bool {
        let [low, high] = [ROUNDING, DEPENDENT].map(|share| share * self.scale());
        !self.fresh && self.weights.iter().any(|weight| weight.abs() > low && weight.abs() < high)
    }

    /// The largest weight; at least 1, that of a row that is in the basis.
    fn scale(&self) -> f64 {
        largest(&self.weights).max(1.0)
    }

    /// The constraint that leaves: the smallest ratio of multiplier over weight, ties broken lexicographically. One of hardly any weight is
    /// the last resort.
    pub(super) fn leaving(&self) -> Option<usize> {
        let (n, scale) = (self.objective.len(), self.scale());
        // The multiplier itself, then those of the perturbations of the objective.
        let ratio = |i: usize, k: usize| {
            let multiplier = match k {
                0 => self.dual[i],
                _ => -self.inverse[i * n + k - 1] * corner_sign(self.objective[k - 1]),
            };
            multiplier / self.weights[i]
        };
        let by_ratio = |&a: &usize, &b: &usize| {
            let ratios = (0..=n).map(|k| (ratio(a, k), ratio(b, k)));
            let rounding = match n <= FEW {
                true => EQUAL_RATIO[0],
                false => EQUAL_RATIO[1] * (1.0 / self.weights[a] + 1.0 / self.weights[b]),
            };
            let differing = ratios.into_iter().find(|(x, y)| (x - y).abs() > TIE * (x.abs() + y.abs()) + rounding);
            differing.map_or(a.cmp(&b), |(x, y)| x.total_cmp(&y))
        };
        let above = |share: f64| (0..n).filter(move |&i| self.weights[i] > share * scale).min_by(by_ratio);
        above(DEPENDENT).or_else(|| above(NO_WEIGHT))
    }

    /// Puts the entering constraint in the place of the leaving one.
    pub(super) fn exchange(&mut self, leaving: usize, entering: Facet) {
        let n = self.objective.len();
        let pivot = 1.0 / self.weights[leaving];
        let (before, rest) = self.inverse.split_at_mut(leaving * n);
        let (column, after) = rest.split_at_mut(n);
        column.iter_mut().for_each(|x| *x *= pivot);
        let y = self.dual[leaving] * pivot;
        let others = before.chunks_exact_mut(n).enumerate();
        let others = others.chain(after.chunks_exact_mut(n).enumerate().map(|(i, other)| (i + leaving + 1, other)));
        for (i, other) in others {
            let weight = self.weights[i];
            if weight == 0.0 {
                continue;
            }
            other.iter_mut().zip(&*column).for_each(|(x, c)| *x -= weight * c);
            self.dual[i] -= weight * y;
        }
        self.dual[leaving] = y;
        self.point.iter_mut().zip(&*column).for_each(|(x, c)| *x -= self.violation * c);
        self.constraints[leaving] = entering;
        (self.fresh, self.exact) = (false, false);
    }

    /// Corrects point and multipliers by what the rows themselves say; where they are off by much, computes the inverse anew, too. False
    /// where the rows depend on each other.
    pub(super) fn settle(&mut self, half_spaces: &HalfSpaces) -> bool {
        for _ in 0..CORRECTIONS {
            let moved = self.correct(half_spaces);
            if moved.is_nan() || moved > GOOD {
                return self.refresh(half_spaces);
            }
        }
        self.exact = true;
        true
    }

    /// One step of iterative refinement; how far point and multipliers move, as a share of the largest.
    fn correct(&mut self, half_spaces: &HalfSpaces) -> f64 {
        let n = self.objective.len();
        let sizes =
            [&self.point, &self.dual].map(|values| largest(values)).map(|size| if size > 0.0 { size } else { 1.0 });
        // What is left of the objective, and of every constraint.
        self.row.copy_from_slice(&self.objective);
        for (i, &constraint) in self.constraints.iter().enumerate() {
            self.weights[i] = self.entry(half_spaces, constraint, n);
            for j in 0..n {
                let entry = self.entry(half_spaces, constraint, j);
                self.weights[i] += entry * self.point[j];
                self.row[j] += entry * self.dual[i];
            }
        }
        let [mut moved, mut changed] = [(); 2].map(|()| vec![0.0; n]);
        for (i, column) in self.inverse.chunks_exact(n).enumerate() {
            moved.iter_mut().zip(column).for_each(|(step, c)| *step -= self.weights[i] * c);
            changed[i] = -dot(column, &self.row);
        }
        self.point.iter_mut().zip(&moved).for_each(|(x, step)| *x += step);
        self.dual.iter_mut().zip(&changed).for_each(|(y, step)| *y += step);
        largest(&[largest(&moved) / sizes[0], largest(&changed) / sizes[1]])
    }

    /// Computes inverse, point and multipliers from the rows themselves; false where the rows depend on each other.
    pub(super) fn refresh(&mut self, half_spaces: &HalfSpaces) -> bool {
        let n = self.objective.len();
        for i in 0..n {
            for j in 0..n {
                self.matrix[i * n + j] = self.entry(half_spaces, self.constraints[i], j);
            }
        }
        if !invert_transposed(&mut self.matrix, &mut self.inverse, n) {
            return false;
        }
        for (y, column) in self.dual.iter_mut().zip(self.inverse.chunks_exact(n)) {
            *y = -dot(column, &self.objective);
        }
        self.fresh = true;
        self.meet(half_spaces);
        // Where rows all but depend on each other, what the point is off by would pass for a violated constraint.
        self.correct(half_spaces).is_finite()
    }

    /// Computes the point from the constants of the constraints.
    pub(super) fn meet(&mut self, half_spaces: &HalfSpaces) {
        let n = self.objective.len();
        self.point.fill(0.0);
        for (i, column) in self.inverse.chunks_exact(n).enumerate() {
            let constant = self.entry(half_spaces, self.constraints[i], n);
            self.point.iter_mut().zip(column).for_each(|(x, c)| *x -= constant * c);
        }
        self.exact = self.fresh;
    }
}
