//! Joints that are open, and how wide.

use super::discretise::Model;
use super::{Face, OpenJoint, SettlementPath, Thrust};
use crate::dda::Tracer;
use crate::structure::{Joint, Structure};

/// A joint that is open by less than this share of its length is shut: that is strain of stones and contacts.
const SHUT: f64 = 1e-6;

/// Hinges with which an arch follows any movement of its springings.
const HINGES: usize = 3;
/// A thrust so far from the middle of its joint, as a share of half its length, is at its end but for what stone and contacts give.
const AT_END: f64 = 0.99;

/// The joints that are open where the path is, in their order.
pub(super) fn open_joints(structure: &Structure, model: &Model, tracer: &Tracer) -> Vec<OpenJoint> {
    let opens = |(k, joint): (usize, &Joint)| {
        joint.law.coulomb()?;
        let gap = |p: usize| model.opening(k, tracer.gap_between_bodies(p));
        let gaps: Vec<[f64; 2]> = model.contacts(k).map(|p| [model.position(k, p), gap(p)]).collect();
        open_joint(k, joint, &gaps)
    };
    structure.ring().iter().enumerate().filter_map(opens).collect()
}

/// From gaps at places on the joint: 0 at the intrados, 1 at the extrados.
fn open_joint(number: usize, joint: &Joint, gaps: &[[f64; 2]]) -> Option<OpenJoint> {
    let ends = [gaps.first()?[1], gaps.last()?[1]];
    let (face, [width, other]) = match ends {
        [intrados, extrados] if intrados > extrados => (Face::Intrados, ends),
        [intrados, extrados] => (Face::Extrados, [extrados, intrados]),
    };
    let open: f64 = gaps.windows(2).map(|pair| open_between(pair[0], pair[1])).sum();
    (width > SHUT * joint.length()).then(|| OpenJoint {
        joint: number,
        face,
        at: joint.end(face),
        width,
        other: other.max(0.0),
        depth: open * joint.length(),
    })
}

/// The length of a stretch over which a gap linear on it is more than none.
fn open_between([from, a]: [f64; 2], [to, b]: [f64; 2]) -> f64 {
    let share = match (a > 0.0, b > 0.0) {
        (true, true) => 1.0,
        (false, false) => 0.0,
        (true, false) => a / (a - b),
        (false, true) => b / (b - a),
    };
    share * (to - from)
}

/// Of an arch that could follow its springings by opening other joints, or these by more or less: at how many joints the thrust
/// passes through an end. Three hinges are enough to follow.
pub(super) fn shared(structure: &Structure, path: &SettlementPath) -> Option<usize> {
    let at_end = |thrust: &&Thrust| thrust.eccentricity.abs() >= 0.5 * AT_END * structure.ring()[thrust.joint].length();
    let ends = path.thrust_line.iter().filter(at_end).count();
    (structure.is_one_ring() && !structure.is_half() && ends > HINGES).then_some(ends)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vec2;
    use crate::structure::{JointLaw, Side};

    #[test]
    fn width_and_depth_are_those_of_a_gap_linear_between_points() {
        let joint = Joint {
            between: [Side::Support(0), Side::Body(0)],
            intrados: Vec2::new(1.0, 0.0),
            extrados: Vec2::new(1.0, 2.0),
            law: JointLaw::Dry { friction: 0.5, cohesion: 0.0 },
        };
        let hinge = open_joint(3, &joint, &[[0.0, -1e-4], [1.0, 3e-4]]).unwrap();
        let expected =
            OpenJoint { joint: 3, face: Face::Extrados, at: joint.extrados, width: 3e-4, other: 0.0, depth: 1.5 };
        assert_eq!(hinge, expected);
        let part = open_joint(3, &joint, &[[0.0, 2e-3], [0.5, 1e-3], [1.0, -1e-3]]).unwrap();
        assert!((part.face, part.width) == (Face::Intrados, 2e-3) && (part.depth - 1.5).abs() < 1e-12);
        let apart = open_joint(3, &joint, &[[0.0, 2e-3], [1.0, 1e-3]]).unwrap();
        assert_eq!([apart.width, apart.other, apart.depth], [2e-3, 1e-3, 2.0]);
        assert_eq!(open_joint(3, &joint, &[[0.0, -1e-3], [1.0, 1e-7]]), None);
    }
}
