//! Half an arch: only of what is symmetric.

use super::arch;
use super::structure::Layout;
use crate::structure::{PointForce, Structure, is_symmetric};
use crate::wire::fault::Faults;
use crate::wire::request::{AnalysisRequest, ArchRequest, LoadEntry};

/// The left half of the arch of `request`.
pub fn halved(whole: &Structure, request: &ArchRequest, faults: &mut Faults) -> Structure {
    if let Some(voussoir) = whole.asymmetric_stone() {
        let other = whole.voussoirs().len() - 1 - voussoir;
        let detail = format!(
            "half an arch needs a symmetric one, but voussoir {voussoir} is not of the same stone as voussoir {other}, its mirror \
             image: give both the same, or set half to false"
        );
        faults.add("/arch/stone_of", detail);
    } else if let Some(joint) = whole.asymmetry() {
        let other = whole.voussoirs().len() - joint;
        let detail = format!(
            "half an arch needs a symmetric one, but joint {joint} is not the mirror image of joint {other} in place, \
             friction and cohesion: set half to false"
        );
        faults.add("/arch/half", detail);
    }
    let ring =
        (request.curved_sides && whole.keystone().is_some()).then(|| arch::ring(request, &mut Faults::default()));
    whole.left_half(ring.flatten().and_then(|ring| ring.left_half_of_keystone()))
}

/// Whether the fixed loads together, and the scaled loads together, are symmetric.
pub fn check_loads(request: &AnalysisRequest, entries: &[LoadEntry], whole: &Layout, faults: &mut Faults) {
    let mut lopsided = [false, true].map(|scaled| without_mirror_image(request, entries, whole, scaled)).concat();
    lopsided.sort_unstable();
    for i in lopsided {
        let which = if entries[i].scaled { "scaled" } else { "fixed" };
        let detail = format!(
            "half an arch needs {which} loads that are symmetric together, and this one has no mirror image among \
             them: add it, or set half to false"
        );
        faults.add(format!("/loads/{i}"), detail);
    }
}

/// Of the fixed, or of the scaled, loads those that lean to one side; none where together they do not.
fn without_mirror_image(request: &AnalysisRequest, entries: &[LoadEntry], whole: &Layout, scaled: bool) -> Vec<usize> {
    let (whole, names) = (&whole.structure, &whole.bodies);
    let symmetric = |forces: &[PointForce]| is_symmetric(forces, whole.voussoirs().len(), whole.axis());
    let (mut all, mut lopsided) = (Vec::new(), Vec::new());
    for (i, entry) in entries.iter().enumerate().filter(|(_, entry)| entry.scaled == scaled) {
        // A load that does not fit the arch has a fault of its own.
        let load = entry.load.in_si(names, request.backfill.as_ref());
        let coefficient = request.factors().of(entry) * entry.coefficient;
        let Some(Ok(forces)) = load.map(|load| load.on(whole, coefficient)) else {
            return Vec::new();
        };
        if !symmetric(&forces) {
            lopsided.push(i);
        }
        all.extend(forces);
    }
    if symmetric(&all) { Vec::new() } else { lopsided }
}
