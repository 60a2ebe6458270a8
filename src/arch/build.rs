//! From joints to a structure: checks that the stones can exist, adds springings and abutments.

use crate::geometry::{Region, Vec2, segments_meet};
use crate::structure::{Body, Face, Joint, JointLaw, Side, Sides, Span, Stone, Structure, Surface};

/// Most voussoirs an arch may have.
pub const MAX_VOUSSOIRS: usize = 2001;

/// Why an arch cannot be built.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum ArchFault {
    /// The line of a joint does not meet a face of the arch.
    #[error("the line of joint {joint} does not meet the {face} at a point beside it")]
    JointMisses {
        /// Joint number.
        joint: usize,
        /// Which face.
        face: Face,
    },
    /// Two neighbouring joints have a point in common.
    #[error("the joints on both sides of voussoir {voussoir} cross or touch")]
    JointsCross {
        /// Which voussoir.
        voussoir: usize,
    },
    /// The faces of one voussoir cross, or its corners run clockwise: the stone is inside out.
    #[error("voussoir {voussoir} is inside out (its intrados and extrados cross, or run from right to left)")]
    InsideOut {
        /// Which voussoir.
        voussoir: usize,
    },
    /// The springing joints have a point in common.
    #[error("the two springing joints cross: the arch runs into itself")]
    SpringingsCross,
}

/// Corners of a voussoir, counter-clockwise from the intrados end of its left joint.
pub(super) fn corners(left: &[Vec2; 2], right: &[Vec2; 2]) -> [Vec2; 4] {
    [left[0], right[0], right[1], left[1]]
}

/// The voussoirs between the given joint ends, with straight sides.
///
/// # Errors
/// Every stone that cannot exist.
pub fn straight_voussoirs(ends: &[[Vec2; 2]]) -> Result<Vec<Body>, Vec<ArchFault>> {
    let (mut voussoirs, mut faults) = (Vec::new(), Vec::new());
    for (voussoir, pair) in ends.windows(2).enumerate() {
        let [a, b, c, d] = corners(&pair[0], &pair[1]);
        let region = Region::polygon(&[a, b, c, d]);
        if segments_meet(a, d, b, c) {
            faults.push(ArchFault::JointsCross { voussoir });
        } else if segments_meet(a, b, c, d) || region.area.is_nan() || region.area <= 0.0 {
            faults.push(ArchFault::InsideOut { voussoir });
        }
        voussoirs.push(Body { corners: vec![a, b, c, d], sides: Sides::Straight, region, stone: 0 });
    }
    let ([a, b], [c, d]) = (ends[0], ends[ends.len() - 1]);
    if segments_meet(a, b, c, d) {
        faults.push(ArchFault::SpringingsCross);
    }
    if faults.is_empty() { Ok(voussoirs) } else { Err(faults) }
}

/// Puts a ring together from its voussoirs and the ends of their joints: one span, of one stone, between two supports, all
/// joints with the same law. Loads stand on the extrados.
pub fn assemble(ends: &[[Vec2; 2]], voussoirs: Vec<Body>, stone: Stone, law: JointLaw) -> Structure {
    let n = voussoirs.len();
    let before = |k: usize| if k == 0 { Side::Support(0) } else { Side::Body(k - 1) };
    let after = |k: usize| if k == n { Side::Support(1) } else { Side::Body(k) };
    let joint = |(k, &[intrados, extrados]): (usize, &[Vec2; 2])| Joint {
        between: [before(k), after(k)],
        intrados,
        extrados,
        law,
    };
    let surface = |(body, pair): (usize, &[[Vec2; 2]])| Surface { body, ends: [pair[0][1], pair[1][1]] };
    Structure {
        stones: vec![stone],
        bodies: voussoirs,
        joints: ends.iter().enumerate().map(joint).collect(),
        spans: vec![Span { bodies: 0..n, joints: 0..n + 1 }],
        surfaces: ends.windows(2).enumerate().map(surface).collect(),
        passive: Vec::new(),
        supports: 2,
    }
}

/// Makes every voussoir of a ring of the one of `stones` that `of` gives it, and the joints those of the stones beside them.
pub fn make_of(ring: &mut Structure, stones: Vec<Stone>, of: &[usize]) {
    ring.bodies.iter_mut().zip(of).for_each(|(voussoir, &stone)| voussoir.stone = stone);
    for joint in &mut ring.joints {
        let [before, after] = joint.between.map(|side| side.body().map(|body| &stones[ring.bodies[body].stone]));
        // The ground is as good as the stone on it.
        if let Some((a, b)) = before.or(after).zip(after.or(before)) {
            joint.law = a.dry_joint_with(b);
        }
    }
    ring.stones = stones;
}

/// Puts rectangles of height `height`, m, on the outer sides of the springing joints of a ring, bonded to the ground.
///
/// They follow the voussoirs, and their bases the joints of the ring: the left one first. Each is of the stone of the voussoir on
/// it, but has no weight.
pub fn stand_on_abutments(ring: &mut Structure, height: f64) {
    let (first_block, last_joint) = (ring.bodies.len(), ring.joints.len() - 1);
    for side in 0..2 {
        let (springing, shift) = [(0, -height), (last_joint, height)][side];
        let (top, block) = (ring.joints[springing], Side::Body(first_block + side));
        let springer = ring.stones[ring.bodies[[0, first_block - 1][side]].stone];
        let shift = shift * top.normal();
        let [intrados, extrados] = [top.intrados + shift, top.extrados + shift];
        let ground = Side::Support(side);
        let (between, corners) = match side {
            0 => ([ground, block], corners(&[intrados, extrados], &[top.intrados, top.extrados])),
            _ => ([block, ground], corners(&[top.intrados, top.extrados], &[intrados, extrados])),
        };
        let mut region = Region::polygon(&[top.intrados, top.extrados, extrados, intrados]);
        region.area = region.area.abs();
        let stone = ring.stones.len();
        ring.stones.push(Stone { density: 0.0, ..springer });
        ring.bodies.push(Body { corners: corners.to_vec(), sides: Sides::Straight, region, stone });
        ring.joints[springing].between[side] = block;
        ring.joints.push(Joint { between, intrados, extrados, law: JointLaw::Bonded });
    }
}
