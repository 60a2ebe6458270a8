//! Linear programmes with many sparse unknowns: a primal-dual interior point method; the only file of this room that knows faer.
//!
//! Minimise c x over E x = b and s = A x + h >= 0. Unknowns come in blocks of three, one a joint, and a last one, the load
//! factor; rows of A touch one block, rows of E come in blocks of three, one a body. The method works on the homogeneous
//! self-dual embedding (Ye, Todd and Mizuno 1994; steps after Mehrotra 1992), which ends in an optimum or in a proof that there is
//! none, and never needs a point to start from. Eliminating s, z and x leaves S = sum E_j H_j^-1 E_j', as sparse as bodies touch.

use super::linear_program::{Beat, dot};
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{SparseColMat, SymbolicSparseColMat};
use faer::{Mat, Side};
use std::collections::BTreeMap;

/// Iterations after which the method has failed (it needs 10 to 40).
const MOST_ITERATIONS: usize = 120;
/// Residuals and gap at which it goes no further, relative to the size of the data and of the point.
const ENOUGH: f64 = 1e-13;
/// A proof that there is no optimum may be off by this.
const PROVEN: f64 = 1e-9;
/// Share of the way to the boundary that a step goes.
const STEP: f64 = 0.99;
/// Iterations without a better point after which rounding has won.
const PATIENCE: usize = 20;
/// So much worse than a best point that is as near as this to the optimum: rounding has won.
const BLOWN_UP: f64 = 1e4;
const NEAR: f64 = 1e-6;
/// Root of the curvature of a block without rows.
const UNREACHED: f64 = 1e-4;
/// Corrections of a solution of the Newton system.
const REFINEMENTS: usize = 3;
/// Added to the Hessian of a block that its rows leave singular, relative to its largest entry.
const RIDGE: f64 = 1e-10;

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
    /// Column of E of the load factor, and right-hand sides.
    pub growth: Vec<f64>,
    pub right: Vec<f64>,
    /// c: three entries a block, and that of the load factor.
    pub cost: Vec<f64>,
}

/// What comes of it.
#[derive(Debug, Clone)]
pub enum Found {
    /// Unknowns and the multipliers z >= 0 of the rows, and how far they are from a proof of the optimum.
    Optimum {
        x: Vec<f64>,
        z: Vec<f64>,
        error: f64,
    },
    /// A direction of unlimited descent.
    Unbounded,
    Infeasible,
    Lost,
}

/// A point of the embedding.
#[derive(Debug, Clone)]
struct Point {
    x: Vec<f64>,
    y: Vec<f64>,
    s: Vec<f64>,
    z: Vec<f64>,
    tau: f64,
    kappa: f64,
}

impl Sparse {
    fn unknowns(&self) -> usize {
        3 * self.blocks.len() + 1
    }

    /// A x.
    fn rows_times(&self, x: &[f64]) -> Vec<f64> {
        let n = self.blocks.len();
        let value = |row: &Row| match row.block {
            block if block == n => row.a[0] * x[3 * n],
            block => (0..3).map(|i| row.a[i] * x[3 * block + i]).sum(),
        };
        self.rows.iter().map(value).collect()
    }

    /// A' z, added to `sum` times `sign`.
    fn add_transposed(&self, z: &[f64], sign: f64, sum: &mut [f64]) {
        for (row, z) in self.rows.iter().zip(z) {
            let dimensions = if row.block == self.blocks.len() { 1 } else { 3 };
            (0..dimensions).for_each(|i| sum[3 * row.block + i] += sign * z * row.a[i]);
        }
    }

    /// E x.
    fn balance(&self, x: &[f64]) -> Vec<f64> {
        let last = x[3 * self.blocks.len()];
        let mut sums: Vec<f64> = self.growth.iter().map(|g| g * last).collect();
        for (k, block) in self.blocks.iter().enumerate() {
            for (body, e) in block {
                (0..3).for_each(|i| sums[3 * body + i] += (0..3).map(|j| e[i][j] * x[3 * k + j]).sum::<f64>());
            }
        }
        sums
    }

    /// E' y.
    fn motion(&self, y: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.unknowns()];
        for (k, block) in self.blocks.iter().enumerate() {
            for (body, e) in block {
                (0..3).for_each(|j| sums[3 * k + j] += (0..3).map(|i| e[i][j] * y[3 * body + i]).sum::<f64>());
            }
        }
        sums[3 * self.blocks.len()] = dot(&self.growth, y);
        sums
    }

    fn constants(&self) -> Vec<f64> {
        self.rows.iter().map(|row| row.constant).collect()
    }
}

/// The pattern of S and its elimination order, found once.
struct Pattern {
    columns: Vec<usize>,
    rows: Vec<usize>,
    /// Of every pair of bodies with a block in the lower triangle: where the block's columns start.
    places: BTreeMap<(usize, usize), [usize; 3]>,
    order: SymbolicLlt<usize>,
}

impl Pattern {
    fn new(programme: &Sparse) -> Option<Self> {
        let n = programme.bodies;
        let mut below: Vec<Vec<usize>> = (0..n).map(|body| vec![body]).collect();
        for block in &programme.blocks {
            for (a, _) in block {
                block.iter().filter(|(b, _)| b > a).for_each(|(b, _)| below[*a].push(*b));
            }
        }
        let (mut columns, mut rows, mut places) = (vec![0], Vec::new(), BTreeMap::new());
        for (a, neighbours) in below.iter_mut().enumerate() {
            neighbours.sort_unstable();
            neighbours.dedup();
            for column in 0..3 {
                for &b in neighbours.iter() {
                    places.entry((b, a)).or_insert([0; 3])[column] = rows.len();
                    rows.extend(3 * b..3 * b + 3);
                }
                columns.push(rows.len());
            }
        }
        let symbolic = SymbolicSparseColMat::new_checked(3 * n, 3 * n, columns.clone(), None, rows.clone());
        let order = SymbolicLlt::try_new(symbolic.as_ref(), Side::Lower).ok()?;
        Some(Pattern { columns, rows, places, order })
    }
}

/// The Newton system at a point, factored.
struct Newton<'p> {
    programme: &'p Sparse,
    /// z / s of every row.
    weights: Vec<f64>,
    /// C of every block, H^-1 = C C'.
    roots: Vec<Square>,
    factors: Llt<usize, f64>,
    /// S^-1 growth, and the curvature of the load factor without the rest.
    growth: Vec<f64>,
    schur: f64,
}

impl<'p> Newton<'p> {
    fn new(programme: &'p Sparse, pattern: &Pattern, point: &Point) -> Option<Self> {
        let weights: Vec<f64> = point.z.iter().zip(&point.s).map(|(z, s)| z / s).collect();
        let n = programme.blocks.len();
        let mut scaled: Vec<Vec<[f64; 4]>> = vec![Vec::new(); n];
        let mut last = 0.0;
        for (row, weight) in programme.rows.iter().zip(&weights) {
            if row.block == n {
                last += weight * row.a[0] * row.a[0];
            } else {
                let [a, b, c] = row.a.map(|a| a * weight.sqrt());
                scaled[row.block].push([*weight, a, b, c]);
            }
        }
        let roots: Vec<Square> = scaled.iter_mut().map(|rows| inverse_root(rows)).collect();
        let factors = factor(programme, pattern, &roots)?;
        let mut newton = Newton { programme, weights, roots, factors, growth: Vec::new(), schur: 0.0 };
        newton.growth = newton.solve_bodies(&programme.growth);
        newton.schur = last + dot(&programme.growth, &newton.growth);
        if last == 0.0 && programme.growth.iter().all(|g| *g == 0.0) {
            // Nothing depends on the load factor.
            newton.schur = 1.0;
        }
        (newton.schur > 0.0 && newton.schur.is_finite()).then_some(newton)
    }

    fn solve_bodies(&self, right: &[f64]) -> Vec<f64> {
        let x = self.factors.solve(&Mat::from_fn(right.len(), 1, |i, _| right[i]));
        (0..right.len()).map(|i| x[(i, 0)]).collect()
    }

    /// H^-1 of the blocks times `right`; the entry of the load factor stays.
    fn invert_blocks(&self, right: &[f64]) -> Vec<f64> {
        let mut x = right.to_vec();
        for (root, x) in self.roots.iter().zip(x.chunks_exact_mut(3)) {
            let half: [f64; 3] = std::array::from_fn(|j| (0..3).map(|i| root[i][j] * x[i]).sum());
            (0..3).for_each(|i| x[i] = (0..3).map(|j| root[i][j] * half[j]).sum());
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
    fn solve(&self, first: &[f64], second: &[f64]) -> (Vec<f64>, Vec<f64>) {
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
            if next > 0.5 * left || next == 0.0 {
                break;
            }
            left = next;
        }
        (x, y)
    }

    fn residuals(&self, first: &[f64], second: &[f64], x: &[f64], y: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let weighted: Vec<f64> = self.programme.rows_times(x).iter().zip(&self.weights).map(|(a, w)| a * w).collect();
        let mut rest = sum(first, &self.programme.motion(y), -1.0);
        self.programme.add_transposed(&weighted, -1.0, &mut rest);
        (rest, sum(second, &self.programme.balance(x), -1.0))
    }
}

/// C with C C' = (sum of w a a')^-1 from rows (w, sqrt(w) a), by an orthogonal decomposition of the rows, the heaviest first and
/// the longest column first, so that a light row keeps its digits beside a heavy one. A direction that no row reaches is held
/// by a ridge.
fn inverse_root(rows: &mut Vec<[f64; 4]>) -> Square {
    rows.sort_by(|a, b| b[0].total_cmp(&a[0]));
    let size = rows.iter().map(|row| row[1..].iter().fold(0.0, |m: f64, x| m.max(x.abs()))).fold(0.0, f64::max);
    let ridge = if size > 0.0 { size * RIDGE.sqrt() } else { UNREACHED };
    let mut m: Vec<[f64; 3]> = rows.iter().map(|row| [row[1], row[2], row[3]]).collect();
    let mut order = [0, 1, 2];
    let mut r: Square = [[0.0; 3]; 3];
    for k in 0..3 {
        let length = |m: &[[f64; 3]], c: usize| m.iter().skip(k).map(|row| row[c] * row[c]).sum::<f64>();
        let longest = (k..3).max_by(|&a, &b| length(&m, a).total_cmp(&length(&m, b))).unwrap_or(k);
        m.iter_mut().for_each(|row| row.swap(k, longest));
        r.iter_mut().take(k).for_each(|row| row.swap(k, longest));
        order.swap(k, longest);
        let alpha = length(&m, k).sqrt();
        if k >= m.len() || alpha <= SMALLEST * size || alpha == 0.0 {
            (k..3).for_each(|i| r[i][i] = ridge);
            break;
        }
        let alpha = if m[k][k] > 0.0 { -alpha } else { alpha };
        let mut v: Vec<f64> = m[k..].iter().map(|row| row[k]).collect();
        v[0] -= alpha;
        let square = dot(&v, &v);
        for c in k..3 {
            let by = 2.0 * v.iter().zip(&m[k..]).map(|(v, row)| v * row[c]).sum::<f64>() / square;
            v.iter().zip(&mut m[k..]).for_each(|(v, row)| row[c] -= by * v);
            r[k][c] = m[k][c];
        }
        r[k][k] = alpha;
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
fn factor(programme: &Sparse, pattern: &Pattern, roots: &[Square]) -> Option<Llt<usize, f64>> {
    let n = 3 * programme.bodies;
    let mut values = vec![0.0; pattern.rows.len()];
    for (block, root) in programme.blocks.iter().zip(roots) {
        let product = |e: &Square| -> Square {
            std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| e[i][k] * root[k][j]).sum()))
        };
        let halves: Vec<(usize, Square)> = block.iter().map(|(body, e)| (*body, product(e))).collect();
        for (a, left) in &halves {
            for (b, right) in halves.iter().filter(|(b, _)| b >= a) {
                let starts = pattern.places[&(*b, *a)];
                for (column, start) in starts.into_iter().enumerate() {
                    for row in 0..3 {
                        values[start + row] += dot(&right[row], &left[column]);
                    }
                }
            }
        }
    }
    for ridge in [0.0, 1e-14, 1e-12, 1e-10, 1e-8] {
        let mut shifted = values.clone();
        // The diagonal is the first entry of a column at and below it.
        for column in 0..n {
            let start = pattern.columns[column] + column % 3;
            shifted[start] *= 1.0 + ridge;
            if shifted[start] == 0.0 {
                shifted[start] = 1.0;
            }
        }
        let symbolic = SymbolicSparseColMat::new_checked(n, n, pattern.columns.clone(), None, pattern.rows.clone());
        let matrix = SparseColMat::new(symbolic, shifted);
        if let Ok(factors) = Llt::try_new_with_symbolic(pattern.order.clone(), matrix.as_ref(), Side::Lower) {
            return Some(factors);
        }
    }
    None
}

/// Residuals of the embedding's linear equations: 0 = ...
struct Residuals {
    x: Vec<f64>,
    y: Vec<f64>,
    s: Vec<f64>,
    tau: f64,
}

impl Residuals {
    fn new(programme: &Sparse, constants: &[f64], point: &Point) -> Self {
        let mut x = programme.motion(&point.y);
        programme.add_transposed(&point.z, -1.0, &mut x);
        let x = sum(&x, &programme.cost, point.tau);
        let y = sum(&programme.balance(&point.x), &programme.right, -point.tau);
        let s = sum(&sum(&point.s, &programme.rows_times(&point.x), -1.0), constants, -point.tau);
        let products = [(&programme.cost, &point.x), (&programme.right, &point.y)].map(|(a, b)| dot(a, b));
        Residuals { x, y, s, tau: point.kappa + products[0] + products[1] + dot(constants, &point.z) }
    }
}

/// Solves a programme; an optimum's `error` bounds what is left of residuals and gap, relative to the data and the point.
pub fn minimise(programme: &Sparse, beat: Beat) -> Found {
    let Some(pattern) = Pattern::new(programme) else { return Found::Lost };
    let constants = programme.constants();
    let rows = programme.rows.len();
    let mut point = Point {
        x: vec![0.0; programme.unknowns()],
        y: vec![0.0; 3 * programme.bodies],
        s: vec![1.0; rows],
        z: vec![1.0; rows],
        tau: 1.0,
        kappa: 1.0,
    };
    let (mut best, mut since) = (None::<(f64, Vec<f64>, Vec<f64>)>, 0);
    for _ in 0..MOST_ITERATIONS {
        if beat().is_break() {
            return Found::Lost;
        }
        let residuals = Residuals::new(programme, &constants, &point);
        if let Some(found) = without_optimum(programme, &constants, &point, &residuals) {
            return found;
        }
        let error = error(programme, &constants, &point, &residuals);
        if error.is_nan() {
            break;
        }
        if best.as_ref().is_some_and(|best| best.0 < NEAR && error > BLOWN_UP * best.0) {
            break;
        }
        since += 1;
        if best.as_ref().is_none_or(|best| error < best.0) {
            let by_tau = |v: &[f64]| v.iter().map(|x| x / point.tau).collect();
            best = Some((error, by_tau(&point.x), by_tau(&point.z)));
            since = 0;
        }
        if error < ENOUGH || since > PATIENCE {
            break;
        }
        let Some(newton) = Newton::new(programme, &pattern, &point) else { break };
        step(programme, &constants, &newton, &residuals, &mut point);
    }
    best.map_or(Found::Lost, |(error, x, z)| Found::Optimum { x, z, error })
}

/// Largest of the residuals and the gap, relative to the data and the point.
fn error(programme: &Sparse, constants: &[f64], point: &Point, residuals: &Residuals) -> f64 {
    let tau = point.tau;
    let primal = largest(&residuals.y).max(largest(&residuals.s)) / tau;
    let dual = largest(&residuals.x) / tau;
    let value = dot(&programme.cost, &point.x) / tau;
    let bound = -(dot(&programme.right, &point.y) + dot(constants, &point.z)) / tau;
    let gap = (value - bound).abs() / (1e-3 + value.abs());
    // `max` drops what is no number.
    [primal, dual, gap].into_iter().fold(0.0, |m, e| if e.is_nan() || e > m { e } else { m })
}

/// A proof that there is no optimum.
fn without_optimum(programme: &Sparse, constants: &[f64], point: &Point, residuals: &Residuals) -> Option<Found> {
    let bound = -(dot(&programme.right, &point.y) + dot(constants, &point.z));
    let descent = -dot(&programme.cost, &point.x);
    let dual = largest(&sum(&residuals.x, &programme.cost, -point.tau));
    if bound > 0.0 && dual < PROVEN * bound && point.tau < 1e-3 * point.kappa {
        return Some(Found::Infeasible);
    }
    let primal =
        largest(&sum(&residuals.y, &programme.right, point.tau)).max(largest(&sum(&residuals.s, constants, point.tau)));
    (descent > 0.0 && primal < PROVEN * descent && point.tau < 1e-3 * point.kappa).then_some(Found::Unbounded)
}

/// One predictor and corrector step.
fn step(programme: &Sparse, constants: &[f64], newton: &Newton, residuals: &Residuals, point: &mut Point) {
    let rows = point.s.len();
    let mu = (dot(&point.s, &point.z) + point.tau * point.kappa) / (rows as f64 + 1.0);
    let weighted = |v: &[f64]| v.iter().zip(&newton.weights).map(|(v, w)| v * w).collect::<Vec<f64>>();
    // What one unit of tau adds.
    let mut first: Vec<f64> = programme.cost.iter().map(|c| -c).collect();
    programme.add_transposed(&weighted(constants), -1.0, &mut first);
    let (x2, y2) = newton.solve(&first, &programme.right);
    let z2: Vec<f64> = weighted(&sum(&programme.rows_times(&x2), constants, 1.0)).iter().map(|z| -z).collect();
    let pivot = -point.kappa / point.tau + dot(&programme.cost, &x2) + dot(&programme.right, &y2) + dot(constants, &z2);
    let direction = |share: f64, complementarity: &[f64], last: f64| -> Point {
        let scaled = |v: &[f64]| v.iter().map(|r| -share * r).collect::<Vec<f64>>();
        let (qx, qy, qs, qt) =
            (scaled(&residuals.x), scaled(&residuals.y), scaled(&residuals.s), -share * residuals.tau);
        let over: Vec<f64> = complementarity.iter().zip(&point.s).map(|(c, s)| c / s).collect();
        let mut first = qx;
        programme.add_transposed(&sum(&over, &weighted(&qs), -1.0), 1.0, &mut first);
        let (x1, y1) = newton.solve(&first, &qy);
        let moved = sum(&programme.rows_times(&x1), &qs, 1.0);
        let z1 = sum(&over, &weighted(&moved), -1.0);
        let rest = qt - last / point.tau - dot(&programme.cost, &x1) - dot(&programme.right, &y1) - dot(constants, &z1);
        let tau = rest / pivot;
        let (x, y, z) = (sum(&x1, &x2, tau), sum(&y1, &y2, tau), sum(&z1, &z2, tau));
        let s = sum(&sum(&programme.rows_times(&x), constants, tau), &qs, 1.0);
        Point { x, y, s, z, tau, kappa: (last - point.kappa * tau) / point.tau }
    };
    let products: Vec<f64> = point.s.iter().zip(&point.z).map(|(s, z)| -s * z).collect();
    let affine = direction(1.0, &products, -point.tau * point.kappa);
    let reach = longest(point, &affine).min(1.0);
    let centring = (1.0 - reach).powi(3);
    let corrected = |i: usize| products[i] - affine.s[i] * affine.z[i] + centring * mu;
    let complementarity: Vec<f64> = (0..rows).map(corrected).collect();
    let last = -point.tau * point.kappa - affine.tau * affine.kappa + centring * mu;
    let chosen = direction(1.0 - centring, &complementarity, last);
    let length = (STEP * longest(point, &chosen)).min(1.0);
    let advance = |v: &mut Vec<f64>, d: &[f64]| v.iter_mut().zip(d).for_each(|(v, d)| *v += length * d);
    advance(&mut point.x, &chosen.x);
    advance(&mut point.y, &chosen.y);
    advance(&mut point.s, &chosen.s);
    advance(&mut point.z, &chosen.z);
    point.tau += length * chosen.tau;
    point.kappa += length * chosen.kappa;
}

/// How far a direction leads before something positive vanishes.
fn longest(point: &Point, direction: &Point) -> f64 {
    let pairs = point.s.iter().zip(&direction.s).chain(point.z.iter().zip(&direction.z));
    let scalars = [(&point.tau, &direction.tau), (&point.kappa, &direction.kappa)];
    pairs.chain(scalars).filter(|(_, d)| **d < 0.0).map(|(v, d)| -v / d).fold(1e30, f64::min)
}

fn sum(a: &[f64], b: &[f64], by: f64) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + by * b).collect()
}

/// Largest entry; NaN if there is one.
fn largest(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |m, x| if x.is_nan() || x.abs() > m { x.abs() } else { m })
}
