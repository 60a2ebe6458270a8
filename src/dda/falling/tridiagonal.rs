//! A chain of 3 x 3 blocks, each coupled to its neighbours: factors and solutions in time proportional to its length.

use nalgebra::{LU, Matrix3, U3, Vector3};

/// A block-tridiagonal matrix.
#[derive(Debug, Clone)]
pub(super) struct Tridiagonal {
    /// On the diagonal.
    pub diagonal: Vec<Matrix3<f64>>,
    /// Row `i`, column `i + 1`.
    pub upper: Vec<Matrix3<f64>>,
    /// Row `i + 1`, column `i`.
    pub lower: Vec<Matrix3<f64>>,
}

/// Its factors.
pub(super) struct Factors<'a> {
    pivots: Vec<LU<f64, U3, U3>>,
    matrix: &'a Tridiagonal,
}

impl Tridiagonal {
    /// Eliminates block after block; none where one is singular.
    pub(super) fn factor(&self) -> Option<Factors<'_>> {
        let mut pivots: Vec<LU<f64, U3, U3>> = Vec::with_capacity(self.diagonal.len());
        for (i, diagonal) in self.diagonal.iter().enumerate() {
            let block = match i.checked_sub(1) {
                Some(before) => diagonal - self.lower[before] * pivots[before].solve(&self.upper[before])?,
                None => *diagonal,
            };
            let pivot = block.lu();
            if !pivot.is_invertible() {
                return None;
            }
            pivots.push(pivot);
        }
        Some(Factors { pivots, matrix: self })
    }
}

impl Factors<'_> {
    /// The solution for a right-hand side, in its place.
    pub(super) fn solve(&self, x: &mut [Vector3<f64>]) {
        for i in 0..x.len() {
            if i > 0 {
                x[i] -= self.matrix.lower[i - 1] * x[i - 1];
            }
            self.pivots[i].solve_mut(&mut x[i]);
        }
        for i in (1..x.len()).rev() {
            let mut back = self.matrix.upper[i - 1] * x[i];
            self.pivots[i - 1].solve_mut(&mut back);
            x[i - 1] -= back;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_what_it_multiplies() {
        let some = |seed: f64| Matrix3::from_fn(|i, j| (seed + 1.7 * i as f64 + 2.9 * j as f64).sin());
        let n = 5;
        let matrix = Tridiagonal {
            diagonal: (0..n).map(|i| some(i as f64) + Matrix3::identity() * 5.0).collect(),
            upper: (1..n).map(|i| some(10.0 + i as f64)).collect(),
            lower: (1..n).map(|i| some(20.0 + i as f64)).collect(),
        };
        let x: Vec<_> = (0..n).map(|i| Vector3::new(i as f64, 1.0, -2.0 * i as f64)).collect();
        let mut b: Vec<_> = (0..n).map(|i| matrix.diagonal[i] * x[i]).collect();
        for i in 1..n {
            b[i] += matrix.lower[i - 1] * x[i - 1];
            b[i - 1] += matrix.upper[i - 1] * x[i];
        }
        matrix.factor().unwrap().solve(&mut b);
        assert!(b.iter().zip(&x).all(|(b, x)| (b - x).norm() < 1e-12));
    }
}
