//! From joints to an arch: checks that the stones can exist, adds springings and abutments.

use super::{Abutment, Arch, Face, Joint, JointLaw, Sides, Voussoir};
use crate::geometry::{Region, Vec2, segments_meet};

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
fn corners(left: &[Vec2; 2], right: &[Vec2; 2]) -> [Vec2; 4] {
    [left[0], right[0], right[1], left[1]]
}

/// The voussoirs between the given joint ends, with straight sides.
///
/// # Errors
/// Every stone that cannot exist.
pub fn straight_voussoirs(ends: &[[Vec2; 2]]) -> Result<Vec<Voussoir>, Vec<ArchFault>> {
    let (mut voussoirs, mut faults) = (Vec::new(), Vec::new());
    for (voussoir, pair) in ends.windows(2).enumerate() {
        let [a, b, c, d] = corners(&pair[0], &pair[1]);
        let region = Region::polygon(&[a, b, c, d]);
        if segments_meet(a, d, b, c) {
            faults.push(ArchFault::JointsCross { voussoir });
        } else if segments_meet(a, b, c, d) || region.area.is_nan() || region.area <= 0.0 {
            faults.push(ArchFault::InsideOut { voussoir });
        }
        voussoirs.push(Voussoir { region, sides: Sides::Straight });
    }
    let ([a, b], [c, d]) = (ends[0], ends[ends.len() - 1]);
    if segments_meet(a, b, c, d) {
        faults.push(ArchFault::SpringingsCross);
    }
    if faults.is_empty() { Ok(voussoirs) } else { Err(faults) }
}

impl Arch {
    /// Puts the arch together; every joint gets the same law.
    pub fn assemble(ends: &[[Vec2; 2]], voussoirs: Vec<Voussoir>, law: JointLaw, angle_centre: Vec2) -> Arch {
        Arch {
            voussoirs,
            joints: ends.iter().map(|&[intrados, extrados]| Joint { intrados, extrados, law }).collect(),
            abutments: [None, None],
            half: false,
            angle_centre,
        }
    }

    /// Corners of voussoir `k`, counter-clockwise from the intrados end of its left joint, m.
    pub fn corners(&self, k: usize) -> [Vec2; 4] {
        let [left, right] = [&self.joints[k], &self.joints[k + 1]];
        corners(&[left.intrados, left.extrados], &[right.intrados, right.extrados])
    }

    /// The straight extrados side of voussoir `k`, from left to right, m.
    pub fn extrados_side(&self, k: usize) -> (Vec2, Vec2) {
        (self.joints[k].extrados, self.joints[k + 1].extrados)
    }

    /// Puts rectangles of height `height`, m, on the outer sides of the springing joints, bonded to the foundation.
    pub fn stand_on_abutments(&mut self, height: f64) {
        let last = self.joints.len() - 1;
        self.abutments = [(0, -height), (last, height)].map(|(joint, shift)| {
            let top = self.joints[joint];
            let shift = shift * top.normal();
            let base = Joint { intrados: top.intrados + shift, extrados: top.extrados + shift, law: JointLaw::Bonded };
            let mut region = Region::polygon(&[top.intrados, top.extrados, base.extrados, base.intrados]);
            region.area = region.area.abs();
            Some(Abutment { base, region })
        });
    }
}
