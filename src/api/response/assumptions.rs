//! Notes on what a request means without saying it.

use crate::api::request::{AnalysisRequest, LoadEntry, LoadRequest};

/// Note on fill and acceleration together.
const FILL_IS_SHAKEN: &str = "Fill has mass: in the acceleration the column of fill and embankment over every part of the \
     extrados that looks up pushes with its mass, each of the two at half its height, and the stone below carries it. \
     What lies beside the arch does not push.";

/// Notes on what is assumed of the loads.
pub(super) fn assumptions(request: &AnalysisRequest) -> Vec<String> {
    let any = |fits: fn(&LoadRequest) -> bool| request.loads.iter().any(|LoadEntry { load, .. }| fits(load));
    let fill = any(|load| matches!(load, LoadRequest::FillPressure(_)));
    let shaken = fill && any(|load| matches!(load, LoadRequest::BodyAcceleration(_)));
    shaken.then(|| FILL_IS_SHAKEN.to_owned()).into_iter().collect()
}
