//! Crushing in the load path.

use crate::collapse::{Geometry, Order};
use crate::wire::fault::Faults;
use crate::wire::request::{AnalysisRequest, MethodRequest};

/// What crushing in the path does not go with.
pub fn check(request: &AnalysisRequest, subblocks: &[[usize; 2]], faults: &mut Faults) {
    if !request.crushing_in_path {
        return;
    }
    let remedy = "or set crushing_in_path to false";
    for (pointer, holds, detail) in [
        (
            "/analysis",
            request.analysis.is_collapse(),
            "joints crush on the path to a collapse only: set analysis to `collapse`",
        ),
        (
            "/geometry",
            request.geometry == Geometry::FirstOrder,
            "joints crush on the arch as built only: set geometry to `first_order`",
        ),
        (
            "/method",
            request.method == MethodRequest::EventPath,
            "joints that crush are followed exactly: set method to `event_path`",
        ),
        (
            "/mesh/subblocks",
            subblocks.iter().all(|each| *each == [1, 1]),
            "joints that crush lie between whole stones: cut every stone into 1 x 1 subblocks",
        ),
        (
            "/mesh/order",
            request.mesh.order() == Order::First,
            "joints that crush lie between stones of one stress each: set order to 1",
        ),
        (
            "/report/first_yield_length_m",
            request.report.first_yield_length_m.is_none(),
            "where stones are whole no stress is averaged over a length: leave it out",
        ),
        (
            "/accuracy",
            request.accuracy.is_none(),
            "where joints crush the error of a mesh is not estimated: leave accuracy out",
        ),
        (
            "/motion",
            request.motion.is_none(),
            "how stones move on whose joints have crushed is not followed: leave motion out",
        ),
    ] {
        faults.require(holds, pointer, format!("{detail}, {remedy}"));
    }
}
