//! An assembly and its mirror image about a vertical axis.
//!
//! Interfaces are matched by their middles. Where the mirror image of an interface's normal points against its partner's, what
//! lies before the one is the image of what lies after the other, and points keep their order; a node's displacement along the
//! normal changes its sign, and that along the tangent (the normal turned by +90 degrees) keeps it. Where the normals agree it is
//! the other way round. Gaps stay, slips change their sign.

use super::{Assembly, Beside};
use crate::dda::contact::{Contact, Law};
use crate::geometry::{Vec2, mirrored};
use std::collections::BTreeSet;

/// Numbers of two mirror images that differ by this share of the largest differ by rounding.
const MIRROR_ROUNDING: f64 = 1e-9;
/// The same for the stiffness of condensed bodies, which took many operations.
const STIFFNESS_ROUNDING: f64 = 1e-7;

/// Where the mirror image of every unknown is, and whether it keeps its sign.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Mirror {
    place: Vec<usize>,
    sign: Vec<f64>,
    /// Which body is the image of every body.
    bodies: Vec<usize>,
    /// Abscissa of the axis, m.
    axis: f64,
}

/// The mirror image of an interface, and whether what lies before is exchanged with what lies after.
type Image = (usize, bool);

impl Assembly {
    /// Displacements of the nodes (or loads on them) of the mirror image, where the assembly is its own; else as they are.
    pub fn mirrored(&self, d: &[f64]) -> Vec<f64> {
        let Some(Mirror { place, sign, .. }) = &self.mirror else { return d.to_vec() };
        place.iter().zip(sign).map(|(&place, sign)| sign * d[place]).collect()
    }

    /// The mean of displacements of the nodes and their mirror image, where the assembly is its own: symmetric to the last digit.
    pub fn symmetrised(&self, d: &[f64]) -> Vec<f64> {
        let Some(Mirror { place, sign, .. }) = &self.mirror else { return d.to_vec() };
        place.iter().zip(sign).zip(d).map(|((&place, sign), here)| 0.5 * (sign * d[place] + here)).collect()
    }

    /// True where the assembly and `loads` on its nodes are their own mirror image.
    pub fn are_symmetric(&self, loads: &[f64]) -> bool {
        self.is_symmetric() && near(&self.mirrored(loads), loads, MIRROR_ROUNDING)
    }

    /// How many times loads `scaled` on the nodes have to be added to, or taken from, `fixed` until the sum is not its own mirror
    /// image for sure.
    pub fn lopsided_beyond(&self, fixed: &[f64], scaled: &[f64]) -> f64 {
        let size = |loads: &mut dyn Iterator<Item = f64>| loads.fold(0.0f64, |most, load| most.max(load.abs()));
        let [of_fixed, of_scaled] = [fixed, scaled].map(|loads| {
            let apart = size(&mut self.mirrored(loads).iter().zip(loads).map(|(there, here)| there - here));
            [apart, MIRROR_ROUNDING * size(&mut loads.iter().copied())]
        });
        let share = (of_fixed[0] + of_fixed[1]) / (of_scaled[0] - of_scaled[1]);
        if of_scaled[0] > of_scaled[1] { share } else { f64::INFINITY }
    }

    /// True where the assembly is its own mirror image: places, normals, exact contacts and elastic stiffness.
    pub fn is_symmetric(&self) -> bool {
        self.mirror.is_some()
    }

    /// Which body is the mirror image of every body, and the abscissa of the axis, m; none where the assembly is not its own.
    pub fn images_of_bodies(&self) -> Option<(&[usize], f64)> {
        self.mirror.as_ref().map(|mirror| (mirror.bodies.as_slice(), mirror.axis))
    }

    /// The mirror image, if the assembly is its own.
    pub(super) fn find_mirror(&self) -> Option<Mirror> {
        let (images, axis) = self.images()?;
        let unknowns = self.node_unknowns();
        let mut mirror = Mirror { place: vec![0; unknowns], sign: vec![0.0; unknowns], bodies: Vec::new(), axis };
        let mut bodies = vec![None; self.bodies.len()];
        for (k, &(image, swapped)) in images.iter().enumerate() {
            self.pair_bodies(k, (image, swapped), &mut bodies)?;
            let (here, there) = (self.at_interface(k), self.at_interface(image));
            for (j, p) in here.clone().enumerate() {
                let q = if swapped { there.start + j } else { there.end - 1 - j };
                let same =
                    |a: &Contact, b: &Contact| alike(a.law, b.law) && near(&a.stiffness, &b.stiffness, MIRROR_ROUNDING);
                if !same(&self.exact[p], &self.exact[q]) {
                    return None;
                }
                for side in 0..2 {
                    let partner = if swapped { 1 - side } else { side };
                    let (Some(at), Some(from)) = (self.places[p][side], self.places[q][partner]) else { continue };
                    let sign = if swapped { -1.0 } else { 1.0 };
                    (mirror.place[at], mirror.place[at + 1]) = (from, from + 1);
                    (mirror.sign[at], mirror.sign[at + 1]) = (sign, -sign);
                }
            }
        }
        mirror.bodies = bodies.into_iter().collect::<Option<_>>()?;
        let kinds = |(a, &b): (usize, &usize)| {
            Some(([a, b].map(|body| self.bodies[body].kind), self.image_of_nodes(a, b, &mirror)?))
        };
        // Once for all bodies of the same kinds.
        let images: BTreeSet<_> = mirror.bodies.iter().enumerate().map(kinds).collect::<Option<_>>()?;
        images.iter().all(|(kinds, image)| self.is_mirror_image(*kinds, image)).then_some(mirror)
    }

    /// The mirror image of every interface, and the axis; none where one has none.
    fn images(&self) -> Option<(Vec<Image>, f64)> {
        let middle = |k: usize| {
            let points = &self.sites[self.at_interface(k)];
            Some(0.5 * (points.first()?.at + points.last()?.at))
        };
        let middles: Vec<Vec2> = (0..self.interfaces()).map(middle).collect::<Option<_>>()?;
        let (low, high) = middles
            .iter()
            .fold((Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY)), |(l, h), m| (l.inf(m), h.sup(m)));
        let (axis, rounding) = (0.5 * (low.x + high.x), MIRROR_ROUNDING * (high - low).amax());
        let mut by_height: Vec<usize> = (0..middles.len()).collect();
        by_height.sort_by(|&a, &b| middles[a].y.total_cmp(&middles[b].y));
        let image = |k: usize| {
            let wanted = mirrored(middles[k], axis);
            let from = by_height.partition_point(|&other| middles[other].y < wanted.y - rounding);
            let level = by_height[from..].iter().take_while(|&&other| middles[other].y <= wanted.y + rounding);
            { level }.find_map(|&other| {
                let near = (middles[other] - wanted).amax() <= rounding;
                self.facing(k, other).filter(|_| near).map(|swapped| (other, swapped))
            })
        };
        Some(((0..middles.len()).map(image).collect::<Option<_>>()?, axis))
    }

    /// Whether what lies before and after is exchanged between an interface and its mirror image; none where the other is not.
    fn facing(&self, k: usize, image: usize) -> Option<bool> {
        let (here, there) = (self.at_interface(k), self.at_interface(image));
        let (a, b) = (mirrored(self.sites[here.start].normal, 0.0), self.sites[there.start].normal);
        let same = |b: Vec2| near(&[a.x, a.y], &[b.x, b.y], MIRROR_ROUNDING);
        let swapped = if same(-b) { Some(true) } else { same(b).then_some(false) };
        swapped.filter(|_| here.len() == there.len())
    }

    /// Writes down which body is the mirror image of which; none where it is not the same everywhere.
    fn pair_bodies(&self, k: usize, (image, swapped): Image, bodies: &mut [Option<usize>]) -> Option<()> {
        for side in 0..2 {
            let partner = if swapped { 1 - side } else { side };
            match (self.beside[k][side], self.beside[image][partner]) {
                (Beside::Body(a), Beside::Body(b)) => {
                    bodies[a] = Some(b).filter(|_| bodies[a].is_none_or(|other| other == b));
                    bodies[a]?;
                }
                (Beside::Ground(_), Beside::Ground(_)) => {}
                _ => return None,
            }
        }
        Some(())
    }

    /// The unknown of body `b` that is the image of each unknown of body `a`, and whether its sign changes; none where some image is
    /// another body's.
    fn image_of_nodes(&self, a: usize, b: usize, mirror: &Mirror) -> Option<Vec<(usize, bool)>> {
        let (here, there) = (self.nodes_of(a), self.nodes_of(b));
        let image = |i: usize| {
            let at = mirror.place[i];
            there.contains(&at).then(|| (at - there.start, mirror.sign[i] < 0.0))
        };
        if here.len() == there.len() { here.map(image).collect() } else { None }
    }

    /// Whether the stiffness of one kind is the mirror image of that of another.
    fn is_mirror_image(&self, kinds: [usize; 2], image: &[(usize, bool)]) -> bool {
        let [of_a, of_b] = kinds.map(|kind| self.kinds[kind].condensed.stiffness());
        let near = |i: usize, j: usize| {
            let ((at, turns), (other, also)) = (image[i], image[j]);
            let there = if turns == also { of_b[(at, other)] } else { -of_b[(at, other)] };
            (of_a[(i, j)] - there).abs() <= STIFFNESS_ROUNDING * of_a[(i, i)].abs().max(of_a[(j, j)].abs())
        };
        // Both are symmetric, but for rounding.
        (0..image.len()).all(|i| (0..=i).all(|j| near(i, j)))
    }
}

/// True where two laws are the same; caps may differ by rounding.
fn alike(a: Law, b: Law) -> bool {
    match (a, b) {
        (Law::Coulomb { cap: a_cap, .. }, Law::Coulomb { cap: b_cap, friction, cohesion }) if a_cap.is_finite() => {
            near(&[a_cap], &[b_cap], MIRROR_ROUNDING) && a == Law::Coulomb { friction, cohesion, cap: a_cap }
        }
        _ => a == b,
    }
}

/// True where two lists are the same but for rounding.
fn near(a: &[f64], b: &[f64], rounding: f64) -> bool {
    let scale = a.iter().chain(b).fold(0.0f64, |most, x| most.max(x.abs()));
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= rounding * scale)
}
