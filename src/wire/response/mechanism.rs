//! Ends of what a structure bears: where they are, what governs, and how it falls there.

use super::Scale;
use super::columns::{ThrustColumns, VelocityColumns, column};
use super::falling::MotionBody;
use super::width::ScaledLoadBody;
use crate::collapse::{
    CrushedJoint, End, Face, GovernedBy, Hinge, LiftOff, LoadRange, Mechanism, Mode, PathEnd, Slide, WhichEnd,
};
use serde::Serialize;
use utoipa::ToSchema;

/// One end of what the structure bears.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct EndBody {
    /// Which end of the load factors it is.
    pub which: WhichEnd,
    /// The intensity that governs: `load_factor` times the request's intensity per unit of it; where joints slide, the least of
    /// `range`.
    pub intensity: f64,
    /// Its unit.
    pub unit: String,
    /// `intensity` as a load factor.
    pub load_factor: f64,
    /// With `partial_factors`: by how much the factored scaled loads may be multiplied. 1 and more is enough. It is `load_factor` or,
    /// where that is lower, the load factor on moving geometry; in a safety analysis the governing one. Left out without
    /// `partial_factors`, where it cannot be told, and of a structure that needs its scaled loads to stand.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub adequacy_factor: Option<f64>,
    /// What governs. All that follows but the two figures is of that state.
    pub governed_by: GovernedBy,
    /// Where stone that does not crush falls; null where it does not up to `cap`, and where `crushing_in_path` is set and joints
    /// crush.
    pub instability: Option<FigureBody>,
    /// Where joints of the stone's strength give way: by limit analysis (plastic sections) or, where joints slide, too, on the load path
    /// on which they crush, whichever is lower; null where that was not computed or has no end. It governs where it comes first, but not
    /// by fixed steps.
    pub crushing: Option<FigureBody>,
    /// Range in which the intensity may lie, as joints slide; null where none does, and where limit analysis says that crushing governs.
    pub range: Option<RangeBody>,
    /// Largest equilibrium residual of any body, at any event of the load path where it was traced, and of the forces at its end, as a
    /// share of the structure's weight, or of the largest load at a point where that is more; where crushing governs, of its forces
    /// alone, as a share of the loads that stay or, where these are more, that grow.
    pub residual: f64,
    /// What the scaled loads come to there, with their partial factor.
    pub scaled_load: ScaledLoadBody,
    /// How it falls.
    #[serde(flatten)]
    pub fall: FallBody,
    /// Joints that crush, in their order.
    pub crushed_joints: Vec<CrushedJointBody>,
    /// Where crushing governs: how it would fall at `instability` if its stone did not crush.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub without_crushing: Option<FallBody>,
    /// How it moves on from `instability`, where `motion` asks for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motion: Option<MotionBody>,
}

/// An intensity, also as a load factor.
#[derive(Debug, Clone, Copy, Serialize, ToSchema)]
pub struct FigureBody {
    /// Intensity.
    pub intensity: f64,
    /// Load factor.
    pub load_factor: f64,
}

/// How a structure falls, and what its joints carry there.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct FallBody {
    /// What moves.
    #[serde(flatten)]
    pub mechanism: MechanismBody,
    /// Resultant of every joint.
    pub thrust_line: ThrustColumns,
    /// Force of every one of `structure.passive_elements`, N/m; empty where the load path was left before.
    pub passive_n_per_m: Vec<f64>,
    /// Velocity of every body.
    pub velocities: VelocityColumns,
}

/// The joints at which a structure moves, each list in the order of the joints.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct MechanismBody {
    /// How the structure moves.
    pub mode: Mode,
    /// Hinges.
    pub hinges: Vec<HingeBody>,
    /// Sliding joints.
    pub slides: Vec<SlideBody>,
    /// Joints that part altogether.
    pub lift_offs: Vec<LiftOffBody>,
}

/// It is seen from the start of the load path. Joints that slide without dilating have many loads at which a mechanism is in
/// equilibrium; stiffness of the joints and order of loading pick one.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct RangeBody {
    /// Least intensity found at which a mechanism without dilation is in equilibrium; where crushing governs, that at which the load path
    /// ends on which joints crush. It governs.
    pub least: f64,
    /// End of the limit window, in which sliding joints dilate (associated friction): no more is possible; where joints crush first,
    /// no more than `crushing`. Null where unbounded.
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
    /// Position: angle between the joint's middle and that of the nearer springing joint of its span, seen from the point midway
    /// between the middles of both springing joints, which in general is not the centre of a curve; null of a joint of no span.
    pub angle_from_springing_deg: Option<f64>,
    /// Position: the same seen from the vertical through the point that `angle_from_springing_deg` names, negative on the left; null of
    /// a joint of no span.
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

impl EndBody {
    pub(super) fn new(end: &End<'_>, scaled_load: ScaledLoadBody, scale: &Scale<'_>) -> Self {
        let figure = |load_factor| FigureBody { intensity: scale.intensity(load_factor), load_factor };
        let state = end.state;
        EndBody {
            which: end.which,
            intensity: scale.intensity(state.load_factor),
            unit: scale.unit.to_owned(),
            load_factor: state.load_factor,
            adequacy_factor: None,
            governed_by: end.governed_by,
            instability: end.uncrushed.map(|path| figure(path.load_factor)),
            crushing: end.crushing.map(figure),
            range: state.range.as_ref().map(|range| RangeBody::new(range, scale)),
            residual: state.residual,
            scaled_load: scaled_load.times(state.load_factor),
            fall: state.into(),
            crushed_joints: column(&state.crushed, Into::into),
            without_crushing: end.uncrushed.filter(|_| end.governed_by == GovernedBy::Crushing).map(Into::into),
            motion: end.motion.map(|motion| MotionBody::new(motion, scale)),
        }
    }
}

impl From<&PathEnd> for FallBody {
    fn from(end: &PathEnd) -> Self {
        FallBody {
            mechanism: (&end.mechanism).into(),
            thrust_line: ThrustColumns::new(&end.thrust_line),
            passive_n_per_m: end.soil.clone(),
            velocities: VelocityColumns::new(&end.mechanism.velocities),
        }
    }
}

impl From<&Mechanism> for MechanismBody {
    fn from(mechanism: &Mechanism) -> Self {
        MechanismBody {
            mode: mechanism.mode,
            hinges: column(&mechanism.hinges, Into::into),
            slides: column(&mechanism.slides, Into::into),
            lift_offs: column(&mechanism.lift_offs, Into::into),
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
