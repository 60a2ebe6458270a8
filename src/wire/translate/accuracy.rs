//! An accuracy instead of a mesh.

use super::mesh::why_whole;
use super::structure::Layout;
use crate::collapse::{Accuracy, Geometry, Order, Seams, Spacing, can_be_refined, subblocks_of};
use crate::wire::fault::Faults;
use crate::wire::request::{
    AccuracyRequest, AimRequest, AnalysisRequest, MeshRequest, MethodRequest, SubblocksRequest,
};

/// The accuracy asked for, where one is.
pub fn accuracy(request: &AnalysisRequest, layout: Option<&Layout>, faults: &mut Faults) -> Option<Accuracy> {
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
    let stands = matches!(request.analysis, AimRequest::GeometricSafety(_));
    faults.require(!stands, "/accuracy", "geometric safety factors do not depend on a mesh: leave accuracy out");
    if asked.stress.is_some() {
        let own = request.mesh.subblocks == SubblocksRequest::default();
        let detail = "accuracy.stress finds the mesh itself: leave the subblocks out, or accuracy.stress";
        faults.require(own, "/mesh/subblocks", detail);
        check_drawing(&request.mesh, "accuracy.stress", faults);
        let detail = "stress converges with split seams only: set seams to `split`, or leave accuracy.stress out";
        faults.require(request.mesh.seams == Seams::Split, "/mesh/seams", detail);
        let refined = |layout: &Layout| layout.structure.voussoirs().iter().position(|body| !can_be_refined(body));
        if let Some((layout, body)) = layout.and_then(|layout| Some((layout, refined(layout)?))) {
            let coarsest = subblocks_of(&layout.structure.bodies[body], [2, 2], Order::First).unwrap_or([1, 1]);
            faults.add("/accuracy/stress", why_whole(layout, body, coarsest, "leave accuracy.stress out"));
        }
    }
    Some(accuracy)
}

/// How subblocks are drawn where their number is found by `asked`.
pub fn check_drawing(mesh: &MeshRequest, asked: &str, faults: &mut Faults) {
    let detail = |name: &str| format!("{asked} finds the mesh itself: leave {name} out, or {asked}");
    faults.require(mesh.order() == Order::First, "/mesh/order", detail("order"));
    faults.require(mesh.lines == Spacing::Even, "/mesh/lines", detail("lines"));
}

/// What stands in the object itself.
pub fn checked(asked: &AccuracyRequest, faults: &mut Faults) -> Accuracy {
    let AccuracyRequest { collapse_intensity, stress, subblocks } = *asked;
    let some = collapse_intensity.is_some() || stress.is_some();
    faults.require(some, "/accuracy", "no accuracy is asked for: give collapse_intensity, stress or both");
    Accuracy { collapse_intensity, stress, most_subblocks: subblocks }
}
