//! The smallest of all motions that joints at their limits allow.

use crate::dda::Heart;
use nalgebra::{SMatrix, SVector};

/// Closure of the chain (two velocities and a spin) and power, per unit rate of a release.
pub(super) type Column = SVector<f64, 4>;

/// Work of looking at one column, in multiplications.
const WORK: usize = 20;

/// Smallest rates x >= 0 (in the sum of squares) with closure 0 and power 1.
///
/// The dual of this quadratic program is an unconstrained convex function of four multipliers y with
/// x = max(0, a . y); its stationary point is found by Newton's method with backtracking. None where the heart stands still.
pub(super) fn smallest_motion(columns: &[Column], heart: &Heart) -> Option<Vec<f64>> {
    let target = Column::new(0.0, 0.0, 0.0, 1.0);
    let rates = |y: &Column| -> Vec<f64> { columns.iter().map(|a| a.dot(y).max(0.0)).collect() };
    let value = |y: &Column| 0.5 * rates(y).iter().map(|x| x * x).sum::<f64>() - target.dot(y);
    let mut y = columns.iter().fold(Column::zeros(), |sum, a| sum + a * a.dot(&target).max(0.0));
    for _ in 0..200 {
        let x = rates(&y);
        let gradient = columns.iter().zip(&x).fold(-target, |g, (a, &x)| g + a * x);
        let scale = 1.0 + columns.iter().zip(&x).map(|(a, x)| a.norm() * x).sum::<f64>();
        if gradient.norm() < 1e-11 * scale {
            return Some(x);
        }
        let active = columns.iter().zip(&x).filter(|&(_, &x)| x > 0.0);
        let mut hessian = active.fold(SMatrix::<f64, 4, 4>::zeros(), |h, (a, _)| h + a * a.transpose());
        let ridge = 1e-14 * hessian.trace().max(1e-6);
        hessian += SMatrix::identity() * ridge;
        let step = hessian.lu().solve(&-gradient)?;
        let (before, slope) = (value(&y), gradient.dot(&step));
        let mut length = 1.0;
        while value(&(y + step * length)) > before + 1e-4 * length * slope + 1e-16 * before.abs() && length > 1e-12 {
            length *= 0.5;
            heart.work(WORK * columns.len()).ok()?;
        }
        heart.work(2 * WORK * columns.len()).ok()?;
        y += step * length;
        if !y.iter().all(|v| v.is_finite()) || y.norm() > 1e14 {
            return None;
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_feasible_and_no_feasible_motion_is_smaller() {
        // Six columns: a two-parameter family of rates closes the chain.
        let columns: Vec<Column> = [(1.0, 2.0), (-1.0, 0.5), (0.4, -1.5), (-0.7, -0.8), (1.3, 0.1), (-0.9, 1.1)]
            .iter()
            .enumerate()
            .map(|(i, &(x, y))| Column::new(x, y, if i % 2 == 0 { 1.0 } else { -1.0 }, 0.3 * i as f64 - 0.4))
            .collect();
        let x = smallest_motion(&columns, &Heart::unwatched()).unwrap();
        let sum = columns.iter().zip(&x).fold(Column::zeros(), |s, (a, x)| s + a * *x);
        assert!((sum - Column::new(0.0, 0.0, 0.0, 1.0)).norm() < 1e-9 && x.iter().all(|&x| x >= 0.0));
        // Along every direction of the null space that keeps x >= 0 the sum of squares only grows.
        let a = nalgebra::Matrix4x6::from_columns(
            &columns.iter().map(|c| c.fixed_rows::<4>(0).into_owned()).collect::<Vec<_>>(),
        );
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
    fn without_a_motion_there_is_none() {
        let columns = [Column::new(1.0, 0.0, 1.0, 1.0), Column::new(1.0, 1.0, 1.0, 1.0)];
        assert_eq!(smallest_motion(&columns, &Heart::unwatched()), None);
    }
}
