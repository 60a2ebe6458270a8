//! Notes on what a request means without saying it.

use super::structure::StructureBody;
use crate::api::request::{AnalysisRequest, LoadEntry, LoadRequest, Subblocks, SubblocksRequest};

/// Note on fill and acceleration together.
const FILL_IS_SHAKEN: &str = "Fill has mass: in the acceleration the column of fill and embankment over every part of the \
     extrados that looks up pushes with its mass, each of the two at half its height, and the stone below carries it. \
     What lies beside the arch does not push.";

/// Most bodies that are named in a note.
const BODIES_NAMED: usize = 6;

/// Notes on what is assumed of the loads, and of the bodies of a bridge or of blocks.
pub(super) fn assumptions(request: &AnalysisRequest, structure: &StructureBody) -> Vec<String> {
    let any = |fits: fn(&LoadRequest) -> bool| request.loads.iter().any(|LoadEntry { load, .. }| fits(load));
    let fill = any(|load| matches!(load, LoadRequest::FillPressure(_)));
    let shaken = fill && any(|load| matches!(load, LoadRequest::BodyAcceleration(_)));
    let shaken = shaken.then(|| FILL_IS_SHAKEN.to_owned());
    shaken.into_iter().chain(uncut(request, structure)).collect()
}

/// Which bodies a mesh leaves whole.
fn uncut(request: &AnalysisRequest, structure: &StructureBody) -> Option<String> {
    if matches!(request.mesh.subblocks, SubblocksRequest::Uniform(Subblocks { radial: 1, along: 1 })) {
        return None;
    }
    let whole: Vec<&str> = structure.whole.iter().map(|&body| structure.bodies[body].name.as_str()).collect();
    let more =
        if whole.len() > BODIES_NAMED { format!(" and {} more", whole.len() - BODIES_NAMED) } else { String::new() };
    let names = whole.iter().take(BODIES_NAMED).copied().collect::<Vec<_>>().join(", ");
    let words = format!(
        "Bodies that turn inwards are not cut into subblocks. One block each, with one state of stress: {names}{more}."
    );
    (!whole.is_empty()).then_some(words)
}
