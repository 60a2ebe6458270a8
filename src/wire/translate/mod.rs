//! A request in SI, or everything that is wrong with it.

mod accuracy;
mod arch;
mod backfill;
mod beam;
mod blocks;
mod bridge;
mod crushing;
mod factors;
mod geometric;
mod half;
mod inertia;
mod loads;
mod mesh;
mod motion;
mod profile;
mod safety;
mod settlement;
mod site;
mod stone;
mod structure;
mod survey;
mod survey_tolerance;
mod vehicle;
mod worst_position;

use super::fault::{Fault, Faults};
use super::request::{AimRequest, AnalysisRequest, Request};
use crate::collapse::{Analysis, Question};
use site::Unloaded;

pub use loads::{arriving, forces_per_voussoir_of};
pub use structure::Layout;
pub use survey::{Smoothing, smoothing};
pub use worst_position::placed;

/// Translates a request.
///
/// # Errors
/// All faults that are not of structure.
pub fn translate(request: &Request) -> Result<Question, Vec<Fault>> {
    let mut faults = Faults::default();
    let question = match request {
        Request::Structure(request) => structure_question(request, &mut faults),
        Request::CurvedBeam(request) => beam::beam(request, &mut faults).map(Question::CurvedBeam),
    };
    match question {
        Some(question) if faults.is_empty() => Ok(question),
        _ => Err(faults.into_vec()),
    }
}

/// What is analysed, of a curve under the loads as they are at abscissa 1, and the whole structure with its names.
pub fn analysed(request: &AnalysisRequest) -> Option<(Analysis, Layout)> {
    let faults = &mut Faults::default();
    let site = Unloaded::new(request, faults);
    let analysis = site.analysis(&request.loads, faults)?;
    Some((analysis, site.layout()?.clone()))
}

fn structure_question(request: &AnalysisRequest, faults: &mut Faults) -> Option<Question> {
    let site = Unloaded::new(request, faults);
    let curve = match &request.analysis {
        AimRequest::Collapse | AimRequest::WorstPosition(_) | AimRequest::SurveyTolerance(_) => None,
        AimRequest::Safety(safety) => {
            safety::check(request, faults);
            safety.curve.as_ref()
        }
        AimRequest::Settlement(settlement) => {
            settlement::check(request, settlement, &site, faults);
            None
        }
        AimRequest::GeometricSafety(_) => {
            geometric::check(request, faults);
            None
        }
    };
    factors::check(request, faults);
    safety::check_flags(request, curve, faults);
    vehicle::check(request, faults);
    match (curve, &request.analysis) {
        (Some(curve), _) => safety::points(&site, curve, faults).map(Question::Curve),
        (None, AimRequest::WorstPosition(asked)) => {
            worst_position::question(&site, asked, faults).map(|question| Question::WorstPosition(Box::new(question)))
        }
        (None, AimRequest::SurveyTolerance(asked)) => {
            let question = survey_tolerance::question(&site, asked, faults);
            question.map(|question| Question::SurveyTolerance(Box::new(question)))
        }
        (None, _) => site.analysis(&request.loads, faults).map(|analysis| Question::One(Box::new(analysis))),
    }
}
