use super::*;
use crate::largest::largest;
use faer::linalg::solvers::Solve;
use pulp::Scalar;

/// Rows of [a | b], so wide, with a block whose pivots are not on the diagonal.
fn block(n: usize, width: usize) -> Vec<f64> {
    let entry = |i: usize, j: usize| ((i * i + 7 * j * j + 3 * i * j + 1) as f64 * 0.754_877_666).fract() - 0.5;
    let mut rows: Vec<f64> = (0..n * width).map(|at| entry(at / width, at % width)).collect();
    (0..n).for_each(|i| rows[i * width + (i + 1) % n] += 3.0);
    rows
}

/// Blocks of all sizes around the number of columns that are eliminated at once.
#[test]
fn solves_as_a_dense_solver_does() {
    for (n, columns) in (1..14).flat_map(|n| [0, 1, 4, 6, n].map(|columns| (n, columns))) {
        let width = n + columns;
        let mut rows = block(n, width);
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

/// Vector instructions do what single ones do, in the same order.
#[test]
fn is_the_same_to_the_last_bit_whatever_the_processor_has() {
    for (n, columns) in (1..14).flat_map(|n| [0, 3, 9].map(|columns| (n, columns))) {
        let eliminated = |by_one: bool| {
            let (mut pivot, mut rows, mut solved) = (Pivot::new(n), block(n, n + columns), vec![0.0; n * columns]);
            let (size, budget) = ([n, columns], Budget::unlimited());
            let (rows, into) = (&mut rows[..], &mut solved[..]);
            let all = Elimination { pivot: &mut pivot, size, rows, solved: into, ends: &[n], budget: &budget };
            if by_one { all.with_simd(Scalar) } else { Arch::new().dispatch(all) }.unwrap();
            (pivot.rows, solved)
        };
        assert_eq!(eliminated(true), eliminated(false), "{n} rows, {columns} columns");
    }
}
