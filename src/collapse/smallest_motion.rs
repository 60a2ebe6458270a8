//! The smallest of all motions that joints at their limits allow; the only file of this room that knows faer.

use crate::budget::Budget;
use faer::linalg::solvers::{Llt, Solve};
use faer::{MatMut, MatRef, Side};
use nalgebra::{DMatrix, DVector};

/// Closure of the loops (two velocities and a spin each) and, last, power, per unit rate of a release: the entries that are not
/// zero.
pub(super) type Column = Vec<(usize, f64)>;

/// Work of looking at one entry of a column, in multiplications.
const ENTRY_WORK: usize = 5;
/// More unknowns than this are worth a Cholesky decomposition, half the work, before the surer one with exchanges of rows.
const MANY: usize = 60;
/// What rounding may leave of a value, as a share of it.
const VALUE_ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Smallest rates x >= 0 (in the sum of squares) with closure 0 and power 1, of columns with so many `unknowns`.
///
/// The dual of this quadratic program is an unconstrained convex function of as many multipliers y with
/// x = max(0, a . y); its stationary point is found by Newton's method with backtracking. None where the budget is spent.
pub(super) fn smallest_motion(columns: &[Column], unknowns: usize, budget: &Budget) -> Option<Vec<f64>> {
    let last = unknowns - 1;
    let product = |a: &Column, y: &DVector<f64>| a.iter().map(|&(i, a)| a * y[i]).sum::<f64>();
    let rates = |y: &DVector<f64>| -> Vec<f64> { columns.iter().map(|a| product(a, y).max(0.0)).collect() };
    let value = |y: &DVector<f64>| 0.5 * rates(y).iter().map(|x| x * x).sum::<f64>() - y[last];
    let power = |a: &Column| a.iter().find(|(i, _)| *i == last).map_or(0.0, |(_, power)| power.max(0.0));
    let norm = |a: &Column| a.iter().map(|(_, a)| a * a).sum::<f64>().sqrt();
    let work = ENTRY_WORK * columns.iter().map(Vec::len).sum::<usize>();
    let mut y = DVector::zeros(unknowns);
    for column in columns {
        column.iter().for_each(|&(i, a)| y[i] += a * power(column));
    }
    for _ in 0..200 {
        let x = rates(&y);
        let mut gradient = DVector::zeros(unknowns);
        gradient[last] = -1.0;
        let mut hessian = DMatrix::<f64>::zeros(unknowns, unknowns);
        // Rates are as exact as multipliers, which grow as the loads hardly do work.
        let (mut scale, mut rounding) = (1.0, 0.0);
        for (column, &x) in columns.iter().zip(&x).filter(|&(_, &x)| x > 0.0) {
            scale += norm(column) * x;
            rounding += f64::EPSILON * norm(column).powi(2) * y.norm();
            for &(i, a) in column {
                gradient[i] += a * x;
                column.iter().for_each(|&(j, b)| hessian[(i, j)] += a * b);
            }
        }
        if gradient.norm() < (1e-11 * scale + rounding).min(CLOSURE[0] * scale) {
            return Some(x);
        }
        let ridge = 1e-14 * hessian.trace().max(1e-6);
        (0..unknowns).for_each(|i| hessian[(i, i)] += ridge);
        budget.work(unknowns.pow(3) / 3).ok()?;
        let step = match (unknowns > MANY).then(|| cholesky(&hessian)).flatten() {
            Some(factors) => solved(&factors, -&gradient),
            None => hessian.lu().solve(&-&gradient)?,
        };
        let (before, slope) = (value(&y), gradient.dot(&step));
        let mut length = 1.0;
        while value(&(&y + &step * length)) > before + 1e-4 * length * slope + VALUE_ROUNDING * before.abs()
            && length > 1e-12
        {
            length *= 0.5;
            budget.work(work).ok()?;
        }
        budget.work(2 * work).ok()?;
        y += step * length;
        if !y.iter().all(|v| v.is_finite()) || y.norm() > 1e14 {
            return None;
        }
    }
    None
}

/// The factors of a positive definite matrix.
fn cholesky(matrix: &DMatrix<f64>) -> Option<Llt<f64>> {
    Llt::new(MatRef::from_column_major_slice(matrix.as_slice(), matrix.nrows(), matrix.ncols()), Side::Lower).ok()
}

fn solved(factors: &Llt<f64>, mut right: DVector<f64>) -> DVector<f64> {
    let rows = right.len();
    factors.solve_in_place(MatMut::from_column_major_slice_mut(right.as_mut_slice(), rows, 1));
    right
}

/// Corrections of a motion that is nearly closed.
const MOTION_CORRECTIONS: usize = 30;
/// Added to the matrix of the correction, whose diagonal is 1: releases of one joint may depend on each other.
const CORRECTION_RIDGE: f64 = 1e-12;
/// Closure and power may be off by this, relative to what the parts come to; corrections stop at the second.
const CLOSURE: [f64; 2] = [1e-9, 1e-14];
/// Rates below minus this share of the fastest run backwards.
const BACKWARDS: f64 = 1e-4;

/// Rates x >= 0 with closure 0 and power 1 next to `rates` that have them nearly, in proportion; None where the corrections (least
/// squares by the normal equations, repeated) do not close them or some rate turns round.
pub(super) fn nearest_motion(columns: &[Column], unknowns: usize, rates: &[f64]) -> Option<Vec<f64>> {
    let (last, count) = (unknowns - 1, columns.len());
    let norms: Vec<f64> = columns.iter().map(|a| a.iter().map(|(_, a)| a * a).sum::<f64>().sqrt()).collect();
    let mut gram = DMatrix::<f64>::zeros(count, count);
    for (j, column) in columns.iter().enumerate() {
        let mut dense = vec![0.0; unknowns];
        column.iter().for_each(|&(i, a)| dense[i] += a / norms[j]);
        for (i, other) in columns.iter().enumerate().skip(j) {
            gram[(i, j)] = other.iter().map(|&(k, a)| a * dense[k]).sum::<f64>() / norms[i];
        }
        gram[(j, j)] += CORRECTION_RIDGE;
    }
    let factors = cholesky(&gram)?;
    let missing = |x: &[f64]| {
        let mut rest = vec![0.0; unknowns];
        rest[last] = 1.0;
        for (column, x) in columns.iter().zip(x) {
            column.iter().for_each(|&(i, a)| rest[i] -= a * x);
        }
        rest
    };
    let power = 1.0 - missing(rates)[last];
    let mut x: Vec<f64> = rates.iter().map(|rate| rate / power).collect();
    let off = |x: &[f64], rest: &[f64]| {
        let size = 1.0 + norms.iter().zip(x).map(|(norm, x)| norm * x.abs()).sum::<f64>();
        rest.iter().map(|r| r * r).sum::<f64>().sqrt() / size
    };
    for _ in 0..MOTION_CORRECTIONS {
        let rest = missing(&x);
        if off(&x, &rest) < CLOSURE[1] {
            break;
        }
        let along = |(column, norm): (&Column, &f64)| column.iter().map(|&(i, a)| a * rest[i]).sum::<f64>() / norm;
        let right = DVector::from_iterator(count, columns.iter().zip(&norms).map(along));
        let step = solved(&factors, right);
        (0..count).for_each(|i| x[i] += step[i] / norms[i]);
    }
    let fastest = x.iter().copied().fold(0.0, f64::max);
    if !x.iter().all(|&rate| rate >= -BACKWARDS * fastest) {
        return None;
    }
    let forward: Vec<usize> = (0..count).filter(|&i| x[i] >= 0.0).collect();
    if forward.len() < count {
        // What barely turns round stands still.
        let (kept, of_kept): (Vec<Column>, Vec<f64>) = forward.iter().map(|&i| (columns[i].clone(), x[i])).unzip();
        let of_kept = nearest_motion(&kept, unknowns, &of_kept)?;
        x.fill(0.0);
        forward.iter().zip(of_kept).for_each(|(&i, rate)| x[i] = rate);
        return Some(x);
    }
    (off(&x, &missing(&x)) < CLOSURE[0]).then_some(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motion_that_nearly_closes_is_closed_and_one_that_cannot_be_is_none() {
        // Rates 2, 1 close the first unknown; the second is the power.
        let columns: Vec<Column> = vec![vec![(0, 1.0), (1, 0.5)], vec![(0, -2.0), (1, 1.0)]];
        let x = nearest_motion(&columns, 2, &[3.0, 1.4]).unwrap();
        assert!((x[0] - 1.0).abs() < 1e-9 && (x[1] - 0.5).abs() < 1e-9, "{x:?}");
        let opposed: Vec<Column> = vec![vec![(0, 1.0), (1, 0.5)], vec![(0, 2.0), (1, 1.0)]];
        assert_eq!(nearest_motion(&opposed, 2, &[1.0, 1.0]), None);
    }

    #[test]
    fn is_feasible_and_no_feasible_motion_is_smaller() {
        // Six columns: a two-parameter family of rates closes the chain.
        let columns: Vec<Column> = [(1.0, 2.0), (-1.0, 0.5), (0.4, -1.5), (-0.7, -0.8), (1.3, 0.1), (-0.9, 1.1)]
            .iter()
            .enumerate()
            .map(|(i, &(x, y))| [x, y, if i % 2 == 0 { 1.0 } else { -1.0 }, 0.3 * i as f64 - 0.4])
            .map(|column| column.into_iter().enumerate().collect())
            .collect();
        let x = smallest_motion(&columns, 4, &Budget::unlimited()).unwrap();
        let vector = |column: &Column| nalgebra::Vector4::from_fn(|i, _| column[i].1);
        let sum = columns.iter().zip(&x).fold(nalgebra::Vector4::zeros(), |s, (a, x)| s + vector(a) * *x);
        assert!((sum - nalgebra::Vector4::new(0.0, 0.0, 0.0, 1.0)).norm() < 1e-9 && x.iter().all(|&x| x >= 0.0));
        // Along every direction of the null space that keeps x >= 0 the sum of squares only grows.
        let a = nalgebra::Matrix4x6::from_columns(&columns.iter().map(vector).collect::<Vec<_>>());
        let projector = nalgebra::Matrix6::identity() - a.transpose() * (a * a.transpose()).try_inverse().unwrap() * a;
        for (i, sign) in (0..6).flat_map(|i| [(i, 1e-4), (i, -1e-4)]) {
            let step = projector.column(i) * sign;
            let moved: Vec<f64> = x.iter().zip(step.iter()).map(|(x, s)| x + s).collect();
            if moved.iter().all(|&m| m >= 0.0) {
                let squares = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>();
                assert!(squares(&moved) >= squares(&x) - 1e-12);
            }
        }
    }

    #[test]
    fn loads_that_hardly_do_work_have_a_motion() {
        // The thick embankment of figure 10 of the paper at an abscissa of 11.75 m: six hinges, symmetric.
        let hinge = |x: f64, y: f64, spin: f64, power: f64| vec![(0, x), (1, y), (2, spin), (3, power)];
        let columns = [
            hinge(-0.02513662460575543, 0.7359281540119466, 1.0, -0.0),
            hinge(-0.3300416565703881, -0.7212522940671748, -1.0, 0.016157128931135162),
            hinge(0.9934028390272986, 0.1835521807170714, 1.0, -0.20209238430487655),
            hinge(0.9934028390272986, -0.1835521807170714, 1.0, -0.3141487398244732),
            hinge(-0.3300416565703881, 0.7212522940671748, -1.0, 0.45647281010462076),
            hinge(-0.02513662460575543, -0.7359281540119466, 1.0, -0.4492751137070714),
        ];
        let x = smallest_motion(&columns, 4, &Budget::unlimited()).unwrap();
        assert!((0..3).all(|i| (x[i] / x[5 - i] - 1.0).abs() < 1e-6), "{x:?}");
    }

    #[test]
    fn a_motion_that_closes_but_for_a_little_is_none() {
        // The first unknown wants equal rates, which the second lets no rate but 0 have; multipliers grow as it fades.
        for off in [1e-5, 1e-6, 1e-7] {
            let columns = vec![vec![(0, 1.0), (2, 1.0)], vec![(0, -1.0), (1, off), (2, -0.5)]];
            assert_eq!(smallest_motion(&columns, 3, &Budget::unlimited()), None, "{off}");
        }
    }

    #[test]
    fn without_a_motion_there_is_none() {
        let columns = [[1.0, 0.0, 1.0, 1.0], [1.0; 4]].map(|column| column.into_iter().enumerate().collect());
        assert_eq!(smallest_motion(&columns, 4, &Budget::unlimited()), None);
    }
}
