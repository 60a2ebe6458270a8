//! Linear programs with a handful of unknowns and very many inequalities, solved exactly by the dual simplex method.

use nalgebra::{SMatrix, SVector};
use std::ops::ControlFlow;

/// Unknowns of every program here: three redundants and the load factor.
pub const UNKNOWNS: usize = 4;
/// A point or a row.
pub type Row = SVector<f64, UNKNOWNS>;
type Basis = SMatrix<f64, UNKNOWNS, UNKNOWNS>;

/// The half space `row . x + constant >= 0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inequality {
    /// Normal, pointing inside.
    pub row: Row,
    /// Constant.
    pub constant: f64,
}

/// Outcome of a maximisation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Optimum {
    /// The largest value and where it is reached.
    At(f64, Row),
    /// Larger than any bound; the best point of the box.
    Unbounded(Row),
    /// No point satisfies all inequalities.
    Infeasible,
    /// Rounding kept the method from an answer, or who asked for it no longer wants one.
    Lost,
}

/// Unknowns are looked for within this box; the rows are expected to be scaled so that answers are of order one.
const BOX: f64 = 1e9;
/// A row (of unit length) may be violated by this, relative to the size of the point.
const TOLERANCE: f64 = 1e-12;

/// Far above what the method needs (about ten pivots); reached only if rounding defeats the tie rule.
const MOST_PIVOTS: usize = 10_000;

/// Asked at every pivot whether to go on. Where it breaks, what is returned is no answer.
pub type Beat<'b> = &'b dyn Fn() -> ControlFlow<()>;

/// Always goes on.
pub fn unwatched() -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Maximises `objective . x` over all `inequalities`, whose rows must have unit length.
///
/// Dual simplex from a corner of a large box: of the constraints in the basis one leaves for the most violated one,
/// until none is violated. Ties are broken lexicographically, as if the objective were perturbed by
/// (e, e^2, e^3, e^4), so that the method cannot cycle (Dantzig, Orden and Wolfe 1955).
pub fn maximise(objective: Row, inequalities: &[Inequality], beat: Beat) -> Optimum {
    solve(objective, inequalities, beat).0
}

/// Multipliers y >= 0 of the `inequalities` at the optimum, objective = - sum y row: the solution of the dual programme, at most
/// four of them not zero. None unless there is an optimum.
pub fn multipliers_at_optimum(objective: Row, inequalities: &[Inequality], beat: Beat) -> Option<Vec<f64>> {
    let (Optimum::At(..), basis) = solve(objective, inequalities, beat) else { return None };
    let inverse = Basis::from_fn(|i, j| basis[i].inequality.row[j]).try_inverse()?;
    let mut all = vec![0.0; inequalities.len()];
    for (active, multiplier) in basis.iter().zip(multipliers(&inverse, objective)) {
        if let Some(place) = active.place {
            all[place] = multiplier[0].max(0.0);
        }
    }
    Some(all)
}

/// A constraint of the basis: which of the inequalities it is, none where it is a wall of the box.
#[derive(Debug, Clone, Copy)]
struct Active {
    inequality: Inequality,
    place: Option<usize>,
}

fn solve(objective: Row, inequalities: &[Inequality], beat: Beat) -> (Optimum, [Active; UNKNOWNS]) {
    let bound = |i: usize, sign: f64| Inequality { row: Row::ith(i, -sign), constant: BOX };
    let wall = |i: usize, sign: f64| Active { inequality: bound(i, sign), place: None };
    // At the starting corner every unknown is at the bound its (perturbed) objective pushes it to.
    let mut basis: [Active; UNKNOWNS] = std::array::from_fn(|i| wall(i, corner_sign(objective[i])));
    let walls: Vec<Inequality> = (0..UNKNOWNS).flat_map(|i| [bound(i, 1.0), bound(i, -1.0)]).collect();
    for _ in 0..MOST_PIVOTS {
        if beat().is_break() {
            return (Optimum::Lost, basis);
        }
        let rows = Basis::from_fn(|i, j| basis[i].inequality.row[j]);
        let Some(inverse) = rows.try_inverse() else { return (Optimum::Lost, basis) };
        let point = -inverse * Row::from_fn(|i, _| basis[i].inequality.constant);
        let dual = multipliers(&inverse, objective);
        let Some(entering) = most_violated(&point, inequalities, &walls) else {
            let at_wall = basis.iter().zip(dual).any(|(active, y)| active.place.is_none() && y[0] > TOLERANCE);
            let optimum = if at_wall { Optimum::Unbounded(point) } else { Optimum::At(objective.dot(&point), point) };
            return (optimum, basis);
        };
        // Weights with which the entering row is a combination of the rows in the basis.
        let weights = inverse.transpose() * entering.inequality.row;
        let Some(leaving) = leaving(&weights, &dual) else { return (Optimum::Infeasible, basis) };
        basis[leaving] = entering;
    }
    (Optimum::Lost, basis)
}

fn most_violated(point: &Row, inequalities: &[Inequality], walls: &[Inequality]) -> Option<Active> {
    let size = point.abs();
    let mut worst = (0.0, None);
    let all = inequalities.iter().enumerate().map(|(place, inequality)| (Some(place), inequality));
    for (place, &inequality) in all.chain(walls.iter().map(|wall| (None, wall))) {
        let value = inequality.row.dot(point) + inequality.constant;
        // A value that is no number is taken for a violation, which ends in `Lost`.
        if value.is_nan() {
            return Some(Active { inequality, place });
        }
        if value < worst.0 && value < -TOLERANCE * (1.0 + inequality.row.abs().dot(&size)) {
            worst = (value, Some(Active { inequality, place }));
        }
    }
    worst.1
}

/// A multiplier with those of the four perturbations of the objective.
type Multiplier = [f64; UNKNOWNS + 1];

/// Multipliers y >= 0 of the rows in the basis: objective = - sum y_i row_i.
fn multipliers(inverse: &Basis, objective: Row) -> [Multiplier; UNKNOWNS] {
    let y = -inverse.transpose() * objective;
    std::array::from_fn(|i| {
        std::array::from_fn(|k| if k == 0 { y[i] } else { -inverse[(k - 1, i)] * corner_sign(objective[k - 1]) })
    })
}

/// Which way an unknown with this coefficient is pushed at the start.
fn corner_sign(coefficient: f64) -> f64 {
    if coefficient < 0.0 { -1.0 } else { 1.0 }
}

/// The row that leaves: the smallest ratio of multiplier over weight, ties broken lexicographically.
fn leaving(weights: &Row, dual: &[Multiplier; UNKNOWNS]) -> Option<usize> {
    let candidates = (0..UNKNOWNS).filter(|&i| weights[i] > 1e-13);
    candidates.min_by(|&a, &b| {
        let ratios = (0..=UNKNOWNS).map(|k| (dual[a][k] / weights[a], dual[b][k] / weights[b]));
        let differing = ratios.into_iter().find(|(x, y)| (x - y).abs() > 1e-11 * (x.abs() + y.abs()) + 1e-15);
        differing.map_or(a.cmp(&b), |(x, y)| x.total_cmp(&y))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn half_space(row: [f64; UNKNOWNS], constant: f64) -> Inequality {
        let row = Row::from(row);
        Inequality { row: row / row.norm(), constant: constant / row.norm() }
    }

    #[test]
    fn finds_the_corner_of_a_simplex() {
        let mut rows: Vec<_> = (0..UNKNOWNS).map(|i| Inequality { row: Row::ith(i, 1.0), constant: 0.0 }).collect();
        rows.push(half_space([-1.0, -2.0, -3.0, -4.0], 12.0));
        let Optimum::At(value, point) = maximise(Row::from([1.0, 1.0, 1.0, 1.0]), &rows, &unwatched) else { panic!() };
        assert!((value - 12.0).abs() < 1e-12 && (point[0] - 12.0).abs() < 1e-12);
    }

    #[test]
    fn tells_empty_and_unbounded_sets() {
        let x_between =
            |low: f64, high: f64| [half_space([1.0, 0.0, 0.0, 0.0], -low), half_space([-1.0, 0.0, 0.0, 0.0], high)];
        assert_eq!(maximise(Row::ith(3, 1.0), &x_between(2.0, 1.0), &unwatched), Optimum::Infeasible);
        assert!(matches!(maximise(Row::ith(3, 1.0), &x_between(1.0, 2.0), &unwatched), Optimum::Unbounded(_)));
        assert!(
            matches!(maximise(Row::ith(0, -1.0), &x_between(1.0, 2.0), &unwatched), Optimum::At(v, _) if (v + 1.0).abs() < 1e-12)
        );
    }

    #[test]
    fn a_heavily_tied_vertex_does_not_cycle() {
        // A cone of 400 half spaces through one point, the objective along its axis.
        let rows: Vec<_> = (0..400)
            .map(|i| {
                let a = f64::from(i) * 0.7;
                half_space([a.cos(), a.sin(), (1.7 * a).cos(), -1.0], 1.0)
            })
            .collect();
        let Optimum::At(value, _) = maximise(Row::ith(3, 1.0), &rows, &unwatched) else { panic!() };
        assert!((value - 1.0).abs() < 1e-12);
    }
}
