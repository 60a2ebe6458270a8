use super::*;
use crate::largest::largest;
use faer::linalg::solvers::Solve;

/// Blocks of all sizes around the number of columns that are eliminated at once, whose pivots are not on the diagonal.
#[test]
fn solves_as_a_dense_solver_does() {
    for (n, columns) in (1..14).flat_map(|n| [0, 1, 4, 6, n].map(|columns| (n, columns))) {
        let entry = |i: usize, j: usize| ((i * i + 7 * j * j + 3 * i * j + 1) as f64 * 0.754_877_666).fract() - 0.5;
        let width = n + columns;
        let mut rows: Vec<f64> = (0..n * width).map(|at| entry(at / width, at % width)).collect();
        (0..n).for_each(|i| rows[i * width + (i + 1) % n] += 3.0);
        let dense = faer::Mat::from_fn(n, n, |i, j| rows[i * width + j]).partial_piv_lu();
        let right = faer::Mat::from_fn(n, columns + 1, |i, j| if j < columns { rows[i * width + n + j] } else { 1.0 });
        let expected = dense.solve(&right);
        let (mut pivot, mut solved, mut x) = (Pivot::new(n), vec![0.0; n * columns], vec![1.0; n]);
        pivot.factor(&mut rows, columns, &mut solved, &[n], &Budget::unlimited()).unwrap();
        pivot.solve(&mut x, &mut Vec::new());
        let off = (0..n * columns).map(|at| (solved[at] - expected[(at / columns, at % columns)]).abs());
        let off = off.chain((0..n).map(|i| (x[i] - expected[(i, columns)]).abs()));
        assert!(largest(off) < 1e-13, "{n} rows, {columns} columns");
    }
}
