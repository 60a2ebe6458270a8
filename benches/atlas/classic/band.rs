//! A banded matrix and its LU factorisation with partial pivoting (Golub & Van Loan, Matrix Computations, 4.3.5).

/// Unknowns of a block and of its neighbour: entries lie at most so far off the diagonal.
const REACH: usize = 11;
/// Pivoting fills so many diagonals more.
const WIDTH: usize = 3 * REACH + 1;

/// A square matrix, row by row, from `REACH` before the diagonal to twice as far behind it.
#[derive(Debug, Clone)]
pub struct Band(Vec<[f64; WIDTH]>);

impl Band {
    pub fn zeros(size: usize) -> Band {
        Band(vec![[0.0; WIDTH]; size])
    }

    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        self.0[row][column + REACH - row] += value;
    }

    /// Adds a share of the largest diagonal entry to all of them, which makes a singular matrix regular.
    pub fn shift(&mut self, share: f64) {
        let largest = self.0.iter().map(|row| row[REACH].abs()).fold(0.0, f64::max);
        self.0.iter_mut().for_each(|row| row[REACH] += share * largest);
    }

    /// Solves for a right side; none where a pivot vanishes.
    pub fn solve(mut self, mut right: Vec<f64>) -> Option<Vec<f64>> {
        let size = self.0.len();
        for k in 0..size {
            let last = (k + REACH).min(size - 1);
            let pivot = (k..=last).max_by(|&a, &b| self.at(a, k).abs().total_cmp(&self.at(b, k).abs()))?;
            let end = (k + 2 * REACH).min(size - 1);
            for j in k..=end {
                let (a, b) = (self.at(k, j), self.at(pivot, j));
                self.0[k][j + REACH - k] = b;
                self.0[pivot][j + REACH - pivot] = a;
            }
            right.swap(k, pivot);
            let head = self.at(k, k);
            if head == 0.0 || !head.is_finite() {
                return None;
            }
            for i in k + 1..=last {
                let factor = self.at(i, k) / head;
                if factor == 0.0 {
                    continue;
                }
                for j in k..=end {
                    self.0[i][j + REACH - i] -= factor * self.0[k][j + REACH - k];
                }
                right[i] -= factor * right[k];
            }
        }
        for k in (0..size).rev() {
            let end = (k + 2 * REACH).min(size - 1);
            let known: f64 = (k + 1..=end).map(|j| self.at(k, j) * right[j]).sum();
            right[k] = (right[k] - known) / self.at(k, k);
        }
        right.iter().all(|x| x.is_finite()).then_some(right)
    }

    fn at(&self, row: usize, column: usize) -> f64 {
        self.0[row][column + REACH - row]
    }
}
