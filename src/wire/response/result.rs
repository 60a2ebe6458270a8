//! The answer to whatever was asked.

use super::{AnalysisResult, BeamResult, SafetyCurveResult};
use crate::collapse::Answer;
use crate::wire::json::{NotFinite, line};
use crate::wire::request::Request;
use serde::Serialize;
use utoipa::ToSchema;

/// The answer to a request: of one analysis, of a safety curve or of the curved beam.
#[derive(Debug, Clone, Serialize, ToSchema)]
#[serde(untagged)]
#[schema(discriminator(property_name = "kind", mapping(
    ("analysis" = "#/components/schemas/AnalysisResult"),
    ("safety_curve" = "#/components/schemas/SafetyCurveResult"),
    ("curved_beam" = "#/components/schemas/BeamResult"),
)))]
pub enum JobResult {
    /// Of one analysis of a structure.
    Analysis(Box<AnalysisResult>),
    /// Of a safety curve.
    SafetyCurve(Box<SafetyCurveResult>),
    /// Of the curved beam.
    CurvedBeam(Box<BeamResult>),
}

impl JobResult {
    /// Puts the answer in the request's words; none where it is no answer to this request.
    pub fn new(request: &Request, answer: &Answer) -> Option<Self> {
        match (request, answer) {
            (Request::Structure(request), Answer::One(report)) => {
                AnalysisResult::new(request, report).map(|result| JobResult::Analysis(Box::new(result)))
            }
            (Request::Structure(request), Answer::Curve(points)) => {
                SafetyCurveResult::new(request, points).map(|result| JobResult::SafetyCurve(Box::new(result)))
            }
            (Request::CurvedBeam(request), Answer::CurvedBeam(report)) => {
                Some(JobResult::CurvedBeam(Box::new(BeamResult::new(request, report))))
            }
            _ => None,
        }
    }

    /// The body of `/results` and the output of `solve --json`: compact JSON and a newline.
    ///
    /// # Errors
    /// Where a number is not finite.
    pub fn to_bytes(&self) -> Result<Vec<u8>, NotFinite> {
        line(self)
    }
}
