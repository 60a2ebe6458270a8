//! What the mass of fill does in an acceleration.

use super::loads::LoadForces;
use crate::structure::Structure;
use crate::structure::load::Fill;
use crate::wire::fault::Faults;
use crate::wire::request::{LoadEntry, LoadRequest};

/// Adds what all fill among `entries` does in the acceleration `entry`. The force has the coefficients of both, and is scaled
/// where one of the two is. A fill that does not fit the arch has a fault of its own.
pub fn add(entries: &[LoadEntry], entry: &LoadEntry, structure: &Structure, pieces: &[usize], forces: &mut LoadForces) {
    let LoadRequest::BodyAcceleration(body) = &entry.load else { return };
    for (other, fill) in fills(entries) {
        let acceleration = entry.coefficient * other.coefficient * body.in_si();
        let carried = fill.inertia(structure, pieces, acceleration).unwrap_or_default();
        forces.of(entry.scaled || other.scaled).extend(carried);
    }
}

/// How many forces the mass of fill puts on each voussoir.
pub fn forces_per_voussoir(entries: &[LoadEntry]) -> usize {
    let accelerations = entries.iter().filter(|entry| matches!(entry.load, LoadRequest::BodyAcceleration(_)));
    accelerations.count() * fills(entries).count()
}

/// Whether the forces are in proportion to the load factor: those of scaled fill in a scaled acceleration are not.
pub fn check(entries: &[LoadEntry], faults: &mut Faults) {
    let scaled = |fits: fn(&LoadRequest) -> bool| entries.iter().position(|entry| entry.scaled && fits(&entry.load));
    let fill = scaled(|load| matches!(load, LoadRequest::FillPressure(_)));
    let acceleration = scaled(|load| matches!(load, LoadRequest::BodyAcceleration(_)));
    let (Some(fill), Some(acceleration)) = (fill, acceleration) else { return };
    let detail = format!(
        "fill has mass, and scaled fill (/loads/{fill}) in a scaled acceleration would push with the square of the load \
         factor: set scaled to false in one of the two"
    );
    faults.add(format!("/loads/{acceleration}/scaled"), detail);
}

fn fills(entries: &[LoadEntry]) -> impl Iterator<Item = (&LoadEntry, Fill)> {
    entries.iter().filter_map(|entry| match &entry.load {
        LoadRequest::FillPressure(fill) => Some((entry, fill.in_si())),
        _ => None,
    })
}
