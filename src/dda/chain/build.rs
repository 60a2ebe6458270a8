//! Building a chain: contact points, and stones of one shape condensed once.

use super::{Body, Chain, Kind, Site, stresses};
use crate::dda::condense::{Condensed, Loose, Node, Unbuilt};
use crate::dda::contact::{Contact, Law};
use crate::dda::factor::Tridiagonal;
use crate::dda::heart::{Heart, Stopped};
use crate::dda::macroblock::Macroblock;
use crate::geometry::{Vec2, cross, perpendicular};
use nalgebra::{DMatrix, DVectorView};

/// Coordinates that differ by this share of the farthest from the origin differ by rounding: some operations' worth.
const ROUNDING: f64 = 256.0 * f64::EPSILON;
/// Work of seeing a subblock from another frame, or of comparing a body with a kind, in multiplications.
const WORK: usize = 300;
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

/// Builds a [`Chain`] interface by interface.
#[derive(Debug)]
pub struct ChainBuilder {
    macroblocks: Vec<Macroblock>,
    touches: Vec<Vec<Touch>>,
}

impl ChainBuilder {
    /// A chain of these bodies with no contacts yet, the first interface (ground to body 0) open for contacts.
    pub fn new(macroblocks: Vec<Macroblock>) -> Self {
        ChainBuilder { macroblocks, touches: vec![Vec::new()] }
    }

    /// Adds a contact point to the current interface.
    pub fn contact(&mut self, touch: Touch) {
        if let Some(interface) = self.touches.last_mut() {
            interface.push(touch);
        }
    }

    /// Closes the current interface and goes on to the next.
    pub fn next_interface(&mut self) {
        self.touches.push(Vec::new());
    }

    /// The chain; interfaces not reached stay free.
    ///
    /// # Errors
    /// When a body is not held by two contact points at least, or when stopped.
    pub fn finish(mut self, heart: &Heart) -> Result<Chain, Unbuilt> {
        let n = self.macroblocks.len();
        self.touches.resize(n + 1, Vec::new());
        let mut kinds: Vec<Kind> = Vec::new();
        let mut bodies = Vec::new();
        for (i, macroblock) in self.macroblocks.iter().enumerate() {
            let nodes = nodes(&self.touches[i], &self.touches[i + 1]);
            let (origin, x_axis) = nodes.first().map(|n| (n.at, n.axes[0])).ok_or(Loose)?;
            let (seen, nodes) = (macroblock.seen_from(origin, x_axis), seen_nodes(&nodes, origin, x_axis));
            let rounding = ROUNDING * (origin.amax() + extent(&nodes));
            // A kind is compared, or a new one made.
            heart.work(WORK * (1 + kinds.len() + seen.blocks().len()))?;
            let same = |kind: &Kind| alike(kind, &seen, &nodes, rounding);
            let kind = match kinds.iter().rposition(same) {
                Some(kind) => kind,
                None => {
                    kinds.push(Kind::new(seen, nodes, heart)?);
                    kinds.len() - 1
                }
            };
            bodies.push(Body { origin, x_axis, kind });
        }
        let sizes: Vec<usize> = (0..2 * n).map(|face| 2 * self.touches[face.div_ceil(2)].len()).collect();
        let elastic = elastic(&sizes, bodies.iter().map(|b| &kinds[b.kind].condensed), heart)?;
        let mut first = vec![0];
        self.touches.iter().for_each(|t| first.push(first[first.len() - 1] + t.len()));
        let interface = self.touches.iter().enumerate().flat_map(|(k, t)| vec![k; t.len()]).collect();
        let touches = || self.touches.iter().flatten();
        let contacts: Vec<_> = touches().map(|t| Contact::new(t.stiffness, t.law)).collect();
        let links = touches().map(|t| t.link).collect();
        let sites = touches().map(|t| Site { at: t.at, normal: t.normal }).collect();
        let (exact, places) = (contacts.clone(), Vec::new());
        let mut chain = Chain { bodies, kinds, contacts, exact, sites, links, first, interface, places, elastic };
        chain.places = (0..chain.contacts.len()).map(|p| chain.find_places(p)).collect();
        Ok(chain)
    }
}

impl Kind {
    fn new(macroblock: Macroblock, nodes: Vec<Node>, heart: &Heart) -> Result<Self, Unbuilt> {
        let blocks = macroblock.blocks();
        let area: f64 = blocks.iter().map(|b| b.area()).sum();
        let mean = DMatrix::from_fn(3, 6 * blocks.len(), |i, j| {
            let block = &blocks[j / 6];
            let weight = block.area() / area / if i == 2 { block.size() } else { 1.0 };
            if j % 6 == i { weight } else { 0.0 }
        });
        let stress: Vec<_> = blocks.iter().map(|b| b.stress_matrix()).collect();
        let columns = 2 * nodes.len();
        let mut mean_of_nodes = DMatrix::zeros(3, columns);
        let kept = Some(3 * blocks.len()).filter(|rows| rows * columns <= MOST_KEPT);
        let mut stress_of_nodes = kept.map(|rows| DMatrix::zeros(rows, columns));
        let condensed = Condensed::new(&macroblock, &nodes, heart, |j, d| {
            mean_of_nodes.set_column(j, &(&mean * DVectorView::from_slice(d, d.len())));
            if let Some(of_nodes) = &mut stress_of_nodes {
                of_nodes.set_column(j, &stresses(&stress, d));
            }
        })?;
        Ok(Kind { macroblock, nodes, condensed, mean, mean_of_nodes, stress, stress_of_nodes })
    }
}

/// Nodes of a body between two interfaces, first those on the first.
fn nodes(before: &[Touch], after: &[Touch]) -> Vec<Node> {
    let node = |t: &Touch, holds| Node { at: t.at, axes: [t.normal, perpendicular(t.normal)], link: t.link, holds };
    before.iter().map(|t| node(t, t.after)).chain(after.iter().map(|t| node(t, t.before))).collect()
}

fn seen_nodes(nodes: &[Node], origin: Vec2, x_axis: Vec2) -> Vec<Node> {
    let turned = |v: Vec2| Vec2::new(v.dot(&x_axis), cross(x_axis, v));
    nodes.iter().map(|n| Node { at: turned(n.at - origin), axes: n.axes.map(turned), ..*n }).collect()
}

fn extent(nodes: &[Node]) -> f64 {
    nodes.iter().map(|n| n.at.amax()).fold(0.0, f64::max)
}

/// True where a body seen from its own frame is the same as `kind`, up to the rounding of its coordinates.
fn alike(kind: &Kind, body: &Macroblock, nodes: &[Node], rounding: f64) -> bool {
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
        && kind.macroblock.same_as(body, rounding)
}

/// Elastic stiffness between the faces of all bodies.
fn elastic<'c>(
    sizes: &[usize],
    bodies: impl Iterator<Item = &'c Condensed>,
    heart: &Heart,
) -> Result<Tridiagonal, Stopped> {
    let mut k = Tridiagonal::zeros(sizes);
    for (i, condensed) in bodies.enumerate() {
        k.set_pair(2 * i, |i, j| condensed.stiffness()[(i, j)]);
        heart.work(SET * condensed.stiffness().len())?;
    }
    Ok(k)
}
