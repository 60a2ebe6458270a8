//! The arch in a request.

use super::{Length, Point, Text};
use crate::arch::ring::Line;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use utoipa::ToSchema;

/// An arch: a profile, its thickness, and how it is cut into voussoirs. The springing level is y = 0, mid-span x = 0.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ArchRequest {
    /// The curve that the arch follows, symmetric about x = 0 and springing from y = 0; or its surveyed corners.
    pub profile: ProfileRequest,
    /// Which curve the profile is. `axis`, also where it is left out: half the thickness lies on each side. `intrados`: the inner
    /// face. Not with `surveyed`.
    pub line: Option<Line>,
    /// Thickness, normal to the profile. Required, but not with `surveyed`.
    pub thickness: Option<ThicknessRequest>,
    /// Number of voussoirs, 2 to 2001. Required, but not with `surveyed`.
    #[schema(minimum = 2, maximum = 2001)]
    pub voussoirs: Option<usize>,
    /// Which way the joints run. Left out: normal to the profile. Not with `surveyed`.
    pub joints: Option<JointsRequest>,
    /// Lengths of the voussoirs along the profile in any common unit, left to right. Left out: equal. Not with `surveyed`.
    #[schema(min_items = 2, max_items = 2001)]
    pub relative_lengths: Option<Vec<Length>>,
    /// True: areas and centroids are those of true circular sectors, instead of blocks with straight sides. For circular arcs of
    /// constant thickness with normal joints. Pressures still act on the straight sides.
    #[schema(required = false, default = false)]
    pub curved_sides: bool,
    /// Voussoirs that are not of `stone`. The others are.
    #[serde(default)]
    #[schema(max_items = 2001)]
    pub stone_of: Vec<StoneOf>,
    /// Rectangular blocks below the springing joints, bonded to the ground. Left out: none.
    pub abutments: Option<AbutmentsRequest>,
    /// How the springing joints hold. `dry`: like all others. `bonded`: they neither open nor slide.
    #[schema(required = false, default = "dry")]
    pub springing_joints: SpringingJoints,
    /// True: only the left half of a symmetric arch is modelled. A crown joint rests on a frictionless wall; a keystone is cut on
    /// the axis and neither turns nor moves sideways there. The cut counts as the last joint, which never opens. The fixed loads
    /// together, and the scaled loads together, have to be symmetric.
    #[schema(required = false, default = false)]
    pub half: bool,
}

/// The curve an arch follows, symmetric about x = 0 and springing from y = 0; or its corners.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum ProfileRequest {
    /// An arc of a circle.
    Circular(Circular),
    /// Two arcs that meet at an apex.
    Pointed(Pointed),
    /// Half an ellipse.
    Elliptical(Elliptical),
    /// Tangent arcs, such as an oval or a basket handle.
    MultiCentre(MultiCentre),
    /// Ends of every joint, as surveyed.
    Surveyed(Surveyed),
}

/// An arc of a circle: radius and opening angle, or span and rise.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Circular {
    /// Radius, m; with `opening_angle_deg`.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub radius_m: Option<f64>,
    /// Full opening angle, degrees: 180 for a semicircle; with `radius_m`.
    #[schema(exclusive_minimum = 0.0, exclusive_maximum = 360.0)]
    pub opening_angle_deg: Option<f64>,
    /// Span, m; with `rise_m`.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub span_m: Option<f64>,
    /// Rise, m; with `span_m`.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub rise_m: Option<f64>,
}

/// Two arcs that meet at an apex, with centres on the springing level: radius and offset of the centres, or span and rise.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Pointed {
    /// Radius of both arcs, m; with `centre_offset_m`.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub radius_m: Option<f64>,
    /// Distance of the centre of the left arc from mid-span, to the right, m; less than the radius; with `radius_m`.
    #[schema(minimum = 0.0, exclusive_maximum = 1e5)]
    pub centre_offset_m: Option<f64>,
    /// Span, m; with `rise_m`.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub span_m: Option<f64>,
    /// Rise, m; at least half the span; with `span_m`.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub rise_m: Option<f64>,
}

/// Half an ellipse.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Elliptical {
    /// Span, m.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub span_m: f64,
    /// Rise, m.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub rise_m: f64,
}

/// Tangent arcs, such as an oval or a basket handle, from the left springing to the crown, mirrored to the right. The tangent at
/// the crown is horizontal, so the arch leans outwards at the springing by the sum of the angles less 90 degrees.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct MultiCentre {
    /// The arcs of the left half, from the springing upwards.
    #[schema(min_items = 1, max_items = 2001)]
    pub arcs: Vec<ArcRequest>,
}

/// An arc, tangent to its neighbours.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ArcRequest {
    /// Radius, m.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub radius_m: f64,
    /// Angle, degrees.
    #[schema(exclusive_minimum = 0.0, exclusive_maximum = 180.0)]
    pub angle_deg: f64,
}

/// Ends of every joint, as surveyed, from left to right; or those on the intrados and a thickness. With no `thickness`, `line`,
/// `joints` or `voussoirs`.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Surveyed {
    /// Intrados end [x, y] of every joint, m.
    #[schema(min_items = 3, max_items = 2002)]
    pub intrados_m: Vec<Point>,
    /// Extrados end [x, y] of every joint, m. Required without `thickness_m`.
    #[schema(min_items = 3, max_items = 2002)]
    pub extrados_m: Option<Vec<Point>>,
    /// Thickness, m, in place of `extrados_m`: every joint is normal to the circle through its intrados end and those of both
    /// neighbours, at a springing through the three points at that end.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub thickness_m: Option<f64>,
    /// Length over which the points are smoothed, m: each is moved along the normal on to a parabola fitted to the points of its face
    /// nearer than this, measured along them, of which there are at least four. A note tells how far points are moved. Left out:
    /// they are used as they are.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub smoothing_length_m: Option<f64>,
}

/// Thickness, normal to the profile.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum ThicknessRequest {
    /// The same everywhere, m.
    ConstantM(Length),
    /// Linear in the length along the profile, from crown to springing.
    Linear(LinearThickness),
    /// As the extrados makes it, a circle of its own.
    ExtradosCircle(ExtradosCircle),
}

impl ThicknessRequest {
    /// Its numbers, those at the crown and at the springings, m; none of an extrados circle.
    pub fn at_crown_and_springings(&self) -> Option<[f64; 2]> {
        match self {
            ThicknessRequest::ConstantM(Length(thickness)) => Some([*thickness; 2]),
            ThicknessRequest::Linear(linear) => Some([linear.crown_m, linear.springing_m]),
            ThicknessRequest::ExtradosCircle(_) => None,
        }
    }

    /// So many times as thick; none of an extrados circle.
    pub fn times(&self, share: f64) -> Option<Self> {
        match self {
            ThicknessRequest::ConstantM(Length(thickness)) => {
                Some(ThicknessRequest::ConstantM(Length(share * thickness)))
            }
            ThicknessRequest::Linear(LinearThickness { crown_m, springing_m }) => {
                let [crown_m, springing_m] = [crown_m, springing_m].map(|thickness| share * thickness);
                Some(ThicknessRequest::Linear(LinearThickness { crown_m, springing_m }))
            }
            ThicknessRequest::ExtradosCircle(_) => None,
        }
    }
}

/// Linear in the length along the profile, from crown to springing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct LinearThickness {
    /// At the crown, m.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub crown_m: f64,
    /// At the springings, m.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub springing_m: f64,
}

/// As the extrados makes it, a circle of its own with its centre on x = 0; `line` must be `intrados`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ExtradosCircle {
    /// Radius, m.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub radius_m: f64,
    /// Height of the centre above the springing level, m; usually negative.
    #[schema(minimum = -1e5, maximum = 1e5)]
    pub centre_y_m: f64,
}

/// Which way the joints run.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum JointsRequest {
    /// Normal to the profile.
    #[default]
    Normal,
    /// Along rays from a centre.
    Rays(Rays),
}

/// Along rays from a centre.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Rays {
    /// Centre [x, y], m.
    pub centre_m: Point,
}

/// Voussoirs in a row and the stone that they are of. A joint of two stones has the lower friction, the lower cohesion and the
/// lower strength of both.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct StoneOf {
    /// The first of them, from 0 on the left.
    #[schema(maximum = 2000)]
    pub from: usize,
    /// The last of them.
    #[schema(maximum = 2000)]
    pub to: usize,
    /// The name of one of `stones`.
    pub stone: Text,
}

/// Rectangular blocks below the springing joints, bonded to the ground. Each is of the stone of the voussoir on it, but weighs
/// nothing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct AbutmentsRequest {
    /// Height, normal to the springing joint, m.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub height_m: f64,
}

/// How the first and the last joint hold.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum SpringingJoints {
    /// Like every other joint.
    #[default]
    Dry,
    /// Glued: neither open nor slide.
    Bonded,
}
