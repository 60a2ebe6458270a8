//! How a structure moves on after it has begun to fall.

use crate::geometry::Vec2;
use crate::structure::Face;

/// How a motion ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "server", derive(serde::Serialize, serde::Deserialize, utoipa::ToSchema))]
#[cfg_attr(feature = "server", serde(rename_all = "snake_case"))]
pub enum MotionEnd {
    /// Some corner has moved by the stated share of the span.
    Moved,
    /// All has come to rest: a new equilibrium, or the old one.
    AtRest,
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
    /// Span that displacements are measured in, m: the longest; of blocks the longer side of the box around them.
    pub span: f64,
    /// Scale of lengths, m: of the longest joint of every stone the shortest.
    pub thickness: f64,
    /// The structure as built, and after every step.
    pub frames: Vec<MotionFrame>,
}

/// The structure in one moment of a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionFrame {
    /// Time-like parameter, s2: a stone that nothing holds falls by g times it.
    pub parameter: f64,
    /// Place of every stone's centroid, m (of the stone between straight sides).
    pub centroids: Vec<Vec2>,
    /// Rotation of every stone since the start, counter-clockwise, rad.
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
    /// The stones; none is the ground.
    pub bodies: [Option<usize>; 2],
    /// Joint number; none where there was no joint between them.
    pub joint: Option<usize>,
    /// Where, m.
    pub at: Vec2,
    /// Unit normal, into the second.
    pub direction: Vec2,
    /// Normal force, compression positive, N/m.
    pub normal: f64,
    /// Tangential force on the second, positive to the left of the normal (towards the extrados of an arch), N/m.
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
