//! Compatibility: the gradient of the complementary energy by redundants and splits.

use super::statics::{self, Statics};
use super::{ForceMethod, Linear, Three, dot, is_smooth, plus};
use crate::budget::{Budget, Stopped};
use crate::dda::assembly::Assembly;
use crate::dda::condense::Node;
use crate::dda::contact::Contact;
use crate::geometry::{Vec2, perpendicular};
use nalgebra::{SMatrix, SVector};

/// Work of finding what a body gives, in multiplications.
const BODY_WORK: usize = 600;

type Eight = SMatrix<f64, 8, 8>;
/// Columns: per unit of the redundants, and of the splits before and after a body.
type Five = SMatrix<f64, 8, 5>;

/// What bodies give under forces on their nodes.
#[derive(Debug)]
pub(super) struct Compatibility {
    /// Of every body, displacements of its nodes, but for a rigid motion.
    pub given: Vec<Five>,
    /// Flexibility of every kind of body.
    flexibilities: Vec<Option<Eight>>,
    /// Of bodies alone.
    gradient: Gradient,
}

/// The gradient of the complementary energy; symmetric, so that columns are rows.
#[derive(Debug, Clone)]
pub(super) struct Gradient {
    /// By the redundants, per unit of each, m/N.
    pub redundants: [Three; 3],
    /// By every split, per unit of itself, of the next one and of the redundants.
    pub own: Vec<f64>,
    pub next: Vec<f64>,
    pub mixed: Vec<Three>,
}

/// A chain with contacts, under loads that stay and loads that grow.
#[derive(Debug)]
pub struct Loaded<'m> {
    pub(super) method: &'m ForceMethod<'m>,
    pub(super) contacts: &'m [Contact],
    pub(super) loads: [&'m [f64]; 2],
    pub(super) gradient: Gradient,
    /// By the redundants and by every split, per unit of either loads.
    pub(super) of_loads: ([Three; 2], Vec<[f64; 2]>),
    /// What every interface carries more than the first, of either loads.
    pub(super) carried: Vec<[Three; 2]>,
}

/// Forces of a split on the points of its interface, normal and tangential.
const SPLIT: [f64; 4] = [0.0, 1.0, 0.0, -1.0];

impl Compatibility {
    /// Of the bodies of a chain; none where one of them is loose.
    pub(super) fn new(assembly: &Assembly, statics: &[Statics], budget: &Budget) -> Result<Option<Self>, Stopped> {
        let n = assembly.bodies();
        let (mut flexibilities, mut given) = (vec![None; assembly.kinds()], Vec::with_capacity(n));
        let mut gradient = Gradient::zeros(n + 1);
        for i in 0..n {
            let kind = assembly.kind_of(i);
            if flexibilities[kind].is_none() {
                flexibilities[kind] = flexibility(
                    assembly.kind_nodes(kind),
                    &Eight::from_column_slice(assembly.stiffness_of(i).as_slice()),
                );
            }
            let Some(flexibility) = &flexibilities[kind] else { return Ok(None) };
            let forces = on_nodes(&statics[i], &statics[i + 1]);
            let gives = flexibility * forces;
            gradient.add_body(i, &forces.tr_mul(&gives));
            given.push(gives);
            budget.work(BODY_WORK)?;
        }
        Ok(Some(Compatibility { given, flexibilities, gradient }))
    }

    /// Displacements of the nodes of body `i` under these forces on them, but for a rigid motion, m.
    pub(super) fn gives(&self, assembly: &Assembly, i: usize, forces: [f64; 8]) -> [f64; 8] {
        let flexibility = self.flexibilities[assembly.kind_of(i)].unwrap_or_else(Eight::zeros);
        (flexibility * SVector::<f64, 8>::from(forces)).into()
    }
}

/// Forces on the nodes of a body between two interfaces, per unit of redundants and splits.
pub(super) fn on_nodes(before: &Statics, after: &Statics) -> Five {
    let (before, after) = (before.forces(), after.forces());
    let mut forces = Five::zeros();
    for row in 0..4 {
        for column in 0..3 {
            forces[(row, column)] = before[row][column];
            forces[(row + 4, column)] = -after[row][column];
        }
        forces[(row, 3)] = SPLIT[row];
        forces[(row + 4, 4)] = -SPLIT[row];
    }
    forces
}

/// Displacements of a body's nodes under forces in equilibrium, but for a rigid motion; none where it is loose.
fn flexibility(nodes: &[Node], stiffness: &Eight) -> Option<Eight> {
    let centre = nodes.iter().map(|node| node.at).sum::<Vec2>() / nodes.len() as f64;
    let rigid = SMatrix::<f64, 8, 3>::from_fn(|row, motion| {
        let node = &nodes[row / 2];
        [Vec2::x(), Vec2::y(), perpendicular(node.at - centre)][motion].dot(&node.axes[row % 2])
    });
    let rigid = rigid.qr().q();
    let (held, scale) = (rigid * rigid.transpose(), stiffness.trace() / 8.0);
    let inverse = (stiffness + held * scale).cholesky()?.inverse();
    Some(inverse - held / scale)
}

impl Gradient {
    fn zeros(interfaces: usize) -> Self {
        let (redundants, mixed) = ([[0.0; 3]; 3], vec![[0.0; 3]; interfaces]);
        Gradient { redundants, own: vec![0.0; interfaces], next: vec![0.0; interfaces], mixed }
    }

    /// Adds the energy of body `i` per unit of redundants and splits, in pairs.
    fn add_body(&mut self, i: usize, energy: &SMatrix<f64, 5, 5>) {
        for a in 0..3 {
            (0..3).for_each(|b| self.redundants[a][b] += energy[(a, b)]);
            self.mixed[i][a] += energy[(a, 3)];
            self.mixed[i + 1][a] += energy[(a, 4)];
        }
        self.own[i] += energy[(3, 3)];
        self.own[i + 1] += energy[(4, 4)];
        self.next[i] += energy[(3, 4)];
    }
}

impl<'a> ForceMethod<'a> {
    /// With these contacts, the assembly's own or its exact ones, under loads on the nodes: those that stay, and those that grow.
    pub fn loaded<'m>(&'m self, contacts: &'m [Contact], loads: [&'m [f64]; 2]) -> Loaded<'m> {
        let (assembly, statics) = (self.assembly, &self.statics);
        let carried = loads.map(|loads| statics::carried(assembly, loads));
        let carried: Vec<_> = carried[0].iter().zip(&carried[1]).map(|(fixed, scaled)| [*fixed, *scaled]).collect();
        let (mut by_redundants, mut by_splits) = ([[0.0; 3]; 2], vec![[0.0; 2]; statics.len()]);
        for (i, gives) in self.compatibility.given.iter().enumerate() {
            for which in 0..2 {
                let carried = [i, i + 1].map(|k| &carried[k][which]);
                let forces = under_loads(&statics[i..i + 2], carried, &loads[which][assembly.nodes_of(i)]);
                let by = gives.tr_mul(&forces);
                by_redundants[which] = plus(&by_redundants[which], &[by[0], by[1], by[2]]);
                by_splits[i][which] += by[3];
                by_splits[i + 1][which] += by[4];
            }
        }
        let (gradient, of_loads) = (self.compatibility.gradient.clone(), (by_redundants, by_splits));
        let mut loaded = Loaded { method: self, contacts, loads, gradient, of_loads, carried };
        (0..statics.len()).for_each(|k| loaded.add_contacts(k));
        loaded
    }
}

/// Forces on the nodes of a body under `loads` on them and what its two interfaces carry of all loads, N/m.
pub(super) fn under_loads(statics: &[Statics], carried: [&Three; 2], loads: &[f64]) -> SVector<f64, 8> {
    let mut forces = SVector::<f64, 8>::from_column_slice(loads);
    for (side, sign) in [(0, 1.0), (1, -1.0)] {
        let ([first, second], shear) = statics[side].at(carried[side]);
        let at = [first, 0.5 * shear, second, 0.5 * shear];
        (0..4).for_each(|row| forces[4 * side + row] += sign * at[row]);
    }
    forces
}

impl<'m> Loaded<'m> {
    /// Loads on the nodes: those that stay, and those that grow.
    pub fn loads(&self) -> [&'m [f64]; 2] {
        self.loads
    }

    /// Adds the energy of the two contacts of interface `k`.
    fn add_contacts(&mut self, k: usize) {
        let (statics, pair) = (&self.method.statics[k], &self.contacts[2 * k..2 * k + 2]);
        let gives = |axis: usize| [0, 1].map(|p: usize| 1.0 / pair[p].stiffness[axis]);
        // A smooth interface has no shear that could do work.
        let sheared = if is_smooth(&pair[0]) { [0.0; 2] } else { gives(1) };
        let [first, second] = gives(0);
        let mixed = statics.shear.map(|v| 0.5 * (sheared[0] - sheared[1]) * v);
        let rows = [
            (statics.normals[0], first),
            (statics.normals[1], second),
            (statics.shear, 0.25 * (sheared[0] + sheared[1])),
        ];
        let Gradient { redundants, own, mixed: all_mixed, .. } = &mut self.gradient;
        for (row, give) in rows {
            for a in 0..3 {
                (0..3).for_each(|b| redundants[a][b] += give * row[a] * row[b]);
                for (by, carried) in self.of_loads.0.iter_mut().zip(&self.carried[k]) {
                    by[a] += row[a] * give * dot(&row, carried);
                }
            }
        }
        own[k] += sheared[0] + sheared[1];
        all_mixed[k] = plus(&all_mixed[k], &mixed);
        for (by, carried) in self.of_loads.1[k].iter_mut().zip(&self.carried[k]) {
            *by += dot(&mixed, carried);
        }
    }

    /// The same row of statics at interface `k`, by redundants and loads.
    pub(super) fn linear(&self, k: usize, row: &Three) -> Linear {
        let [fixed, scaled] = &self.carried[k];
        [row[0], row[1], row[2], dot(row, fixed), dot(row, scaled)]
    }

    /// The resultant through interface `k`.
    pub(super) fn resultant(&self, k: usize, redundants: &Three, load_factor: f64) -> Three {
        let [fixed, scaled] = &self.carried[k];
        std::array::from_fn(|c| redundants[c] + fixed[c] + load_factor * scaled[c])
    }
}
