//! What the movement of supports does.

use super::columns::{ThrustColumns, column};
use super::mechanism::MechanismBody;
use crate::collapse::{Face, OpenJoint, SettlementEnd, SettlementPath, SettlementPoint, SettlementReport};
use serde::Serialize;
use utoipa::ToSchema;

/// The path at first order and that on moving geometry.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct SettlementBody {
    /// On the geometry as built: where the thrust ends up, the least or the greatest that limit analysis allows if the
    /// movement is large enough. An arch does not fall at first order.
    pub first_order: SettlementPathBody,
    /// On moving geometry, where `geometry` asks for it.
    pub updated_geometry: Option<SettlementPathBody>,
}

/// A path of the movement.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct SettlementPathBody {
    /// How the movement ended.
    pub end: SettlementEnd,
    /// Why there is no answer, in words; null where there is one.
    pub why: Option<String>,
    /// The last share of the movement that the arch can reach: 1, or less where it falls; where the path was lost, the highest
    /// that it reached.
    pub share_of_movement: f64,
    /// Share of the movement through which the arch follows without a snap: what can be relied on.
    pub safe_share_of_movement: f64,
    /// Horizontal thrust at the end, with which the left springing pushes the arch to the right; null of a bridge and of blocks.
    pub thrust_n_per_m: Option<f64>,
    /// The path, event by event, from the arch as it stands before the movement to the largest share it reaches. Where the
    /// share falls in between, the arch snaps into another shape.
    pub history: SettlementColumns,
    /// How it follows its supports, or falls, at the end.
    #[serde(flatten)]
    pub mechanism: MechanismBody,
    /// Joints that are open at the end, in their order: cracks. Those open by less than a millionth of their length are not listed.
    /// Which of two neighbouring joints opens may be up to how the arch was built.
    pub open_joints: Vec<OpenJointBody>,
    /// Force of every one of `structure.passive_elements` at the end, N/m.
    pub passive_n_per_m: Vec<f64>,
    /// Resultant per joint at the end, as places on the joints as built.
    pub thrust_line: ThrustColumns,
    /// Displacements at the end.
    pub displacements: DisplacementColumns,
    /// Share of the movement at which the arch first snaps into another shape; null where it does not.
    pub snap_share_of_movement: Option<f64>,
    /// Largest equilibrium residual, as a share of the loads.
    pub residual: f64,
}

/// A joint that is open.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct OpenJointBody {
    /// Joint number: of an arch from 0 at the left springing, else the place in `structure.joints`.
    pub joint: usize,
    /// Face at which it is open, or open more.
    pub opens: Face,
    /// The joint's end there as built, [x, y].
    pub at_m: [f64; 2],
    /// Width of the crack there.
    pub width_m: f64,
    /// Width at the joint's other end; 0 where that stays shut.
    pub width_at_other_end_m: f64,
    /// Length of the joint over which it is open.
    pub depth_m: f64,
}

/// Forces of the ground as the supports move: of an arch thrust and reactions, of a bridge and of blocks `supports`.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct SettlementColumns {
    /// Share of the movement.
    pub share_of_movement: Vec<f64>,
    /// Horizontal force of the left springing on the arch, to the right; null of a bridge and of blocks.
    pub thrust_n_per_m: Option<Vec<f64>>,
    /// Horizontal force of the right springing on the arch, to the right; null for half an arch, a bridge and blocks.
    pub right_thrust_n_per_m: Option<Vec<f64>>,
    /// Vertical force of the left springing on the arch, upwards; null of a bridge and of blocks.
    pub left_reaction_n_per_m: Option<Vec<f64>>,
    /// Vertical force of the right springing on the arch, upwards; null for half an arch, a bridge and blocks.
    pub right_reaction_n_per_m: Option<Vec<Option<f64>>>,
    /// Every support of a bridge or of blocks; of an arch none.
    pub supports: Vec<SupportForces>,
}

/// Force of one support on what it carries.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct SupportForces {
    /// The support's name.
    pub support: String,
    /// Force to the right.
    pub rightwards_n_per_m: Vec<f64>,
    /// Force upwards.
    pub upwards_n_per_m: Vec<f64>,
}

/// Displacement of every body, in the order of `structure.bodies`.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct DisplacementColumns {
    /// Displacement of the centroid to the right.
    pub x_m: Vec<f64>,
    /// Displacement of the centroid upwards.
    pub y_m: Vec<f64>,
    /// Rotation, counter-clockwise.
    pub rotation_rad: Vec<f64>,
}

/// Whose supports move.
pub(super) enum Grounds<'a> {
    Arch { half: bool },
    Named(&'a [String]),
}

impl SettlementBody {
    pub(super) fn new(report: &SettlementReport, grounds: &Grounds<'_>) -> Self {
        SettlementBody {
            first_order: SettlementPathBody::new(&report.first_order, grounds),
            updated_geometry: report.updated.as_ref().map(|path| SettlementPathBody::new(path, grounds)),
        }
    }
}

impl SettlementPathBody {
    fn new(path: &SettlementPath, grounds: &Grounds<'_>) -> Self {
        let history = SettlementColumns::new(&path.points, grounds);
        SettlementPathBody {
            end: path.end,
            why: path.why.map(|why| why.to_string()),
            share_of_movement: path.share,
            safe_share_of_movement: path.safe,
            thrust_n_per_m: history.thrust_n_per_m.as_ref().map(|thrust| thrust.last().copied().unwrap_or(0.0)),
            history,
            mechanism: (&path.mechanism).into(),
            open_joints: column(&path.open_joints, Into::into),
            passive_n_per_m: path.soil.clone(),
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

impl From<&OpenJoint> for OpenJointBody {
    fn from(open: &OpenJoint) -> Self {
        let &OpenJoint { joint, face, at, width, other, depth } = open;
        let (width_m, width_at_other_end_m, depth_m) = (width, other, depth);
        OpenJointBody { joint, opens: face, at_m: at.into(), width_m, width_at_other_end_m, depth_m }
    }
}

impl SettlementColumns {
    fn new(rows: &[SettlementPoint], grounds: &Grounds<'_>) -> Self {
        let forces = |support: usize| {
            [0, 1].map(|axis| column(rows, |row| row.forces.get(support).map_or(0.0, |force| force[axis])))
        };
        let support = |(k, name): (usize, &String)| {
            let [rightwards_n_per_m, upwards_n_per_m] = forces(k);
            SupportForces { support: name.clone(), rightwards_n_per_m, upwards_n_per_m }
        };
        let (half, names): (_, &[String]) = match grounds {
            Grounds::Arch { half } => (Some(*half), &[]),
            Grounds::Named(names) => (None, names),
        };
        let ([thrust, left], [right_thrust, right]) = (forces(0), forces(1));
        SettlementColumns {
            share_of_movement: column(rows, |row| row.share),
            thrust_n_per_m: half.map(|_| thrust),
            right_thrust_n_per_m: half.filter(|half| !half).map(|_| right_thrust),
            left_reaction_n_per_m: half.map(|_| left),
            right_reaction_n_per_m: half.map(|half| right.into_iter().map(|up| (!half).then_some(up)).collect()),
            supports: names.iter().enumerate().map(support).collect(),
        }
    }
}
