//! The bodies and joints that the numbers of an answer stand for.

use crate::api::translate::Layout;
use crate::collapse::subblocks_of;
use crate::structure::{Joint, Side};
use serde::Serialize;
use utoipa::ToSchema;

/// The structure as it was analysed. What an answer calls intrados and extrados of a joint are its first and its second end here.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct StructureBody {
    /// All bodies; rows of `velocities` and of `blocks` come in this order.
    pub bodies: Vec<BodyBody>,
    /// All joints; joint numbers count these from 0.
    pub joints: Vec<JointBody>,
    /// Names of all pieces of ground.
    pub supports: Vec<String>,
    /// Bodies that no mesh cuts.
    #[serde(skip)]
    pub(super) whole: Vec<usize>,
}

/// A body: a stone, or a block of a pier or an abutment.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct BodyBody {
    /// Its name.
    pub name: String,
    /// Corners [x, y], counter-clockwise, m.
    pub corners_m: Vec<[f64; 2]>,
}

/// A joint.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct JointBody {
    /// Names of the bodies, or the support, before and after it.
    pub between: [String; 2],
    /// Its first and its second end [x, y], m: seen from what lies before it, from right to left.
    pub ends_m: [[f64; 2]; 2],
}

impl From<Layout> for StructureBody {
    fn from(layout: Layout) -> Self {
        let Layout { structure, bodies, supports } = layout;
        let name = |side: Side| match side {
            Side::Body(body) => bodies.get(body).cloned().unwrap_or_default(),
            Side::Support(support) => supports.get(support).cloned().unwrap_or_default(),
        };
        let joint = |joint: &Joint| JointBody {
            between: joint.between.map(name),
            ends_m: [joint.intrados.into(), joint.extrados.into()],
        };
        let joints = structure.joints.iter().map(joint).collect();
        let corners = structure.bodies.iter().map(|body| body.corners.iter().map(|&corner| corner.into()).collect());
        let bodies =
            bodies.iter().cloned().zip(corners).map(|(name, corners_m)| BodyBody { name, corners_m }).collect();
        let whole = structure.bodies.iter().enumerate().filter(|(_, body)| subblocks_of(body, [2, 2]).is_none());
        StructureBody { bodies, joints, supports, whole: whole.map(|(k, _)| k).collect() }
    }
}
