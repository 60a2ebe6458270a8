//! Blocks given by their corners: walls, buttresses, portals, arches drawn elsewhere.

use super::{Point, Segment, Text};
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use utoipa::ToSchema;

/// Blocks given by their corners, such as a wall; the joints between them and the ground that they stand on. x runs to the right,
/// y upwards, in m.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct BlocksRequest {
    /// The blocks, of at most 20,000 corners together.
    #[schema(min_items = 1, max_items = 2001)]
    pub polygons: Vec<PolygonRequest>,
    /// Where the joints between blocks are. Left out: `found`.
    #[serde(default)]
    pub joints: BlockJointsRequest,
    /// The ground.
    #[schema(min_items = 1, max_items = 2001)]
    pub supports: Vec<SupportRequest>,
    /// How far points may be from where they are meant to be, m. Left out: a millionth of the longer side of the box round all
    /// corners.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub tolerance_m: Option<f64>,
}

/// A block.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PolygonRequest {
    /// Its name, up to 200 characters; no other block and no support has it.
    pub name: Text,
    /// Corners [x, y] in order, in either sense, m. It need not be convex.
    #[schema(min_items = 3, max_items = 200)]
    pub corners_m: Vec<Point>,
    /// The name of one of `stones`; left out: `stone`.
    pub stone: Option<Text>,
}

/// Where the joints between blocks are.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum BlockJointsRequest {
    /// Wherever straight sides of two blocks meet; friction and cohesion are those of the weaker stone.
    #[default]
    Found,
    /// These, and those on supports: blocks that meet elsewhere have no joint between them.
    Given(GivenJoints),
}

/// Joints between blocks, and between blocks and supports.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(max_items = 8000)]
pub struct GivenJoints(pub Vec<GivenJointRequest>);

/// A joint between two blocks, or a block and a support.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct GivenJointRequest {
    /// Names of what it lies between.
    #[schema(min_items = 2, max_items = 2)]
    pub between: [Text; 2],
    /// Its ends [x, y], m; both on one side of each block.
    #[schema(min_items = 2, max_items = 2)]
    pub ends_m: [Point; 2],
    /// Friction angle, degrees. Left out: that of the weaker stone.
    #[schema(minimum = 0.0, exclusive_maximum = 90.0)]
    pub friction_angle_deg: Option<f64>,
    /// Cohesion, Pa. Left out: that of the weaker stone.
    #[schema(minimum = 0.0, exclusive_maximum = 1e15)]
    pub cohesion_pa: Option<f64>,
    /// True: it neither opens nor slides.
    #[schema(required = false, default = false)]
    pub bonded: bool,
}

/// A piece of ground. Its joints have friction and cohesion of the stone that rests on it. At least one of its lists has an
/// item, or a given joint names it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SupportRequest {
    /// Its name, up to 200 characters; no block and no other support has it.
    pub name: Text,
    /// Sides of blocks that rest on it.
    #[serde(default)]
    #[schema(max_items = 2001)]
    pub sides: Vec<SideRequest>,
    /// Straight lines of ground, from [x, y] to [x, y], m: all sides of blocks that lie on them rest on it.
    #[serde(default)]
    #[schema(max_items = 2001)]
    pub segments_m: Vec<Segment>,
}

/// A whole side of a block.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SideRequest {
    /// The block's name.
    pub block: Text,
    /// From this corner to the next, counted from 0 as in `corners_m`.
    #[schema(maximum = 199)]
    pub side: usize,
}
