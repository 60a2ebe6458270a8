//! Static condensation of a macroblock onto the nodes on its faces; the only file that knows faer.
//!
//! A node is a point of a face, tied to the subblocks there by two springs (its link, along the contact's normal and
//! tangent). With the nodes' displacements p given, the subblocks' displacements D follow from
//! `K D = F + X0 p`, where K holds elasticity, seams and links and X0 the links' forces; so `D = X p + K^-1 F` with
//! `X = K^-1 X0`, and on the nodes act `S p - X' F`, with `S = links - X0' X` (Guyan 1965). Nothing is lost: the condensed
//! macroblock answers to forces at its nodes exactly as the whole one does.

use super::block::V6;
use super::heart::{Heart, Stopped};
use super::macroblock::Macroblock;
use crate::geometry::Vec2;
use faer::linalg::solvers::{Llt, Solve};
use faer::sparse::linalg::solvers::{Llt as SparseLlt, SymbolicLlt};
use faer::sparse::{SparseColMat, SymbolicSparseColMat, Triplet};
use faer::{Mat, Side};
use nalgebra::{DMatrix, DVector};
use std::ops::Range;

/// A node on a face, tied to the subblocks there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// Its place, m.
    pub at: Vec2,
    /// Unit vectors along which its two displacements count.
    pub axes: [Vec2; 2],
    /// Stiffness of its link along them, N/m2.
    pub link: [f64; 2],
    /// The one or two subblocks it is tied to, and with which share each.
    pub holds: [(usize, f64); 2],
}

/// Cholesky factors of a macroblock's stiffness: dense where it has one subblock, sparse otherwise.
#[derive(Debug, Clone)]
enum Factors {
    Dense(Llt<f64>),
    Sparse(SparseLlt<usize, f64>),
}

/// A macroblock condensed onto its nodes, in its own frame.
#[derive(Debug, Clone)]
pub struct Condensed {
    /// X: displacements of the subblocks per displacement of the nodes, 6 n_subblocks x 2 n_nodes.
    response: DMatrix<f64>,
    /// S: forces on the nodes per displacement of the nodes, 2 n_nodes x 2 n_nodes, N/m2.
    stiffness: DMatrix<f64>,
    /// Rigid motions of the nodes, orthonormal columns, and the same motions of the subblocks.
    rigid: [DMatrix<f64>; 2],
    factors: Factors,
}

/// Why a macroblock cannot be condensed: its nodes do not hold it, so it is free to move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("a block is held by fewer than two contact points")]
pub struct Loose;

/// Why a chain was not built.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Unbuilt {
    /// A body is not held.
    #[error(transparent)]
    Loose(#[from] Loose),
    /// Asked to stop.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// So many columns at least, and less than twice as many, are solved for, or multiplied, between two heartbeats. The last
/// bits of the answer are those of all columns at once, which those of fewer than a dozen are not: unit test.
const AT_ONCE: usize = 16;
/// Work of adding a block of stiffness, of sorting an entry into its place, and of solving for an entry of a column, in
/// multiplications.
const ADDED: usize = 200;
const SORTED: usize = 50;
const SOLVED: usize = 50;

impl Condensed {
    /// Condenses `body` onto `nodes`, both seen from one frame.
    ///
    /// # Errors
    /// When the nodes leave the body a rigid motion, or when stopped.
    pub fn new(body: &Macroblock, nodes: &[Node], heart: &Heart) -> Result<Self, Unbuilt> {
        let (unknowns, columns) = (6 * body.blocks().len(), 2 * nodes.len());
        let mut ties = DMatrix::zeros(unknowns, columns);
        for (i, node) in nodes.iter().enumerate() {
            for (c, (axis, link)) in node.axes.into_iter().zip(node.link).enumerate() {
                for (block, share) in node.holds {
                    let row = body.blocks()[block].displacement_row(node.at, axis) * (link * share);
                    let mut place = ties.fixed_view_mut::<6, 1>(6 * block, 2 * i + c);
                    place += row;
                }
            }
        }
        heart.beat()?;
        let links: Vec<f64> = nodes.iter().flat_map(|node| node.link).collect();
        let factors = factor(body, &held(body, &ties, &links), heart)?.ok_or(Loose)?;
        let response = solve(&factors, &ties, heart)?;
        let raw = DMatrix::from_diagonal(&DVector::from_vec(links)) - product(&ties.transpose(), &response, heart)?;
        let rigid = rigid_motions(body, nodes);
        let q = &rigid[0];
        // Rounding in the elimination must not take away equilibrium: a rigid motion costs no force at all.
        let still = DMatrix::identity(columns, columns) - q * q.transpose();
        let stiffness = &still * (0.5 * (&raw + raw.transpose())) * &still;
        Ok(Condensed { response, stiffness, rigid, factors })
    }

    /// Stiffness S on the nodes, N/m2.
    pub fn stiffness(&self) -> &DMatrix<f64> {
        &self.stiffness
    }

    /// Displacements X of the subblocks per displacement of the nodes.
    pub fn response(&self) -> &DMatrix<f64> {
        &self.response
    }

    /// Displacements of the subblocks under `load` with the nodes held.
    pub fn inner(&self, load: &DVector<f64>) -> DVector<f64> {
        solve_one(&self.factors, load)
    }

    /// The forces on the nodes that stand for `load`.
    pub fn on_nodes(&self, load: &DVector<f64>) -> DVector<f64> {
        let mut on_nodes = self.response.tr_mul(load);
        let [of_nodes, of_blocks] = &self.rigid;
        let missing = of_blocks.tr_mul(load) - of_nodes.tr_mul(&on_nodes);
        on_nodes += of_nodes * missing;
        on_nodes
    }
}

/// Displacements of the subblocks of a free body under a load in equilibrium, with no motion of the first subblock.
///
/// `load`: generalised loads of all subblocks, 6 n_subblocks.
/// None where the body's stiffness does not hold.
///
/// # Errors
/// When stopped.
pub fn free_response(body: &Macroblock, load: &DVector<f64>, heart: &Heart) -> Result<Option<DVector<f64>>, Stopped> {
    let modulus = body.blocks()[0].youngs_modulus();
    // Three springs on three rigid motions: statically determinate, so that a load in equilibrium does not feel them.
    let springs: Vec<Triplet<usize, usize, f64>> = (0..3).map(|i| Triplet::new(i, i, modulus)).collect();
    Ok(factor(body, &springs, heart)?.map(|factors| solve_one(&factors, load)))
}

/// Stiffness of the links on the subblocks: T' k T with T k = `ties`.
fn held(body: &Macroblock, ties: &DMatrix<f64>, links: &[f64]) -> Vec<Triplet<usize, usize, f64>> {
    let mut triplets = Vec::new();
    for (c, &link) in links.iter().enumerate() {
        let column = ties.column(c);
        let rows: Vec<usize> = (0..6 * body.blocks().len()).filter(|&i| column[i] != 0.0).collect();
        for &i in rows.iter().filter(|_| link > 0.0) {
            triplets.extend(rows.iter().map(|&j| Triplet::new(i, j, column[i] * column[j] / link)));
        }
    }
    triplets
}

fn factor(body: &Macroblock, more: &[Triplet<usize, usize, f64>], heart: &Heart) -> Result<Option<Factors>, Stopped> {
    let n = 6 * body.blocks().len();
    // All at once: to grow would be to copy a hundred megabytes, in one go.
    let mut triplets = Vec::with_capacity(more.len() + 36 * body.stiffness_count());
    triplets.extend_from_slice(more);
    body.stiffness(|i, j, block| {
        for a in 0..6 {
            triplets.extend((0..6).map(|b| Triplet::new(6 * i + a, 6 * j + b, block[(a, b)])));
        }
        // Where this says to stop, the next beat does too.
        let _ = heart.work(ADDED);
    });
    if n == 6 {
        let mut dense = Mat::<f64>::zeros(n, n);
        triplets.iter().for_each(|t| dense[(t.row, t.col)] += t.val);
        return Ok(dense.llt(Side::Lower).ok().map(Factors::Dense));
    }
    heart.beat()?;
    let sparse = assemble(n, &triplets, heart)?;
    drop(triplets);
    heart.beat()?;
    let Ok(order) = SymbolicLlt::try_new(sparse.symbolic(), Side::Lower) else { return Ok(None) };
    heart.beat()?;
    let factors = SparseLlt::try_new_with_symbolic(order, sparse.as_ref(), Side::Lower);
    heart.beat()?;
    Ok(factors.ok().map(Factors::Sparse))
}

/// The square matrix of `n` rows that these are the entries of, column by column. It is what faer makes of them, which adds
/// up those of one place in the same order, but would do so in one go.
fn assemble(
    n: usize,
    triplets: &[Triplet<usize, usize, f64>],
    heart: &Heart,
) -> Result<SparseColMat<usize, f64>, Stopped> {
    let mut end = vec![0; n];
    triplets.iter().for_each(|t| end[t.col] += 1);
    let mut all = 0;
    for end in &mut end {
        (all, *end) = (all + *end, all);
    }
    heart.beat()?;
    let mut order = vec![0; all];
    for (i, t) in triplets.iter().enumerate() {
        order[end[t.col]] = i;
        end[t.col] += 1;
    }
    heart.beat()?;
    let (mut columns, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
    let mut start = 0;
    for end in end {
        let column = &mut order[start..end];
        column.sort_unstable_by_key(|&i| triplets[i].row);
        let mut last = None;
        for &Triplet { row, val, .. } in column.iter().map(|&i| &triplets[i]) {
            match values.last_mut() {
                Some(sum) if last == Some(row) => *sum += val,
                _ => {
                    rows.push(row);
                    values.push(val);
                }
            }
            last = Some(row);
        }
        columns.push(rows.len());
        heart.work(SORTED * (end - start))?;
        start = end;
    }
    Ok(SparseColMat::new(SymbolicSparseColMat::new_checked(n, n, columns, None, rows), values))
}

/// K^-1 `right`, some columns at a time.
fn solve(factors: &Factors, right: &DMatrix<f64>, heart: &Heart) -> Result<DMatrix<f64>, Stopped> {
    let (rows, columns) = right.shape();
    let mut all = DMatrix::zeros(rows, columns);
    for part in parts(columns) {
        let some = solve_some(factors, &Mat::from_fn(rows, part.len(), |i, j| right[(i, part.start + j)]));
        for (j, column) in part.clone().enumerate() {
            all.column_mut(column).copy_from_slice(some.col_as_slice(j));
        }
        heart.work(SOLVED * rows * part.len())?;
    }
    Ok(all)
}

fn solve_one(factors: &Factors, right: &DVector<f64>) -> DVector<f64> {
    let x = solve_some(factors, &Mat::from_fn(right.len(), 1, |i, _| right[i]));
    DVector::from_fn(right.len(), |i, _| x[(i, 0)])
}

fn solve_some(factors: &Factors, right: &Mat<f64>) -> Mat<f64> {
    match factors {
        Factors::Dense(factors) => factors.solve(right),
        Factors::Sparse(factors) => factors.solve(right),
    }
}

/// The product of two matrices, some columns at a time.
fn product(a: &DMatrix<f64>, b: &DMatrix<f64>, heart: &Heart) -> Result<DMatrix<f64>, Stopped> {
    let mut all = DMatrix::zeros(a.nrows(), b.ncols());
    for part in parts(b.ncols()) {
        all.columns_mut(part.start, part.len()).gemm(1.0, a, &b.columns(part.start, part.len()), 0.0);
        heart.work(a.nrows() * a.ncols() * part.len())?;
    }
    Ok(all)
}

/// Columns in parts of which none is small.
fn parts(columns: usize) -> impl Iterator<Item = Range<usize>> {
    let count = (columns / AT_ONCE).max(1);
    (0..count).map(move |i| i * columns / count..(i + 1) * columns / count)
}

/// The three rigid motions as displacements of the nodes (orthonormal) and of the subblocks.
fn rigid_motions(body: &Macroblock, nodes: &[Node]) -> [DMatrix<f64>; 2] {
    let centre = nodes.iter().map(|n| n.at).sum::<Vec2>() / nodes.len().max(1) as f64;
    let field = |motion: usize, at: Vec2| match motion {
        0 => Vec2::x(),
        1 => Vec2::y(),
        _ => Vec2::new(centre.y - at.y, at.x - centre.x),
    };
    let of_nodes =
        DMatrix::from_fn(2 * nodes.len(), 3, |i, m| field(m, nodes[i / 2].at).dot(&nodes[i / 2].axes[i % 2]));
    let of_blocks = DMatrix::from_fn(6 * body.blocks().len(), 3, |i, m| {
        let block = &body.blocks()[i / 6];
        let velocity = field(m, block.centroid());
        let spin = if m == 2 { block.size() } else { 0.0 };
        V6::from([velocity.x, velocity.y, spin, 0.0, 0.0, 0.0])[i % 6]
    });
    orthonormal(of_nodes, of_blocks)
}

/// Orthonormal columns of `a`, and the same combinations of the columns of `b` (modified Gram and Schmidt, twice).
fn orthonormal(mut a: DMatrix<f64>, mut b: DMatrix<f64>) -> [DMatrix<f64>; 2] {
    for k in 0..a.ncols() {
        for j in (0..k).chain(0..k) {
            let share = a.column(j).dot(&a.column(k));
            let (aj, bj) = (a.column(j) * share, b.column(j) * share);
            a.column_mut(k).zip_apply(&aj, |x, y| *x -= y);
            b.column_mut(k).zip_apply(&bj, |x, y| *x -= y);
        }
        let norm = a.column(k).norm();
        a.column_mut(k).unscale_mut(norm);
        b.column_mut(k).unscale_mut(norm);
    }
    [a, b]
}

#[cfg(test)]
mod tests;
