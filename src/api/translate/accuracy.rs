//! An accuracy instead of a mesh.

use crate::api::fault::Faults;
use crate::api::request::{
    AccuracyRequest, AimRequest, AnalysisRequest, MAX_SUBBLOCKS, MethodRequest, SubblocksRequest,
};
use crate::collapse::{Accuracy, Geometry, Seams};
use crate::structure::{Sides, Structure};

/// The accuracy asked for, where one is.
pub fn accuracy(request: &AnalysisRequest, structure: Option<&Structure>, faults: &mut Faults) -> Option<Accuracy> {
    let asked = request.accuracy.as_ref()?;
    let accuracy = checked(asked, faults);
    let detail = "an accuracy is reached by steps no one chooses: set method to `event_path`";
    faults.require(request.method == MethodRequest::EventPath, "/method", detail);
    let detail = "on moving geometry the answer depends on the mesh by an error that is not estimated: leave accuracy out \
                  and name a mesh, or set geometry to `first_order`";
    faults.require(request.geometry == Geometry::FirstOrder, "/geometry", detail);
    let curve = matches!(&request.analysis, AimRequest::Safety(safety) if safety.curve.is_some());
    faults.require(!curve, "/accuracy", "a curve does not tell how accurate its points are: leave accuracy out");
    let settles = matches!(request.analysis, AimRequest::Settlement(_));
    faults.require(!settles, "/accuracy", "the error of a settlement is not estimated: leave accuracy out");
    if asked.stress.is_some() {
        let own = request.mesh.subblocks == SubblocksRequest::default();
        let detail = "accuracy.stress finds the mesh itself: leave the subblocks out, or accuracy.stress";
        faults.require(own, "/mesh/subblocks", detail);
        let detail = "stress converges with split seams only: set seams to `split`, or leave accuracy.stress out";
        faults.require(request.mesh.seams == Seams::Split, "/mesh/seams", detail);
        if let Some(k) = structure
            .and_then(|structure| structure.voussoirs().iter().position(|stone| stone.sides == Sides::Compound))
        {
            let detail = format!(
                "a curved side of voussoir {k} is of more than one arc, which cannot be cut into subblocks: place joints \
                 where the arcs meet, set curved_sides to false, or leave accuracy.stress out"
            );
            faults.add("/accuracy/stress", detail);
        }
    }
    Some(accuracy)
}

/// What stands in the object itself.
pub fn checked(asked: &AccuracyRequest, faults: &mut Faults) -> Accuracy {
    let AccuracyRequest { collapse_intensity, stress, subblocks } = *asked;
    for (name, share) in [("collapse_intensity", collapse_intensity), ("stress", stress)] {
        if let Some(share) = share {
            faults.within(format!("/accuracy/{name}"), share, 0.0, 1.0);
        }
    }
    let some = collapse_intensity.is_some() || stress.is_some();
    faults.require(some, "/accuracy", "no accuracy is asked for: give collapse_intensity, stress or both");
    faults.counted("/accuracy/subblocks", subblocks, 1..=MAX_SUBBLOCKS, "subblocks");
    Accuracy { collapse_intensity, stress, most_subblocks: subblocks }
}
