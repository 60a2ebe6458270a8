//! What a request means by what it leaves out.

use crate::wire::request::{
    AimRequest, AnalysisRequest, JointsRequest, LoadRequest, ProfileRequest, Request, StressFieldRequest,
};

impl Request {
    /// The same with what it means by leaving it out.
    pub(super) fn with_defaults(self) -> Self {
        match self {
            Request::Structure(request) => Request::Structure(Box::new(with_defaults(*request))),
            Request::CurvedBeam(mut beam) => {
                beam.stone = beam.stone.filled_in(true);
                Request::CurvedBeam(beam)
            }
        }
    }
}

fn with_defaults(mut request: AnalysisRequest) -> AnalysisRequest {
    if let Some(arch) = request.arch.as_mut().filter(|arch| !matches!(arch.profile, ProfileRequest::Surveyed(_))) {
        arch.line.get_or_insert(Default::default());
        arch.joints.get_or_insert(JointsRequest::default());
    }
    request.stone = request.stone.filled_in(request.arch.is_some());
    for entry in &mut request.loads {
        if let LoadRequest::FillPressure(fill) = &mut entry.load {
            fill.lateral_ratio = Some(fill.ratio());
        }
    }
    let stress = request.accuracy.is_some_and(|accuracy| accuracy.stress.is_some());
    let one_path = match &request.analysis {
        AimRequest::Collapse | AimRequest::WorstPosition(_) | AimRequest::SurveyTolerance(_) => true,
        AimRequest::Safety(safety) => safety.curve.is_none(),
        AimRequest::Settlement(_) | AimRequest::GeometricSafety(_) => false,
    };
    if stress && one_path && request.report.stress_fields.is_empty() {
        request.report.stress_fields.push(StressFieldRequest::UnitLoad);
    }
    request
}
