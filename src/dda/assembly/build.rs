//! Building an assembly: contact points, and stones of one shape condensed once.

use super::{Assembly, Beside, Instance, Kind, Site, Strain};
use crate::budget::Budget;
use crate::dda::condense::{Condensed, Loose, Node, Unbuilt};
use crate::dda::contact::{Contact, Law};
use crate::dda::elements::{Elements, Pattern};
use crate::dda::inside::Inside;
use crate::dda::panels::ThreeOfEight;
use crate::geometry::{Vec2, cross, perpendicular};
use nalgebra::{DMatrix, DVectorView};
use std::cell::OnceCell;

/// Coordinates that differ by this share of the farthest from the origin differ by rounding: some operations' worth.
const COORDINATE_ROUNDING: f64 = 256.0 * f64::EPSILON;
/// Work of seeing a subblock from another frame, or of comparing a body with a kind, in multiplications.
const BODY_WORK: usize = 300;
/// Most entries of a kind's stress by its nodes that are kept, 32 MB. Where there are more, solving for the subblocks each
/// time, with factors that are there anyway, takes hardly longer.
const MOST_KEPT: usize = 1 << 22;
/// Work of setting an entry of the stiffness.
const SET: usize = 8;

/// A contact point as it is built.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Its place, m.
    pub at: Vec2,
    /// Unit vector from the body before into the body after; shear counts along it turned by +90 degrees.
    pub normal: Vec2,
    /// Stiffness [k_n, k_t] of the contact itself, N/m2.
    pub stiffness: [f64; 2],
    /// Stiffness of the links that tie it to the subblocks on either side, N/m2. The three are in series.
    pub link: [f64; 2],
    /// Its law.
    pub law: Law,
    /// The one or two subblocks it touches in the body before, with the share each takes.
    pub before: [(usize, f64); 2],
    /// The same in the body after.
    pub after: [(usize, f64); 2],
}

/// Builds an [`Assembly`].
#[derive(Debug)]
pub struct AssemblyBuilder {
    bodies: Vec<Inside>,
    interfaces: Vec<Joined>,
}

/// An interface as it is built.
#[derive(Debug)]
struct Joined {
    between: [Beside; 2],
    touches: Vec<Touch>,
}

impl AssemblyBuilder {
    /// An assembly of these bodies, not yet joined to anything.
    pub fn new(bodies: Vec<Inside>) -> Self {
        AssemblyBuilder { bodies, interfaces: Vec::new() }
    }

    /// Joins what lies before an interface to what lies after it, by these contact points.
    pub fn join(&mut self, between: [Beside; 2], touches: impl IntoIterator<Item = Touch>) {
        self.interfaces.push(Joined { between, touches: touches.into_iter().collect() });
    }

    /// The assembly.
    ///
    /// # Errors
    /// When a body is not held by two contact points at least, or when stopped.
    pub fn finish(self, budget: &Budget) -> Result<Assembly, Unbuilt> {
        let of_bodies = interfaces_of(self.bodies.len(), self.interfaces.iter().map(|interface| interface.between));
        let mut kinds: Vec<Kind> = Vec::new();
        let mut bodies = Vec::new();
        for (i, inside) in self.bodies.iter().enumerate() {
            let nodes: Vec<Node> =
                of_bodies[i].iter().flat_map(|&(k, side)| nodes(&self.interfaces[k].touches, side)).collect();
            let (origin, x_axis) = nodes.first().map(|n| (n.at, n.axes[0])).ok_or(Loose)?;
            let (seen, nodes) = (inside.seen_from(origin, x_axis), seen_nodes(&nodes, origin, x_axis));
            let rounding = COORDINATE_ROUNDING * (origin.amax() + extent(&nodes));
            // A kind is compared, or a new one made.
            budget.work(BODY_WORK * (1 + kinds.len() + seen.subblocks()))?;
            let same = |kind: &Kind| alike(kind, &seen, &nodes, rounding);
            let kind = match kinds.iter().rposition(same) {
                Some(kind) => kind,
                None => {
                    kinds.push(Kind::new(seen, nodes, budget)?);
                    kinds.len() - 1
                }
            };
            bodies.push(Instance { origin, x_axis, kind });
        }
        self.put_together(&of_bodies, bodies, kinds, budget)
    }

    fn put_together(
        self,
        of_bodies: &[Vec<(usize, usize)>],
        bodies: Vec<Instance>,
        kinds: Vec<Kind>,
        budget: &Budget,
    ) -> Result<Assembly, Unbuilt> {
        let points: Vec<usize> = self.interfaces.iter().map(|interface| interface.touches.len()).collect();
        let (mut pattern, faces, nodes) = Pattern::new(of_bodies, &points);
        let (unknowns, elements) = (pattern.unknowns(), pattern.faces.len());
        let kind_of = |body: usize| &kinds[bodies[body].kind];
        let cored: Vec<usize> = (0..bodies.len())
            .filter(|&i| has_core(kind_of(i).inside.is_one_block(), of_bodies[i].len(), kind_of(i).nodes.len()))
            .collect();
        cored.iter().for_each(|&body| pattern.add_core(body));
        let mut elastic = Elements::zeros(&pattern);
        let mut element = elements;
        for &body in &cored {
            let (kind, mut from) = (kind_of(body), 0);
            for &(k, _) in &of_bodies[body] {
                let to = from + 2 * self.interfaces[k].touches.len();
                elastic.get_mut(element).copy_from_slice(&kind.condensed.ties(from..to));
                (element, from) = (element + 1, to);
            }
            // Symmetric, so that columns are rows.
            let core = elastic.get_mut(element);
            kind.inside.stiffness(|_, _, block| core.copy_from_slice(block));
            element += 1;
        }
        for (i, body) in bodies.iter().enumerate() {
            // Symmetric, so that columns are rows.
            let stiffness = kinds[body.kind].condensed.stiffness();
            elastic.get_mut(i).copy_from_slice(stiffness.as_slice());
            budget.work(SET * stiffness.len())?;
        }
        let mut first = vec![0];
        self.interfaces.iter().for_each(|i| first.push(first[first.len() - 1] + i.touches.len()));
        let touches = || self.interfaces.iter().flat_map(|interface| &interface.touches);
        let contacts: Vec<_> = touches().map(|t| Contact::new(t.stiffness, t.law)).collect();
        let of_contact = |(k, i): (usize, &Joined)| vec![k; i.touches.len()];
        let mut assembly = Assembly {
            exact: contacts.clone(),
            contacts,
            links: touches().map(|t| t.link).collect(),
            sites: touches().map(|t| Site { at: t.at, normal: t.normal }).collect(),
            interface: self.interfaces.iter().enumerate().flat_map(of_contact).collect(),
            beside: self.interfaces.iter().map(|interface| interface.between).collect(),
            tree: OnceCell::new(),
            plain_tree: OnceCell::new(),
            cored,
            unknowns,
            bodies,
            kinds,
            first,
            faces,
            places: Vec::new(),
            nodes,
            pattern,
            elastic,
            mirror: None,
        };
        assembly.places = (0..assembly.contacts.len()).map(|p| assembly.find_places(p)).collect();
        assembly.mirror = assembly.find_mirror();
        assembly.prepare(budget)?;
        Ok(assembly)
    }
}

/// The interfaces of each of so many bodies, each with the side on which the body lies.
pub(in crate::dda) fn interfaces_of(
    bodies: usize,
    between: impl Iterator<Item = [Beside; 2]>,
) -> Vec<Vec<(usize, usize)>> {
    let mut of_bodies = vec![Vec::new(); bodies];
    for (k, between) in between.enumerate() {
        for (side, beside) in between.into_iter().enumerate() {
            if let Beside::Body(body) = beside {
                of_bodies[body].push((k, side));
            }
        }
    }
    of_bodies
}

/// Whether a body between so many faces with so many nodes is better eliminated by way of its own unknowns: where it is one
/// constant-strain subblock, with more than the two faces of a chain, and fewer unknowns than they.
pub(in crate::dda) fn has_core(one_block: bool, faces: usize, nodes: usize) -> bool {
    one_block && faces > 2 && 2 * nodes > 6
}

impl Kind {
    fn new(inside: Inside, nodes: Vec<Node>, budget: &Budget) -> Result<Self, Unbuilt> {
        let (mean, stress, columns) = (inside.mean(), inside.stress(), 2 * nodes.len());
        let mut mean_of_nodes = DMatrix::zeros(3, columns);
        let kept = Some(3 * inside.subblocks()).filter(|rows| rows * columns <= MOST_KEPT);
        let mut stress_of_nodes = kept.map(|rows| DMatrix::zeros(rows, columns));
        let condensed = Condensed::new(&inside, &nodes, budget, |j, d| {
            mean_of_nodes.set_column(j, &(&mean * DVectorView::from_slice(d, d.len())));
            if let Some(of_nodes) = &mut stress_of_nodes {
                of_nodes.column_mut(j).copy_from_slice(&stress.mean(d));
            }
        })?;
        let whole = stress_of_nodes.as_ref().and_then(|stress| Some([by_rows(&mean_of_nodes)?, by_rows(stress)?]));
        let strain = match &stress_of_nodes {
            Some(of_nodes) if inside.subblocks() > 1 => {
                budget.work(3 * of_nodes.len())?;
                Some(Strain::new(&nodes, of_nodes))
            }
            _ => None,
        };
        Ok(Kind { inside, nodes, condensed, mean, mean_of_nodes, stress, stress_of_nodes, whole, strain })
    }
}

/// A matrix of three rows and eight columns, row by row; none of another shape.
fn by_rows(matrix: &DMatrix<f64>) -> Option<ThreeOfEight> {
    let is_one = matrix.shape() == (3, 8);
    is_one.then(|| std::array::from_fn(|i| std::array::from_fn(|j| matrix[(i, j)])))
}

/// Nodes of the body on one side of an interface.
fn nodes(touches: &[Touch], side: usize) -> impl Iterator<Item = Node> + '_ {
    touches.iter().map(move |t| Node {
        at: t.at,
        axes: [t.normal, perpendicular(t.normal)],
        link: t.link,
        holds: if side == 0 { t.before } else { t.after },
    })
}

fn seen_nodes(nodes: &[Node], origin: Vec2, x_axis: Vec2) -> Vec<Node> {
    let turned = |v: Vec2| Vec2::new(v.dot(&x_axis), cross(x_axis, v));
    nodes.iter().map(|n| Node { at: turned(n.at - origin), axes: n.axes.map(turned), ..*n }).collect()
}

fn extent(nodes: &[Node]) -> f64 {
    nodes.iter().map(|n| n.at.amax()).fold(0.0, f64::max)
}

/// True where a body seen from its own frame is the same as `kind`, up to the rounding of its coordinates.
fn alike(kind: &Kind, body: &Inside, nodes: &[Node], rounding: f64) -> bool {
    let near = |a: Vec2, b: Vec2| (a - b).amax() <= rounding;
    let parallel = |a: Vec2, b: Vec2, size: f64| (a - b).amax() * size <= rounding;
    let size = extent(nodes);
    let same_node = |(a, b): (&Node, &Node)| {
        near(a.at, b.at)
            && a.axes.iter().zip(b.axes).all(|(&a, b)| parallel(a, b, size))
            && (a.link, a.holds) == (b.link, b.holds)
    };
    kind.nodes.len() == nodes.len()
        && kind.nodes.iter().zip(nodes).all(same_node)
        && kind.inside.same_as(body, rounding)
}
