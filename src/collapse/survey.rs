//! The question how a collapse load depends on the points of a survey, and what is told of it.

use super::{Analysis, Face};
use crate::geometry::Vec2;
use crate::structure::{PointForce, Structure};
use std::sync::Arc;

/// How far the load factor of collapse moves as surveyed points move within their tolerances.
#[derive(Debug, Clone, PartialEq)]
pub struct SurveyQuestion {
    /// What is asked of the structure as surveyed.
    pub analysis: Analysis,
    /// The points that are not certain.
    pub points: Vec<UncertainPoint>,
    /// The same structure with its points elsewhere.
    pub resurvey: Resurvey,
}

/// A surveyed point, an end of a joint, that may lie elsewhere along the normal of its face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UncertainPoint {
    /// Joint number.
    pub joint: usize,
    /// Which end of the joint.
    pub face: Face,
    /// Where it was surveyed, m.
    pub at: Vec2,
    /// Unit normal of the face there, out of the arch's opening.
    pub outwards: Vec2,
    /// How far it may lie either way, m.
    pub tolerance: f64,
}

/// A structure and its loads, all computed from other points.
#[derive(Debug, Clone, PartialEq)]
pub struct Resurveyed {
    /// The structure.
    pub structure: Structure,
    /// Loads that stay.
    pub fixed: Vec<PointForce>,
    /// Loads that the load factor multiplies.
    pub scaled: Vec<PointForce>,
}

/// The same structure with every uncertain point moved outwards by so much.
#[derive(Clone)]
pub struct Resurvey(Arc<SetOut>);

/// Sets a structure out with its uncertain points moved outwards by these lengths, m; none where that cannot be.
type SetOut = dyn Fn(&[f64]) -> Option<Resurveyed> + Send + Sync;

impl Resurvey {
    /// From what sets it out.
    pub fn new(set_out: impl Fn(&[f64]) -> Option<Resurveyed> + Send + Sync + 'static) -> Self {
        Resurvey(Arc::new(set_out))
    }

    /// With its uncertain points moved outwards by these lengths, m; none where it cannot be set out.
    pub fn at(&self, by: &[f64]) -> Option<Resurveyed> {
        (self.0)(by)
    }
}

impl std::fmt::Debug for Resurvey {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Resurvey")
    }
}

/// Whether both set out the same structure where no point is moved.
impl PartialEq for Resurvey {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.at(&[]) == other.at(&[])
    }
}

/// What limit analysis says of a survey: the load factor at which the structure falls or joints of its stone's strength give way,
/// infinite where there is none, minus infinite where nothing is in equilibrium, none where rounding kept the programme from an
/// answer or the structure cannot be set out.
pub type SurveyedLimit = Option<f64>;

/// What a point's tolerance does to the load factor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovedPoint {
    /// The point.
    pub point: UncertainPoint,
    /// With this point alone moved outwards by its tolerance.
    pub outwards: SurveyedLimit,
    /// With this point alone moved inwards by its tolerance.
    pub inwards: SurveyedLimit,
    /// How far outwards it is moved where all are at their worst, m: the tolerance, less than nothing inwards, or 0.
    pub at_worst: f64,
}

/// How the load factor depends on the points.
#[derive(Debug, Clone, PartialEq)]
pub struct SurveyReport {
    /// With no point moved.
    pub as_surveyed: SurveyedLimit,
    /// Every uncertain point.
    pub points: Vec<MovedPoint>,
    /// With all points at their worst together.
    pub all_at_worst: SurveyedLimit,
    /// Whether no single point moved from there to another end of its tolerance, or back, lowers it.
    pub settled: bool,
    /// At first order: `as_surveyed` less what every point alone takes off at its worst. None where some of that has no end.
    pub first_order: Option<f64>,
    /// How many surveys were solved.
    pub solved: usize,
}
