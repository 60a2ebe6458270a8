//! The chain: bodies in a row, joined at interfaces by contact points.

use super::block::V6;
use super::condense::{Condensed, Loose, Node};
use super::contact::{Contact, ContactForce, Law, State};
use super::factor::Tridiagonal;
use super::macroblock::Macroblock;
use crate::geometry::{Vec2, cross, perpendicular};
use nalgebra::{DMatrix, DVector, SMatrix};

/// A contact point as it is built.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Its place, m.
    pub at: Vec2,
    /// Unit vector from the body before into the body after.
    pub normal: Vec2,
    /// Unit vector along which shear counts, perpendicular to the normal.
    pub tangent: Vec2,
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

/// A body of the chain: where its frame is, and which condensed macroblock it is a copy of.
#[derive(Debug, Clone, PartialEq)]
struct Body {
    origin: Vec2,
    x_axis: Vec2,
    kind: usize,
}

/// A macroblock that one or more bodies are copies of, up to a rigid motion.
#[derive(Debug, Clone)]
struct Kind {
    macroblock: Macroblock,
    nodes: Vec<Node>,
    condensed: Condensed,
    /// Area-weighted mean displacement and rotation of the subblocks per unit of their unknowns, 3 x 6 n_subblocks.
    mean: DMatrix<f64>,
    /// The same per displacement of the nodes.
    mean_of_nodes: DMatrix<f64>,
    /// Stress of every subblock per unit of its unknowns, 3 x 6 each, and per displacement of the nodes, 3 n_subblocks x
    /// 2 n_nodes.
    stress: Vec<SMatrix<f64, 3, 6>>,
    stress_of_nodes: DMatrix<f64>,
}

/// Loads on a chain.
#[derive(Debug, Clone, PartialEq)]
pub struct Loads {
    /// What they are worth on the nodes, N/m.
    pub on_nodes: Vec<f64>,
    /// Mean displacement and rotation of every body with its nodes held, in the body's frame.
    mean: Vec<[f64; 3]>,
    /// Stress of its subblocks with its nodes held, in the body's frame, three numbers each.
    stress: Vec<Vec<f64>>,
}

/// A force on one subblock.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Push {
    /// Which body.
    pub body: usize,
    /// Which of its subblocks.
    pub subblock: usize,
    /// Where, m.
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

/// Bodies in a row. Interface `k` joins body `k - 1` to body `k`; beyond either end lies the rigid ground.
///
/// Unknowns are the displacements of the contact points on every body, along each contact's normal and tangent: face
/// `2 i` is that of body `i` to interface `i`, face `2 i + 1` that to interface `i + 1`.
#[derive(Debug, Clone)]
pub struct Chain {
    bodies: Vec<Body>,
    kinds: Vec<Kind>,
    contacts: Vec<Contact>,
    /// Stiffness of every contact's links.
    links: Vec<[f64; 2]>,
    /// Contacts of interface k: `contacts[first[k]..first[k + 1]]`.
    first: Vec<usize>,
    /// Interface of every contact.
    interface: Vec<usize>,
    /// Places of every contact's normal unknown on the body before and on the body after (none: the ground); the
    /// tangential one follows.
    places: Vec<[Option<usize>; 2]>,
    /// Elastic stiffness between the faces.
    elastic: Tridiagonal,
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
    /// When a body is not held by two contact points at least.
    pub fn finish(mut self) -> Result<Chain, Loose> {
        let n = self.macroblocks.len();
        self.touches.resize(n + 1, Vec::new());
        let mut kinds: Vec<Kind> = Vec::new();
        let mut bodies = Vec::new();
        for (i, macroblock) in self.macroblocks.iter().enumerate() {
            let nodes = nodes(&self.touches[i], &self.touches[i + 1]);
            let (origin, x_axis) = nodes.first().map(|n| (n.at, n.axes[0])).ok_or(Loose)?;
            let (seen, nodes) = (macroblock.seen_from(origin, x_axis), seen_nodes(&nodes, origin, x_axis));
            let rounding = 256.0 * f64::EPSILON * (origin.amax() + extent(&nodes));
            let same = |kind: &Kind| alike(kind, &seen, &nodes, rounding);
            let kind = match kinds.iter().rposition(same) {
                Some(kind) => kind,
                None => {
                    kinds.push(Kind::new(seen, nodes)?);
                    kinds.len() - 1
                }
            };
            bodies.push(Body { origin, x_axis, kind });
        }
        let sizes: Vec<usize> = (0..2 * n).map(|face| 2 * self.touches[face.div_ceil(2)].len()).collect();
        let elastic = elastic(&sizes, bodies.iter().map(|b| &kinds[b.kind].condensed));
        let mut first = vec![0];
        self.touches.iter().for_each(|t| first.push(first[first.len() - 1] + t.len()));
        let interface = self.touches.iter().enumerate().flat_map(|(k, t)| vec![k; t.len()]).collect();
        let touches = || self.touches.iter().flatten();
        let contacts = touches().map(|t| Contact::new(t.stiffness, t.law)).collect();
        let links = touches().map(|t| t.link).collect();
        let mut chain = Chain { bodies, kinds, contacts, links, first, interface, places: Vec::new(), elastic };
        chain.places = (0..chain.contacts.len()).map(|p| chain.find_places(p)).collect();
        Ok(chain)
    }
}

impl Kind {
    fn new(macroblock: Macroblock, nodes: Vec<Node>) -> Result<Self, Loose> {
        let condensed = Condensed::new(&macroblock, &nodes)?;
        let area: f64 = macroblock.blocks().iter().map(|b| b.area()).sum();
        let mean = DMatrix::from_fn(3, 6 * macroblock.blocks().len(), |i, j| {
            let block = &macroblock.blocks()[j / 6];
            let weight = block.area() / area / if i == 2 { block.size() } else { 1.0 };
            if j % 6 == i { weight } else { 0.0 }
        });
        let mean_of_nodes = &mean * condensed.response();
        let stress: Vec<_> = macroblock.blocks().iter().map(|b| b.stress_matrix()).collect();
        let stress_of_nodes = DMatrix::from_columns(
            &condensed.response().column_iter().map(|d| stresses(&stress, d.as_slice())).collect::<Vec<_>>(),
        );
        Ok(Kind { macroblock, nodes, condensed, mean, mean_of_nodes, stress, stress_of_nodes })
    }
}

/// Stress of subblocks displaced by `d`, three numbers each.
fn stresses(stress: &[SMatrix<f64, 3, 6>], d: &[f64]) -> DVector<f64> {
    let each = stress.iter().zip(d.chunks_exact(6)).map(|(of, d)| of * V6::from_column_slice(d));
    DVector::from_iterator(3 * stress.len(), each.flat_map(|s| [s[0], s[1], s[2]]))
}

/// Nodes of a body between two interfaces, first those on the first.
fn nodes(before: &[Touch], after: &[Touch]) -> Vec<Node> {
    let node = |t: &Touch, holds| Node { at: t.at, axes: [t.normal, t.tangent], link: t.link, holds };
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
fn elastic<'c>(sizes: &[usize], bodies: impl Iterator<Item = &'c Condensed>) -> Tridiagonal {
    let mut k = Tridiagonal::zeros(sizes);
    for (i, condensed) in bodies.enumerate() {
        let (s, left) = (condensed.stiffness(), sizes[2 * i]);
        let all = left + sizes[2 * i + 1];
        let copy = |panel: &mut [f64], rows: std::ops::Range<usize>, columns: std::ops::Range<usize>| {
            let entries = rows.flat_map(|i| columns.clone().map(move |j| s[(i, j)]));
            panel.iter_mut().zip(entries).for_each(|(entry, x)| *entry = x);
        };
        copy(k.diagonal.get_mut(2 * i), 0..left, 0..left);
        copy(k.diagonal.get_mut(2 * i + 1), left..all, left..all);
        copy(k.upper.get_mut(2 * i), 0..left, left..all);
        copy(k.lower.get_mut(2 * i), left..all, 0..left);
    }
    k
}

impl Chain {
    /// Number of bodies.
    pub fn bodies(&self) -> usize {
        self.bodies.len()
    }

    /// Number of distinct macroblocks that were condensed.
    pub fn kinds(&self) -> usize {
        self.kinds.len()
    }

    /// Number of displacement unknowns: six for every subblock.
    pub fn unknowns(&self) -> usize {
        self.bodies.iter().map(|b| 6 * self.kinds[b.kind].macroblock.blocks().len()).sum()
    }

    /// Elastic stiffness between the faces, N/m2.
    pub fn elastic(&self) -> &Tridiagonal {
        &self.elastic
    }

    /// All contact points, interface by interface.
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

    /// Number of interfaces, the two ends included.
    pub fn interfaces(&self) -> usize {
        self.bodies.len() + 1
    }

    /// Faces before and after interface `k`; none where the ground is.
    pub fn faces(&self, k: usize) -> [Option<usize>; 2] {
        [(2 * k).checked_sub(1), Some(2 * k).filter(|_| k < self.bodies.len())]
    }

    fn find_places(&self, p: usize) -> [Option<usize>; 2] {
        let k = self.interface[p];
        self.faces(k).map(|face| face.map(|face| self.elastic.start[face] + 2 * (p - self.first[k])))
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
        into.extend((0..self.contacts.len()).map(|p| self.gap(p, d)));
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

    /// Contact forces at displacements `d`; the gap is that between the bodies, links and contact together.
    pub fn contact_forces(&self, d: &[f64]) -> Vec<ContactForce> {
        let force = |p: usize| {
            let [gap, slip] = self.gap(p, d);
            let force = self.contacts[p].force(gap, slip);
            let ties = self.places[p].iter().flatten().count() as f64;
            ContactForce { gap: gap - ties * force.normal / self.links[p][0], ..force }
        };
        (0..self.contacts.len()).map(force).collect()
    }

    /// Tangent stiffness of interface `k` in the given states, as one 2 x 2 block per contact.
    pub(super) fn interface_stiffness<'s>(
        &'s self,
        k: usize,
        states: &'s [State],
    ) -> impl Iterator<Item = [f64; 4]> + 's {
        self.at_interface(k).map(|p| self.contacts[p].tangent_stiffness(states[p]))
    }

    /// Condenses forces on subblocks onto the nodes.
    pub fn loads(&self, pushes: impl IntoIterator<Item = Push>) -> Loads {
        let zeros = |b: &Body| DVector::zeros(6 * self.kinds[b.kind].macroblock.blocks().len());
        let mut on_blocks: Vec<DVector<f64>> = self.bodies.iter().map(zeros).collect();
        for push in pushes {
            let body = &self.bodies[push.body];
            let block = &self.kinds[body.kind].macroblock.blocks()[push.subblock];
            let load: V6 = block.load(body.turned(push.at - body.origin), body.turned(push.force));
            let mut place = on_blocks[push.body].fixed_rows_mut::<6>(6 * push.subblock);
            place += load;
        }
        let mut loads = Loads { on_nodes: Vec::new(), mean: Vec::new(), stress: Vec::new() };
        for (body, load) in self.bodies.iter().zip(&on_blocks) {
            let kind = &self.kinds[body.kind];
            let [inner, on_nodes] = kind.condensed.load(load);
            loads.on_nodes.extend(on_nodes.iter());
            let mean = &kind.mean * &inner;
            loads.mean.push([mean[0], mean[1], mean[2]]);
            loads.stress.push(stresses(&kind.stress, inner.as_slice()).as_slice().to_vec());
        }
        loads
    }

    /// Displacements of the nodes of body `i`.
    fn of_body<'d>(&self, i: usize, d: &'d [f64]) -> &'d [f64] {
        &d[self.elastic.start[2 * i]..self.elastic.start[2 * i + 2]]
    }

    /// Mean motion of body `i` for node displacements (or velocities) `d` and what loads, each times its factor, add
    /// between the nodes.
    pub fn mean_motion(&self, i: usize, d: &[f64], loads: &[(&Loads, f64)]) -> MeanMotion {
        let body = &self.bodies[i];
        let of_nodes = &self.kinds[body.kind].mean_of_nodes;
        let mut mean = [0.0; 3];
        let mut add = |column: &[f64], x: f64| mean.iter_mut().zip(column).for_each(|(sum, share)| *sum += share * x);
        of_nodes.column_iter().zip(self.of_body(i, d)).for_each(|(column, &x)| add(column.as_slice(), x));
        loads.iter().for_each(|(loads, factor)| add(&loads.mean[i], *factor));
        MeanMotion { displacement: body.turned_back(Vec2::new(mean[0], mean[1])), rotation: mean[2] }
    }

    /// Stress (sigma_x, sigma_y, tau_xy) in every subblock of body `i`, three numbers each in the body's own frame, Pa.
    pub fn stresses_in_frame(&self, i: usize, d: &[f64], loads: &[(&Loads, f64)], into: &mut Vec<f64>) {
        let of_nodes = &self.kinds[self.bodies[i].kind].stress_of_nodes;
        into.clear();
        into.resize(of_nodes.nrows(), 0.0);
        let mut add = |column: &[f64], x: f64| into.iter_mut().zip(column).for_each(|(sum, share)| *sum += share * x);
        of_nodes.column_iter().zip(self.of_body(i, d)).for_each(|(column, &x)| add(column.as_slice(), x));
        loads.iter().for_each(|(loads, factor)| add(&loads.stress[i], *factor));
    }

    /// Stress (sigma_x, sigma_y, tau_xy) in every subblock of body `i`, Pa, for node displacements `d` under loads, each
    /// times its factor.
    pub fn stresses(&self, i: usize, d: &[f64], loads: &[(&Loads, f64)]) -> Vec<[f64; 3]> {
        let mut in_frame = Vec::new();
        self.stresses_in_frame(i, d, loads, &mut in_frame);
        in_frame.chunks_exact(3).map(|s| self.bodies[i].stress_turned_back([s[0], s[1], s[2]])).collect()
    }
}

impl Body {
    fn turned(&self, v: Vec2) -> Vec2 {
        Vec2::new(v.dot(&self.x_axis), cross(self.x_axis, v))
    }

    fn turned_back(&self, v: Vec2) -> Vec2 {
        self.x_axis * v.x + perpendicular(self.x_axis) * v.y
    }

    /// A state of stress in the frame of the chain.
    fn stress_turned_back(&self, [x, y, tau]: [f64; 3]) -> [f64; 3] {
        let (c, s) = (self.x_axis.x, self.x_axis.y);
        let (cc, ss, cs) = (c * c, s * s, c * s);
        [cc * x + ss * y - 2.0 * cs * tau, ss * x + cc * y + 2.0 * cs * tau, cs * (x - y) + (cc - ss) * tau]
    }
}
