//! What an analysis says: plain data, SI units, radians.

mod end;
mod falling;
mod geometric;
mod mechanism;
mod note;
mod plan;
mod settlement;
mod strength;
mod unfollowed;
mod updated;

pub use crate::limit::{Resultant, Window, WindowEnd};
pub use crate::structure::Face;
pub use end::*;
pub use falling::*;
pub use geometric::*;
pub use mechanism::*;
pub use note::*;
pub use plan::*;
pub use settlement::*;
pub use strength::*;
pub use unfollowed::*;
pub use updated::*;

use super::{Direction, FieldAt, PositionReport, SurveyReport};
use crate::geometry::Vec2;

/// What happened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "server", derive(serde::Serialize, utoipa::ToSchema))]
#[cfg_attr(feature = "server", serde(rename_all = "snake_case"))]
pub enum Outcome {
    /// Stands at load factor 0 and collapses at a finite one; at 0 itself where it falls as soon as the load factor leaves it.
    Collapse,
    /// Stands at no load factor in reach: limit analysis finds no equilibrium there.
    FallsAsBuilt,
    /// Slides as its loads come on, although limit analysis, in which sliding joints dilate, finds equilibrium: whether it
    /// stands depends on how it was built.
    SlidesAsBuilt,
    /// Does not stand at load factor 0, but does between two others.
    StandsInWindow,
    /// Stands up to the cap.
    Stands,
    /// Stands, and follows its springings through their whole movement.
    FollowsMovement,
    /// Stands, and falls before its springings have come to the end of their movement.
    FallsByMovement,
    /// The stone crushes: in a safety analysis where crushing governs; in any other where joints of its strength cannot carry the
    /// fixed loads alone.
    Crushes,
    /// Path and certificate contradict each other, or the path could not be followed; the notes say why.
    CannotTell,
}

/// Resultant carried by one joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thrust {
    /// Joint number.
    pub joint: usize,
    /// Normal force, compression positive, N/m.
    pub normal: f64,
    /// Shear force on the stone after the joint, towards the extrados positive, N/m.
    pub shear: f64,
    /// Distance of the resultant from the joint's middle, towards the extrados positive, m. Zero where N = 0.
    pub eccentricity: f64,
    /// Where the resultant crosses the joint's line, m.
    pub at: Vec2,
}

/// Force at one contact point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPoint {
    /// Joint number.
    pub joint: usize,
    /// Place on the joint: 0 at the intrados, 1 at the extrados.
    pub position: f64,
    /// Normal force, compression positive, N/m.
    pub normal: f64,
    /// Tangential force on the stone after the joint, towards the extrados positive, N/m.
    pub tangential: f64,
    /// Opening between the stones, positive when open, m; on a plane of symmetry that of the whole joint.
    pub gap: f64,
}

/// Movement of one voussoir's centroid and the state of stress in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlockState {
    /// Displacement of the centroid, m.
    pub displacement: Vec2,
    /// Rotation, counter-clockwise positive, rad.
    pub rotation: f64,
    /// sigma_x, sigma_y, tau_xy, Pa, compression negative.
    pub stress: [f64; 3],
}

/// The arch at one load factor.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// Load factor.
    pub load_factor: f64,
    /// Every voussoir, left to right.
    pub blocks: Vec<BlockState>,
    /// Every contact point, joint by joint, intrados first.
    pub contacts: Vec<ContactPoint>,
    /// Force of every passive element, N/m.
    pub soil: Vec<f64>,
}

/// How the states of a structure were found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "server", derive(serde::Serialize, utoipa::ToSchema))]
#[cfg_attr(feature = "server", serde(rename_all = "snake_case"))]
pub enum StatesFrom {
    /// Each by itself, from the equations of equilibrium and the contact law; the load path was followed on whole stones from near
    /// collapse to collapse.
    DirectSolution,
    /// On the load path, followed from the unstressed structure on.
    LoadPath,
}

/// One point of the load-displacement history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HistoryPoint {
    /// Load factor.
    pub load_factor: f64,
    /// Displacement of the stone at the crown, m.
    pub crown: Vec2,
    /// Largest displacement of any centroid, m.
    pub largest: f64,
}

/// Lowest and highest load factor for which the static theorem finds equilibrium; infinite where unbounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimitWindow {
    /// Lowest.
    pub lowest: f64,
    /// Highest.
    pub highest: f64,
}

/// From where to where the load at which an arch falls may lie, because its joints slide without dilating: then many load
/// factors have a full solution (a mechanism whose forces are admissible), and stiffness and loading order pick one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadRange {
    /// The least full solution found: the end nearest to the start of the path.
    pub least: f64,
    /// End of the limit window, which lets sliding joints dilate: no full solution lies beyond. Infinite where it has none.
    pub greatest: f64,
    /// Where the load path itself ended.
    pub path: f64,
    /// How many mechanisms were tried for the least.
    pub mechanisms_tried: usize,
}

/// One end of the load path.
#[derive(Debug, Clone, PartialEq)]
pub struct PathEnd {
    /// Load factor at which the arch falls (first order), polished on the final static conditions; where joints slide, the
    /// least of `range`. Mechanism and thrust line belong to it.
    pub load_factor: f64,
    /// Where joints slide: between what the load lies.
    pub range: Option<LoadRange>,
    /// Largest equilibrium residual of any block at any event of a path that was traced, or at the end of one that the force method has
    /// followed, with forces by the contact law alone, as a share of the arch's weight, or of the largest load at a point where that is
    /// more.
    pub residual: f64,
    /// The mechanism.
    pub mechanism: Mechanism,
    /// Resultants per joint at collapse.
    pub thrust_line: Vec<Thrust>,
    /// Force of every passive element there, N/m; none where the path was left before.
    pub soil: Vec<f64>,
    /// Joints that crush there, where crushing is in the path.
    pub crushed: Vec<CrushedJoint>,
}

impl PathEnd {
    /// Load factor at which the load path itself ended.
    pub fn on_path(&self) -> f64 {
        self.range.map_or(self.load_factor, |range| range.path)
    }
}

/// A joint that carries its strength over a block of its length at one face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrushedJoint {
    /// Joint number.
    pub joint: usize,
    /// The face.
    pub face: Face,
    /// The joint's end there, m.
    pub at: Vec2,
    /// Length of the block: its normal force over the strength, m.
    pub length: f64,
}

/// Counts of the work done; the same for the same request on any machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "server", derive(serde::Serialize, utoipa::ToSchema))]
pub struct Cost {
    /// Contact events passed.
    pub events: usize,
    /// Factorisations, partial ones included.
    pub factorisations: usize,
    /// Block rows eliminated in all factorisations together.
    pub block_rows: usize,
    /// Displacement unknowns.
    pub unknowns: usize,
}

/// Least and greatest horizontal thrust under the fixed loads, N/m (static theorem).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThrustRange {
    /// Least.
    pub lowest: f64,
    /// Greatest.
    pub highest: f64,
}

/// The whole answer.
#[derive(Debug, Clone, PartialEq)]
pub struct CollapseReport {
    /// What happened.
    pub outcome: Outcome,
    /// Which way the load factor went.
    pub direction: Direction,
    /// The exact limit window (static theorem, associated friction): the certificate. None where nothing stands.
    pub limit_window: Option<LimitWindow>,
    /// What proves it, where it was solved.
    pub proof: Option<Window>,
    /// Thrust range under the fixed loads, where they stand.
    pub thrust_range: Option<ThrustRange>,
    /// Resultants per joint at the least and at the greatest thrust, where there is one.
    pub thrust_range_lines: [Option<Vec<Thrust>>; 2],
    /// The end of the path in the asked direction: collapse, or the mechanism of an arch that falls or slides as built. What
    /// governs, which may be crushing, [`CollapseReport::ends`] says.
    pub end: Option<PathEnd>,
    /// The end of the path in the other direction, for an arch that stands in a window only.
    pub other_end: Option<PathEnd>,
    /// Load factor from which the path was followed.
    pub start: f64,
    /// Largest absolute load factor that was tried.
    pub cap: f64,
    /// Share of the way to the end of the path at which `near_collapse` was taken.
    pub share: f64,
    /// The arch just before the end of the path; where joints slide, that may lie beyond the collapse load.
    pub near_collapse: Option<Snapshot>,
    /// The arch at load factor 1, where the path passes it.
    pub at_unit_load: Option<Snapshot>,
    /// The arch at the start of the path (load factor `start`).
    pub at_start: Option<Snapshot>,
    /// Stress in every subblock, where asked.
    pub stress_fields: Vec<StressField>,
    /// When the stone crushes.
    pub crushing: Crushing,
    /// The same question on moving geometry, where asked and where the arch stands at first order.
    pub updated: Option<UpdatedGeometry>,
    /// What the task asked for besides.
    pub task: TaskReport,
    /// How its states were found.
    pub states_from: StatesFrom,
    /// The path, event by event, where that is asked for.
    pub history: Vec<HistoryPoint>,
    /// How the arch moves on from `end`, where asked.
    pub motion: Option<FallingMotion>,
    /// How it moves on from `other_end`, where asked.
    pub other_motion: Option<FallingMotion>,
    /// What was modelled, where an accuracy was asked for.
    pub plan: Option<Plan>,
    /// Counts.
    pub cost: Cost,
    /// What an engineer should know before using the numbers: why intensity and window differ, what was not reached.
    pub notes: Vec<Note>,
}

/// What a task asks for besides the load path.
#[derive(Debug, Clone, PartialEq)]
pub enum TaskReport {
    /// Of a collapse: nothing.
    Collapse,
    /// The safety factors.
    Safety(SafetyFactors),
    /// What the movement of supports does; none where the structure does not stand.
    Settlement(Option<Box<SettlementReport>>),
    /// The geometric safety factors; none where the structure does not stand.
    GeometricSafety(Option<Box<GeometricSafety>>),
    /// The worst position, at which the collapse is told.
    WorstPosition(Box<PositionReport>),
    /// How the load factor moves with the points of the survey.
    SurveyTolerance(Box<SurveyReport>),
}

impl CollapseReport {
    /// The safety factors, of a safety analysis.
    pub fn safety(&self) -> Option<&SafetyFactors> {
        if let TaskReport::Safety(factors) = &self.task { Some(factors) } else { None }
    }

    /// What the movement of supports does, where it was asked and the structure stands.
    pub fn settlement(&self) -> Option<&SettlementReport> {
        if let TaskReport::Settlement(settlement) = &self.task { settlement.as_deref() } else { None }
    }

    /// The geometric safety factors, where they were asked for and the structure stands.
    pub fn geometric_safety(&self) -> Option<&GeometricSafety> {
        if let TaskReport::GeometricSafety(safety) = &self.task { safety.as_deref() } else { None }
    }

    /// The worst position, where it was asked for.
    pub fn worst_position(&self) -> Option<&PositionReport> {
        if let TaskReport::WorstPosition(report) = &self.task { Some(report) } else { None }
    }

    /// How the load factor moves with the points of the survey, where that was asked for.
    pub fn survey_tolerance(&self) -> Option<&SurveyReport> {
        if let TaskReport::SurveyTolerance(report) = &self.task { Some(report) } else { None }
    }
}
