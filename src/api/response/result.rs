//! The answer to whatever was asked.

use super::{AnalysisResult, BeamResult, SafetyCurveResult, line};
use crate::api::request::Request;
use crate::collapse::{Answer, CollapseReport, Reach, SafetyPoint, StressField};
use serde::Serialize;
use utoipa::ToSchema;

/// The answer to a request: of one analysis, of a safety curve or of the curved beam.
#[derive(Debug, Clone, Serialize, ToSchema)]
#[serde(untagged)]
pub enum JobResult {
    /// Of one analysis of an arch.
    Analysis(Box<AnalysisResult>),
    /// Of a safety curve.
    SafetyCurve(Box<SafetyCurveResult>),
    /// Of the curved beam.
    CurvedBeam(Box<BeamResult>),
}

impl JobResult {
    /// Puts the answer in the request's words; none where it is no answer to this request, or has a number that JSON
    /// cannot say.
    pub fn new(request: &Request, answer: &Answer) -> Option<Self> {
        match (request, answer) {
            (Request::Arch(request), Answer::One(report)) => {
                is_finite(report).then(|| JobResult::Analysis(Box::new(AnalysisResult::new(request, report))))
            }
            (Request::Arch(request), Answer::Curve(points)) => {
                let result = SafetyCurveResult::new(request, points)?;
                points.iter().all(is_told).then(|| JobResult::SafetyCurve(Box::new(result)))
            }
            (Request::CurvedBeam(request), Answer::CurvedBeam(report)) => {
                let numbers = report.exact.iter().chain(&report.energy).chain([&report.error]);
                let finite = numbers.copied().all(f64::is_finite) && has_stress(&report.field);
                finite.then(|| JobResult::CurvedBeam(Box::new(BeamResult::new(request, report))))
            }
            _ => None,
        }
    }

    /// The body of `/results` and the output of `solve --json`: compact JSON and a newline.
    ///
    /// # Errors
    /// Never for an answer of the mechanics; the serialiser wants it said.
    pub fn to_bytes(&self) -> serde_json::Result<Vec<u8>> {
        line(self)
    }
}

/// Whether stress, crushing and safety are numbers; the mechanics see to the rest.
fn is_finite(report: &CollapseReport) -> bool {
    let elastic = report.crushing.as_ref().and_then(|crushing| crushing.elastic.as_ref());
    let load_factor = elastic.and_then(|elastic| elastic.load_factor);
    let subblock = elastic.and_then(|elastic| elastic.where_largest.as_ref());
    report.stress_fields.iter().all(has_stress)
        && report.safety.iter().all(is_told)
        && load_factor.is_none_or(f64::is_finite)
        && subblock.is_none_or(|subblock| subblock.stress.iter().all(|stress| stress.is_finite()))
}

fn has_stress(field: &StressField) -> bool {
    field.load_factor.is_finite()
        && field.subblocks.iter().all(|subblock| subblock.stress.iter().all(|stress| stress.is_finite()))
}

fn is_told(point: &SafetyPoint) -> bool {
    let reaches = [point.instability, point.elastic, point.plastic_section, point.governing];
    reaches.iter().chain(&point.updated).all(|reach| !matches!(reach, Reach::At(factor) if !factor.is_finite()))
}
