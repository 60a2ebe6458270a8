//! The product of two dense matrices, in pieces.

use super::parts;
use crate::budget::{Budget, Stopped};
use nalgebra::DMatrix;
use std::ops::Range;

/// Beyond so many columns a product of matrices takes more than some milliseconds.
const MANY_COLUMNS: usize = 256;

/// `a` `b`, so many columns at a time where there are many: its cost grows with the third power of them.
///
/// # Errors
/// When stopped.
pub(super) fn product(a: &DMatrix<f64>, b: &DMatrix<f64>, budget: &Budget) -> Result<DMatrix<f64>, Stopped> {
    let mut product = DMatrix::zeros(a.nrows(), b.ncols());
    let all = 0..b.ncols();
    let pieces = if b.ncols() > MANY_COLUMNS { parts(b.ncols()).collect() } else { vec![all] };
    for Range { start, end } in pieces {
        product.columns_mut(start, end - start).gemm(1.0, a, &b.columns(start, end - start), 0.0);
        // Several multiplications at a time.
        budget.work(a.len() * (end - start) / 4)?;
    }
    Ok(product)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ops::ControlFlow;

    #[test]
    fn a_product_in_parts_is_the_whole_to_the_last_digit() {
        let matrix =
            |n: usize, seed: f64| DMatrix::from_fn(n, n, |i, j| (seed + 1.3 * i as f64 + 0.7 * j as f64).sin());
        for n in [6, 255, 256, 257, 274, 300] {
            let (a, b) = (matrix(n, 0.3), matrix(n, 2.1));
            assert_eq!(product(&a, &b, &Budget::unlimited()).unwrap(), &a * &b, "{n}");
        }
        let stop = |_| ControlFlow::Break(());
        let (a, b) = (matrix(600, 0.3), matrix(600, 2.1));
        assert!(product(&a, &b, &Budget::new(&stop)).is_err());
    }
}
