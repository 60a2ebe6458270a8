//! The backfill of a request: what is wrong with it, and its weight.

use super::structure::Layout;
use crate::structure::load::Load;
use crate::structure::{PassiveElement, PointForce, Structure, is_symmetric};
use crate::wire::fault::Faults;
use crate::wire::request::AnalysisRequest;

const HERE: &str = "/backfill";

/// The weight of the backfill and what it presses in any case, where there is one, on the whole structure with the sides of its
/// bodies cut into `pieces` each.
pub fn weight(
    request: &AnalysisRequest,
    whole: Option<&Layout>,
    pieces: &[usize],
    faults: &mut Faults,
) -> Vec<PointForce> {
    let Some(backfill) = &request.backfill else { return Vec::new() };
    let detail = "blocks have no extrados for fill to lie on: leave this out, and give a point_force on each block that carries it";
    let lies = faults.require(request.blocks.is_none(), HERE, detail);
    backfill.check(HERE, faults);
    let (Some(fill), Some(layout), true) = (backfill.in_si(), whole, lies) else { return Vec::new() };
    let factors = request.factors();
    let passive = backfill.resists().map(|passive| factors.on_passive(passive).of(&fill, &layout.structure));
    let mut forces = Load::Fill(fill).on_pieces(&layout.structure, pieces, factors.fill).unwrap_or_default();
    let detail = "none of its weight lies on the structure: raise its surface, give it a density, or leave it out";
    faults.require(!forces.is_empty(), HERE, detail);
    let structure = &layout.structure;
    // An arch that is not symmetric itself has a fault of its own.
    let symmetric =
        || structure.asymmetry().is_some() || is_symmetric(&forces, structure.voussoirs().len(), structure.axis());
    if request.half() && !symmetric() {
        let detail = "half an arch needs a symmetric surface, and this one is not its own mirror image about the axis of the \
                      arch: correct it, or set half to false";
        faults.add(format!("{HERE}/surface_m"), detail);
    }
    forces.extend(passive.into_iter().flat_map(|(_, always)| always));
    forces
}

/// The passive elements of the backfill on a structure.
pub fn resistance(request: &AnalysisRequest, structure: &Structure) -> Vec<PassiveElement> {
    let fill = request.backfill.as_ref().and_then(|backfill| Some((backfill.resists()?, backfill.in_si()?)));
    fill.map_or(Vec::new(), |(passive, fill)| request.factors().on_passive(passive).of(&fill, structure).0)
}
