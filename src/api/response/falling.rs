//! Motion after collapse, frame by frame.

use super::Scale;
use super::columns::column;
use crate::collapse::{Face, FallingMotion, MotionContact, MotionEnd, MotionFrame, OpenHinge, Slid};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// How a motion ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum MotionEndWord {
    /// A joint has opened through: the stone is clear of its neighbour or of the ground by 2 % of the thickness.
    StoneFree,
    /// Some corner has moved by the stated share of the span.
    Moved,
    /// Nothing moves any more: the stones have found an equilibrium.
    AtRest,
    /// Two stones that are no neighbours, or a stone and the ground, touch; what follows is not modelled.
    StonesMeet,
    /// The frames asked for are used up.
    StepLimit,
    /// No further step was found.
    Lost,
}

/// Motion after collapse: rigid stones (sides along intrados and extrados straight) under constant loads, without inertia,
/// as in a thick fluid. Frames are numbered from 0, the arch as built.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct MotionBody {
    /// How it ended.
    pub end: MotionEndWord,
    /// The same as a sentence.
    pub why: String,
    /// The stone that is free, or the stones that meet; one that meets the ground stands alone.
    pub voussoirs: Vec<usize>,
    /// The joint that has opened through.
    pub joint: Option<usize>,
    /// Load factor of the loads during the motion.
    pub load_factor: f64,
    /// The same as an intensity.
    pub intensity: f64,
    /// By how much the load factor is beyond that of collapse.
    pub overload: f64,
    /// The span that displacements are compared with.
    pub span_m: f64,
    /// Length of the shortest joint.
    pub thickness_m: f64,
    /// Every frame.
    pub frames: FrameColumns,
    /// Every stone in every frame.
    pub places: PlaceColumns,
    /// Every point at which stones touch.
    pub contacts: MotionContactColumns,
    /// Joints that touch at one end only.
    pub hinges: OpenHingeColumns,
    /// Joints that have slid.
    pub slides: SlidColumns,
}

/// One row a frame.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct FrameColumns {
    /// Time-like parameter: a stone that nothing holds falls by g times it.
    pub parameter_s2: Vec<f64>,
    /// Largest displacement of a corner since the start.
    pub largest_displacement_m: Vec<f64>,
    /// Largest overlap of two stones, as a share of `thickness_m`.
    pub penetration: Vec<f64>,
    /// Largest residual of equilibrium of any stone in the step to this frame, as a share of the loads.
    pub residual: Vec<f64>,
    /// Friction beyond Coulomb's bound in the step to this frame, as a share of the loads.
    pub friction_excess: Vec<f64>,
    /// Work of the loads in the step to this frame.
    pub work_j_per_m: Vec<f64>,
}

/// One array of stones, left to right, a frame.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct PlaceColumns {
    /// Centroid of the stone between straight sides.
    pub x_m: Vec<Vec<f64>>,
    /// Centroid of the stone between straight sides.
    pub y_m: Vec<Vec<f64>>,
    /// Rotation since the start, counter-clockwise.
    pub rotation_rad: Vec<Vec<f64>>,
}

/// One row a point at which stones touch.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct MotionContactColumns {
    /// Frame.
    pub frame: Vec<usize>,
    /// Joint number.
    pub joint: Vec<usize>,
    /// Where.
    pub x_m: Vec<f64>,
    /// Where.
    pub y_m: Vec<f64>,
    /// Unit normal, into the stone after the joint.
    pub normal_x: Vec<f64>,
    /// Unit normal, into the stone after the joint.
    pub normal_y: Vec<f64>,
    /// Normal force in the step to this frame, compression positive; 0 in the first frame.
    pub normal_n_per_m: Vec<f64>,
    /// Tangential force on the stone after the joint, towards the extrados positive; 0 in the first frame.
    pub tangential_n_per_m: Vec<f64>,
    /// Gap, positive when open.
    pub gap_m: Vec<f64>,
}

/// One row a hinge.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct OpenHingeColumns {
    /// Frame.
    pub frame: Vec<usize>,
    /// Joint number.
    pub joint: Vec<usize>,
    /// Face at which the joint touches.
    pub face: Vec<Face>,
    /// Angle between its two sides.
    pub opening_rad: Vec<f64>,
}

/// One row a joint that has slid.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct SlidColumns {
    /// Frame.
    pub frame: Vec<usize>,
    /// Joint number.
    pub joint: Vec<usize>,
    /// How far the stone after it has slid towards the extrados.
    pub by_m: Vec<f64>,
}

/// Rows of all frames, each with its frame's number.
fn rows<'a, T>(frames: &'a [MotionFrame], of: impl Fn(&'a MotionFrame) -> &'a [T]) -> Vec<(usize, &'a T)> {
    frames.iter().enumerate().flat_map(|(number, frame)| of(frame).iter().map(move |row| (number, row))).collect()
}

impl MotionBody {
    pub(super) fn new(motion: &FallingMotion, scale: &Scale<'_>) -> Self {
        let frames = &motion.frames;
        let (end, voussoirs, joint) = match motion.end {
            MotionEnd::StoneFree { voussoir, joint } => (MotionEndWord::StoneFree, vec![voussoir], Some(joint)),
            MotionEnd::Moved => (MotionEndWord::Moved, vec![], None),
            MotionEnd::AtRest => (MotionEndWord::AtRest, vec![], None),
            MotionEnd::StonesMeet { voussoirs } => {
                (MotionEndWord::StonesMeet, voussoirs.into_iter().flatten().collect(), None)
            }
            MotionEnd::StepLimit => (MotionEndWord::StepLimit, vec![], None),
            MotionEnd::Lost => (MotionEndWord::Lost, vec![], None),
        };
        MotionBody {
            end,
            why: why(motion),
            voussoirs,
            joint,
            load_factor: motion.load_factor,
            intensity: scale.intensity(motion.load_factor),
            overload: motion.overload,
            span_m: motion.span,
            thickness_m: motion.thickness,
            frames: FrameColumns::new(frames),
            places: PlaceColumns {
                x_m: column(frames, |frame| column(&frame.centroids, |at| at.x)),
                y_m: column(frames, |frame| column(&frame.centroids, |at| at.y)),
                rotation_rad: column(frames, |frame| frame.rotations.clone()),
            },
            contacts: MotionContactColumns::new(&rows(frames, |frame| &frame.contacts)),
            hinges: OpenHingeColumns::new(&rows(frames, |frame| &frame.hinges)),
            slides: SlidColumns::new(&rows(frames, |frame| &frame.slides)),
        }
    }
}

/// Why the motion ended, for people.
fn why(motion: &FallingMotion) -> String {
    let last = motion.frames.last();
    let share = last.map_or(0.0, |frame| 100.0 * frame.displacement / motion.span);
    let stone = |voussoir: Option<usize>| voussoir.map_or("the ground".to_owned(), |k| format!("voussoir {k}"));
    match motion.end {
        MotionEnd::StoneFree { voussoir, joint } => {
            format!("Joint {joint} has opened through: voussoir {voussoir} is clear of what it rested on.")
        }
        MotionEnd::Moved => format!("The arch has moved by {share:.1} % of its span."),
        MotionEnd::AtRest => format!("The stones are in equilibrium after {share:.1} % of the span."),
        MotionEnd::StonesMeet { voussoirs: [a, b] } => {
            format!("{} touches {}, which is no neighbour of it.", capital(&stone(a.or(b))), stone(a.and(b)))
        }
        MotionEnd::StepLimit => format!("The frames asked for are used up, after {share:.1} % of the span."),
        MotionEnd::Lost => "No further step was found: what follows cannot be told.".to_owned(),
    }
}

fn capital(words: &str) -> String {
    words.chars().take(1).flat_map(char::to_uppercase).chain(words.chars().skip(1)).collect()
}

impl FrameColumns {
    fn new(frames: &[MotionFrame]) -> Self {
        FrameColumns {
            parameter_s2: column(frames, |frame| frame.parameter),
            largest_displacement_m: column(frames, |frame| frame.displacement),
            penetration: column(frames, |frame| frame.penetration),
            residual: column(frames, |frame| frame.residual),
            friction_excess: column(frames, |frame| frame.excess),
            work_j_per_m: column(frames, |frame| frame.work),
        }
    }
}

impl MotionContactColumns {
    fn new(rows: &[(usize, &MotionContact)]) -> Self {
        MotionContactColumns {
            frame: column(rows, |row| row.0),
            joint: column(rows, |row| row.1.joint),
            x_m: column(rows, |row| row.1.at.x),
            y_m: column(rows, |row| row.1.at.y),
            normal_x: column(rows, |row| row.1.direction.x),
            normal_y: column(rows, |row| row.1.direction.y),
            normal_n_per_m: column(rows, |row| row.1.normal),
            tangential_n_per_m: column(rows, |row| row.1.tangential),
            gap_m: column(rows, |row| row.1.gap),
        }
    }
}

impl OpenHingeColumns {
    fn new(rows: &[(usize, &OpenHinge)]) -> Self {
        OpenHingeColumns {
            frame: column(rows, |row| row.0),
            joint: column(rows, |row| row.1.joint),
            face: column(rows, |row| row.1.face),
            opening_rad: column(rows, |row| row.1.opening),
        }
    }
}

impl SlidColumns {
    fn new(rows: &[(usize, &Slid)]) -> Self {
        SlidColumns {
            frame: column(rows, |row| row.0),
            joint: column(rows, |row| row.1.joint),
            by_m: column(rows, |row| row.1.by),
        }
    }
}
