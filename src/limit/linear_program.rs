//! Linear programs with few unknowns and very many inequalities, solved exactly by the dual simplex method.

mod exchange;
mod half_spaces;
mod inverse;

pub use half_spaces::HalfSpaces;

use crate::budget::Budget;
use half_spaces::LANES;

/// Unknowns are looked for within this box; the rows are expected to be scaled so that answers are of order one.
const BOX: f64 = 1e9;
/// And within these in turn, where walls hold the point that was found and others are as good.
const SMALLER_BOXES: [f64; 3] = [1e1, 1e3, 1e6];
/// A row (of unit length) may be violated by this, relative to the size of the point.
const TOLERANCE: f64 = 1e-12;
/// Multipliers below 0 by this share of the largest prove nothing.
const NEGATIVE: f64 = 1e-9;
/// Far above what the method needs (two to five pivots an unknown); reached only if rounding defeats the tie rule.
const MOST_PIVOTS: usize = 10_000;
/// Pivots after which point and multipliers are corrected.
const SETTLE: usize = 32;

/// Outcome of a maximisation.
#[derive(Debug, Clone, PartialEq)]
pub enum Optimum {
    /// The largest value, where it is reached, and the rows that hold it there with their multipliers y > 0:
    /// objective = - sum y row.
    At(f64, Vec<f64>, Vec<(usize, f64)>),
    /// Larger than any bound; the best point of the box.
    Unbounded(Vec<f64>),
    /// No point satisfies all inequalities: these rows with their multipliers y > 0 add up to a negative constant.
    Infeasible(Vec<(usize, f64)>),
    /// Rounding kept the method from an answer, or who asked for it no longer wants one.
    Lost,
}

/// Exchanges constraints until none is violated.
fn climb(basis: &mut Basis, half_spaces: &HalfSpaces, budget: &Budget) -> Optimum {
    for pivot in 1..=MOST_PIVOTS {
        if budget.ask().is_err() {
            return Optimum::Lost;
        }
        let found = basis.most_violated(half_spaces);
        let MostViolated::Worst(entering) = found else {
            match found {
                MostViolated::NotANumber => return Optimum::Lost,
                _ if basis.exact => return basis.optimum(),
                _ => {}
            }
            if !basis.settle(half_spaces) {
                return Optimum::Lost;
            }
            continue;
        };
        basis.weigh(entering, half_spaces);
        if basis.is_doubtful() {
            if !basis.refresh(half_spaces) {
                return Optimum::Lost;
            }
            continue;
        }
        match basis.leaving() {
            Some(leaving) => basis.exchange(leaving, entering),
            None if basis.fresh => return Optimum::Infeasible(basis.contradiction(entering)),
            None => {
                if !basis.refresh(half_spaces) {
                    return Optimum::Lost;
                }
            }
        }
        if pivot % SETTLE == 0 && !basis.settle(half_spaces) {
            return Optimum::Lost;
        }
    }
    Optimum::Lost
}

/// A constraint: a row of the half spaces, or a wall of the box.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Facet {
    Row(usize),
    /// sign x >= - half the box for this unknown.
    Wall(usize, f64),
}

enum MostViolated {
    None,
    Worst(Facet),
    NotANumber,
}

/// As many constraints as there are unknowns, the point where they meet, and scratch memory.
///
/// Their multipliers stay what they are where half spaces are added, or shifted, so that the method goes on from it.
#[derive(Debug, Clone)]
pub struct Basis {
    objective: Vec<f64>,
    /// The largest an unknown may be.
    size: f64,
    constraints: Vec<Facet>,
    /// Columns of the inverse of the matrix of the constraints' rows, one after the other.
    inverse: Vec<f64>,
    point: Vec<f64>,
    /// Multipliers y >= 0: objective = - sum y row.
    dual: Vec<f64>,
    /// The entering row, how much it is violated, and its weights as a combination of the rows in the basis.
    row: Vec<f64>,
    violation: f64,
    weights: Vec<f64>,
    /// Whether the inverse was computed from the rows themselves.
    fresh: bool,
    /// Whether point and multipliers are as exact as the rows tell them.
    exact: bool,
    matrix: Vec<f64>,
}

impl Basis {
    /// The corner of the box where every unknown is at the bound that its (perturbed) objective pushes it to.
    pub fn new(objective: Vec<f64>) -> Self {
        let n = objective.len();
        let constraints = (0..n).map(|i| Facet::Wall(i, -corner_sign(objective[i]))).collect();
        let [mut inverse, matrix] = [(); 2].map(|()| vec![0.0; n * n]);
        let [point, mut dual, row, weights] = [(); 4].map(|()| vec![0.0; n]);
        for (i, coefficient) in objective.iter().enumerate() {
            let sign = corner_sign(*coefficient);
            inverse[i * n + i] = -sign;
            dual[i] = sign * coefficient;
        }
        Basis {
            objective,
            size: BOX,
            constraints,
            inverse,
            point,
            dual,
            row,
            violation: 0.0,
            weights,
            fresh: true,
            exact: false,
            matrix,
        }
    }

    /// Maximises `objective . x` over all `half_spaces`: those that it was last asked about, with any constants, and any behind them.
    ///
    /// Dual simplex, first from a corner of a large box: of the constraints in the basis one leaves for the most violated one,
    /// until none is violated. Ties are broken lexicographically, as if the objective were perturbed by (e, e^2, e^3, ...),
    /// so that the method cannot cycle (Dantzig, Orden and Wolfe 1955). Of the multipliers at most as many as there are unknowns
    /// are not zero. Of many points that are as good, as where wedged stones may press on each other as they like, one near by is
    /// told: in others what is of order one would be lost to rounding.
    pub fn go_on(&mut self, half_spaces: &HalfSpaces, budget: &Budget) -> Optimum {
        self.meet_in(BOX, half_spaces);
        let found = climb(self, half_spaces, budget);
        if !matches!(found, Optimum::At(..)) || !self.walls().any(|_| true) {
            return found;
        }
        // Multipliers do not depend on the size: the method goes on from where it is.
        let nearer = |size| {
            self.meet_in(size, half_spaces);
            climb(self, half_spaces, budget)
        };
        SMALLER_BOXES.into_iter().map(nearer).find(|nearer| matches!(nearer, Optimum::At(..))).unwrap_or(found)
    }

    /// Coefficient `j` of a constraint, its constant if `j` is the number of unknowns.
    fn entry(&self, half_spaces: &HalfSpaces, constraint: Facet, j: usize) -> f64 {
        match constraint {
            Facet::Row(row) => half_spaces.entry(row, j),
            Facet::Wall(_, _) if j == self.objective.len() => self.size,
            Facet::Wall(unknown, sign) if j == unknown => sign,
            Facet::Wall(..) => 0.0,
        }
    }

    fn most_violated(&mut self, half_spaces: &HalfSpaces) -> MostViolated {
        let (n, mut worst, mut found) = (self.objective.len(), 0.0, MostViolated::None);
        for (number, tile) in half_spaces.tiles.chunks_exact(n + 1).enumerate() {
            let mut values = tile[n];
            for (column, x) in tile.iter().zip(&self.point) {
                for lane in 0..LANES {
                    values[lane] += column[lane] * x;
                }
            }
            if values.iter().all(|value| *value >= worst) {
                continue;
            }
            for (lane, &value) in values.iter().enumerate() {
                // A value that is no number is taken for a violation, which ends in `Lost`.
                if value.is_nan() {
                    return MostViolated::NotANumber;
                }
                let size = || tile.iter().zip(&self.point).map(|(column, x)| (column[lane] * x).abs()).sum::<f64>();
                if value < worst && value < -TOLERANCE * (1.0 + size()) {
                    (worst, found) = (value, MostViolated::Worst(Facet::Row(number * LANES + lane)));
                }
            }
        }
        for (unknown, x) in self.point.iter().enumerate() {
            let value = self.size - x.abs();
            if value < worst && value < -TOLERANCE * (1.0 + x.abs()) {
                (worst, found) = (value, MostViolated::Worst(Facet::Wall(unknown, -x.signum())));
            }
        }
        self.violation = worst;
        found
    }

    /// The entering row, which the rows in the basis cannot satisfy, and those: it is a combination of them in which no weight is
    /// positive.
    fn contradiction(&self, entering: Facet) -> Vec<(usize, f64)> {
        let weighed = self.constraints.iter().zip(&self.weights).map(|(constraint, weight)| (*constraint, -weight));
        let rows = weighed.chain([(entering, 1.0)]).filter_map(|(constraint, y)| match constraint {
            Facet::Row(row) if y > 0.0 => Some((row, y)),
            _ => None,
        });
        rows.collect()
    }

    /// Multipliers of the walls of the box that are in the basis.
    fn walls(&self) -> impl Iterator<Item = f64> {
        let pairs = self.constraints.iter().zip(&self.dual);
        pairs.filter(|(constraint, _)| matches!(constraint, Facet::Wall(..))).map(|(_, &y)| y)
    }

    /// Finds the point where the same constraints meet in a box of this size.
    fn meet_in(&mut self, size: f64, half_spaces: &HalfSpaces) {
        self.size = size;
        self.meet(half_spaces);
    }

    /// No constraint is violated: the best point, if no multiplier is negative.
    fn optimum(&self) -> Optimum {
        let least = -NEGATIVE * largest(&self.dual);
        if self.dual.iter().any(|y| *y < least) {
            return Optimum::Lost;
        }
        let point = self.point.clone();
        if self.walls().any(|y| y > TOLERANCE) {
            return Optimum::Unbounded(point);
        }
        let held = self.constraints.iter().zip(&self.dual).filter_map(|(constraint, &y)| match *constraint {
            Facet::Row(row) if y > 0.0 => Some((row, y)),
            _ => None,
        });
        Optimum::At(dot(&self.objective, &point), point, held.collect())
    }
}

/// Which way an unknown with this coefficient is pushed at the start.
fn corner_sign(coefficient: f64) -> f64 {
    if coefficient < 0.0 { -1.0 } else { 1.0 }
}

/// The scalar product.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Size of the largest entry; NaN if there is one.
pub fn largest(a: &[f64]) -> f64 {
    a.iter().fold(0.0, |most, x| if x.is_nan() || x.abs() > most { x.abs() } else { most })
}

/// The Euclidean norm.
pub fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests;
