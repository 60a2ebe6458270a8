//! Vehicles: where they stand, and on how much of the width.

use crate::wire::fault::Faults;
use crate::wire::prose::Digits;
use crate::wire::request::{AimRequest, AnalysisRequest, LoadRequest, VehicleLoad};

/// Whether every vehicle stands somewhere, on no more than there is.
pub fn check(request: &AnalysisRequest, faults: &mut Faults) {
    for (i, vehicle) in vehicles(request) {
        let Some(width) = request.width_m.filter(|width| *width < vehicle.effective_width_m) else { continue };
        let detail =
            format!("the structure is only {} m wide (width_m): no more than that carries a vehicle", Digits(width));
        faults.add(format!("/loads/{i}/load/vehicle/effective_width_m"), detail);
    }
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
