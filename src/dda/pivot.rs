//! LU of one 6 x 6 block.

#![allow(clippy::needless_range_loop, reason = "indices are the mathematics here")]

use super::block::{M6, V6};

/// LU of one 6 x 6 pivot block, rows exchanged by partial pivoting.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Pivot {
    /// L below the (unit) diagonal, U above it, reciprocal pivots on it.
    rows: [[f64; 6]; 6],
    order: [usize; 6],
    /// Smallest over largest pivot.
    pub(super) ratio: f64,
}

impl Pivot {
    /// Factors `a` and solves a X = b for six right-hand sides in the same sweep.
    ///
    /// Rows of [a | b] are kept together: an elimination step is one operation on twelve neighbours, which compilers
    /// turn into vector instructions.
    pub(super) fn factor(&mut self, a: &M6, b: &M6, x: &mut M6) {
        let mut rows = [[0.0; 12]; 6];
        for j in 0..6 {
            for i in 0..6 {
                (rows[i][j], rows[i][6 + j]) = (a[(i, j)], b[(i, j)]);
            }
        }
        self.order = [0, 1, 2, 3, 4, 5];
        let (mut smallest, mut largest, scale) = (f64::INFINITY, 0f64, a.amax().max(f64::MIN_POSITIVE / f64::EPSILON));
        for k in 0..6 {
            let best = (k + 1..6).fold(k, |best, i| if rows[i][k].abs() > rows[best][k].abs() { i } else { best });
            if best != k {
                rows.swap(k, best);
                self.rows.swap(k, best);
                self.order.swap(k, best);
            }
            // An exactly singular block is left singular to working precision: its inverse then points along the
            // mechanism, which is what the caller looks for.
            let pivot = if rows[k][k] == 0.0 { scale * f64::EPSILON } else { rows[k][k] };
            (smallest, largest) = (smallest.min(pivot.abs()), largest.max(pivot.abs()));
            let (reciprocal, pivot_row) = (1.0 / pivot, rows[k]);
            for i in k + 1..6 {
                let l = rows[i][k] * reciprocal;
                for (entry, above) in rows[i].iter_mut().zip(&pivot_row) {
                    *entry -= l * above;
                }
                self.rows[i][k] = l;
            }
            self.rows[k][k + 1..].copy_from_slice(&pivot_row[k + 1..6]);
            self.rows[k][k] = reciprocal;
        }
        self.ratio = smallest / largest;
        self.substitute_back(&mut rows, x);
    }

    /// Turns the right half of `rows` (forward-substituted) into the solution.
    fn substitute_back(&self, rows: &mut [[f64; 12]; 6], x: &mut M6) {
        for i in (0..6).rev() {
            let mut row: [f64; 6] = std::array::from_fn(|j| rows[i][6 + j]);
            for j in i + 1..6 {
                for (c, entry) in row.iter_mut().enumerate() {
                    *entry -= self.rows[i][j] * rows[j][6 + c];
                }
            }
            for (c, entry) in row.iter().enumerate() {
                rows[i][6 + c] = entry * self.rows[i][i];
                x[(i, c)] = rows[i][6 + c];
            }
        }
    }

    pub(super) fn solve(&self, b: &V6) -> V6 {
        let mut x: [f64; 6] = std::array::from_fn(|i| b[self.order[i]]);
        for i in 1..6 {
            for j in 0..i {
                x[i] -= self.rows[i][j] * x[j];
            }
        }
        for i in (0..6).rev() {
            for j in i + 1..6 {
                x[i] -= self.rows[i][j] * x[j];
            }
            x[i] *= self.rows[i][i];
        }
        V6::from(x)
    }
}
