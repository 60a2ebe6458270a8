//! Statics: what the resultant through an interface is at its two points.

use super::super::assembly::Assembly;
use super::{Three, dot};
use crate::geometry::{Vec2, cross, perpendicular};

/// Share of an interface's length by which its points may be off its line.
const STRAIGHT: f64 = 1e-9;

/// Forces at the points of an interface by the resultant there: of the force on the body after along both axes, N/m, and its moment
/// about the chain's middle over the chain's size, N/m.
#[derive(Debug, Clone)]
pub(super) struct Statics {
    /// Normal forces of both points.
    pub normals: [Three; 2],
    /// Shear through the interface.
    pub shear: Three,
}

impl Statics {
    /// Normal and tangential force of both points with no split, one after the other.
    pub(super) fn forces(&self) -> [Three; 4] {
        let half = self.shear.map(|v| 0.5 * v);
        [self.normals[0], half, self.normals[1], half]
    }

    /// Normal forces and shear by a resultant, N/m.
    pub(super) fn at(&self, resultant: &Three) -> ([f64; 2], f64) {
        (self.normals.each_ref().map(|normal| dot(normal, resultant)), dot(&self.shear, resultant))
    }
}

/// Of every interface; none where one of them is not straight.
pub(super) fn of(assembly: &Assembly) -> Option<Vec<Statics>> {
    let frame = Frame::new(assembly);
    let of = |k: usize| {
        let points = assembly.at_interface(k);
        let (first, second) = (points.start, points.start + 1);
        let normal = assembly.normal(first);
        let along = assembly.place(second) - assembly.place(first);
        let straight = along.dot(&normal).abs() <= STRAIGHT * along.norm()
            && (assembly.normal(second) - normal).norm() <= STRAIGHT;
        // Of the moment, what each force has for an arm.
        let [normal_arms, shear_arms] = [normal, perpendicular(normal)]
            .map(|way| [first, second].map(|p| cross(assembly.place(p) - frame.middle, way) / frame.size));
        let shear = [perpendicular(normal).x, perpendicular(normal).y, 0.0];
        let both = [normal.x, normal.y, 0.0];
        let lever = normal_arms[1] - normal_arms[0];
        let moment = |c: usize| if c == 2 { 1.0 } else { 0.0 };
        let on_second: Three =
            std::array::from_fn(|c| (moment(c) - shear[c] * shear_arms[0] - both[c] * normal_arms[0]) / lever);
        let on_first = std::array::from_fn(|c| both[c] - on_second[c]);
        (straight && lever.abs() > STRAIGHT).then_some(Statics { normals: [on_first, on_second], shear })
    };
    (0..assembly.interfaces()).map(of).collect()
}

/// Resultants of loads on the nodes up to every interface: what it carries more than the first.
pub(super) fn carried(assembly: &Assembly, loads: &[f64]) -> Vec<Three> {
    let frame = Frame::new(assembly);
    let (mut sum, mut carried) = ([0.0; 3], vec![[0.0; 3]]);
    for body in 0..assembly.bodies() {
        let nodes = loads[assembly.nodes_of(body)].as_chunks::<2>().0;
        let points = assembly.at_interface(body).chain(assembly.at_interface(body + 1));
        for (p, [along, across]) in points.zip(nodes) {
            let normal = assembly.normal(p);
            let force: Vec2 = normal * *along + perpendicular(normal) * *across;
            let moment = cross(assembly.place(p) - frame.middle, force) / frame.size;
            sum = [sum[0] + force.x, sum[1] + force.y, sum[2] + moment];
        }
        carried.push(sum);
    }
    carried
}

/// Where moments are taken about, and what they are measured in.
pub(super) struct Frame {
    pub middle: Vec2,
    pub size: f64,
}

impl Frame {
    pub(super) fn new(assembly: &Assembly) -> Self {
        let places = (0..assembly.contacts().len()).map(|p| assembly.place(p));
        let (low, high) = places
            .fold((Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY)), |(low, high), at| {
                (low.inf(&at), high.sup(&at))
            });
        Frame { middle: 0.5 * (low + high), size: (high - low).norm() }
    }
}
