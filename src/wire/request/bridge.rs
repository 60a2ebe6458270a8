//! A bridge of arch spans.

use super::{Circular, Elliptical, MultiCentre, Pointed, ProfileRequest, Text};
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use utoipa::ToSchema;

/// A bridge of arch spans, each of one ring or more, on piers and abutments. The springing level of all spans is y = 0; x = 0
/// lies in the middle between the first springing and the last. At most 2001 stones and blocks in all.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct BridgeRequest {
    /// Spans, from left to right.
    #[schema(min_items = 1, max_items = 200)]
    pub spans: Vec<SpanRequest>,
    /// Piers, from left to right, one between every two spans.
    #[serde(default)]
    #[schema(max_items = 199)]
    pub piers: Vec<PierRequest>,
    /// Blocks under the first and the last springing.
    pub abutments: Option<BridgeAbutments>,
    /// Masonry over the haunches. Left out: none. It is blocks, with joints that bear and may slide; loose fill of another density,
    /// which no joint holds, is `backfill.backing`. At an end without an abutment its plumb back leans on the ground behind, by a joint
    /// with the friction of its stone: that ground gives way to no thrust, and may hold the backing down.
    pub backing: Option<BackingRequest>,
    /// Friction angle between two rings of a span, degrees; there is no cohesion between them. Left out: the lower of their
    /// stones'.
    #[schema(minimum = 0.0, exclusive_maximum = 90.0)]
    pub ring_friction_angle_deg: Option<f64>,
}

/// A span.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SpanRequest {
    /// The intrados of the lowest ring, symmetric about its middle, from the springing level y = 0.
    pub profile: SpanProfile,
    /// Rings, from the lowest outwards. Each stands on the extrados of the one below.
    #[schema(min_items = 1, max_items = 20)]
    pub rings: Vec<RingRequest>,
}

/// The curve that a span follows, symmetric about its middle, from the springing level y = 0.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum SpanProfile {
    /// An arc of a circle.
    Circular(Circular),
    /// Two arcs that meet at an apex.
    Pointed(Pointed),
    /// Half an ellipse.
    Elliptical(Elliptical),
    /// Tangent arcs, such as an oval or a basket handle.
    MultiCentre(MultiCentre),
}

impl From<SpanProfile> for ProfileRequest {
    fn from(profile: SpanProfile) -> Self {
        match profile {
            SpanProfile::Circular(circular) => ProfileRequest::Circular(circular),
            SpanProfile::Pointed(pointed) => ProfileRequest::Pointed(pointed),
            SpanProfile::Elliptical(ellipse) => ProfileRequest::Elliptical(ellipse),
            SpanProfile::MultiCentre(oval) => ProfileRequest::MultiCentre(oval),
        }
    }
}

/// A ring, whose joints are normal to the profile.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RingRequest {
    /// Thickness at the crown, m.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub thickness_m: f64,
    /// Thickness at the springings, m; linear in the length along the profile between them. Left out: as at the crown.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub springing_thickness_m: Option<f64>,
    /// Number of voussoirs, of one length along the profile each.
    #[schema(minimum = 1, maximum = 2001)]
    pub voussoirs: usize,
    /// The name of one of `stones`; left out: `stone`.
    pub stone: Option<Text>,
}

/// A pier between two spans, on ground of its own.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PierRequest {
    /// Distance between the springings of the two spans, m.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub top_width_m: f64,
    /// From the ground to the springing level, m.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub height_m: f64,
    /// Courses of one height each; the uppermost carries the springings.
    #[schema(required = false, default = 1, minimum = 1, maximum = 2001)]
    pub courses: usize,
    /// Batter of each side: by how much it leans inwards, as horizontal run over height.
    #[schema(required = false, default = 0.0, minimum = 0.0, maximum = 1.0)]
    pub batter: f64,
    /// The name of one of `stones`; left out: `stone`.
    pub stone: Option<Text>,
}

/// Blocks under the first and the last springing. An end that is left out stands on the ground.
#[skip_serializing_none]
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(default)]
pub struct BridgeAbutments {
    /// Under the first springing.
    pub left: Option<BridgeAbutment>,
    /// Under the last springing.
    pub right: Option<BridgeAbutment>,
}

/// A block with a plumb face under the springing of the intrados, a plumb back, and a level bed with a dry joint on the ground.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct BridgeAbutment {
    /// From the ground to the springing level, m.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub height_m: f64,
    /// Width of its bed, m. Left out: as wide as the springings.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub width_m: Option<f64>,
    /// The name of one of `stones`; left out: `stone`.
    pub stone: Option<Text>,
}

/// Masonry over the haunches up to a level: a block above every pier and at each end.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct BackingRequest {
    /// Height of its top above the springing level, m.
    #[schema(minimum = -1e5, maximum = 1e5)]
    pub level_m: f64,
    /// The name of one of `stones`; left out: `stone`.
    pub stone: Option<Text>,
}
