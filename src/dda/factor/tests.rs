use super::*;
use faer::linalg::solvers::Solve;

/// A fixed, well-spread sequence of numbers in (-1, 1).
fn numbers() -> impl Iterator<Item = f64> {
    (1..).map(|i| ((i * i) as f64 * 0.754_877_666).fract() * 2.0 - 1.0)
}

/// Block rows of different sizes, one of them empty, as at a free end.
const SIZES: [usize; 7] = [4, 4, 6, 2, 4, 5, 0];

fn matrix(sizes: &[usize]) -> Tridiagonal {
    let mut k = Tridiagonal::zeros(sizes);
    let mut source = numbers();
    let mut fill = |panel: &mut [f64]| panel.iter_mut().for_each(|x| *x = source.next().unwrap());
    for (i, &n) in sizes.iter().enumerate() {
        fill(k.diagonal.get_mut(i));
        (0..n).for_each(|j| k.diagonal.get_mut(i)[j * (n + 1)] += 9.0);
    }
    for i in 1..sizes.len() {
        fill(k.upper.get_mut(i - 1));
        fill(k.lower.get_mut(i - 1));
    }
    k
}

/// Worst difference from faer's dense LU with partial pivoting over the whole matrix.
fn error(k: &Tridiagonal, b: &[f64], x: &[f64]) -> f64 {
    let mut dense = faer::Mat::zeros(b.len(), b.len());
    let mut put = |panel: &[f64], rows: Range<usize>, columns: Range<usize>| {
        for (at, value) in panel.iter().enumerate() {
            dense[(rows.start + at / columns.len(), columns.start + at % columns.len())] = *value;
        }
    };
    for i in 0..k.rows() {
        put(k.diagonal.get(i), k.range(i), k.range(i));
        if i > 0 {
            put(k.upper.get(i - 1), k.range(i - 1), k.range(i));
            put(k.lower.get(i - 1), k.range(i), k.range(i - 1));
        }
    }
    let rhs = faer::Mat::from_fn(b.len(), 1, |i, _| b[i]);
    let expected = dense.partial_piv_lu().solve(&rhs);
    (0..b.len()).map(|i| (x[i] - expected[(i, 0)]).abs()).fold(0.0, f64::max)
}

#[test]
fn agrees_with_a_dense_solver_wherever_the_change_is() {
    let mut k = matrix(&SIZES);
    let mut factor = Factor::new(&k);
    let n = k.start[SIZES.len()];
    let mut source = numbers().skip(5000);
    let mut vector = || -> Vec<f64> { source.by_ref().take(n).collect() };
    let (mut b, other, mut x) = (vector(), vector(), vec![0.0; n]);
    for row in [3, 4, 0, 6, 5, 1, 1] {
        if SIZES[row] > 0 {
            k.diagonal.get_mut(row)[1] += 1.5;
            b[k.start[row]] -= 0.3;
        }
        factor.invalidate(row);
        factor.update(&k, &b, &mut x, &Heart::unwatched()).unwrap();
        assert!(error(&k, &b, &x) < 1e-13);
        factor.solve(&k, &other, &mut x, &Heart::unwatched()).unwrap();
        assert!(error(&k, &other, &x) < 1e-13);
        assert!(factor.pivot_ratio() > 1e-3);
    }
}

#[test]
fn a_change_costs_the_rows_between_it_and_the_last() {
    let k = matrix(&[4; 100]);
    let mut factor = Factor::new(&k);
    let (b, mut x) = (vec![0.0; 400], vec![0.0; 400]);
    let mut cost = |row: usize| {
        let before = factor.eliminated();
        factor.invalidate(row);
        factor.update(&k, &b, &mut x, &Heart::unwatched()).unwrap();
        factor.eliminated() - before
    };
    assert_eq!([cost(50), cost(53), cost(53), cost(43), cost(99)], [100, 4, 1, 11, 57]);
}

#[test]
fn a_singular_block_shows_in_the_pivot_ratio() {
    let mut k = Tridiagonal::zeros(&[4]);
    k.diagonal.get_mut(0).copy_from_slice(&[1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 0.]);
    let mut factor = Factor::new(&k);
    factor.update(&k, &[0.0; 4], &mut [0.0; 4], &Heart::unwatched()).unwrap();
    assert!(factor.pivot_ratio() < 1e-14);
}
