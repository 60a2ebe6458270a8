//! The programme and what its sparse matrices do to vectors.

use crate::limit::linear_program::dot;

/// A 3 x 3 matrix by rows.
pub type Square = [[f64; 3]; 3];

/// A row of A: its block (one past the last: the load factor), coefficients and constant.
#[derive(Debug, Clone, Copy)]
pub struct Row {
    pub block: usize,
    pub a: [f64; 3],
    pub constant: f64,
}

/// A programme.
#[derive(Debug, Clone)]
pub struct Sparse {
    /// For every block the bodies whose equations it enters, and how.
    pub blocks: Vec<Vec<(usize, Square)>>,
    pub bodies: usize,
    pub rows: Vec<Row>,
    /// How many threes of rows, the last ones, are second-order cones.
    pub cones: usize,
    /// Column of E of the load factor, and right-hand sides.
    pub growth: Vec<f64>,
    pub right: Vec<f64>,
    /// c: three entries a block, and that of the load factor.
    pub cost: Vec<f64>,
}

impl Sparse {
    pub fn unknowns(&self) -> usize {
        3 * self.blocks.len() + 1
    }

    /// Number of rows before the cones.
    pub fn linear(&self) -> usize {
        self.rows.len() - 3 * self.cones
    }

    /// A x.
    pub fn rows_times(&self, x: &[f64]) -> Vec<f64> {
        let n = self.blocks.len();
        let value = |row: &Row| match x.get(3 * row.block..3 * row.block + 3) {
            Some(x) => dot3(&row.a, x),
            None => row.a[0] * x[3 * n],
        };
        self.rows.iter().map(value).collect()
    }

    /// A' z, added to `sum` times `sign`.
    pub fn add_transposed(&self, z: &[f64], sign: f64, sum: &mut [f64]) {
        for (row, z) in self.rows.iter().zip(z) {
            // The load factor has one entry, a block three.
            let sum = sum[3 * row.block..].iter_mut();
            sum.zip(&row.a).for_each(|(sum, a)| *sum += sign * z * a);
        }
    }

    /// E x.
    pub fn balance(&self, x: &[f64]) -> Vec<f64> {
        let last = x[3 * self.blocks.len()];
        let mut sums: Vec<f64> = self.growth.iter().map(|g| g * last).collect();
        for (block, x) in self.blocks.iter().zip(x.chunks_exact(3)) {
            for (body, e) in block {
                let sums = sums[3 * body..3 * body + 3].iter_mut();
                sums.zip(e).for_each(|(sum, e)| *sum += dot3(e, x));
            }
        }
        sums
    }

    /// E' y.
    pub fn motion(&self, y: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.unknowns()];
        for (block, sums) in self.blocks.iter().zip(sums.chunks_exact_mut(3)) {
            for (body, e) in block {
                let y = &y[3 * body..3 * body + 3];
                for (j, sum) in sums.iter_mut().enumerate() {
                    *sum += e[0][j] * y[0] + e[1][j] * y[1] + e[2][j] * y[2];
                }
            }
        }
        sums[3 * self.blocks.len()] = dot(&self.growth, y);
        sums
    }

    pub fn constants(&self) -> Vec<f64> {
        self.rows.iter().map(|row| row.constant).collect()
    }
}

/// The scalar product of three entries.
pub fn dot3(a: &[f64; 3], b: &[f64]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
