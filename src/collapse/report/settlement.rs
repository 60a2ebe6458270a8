//! What the movement of supports does.

use super::{Face, Mechanism, Thrust, Unfollowed};
use crate::geometry::Vec2;

/// How a movement ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "server", derive(serde::Serialize, utoipa::ToSchema))]
#[cfg_attr(feature = "server", serde(rename_all = "snake_case"))]
pub enum SettlementEnd {
    /// The arch follows to the end of the movement.
    Follows,
    /// The arch falls before the movement is complete.
    Collapse,
    /// On moving geometry the arch falls under its loads before any movement.
    FallsAsLoaded,
    /// The path could not be followed.
    CannotTell,
}

/// One point of a movement.
#[derive(Debug, Clone, PartialEq)]
pub struct SettlementPoint {
    /// Share of the movement that has happened.
    pub share: f64,
    /// Force of every support on the structure, N/m; of an arch, of its springings, the left one first.
    pub forces: Vec<Vec2>,
}

/// A joint that is open.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OpenJoint {
    /// Joint number.
    pub joint: usize,
    /// The face at which it is open, or open more.
    pub face: Face,
    /// The joint's end there, as built, m.
    pub at: Vec2,
    /// How wide it is open there, m.
    pub width: f64,
    /// How wide it is open at its other end, m: none where that stays shut.
    pub other: f64,
    /// Length of the joint over which it is open, m.
    pub depth: f64,
}

/// The structure on a movement of its supports.
#[derive(Debug, Clone, PartialEq)]
pub struct SettlementPath {
    /// How it ended.
    pub end: SettlementEnd,
    /// Why there is no answer, where there is none.
    pub why: Option<Unfollowed>,
    /// The last share of the movement that the arch can reach: 1, or less where it falls; where the path was lost, the highest
    /// that it reached.
    pub share: f64,
    /// Share of the movement through which the arch follows without a snap: what can be relied on.
    pub safe: f64,
    /// The path, event by event, from the arch as it stands before the movement.
    pub points: Vec<SettlementPoint>,
    /// How the structure moves on at the end: the hinges on which it follows its supports, or falls.
    pub mechanism: Mechanism,
    /// Resultants per joint at the end.
    pub thrust_line: Vec<Thrust>,
    /// Joints that are open at the end, in their order.
    pub open_joints: Vec<OpenJoint>,
    /// Force of every passive element at the end, N/m.
    pub soil: Vec<f64>,
    /// Displacement (u, v) of every body's centroid and its rotation at the end, m and rad.
    pub displacements: Vec<[f64; 3]>,
    /// Share at which the arch first snaps into another shape: the path dips by more than a hundredth, then goes on further.
    pub snap: Option<f64>,
    /// Largest equilibrium residual, as a share of the loads.
    pub residual: f64,
}

/// The answer: at first order, and on moving geometry where asked.
#[derive(Debug, Clone, PartialEq)]
pub struct SettlementReport {
    /// On the geometry as built.
    pub first_order: SettlementPath,
    /// On moving geometry.
    pub updated: Option<SettlementPath>,
}
