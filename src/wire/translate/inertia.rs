//! What the mass of fill does in an acceleration.

use super::loads::LoadForces;
use crate::structure::Structure;
use crate::structure::load::Fill;
use crate::wire::fault::Faults;
use crate::wire::request::{BackfillRequest, LoadEntry, LoadRequest};

/// Fill that has mass: a load of it, or the backfill.
pub struct Mass {
    fill: Fill,
    coefficient: f64,
    scaled: bool,
}

/// Adds what fill of these masses does in the acceleration `entry`. The force has the coefficients of both, and is scaled where
/// one of the two is, then with the partial factor `live`; masses have none. A fill that does not fit the arch has a fault of
/// its own.
pub fn add(
    masses: &[Mass],
    entry: &LoadEntry,
    live: f64,
    structure: &Structure,
    pieces: &[usize],
    forces: &mut LoadForces,
) {
    let LoadRequest::BodyAcceleration(body) = &entry.load else { return };
    for Mass { fill, coefficient, scaled } in masses {
        let scaled = entry.scaled || *scaled;
        let factor = if scaled { live } else { 1.0 };
        let acceleration = factor * entry.coefficient * coefficient * body.in_si();
        let carried = fill.inertia(structure, pieces, acceleration).unwrap_or_default();
        forces.of(scaled).extend(carried);
    }
}

/// How many forces the mass of fill puts on each voussoir.
pub fn forces_per_voussoir(entries: &[LoadEntry], backfill: Option<&BackfillRequest>) -> usize {
    let count = |fits: fn(&LoadRequest) -> bool| entries.iter().filter(|entry| fits(&entry.load)).count();
    let fills = count(|load| matches!(load, LoadRequest::FillPressure(_)));
    let accelerations = count(|load| matches!(load, LoadRequest::BodyAcceleration(_)));
    accelerations * (fills + backfill.map_or(0, BackfillRequest::forces_per_side))
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

/// All fill of a request.
pub fn masses(entries: &[LoadEntry], backfill: Option<&BackfillRequest>) -> Vec<Mass> {
    let loads = entries.iter().filter_map(|entry| match &entry.load {
        LoadRequest::FillPressure(fill) => {
            Some(Mass { fill: fill.in_si(backfill), coefficient: entry.coefficient, scaled: entry.scaled })
        }
        _ => None,
    });
    let below = backfill.and_then(BackfillRequest::in_si);
    loads.chain(below.map(|fill| Mass { fill, coefficient: 1.0, scaled: false })).collect()
}
