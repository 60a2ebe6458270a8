//! Static condensation of a macroblock onto the nodes on its faces.
//!
//! A node is a point of a face, tied to the subblocks there by two springs (its link, along the contact's normal and
//! tangent). With the nodes' displacements p given, the subblocks' displacements D follow from
//! `K D = F + X0 p`, where K holds elasticity, seams and links and X0 the links' forces; so `D = X p + K^-1 F` with
//! `X = K^-1 X0`, and on the nodes act `S p - X' F`, with `S = links - X0' X` (Guyan 1965). Nothing is lost: the condensed
//! macroblock answers to forces at its nodes exactly as the whole one does.

mod factors;
mod product;

use super::inside::Inside;
use crate::budget::{Budget, Stopped};
use crate::geometry::Vec2;
use factors::{Add, Factors};
use nalgebra::{DMatrix, DVector};
use product::product;
use std::array::from_fn;
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

/// A macroblock condensed onto its nodes, in its own frame.
#[derive(Debug, Clone)]
pub struct Condensed {
    /// Unknowns of the subblocks.
    unknowns: usize,
    /// X0, one column for each of the nodes' displacements.
    ties: Vec<Tie>,
    /// S: forces on the nodes per displacement of the nodes, 2 n_nodes x 2 n_nodes, N/m2.
    stiffness: DMatrix<f64>,
    /// Rigid motions of the nodes, orthonormal columns, and the same motions of the subblocks.
    rigid: [DMatrix<f64>; 2],
    factors: Factors,
}

/// Why a macroblock cannot be condensed: its nodes do not hold it, so it is free to move.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("a block is held by fewer than two contact points")]
pub struct Loose;

/// Why an assembly was not built.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Unbuilt {
    /// A body is not held.
    #[error(transparent)]
    Loose(#[from] Loose),
    /// Asked to stop.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// Displacement of a node along one of its axes.
#[derive(Debug, Clone)]
struct Tie {
    /// Stiffness of the link along it, N/m2.
    link: f64,
    /// Loads on the unknowns per unit of it, whole groups of them.
    loads: Vec<(usize, f64)>,
}

/// So many columns of X at least, and less than twice as many, are solved for at a time: X as a whole is the largest thing
/// there is, and nobody needs it.
const COLUMNS_AT_ONCE: usize = 16;
/// Work of solving for an entry of a column, in multiplications.
const SOLVED_COLUMN: usize = 50;

impl Condensed {
    /// Condenses `body` onto `nodes`, both seen from one frame. `see(j, x)` is shown every column of X, the displacements of
    /// the subblocks for displacement `j` of the nodes, which is not kept.
    ///
    /// # Errors
    /// When the nodes leave the body a rigid motion, or when stopped.
    pub fn new(
        body: &Inside,
        nodes: &[Node],
        budget: &Budget,
        mut see: impl FnMut(usize, &[f64]),
    ) -> Result<Self, Unbuilt> {
        let ties: Vec<Tie> = nodes.iter().flat_map(|node| [0, 1].map(|axis| Tie::new(body, node, axis))).collect();
        budget.ask()?;
        let links = |add: &mut Add| ties.iter().for_each(|tie| tie.stiffness(body.group(), add));
        let factors = Factors::new(body, links, budget)?.ok_or(Loose)?;
        let (unknowns, columns) = (body.unknowns(), ties.len());
        let mut raw = DMatrix::from_diagonal(&DVector::from_iterator(columns, ties.iter().map(|tie| tie.link)));
        for part in parts(columns) {
            let mut right = DMatrix::zeros(unknowns, part.len());
            for (j, tie) in ties[part.clone()].iter().enumerate() {
                tie.loads.iter().for_each(|&(i, load)| right[(i, j)] += load);
            }
            let x = factors.solve(&right);
            for (j, column) in part.clone().enumerate() {
                let x = &x.as_slice()[j * unknowns..(j + 1) * unknowns];
                raw.column_mut(column).iter_mut().zip(&ties).for_each(|(entry, tie)| *entry -= tie.work(x));
                see(column, x);
            }
            budget.work(SOLVED_COLUMN * unknowns * part.len())?;
        }
        let rigid = rigid_motions(body, nodes);
        let q = &rigid[0];
        // Rounding in the elimination must not take away equilibrium: a rigid motion costs no force at all.
        let still = DMatrix::identity(columns, columns) - q * q.transpose();
        let stiffness = product(&product(&still, &(0.5 * (&raw + raw.transpose())), budget)?, &still, budget)?;
        Ok(Condensed { unknowns, ties, stiffness, rigid, factors })
    }

    /// What ties some displacements of the nodes to the first subblock, as one matrix over both, the subblock's unknowns last,
    /// row by row, N/m2.
    pub(super) fn ties(&self, range: Range<usize>) -> Vec<f64> {
        let (nodes, width) = (range.len(), range.len() + 6);
        let mut matrix = vec![0.0; width * width];
        for (i, tie) in self.ties[range].iter().enumerate() {
            matrix[i * width + i] = tie.link;
            for &(a, load) in tie.loads.iter().filter(|_| tie.link > 0.0) {
                matrix[i * width + nodes + a] -= load;
                matrix[(nodes + a) * width + i] -= load;
                for (b, other) in &tie.loads {
                    matrix[(nodes + a) * width + nodes + b] += load * other / tie.link;
                }
            }
        }
        matrix
    }

    /// Stiffness S on the nodes, N/m2.
    pub fn stiffness(&self) -> &DMatrix<f64> {
        &self.stiffness
    }

    /// Displacements of the subblocks under `load` with the nodes held.
    pub fn inner(&self, load: &DVector<f64>) -> DVector<f64> {
        self.factors.solve_one(load)
    }

    /// Displacements X p of the subblocks for displacements p of the nodes.
    pub fn displaced(&self, p: &[f64]) -> DVector<f64> {
        let mut load = DVector::zeros(self.unknowns);
        for (tie, p) in self.ties.iter().zip(p) {
            tie.loads.iter().for_each(|&(i, each)| load[i] += p * each);
        }
        self.inner(&load)
    }

    /// The forces on the nodes that stand for `load`, which displaces the subblocks by `inner` with the nodes held: those
    /// that hold them.
    pub fn on_nodes(&self, load: &DVector<f64>, inner: &DVector<f64>) -> DVector<f64> {
        // Not fused as in S, which takes long: a load is condensed once, and its rounding does not add up.
        let held = self.ties.iter().map(|tie| tie.loads.iter().map(|&(i, load)| load * inner[i]).sum::<f64>());
        let mut on_nodes = DVector::from_iterator(self.ties.len(), held);
        let [of_nodes, of_blocks] = &self.rigid;
        let missing: [f64; 3] = from_fn(|m| of_blocks.column(m).dot(load) - of_nodes.column(m).dot(&on_nodes));
        missing.iter().enumerate().for_each(|(m, missing)| on_nodes.axpy(*missing, &of_nodes.column(m), 1.0));
        on_nodes
    }
}

impl Tie {
    fn new(body: &Inside, node: &Node, axis: usize) -> Self {
        let (along, link) = (node.axes[axis], node.link[axis]);
        let held = node.holds.into_iter().filter(|(_, share)| *share != 0.0);
        let loads = held.flat_map(|(subblock, share)| {
            body.row(subblock, node.at, along).into_iter().map(move |(i, each)| (i, each * (link * share)))
        });
        Tie { link, loads: loads.collect() }
    }

    /// Adds the link's stiffness on the unknowns, of which so many are a group.
    fn stiffness(&self, group: usize, add: &mut Add) {
        let groups = || self.loads.chunks_exact(group).filter(|_| self.link > 0.0);
        for (a, b) in groups().flat_map(|a| groups().map(move |b| (a, b))) {
            let entries = b.iter().flat_map(|(_, b)| a.iter().map(move |(_, a)| a * b / self.link));
            add(a[0].0 / group, b[0].0 / group, &entries.collect::<Vec<f64>>());
        }
    }

    /// Work of the loads in displacements of the subblocks, per unit.
    fn work(&self, x: &[f64]) -> f64 {
        // Fused, with one rounding for each product and sum: copies of a stone share what rounding leaves of S, and over
        // hundreds of them it adds up.
        self.loads.iter().fold(0.0, |sum, &(i, load)| load.mul_add(x[i], sum))
    }
}

/// The unknowns of a free body under a load in equilibrium, but for a rigid motion.
///
/// `load`: generalised loads on all unknowns.
/// None where the body's stiffness does not hold.
///
/// # Errors
/// When stopped.
pub fn free_response(body: &Inside, load: &DVector<f64>, budget: &Budget) -> Result<Option<DVector<f64>>, Stopped> {
    // Three springs on three rigid motions: statically determinate, so that a load in equilibrium does not feel them.
    let factors = Factors::new(body, |add| body.hold(add), budget)?;
    Ok(factors.map(|factors| factors.solve_one(load)))
}

/// Columns in parts of which none is small.
fn parts(columns: usize) -> impl Iterator<Item = Range<usize>> {
    let count = (columns / COLUMNS_AT_ONCE).max(1);
    (0..count).map(move |i| i * columns / count..(i + 1) * columns / count)
}

/// The three rigid motions as displacements of the nodes (orthonormal) and of the unknowns inside.
fn rigid_motions(body: &Inside, nodes: &[Node]) -> [DMatrix<f64>; 2] {
    let centre = nodes.iter().map(|n| n.at).sum::<Vec2>() / nodes.len().max(1) as f64;
    let field = |motion: usize, at: Vec2| match motion {
        0 => Vec2::x(),
        1 => Vec2::y(),
        _ => Vec2::new(centre.y - at.y, at.x - centre.x),
    };
    let of_nodes =
        DMatrix::from_fn(2 * nodes.len(), 3, |i, m| field(m, nodes[i / 2].at).dot(&nodes[i / 2].axes[i % 2]));
    let of_body = [0, 1, 2].map(|m| body.rigid(|at| field(m, at), if m == 2 { 1.0 } else { 0.0 }));
    orthonormal(of_nodes, DMatrix::from_columns(&of_body))
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
