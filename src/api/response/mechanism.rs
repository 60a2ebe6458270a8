//! One end of the load path: where it ends and how the arch falls there.

use super::Scale;
use super::columns::{ThrustColumns, VelocityColumns};
use super::words::GovernedBy;
use crate::collapse::{CrushedJoint, Face, Hinge, LiftOff, LimitWindow, LoadRange, Mode, PathEnd, Slide};
use serde::Serialize;
use utoipa::ToSchema;

/// Where the load path ends, and in which way.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct Collapse {
    /// Collapse intensity: `load_factor` times the request's intensity per unit of it; where joints slide, the least of `range`.
    pub intensity: f64,
    /// Its unit.
    pub unit: String,
    /// Load factor at collapse.
    pub load_factor: f64,
    /// Range in which the collapse intensity may lie, as joints slide; null where none does.
    pub range: Option<RangeBody>,
    /// Largest equilibrium residual of any stone at any event, as a share of the arch's weight, or of the
    /// largest load at a point where that is more.
    pub residual: f64,
    /// Lowest and highest intensity of the static theorem, null where unbounded; null where nothing stands.
    pub limit_window: Option<[Option<f64>; 2]>,
    /// How the structure moves.
    pub mode: Mode,
    /// What ends the load path.
    pub governed_by: GovernedBy,
}

/// It is seen from the start of the load path. Joints that slide without dilating have many loads at which a mechanism is in equilibrium; stiffness of the joints and
/// order of loading pick one.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct RangeBody {
    /// Least intensity found at which a mechanism without dilation is in equilibrium. It governs.
    pub least: f64,
    /// End of the limit window, in which sliding joints dilate (associated friction): no more is possible. Null where unbounded.
    pub greatest: Option<f64>,
    /// Intensity at which this load path ended.
    pub path: f64,
    /// `least` as a load factor.
    pub least_load_factor: f64,
    /// `greatest` as a load factor.
    pub greatest_load_factor: Option<f64>,
    /// `path` as a load factor.
    pub path_load_factor: f64,
    /// How many mechanisms were tried for the least.
    pub mechanisms_tried: usize,
}

/// A joint that stays pressed at one face and opens at the other.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct HingeBody {
    /// Joint number: of an arch from 0 at the left springing, else the place in `structure.joints`.
    pub joint: usize,
    /// Face at which the joint stays pressed: the axis of rotation.
    pub face: Face,
    /// Face at which it opens.
    pub opens: Face,
    /// The point that it turns about, [x, y]: the joint's end on `face`, or that of the block that is crushed there.
    pub at_m: [f64; 2],
    /// Position: angle from the nearer springing, about the angle centre of its span; null of a joint of no span.
    pub angle_from_springing_deg: Option<f64>,
    /// Position: angle from the crown of its span, negative on the left; null of a joint of no span.
    pub angle_from_crown_deg: Option<f64>,
    /// Relative rotation rate in the mechanism; the largest of all hinges is 1.
    pub rotation: f64,
}

/// A joint that slides in the mechanism.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct SlideBody {
    /// Joint number: of an arch from 0 at the left springing, else the place in `structure.joints`.
    pub joint: usize,
    /// The joint's middle, [x, y].
    pub at_m: [f64; 2],
    /// Rate at which the stone after the joint slides towards the extrados, in the mechanism's scale: metres per radian of
    /// the largest hinge rotation; where no hinge turns, the largest slide is 1.
    pub rate: f64,
}

/// A joint that parts at both faces in the mechanism: it carries no force, and no point of it stays pressed.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct LiftOffBody {
    /// Joint number: of an arch from 0 at the left springing, else the place in `structure.joints`.
    pub joint: usize,
    /// The joint's middle, [x, y].
    pub at_m: [f64; 2],
    /// Rate at which its end on the intrados opens (negative: closes), in the mechanism's scale: metres per radian of the
    /// largest hinge rotation; where no hinge turns, the largest slide is 1, and where nothing slides either, the largest
    /// opening.
    pub intrados: f64,
    /// Rate at which its end on the extrados opens (negative: closes), in the same scale.
    pub extrados: f64,
}

/// A joint that carries its strength over a block of its length at one face.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct CrushedJointBody {
    /// Joint number: of an arch from 0 at the left springing, else the place in `structure.joints`.
    pub joint: usize,
    /// The face that is crushed.
    pub face: Face,
    /// The joint's end there, [x, y].
    pub at_m: [f64; 2],
    /// Length of the block: the normal force over the strength.
    pub length_m: f64,
}

impl From<&CrushedJoint> for CrushedJointBody {
    fn from(crushed: &CrushedJoint) -> Self {
        let CrushedJoint { joint, face, at, length } = *crushed;
        CrushedJointBody { joint, face, at_m: [at.x, at.y], length_m: length }
    }
}

/// A collapse with its mechanism.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct EndBody {
    /// Where it is, and how.
    #[serde(flatten)]
    pub collapse: Collapse,
    /// Hinges from left to right.
    pub hinges: Vec<HingeBody>,
    /// Sliding joints from left to right.
    pub slides: Vec<SlideBody>,
    /// Joints that part altogether, from left to right.
    pub lift_offs: Vec<LiftOffBody>,
    /// Joints that crush, from left to right, where `crushing_in_path` is set.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub crushed_joints: Vec<CrushedJointBody>,
    /// Resultant of every joint.
    pub thrust_line: ThrustColumns,
    /// Velocity of every body.
    pub velocities: VelocityColumns,
}

impl EndBody {
    pub(super) fn new(end: &PathEnd, window: Option<LimitWindow>, scale: &Scale<'_>) -> Self {
        EndBody {
            collapse: Collapse {
                intensity: scale.intensity(end.load_factor),
                unit: scale.unit.to_owned(),
                load_factor: end.load_factor,
                range: end.range.as_ref().map(|range| RangeBody::new(range, scale)),
                residual: end.residual,
                limit_window: window.map(|window| scale.window(window)),
                mode: end.mechanism.mode,
                governed_by: if end.crushed.is_empty() { GovernedBy::Instability } else { GovernedBy::Crushing },
            },
            hinges: end.mechanism.hinges.iter().map(HingeBody::from).collect(),
            slides: end.mechanism.slides.iter().map(SlideBody::from).collect(),
            lift_offs: end.mechanism.lift_offs.iter().map(LiftOffBody::from).collect(),
            crushed_joints: end.crushed.iter().map(CrushedJointBody::from).collect(),
            thrust_line: ThrustColumns::new(&end.thrust_line),
            velocities: VelocityColumns::new(&end.mechanism.velocities),
        }
    }
}

impl RangeBody {
    fn new(range: &LoadRange, scale: &Scale<'_>) -> Self {
        let greatest = Some(range.greatest).filter(|greatest| !greatest.is_infinite());
        RangeBody {
            least: scale.intensity(range.least),
            greatest: greatest.map(|greatest| scale.intensity(greatest)),
            path: scale.intensity(range.path),
            least_load_factor: range.least,
            greatest_load_factor: greatest,
            path_load_factor: range.path,
            mechanisms_tried: range.mechanisms_tried,
        }
    }
}

impl From<&Hinge> for HingeBody {
    fn from(hinge: &Hinge) -> Self {
        let face = hinge.face;
        HingeBody {
            joint: hinge.joint,
            face,
            at_m: hinge.at.into(),
            opens: face.other(),
            angle_from_springing_deg: hinge.angle_from_springing.map(f64::to_degrees),
            angle_from_crown_deg: hinge.angle_from_crown.map(f64::to_degrees),
            rotation: hinge.rotation,
        }
    }
}

impl From<&LiftOff> for LiftOffBody {
    fn from(lift_off: &LiftOff) -> Self {
        let &LiftOff { joint, at, intrados, extrados, along: _ } = lift_off;
        LiftOffBody { joint, at_m: at.into(), intrados, extrados }
    }
}

impl From<&Slide> for SlideBody {
    fn from(slide: &Slide) -> Self {
        SlideBody { joint: slide.joint, at_m: slide.at.into(), rate: slide.rate }
    }
}
