//! Block LU of a block tridiagonal matrix, pivoting inside the blocks, refactored only from the first change on.

use super::block::{M6, V6};

/// LU of one 6 x 6 pivot block with partial pivoting.
#[derive(Debug, Clone, Copy)]
struct Pivot {
    lu: M6,
    rows: [usize; 6],
    /// Smallest over largest pivot.
    ratio: f64,
}

impl Pivot {
    fn new(mut a: M6) -> Self {
        let mut rows = [0, 1, 2, 3, 4, 5];
        let (mut smallest, mut largest) = (f64::INFINITY, 0f64);
        for k in 0..6 {
            let mut best = k;
            for i in k + 1..6 {
                if a[(i, k)].abs() > a[(best, k)].abs() {
                    best = i;
                }
            }
            if best != k {
                a.swap_rows(k, best);
                rows.swap(k, best);
            }
            // An exactly singular block is left singular to working precision: its inverse then points along the
            // mechanism, which is what the caller looks for.
            if a[(k, k)] == 0.0 {
                a[(k, k)] = largest.max(f64::MIN_POSITIVE) * f64::EPSILON;
            }
            let pivot = a[(k, k)];
            smallest = smallest.min(pivot.abs());
            largest = largest.max(pivot.abs());
            for i in k + 1..6 {
                a[(i, k)] /= pivot;
            }
            for j in k + 1..6 {
                let u = a[(k, j)];
                for i in k + 1..6 {
                    let l = a[(i, k)];
                    a[(i, j)] -= l * u;
                }
            }
        }
        Pivot { lu: a, rows, ratio: smallest / largest }
    }

    fn solve(&self, b: &V6) -> V6 {
        let mut x = V6::zeros();
        for i in 0..6 {
            x[i] = b[self.rows[i]];
        }
        for k in 0..6 {
            let xk = x[k];
            for i in k + 1..6 {
                x[i] -= self.lu[(i, k)] * xk;
            }
        }
        for k in (0..6).rev() {
            x[k] /= self.lu[(k, k)];
            let xk = x[k];
            for i in 0..k {
                x[i] -= self.lu[(i, k)] * xk;
            }
        }
        x
    }

    fn solve_matrix(&self, b: &M6) -> M6 {
        let mut x = M6::zeros();
        for j in 0..6 {
            x.set_column(j, &self.solve(&b.column(j).into_owned()));
        }
        x
    }
}

/// Factorisation of a block tridiagonal matrix with 6 x 6 blocks.
#[derive(Debug, Clone, Default)]
pub struct Factor {
    pivots: Vec<Pivot>,
    /// S_i^-1 K(i, i+1).
    ahead: Vec<M6>,
    /// How many leading block rows are factored and current.
    current: usize,
    /// Running minimum of the pivot ratios.
    ratio: Vec<f64>,
}

impl Factor {
    /// Forgets everything from block row `row` on.
    pub fn invalidate(&mut self, row: usize) {
        self.current = self.current.min(row);
    }

    /// Factors the rows that are not current. `diagonal[i]` is K(i, i), `upper[i]` K(i, i+1), `lower[i]` K(i+1, i).
    pub fn update(&mut self, diagonal: &[M6], upper: &[M6], lower: &[M6]) {
        self.pivots.truncate(self.current);
        self.ahead.truncate(self.current);
        self.ratio.truncate(self.current);
        for i in self.current..diagonal.len() {
            let schur = if i == 0 { diagonal[0] } else { diagonal[i] - lower[i - 1] * self.ahead[i - 1] };
            let pivot = Pivot::new(schur);
            self.ahead.push(if i + 1 < diagonal.len() { pivot.solve_matrix(&upper[i]) } else { M6::zeros() });
            self.ratio.push(pivot.ratio.min(self.ratio.last().copied().unwrap_or(f64::INFINITY)));
            self.pivots.push(pivot);
        }
        self.current = diagonal.len();
    }

    /// Solves K x = b in place.
    pub fn solve(&self, lower: &[M6], x: &mut [V6]) {
        for i in 0..x.len() {
            if i > 0 {
                let known = lower[i - 1] * x[i - 1];
                x[i] -= known;
            }
            x[i] = self.pivots[i].solve(&x[i]);
        }
        for i in (0..x.len() - 1).rev() {
            let known = self.ahead[i] * x[i + 1];
            x[i] -= known;
        }
    }

    /// Smallest ratio of pivots within a block: 1e-2 to 1e-6 for a stable structure, below 1e-13 for a mechanism.
    pub fn pivot_ratio(&self) -> f64 {
        self.ratio.last().copied().unwrap_or(f64::INFINITY)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};

    /// A fixed, well-spread sequence of numbers in (-1, 1).
    fn numbers() -> impl Iterator<Item = f64> {
        (1..).map(|i| ((i * i) as f64 * 0.754_877_666).fract() * 2.0 - 1.0)
    }

    #[test]
    fn agrees_with_a_dense_solver_after_a_partial_update() {
        let n = 7;
        let mut source = numbers();
        let mut matrix = || M6::from_fn(|_, _| source.next().unwrap());
        let (upper, lower): (Vec<M6>, Vec<M6>) = (0..n - 1).map(|_| (matrix(), matrix())).unzip();
        let mut diagonal: Vec<M6> = (0..n).map(|_| matrix() + M6::identity() * 9.0).collect();
        let mut factor = Factor::default();
        factor.update(&diagonal, &upper, &lower);
        diagonal[4][(2, 3)] += 1.5;
        factor.invalidate(4);
        factor.update(&diagonal, &upper, &lower);

        let mut dense = DMatrix::zeros(6 * n, 6 * n);
        for i in 0..n {
            dense.view_mut((6 * i, 6 * i), (6, 6)).copy_from(&diagonal[i]);
            if i + 1 < n {
                dense.view_mut((6 * i, 6 * i + 6), (6, 6)).copy_from(&upper[i]);
                dense.view_mut((6 * i + 6, 6 * i), (6, 6)).copy_from(&lower[i]);
            }
        }
        let b = DVector::from_iterator(6 * n, numbers().skip(500).take(6 * n));
        let mut x: Vec<V6> = (0..n).map(|i| V6::from_iterator(b.rows(6 * i, 6).iter().copied())).collect();
        factor.solve(&lower, &mut x);
        let expected = dense.lu().solve(&b).unwrap();
        let worst = (0..6 * n).map(|i| (x[i / 6][i % 6] - expected[i]).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-13, "{worst}");
        assert!(factor.pivot_ratio() > 1e-3);
    }

    #[test]
    fn a_singular_block_shows_in_the_pivot_ratio() {
        let mut a = M6::identity();
        a[(3, 3)] = 0.0;
        let mut factor = Factor::default();
        factor.update(&[a], &[], &[]);
        assert!(factor.pivot_ratio() < 1e-14);
    }
}
