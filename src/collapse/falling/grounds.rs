//! The ground that falling stones meet.

use crate::dda::falling::RigidBody;
use crate::geometry::{Vec2, perpendicular};
use crate::structure::{Side, Structure};

/// Joints on one line to this share of the extent share the ground between them.
const COLLINEAR: f64 = 1e-6;
/// The ground at a level and the wall at the crown of half an arch go on for so many extents.
const GROUND_EXTENTS: f64 = 10.0;

/// Lowest and highest coordinates of all stones, and the longer side of the box between them.
pub(super) fn around(structure: &Structure) -> ([Vec2; 2], f64) {
    let corners = || structure.bodies.iter().flat_map(|body| &body.corners);
    let low = corners().fold(Vec2::repeat(f64::INFINITY), |low, corner| low.inf(corner));
    let high = corners().fold(low, |high, corner| high.sup(corner));
    ([low, high], (high - low).amax())
}

/// Ground below a straight line.
struct Ground {
    number: usize,
    /// Unit normal out of it, and how far out the line is, m.
    normal: Vec2,
    level: f64,
    /// From where to where it goes along the line, to the right as one looks along the normal, m.
    reach: [f64; 2],
    friction: f64,
}

impl Ground {
    /// As deep as it is wide.
    fn body(&self) -> RigidBody {
        let [from, to] = self.reach;
        let at = |along: f64, depth: f64| self.normal * (self.level - depth) - perpendicular(self.normal) * along;
        let corners = vec![at(from, to - from), at(to, to - from), at(to, 0.0), at(from, 0.0)];
        RigidBody::fixed(corners, self.number, self.friction)
    }
}

/// The ground of every support: below its joints, from the first to the last of those on one line. The wall at the crown of half
/// an arch goes on above and below. And the ground at a level, if one is stated.
pub(super) fn grounds(structure: &Structure, level: Option<f64>) -> Vec<RigidBody> {
    let ([low, high], extent) = around(structure);
    let (far, first) = (GROUND_EXTENTS * extent, structure.bodies.len());
    let mut grounds: Vec<Ground> = Vec::new();
    for joint in &structure.joints {
        let (support, normal) = match joint.between {
            [Side::Support(support), _] => (support, joint.normal()),
            [_, Side::Support(support)] => (support, -joint.normal()),
            _ => continue,
        };
        let (number, level) = (first + support, normal.dot(&joint.intrados));
        let ends = [joint.intrados, joint.extrados].map(|end| -perpendicular(normal).dot(&end));
        let (beyond, friction) = if joint.is_symmetry() { (far, 0.0) } else { (0.0, f64::INFINITY) };
        let reach = [ends[0].min(ends[1]) - beyond, ends[0].max(ends[1]) + beyond];
        let on_line = |other: &&mut Ground| {
            let off = (other.level - level).abs() + (other.normal - normal).norm() * extent;
            other.number == number && off < COLLINEAR * extent
        };
        match grounds.iter_mut().find(on_line) {
            Some(other) => other.reach = [other.reach[0].min(reach[0]), other.reach[1].max(reach[1])],
            None => grounds.push(Ground { number, normal, level, reach, friction }),
        }
    }
    let (number, reach) = (first + structure.supports, [low.x - far, high.x + far]);
    let flat = |level| Ground { number, normal: Vec2::y(), level, reach, friction: f64::INFINITY };
    grounds.iter().chain(level.map(flat).iter()).map(Ground::body).collect()
}
