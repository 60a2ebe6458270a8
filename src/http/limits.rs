//! How much one request may ask for.

use crate::collapse::{Analysis, Question};
use crate::wire::fault::{Fault, Faults};
use crate::wire::request::{AnalysisRequest, MAX_SUBBLOCKS_EACH_WAY, ProfileRequest, Request};
use std::time::Duration;

/// How much one request may ask for, beside what the validator allows at most.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ApiLimits {
    /// Longest body, bytes.
    pub body: usize,
    /// Time in which a body has to arrive.
    pub request_time: Duration,
    /// Most voussoirs of an arch, or bodies of any structure.
    pub voussoirs: usize,
    /// Most subblocks of an analysis.
    pub subblocks: usize,
    /// Most event streams open at once.
    pub streams: usize,
    /// Most bytes of bodies on their way in.
    pub incoming: usize,
    /// Most bytes of answers on their way.
    pub outgoing: usize,
}

impl ApiLimits {
    /// What of a question is more than this service takes.
    pub(super) fn check(&self, request: &Request, question: &Question) -> Vec<Fault> {
        let mut faults = Faults::default();
        let (voussoirs, subblocks) = size(question);
        let place = match request {
            Request::Structure(request) => place_of_stones(request),
            Request::CurvedBeam(_) => "",
        };
        let most = self.voussoirs;
        let detail = format!("{voussoirs} voussoirs: this service takes at most {most}; use fewer");
        faults.require(voussoirs <= most, place, detail);
        let most = self.subblocks;
        let (place, remedy) = match request {
            Request::Structure(request) if request.accuracy.is_some_and(|accuracy| accuracy.stress.is_some()) => {
                ("/accuracy/subblocks", "allow fewer")
            }
            Request::CurvedBeam(request) if request.accuracy.is_some() => {
                ("/accuracy", "leave accuracy out and name a mesh")
            }
            _ => ("/mesh/subblocks", "use a coarser mesh"),
        };
        let detail = format!("{subblocks} subblocks in all: this service takes at most {most}; {remedy}");
        faults.require(subblocks <= most, place, detail);
        faults.into_vec()
    }
}

/// Where the number of stones is given.
fn place_of_stones(request: &AnalysisRequest) -> &'static str {
    match (&request.arch, &request.bridge) {
        (Some(arch), _) if matches!(arch.profile, ProfileRequest::Surveyed(_)) => "/arch/profile/surveyed/intrados_m",
        (Some(_), _) => "/arch/voussoirs",
        (None, Some(_)) => "/bridge/spans",
        (None, None) => "/blocks/polygons",
    }
}

/// Voussoirs and subblocks of one analysis; all points of a curve have the same.
fn size(question: &Question) -> (usize, usize) {
    let of = |analysis: &Analysis| {
        let given = || analysis.mesh.subblocks.iter().map(|[radial, along]| radial * along).sum();
        let refined = analysis.task.accuracy().filter(|accuracy| accuracy.stress.is_some());
        (analysis.structure.voussoirs().len(), refined.map_or_else(given, |accuracy| accuracy.most_subblocks))
    };
    match question {
        Question::One(analysis) => of(analysis),
        Question::Curve(points) => points.first().map_or((0, 0), |point| of(&point.analysis)),
        Question::CurvedBeam(beam) if beam.accuracy.is_some() => (1, MAX_SUBBLOCKS_EACH_WAY.pow(2)),
        Question::CurvedBeam(beam) => (1, beam.subblocks.iter().product()),
    }
}
