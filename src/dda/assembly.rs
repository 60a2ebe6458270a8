//! The assembly: bodies joined to each other and to the ground at interfaces, by contact points.

mod build;
mod inside_bodies;
mod law;
mod loads;
mod mirror;
mod places;
mod strain;

pub use build::{AssemblyBuilder, Touch};
pub(super) use build::{has_core, interfaces_of};
pub use inside_bodies::MeanMotion;
pub use loads::{Loads, Push};

use super::condense::{Condensed, Node};
use super::contact::Contact;
use super::elements::{Elements, Pattern};
use super::inside::{Inside, Stress};
use super::panels::ThreeOfEight;
use super::tree::Tree;
use crate::budget::{Budget, Stopped};
use crate::geometry::{Vec2, cross, perpendicular};
use mirror::Mirror;
use nalgebra::DMatrix;
use std::cell::OnceCell;
use std::ops::Range;
use strain::Strain;

/// The tree of so many interfaces takes less time than anybody who waits would notice.
const SOON: usize = 300;

/// A body of the assembly: where its frame is, and which condensed macroblock it is a copy of.
#[derive(Debug, Clone, PartialEq)]
struct Instance {
    origin: Vec2,
    x_axis: Vec2,
    kind: usize,
}

/// A macroblock that one or more bodies are copies of, up to a rigid motion.
#[derive(Debug, Clone)]
struct Kind {
    inside: Inside,
    nodes: Vec<Node>,
    condensed: Condensed,
    /// Area-weighted mean displacement and rotation per unit of the unknowns inside.
    mean: DMatrix<f64>,
    /// The same per displacement of the nodes.
    mean_of_nodes: DMatrix<f64>,
    /// Mean stress of every subblock per unit of the unknowns, and per displacement of the nodes, 3 n_subblocks x 2 n_nodes; none
    /// where that would be too much to keep.
    stress: Stress,
    stress_of_nodes: Option<DMatrix<f64>>,
    /// `mean_of_nodes` and `stress_of_nodes` of a body of one subblock between two joints of two contact points.
    whole: Option<[ThreeOfEight; 2]>,
    /// What bounds a change of stress, where there are several subblocks and `stress_of_nodes`.
    strain: Option<Strain>,
}

/// What lies on one side of an interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Beside {
    /// This body.
    Body(usize),
    /// This piece of rigid ground.
    Ground(usize),
}

/// Where a contact point is, and its normal.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Site {
    at: Vec2,
    normal: Vec2,
}

/// Bodies and the interfaces between two of them, or one and the rigid ground.
///
/// Unknowns are the displacements of the contact points on every body, along each contact's normal and tangent: body by body,
/// and those of a body interface by interface (its faces).
#[derive(Debug, Clone)]
pub struct Assembly {
    bodies: Vec<Instance>,
    kinds: Vec<Kind>,
    /// Contacts as a path meets them, and as they were built.
    contacts: Vec<Contact>,
    exact: Vec<Contact>,
    sites: Vec<Site>,
    /// Stiffness of every contact's links.
    links: Vec<[f64; 2]>,
    /// Contacts of interface k: `contacts[first[k]..first[k + 1]]`.
    first: Vec<usize>,
    /// Interface of every contact.
    interface: Vec<usize>,
    /// What lies before and after every interface, and the faces there (none: the ground).
    beside: Vec<[Beside; 2]>,
    faces: Vec<[Option<usize>; 2]>,
    /// Places of every contact's normal unknown on the body before and on the body after (none: the ground); the
    /// tangential one follows.
    places: Vec<[Option<usize>; 2]>,
    /// Unknowns of every body.
    nodes: Vec<Range<usize>>,
    /// Bodies and interfaces as elements of a matrix over the faces: first all bodies, then all interfaces.
    pattern: Pattern,
    /// The tree with bodies' cores, where there are any, and that of bodies as their faces alone, once they have been asked for.
    tree: OnceCell<Tree>,
    plain_tree: OnceCell<Tree>,
    /// Elements that are left out of the tree: bodies that have cores, in order.
    cored: Vec<usize>,
    /// Unknowns of all nodes.
    unknowns: usize,
    /// Elastic stiffness of the bodies; nothing in the interfaces.
    elastic: Elements,
    /// The mirror image, where the assembly is its own.
    mirror: Option<Mirror>,
}

impl Assembly {
    /// Number of bodies.
    pub fn bodies(&self) -> usize {
        self.bodies.len()
    }

    /// Number of distinct macroblocks that were condensed.
    pub fn kinds(&self) -> usize {
        self.kinds.len()
    }

    /// Number of displacement unknowns inside all bodies.
    pub fn unknowns(&self) -> usize {
        self.bodies.iter().map(|b| self.kinds[b.kind].inside.unknowns()).sum()
    }

    /// Elastic stiffness of the bodies as elements, N/m2; zero in the interfaces.
    pub(super) fn elastic(&self) -> &Elements {
        &self.elastic
    }

    /// In which order unknowns are eliminated.
    pub(super) fn tree(&self) -> &Tree {
        // It is a small one: nobody who waits could be told to stop meanwhile.
        self.tree.get_or_init(|| self.new_tree(&Budget::unlimited()).unwrap_or_default())
    }

    fn new_tree(&self, budget: &Budget) -> Result<Tree, Stopped> {
        Tree::new(&self.pattern, |element| self.cored.binary_search(&element).is_err(), budget)
    }

    /// Makes the tree at once where that takes long.
    fn prepare(&mut self, budget: &Budget) -> Result<(), Stopped> {
        if self.faces.len() > SOON {
            self.tree = self.new_tree(budget)?.into();
        }
        Ok(())
    }

    /// The same where bodies are their faces alone, as on moving geometry; none where stopped.
    pub(super) fn plain_tree(&self, budget: &Budget) -> Option<&Tree> {
        let elements = self.bodies.len() + self.faces.len();
        if self.pattern.faces.len() == elements {
            return Some(self.tree());
        }
        if self.plain_tree.get().is_none() {
            let tree = Tree::new(&self.pattern, |element| element < elements, budget).ok()?;
            return Some(self.plain_tree.get_or_init(|| tree));
        }
        self.plain_tree.get()
    }

    /// The element of interface `k` in a matrix.
    pub(super) fn element(&self, k: usize) -> usize {
        self.bodies.len() + k
    }

    /// All contact points as a path meets them, interface by interface.
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    /// Indices of the contacts of interface `k`.
    pub fn at_interface(&self, k: usize) -> std::ops::Range<usize> {
        self.first[k]..self.first[k + 1]
    }

    /// Interface that contact `p` belongs to.
    pub fn interface_of(&self, p: usize) -> usize {
        self.interface[p]
    }

    /// Number of interfaces.
    pub fn interfaces(&self) -> usize {
        self.beside.len()
    }

    /// What lies before and after interface `k`.
    pub(super) fn beside(&self, k: usize) -> [Beside; 2] {
        self.beside[k]
    }

    /// Unknowns of the faces before and after interface `k`; none where the ground is.
    pub fn faces(&self, k: usize) -> [Option<Range<usize>>; 2] {
        self.faces[k].map(|face| face.map(|face| self.pattern.range(face)))
    }

    /// Normal and tangential gap of contact `p` at the displacements (or velocities) `d`, its links' strain left out, m.
    pub fn gap(&self, p: usize, d: &[f64]) -> [f64; 2] {
        let of = |place: Option<usize>| place.map_or([0.0; 2], |i| [d[i], d[i + 1]]);
        let [before, after] = [of(self.places[p][0]), of(self.places[p][1])];
        [after[0] - before[0], after[1] - before[1]]
    }

    /// The gaps of all contacts.
    pub fn gaps(&self, d: &[f64], into: &mut Vec<[f64; 2]>) {
        into.clear();
        for (k, points) in self.first.windows(2).enumerate() {
            match self.faces(k) {
                // Contacts are in order on either face.
                [Some(before), Some(after)] => {
                    let pairs = d[before].as_chunks::<2>().0.iter().zip(d[after].as_chunks::<2>().0);
                    into.extend(pairs.map(|(before, after)| [after[0] - before[0], after[1] - before[1]]));
                }
                _ => into.extend((points[0]..points[1]).map(|p| self.gap(p, d))),
            }
        }
    }

    /// Adds the forces that contact `p` puts on the bodies beside it.
    pub(super) fn push(&self, p: usize, [normal, shear]: [f64; 2], forces: &mut [f64]) {
        let [before, after] = self.places[p];
        for (place, sign) in [(before, -1.0), (after, 1.0)] {
            if let Some(i) = place {
                forces[i] += sign * normal;
                forces[i + 1] += sign * shear;
            }
        }
    }
}

impl Instance {
    fn turned(&self, v: Vec2) -> Vec2 {
        Vec2::new(v.dot(&self.x_axis), cross(self.x_axis, v))
    }

    fn turned_back(&self, v: Vec2) -> Vec2 {
        self.x_axis * v.x + perpendicular(self.x_axis) * v.y
    }

    /// A state of stress in the frame of the assembly.
    fn stress_turned_back(&self, [x, y, tau]: [f64; 3]) -> [f64; 3] {
        let (c, s) = (self.x_axis.x, self.x_axis.y);
        let (cc, ss, cs) = (c * c, s * s, c * s);
        [cc * x + ss * y - 2.0 * cs * tau, ss * x + cc * y + 2.0 * cs * tau, cs * (x - y) + (cc - ss) * tau]
    }
}

#[cfg(test)]
mod tests;
