//! The curved beam of a request.

use super::accuracy::check_drawing;
use super::stone;
use crate::collapse::{CurvedBeam, Order, Seams};
use crate::wire::fault::{Faults, Shown};
use crate::wire::request::{BeamRequest, Subblocks, SubblocksRequest};

/// Ratio of the radii for which the closed form keeps its digits.
const RATIO: [f64; 2] = [1.001, 1000.0];

/// The beam in SI; none where its mesh cannot be told.
pub fn beam(request: &BeamRequest, faults: &mut Faults) -> Option<CurvedBeam> {
    let (here, beam) = ("/curved_beam", &request.curved_beam);
    let (inner, outer, shear) = (beam.inner_radius_m, beam.outer_radius_m, beam.end_shear_n_per_m);
    let [least, most] = RATIO.map(|ratio| ratio * inner);
    let thick = outer > least && outer <= most;
    let detail = format!(
        "{} is no outer radius for this inner one: it must be greater than {} and at most {}",
        Shown(outer),
        Shown(least),
        Shown(most)
    );
    faults.require(thick, format!("{here}/outer_radius_m"), detail);
    faults.require(
        shear != 0.0,
        format!("{here}/end_shear_n_per_m"),
        "the end shear is the load: give one that is not 0",
    );
    let stone = stone::stone(&request.stone);
    let accuracy = request.accuracy.map(|accuracy| accuracy.stress);
    if accuracy.is_some() {
        let detail = "accuracy.stress finds the mesh itself: leave the subblocks out, or accuracy";
        let own = request.mesh.subblocks == BeamRequest::default_mesh().subblocks;
        faults.require(own, "/mesh/subblocks", detail);
        check_drawing(&request.mesh, "accuracy", faults);
        let detail = "stress converges with split seams only: set seams to `split`, or leave accuracy out";
        faults.require(request.mesh.seams == Seams::Split, "/mesh/seams", detail);
    }
    let (first, split) = (request.mesh.order() == Order::First, request.mesh.seams == Seams::Split);
    let detail = "subblocks of second order have no seams: set seams to `split`, or order to 1";
    faults.require(first || split, "/mesh/seams", detail);
    let Subblocks { radial, along } = subblocks(request, faults)?;
    Some(CurvedBeam {
        inner_radius: inner,
        outer_radius: outer,
        shear,
        stone,
        plane: request.stone.plane,
        subblocks: [radial, along],
        accuracy,
        seams: request.mesh.seams,
        order: request.mesh.order(),
        spacing: request.mesh.lines,
        curved_sides: beam.curved_sides,
    })
}

fn subblocks(request: &BeamRequest, faults: &mut Faults) -> Option<Subblocks> {
    match request.mesh.subblocks {
        SubblocksRequest::Uniform(subblocks) => Some(subblocks),
        SubblocksRequest::PerVoussoir(_) => {
            faults.add("/mesh/subblocks/per_voussoir", "the curved beam has no voussoirs: give `uniform` instead");
            None
        }
    }
}
