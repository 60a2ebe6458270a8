//! What is asked of an arch, and what the answer shows.

use super::{Abscissa, LoadFactor, Point, SurveyToleranceRequest, Text, WorstPositionRequest};
use crate::collapse::CrushingKind;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use utoipa::ToSchema;

/// What is asked.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum AimRequest {
    /// The load factor at which the structure falls.
    #[default]
    Collapse,
    /// How far the scaled loads, in full at load factor 1, can grow until the arch falls or its stone crushes.
    Safety(SafetyRequest),
    /// What becomes of the structure as its supports move, its loads staying as they are.
    Settlement(SettlementRequest),
    /// How much thinner a structure that stands could be: its geometric safety factors.
    GeometricSafety(GeometricSafetyRequest),
    /// Where vehicles stand worst, and the load factor at which the structure falls there.
    WorstPosition(WorstPositionRequest),
    /// How the load factor moves with the points of a survey within their tolerances.
    SurveyTolerance(SurveyToleranceRequest),
}

impl AimRequest {
    /// Whether the load factor at which the structure falls is asked for, whatever else is.
    pub fn is_collapse(&self) -> bool {
        matches!(self, AimRequest::Collapse | AimRequest::WorstPosition(_) | AimRequest::SurveyTolerance(_))
    }
}

/// How much thinner a structure that stands could be: its geometric safety factors. No load may be scaled; `geometry`,
/// `load_factor.direction`, `load_factor.cap` and `report` keep their defaults.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct GeometricSafetyRequest {}

/// What becomes of the structure as its supports move, its loads staying as they are. The supports move in proportion to where
/// these fields say. No load may be scaled; `load_factor.direction`, `load_factor.cap`, `report.share_of_collapse` and
/// `report.history` keep their defaults.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(default)]
pub struct SettlementRequest {
    /// The left springing of an arch.
    pub left: MovementRequest,
    /// The right springing of an arch; not for half an arch, whose other half moves as its mirror image.
    pub right: MovementRequest,
    /// Supports of a bridge (`ground.left`, `ground.pier0` and so on, `ground.right`) or of blocks; the others stay.
    #[schema(max_items = 2001)]
    pub supports: Vec<SupportMovementRequest>,
}

/// A support and its movement, whose components are at most as large as the structure.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SupportMovementRequest {
    /// The support's name.
    pub support: Text,
    /// To the right, m; negative to the left.
    #[schema(required = false, default = 0.0, minimum = -1e5, maximum = 1e5)]
    pub rightwards_m: f64,
    /// Downwards, m; negative upwards.
    #[schema(required = false, default = 0.0, minimum = -1e5, maximum = 1e5)]
    pub downwards_m: f64,
    /// Rotation, counter-clockwise, degrees.
    #[schema(required = false, default = 0.0, minimum = -90.0, maximum = 90.0)]
    pub rotation_deg: f64,
    /// The point [x, y] that it turns about and whose movement is given, m. Left out: the middle of its joints, each with the
    /// weight of its length.
    pub about_m: Option<Point>,
}

/// How far it moves; components are at most as large as the arch.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(default)]
pub struct MovementRequest {
    /// Away from the arch, m; negative towards it.
    #[schema(minimum = -1e5, maximum = 1e5)]
    pub outwards_m: f64,
    /// Downwards, m; negative upwards.
    #[schema(minimum = -1e5, maximum = 1e5)]
    pub downwards_m: f64,
    /// Rotation about the middle of the springing joint, degrees; positive opens the joint's intrados.
    #[schema(minimum = -90.0, maximum = 90.0)]
    pub rotation_deg: f64,
}

/// How far the scaled loads, in full at load factor 1, can grow until the arch falls or its stone crushes. Needs a scaled load,
/// direction `increase` and method `event_path`.
#[skip_serializing_none]
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(default)]
pub struct SafetyRequest {
    /// Which of the two answers about crushing counts. `plastic_section`: no equilibrium keeps every joint within its strength.
    /// `elastic`: first yield, where the equivalent stress reaches the strength; of stress averaged over `report.first_yield_length_m`,
    /// or, where that is left out, over every subblock, as in the paper: then it depends on the mesh.
    pub crushing: CrushingKind,
    /// Asks for a curve: the safety factor at every abscissa of a list.
    pub curve: Option<CurveRequest>,
}

/// Asks for a curve: the safety factor at every abscissa of a list. Loads with `per_abscissa` are multiplied by the abscissa; at
/// least one load has it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct CurveRequest {
    /// Positive numbers, rising strictly. Abscissae times subblocks come to at most 1,000,000, abscissae times loads times
    /// subblocks along the arch to 500,000.
    #[schema(min_items = 1, max_items = 500)]
    pub abscissae: Vec<Abscissa>,
    /// Their unit: a label only.
    #[schema(required = false, default = "-")]
    pub unit: Text,
}

/// What the answer shows.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(default)]
pub struct ReportRequest {
    /// At which share of the way to collapse `near_collapse` is taken: displacements and contact forces.
    #[schema(exclusive_minimum = 0.0, exclusive_maximum = 1.0)]
    pub share_of_collapse: f64,
    /// Where on the path the stress in every subblock is shown; fields times subblocks come to at most 400,000. Not with a curve.
    #[schema(max_items = 16)]
    pub stress_fields: Vec<StressFieldRequest>,
    /// Asks for first yield, with stress averaged over this length both ways inside every stone, m; over the stone where that is shorter.
    /// Two subblocks at least have to lie in it either way. Left out: first yield is given only where it counts as crushing in a safety
    /// analysis, by the mean stress of every subblock.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub first_yield_length_m: Option<f64>,
    /// Asks for `history`, the load path event by event, which is followed all the way then. Left out: states are solved for one by one
    /// wherever they can be, which is quicker, and `history` is empty. Not with a curve.
    pub history: bool,
}

impl Default for ReportRequest {
    fn default() -> Self {
        ReportRequest {
            share_of_collapse: 0.999,
            stress_fields: Vec::new(),
            first_yield_length_m: None,
            history: false,
        }
    }
}

/// Where on the path a stress field is shown.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum StressFieldRequest {
    /// At load factor 1.
    UnitLoad,
    /// At `share_of_collapse` of the way to collapse.
    NearCollapse,
    /// At this load factor, where the path passes it.
    LoadFactor(LoadFactor),
}
