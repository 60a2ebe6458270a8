//! The curved beam of a request.

use super::{MAX_FORCE_N_PER_M, MAX_LENGTH_M, check_text, mesh, stone};
use crate::api::fault::Faults;
use crate::api::request::{BeamRequest, Subblocks, SubblocksRequest};
use crate::collapse::CurvedBeam;

/// Ratio of the radii for which the closed form keeps its digits.
const RATIO: [f64; 2] = [1.001, 1000.0];

/// The beam in SI; none where its mesh cannot be told.
pub fn beam(request: &BeamRequest, faults: &mut Faults) -> Option<CurvedBeam> {
    check_text("/name", request.name.as_deref().unwrap_or(""), faults);
    let (here, beam) = ("/curved_beam", &request.curved_beam);
    let (inner, outer, shear) = (beam.inner_radius_m, beam.outer_radius_m, beam.end_shear_n_per_m);
    if faults.within(format!("{here}/inner_radius_m"), inner, 0.0, MAX_LENGTH_M) {
        let most = (RATIO[1] * inner).min(MAX_LENGTH_M);
        faults.within(format!("{here}/outer_radius_m"), outer, RATIO[0] * inner, most);
    }
    let detail =
        format!("{shear} is out of range: it lies between -{MAX_FORCE_N_PER_M} and {MAX_FORCE_N_PER_M} and is not 0");
    let loaded = shear != 0.0 && shear.abs() <= MAX_FORCE_N_PER_M;
    faults.require(loaded, format!("{here}/end_shear_n_per_m"), detail);
    let stone = stone::stone(&request.stone, faults);
    let Subblocks { radial, along } = subblocks(request, faults)?;
    Some(CurvedBeam {
        inner_radius: inner,
        outer_radius: outer,
        shear,
        stone,
        plane: request.stone.plane.into(),
        subblocks: [radial, along],
        seams: request.mesh.seams.into(),
        curved_sides: beam.curved_sides,
    })
}

fn subblocks(request: &BeamRequest, faults: &mut Faults) -> Option<Subblocks> {
    match request.mesh.subblocks {
        SubblocksRequest::Uniform(subblocks) => {
            mesh::check("/mesh/subblocks/uniform", subblocks, faults);
            Some(subblocks)
        }
        SubblocksRequest::PerVoussoir(_) => {
            faults.add("/mesh/subblocks/per_voussoir", "the curved beam has no voussoirs: give `uniform` instead");
            None
        }
    }
}
