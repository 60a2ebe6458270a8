//! The assembly: bodies joined to each other and to the ground at interfaces, by contact points.

mod build;
mod law;
mod mirror;
mod places;
mod strain;

pub use build::{AssemblyBuilder, Touch};
pub(super) use build::{has_core, interfaces_of};

use super::condense::{Condensed, Node};
use super::contact::Contact;
use super::elements::{Elements, Pattern};
use super::inside::{Inside, Stress};
use super::panels::{ThreeOfEight, add_applied_columns, three_of_eight};
use super::tree::Tree;
use crate::budget::{Budget, Stopped};
use crate::geometry::{Vec2, cross, perpendicular};
use mirror::Mirror;
use nalgebra::{DMatrix, DVector};
use std::cell::OnceCell;
use std::ops::Range;
use strain::Strain;

/// Work of putting a force on a subblock, in multiplications; and of solving for the inside of a body, over the number of
/// entries of its response to the nodes.
const PUSHED: usize = 1000;
const SOLVED: usize = 4;

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

/// Loads on an assembly.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Loads {
    /// What they are worth on the nodes, N/m.
    pub on_nodes: Vec<f64>,
    /// Mean displacement and rotation of every body with its nodes held, in the body's frame.
    mean: Vec<[f64; 3]>,
    /// Mean stress of its subblocks with its nodes held, in the body's frame, three numbers each; and that at their samples, of
    /// second-order ones.
    stress: Vec<Vec<f64>>,
    samples: Vec<Vec<[f64; 3]>>,
}

impl Loads {
    /// The most that the mean displacement of any body is with its nodes held, m.
    pub fn most_shift(&self) -> f64 {
        self.mean.iter().map(|[x, y, _]| x.hypot(*y)).fold(0.0, f64::max)
    }
}

/// A force on a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Push {
    /// Which body.
    pub body: usize,
    /// On which of its subblocks; none: spread evenly over all of it.
    pub subblock: Option<usize>,
    /// Where it acts, be it as a resultant, m.
    pub at: Vec2,
    /// Force, N/m.
    pub force: Vec2,
}

/// Mean motion of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanMotion {
    /// Mean displacement, m: that of the centroid of a body of one subblock.
    pub displacement: Vec2,
    /// Mean rotation, counter-clockwise positive, rad.
    pub rotation: f64,
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
    /// The tree with bodies' cores, where there are any, and that of bodies as their faces alone, once it has been asked for.
    tree: Tree,
    plain_tree: OnceCell<Tree>,
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
        &self.tree
    }

    /// The same where bodies are their faces alone, as on moving geometry; none where stopped.
    pub(super) fn plain_tree(&self, budget: &Budget) -> Option<&Tree> {
        let elements = self.bodies.len() + self.faces.len();
        if self.pattern.faces.len() == elements {
            return Some(&self.tree);
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

    /// Condenses forces on subblocks onto the nodes.
    ///
    /// # Errors
    /// When stopped.
    pub fn loads(&self, pushes: impl IntoIterator<Item = Push>, budget: &Budget) -> Result<Loads, Stopped> {
        let mut loads = Loads::default();
        for (body, load) in self.bodies.iter().zip(self.on_blocks(pushes, budget)?) {
            let kind = &self.kinds[body.kind];
            let inner = kind.condensed.inner(&load);
            loads.on_nodes.extend(kind.condensed.on_nodes(&load, &inner).iter());
            let mean = &kind.mean * &inner;
            loads.mean.push([mean[0], mean[1], mean[2]]);
            loads.stress.push(kind.stress.mean(inner.as_slice()).as_slice().to_vec());
            loads.samples.push(kind.stress.samples(inner.as_slice()));
            budget.work(SOLVED * load.len() * 2 * kind.nodes.len())?;
        }
        Ok(loads)
    }

    /// What forces are worth on the nodes with every one turned by -90 degrees, N/m: what bodies that turn see of them.
    ///
    /// # Errors
    /// When stopped.
    pub fn turned_loads(&self, pushes: impl IntoIterator<Item = Push>, budget: &Budget) -> Result<Vec<f64>, Stopped> {
        let turned = pushes.into_iter().map(|push| Push { force: -perpendicular(push.force), ..push });
        let mut loads = Vec::new();
        for (body, load) in self.bodies.iter().zip(self.on_blocks(turned, budget)?) {
            let kind = &self.kinds[body.kind];
            loads.extend(kind.condensed.on_nodes(&load, &kind.condensed.inner(&load)).iter());
            budget.work(SOLVED * load.len() * 2 * kind.nodes.len())?;
        }
        Ok(loads)
    }

    /// Generalised loads on the subblocks of every body, in its frame.
    fn on_blocks(&self, pushes: impl IntoIterator<Item = Push>, budget: &Budget) -> Result<Vec<DVector<f64>>, Stopped> {
        let zeros = |b: &Instance| DVector::zeros(self.kinds[b.kind].inside.unknowns());
        let mut on_blocks: Vec<DVector<f64>> = self.bodies.iter().map(zeros).collect();
        for push in pushes {
            let body = &self.bodies[push.body];
            let (at, force) = (body.turned(push.at - body.origin), body.turned(push.force));
            let (inside, loads) = (&self.kinds[body.kind].inside, &mut on_blocks[push.body]);
            match push.subblock {
                Some(subblock) => inside.add_load(subblock, at, force, loads),
                None => inside.add_spread(at, force, loads),
            }
            budget.work(PUSHED * push.subblock.map_or(inside.subblocks(), |_| 1))?;
        }
        Ok(on_blocks)
    }

    /// Mean motion of body `i` for node displacements (or velocities) `d` and what loads, each times its factor, add
    /// between the nodes.
    pub fn mean_motion(&self, i: usize, d: &[f64], loads: &[(&Loads, f64)]) -> MeanMotion {
        let mean = self.mean_in_frame(i, d, loads);
        MeanMotion { displacement: self.bodies[i].turned_back(Vec2::new(mean[0], mean[1])), rotation: mean[2] }
    }

    /// Mean displacement and rotation of body `i` in its own frame.
    fn mean_in_frame(&self, i: usize, d: &[f64], loads: &[(&Loads, f64)]) -> [f64; 3] {
        let (kind, d) = (&self.kinds[self.bodies[i].kind], &d[self.nodes[i].clone()]);
        let mut mean = [0.0; 3];
        match (&kind.whole, d.as_array()) {
            (Some([of_nodes, _]), Some(d)) => mean = three_of_eight(of_nodes, d),
            _ => add_applied_columns(kind.mean_of_nodes.as_slice(), d, &mut mean),
        }
        for (loads, factor) in loads {
            (0..3).for_each(|c| mean[c] += loads.mean[i][c] * factor);
        }
        mean
    }

    /// Size of the mean displacement of body `i`, m.
    pub fn shift(&self, i: usize, d: &[f64], loads: &[(&Loads, f64)]) -> f64 {
        // As long in every frame.
        let [x, y, _] = self.mean_in_frame(i, d, loads);
        x.hypot(y)
    }

    /// The most that the mean displacement of any body changes by where no unknown of its nodes does by more than 1 m.
    pub fn most_shift(&self) -> f64 {
        let most = |kind: &Kind| {
            let row = |i: usize| kind.mean_of_nodes.row(i).iter().map(|entry| entry.abs()).sum::<f64>();
            row(0).hypot(row(1))
        };
        self.kinds.iter().map(most).fold(0.0, f64::max)
    }

    /// Mean stress (sigma_x, sigma_y, tau_xy) in every subblock of body `i`, three numbers each in the body's own frame, Pa.
    pub fn stresses_in_frame(&self, i: usize, d: &[f64], loads: &[(&Loads, f64)], into: &mut Vec<f64>) {
        let (kind, d) = (&self.kinds[self.bodies[i].kind], &d[self.nodes[i].clone()]);
        into.clear();
        match &kind.stress_of_nodes {
            Some(of_nodes) => {
                into.resize(of_nodes.nrows(), 0.0);
                add_applied_columns(of_nodes.as_slice(), d, into);
            }
            None => into.extend(&kind.stress.mean(kind.condensed.displaced(d).as_slice())),
        }
        for (loads, factor) in loads {
            into.iter_mut().zip(&loads.stress[i]).for_each(|(sum, stress)| *sum += stress * factor);
        }
    }

    /// The same of a body of one subblock between two joints of two contact points; none of any other.
    #[inline]
    pub fn stress_of_whole(&self, i: usize, d: &[f64], loads: &[(&Loads, f64)]) -> Option<[f64; 3]> {
        let [_, of_nodes] = self.kinds[self.bodies[i].kind].whole.as_ref()?;
        let mut stress = three_of_eight(of_nodes, d[self.nodes[i].clone()].as_array()?);
        for (loads, factor) in loads {
            let of_load = loads.stress[i].as_array::<3>()?;
            (0..3).for_each(|c| stress[c] += of_load[c] * factor);
        }
        Some(stress)
    }

    /// Mean stress (sigma_x, sigma_y, tau_xy) in every subblock of body `i`, Pa, for node displacements `d` under loads, each
    /// times its factor.
    pub fn stresses(&self, i: usize, d: &[f64], loads: &[(&Loads, f64)]) -> Vec<[f64; 3]> {
        let mut in_frame = Vec::new();
        self.stresses_in_frame(i, d, loads, &mut in_frame);
        in_frame.chunks_exact(3).map(|s| self.bodies[i].stress_turned_back([s[0], s[1], s[2]])).collect()
    }

    /// The same at the samples of the subblocks: one of a constant-strain one, those of [`SecondOrder::SAMPLES`] of another.
    ///
    /// [`SecondOrder::SAMPLES`]: super::SecondOrder::SAMPLES
    pub fn samples(&self, i: usize, d: &[f64], loads: &[(&Loads, f64)]) -> Vec<[f64; 3]> {
        let body = &self.bodies[i];
        let kind = &self.kinds[body.kind];
        if let Stress::Constant(_) = kind.stress {
            return self.stresses(i, d, loads);
        }
        let mut samples = kind.stress.samples(kind.condensed.displaced(&d[self.nodes_of(i)]).as_slice());
        for (loads, factor) in loads {
            for (sum, of_load) in samples.iter_mut().zip(&loads.samples[i]) {
                (0..3).for_each(|c| sum[c] += of_load[c] * factor);
            }
        }
        samples.into_iter().map(|stress| body.stress_turned_back(stress)).collect()
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
