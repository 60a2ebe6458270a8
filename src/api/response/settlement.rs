//! What the movement of springings does.

use super::columns::{ThrustColumns, column};
use super::mechanism::{HingeBody, LiftOffBody, SlideBody};
use crate::collapse::{Mode, SettlementEnd, SettlementPath, SettlementPoint, SettlementReport};
use serde::Serialize;
use utoipa::ToSchema;

/// What the movement of springings does, at first order and on moving geometry.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct SettlementBody {
    /// On the geometry as built: where the thrust ends up, the least or the greatest that limit analysis allows if the
    /// movement is large enough. An arch does not fall at first order.
    pub first_order: SettlementPathBody,
    /// On moving geometry, where `geometry` asks for it.
    pub updated_geometry: Option<SettlementPathBody>,
}

/// One path.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct SettlementPathBody {
    /// How it ended.
    pub end: SettlementEnd,
    /// Why there is no answer, in words; null where there is one.
    pub why: Option<String>,
    /// The last share of the movement that the arch can reach: 1, or less where it falls; where the path was lost, the highest
    /// that it reached.
    pub share_of_movement: f64,
    /// Share of the movement through which the arch follows without a snap: what can be relied on.
    pub safe_share_of_movement: f64,
    /// Horizontal thrust at the end, with which the left springing pushes the arch to the right.
    pub thrust_n_per_m: f64,
    /// The path, event by event, from the arch as it stands before the movement to the largest share it reaches. Where the
    /// share falls in between, the arch snaps into another shape.
    pub history: SettlementColumns,
    /// How the crown goes on at the end.
    pub mode: Mode,
    /// Hinges on which the arch follows its springings, or falls, at the end.
    pub hinges: Vec<HingeBody>,
    /// Joints that slide at the end.
    pub slides: Vec<SlideBody>,
    /// Joints that part altogether at the end.
    pub lift_offs: Vec<LiftOffBody>,
    /// Resultant per joint at the end, as places on the joints as built.
    pub thrust_line: ThrustColumns,
    /// Displacement of every voussoir at the end.
    pub displacements: DisplacementColumns,
    /// Share of the movement at which the arch first snaps into another shape; null where it does not.
    pub snap_share_of_movement: Option<f64>,
    /// Largest equilibrium residual, as a share of the loads.
    pub residual: f64,
}

/// Thrust and reactions as the springings move.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct SettlementColumns {
    /// Share of the movement.
    pub share_of_movement: Vec<f64>,
    /// Horizontal force of the left springing on the arch, to the right.
    pub thrust_n_per_m: Vec<f64>,
    /// Vertical force of the left springing on the arch, upwards.
    pub left_reaction_n_per_m: Vec<f64>,
    /// Vertical force of the right springing on the arch, upwards; null for half an arch.
    pub right_reaction_n_per_m: Vec<Option<f64>>,
}

/// Displacement of every voussoir, left to right.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct DisplacementColumns {
    /// Of the centroid, to the right.
    pub x_m: Vec<f64>,
    /// Of the centroid, upwards.
    pub y_m: Vec<f64>,
    /// Counter-clockwise.
    pub rotation_rad: Vec<f64>,
}

impl From<&SettlementReport> for SettlementBody {
    fn from(report: &SettlementReport) -> Self {
        SettlementBody {
            first_order: (&report.first_order).into(),
            updated_geometry: report.updated.as_ref().map(Into::into),
        }
    }
}

impl From<&SettlementPath> for SettlementPathBody {
    fn from(path: &SettlementPath) -> Self {
        SettlementPathBody {
            end: path.end,
            why: path.why.map(|why| why.to_string()),
            share_of_movement: path.share,
            safe_share_of_movement: path.safe,
            thrust_n_per_m: path.points.last().map_or(0.0, |point| point.thrust),
            history: SettlementColumns::new(&path.points),
            mode: path.mechanism.mode,
            hinges: path.mechanism.hinges.iter().map(Into::into).collect(),
            slides: path.mechanism.slides.iter().map(Into::into).collect(),
            lift_offs: path.mechanism.lift_offs.iter().map(Into::into).collect(),
            thrust_line: ThrustColumns::new(&path.thrust_line),
            displacements: DisplacementColumns {
                x_m: column(&path.displacements, |row| row[0]),
                y_m: column(&path.displacements, |row| row[1]),
                rotation_rad: column(&path.displacements, |row| row[2]),
            },
            snap_share_of_movement: path.snap,
            residual: path.residual,
        }
    }
}

impl SettlementColumns {
    fn new(rows: &[SettlementPoint]) -> Self {
        SettlementColumns {
            share_of_movement: column(rows, |row| row.share),
            thrust_n_per_m: column(rows, |row| row.thrust),
            left_reaction_n_per_m: column(rows, |row| row.left),
            right_reaction_n_per_m: column(rows, |row| row.right),
        }
    }
}
