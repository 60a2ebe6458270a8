//! The Newton system of the interior point method; the only file of this room that knows faer.

use super::super::linear_program::{dot, largest};
use super::cone::Scaling;
use super::sparse::dot3;
use super::{Point, Sparse, Square, sum};
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{MatMut, Side};

/// Root of the curvature of a block without rows.
const EMPTY_BLOCK: f64 = 1e-4;
/// Residuals of a solution of the Newton system that no correction betters much, relative to the right-hand sides; where less is
/// asked of the programme, so it is of these.
const EXACT_NEWTON: f64 = 1e-12;
/// Corrections of a solution of the Newton system.
const REFINEMENTS: usize = 3;
/// Added to the Hessian of a block that its rows leave singular, relative to its largest entry.
const RIDGE: f64 = 1e-10;

/// The pattern of S and its elimination order, found once.
#[derive(Debug, Clone)]
pub struct NewtonPattern {
    matrix: SymbolicSparseColMat<usize>,
    /// Of every joint the pairs of its bodies (places in its list) with a block in the lower triangle: where its columns start.
    places: Vec<Vec<([usize; 2], [usize; 3])>>,
    order: SymbolicLlt<usize>,
}

impl NewtonPattern {
    /// Of so many bodies and the lists of those that each joint touches; None where there is no memory for it.
    pub fn new(bodies: usize, joints: &[Vec<usize>]) -> Option<Self> {
        let mut below: Vec<Vec<usize>> = (0..bodies).map(|body| vec![body]).collect();
        for joint in joints {
            for a in joint {
                below[*a].extend(joint.iter().filter(|b| *b > a));
            }
        }
        let (mut columns, mut rows) = (vec![0], Vec::new());
        for neighbours in &mut below {
            neighbours.sort_unstable();
            neighbours.dedup();
            for _ in 0..3 {
                rows.extend(neighbours.iter().flat_map(|b| 3 * b..3 * b + 3));
                columns.push(rows.len());
            }
        }
        let place = |a: usize, b: usize| {
            let row = 3 * below[a].iter().position(|other| *other == b)?;
            Some([0, 1, 2].map(|column| columns[3 * a + column] + row))
        };
        let pairs = |joint: &Vec<usize>| {
            let all = (0..joint.len()).flat_map(|i| (0..joint.len()).map(move |j| [i, j]));
            all.filter_map(|pair| Some((pair, place(joint[pair[0]], joint[pair[1]])?))).collect()
        };
        let places = joints.iter().map(pairs).collect();
        let matrix = SymbolicSparseColMat::new_checked(3 * bodies, 3 * bodies, columns, None, rows);
        let order = SymbolicLlt::try_new(matrix.as_ref(), Side::Lower).ok()?;
        Some(NewtonPattern { matrix, places, order })
    }
}

/// The Newton system at a point, factored.
pub(super) struct Newton<'p> {
    programme: &'p Sparse,
    pub(super) scaling: Scaling,
    /// C of every block, H^-1 = C C'.
    roots: Vec<Square>,
    factors: Llt<usize, f64>,
    /// S^-1 growth, and the curvature of the load factor without the rest.
    growth: Vec<f64>,
    schur: f64,
    /// Residuals of a solution that are small enough.
    exact: f64,
}

impl<'p> Newton<'p> {
    pub(super) fn new(programme: &'p Sparse, pattern: &NewtonPattern, point: &Point, enough: f64) -> Option<Self> {
        let scaling = Scaling::new(programme, point);
        let mut scaled = scaling.rows(programme);
        scaled.sort_by_key(|(block, _)| *block);
        let (mut rest, mut own) = (&scaled[..], Vec::new());
        let root = |block: usize| {
            let (rows, others) = rest.split_at(rest.iter().take_while(|(of, _)| *of == block).count());
            rest = others;
            own.clear();
            own.extend(rows.iter().map(|(_, row)| *row));
            inverse_root(&mut own)
        };
        let roots: Vec<Square> = (0..programme.blocks.len()).map(root).collect();
        let last: f64 = rest.iter().map(|(_, row)| row[0] * row[0]).sum();
        let factors = factor(programme, pattern, &roots)?;
        let (growth, schur, exact) = (Vec::new(), 0.0, EXACT_NEWTON.max(enough));
        let mut newton = Newton { programme, scaling, roots, factors, growth, schur, exact };
        newton.growth = newton.solve_bodies(&programme.growth);
        newton.schur = last + dot(&programme.growth, &newton.growth);
        if last == 0.0 && programme.growth.iter().all(|g| *g == 0.0) {
            // Nothing depends on the load factor.
            newton.schur = 1.0;
        }
        (newton.schur > 0.0 && newton.schur.is_finite()).then_some(newton)
    }

    fn solve_bodies(&self, right: &[f64]) -> Vec<f64> {
        let mut x = right.to_vec();
        self.factors.solve_in_place(MatMut::from_column_major_slice_mut(&mut x, right.len(), 1));
        x
    }

    /// H^-1 of the blocks times `right`; the entry of the load factor stays.
    fn invert_blocks(&self, right: &[f64]) -> Vec<f64> {
        let mut x = right.to_vec();
        for (root, x) in self.roots.iter().zip(x.chunks_exact_mut(3)) {
            let half = [0, 1, 2].map(|j| root[0][j] * x[0] + root[1][j] * x[1] + root[2][j] * x[2]);
            x.iter_mut().zip(root).for_each(|(x, root)| *x = dot3(root, &half));
        }
        x
    }

    /// H x + E' y = first, E x = second; once, with what rounding leaves.
    fn solve_once(&self, first: &[f64], second: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let n = 3 * self.programme.blocks.len();
        let mut free = self.invert_blocks(first);
        free[n] = 0.0;
        let right: Vec<f64> = self.programme.balance(&free).iter().zip(second).map(|(e, r)| e - r).collect();
        let base = self.solve_bodies(&right);
        let load_factor = (first[n] - dot(&self.programme.growth, &base)) / self.schur;
        let y: Vec<f64> = base.iter().zip(&self.growth).map(|(a, v)| a + load_factor * v).collect();
        let moved = self.programme.motion(&y);
        let right: Vec<f64> = first.iter().zip(moved).map(|(r, m)| r - m).collect();
        let mut x = self.invert_blocks(&right);
        x[n] = load_factor;
        (x, y)
    }

    /// The same, corrected as long as that helps.
    pub(super) fn solve(&self, first: &[f64], second: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let (mut x, mut y) = (vec![0.0; first.len()], vec![0.0; second.len()]);
        let (mut rest, mut others) = (first.to_vec(), second.to_vec());
        // Either kind of equation by its own size.
        let sizes = [largest(first), largest(second)].map(|size| if size > 0.0 { size } else { 1.0 });
        let size = |rest: &[f64], others: &[f64]| (largest(rest) / sizes[0]).max(largest(others) / sizes[1]);
        let mut left = f64::INFINITY;
        for _ in 0..=REFINEMENTS {
            let (dx, dy) = self.solve_once(&rest, &others);
            let [next_x, next_y] = [(&x, &dx), (&y, &dy)].map(|(a, d)| sum(a, d, 1.0));
            let (next_rest, next_others) = self.residuals(first, second, &next_x, &next_y);
            let next = size(&next_rest, &next_others);
            if next.is_nan() || next >= left {
                break;
            }
            (x, y, rest, others) = (next_x, next_y, next_rest, next_others);
            if next > 0.5 * left || next < self.exact {
                break;
            }
            left = next;
        }
        (x, y)
    }

    fn residuals(&self, first: &[f64], second: &[f64], x: &[f64], y: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let weighted = self.scaling.weighted(&self.programme.rows_times(x));
        let mut rest = sum(first, &self.programme.motion(y), -1.0);
        self.programme.add_transposed(&weighted, -1.0, &mut rest);
        (rest, sum(second, &self.programme.balance(x), -1.0))
    }
}

/// C with C C' = (sum of a a')^-1 from rows a, by an orthogonal decomposition of the rows, the heaviest first and
/// the longest column first, so that a light row keeps its digits beside a heavy one. A direction that no row reaches is held
/// by a ridge.
#[allow(clippy::needless_range_loop, reason = "indices are the mathematics here")]
fn inverse_root(rows: &mut [[f64; 3]]) -> Square {
    let weight = |row: &[f64; 3]| row.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    rows.sort_by(|a, b| weight(b).total_cmp(&weight(a)));
    let size = rows.first().map_or(0.0, weight);
    let ridge = if size > 0.0 { size * RIDGE.sqrt() } else { EMPTY_BLOCK };
    let m = rows;
    let mut order = [0, 1, 2];
    let mut r: Square = [[0.0; 3]; 3];
    for k in 0..3 {
        let length = |m: &[[f64; 3]], c: usize| m.iter().skip(k).map(|row| row[c] * row[c]).sum::<f64>();
        let longest = (k..3).max_by(|&a, &b| length(m, a).total_cmp(&length(m, b))).unwrap_or(k);
        m.iter_mut().for_each(|row| row.swap(k, longest));
        r.iter_mut().take(k).for_each(|row| row.swap(k, longest));
        order.swap(k, longest);
        let alpha = length(m, k).sqrt();
        if k >= m.len() || alpha <= SMALLEST * size || alpha == 0.0 {
            (k..3).for_each(|i| r[i][i] = ridge);
            break;
        }
        let alpha = if m[k][k] > 0.0 { -alpha } else { alpha };
        // The vector of the reflection takes the place of column k, which becomes (alpha, 0, ...).
        m[k][k] -= alpha;
        r[k][k] = alpha;
        let square = m[k..].iter().map(|row| row[k] * row[k]).sum::<f64>();
        for c in k + 1..3 {
            let by = 2.0 * m[k..].iter().map(|row| row[k] * row[c]).sum::<f64>() / square;
            m[k..].iter_mut().for_each(|row| row[c] -= by * row[k]);
            r[k][c] = m[k][c];
        }
    }
    // C = P R^-1, column by column.
    let mut root = [[0.0; 3]; 3];
    for c in 0..3 {
        let mut x = [0.0; 3];
        for i in (0..=c).rev() {
            let known: f64 = (i + 1..=c).map(|j| r[i][j] * x[j]).sum();
            x[i] = (f64::from(u8::from(i == c)) - known) / r[i][i];
        }
        (0..3).for_each(|i| root[order[i]][c] = x[i]);
    }
    root
}

/// A column shorter than this share of the longest row is none.
const SMALLEST: f64 = 1e-14;

/// S = sum E C C' E', factored; a share of its diagonal is added where rounding makes it indefinite.
fn factor(programme: &Sparse, pattern: &NewtonPattern, roots: &[Square]) -> Option<Llt<usize, f64>> {
    let n = 3 * programme.bodies;
    let mut values = vec![0.0; pattern.matrix.row_idx().len()];
    for ((block, root), places) in programme.blocks.iter().zip(roots).zip(&pattern.places) {
        let mut halves = [[[0.0; 3]; 3]; 2];
        for (half, (_, e)) in halves.iter_mut().zip(block) {
            for (half, e) in half.iter_mut().zip(e) {
                (0..3).for_each(|j| half[j] = e[0] * root[0][j] + e[1] * root[1][j] + e[2] * root[2][j]);
            }
        }
        for &([i, j], starts) in places {
            for (left, start) in halves[i].iter().zip(starts) {
                (0..3).for_each(|row| values[start + row] += dot3(&halves[j][row], left));
            }
        }
    }
    for ridge in [0.0, 1e-14, 1e-12, 1e-10, 1e-8] {
        // The diagonal is the first entry of a column at and below it.
        for column in 0..n {
            let start = pattern.matrix.col_ptr()[column] + column % 3;
            values[start] *= 1.0 + ridge;
            if values[start] == 0.0 {
                values[start] = 1.0;
            }
        }
        let matrix = SparseColMatRef::new(pattern.matrix.as_ref(), &values);
        if let Ok(factors) = Llt::try_new_with_symbolic(pattern.order.clone(), matrix, Side::Lower) {
            return Some(factors);
        }
    }
    None
}
