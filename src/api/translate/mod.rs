//! A request in SI, or everything that is wrong with it.

mod accuracy;
mod arch;
mod beam;
mod blocks;
mod bridge;
mod crushing;
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

use super::fault::{Fault, Faults};
use super::request::{AimRequest, AnalysisRequest, MAX_TEXT, Request};
use crate::collapse::{Analysis, Question};
use site::Unloaded;
use stone::friction_angle;

pub use structure::{Layout, NO_STRUCTURE};

/// Largest length and coordinate, m.
pub const MAX_LENGTH_M: f64 = 1e5;
/// Largest density, kg/m3 (heavier than any matter on Earth).
pub const MAX_DENSITY_KG_M3: f64 = 1e5;
/// Largest modulus, strength, cohesion or pressure, Pa.
pub const MAX_STRESS_PA: f64 = 1e15;
/// Largest force, N per metre of depth.
pub const MAX_FORCE_N_PER_M: f64 = 1e15;
/// Largest pure number: coefficients, load factors, accelerations in g.
pub const MAX_FACTOR: f64 = 1e12;

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
        AimRequest::Collapse => None,
        AimRequest::Safety(safety) => {
            safety::check(request, faults);
            safety.curve.as_ref()
        }
        AimRequest::Settlement(settlement) => {
            settlement::check(request, settlement, &site, faults);
            None
        }
    };
    safety::check_flags(request, curve, faults);
    match curve {
        Some(curve) => safety::points(&site, curve, faults).map(Question::Curve),
        None => site.analysis(&request.loads, faults).map(|analysis| Question::One(Box::new(analysis))),
    }
}

/// Whether a text is short enough and stands on one line.
fn check_text(pointer: &str, text: &str, faults: &mut Faults) -> bool {
    let detail = format!("this text is too long: shorten it to {MAX_TEXT} characters");
    let short = faults.require(text.chars().count() <= MAX_TEXT, pointer, detail);
    let detail = "this text has a line break or another control character: leave it out";
    faults.require(!text.chars().any(|c| c.is_ascii_control()), pointer, detail) && short
}
