//! Cholesky factors of a macroblock's stiffness; the only file of this room that knows faer.

use super::Inside;
use crate::budget::{Budget, Stopped};
use faer::linalg::solvers::{Llt, Solve};
use faer::sparse::linalg::solvers::{Llt as SparseLlt, SymbolicLlt};
use faer::sparse::{SparseColMat, SymbolicSparseColMat};
use faer::{Mat, MatRef, Side};
use nalgebra::{DMatrix, DVector};

/// Dense where the macroblock has one subblock, sparse otherwise.
#[derive(Debug, Clone)]
pub(super) enum Factors {
    Dense(Llt<f64>),
    Sparse(SparseLlt<usize, f64>),
}

/// Work of adding a block of stiffness, and of setting one into its place, in multiplications.
const ADDED: usize = 200;
const PLACED: usize = 36;
/// Entries of a block of stiffness between two constant-strain subblocks.
const CONSTANT_STRAIN: usize = 36;

/// Takes in a block of stiffness between two groups of unknowns, column by column.
pub(super) type Add<'a> = dyn FnMut(usize, usize, &[f64]) + 'a;

impl Factors {
    /// Those of the stiffness of a body to which `more(add)` adds; none where that is not positive definite.
    ///
    /// # Errors
    /// When stopped.
    pub(super) fn new(body: &Inside, more: impl Fn(&mut Add), budget: &Budget) -> Result<Option<Self>, Stopped> {
        let all = |add: &mut Add| {
            more(&mut *add);
            body.stiffness(|i, j, block| {
                add(i, j, block);
                // Where this says to stop, asking the budget does too.
                let _ = budget.work(ADDED * block.len() / CONSTANT_STRAIN);
            });
        };
        let group = body.group();
        if body.groups() == 1 {
            let mut sum = vec![0.0; group * group];
            all(&mut |_, _, block| sum.iter_mut().zip(block).for_each(|(sum, x)| *sum += x));
            let whole = Mat::from_fn(group, group, |i, j| sum[j * group + i]);
            return Ok(whole.llt(Side::Lower).ok().map(Factors::Dense));
        }
        budget.ask()?;
        let sparse = assemble([body.groups(), group], all, budget)?;
        budget.ask()?;
        let Ok(order) = SymbolicLlt::try_new(sparse.symbolic(), Side::Lower) else { return Ok(None) };
        budget.ask()?;
        let factors = SparseLlt::try_new_with_symbolic(order, sparse.as_ref(), Side::Lower);
        budget.ask()?;
        Ok(factors.ok().map(Factors::Sparse))
    }

    /// `K^-1 right`.
    pub(super) fn solve(&self, right: &DMatrix<f64>) -> DMatrix<f64> {
        let (unknowns, columns) = right.shape();
        let x = self.solve_columns(&Mat::from_fn(unknowns, columns, |i, j| right[(i, j)]));
        DMatrix::from_fn(unknowns, columns, |i, j| x[(i, j)])
    }

    /// The same for one right-hand side.
    pub(super) fn solve_one(&self, right: &DVector<f64>) -> DVector<f64> {
        if let Factors::Dense(factors) = self {
            return substitute(factors.L(), right);
        }
        let x = self.solve_columns(&Mat::from_fn(right.len(), 1, |i, _| right[i]));
        DVector::from_fn(right.len(), |i, _| x[(i, 0)])
    }

    /// The same in the library's own matrices: these are aligned, so that it sums alike wherever memory is given.
    fn solve_columns(&self, right: &Mat<f64>) -> Mat<f64> {
        match self {
            Factors::Dense(factors) => factors.solve(right),
            Factors::Sparse(factors) => factors.solve(right),
        }
    }
}

/// The blocks on and below the diagonal of a symmetric matrix between so many groups of so many unknowns, column by column: the sum of
/// what `all(add)` adds, twice over. First it is seen which blocks there are, for the list of all that is added is several times as
/// long.
fn assemble(
    [groups, group]: [usize; 2],
    all: impl Fn(&mut Add),
    budget: &Budget,
) -> Result<SparseColMat<usize, f64>, Stopped> {
    let mut below = vec![Vec::new(); groups];
    all(&mut |i, j, _| {
        if i >= j && !below[j].contains(&i) {
            below[j].push(i);
        }
    });
    budget.ask()?;
    let count = group * group * below.iter().map(Vec::len).sum::<usize>();
    let (mut start, mut ends, mut rows) = (Vec::with_capacity(groups), vec![0], Vec::with_capacity(count));
    for below in &mut below {
        below.sort_unstable();
        start.push(rows.len());
        for _ in 0..group {
            rows.extend(below.iter().flat_map(|i| group * i..group * (i + 1)));
            ends.push(rows.len());
        }
        budget.work(PLACED * below.len())?;
    }
    budget.ask()?;
    let mut values = vec![0.0; count];
    all(&mut |i, j, block| {
        if let Ok(place) = below[j].binary_search(&i) {
            for (b, column) in block.chunks_exact(group).enumerate() {
                let first = start[j] + group * (b * below[j].len() + place);
                values[first..first + group].iter_mut().zip(column).for_each(|(sum, x)| *sum += x);
            }
        }
    });
    budget.ask()?;
    let pattern = SymbolicSparseColMat::new_checked(group * groups, group * groups, ends, None, rows);
    Ok(SparseColMat::new(pattern, values))
}

/// `(L L')^-1 right`. The library takes ten times as long for so few unknowns.
fn substitute(lower: MatRef<f64>, right: &DVector<f64>) -> DVector<f64> {
    let (n, mut x) = (right.len(), right.clone());
    for i in 0..n {
        let rest = (0..i).fold(x[i], |rest, j| rest - lower[(i, j)] * x[j]);
        x[i] = rest / lower[(i, i)];
    }
    for i in (0..n).rev() {
        let rest = (i + 1..n).fold(x[i], |rest, j| rest - lower[(j, i)] * x[j]);
        x[i] = rest / lower[(i, i)];
    }
    x
}

#[cfg(test)]
mod tests;
