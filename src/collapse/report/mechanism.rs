//! How a structure falls.

use super::Face;
use crate::geometry::Vec2;

/// How the arch moves when it falls.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "server", derive(serde::Serialize, utoipa::ToSchema))]
#[cfg_attr(feature = "server", serde(rename_all = "snake_case"))]
pub enum Mode {
    /// The crown goes up.
    CrownRises,
    /// The crown goes down.
    CrownDescends,
    /// The crown moves sideways more than up or down.
    Sway,
    /// Joints slide more than they open.
    Sliding,
    /// Blocks turn over, in a structure without spans.
    Overturning,
    /// Joints crush over their whole length, and none opens or slides.
    Crushing,
}

/// A joint pressed at one face and opening at the other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hinge {
    /// Joint number.
    pub joint: usize,
    /// Face at which the joint stays pressed (the axis of rotation); it opens at the other.
    pub face: Face,
    /// The point that it turns about: the end of the joint on that face, or of the block that is crushed there, m.
    pub at: Vec2,
    /// Angle of the joint's middle from that of the nearer springing of its span, about the middle between both springings, rad;
    /// None of a joint of no span.
    pub angle_from_springing: Option<f64>,
    /// Angle of the joint from the crown of its span, negative on the left, rad; None of a joint of no span.
    pub angle_from_crown: Option<f64>,
    /// Relative rotation rate in the mechanism (largest of all hinges = 1), positive.
    pub rotation: f64,
}

/// A joint that slides in the mechanism.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slide {
    /// Joint number.
    pub joint: usize,
    /// The joint's middle, m.
    pub at: Vec2,
    /// Sliding rate of the stone after the joint towards the extrados, relative to the one before it, in the
    /// mechanism's scale (m per rad of the largest hinge rotation; largest slide = 1 where no hinge turns).
    pub rate: f64,
}

/// A joint that parts altogether in the mechanism: it carries no force, and no point of it stays pressed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LiftOff {
    /// Joint number.
    pub joint: usize,
    /// The joint's middle, m.
    pub at: Vec2,
    /// Rate at which its end on the intrados opens, in the mechanism's scale (m per rad of the largest hinge rotation; largest
    /// slide = 1 where no hinge turns, largest opening = 1 where nothing slides either).
    pub intrados: f64,
    /// The same of its end on the extrados.
    pub extrados: f64,
    /// Rate at which what lies after it moves along it, towards the extrados positive, in the same scale: no friction opposes it.
    pub along: f64,
}

/// How the arch falls.
#[derive(Debug, Clone, PartialEq)]
pub struct Mechanism {
    /// In one word.
    pub mode: Mode,
    /// Hinges from left to right.
    pub hinges: Vec<Hinge>,
    /// Joints that slide under pressure, from left to right.
    pub slides: Vec<Slide>,
    /// Joints that part altogether, from left to right.
    pub lift_offs: Vec<LiftOff>,
    /// Velocity (u, v) and rotation rate of every voussoir in the mechanism, in the hinges' scale.
    pub velocities: Vec<[f64; 3]>,
}

impl Mechanism {
    /// Whether faces move along each other, pressed or parted: the load need not be that of limit analysis then.
    pub fn slips(&self) -> bool {
        !self.slides.is_empty() || self.slips_parted().next().is_some()
    }

    /// Joints that part altogether and whose faces move along each other too.
    pub fn slips_parted(&self) -> impl Iterator<Item = usize> {
        self.lift_offs.iter().filter(|lift_off| lift_off.along != 0.0).map(|lift_off| lift_off.joint)
    }
}
