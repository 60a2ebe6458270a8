//! Vehicles: where they stand, and how much of them comes down on the structure.

use crate::structure::Structure;
use crate::structure::load::Load;
use crate::wire::fault::Faults;
use crate::wire::request::{AimRequest, AnalysisRequest, LoadEntry, LoadRequest, VehicleLoad};

/// Whether every vehicle stands somewhere.
pub fn check(request: &AnalysisRequest, faults: &mut Faults) {
    if matches!(request.analysis, AimRequest::WorstPosition(_)) {
        return;
    }
    for (i, vehicle) in vehicles(request) {
        let detail = "the abscissa of the vehicle's reference is missing: add it, or set analysis to `worst_position`";
        faults.require(vehicle.x_m.is_some(), format!("/loads/{i}/load/vehicle/x_m"), detail);
    }
}

/// The loads that are vehicles, with their numbers.
pub fn vehicles(request: &AnalysisRequest) -> impl Iterator<Item = (usize, &VehicleLoad)> {
    request.loads.iter().enumerate().filter_map(|(i, entry)| match &entry.load {
        LoadRequest::Vehicle(vehicle) => Some((i, vehicle)),
        _ => None,
    })
}

/// The share of every vehicle's force that comes down on the structure, with the number of its load.
pub fn arriving(request: &AnalysisRequest, structure: &Structure) -> Vec<(usize, f64)> {
    let share = |(i, entry): (usize, &LoadEntry)| match entry.load.in_si(&[])? {
        Load::Vehicle(vehicle) => Some((i, vehicle.arriving(structure).ok()?)),
        _ => None,
    };
    request.loads.iter().enumerate().filter_map(share).collect()
}
