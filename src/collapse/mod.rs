//! Incremental limit analysis: what grows, how far, and what happens then.

mod beam;
mod certificate;
mod chain_path;
pub mod cost;
mod cracks;
mod crushed;
mod discretise;
mod ending;
mod falling;
mod far;
mod farthest;
mod geometric;
mod grid;
mod mechanism;
mod mirror;
mod model;
mod motion;
mod narrow;
mod near_point;
mod path;
mod plan;
mod plastic_end;
mod position;
mod record;
mod recovery;
pub mod report;
mod rigid_parts;
mod rounding;
mod safety;
mod scatter;
mod settlement;
mod sliding;
mod smallest_motion;
mod snapshot;
mod state;
mod strips;
mod survey;
mod survey_tolerance;
mod tally;
mod task;
mod tolerances;
mod uniqueness;
mod updated;
mod verdict;
mod worst_position;
mod yielding;

pub use grid::{can_be_cut, can_bend, subblocks_of};
pub use model::*;
pub use plan::{LOAD_PIECES, can_be_refined};
pub use position::*;
pub use report::*;
pub use survey::*;
pub use task::*;

use crate::budget::{Budget, Stopped};
use crate::dda::Unbuilt;
use crate::geometry::Vec2;
use crate::structure::{PointForce, Stone, Structure};
use discretise::Discretisation;

/// Which way the load factor goes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "server", derive(serde::Serialize, serde::Deserialize, utoipa::ToSchema))]
#[cfg_attr(feature = "server", serde(rename_all = "snake_case"))]
pub enum Direction {
    /// From 0 upwards.
    #[default]
    Increase,
    /// From 0 downwards.
    Decrease,
}

/// Whether equilibrium is that of the arch as built, or of the arch where its loads have moved it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "server", derive(serde::Serialize, serde::Deserialize, utoipa::ToSchema))]
#[cfg_attr(feature = "server", serde(rename_all = "snake_case"))]
pub enum Geometry {
    /// As built: first order, what limit analysis certifies.
    #[default]
    FirstOrder,
    /// Both: besides, the load path is followed on the arch as it moves, with finite rotations. That depends on Young's
    /// modulus and the penalty.
    Updated,
}

/// Where one support ends up, seen from where it was built.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SupportMovement {
    /// Which support.
    pub support: usize,
    /// The point that it turns about, m.
    pub about: Vec2,
    /// Displacement of that point, m.
    pub by: Vec2,
    /// Rotation, counter-clockwise positive, rad.
    pub rotation: f64,
}

/// When stone is taken to crush.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "server", derive(serde::Serialize, serde::Deserialize, utoipa::ToSchema))]
#[cfg_attr(feature = "server", serde(rename_all = "snake_case"))]
pub enum CrushingKind {
    /// The equivalent stress of Tresca reaches the strength in some subblock, as in the paper. Depends on the mesh.
    Elastic,
    /// A joint would have to carry its normal force N so far off its middle that less than N / strength of its length
    /// is left, and no other equilibrium avoids it. Does not depend on the mesh.
    #[default]
    PlasticSection,
}

/// Where on the path a stress field is reported.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FieldAt {
    /// At this load factor.
    LoadFactor(f64),
    /// At `share` of the way to collapse.
    NearCollapse,
}

/// How accurate an answer has to be. The model is then the least that is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accuracy {
    /// Largest error of the collapse load factor, as a share of it.
    pub collapse_intensity: Option<f64>,
    /// Largest error of the stress fields asked for, as a share: the root mean square, by area, of all components of the stress, point
    /// by point. Loads have to come in [`LOAD_PIECES`], and no stone may have a side of more than one arc.
    pub stress: Option<f64>,
    /// Most subblocks of the model.
    pub most_subblocks: usize,
}

/// How far a structure is followed after it has begun to fall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionAsked {
    /// Most steps, each of them a frame of the answer.
    pub most_frames: usize,
    /// Until some corner has moved by this share of the span.
    pub share_of_span: f64,
    /// Height at which level ground lies below all stones, m. Without it there is none but what the structure stands on, and
    /// what falls past that falls on.
    pub ground_level: Option<f64>,
}

/// One point of a safety curve.
#[derive(Debug, Clone, PartialEq)]
pub struct CurvePoint {
    /// What it is drawn over, such as the thickness of an embankment; in the request's own unit.
    pub abscissa: f64,
    /// The safety analysis there.
    pub analysis: Analysis,
}

/// What is asked of the mechanics.
#[derive(Debug, Clone, PartialEq)]
pub enum Question {
    /// One analysis.
    One(Box<Analysis>),
    /// Safety factors over a list of abscissae.
    Curve(Vec<CurvePoint>),
    /// The worst position of vehicles, and an analysis there.
    WorstPosition(Box<PositionQuestion>),
    /// An analysis of a surveyed structure, and how its load factor moves with the points.
    SurveyTolerance(Box<SurveyQuestion>),
    /// The curved beam of section 3.3 of the paper.
    CurvedBeam(CurvedBeam),
}

/// What the mechanics say.
#[derive(Debug, Clone, PartialEq)]
pub enum Answer {
    /// Of one analysis, such as that at the worst position.
    One(Box<CollapseReport>),
    /// Safety factors, one per abscissa.
    Curve(Vec<SafetyPoint>),
    /// Of the curved beam.
    CurvedBeam(BeamReport),
}

/// One question to the mechanics, in SI units and radians: a structure under loads, how it is modelled, and what is asked.
#[derive(Debug, Clone, PartialEq)]
pub struct Analysis {
    /// The structure, with its stones.
    pub structure: Structure,
    /// Loads that stay.
    pub fixed: Vec<PointForce>,
    /// Loads that the load factor multiplies.
    pub scaled: Vec<PointForce>,
    /// Plane stress or plane strain.
    pub plane: PlaneModel,
    /// Contact penalty as a multiple of Young's modulus (per metre of width and contact point).
    pub penalty_ratio: f64,
    /// Tangential contact penalty as a multiple of the normal one.
    pub shear_penalty_ratio: f64,
    /// How the voussoirs are cut into subblocks; how many, where an [`Accuracy`] does not find out.
    pub mesh: Mesh,
    /// What is wanted.
    pub task: Task,
}

impl Analysis {
    /// The collapse of a structure of rigid stones under loads that stay and loads that grow, modelled as in the paper.
    pub fn new(structure: Structure, fixed: Vec<PointForce>, scaled: Vec<PointForce>) -> Self {
        let subblocks = vec![[1, 1]; structure.voussoirs().len()];
        Analysis {
            structure,
            fixed,
            scaled,
            plane: PlaneModel::Stress,
            penalty_ratio: DEFAULT_PENALTY_RATIO,
            shear_penalty_ratio: 1.0,
            mesh: Mesh::of(subblocks),
            task: Task::Collapse(CollapseTask::default()),
        }
    }
}

/// The curved beam of section 3.3 of the paper: a quarter ring in bending by end shear, cut into subblocks.
#[derive(Debug, Clone, PartialEq)]
pub struct CurvedBeam {
    /// Inner radius a, m.
    pub inner_radius: f64,
    /// Outer radius b, m.
    pub outer_radius: f64,
    /// Resultant P of the end tractions, N/m.
    pub shear: f64,
    /// Its stone: Young's modulus and Poisson's ratio count.
    pub stone: Stone,
    /// Plane stress or plane strain.
    pub plane: PlaneModel,
    /// Subblocks in radial and circumferential direction; where `accuracy` does not find out.
    pub subblocks: [usize; 2],
    /// Largest error, as a share, if that decides on the mesh: both e_N of eq. (5) and that of all components, point by point.
    pub accuracy: Option<f64>,
    /// What holds them together, where they are of first order.
    pub seams: Seams,
    /// How displacements vary in them.
    pub order: Order,
    /// Where their lines lie.
    pub spacing: Spacing,
    /// True sectors, or subblocks with straight sides.
    pub curved_sides: bool,
}

/// Why there is no report.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum AnalysisError {
    /// The budget is spent.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// The fixed step is so small that the path cannot be walked in it.
    #[error("the load path has more than {most} of the fixed steps asked for; take a larger step")]
    TooManySteps {
        /// Most steps of one path.
        most: usize,
    },
    /// Some stone is held by nothing.
    #[error("{0}; the stones cannot be told apart from loose ones")]
    Loose(#[from] crate::dda::Loose),
    /// Some body is not connected to the ground.
    #[error("{0}; join it to a body that is, or support it")]
    Unconnected(crate::structure::Unconnected),
    /// A number in the report is not finite.
    #[error("the analysis produced a number that is not finite ({what}); check the units of the request")]
    NotFinite {
        /// Which quantity, or where in the answer it stands.
        what: String,
    },
}

impl From<Unbuilt> for AnalysisError {
    fn from(unbuilt: Unbuilt) -> Self {
        match unbuilt {
            Unbuilt::Loose(loose) => loose.into(),
            Unbuilt::Stopped(stopped) => stopped.into(),
        }
    }
}

/// Answers a question. Where a number that decides on the answer is not finite, nothing but the limit window is told; any other
/// is left to whoever writes the answer down.
///
/// # Errors
/// When stopped by `budget`, when a fixed step is too small, when a stone is loose or held by nothing, or when the curved beam has no
/// solution.
pub fn answer(question: &Question, budget: &Budget) -> Result<Answer, AnalysisError> {
    let built = &mut Discretisation::new(budget);
    let answer = match question {
        Question::One(analysis) => verdict::run(analysis, built).map(|report| Answer::One(Box::new(report))),
        Question::Curve(points) => safety::curve(points, built).map(Answer::Curve),
        Question::WorstPosition(question) => {
            worst_position::find(question, budget).map(|report| Answer::One(Box::new(report)))
        }
        Question::SurveyTolerance(question) => {
            survey_tolerance::find(question, budget).map(|report| Answer::One(Box::new(report)))
        }
        Question::CurvedBeam(beam) => plan::beam(beam, budget).map(Answer::CurvedBeam),
    }?;
    // Where it is spent there is no answer, whatever was computed.
    budget.check()?;
    Ok(answer)
}

/// Runs the analysis: limit window, then the load path from where it says the arch stands, then the comparison. Numbers that
/// are not finite are treated as by [`answer`].
///
/// # Errors
/// When stopped by `budget`, when a fixed step is too small, or when a stone is loose or held by nothing.
pub fn run(analysis: &Analysis, budget: &Budget) -> Result<CollapseReport, AnalysisError> {
    let report = verdict::run(analysis, &mut Discretisation::new(budget))?;
    budget.check()?;
    Ok(report)
}
