//! How the load factor moves with the points of a survey.

use super::Scale;
use super::columns::column;
use crate::collapse::{Face, MovedPoint, SurveyReport, SurveyedLimit};
use serde::Serialize;
use utoipa::ToSchema;

/// How the upper end of what limit analysis lets the arch bear moves with surveyed points. It is the lower one of stone that does not
/// crush and of joints of the stone's strength (plastic sections); joints that slide dilate in it. All else in the answer is of the arch as surveyed.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct SurveyToleranceBody {
    /// With no point moved.
    pub as_surveyed: LimitBody,
    /// The lowest with one point moved alone; null where none is known.
    pub lowest: Option<MovedPointBody>,
    /// The highest with one point moved alone; null where none is known.
    pub highest: Option<MovedPointBody>,
    /// With all points at their worst together, where `points.at_worst_m` says: the lowest found from the survey in which each is where
    /// it alone does most harm, going point by point to an end of its tolerance, or back. It is that of one survey within the
    /// tolerances: the least of all is no higher. That it is no lower is not proven.
    pub all_at_worst: LimitBody,
    /// Whether no single point moved from there lowers it.
    pub settled: bool,
    /// The same at first order: the load factor as surveyed, less what every point alone takes off. Null where some of that has no end.
    pub first_order_load_factor: Option<f64>,
    /// How many surveys were solved.
    pub solved: usize,
    /// Every point with a tolerance: those of the intrados, then those of the extrados, each from left to right.
    pub points: MovedPointColumns,
}

/// What limit analysis says.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, ToSchema)]
#[serde(tag = "state", rename_all = "snake_case")]
pub enum LimitBody {
    /// It falls, or joints of the stone's strength give way.
    At {
        /// At this intensity, where `state` is `at`.
        intensity: f64,
        /// `intensity` as a load factor, where `state` is `at`.
        load_factor: f64,
    },
    /// It bears any size of the scaled loads.
    NoEnd,
    /// It falls whatever the size of the scaled loads.
    NoEquilibrium,
    /// Rounding kept limit analysis from an answer, or the arch cannot be set out.
    Unknown,
}

/// A point moved alone.
#[derive(Debug, Clone, Copy, Serialize, ToSchema)]
pub struct MovedPointBody {
    /// Joint whose end it is, from 0 at the left springing.
    pub joint: usize,
    /// The face.
    pub face: Face,
    /// How far it is moved out of the arch's opening, m; negative into it.
    pub outwards_m: f64,
    /// What limit analysis says of it.
    pub limit: LimitBody,
}

/// Points, a row each.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct MovedPointColumns {
    /// Joint whose end the point is, from 0 at the left springing.
    pub joint: Vec<usize>,
    /// The face.
    pub face: Vec<Face>,
    /// Abscissa of the point as analysed, m.
    pub x_m: Vec<f64>,
    /// Height of the point as analysed, m.
    pub y_m: Vec<f64>,
    /// Component to the right of the unit normal, out of the arch's opening.
    pub normal_x: Vec<f64>,
    /// Component upwards of the unit normal.
    pub normal_y: Vec<f64>,
    /// How far it may lie either way, m.
    pub tolerance_m: Vec<f64>,
    /// With this point alone moved outwards by its tolerance.
    pub outwards: Vec<LimitBody>,
    /// With this point alone moved inwards by its tolerance.
    pub inwards: Vec<LimitBody>,
    /// How far outwards the point is moved in `all_at_worst`, m; negative inwards.
    pub at_worst_m: Vec<f64>,
}

impl LimitBody {
    fn new(limit: SurveyedLimit, scale: &Scale<'_>) -> Self {
        match limit {
            None => LimitBody::Unknown,
            Some(f64::INFINITY) => LimitBody::NoEnd,
            Some(f64::NEG_INFINITY) => LimitBody::NoEquilibrium,
            Some(load_factor) => LimitBody::At { intensity: scale.intensity(load_factor), load_factor },
        }
    }
}

impl SurveyToleranceBody {
    pub(super) fn new(report: &SurveyReport, scale: &Scale<'_>) -> Self {
        let alone = || {
            let both = |of: &MovedPoint| [(of.outwards, of.point, 1.0), (of.inwards, of.point, -1.0)];
            report.points.iter().flat_map(both).filter_map(|(limit, point, way)| Some((limit?, point, way)))
        };
        let body = |(limit, point, way): (f64, crate::collapse::UncertainPoint, f64)| MovedPointBody {
            joint: point.joint,
            face: point.face,
            outwards_m: way * point.tolerance,
            limit: LimitBody::new(Some(limit), scale),
        };
        SurveyToleranceBody {
            as_surveyed: LimitBody::new(report.as_surveyed, scale),
            lowest: alone().min_by(|a, b| a.0.total_cmp(&b.0)).map(body),
            highest: alone().max_by(|a, b| a.0.total_cmp(&b.0)).map(body),
            all_at_worst: LimitBody::new(report.all_at_worst, scale),
            settled: report.settled,
            first_order_load_factor: report.first_order,
            solved: report.solved,
            points: MovedPointColumns::new(&report.points, scale),
        }
    }
}

impl MovedPointColumns {
    fn new(points: &[MovedPoint], scale: &Scale<'_>) -> Self {
        MovedPointColumns {
            joint: column(points, |of| of.point.joint),
            face: column(points, |of| of.point.face),
            x_m: column(points, |of| of.point.at.x),
            y_m: column(points, |of| of.point.at.y),
            normal_x: column(points, |of| of.point.outwards.x),
            normal_y: column(points, |of| of.point.outwards.y),
            tolerance_m: column(points, |of| of.point.tolerance),
            outwards: column(points, |of| LimitBody::new(of.outwards, scale)),
            inwards: column(points, |of| LimitBody::new(of.inwards, scale)),
            at_worst_m: column(points, |of| of.at_worst),
        }
    }
}
