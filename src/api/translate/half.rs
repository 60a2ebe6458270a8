//! Half an arch: only of what is symmetric.

use super::{arch, loads};
use crate::api::fault::Faults;
use crate::api::request::{AnalysisRequest, ArchRequest, LoadEntry};
use crate::arch::{Arch, PointForce, is_symmetric};

/// The left half of the arch of `request`.
pub fn halved(arch: &Arch, request: &ArchRequest, faults: &mut Faults) -> Arch {
    if let Some(joint) = arch.asymmetry() {
        let other = arch.voussoirs.len() - joint;
        let detail = format!(
            "half an arch needs a symmetric one, but joint {joint} is not the mirror image of joint {other} in place, \
             friction and cohesion: set half to false"
        );
        faults.add("/arch/half", detail);
    }
    let ring = (request.curved_sides && arch.keystone().is_some()).then(|| arch::ring(request, &mut Faults::default()));
    arch.left_half(ring.flatten().and_then(|ring| ring.left_half_of_keystone()))
}

/// Whether the fixed loads together, and the scaled loads together, are symmetric.
pub fn check_loads(request: &AnalysisRequest, entries: &[LoadEntry], arch: &Arch, faults: &mut Faults) {
    let density = request.stone.density_kg_m3;
    let mut lopsided = [false, true].map(|scaled| without_mirror_image(entries, density, arch, scaled)).concat();
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
fn without_mirror_image(entries: &[LoadEntry], density: f64, arch: &Arch, scaled: bool) -> Vec<usize> {
    let symmetric = |forces: &[PointForce]| is_symmetric(forces, arch.voussoirs.len(), arch.axis());
    let (mut all, mut lopsided) = (Vec::new(), Vec::new());
    for (i, entry) in entries.iter().enumerate().filter(|(_, entry)| entry.scaled == scaled) {
        // A load that does not fit the arch has a fault of its own.
        let Ok(forces) = loads::load(&entry.load, density).on(arch, entry.coefficient) else {
            return Vec::new();
        };
        if !symmetric(&forces) {
            lopsided.push(i);
        }
        all.extend(forces);
    }
    if symmetric(&all) { Vec::new() } else { lopsided }
}
