//! LU of one small dense block.

#![allow(clippy::needless_range_loop, reason = "indices are the mathematics here")]

use super::panels::dot;

/// LU of one pivot block, rows exchanged by partial pivoting.
#[derive(Debug, Clone, Default)]
pub(super) struct Pivot {
    n: usize,
    /// L below the (unit) diagonal, U above it, reciprocal pivots on it, row by row.
    rows: Vec<f64>,
    order: Vec<usize>,
    /// Smallest over largest pivot within a group of columns.
    pub(super) ratio: f64,
}

impl Pivot {
    /// For a block of `n` rows, which takes its memory when it is factored.
    pub(super) fn new(n: usize) -> Self {
        Pivot { n, rows: Vec::new(), order: Vec::new(), ratio: f64::INFINITY }
    }

    /// Factors a and solves a X = b for all `columns` of b in the same sweep, given as `rows` of [a | b], which are used up; X goes
    /// to `solved`, row by row. `ends` of the groups of columns within which pivots are compared: what is left for later ones
    /// may be softer by far.
    pub(super) fn factor(&mut self, rows: &mut [f64], columns: usize, solved: &mut [f64], ends: &[usize]) {
        match (self.n, columns) {
            (0, _) => self.ratio = f64::INFINITY,
            // Two contact points a joint: shapes known to the compiler run several times faster.
            (4, 4) => self.factor_of(4, 4, rows, solved, ends),
            (8, 0) => self.factor_of(8, 0, rows, solved, ends),
            (n, columns) => self.factor_of(n, columns, rows, solved, ends),
        }
    }

    /// Rows of [a | b] are kept together: an elimination step is one operation on neighbours, which compilers turn into
    /// vector instructions.
    #[inline(always)]
    fn factor_of(&mut self, n: usize, columns: usize, rows: &mut [f64], b: &mut [f64], ends: &[usize]) {
        let width = n + columns;
        let rows = &mut rows[..n * width];
        self.rows.resize(n * n, 0.0);
        self.order.resize(n, 0);
        self.order.iter_mut().enumerate().for_each(|(i, place)| *place = i);
        let of_a = rows.chunks_exact(width).flat_map(|row| &row[..n]);
        let scale = of_a.fold(f64::MIN_POSITIVE / f64::EPSILON, |scale, x| scale.max(x.abs()));
        self.ratio = f64::INFINITY;
        let (mut smallest, mut largest, mut ends) = (f64::INFINITY, 0f64, ends.iter());
        let mut end = ends.next();
        for k in 0..n {
            let size = |i: usize| rows[i * width + k].abs();
            let best = (k + 1..n).fold(k, |best, i| if size(i) > size(best) { i } else { best });
            if best != k {
                let (above, below) = rows.split_at_mut(best * width);
                above[k * width..(k + 1) * width].swap_with_slice(&mut below[..width]);
                self.order.swap(k, best);
            }
            // An exactly singular block is left singular to working precision: its inverse then points along the
            // mechanism, which is what the caller looks for.
            let pivot = if rows[k * width + k] == 0.0 { scale * f64::EPSILON } else { rows[k * width + k] };
            (smallest, largest) = (smallest.min(pivot.abs()), largest.max(pivot.abs()));
            if end.is_none_or(|&end| k + 1 >= end) {
                self.ratio = self.ratio.min(smallest / largest);
                (smallest, largest, end) = (f64::INFINITY, 0.0, ends.next());
            }
            let reciprocal = 1.0 / pivot;
            let (above, below) = rows.split_at_mut((k + 1) * width);
            let pivot_row = &mut above[k * width..];
            pivot_row[k] = reciprocal;
            for row in below.chunks_exact_mut(width) {
                let l = row[k] * reciprocal;
                row[k] = l;
                for (entry, above) in row[k + 1..].iter_mut().zip(&pivot_row[k + 1..]) {
                    *entry -= l * above;
                }
            }
        }
        for i in (0..n).rev() {
            let (above, below) = rows.split_at_mut((i + 1) * width);
            let row = &mut above[i * width..];
            let (left, right) = row.split_at_mut(n);
            for (j, other) in (i + 1..n).zip(below.chunks_exact(width)) {
                for (entry, x) in right.iter_mut().zip(&other[n..]) {
                    *entry -= left[j] * x;
                }
            }
            right.iter_mut().for_each(|entry| *entry *= left[i]);
            self.rows[i * n..(i + 1) * n].copy_from_slice(left);
            b[i * columns..(i + 1) * columns].copy_from_slice(right);
        }
    }

    /// Solves a x = b in place. `work` is scratch.
    pub(super) fn solve(&self, x: &mut [f64], work: &mut Vec<f64>) {
        match self.n {
            4 => self.solve_of(4, x, work),
            8 => self.solve_of(8, x, work),
            n => self.solve_of(n, x, work),
        }
    }

    #[inline(always)]
    fn solve_of(&self, n: usize, x: &mut [f64], work: &mut Vec<f64>) {
        work.clear();
        work.extend(self.order[..n].iter().map(|&i| x[i]));
        x[..n].copy_from_slice(&work[..n]);
        for i in 1..n {
            let (before, here) = x.split_at_mut(i);
            here[0] -= dot(&self.rows[i * n..i * n + i], before);
        }
        for i in (0..n).rev() {
            let (before, after) = x.split_at_mut(i + 1);
            let row = &self.rows[i * n..(i + 1) * n];
            before[i] = (before[i] - dot(&row[i + 1..], after)) * row[i];
        }
    }
}
