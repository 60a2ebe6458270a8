//! Block LU of a block tridiagonal matrix, pivoting inside the blocks.
//!
//! The matrix is eliminated from both ends towards the block row that changed last (a twisted factorisation), so that
//! the next change costs only the rows between the two.

use super::block::{M6, V6};
use super::pivot::Pivot;

/// A block tridiagonal matrix of 6 x 6 blocks.
#[derive(Debug, Clone, Default)]
pub struct Tridiagonal {
    /// K(i, i).
    pub diagonal: Vec<M6>,
    /// K(i, i + 1).
    pub upper: Vec<M6>,
    /// K(i + 1, i).
    pub lower: Vec<M6>,
}

/// Elimination from one end: row 0 is the first eliminated.
#[derive(Debug, Clone)]
struct Sweep {
    reversed: bool,
    pivots: Vec<Pivot>,
    /// S_i^-1 K(i, next).
    ahead: Vec<M6>,
    /// Smallest pivot ratio of rows 0..=i.
    ratio: Vec<f64>,
    /// Forward substitution of the kept right-hand side.
    forward: Vec<V6>,
    /// How many rows are eliminated and current.
    current: usize,
}

impl Sweep {
    fn new(n: usize, reversed: bool) -> Self {
        Sweep {
            reversed,
            pivots: vec![Pivot::default(); n],
            ahead: vec![M6::zeros(); n],
            ratio: vec![f64::INFINITY; n],
            forward: vec![V6::zeros(); n],
            current: 0,
        }
    }

    /// Place of row `i` of this sweep in the matrix.
    fn place(&self, i: usize) -> usize {
        if self.reversed { self.pivots.len() - 1 - i } else { i }
    }

    /// K(i, i + 1) in the order of this sweep.
    fn next<'m>(&self, k: &'m Tridiagonal, i: usize) -> &'m M6 {
        if self.reversed { &k.lower[self.place(i) - 1] } else { &k.upper[i] }
    }

    /// K(i, i - 1) in the order of this sweep.
    fn previous<'m>(&self, k: &'m Tridiagonal, i: usize) -> &'m M6 {
        if self.reversed { &k.upper[self.place(i)] } else { &k.lower[i - 1] }
    }

    /// Takes what rows before `i` pass on to row `i` off its diagonal block.
    fn reduce(&self, k: &Tridiagonal, i: usize, schur: &mut M6) {
        if i > 0 {
            schur.gemm(-1.0, self.previous(k, i), &self.ahead[i - 1], 1.0);
        }
    }

    /// Takes what rows before `i` pass on to row `i` off its right-hand side.
    fn reduce_load(&self, k: &Tridiagonal, i: usize, forward: &[V6], load: &mut V6) {
        if i > 0 {
            *load -= self.previous(k, i) * forward[i - 1];
        }
    }

    /// Eliminates rows up to `count`, with the kept right-hand side `b`.
    fn extend(&mut self, k: &Tridiagonal, b: &[V6], count: usize) {
        for i in self.current..count {
            let mut schur = k.diagonal[self.place(i)];
            self.reduce(k, i, &mut schur);
            let next = *self.next(k, i);
            self.pivots[i].factor(&schur, &next, &mut self.ahead[i]);
            self.ratio[i] = self.pivots[i].ratio.min(if i > 0 { self.ratio[i - 1] } else { f64::INFINITY });
            let mut load = b[self.place(i)];
            self.reduce_load(k, i, &self.forward, &mut load);
            self.forward[i] = self.pivots[i].solve(&load);
        }
        self.current = self.current.max(count);
    }

    /// Substitutes back from row `count` (solved) to row 0; `forward(i)` is the forward substitution of row i.
    fn substitute_back(&self, count: usize, x: &mut [V6], forward: impl Fn(usize) -> V6) {
        for i in (0..count).rev() {
            x[self.place(i)] = forward(i) - self.ahead[i] * x[self.place(i + 1)];
        }
    }
}

/// Twisted factorisation of a block tridiagonal matrix, with the solution for one right-hand side kept up to date.
#[derive(Debug, Clone)]
pub struct Factor {
    from_left: Sweep,
    from_right: Sweep,
    /// Row at which the two sweeps meet, and its pivot block.
    meeting: usize,
    middle: Pivot,
    eliminated: usize,
}

impl Factor {
    /// For a matrix of `n` block rows, none of them factored yet.
    pub fn new(n: usize) -> Self {
        let (from_left, from_right) = (Sweep::new(n, false), Sweep::new(n, true));
        Factor { from_left, from_right, meeting: n / 2, middle: Pivot::default(), eliminated: 0 }
    }

    /// Notes that row `row` of the matrix or of the kept right-hand side changes; the sweeps will meet there.
    pub fn invalidate(&mut self, row: usize) {
        let n = self.from_left.pivots.len();
        self.from_left.current = self.from_left.current.min(row);
        self.from_right.current = self.from_right.current.min(n - 1 - row);
        self.meeting = row;
    }

    /// Factors what is not current and solves K x = b. `b` may differ from that of the last call only in rows that were
    /// invalidated since.
    pub fn update(&mut self, k: &Tridiagonal, b: &[V6], x: &mut [V6]) {
        let (m, beyond) = (self.meeting, b.len() - 1 - self.meeting);
        self.eliminated +=
            1 + m.saturating_sub(self.from_left.current) + beyond.saturating_sub(self.from_right.current);
        self.from_left.extend(k, b, m);
        self.from_right.extend(k, b, beyond);
        let mut schur = k.diagonal[m];
        self.from_left.reduce(k, m, &mut schur);
        self.from_right.reduce(k, beyond, &mut schur);
        self.middle.factor(&schur, &M6::zeros(), &mut M6::zeros());
        let mut load = b[m];
        self.from_left.reduce_load(k, m, &self.from_left.forward, &mut load);
        self.from_right.reduce_load(k, beyond, &self.from_right.forward, &mut load);
        x[m] = self.middle.solve(&load);
        self.from_left.substitute_back(m, x, |i| self.from_left.forward[i]);
        self.from_right.substitute_back(beyond, x, |i| self.from_right.forward[i]);
    }

    /// Solves K x = b for another right-hand side.
    pub fn solve(&self, k: &Tridiagonal, b: &[V6], x: &mut [V6]) {
        let (m, beyond) = (self.meeting, b.len() - 1 - self.meeting);
        let mut middle = b[m];
        let mut forward = [Vec::with_capacity(m), Vec::with_capacity(beyond)];
        for ((sweep, count), forward) in
            [(&self.from_left, m), (&self.from_right, beyond)].into_iter().zip(&mut forward)
        {
            for i in 0..count {
                let mut load = b[sweep.place(i)];
                sweep.reduce_load(k, i, forward, &mut load);
                forward.push(sweep.pivots[i].solve(&load));
            }
            sweep.reduce_load(k, count, forward, &mut middle);
        }
        x[m] = self.middle.solve(&middle);
        self.from_left.substitute_back(m, x, |i| forward[0][i]);
        self.from_right.substitute_back(beyond, x, |i| forward[1][i]);
    }

    /// Smallest ratio of pivots within a block: 1e-2 to 1e-6 for a stable structure, below 1e-13 for a mechanism.
    pub fn pivot_ratio(&self) -> f64 {
        let of = |sweep: &Sweep, count: usize| if count > 0 { sweep.ratio[count - 1] } else { f64::INFINITY };
        let n = self.from_left.pivots.len();
        self.middle.ratio.min(of(&self.from_left, self.meeting)).min(of(&self.from_right, n - 1 - self.meeting))
    }

    /// Block rows eliminated so far: the work done.
    pub fn eliminated(&self) -> usize {
        self.eliminated
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::linalg::solvers::Solve;

    /// A fixed, well-spread sequence of numbers in (-1, 1).
    fn numbers() -> impl Iterator<Item = f64> {
        (1..).map(|i| ((i * i) as f64 * 0.754_877_666).fract() * 2.0 - 1.0)
    }

    fn matrix(n: usize) -> Tridiagonal {
        let mut source = numbers();
        let mut block = || M6::from_fn(|_, _| source.next().unwrap());
        Tridiagonal {
            upper: (1..n).map(|_| block()).collect(),
            lower: (1..n).map(|_| block()).collect(),
            diagonal: (0..n).map(|_| block() + M6::identity() * 9.0).collect(),
        }
    }

    /// Worst difference from faer's dense LU with partial pivoting over the whole matrix.
    fn error(k: &Tridiagonal, b: &[V6], x: &[V6]) -> f64 {
        let n = b.len();
        let entry = |row: usize, column: usize| {
            let (i, j, at) = (row / 6, column / 6, (row % 6, column % 6));
            match j as isize - i as isize {
                0 => k.diagonal[i][at],
                1 => k.upper[i][at],
                -1 => k.lower[j][at],
                _ => 0.0,
            }
        };
        let dense = faer::Mat::from_fn(6 * n, 6 * n, entry);
        let rhs = faer::Mat::from_fn(6 * n, 1, |i, _| b[i / 6][i % 6]);
        let expected = dense.partial_piv_lu().solve(&rhs);
        (0..6 * n).map(|i| (x[i / 6][i % 6] - expected[(i, 0)]).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn agrees_with_a_dense_solver_wherever_the_change_is() {
        let n = 7;
        let (mut k, mut factor) = (matrix(n), Factor::new(n));
        let mut source = numbers().skip(5000);
        let mut vector = || V6::from_fn(|_, _| source.next().unwrap());
        let mut b: Vec<V6> = (0..n).map(|_| vector()).collect();
        let other: Vec<V6> = (0..n).map(|_| vector()).collect();
        let mut x = vec![V6::zeros(); n];
        for row in [3, 4, 0, 6, 5, 1, 1] {
            k.diagonal[row][(2, 3)] += 1.5;
            b[row][1] -= 0.3;
            factor.invalidate(row);
            factor.update(&k, &b, &mut x);
            assert!(error(&k, &b, &x) < 1e-13);
            factor.solve(&k, &other, &mut x);
            assert!(error(&k, &other, &x) < 1e-13);
            assert!(factor.pivot_ratio() > 1e-3);
        }
    }

    #[test]
    fn a_change_costs_the_rows_between_it_and_the_last() {
        let (k, mut factor) = (matrix(100), Factor::new(100));
        let (b, mut x) = (vec![V6::zeros(); 100], vec![V6::zeros(); 100]);
        let mut cost = |row: usize| {
            let before = factor.eliminated();
            factor.invalidate(row);
            factor.update(&k, &b, &mut x);
            factor.eliminated() - before
        };
        assert_eq!([cost(50), cost(53), cost(53), cost(43), cost(99)], [100, 4, 1, 11, 57]);
    }

    #[test]
    fn a_singular_block_shows_in_the_pivot_ratio() {
        let mut k = Tridiagonal { diagonal: vec![M6::identity()], ..Tridiagonal::default() };
        k.diagonal[0][(3, 3)] = 0.0;
        let mut factor = Factor::new(1);
        factor.update(&k, &[V6::zeros()], &mut [V6::zeros()]);
        assert!(factor.pivot_ratio() < 1e-14);
    }
}
