//! Motion after collapse, frame by frame.

use super::Scale;
use super::columns::column;
use crate::collapse::{Face, FallingMotion, MotionContact, MotionEnd, MotionFrame, OpenHinge, Slid};
use serde::Serialize;
use utoipa::ToSchema;

/// Motion after collapse: rigid stones (sides along intrados and extrados straight) under constant loads, without inertia: a
/// resistance in proportion to mass balances what loads and contact forces leave. Stones that are bonded move as one. Frames are
/// numbered from 0, the structure as built.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct MotionBody {
    /// How the motion ended.
    pub end: MotionEnd,
    /// How the motion ended, as a sentence.
    pub why: String,
    /// Stones that touch nothing in the last frame.
    pub free_stones: Vec<usize>,
    /// Load factor during the motion, which is constant.
    pub load_factor: f64,
    /// `load_factor` as an intensity.
    pub intensity: f64,
    /// By how much the load factor is beyond that of collapse.
    pub overload: f64,
    /// What displacements are compared with: the longest span; of blocks the longer side of the box around them.
    pub span_m: f64,
    /// Scale of lengths: of the longest joint of every stone the shortest.
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
    /// Parameter of the motion, which is no time: a stone that nothing holds falls by g times it.
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

/// One array of stones, in the order of the structure, a frame.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct PlaceColumns {
    /// Centroid of the stone between straight sides, to the right.
    pub x_m: Vec<Vec<f64>>,
    /// Centroid of the stone between straight sides, upwards.
    pub y_m: Vec<Vec<f64>>,
    /// Rotation since the start, counter-clockwise.
    pub rotation_rad: Vec<Vec<f64>>,
}

/// One row a point at which stones touch.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct MotionContactColumns {
    /// Number of the frame.
    pub frame: Vec<usize>,
    /// The first stone; null is the ground.
    pub first: Vec<Option<usize>>,
    /// The second stone; null is the ground.
    pub second: Vec<Option<usize>>,
    /// Joint number; null where there was no joint between them.
    pub joint: Vec<Option<usize>>,
    /// Where, to the right.
    pub x_m: Vec<f64>,
    /// Where, upwards.
    pub y_m: Vec<f64>,
    /// Unit normal into the second stone, to the right.
    pub normal_x: Vec<f64>,
    /// Unit normal into the second stone, upwards.
    pub normal_y: Vec<f64>,
    /// Normal force in the step to this frame, compression positive; 0 in the first frame.
    pub normal_n_per_m: Vec<f64>,
    /// Tangential force on the second, positive to the left of the normal, towards the extrados of an arch; 0 in the first
    /// frame.
    pub tangential_n_per_m: Vec<f64>,
    /// Gap, positive when open.
    pub gap_m: Vec<f64>,
}

/// One row a hinge.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct OpenHingeColumns {
    /// Number of the frame.
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
    /// Number of the frame.
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
        MotionBody {
            end: motion.end,
            why: why(motion),
            free_stones: free(motion),
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

/// Stones that touch nothing in the last frame.
fn free(motion: &FallingMotion) -> Vec<usize> {
    let Some(last) = motion.frames.last() else { return Vec::new() };
    let touches = |k: usize| last.contacts.iter().any(|contact| contact.bodies.contains(&Some(k)));
    (0..last.centroids.len()).filter(|&k| !touches(k)).collect()
}

/// Why the motion ended, for people.
fn why(motion: &FallingMotion) -> String {
    let last = motion.frames.last();
    let share = last.map_or(0.0, |frame| 100.0 * frame.displacement / motion.span);
    match motion.end {
        MotionEnd::Moved => format!("Some corner has moved by {share:.1} % of the span."),
        MotionEnd::AtRest => format!("The stones are in equilibrium after {share:.1} % of the span."),
        MotionEnd::StepLimit => format!("The frames asked for are used up, after {share:.1} % of the span."),
        MotionEnd::Lost => "No further step was found: what follows cannot be told.".to_owned(),
    }
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
            first: column(rows, |row| row.1.bodies[0]),
            second: column(rows, |row| row.1.bodies[1]),
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
