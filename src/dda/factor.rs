//! Block LU of a block tridiagonal matrix, pivoting inside the blocks.
//!
//! The matrix is eliminated from both ends towards the block row that changed last (a twisted factorisation), so that
//! the next change costs only the rows between the two. Blocks may differ in size.
//!
//! Where block rows are large, the tracer goes on with these factors over several changes, see [`super::trace`].

use super::heart::{Heart, Stopped};
use super::panels::{Panels, subtract_applied, subtract_product};
use super::pivot::Pivot;
use std::ops::Range;

/// Work of eliminating a block row, over the cube of its unknowns; and of solving for it, over their square.
const ELIMINATED: usize = 3;
const SOLVED: usize = 3;

/// A block tridiagonal matrix.
#[derive(Debug, Clone, Default)]
pub struct Tridiagonal {
    /// Unknowns before each block row, and all of them.
    pub start: Vec<usize>,
    /// K(i, i).
    pub diagonal: Panels,
    /// K(i, i + 1).
    pub upper: Panels,
    /// K(i + 1, i).
    pub lower: Panels,
}

impl Tridiagonal {
    /// A zero matrix with block rows of these sizes.
    pub fn zeros(sizes: &[usize]) -> Self {
        let mut start = vec![0];
        sizes.iter().for_each(|n| start.push(start[start.len() - 1] + n));
        let pairs = || sizes.iter().copied().zip(sizes.iter().copied().skip(1));
        Tridiagonal {
            start,
            diagonal: Panels::zeros(sizes.iter().map(|&n| (n, n))),
            upper: Panels::zeros(pairs()),
            lower: Panels::zeros(pairs().map(|(a, b)| (b, a))),
        }
    }

    /// Sets the four panels between block rows `i` and `i + 1`, given as one matrix over both.
    pub fn set_pair(&mut self, i: usize, entry: impl Fn(usize, usize) -> f64) {
        let (left, all) = (self.range(i).len(), self.range(i).len() + self.range(i + 1).len());
        let copy = |panel: &mut [f64], rows: Range<usize>, columns: Range<usize>| {
            let entries = rows.flat_map(|i| columns.clone().map(move |j| (i, j)));
            panel.iter_mut().zip(entries).for_each(|(x, (i, j))| *x = entry(i, j));
        };
        copy(self.diagonal.get_mut(i), 0..left, 0..left);
        copy(self.diagonal.get_mut(i + 1), left..all, left..all);
        copy(self.upper.get_mut(i), 0..left, left..all);
        copy(self.lower.get_mut(i), left..all, 0..left);
    }

    /// The same again; zero from where it was stopped.
    pub fn copied(&self, heart: &Heart) -> Self {
        let [diagonal, upper, lower] = [&self.diagonal, &self.upper, &self.lower].map(|panels| panels.copied(heart));
        Tridiagonal { start: self.start.clone(), diagonal, upper, lower }
    }

    /// Number of block rows.
    pub fn rows(&self) -> usize {
        self.start.len() - 1
    }

    /// Unknowns of block row `i`.
    pub fn range(&self, i: usize) -> Range<usize> {
        self.start[i]..self.start[i + 1]
    }
}

/// Elimination from one end: row 0 is the first eliminated.
#[derive(Debug, Clone)]
struct Sweep {
    reversed: bool,
    /// Pivot blocks, by place in the matrix.
    pivots: Vec<Pivot>,
    /// S_i^-1 K(i, next), by place in the matrix.
    ahead: Panels,
    /// Smallest pivot ratio of rows 0..=i.
    ratio: Vec<f64>,
    /// Forward substitution of the kept right-hand side, by place in the matrix.
    forward: Vec<f64>,
    /// How many rows are eliminated and current.
    current: usize,
    /// Scratch: a Schur complement, a pivot's rows.
    schur: Vec<f64>,
    work: Vec<f64>,
}

impl Sweep {
    fn new(k: &Tridiagonal, reversed: bool) -> Self {
        let n = k.rows();
        let size = |i: usize| k.range(i).len();
        let next = |i: usize| if reversed { i.checked_sub(1) } else { Some(i + 1).filter(|&i| i < n) };
        Sweep {
            reversed,
            pivots: (0..n).map(|i| Pivot::new(size(i))).collect(),
            ahead: Panels::zeros((0..n).map(|i| (size(i), next(i).map_or(0, size)))),
            ratio: vec![f64::INFINITY; n],
            forward: vec![0.0; k.start[n]],
            current: 0,
            schur: Vec::new(),
            work: Vec::new(),
        }
    }

    /// Place of row `i` of this sweep in the matrix.
    fn place(&self, i: usize) -> usize {
        if self.reversed { self.pivots.len() - 1 - i } else { i }
    }

    /// K(i, i + 1) in the order of this sweep.
    fn next<'m>(&self, k: &'m Tridiagonal, i: usize) -> &'m [f64] {
        if self.reversed { k.lower.get(self.place(i) - 1) } else { k.upper.get(i) }
    }

    /// K(i, i - 1) in the order of this sweep.
    fn previous<'m>(&self, k: &'m Tridiagonal, i: usize) -> &'m [f64] {
        if self.reversed { k.upper.get(self.place(i)) } else { k.lower.get(i - 1) }
    }

    /// Takes what rows before `i` pass on to row `i` off its diagonal block.
    fn reduce(&self, k: &Tridiagonal, i: usize, schur: &mut [f64]) {
        if i > 0 {
            let (before, here) = (self.place(i - 1), k.range(self.place(i)).len());
            subtract_product(self.previous(k, i), self.ahead.get(before), schur, k.range(before).len(), here);
        }
    }

    /// Takes what rows before `i` pass on to row `i` off its right-hand side.
    fn reduce_load(&self, k: &Tridiagonal, i: usize, forward: &[f64], load: &mut [f64]) {
        if i > 0 {
            subtract_applied(self.previous(k, i), &forward[k.range(self.place(i - 1))], load);
        }
    }

    /// Eliminates rows up to `count`, with the kept right-hand side `b`.
    fn extend(&mut self, k: &Tridiagonal, b: &[f64], count: usize, heart: &Heart) -> Result<(), Stopped> {
        for i in self.current..count {
            self.eliminate(k, b, i);
            heart.work(ELIMINATED * k.range(self.place(i)).len().pow(3))?;
        }
        Ok(())
    }

    /// Eliminates row `i`, those before being eliminated.
    fn eliminate(&mut self, k: &Tridiagonal, b: &[f64], i: usize) {
        let (mut schur, mut work) = (std::mem::take(&mut self.schur), std::mem::take(&mut self.work));
        let mut forward = std::mem::take(&mut self.forward);
        let place = self.place(i);
        schur.clear();
        schur.extend_from_slice(k.diagonal.get(place));
        self.reduce(k, i, &mut schur);
        let next = self.next(k, i);
        self.ahead.get_mut(place).copy_from_slice(next);
        self.pivots[place].factor(&schur, self.ahead.get_mut(place), &mut work);
        self.ratio[i] = self.pivots[place].ratio.min(if i > 0 { self.ratio[i - 1] } else { f64::INFINITY });
        self.forward_row(k, b, i, &mut forward, &mut work);
        (self.schur, self.work, self.forward) = (schur, work, forward);
        self.current = i + 1;
    }

    /// Forward substitution of row `i` of the right-hand side `b`.
    fn forward_row(&self, k: &Tridiagonal, b: &[f64], i: usize, forward: &mut [f64], work: &mut Vec<f64>) {
        let here = k.range(self.place(i));
        forward[here.clone()].copy_from_slice(&b[here.clone()]);
        if i > 0 {
            let (load, before) = apart(forward, here.clone(), k.range(self.place(i - 1)));
            subtract_applied(self.previous(k, i), before, load);
        }
        self.pivots[self.place(i)].solve(&mut forward[here], work);
    }

    /// Substitutes back from row `count` (solved) to row 0.
    fn substitute_back(&self, k: &Tridiagonal, count: usize, x: &mut [f64], forward: &[f64]) {
        for i in (0..count).rev() {
            let here = k.range(self.place(i));
            let (into, known) = apart(x, here.clone(), k.range(self.place(i + 1)));
            into.copy_from_slice(&forward[here]);
            subtract_applied(self.ahead.get(self.place(i)), known, into);
        }
    }
}

/// Two neighbouring stretches of `x`: the first to change, the second to read.
fn apart(x: &mut [f64], change: Range<usize>, read: Range<usize>) -> (&mut [f64], &[f64]) {
    let (low, high) = x.split_at_mut(change.start.max(read.start));
    if change.start < read.start {
        (&mut low[change], &high[..read.len()])
    } else {
        (&mut high[..change.len()], &low[read])
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
    /// Scratch.
    schur: Vec<f64>,
    work: Vec<f64>,
}

impl Factor {
    /// For matrices shaped as `k`, no row of them factored yet.
    pub fn new(k: &Tridiagonal) -> Self {
        Factor {
            from_left: Sweep::new(k, false),
            from_right: Sweep::new(k, true),
            meeting: k.rows() / 2,
            middle: Pivot::default(),
            eliminated: 0,
            schur: Vec::new(),
            work: Vec::new(),
        }
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
    ///
    /// # Errors
    /// When stopped: what is done by then is kept.
    pub fn update(&mut self, k: &Tridiagonal, b: &[f64], x: &mut [f64], heart: &Heart) -> Result<(), Stopped> {
        let (m, beyond) = (self.meeting, k.rows() - 1 - self.meeting);
        self.eliminated +=
            1 + m.saturating_sub(self.from_left.current) + beyond.saturating_sub(self.from_right.current);
        self.from_left.extend(k, b, m, heart)?;
        self.from_right.extend(k, b, beyond, heart)?;
        self.schur.clear();
        self.schur.extend_from_slice(k.diagonal.get(m));
        self.from_left.reduce(k, m, &mut self.schur);
        self.from_right.reduce(k, beyond, &mut self.schur);
        self.middle = Pivot::new(k.range(m).len());
        self.middle.factor(&self.schur, &mut [], &mut self.work);
        let forward = [&self.from_left.forward, &self.from_right.forward].map(Vec::as_slice);
        Self::finish([&self.from_left, &self.from_right], &self.middle, k, b, forward, m, x);
        Ok(())
    }

    /// Solves K x = b for another right-hand side.
    ///
    /// # Errors
    /// When stopped.
    pub fn solve(&self, k: &Tridiagonal, b: &[f64], x: &mut [f64], heart: &Heart) -> Result<(), Stopped> {
        // Where a factorisation was stopped there are no factors.
        heart.check()?;
        let (m, beyond) = (self.meeting, k.rows() - 1 - self.meeting);
        let mut work = Vec::new();
        let sweeps = [&self.from_left, &self.from_right];
        let mut forward = [vec![0.0; b.len()], vec![0.0; b.len()]];
        for ((sweep, count), forward) in sweeps.into_iter().zip([m, beyond]).zip(&mut forward) {
            // Rows before the first load stay zero.
            let idle = (0..count).take_while(|&i| b[k.range(sweep.place(i))].iter().all(|load| *load == 0.0)).count();
            for i in idle..count {
                sweep.forward_row(k, b, i, forward, &mut work);
                heart.work(SOLVED * k.range(sweep.place(i)).len().pow(2))?;
            }
        }
        Self::finish(sweeps, &self.middle, k, b, forward.each_ref().map(Vec::as_slice), m, x);
        Ok(())
    }

    /// Solves the middle row and substitutes back to both ends.
    fn finish(
        [left, right]: [&Sweep; 2],
        middle: &Pivot,
        k: &Tridiagonal,
        b: &[f64],
        forward: [&[f64]; 2],
        m: usize,
        x: &mut [f64],
    ) {
        let beyond = k.rows() - 1 - m;
        let mut load = b[k.range(m)].to_vec();
        left.reduce_load(k, m, forward[0], &mut load);
        right.reduce_load(k, beyond, forward[1], &mut load);
        middle.solve(&mut load, &mut Vec::new());
        x[k.range(m)].copy_from_slice(&load);
        left.substitute_back(k, m, x, forward[0]);
        right.substitute_back(k, beyond, x, forward[1]);
    }

    /// Smallest ratio of pivots within a block: 1e-2 to 1e-6 for a stable structure, below 1e-13 for a mechanism.
    pub fn pivot_ratio(&self) -> f64 {
        let of = |sweep: &Sweep, count: usize| if count > 0 { sweep.ratio[count - 1] } else { f64::INFINITY };
        let n = self.from_left.pivots.len();
        self.middle.ratio.min(of(&self.from_left, self.meeting)).min(of(&self.from_right, n - 1 - self.meeting))
    }

    /// Row at which the two sweeps met last.
    pub fn meeting(&self) -> usize {
        self.meeting
    }

    /// Block rows eliminated so far: the work done.
    pub fn eliminated(&self) -> usize {
        self.eliminated
    }
}

#[cfg(test)]
mod tests;
