//! LU of one small dense block.

#![allow(clippy::needless_range_loop, reason = "indices are the mathematics here")]

use super::panels::{AT_ONCE, dot, subtract_rows};
use crate::budget::{Budget, Stopped};
use pulp::{Arch, Simd, WithSimd};

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
    ///
    /// # Errors
    /// When stopped: there are no factors.
    pub(super) fn factor(
        &mut self,
        rows: &mut [f64],
        columns: usize,
        solved: &mut [f64],
        ends: &[usize],
        budget: &Budget,
    ) -> Result<(), Stopped> {
        match (self.n, columns) {
            (0, _) => self.ratio = f64::INFINITY,
            // Two contact points a joint: shapes known to the compiler run several times faster.
            (4, 4) => self.factor_fixed::<4, 8>(rows, solved, ends),
            (8, 0) => self.factor_fixed::<8, 8>(rows, solved, ends),
            (n, columns) => {
                let elimination = Elimination { pivot: self, size: [n, columns], rows, solved, ends, budget };
                return Arch::new().dispatch(elimination);
            }
        }
        Ok(())
    }

    /// Brings the row with the largest entry of column `k` to row `k`, of those from there on.
    fn choose(&mut self, k: usize, width: usize, rows: &mut [f64]) {
        let size = |i: usize| rows[i * width + k].abs();
        let best = (k + 1..self.n).fold(k, |best, i| if size(i) > size(best) { i } else { best });
        if best != k {
            let (above, below) = rows.split_at_mut(best * width);
            above[k * width..(k + 1) * width].swap_with_slice(&mut below[..width]);
            self.order.swap(k, best);
        }
    }

    /// The same where `W` numbers are in each of `N` rows. Whole rows, without asking which columns are left, take fewer
    /// instructions.
    fn factor_fixed<const N: usize, const W: usize>(&mut self, rows: &mut [f64], b: &mut [f64], ends: &[usize]) {
        let Some(rows) = rows.as_chunks_mut::<W>().0.first_chunk_mut::<N>() else { return };
        let (mut factors, mut order) = ([[0.0; N]; N], std::array::from_fn::<usize, N, _>(|i| i));
        let mut ratios = Ratios::new(ends);
        for k in 0..N {
            let (mut best, mut most) = (k, rows[k][k].abs());
            for i in k + 1..N {
                let size = rows[i][k].abs();
                (best, most) = if size > most { (i, size) } else { (best, most) };
            }
            if best != k {
                rows.swap(k, best);
                factors.swap(k, best);
                order.swap(k, best);
            }
            let pivot = regular(rows[k][k], rows.as_flattened());
            ratios.see(k, pivot);
            let (reciprocal, pivot_row) = (1.0 / pivot, rows[k]);
            for i in k + 1..N {
                let l = rows[i][k] * reciprocal;
                factors[i][k] = l;
                (0..W).for_each(|j| rows[i][j] -= l * pivot_row[j]);
            }
            factors[k][k] = reciprocal;
        }
        for i in (0..N).rev() {
            let mut row = rows[i];
            for j in i + 1..N {
                factors[i][j] = row[j];
                (N..W).for_each(|column| row[column] -= factors[i][j] * rows[j][column]);
            }
            (N..W).for_each(|column| row[column] *= factors[i][i]);
            rows[i] = row;
            b[i * (W - N)..(i + 1) * (W - N)].copy_from_slice(&row[N..]);
        }
        self.rows.clear();
        self.rows.extend_from_slice(factors.as_flattened());
        self.order.clear();
        self.order.extend_from_slice(&order);
        self.ratio = ratios.least;
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

/// What [`Pivot::factor`] does where the compiler does not know the shape, with the vector instructions that the processor has.
struct Elimination<'p> {
    pivot: &'p mut Pivot,
    size: [usize; 2],
    rows: &'p mut [f64],
    solved: &'p mut [f64],
    ends: &'p [usize],
    budget: &'p Budget<'p>,
}

impl WithSimd for Elimination<'_> {
    type Output = Result<(), Stopped>;

    /// Rows of [a | b] are kept together: an elimination step is one operation on neighbours, which compilers turn into
    /// vector instructions. Four columns are eliminated before what is right of them is touched, so that it is read and written a
    /// fourth as often.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Elimination { pivot: factors, size: [n, columns], rows, solved, ends, budget } = self;
        let width = n + columns;
        let rows = &mut rows[..n * width];
        factors.rows.resize(n * n, 0.0);
        factors.order.clear();
        factors.order.extend(0..n);
        let mut ratios = Ratios::new(ends);
        for first in (0..n).step_by(AT_ONCE) {
            let end = n.min(first + AT_ONCE);
            for k in first..end {
                factors.choose(k, width, rows);
                let pivot = regular(rows[k * width + k], rows);
                ratios.see(k, pivot);
                rows[k * width + k] = 1.0 / pivot;
                let (above, below) = rows.split_at_mut((k + 1) * width);
                let (before, row) = above.split_at_mut(k * width);
                let (left, right) = row.split_at_mut(end);
                subtract_rows(simd, &left[first..k], &before[first * width..], [end, width], right);
                for row in below.chunks_exact_mut(width) {
                    let l = row[k] * left[k];
                    row[k] = l;
                    row[k + 1..end].iter_mut().zip(&left[k + 1..]).for_each(|(entry, above)| *entry -= l * above);
                }
            }
            let (above, below) = rows.split_at_mut(end * width);
            for row in below.chunks_exact_mut(width) {
                let (left, right) = row.split_at_mut(end);
                subtract_rows(simd, &left[first..], &above[first * width..], [end, width], right);
            }
            budget.work((end - first) * (n - first) * (width - first))?;
        }
        for i in (0..n).rev() {
            let (above, below) = rows.split_at_mut((i + 1) * width);
            let (left, right) = above[i * width..].split_at_mut(n);
            subtract_rows(simd, &left[i + 1..], below, [n, width], right);
            right.iter_mut().for_each(|entry| *entry *= left[i]);
            factors.rows[i * n..(i + 1) * n].copy_from_slice(left);
            solved[i * columns..(i + 1) * columns].copy_from_slice(right);
            budget.work((n - i) * columns)?;
        }
        factors.ratio = ratios.least;
        Ok(())
    }
}

/// A pivot, or where that is zero, one that is so to working precision: an exactly singular block's inverse then points along
/// the mechanism, which is what the caller looks for.
#[inline(always)]
fn regular(pivot: f64, rows: &[f64]) -> f64 {
    if pivot != 0.0 {
        return pivot;
    }
    f64::EPSILON * rows.iter().fold(f64::MIN_POSITIVE / f64::EPSILON, |scale, x| scale.max(x.abs()))
}

/// The least ratio of the smallest to the largest pivot within a group of columns.
struct Ratios<'e> {
    least: f64,
    smallest: f64,
    largest: f64,
    ends: &'e [usize],
}

impl<'e> Ratios<'e> {
    fn new(ends: &'e [usize]) -> Self {
        Ratios { least: f64::INFINITY, smallest: f64::INFINITY, largest: 0.0, ends }
    }

    /// Takes in the pivot of column `k`.
    #[inline(always)]
    fn see(&mut self, k: usize, pivot: f64) {
        (self.smallest, self.largest) = (self.smallest.min(pivot.abs()), self.largest.max(pivot.abs()));
        if self.ends.first().is_none_or(|&end| k + 1 >= end) {
            self.least = self.least.min(self.smallest / self.largest);
            (self.smallest, self.largest) = (f64::INFINITY, 0.0);
            self.ends = self.ends.get(1..).unwrap_or_default();
        }
    }
}

#[cfg(test)]
mod tests;
