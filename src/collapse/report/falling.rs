//! How the arch moves on after it has begun to fall.

use crate::geometry::Vec2;
use crate::structure::Face;

/// How a motion ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MotionEnd {
    /// A stone is clear of what it rested on: the joint has opened through.
    StoneFree {
        /// The stone.
        voussoir: usize,
        /// The joint.
        joint: usize,
    },
    /// Some corner has moved by the stated share of the span.
    Moved,
    /// The arch has come to rest: a new equilibrium, or the old one.
    AtRest,
    /// Two that are no neighbours touch (none: the ground beside a springing joint); what follows is not modelled.
    StonesMeet {
        /// The two.
        voussoirs: [Option<usize>; 2],
    },
    /// As many steps were made as were allowed.
    StepLimit,
    /// No further step was found: the motion up to here holds, what follows cannot be told.
    Lost,
}

/// A motion at constant loads.
#[derive(Debug, Clone, PartialEq)]
pub struct FallingMotion {
    /// How it ended.
    pub end: MotionEnd,
    /// Load factor of the loads, a little beyond the one at collapse.
    pub load_factor: f64,
    /// By how much it is beyond the one at collapse.
    pub overload: f64,
    /// Span that displacements are measured in, m.
    pub span: f64,
    /// Thickness of the thinnest joint, m.
    pub thickness: f64,
    /// The arch as built, and after every step.
    pub frames: Vec<MotionFrame>,
}

/// The arch in one moment of a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionFrame {
    /// Time-like parameter, s2: a stone that nothing holds falls by g times it.
    pub parameter: f64,
    /// Place of every voussoir's centroid, m (of the stone between straight sides).
    pub centroids: Vec<Vec2>,
    /// Rotation of every voussoir since the start, counter-clockwise, rad.
    pub rotations: Vec<f64>,
    /// Where stones touch.
    pub contacts: Vec<MotionContact>,
    /// Joints that touch at one end only.
    pub hinges: Vec<OpenHinge>,
    /// Joints that have slid.
    pub slides: Vec<Slid>,
    /// Largest displacement of a corner since the start, m.
    pub displacement: f64,
    /// Largest overlap of two stones, share of the thickness.
    pub penetration: f64,
    /// Largest residual of equilibrium of any stone in the step to here, share of the loads.
    pub residual: f64,
    /// Friction beyond Coulomb's bound in that step, share of the loads.
    pub excess: f64,
    /// Work of the loads in that step, N.
    pub work: f64,
}

/// A point at which stones touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionContact {
    /// Joint number.
    pub joint: usize,
    /// Where, m.
    pub at: Vec2,
    /// Unit normal, into the stone after the joint.
    pub direction: Vec2,
    /// Normal force, compression positive, N/m.
    pub normal: f64,
    /// Tangential force on the stone after the joint, towards the extrados positive, N/m.
    pub tangential: f64,
    /// Gap, m.
    pub gap: f64,
}

/// A joint that touches at one end only.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OpenHinge {
    /// Joint number.
    pub joint: usize,
    /// Face at which it touches.
    pub face: Face,
    /// Angle between its two sides, rad.
    pub opening: f64,
}

/// A joint that has slid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slid {
    /// Joint number.
    pub joint: usize,
    /// How far the stone after it has slid towards the extrados, m.
    pub by: f64,
}
