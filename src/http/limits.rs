//! How much one request may ask for.

use crate::collapse::cost::{Demand, Share, estimate};
use crate::collapse::{Analysis, Question};
use crate::wire::fault::{Fault, Faults};
use crate::wire::request::{AimRequest, AnalysisRequest, MAX_SUBBLOCKS_EACH_WAY, ProfileRequest, Request};
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
    /// Most memory of an analysis by its [`estimate`], bytes.
    pub job_memory: usize,
    /// How long an analysis may go on.
    pub job_time: Duration,
    /// Most event streams open at once.
    pub streams: usize,
    /// Most bytes of bodies on their way in.
    pub incoming: usize,
    /// Most bytes of answers on their way.
    pub outgoing: usize,
}

/// No core makes so many multiplications a second: what takes longer even so ends in no time that is allowed.
const MULTIPLICATIONS: f64 = 2e10;

impl ApiLimits {
    /// What a question takes, no more than all analyses may together: where joints might crush that would take more, it is
    /// analysed alone.
    ///
    /// # Errors
    /// What of it is more than this service takes.
    pub(super) fn check(&self, request: &Request, question: &Question) -> Result<Demand, Vec<Fault>> {
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
        if faults.is_empty() {
            let demand = estimate(question);
            self.check_demand(&demand, request, &mut faults);
            if faults.is_empty() {
                return Ok(Demand { memory: demand.memory.min(self.job_memory), ..demand });
            }
        }
        Err(faults.into_vec())
    }

    fn check_demand(&self, demand: &Demand, request: &Request, faults: &mut Faults) {
        let (place, remedy) = remedy(demand.largest, request);
        let takes = match demand.uncrushed {
            usize::MAX => "more than can be counted".to_owned(),
            memory => format!("about {}", shown(memory)),
        };
        let most = shown(self.job_memory);
        let detail = format!("this analysis would take {takes} of memory; this service allows {most}; {remedy}");
        faults.require(demand.uncrushed <= self.job_memory, place, detail);
        let (seconds, most) = (demand.work / MULTIPLICATIONS, self.job_time.as_secs_f64());
        let detail = format!(
            "this analysis would take more than {seconds:.0} s; this service stops it after {most:.0} s; {remedy}"
        );
        faults.require(seconds <= most || !faults.is_empty(), place, detail);
    }
}

/// Where to ask for less of what takes most, and how.
fn remedy(largest: Share, request: &Request) -> (&'static str, &'static str) {
    match (request, largest) {
        (Request::CurvedBeam(beam), _) if beam.accuracy.is_some() => {
            ("/accuracy", "leave accuracy out and name a mesh")
        }
        (Request::CurvedBeam(_), _) => ("/mesh/subblocks", "use a coarser mesh"),
        (Request::Structure(request), Share::Points) if matches!(request.analysis, AimRequest::WorstPosition(_)) => {
            ("/analysis/worst_position/step_m", "use a larger step")
        }
        (_, Share::Points) => ("/analysis/safety/curve/abscissae", "use fewer"),
        (_, Share::Fields) => ("/report/stress_fields", "ask for fewer, or use a coarser mesh"),
        (_, Share::Frames) => ("/motion/most_frames", "use fewer"),
        (Request::Structure(request), _) if request.accuracy.is_some_and(|accuracy| accuracy.stress.is_some()) => {
            ("/accuracy/subblocks", "allow fewer")
        }
        (_, Share::Mesh) => ("/mesh/subblocks", "use a coarser mesh, or fewer stones"),
        (Request::Structure(request), Share::Stones) => (place_of_stones(request), "use fewer stones"),
    }
}

/// So many bytes in words.
fn shown(bytes: usize) -> String {
    let bytes = bytes as f64;
    if bytes >= 1e9 { format!("{:.1} GB", bytes / 1e9) } else { format!("{:.0} MB", (bytes / 1e6).max(1.0)) }
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
        Question::WorstPosition(question) => of(&question.analysis),
        Question::SurveyTolerance(question) => of(&question.analysis),
        Question::CurvedBeam(beam) if beam.accuracy.is_some() => (1, MAX_SUBBLOCKS_EACH_WAY.pow(2)),
        Question::CurvedBeam(beam) => (1, beam.subblocks.iter().product()),
    }
}
