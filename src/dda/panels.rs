//! Small dense matrices of differing shapes, one after the other in memory, and what is done with them.

use crate::budget::Budget;
use pulp::Simd;

/// Entries that are copied between two questions to the budget.
const ENTRIES_AT_ONCE: usize = 1 << 18;
/// Work of copying an entry to memory that is new, in multiplications.
const COPIED: usize = 4;

/// Matrices stored row by row, one after the other.
#[derive(Debug, Clone, Default)]
pub struct Panels {
    /// Where each begins, and where the last ends.
    start: Vec<usize>,
    entries: Vec<f64>,
}

impl Panels {
    /// Zero matrices of these shapes (rows, columns).
    pub fn zeros(shapes: impl IntoIterator<Item = (usize, usize)>) -> Self {
        let mut start = vec![0];
        let mut end = 0;
        for (rows, columns) in shapes {
            end += rows * columns;
            start.push(end);
        }
        Panels { start, entries: vec![0.0; end] }
    }

    /// The same again; zero from where it was stopped. Where there are many, the memory takes its time.
    pub fn copied(&self, budget: &Budget) -> Self {
        let mut entries = vec![0.0; self.entries.len()];
        for (into, from) in entries.chunks_mut(ENTRIES_AT_ONCE).zip(self.entries.chunks(ENTRIES_AT_ONCE)) {
            into.copy_from_slice(from);
            if budget.work(COPIED * from.len()).is_err() {
                break;
            }
        }
        Panels { start: self.start.clone(), entries }
    }

    /// Matrix `i`, row by row.
    pub fn get(&self, i: usize) -> &[f64] {
        &self.entries[self.start[i]..self.start[i + 1]]
    }

    /// Matrix `i`, row by row.
    pub fn get_mut(&mut self, i: usize) -> &mut [f64] {
        &mut self.entries[self.start[i]..self.start[i + 1]]
    }
}

/// Rows that are taken from another one, and numbers in them that are, at once.
pub const AT_ONCE: usize = 4;

/// Takes so many times each of some rows, `from` a column on, from `into`; the rows begin `width` apart. One row after the other, four of
/// them while numbers are at hand, and nothing is fused: on all processors the same to the last bit.
#[inline(always)]
pub fn subtract_rows<S: Simd>(simd: S, times: &[f64], rows: &[f64], [from, width]: [usize; 2], into: &mut [f64]) {
    let length = into.len();
    let row = |k: usize| &rows[k * width + from..][..length];
    let (by_four, rest) = times.as_chunks::<AT_ONCE>();
    // Faces have few ties.
    for (k, l) in by_four.iter().enumerate().filter(|(_, l)| l.iter().any(|l| *l != 0.0)) {
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| S::as_simd_f64s(row(AT_ONCE * k + i)));
        let (wide, single) = S::as_mut_simd_f64s(into);
        let times = l.map(|l| simd.splat_f64s(l));
        for ((entry, (&a, &b)), (&c, &d)) in wide.iter_mut().zip(a.0.iter().zip(b.0)).zip(c.0.iter().zip(d.0)) {
            let take = |left, i: usize, x| simd.sub_f64s(left, simd.mul_f64s(times[i], x));
            *entry = take(take(take(take(*entry, 0, a), 1, b), 2, c), 3, d);
        }
        for ((entry, (a, b)), (c, d)) in single.iter_mut().zip(a.1.iter().zip(b.1)).zip(c.1.iter().zip(d.1)) {
            *entry = *entry - l[0] * a - l[1] * b - l[2] * c - l[3] * d;
        }
    }
    for (k, l) in rest.iter().enumerate() {
        into.iter_mut().zip(row(AT_ONCE * by_four.len() + k)).for_each(|(entry, x)| *entry -= l * x);
    }
}

/// y -= a x.
pub fn subtract_applied(a: &[f64], x: &[f64], y: &mut [f64]) {
    match x.len() {
        0 => {}
        4 => subtract_applied_of(a, x, y, 4),
        8 => subtract_applied_of(a, x, y, 8),
        n => subtract_applied_of(a, x, y, n),
    }
}

/// Two rows at a time, so that x is read half as often.
#[inline(always)]
fn subtract_applied_of(a: &[f64], x: &[f64], y: &mut [f64], n: usize) {
    let ((by_two, last), height) = (x[..n].as_chunks::<2>(), y.len());
    let (pairs, single) = y.as_chunks_mut::<2>();
    for (rows, pair) in a.chunks_exact(2 * n).zip(pairs) {
        let (upper, lower) = rows.split_at(n);
        let mut sums = [[0.0; 2]; 2];
        for ((x, a), b) in by_two.iter().zip(upper.as_chunks::<2>().0).zip(lower.as_chunks::<2>().0) {
            (0..2).for_each(|lane| sums[0][lane] += a[lane] * x[lane]);
            (0..2).for_each(|lane| sums[1][lane] += b[lane] * x[lane]);
        }
        if let [x] = last {
            sums[0][0] += upper[n - 1] * x;
            sums[1][0] += lower[n - 1] * x;
        }
        (0..2).for_each(|row| pair[row] -= sums[row][0] + sums[row][1]);
    }
    if let [entry] = single {
        *entry -= dot(&a[(height - 1) * n..height * n], &x[..n]);
    }
}

/// y += a x, for `a` stored column by column: four columns at a time, so that y is read and written a fourth as often.
pub fn add_applied_columns(a: &[f64], x: &[f64], y: &mut [f64]) {
    let rows = y.len().max(1);
    let by_four = x.len() / 4 * 4;
    for (columns, x) in a.chunks_exact(4 * rows).zip(x.chunks_exact(4)) {
        let (left, right) = columns.split_at(2 * rows);
        let (pairs, more) = (left[..rows].iter().zip(&left[rows..]), right[..rows].iter().zip(&right[rows..]));
        for ((sum, (a, b)), (c, d)) in y.iter_mut().zip(pairs).zip(more) {
            *sum += a * x[0] + b * x[1] + c * x[2] + d * x[3];
        }
    }
    for (column, x) in a[by_four * rows..].chunks_exact(rows).zip(&x[by_four..]) {
        y.iter_mut().zip(column).for_each(|(sum, a)| *sum += a * x);
    }
}

/// Three numbers of a body with eight unknowns, row by row: a shape known to the compiler.
pub type ThreeOfEight = [[f64; 8]; 3];

/// a x.
#[inline(always)]
pub fn three_of_eight(a: &ThreeOfEight, x: &[f64; 8]) -> [f64; 3] {
    a.each_ref().map(|row| {
        let mut sums = [0.0; 2];
        for (a, x) in row.as_chunks::<2>().0.iter().zip(x.as_chunks::<2>().0) {
            (0..2).for_each(|lane| sums[lane] += a[lane] * x[lane]);
        }
        sums[0] + sums[1]
    })
}

/// a . x, in four sums side by side, which compilers turn into vector instructions.
#[inline(always)]
pub fn dot(a: &[f64], x: &[f64]) -> f64 {
    let (by_four, rest) = (a.chunks_exact(4).zip(x.chunks_exact(4)), a.len().min(x.len()) / 4 * 4);
    let mut sums = [0.0; 4];
    for (a, x) in by_four {
        (0..4).for_each(|lane| sums[lane] += a[lane] * x[lane]);
    }
    let tail: f64 = a[rest..].iter().zip(&x[rest..]).map(|(a, x)| a * x).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + tail
}
