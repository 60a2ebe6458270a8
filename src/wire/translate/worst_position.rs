//! The worst position of vehicles: what moves, and where to.

use super::site::Unloaded;
use super::vehicle::vehicles;
use crate::collapse::{Direction, MovingVehicle, PositionQuestion, Sweep};
use crate::structure::Structure;
use crate::structure::load::{Load, Vehicle};
use crate::wire::fault::{Faults, Shown};
use crate::wire::request::{
    AnalysisRequest, DrivingRequest, LoadEntry, LoadRequest, VehicleLoad, WorstPositionRequest,
};

/// Most positions of the grid.
const MOST_POSITIONS: usize = 2000;
/// Most looks at what of an axle comes down on a face, at all of them: some tenths of a second.
const MOST_LOOKS: usize = 4_000_000;

const HERE: &str = "/analysis/worst_position";

/// The question, where it can be asked.
pub fn question(site: &Unloaded<'_>, asked: &WorstPositionRequest, faults: &mut Faults) -> Option<PositionQuestion> {
    let request = site.request;
    check(request, asked, faults);
    let (moving, standing): (Vec<LoadEntry>, Vec<LoadEntry>) = request.loads.iter().cloned().partition(moves);
    let structure = &site.layout()?.structure;
    // All loads, with the vehicles over the middle, so that their faults have their own places.
    let vehicles: Vec<MovingVehicle> = moving.iter().filter_map(|entry| vehicle(request, entry)).collect();
    let middle = structure.surfaces.get(structure.surfaces.len() / 2).map_or(0.0, |surface| surface.ends[0].x);
    let ahead = vehicles.first().and_then(|moving| moving.vehicle.patches().next()).map_or(0.0, |axle| axle.centre);
    site.analysis(&placed(request, middle - ahead, None).loads, faults);
    if !faults.is_empty() {
        return None;
    }
    let sweeps = sweeps(structure, &vehicles, asked);
    check_positions(request, structure, &vehicles, &sweeps, faults);
    let analysis = site.analysis(&standing, faults)?;
    Some(PositionQuestion { analysis, vehicles, pieces: site.pieces(), sweeps, tolerance: asked.tolerance })
}

/// The same request with the vehicles that move at an abscissa, standing as they do or as is said here.
pub fn placed(request: &AnalysisRequest, x: f64, reversed: Option<bool>) -> AnalysisRequest {
    let mut request = request.clone();
    for entry in &mut request.loads {
        if let LoadRequest::Vehicle(vehicle) = &mut entry.load
            && vehicle.x_m.is_none()
        {
            vehicle.x_m = Some(x);
            vehicle.reversed = reversed.unwrap_or(vehicle.reversed);
        }
    }
    request
}

fn moves(entry: &LoadEntry) -> bool {
    matches!(&entry.load, LoadRequest::Vehicle(vehicle) if vehicle.x_m.is_none())
}

fn vehicle(request: &AnalysisRequest, entry: &LoadEntry) -> Option<MovingVehicle> {
    let Some(Load::Vehicle(vehicle)) = entry.load.in_si(&[], request.backfill.as_ref()) else { return None };
    let coefficient = request.factors().of(entry) * entry.coefficient;
    Some(MovingVehicle { vehicle, coefficient, scaled: entry.scaled })
}

fn check(request: &AnalysisRequest, asked: &WorstPositionRequest, faults: &mut Faults) {
    let moving: Vec<(usize, &VehicleLoad)> = vehicles(request).filter(|(i, _)| moves(&request.loads[*i])).collect();
    let grows = moving.iter().any(|(i, _)| request.loads[*i].scaled);
    let detail = "no vehicle moves and grows: add a scaled vehicle without x_m to loads";
    faults.require(grows, HERE, detail);
    for (i, vehicle) in moving.iter().skip(1) {
        let detail = "vehicles that move together stand the same way: give all the same reversed";
        let same = vehicle.reversed == moving[0].1.reversed;
        faults.require(same, format!("/loads/{i}/load/vehicle/reversed"), detail);
    }
    for (i, _) in &moving {
        let detail = "the forces of a vehicle that moves act downwards: give a positive coefficient";
        faults.require(request.loads[*i].coefficient > 0.0, format!("/loads/{i}/coefficient"), detail);
    }
    if let (Some(from), Some(to)) = (asked.from_m, asked.to_m) {
        let detail = format!("positions run to the right: to_m must be greater than from_m, {}", Shown(from));
        faults.require(to > from, format!("{HERE}/to_m"), detail);
    }
    let increases = request.load_factor.direction == Direction::Increase;
    let detail = "the worst position is that of the least load factor upwards: set direction to `increase`";
    faults.require(increases, "/load_factor/direction", detail);
    let detail = "a vehicle has no mirror image on half an arch: set half to false, or leave worst_position out";
    faults.require(!request.half(), "/arch/half", detail);
}

/// From where to where, in every direction asked for; a vehicle that is its own mirror image has one direction.
fn sweeps(structure: &Structure, vehicles: &[MovingVehicle], asked: &WorstPositionRequest) -> Vec<Sweep> {
    let given = vehicles[0].vehicle.reversed;
    let turned_is_elsewhere = vehicles.len() == 1 && vehicles[0].vehicle.is_symmetric();
    let both = asked.directions == DrivingRequest::Both && !turned_is_elsewhere;
    let reach = |reversed: bool| {
        let of = |moving: &MovingVehicle| Vehicle { reversed, ..moving.vehicle.clone() }.reach(structure);
        let widest = |[a, b]: [f64; 2], [from, to]: [f64; 2]| [a.min(from), b.max(to)];
        vehicles.iter().map(of).fold([f64::INFINITY, f64::NEG_INFINITY], widest)
    };
    let sweep = |reversed: bool| {
        let [from, to] = reach(reversed);
        // Whole steps: positions that are easily read.
        let [from, to] = [(from / asked.step_m).floor(), (to / asked.step_m).ceil()].map(|steps| steps * asked.step_m);
        Sweep { from: asked.from_m.unwrap_or(from), to: asked.to_m.unwrap_or(to), step: asked.step_m, reversed }
    };
    [given].into_iter().chain(both.then_some(!given)).map(sweep).collect()
}

/// Whether there are positions, not too many, and the vehicles fit the structure at all of them.
fn check_positions(
    request: &AnalysisRequest,
    structure: &Structure,
    moving: &[MovingVehicle],
    sweeps: &[Sweep],
    faults: &mut Faults,
) {
    for sweep in sweeps {
        let detail =
            "nothing of the vehicle comes down on the structure there: correct from_m and to_m or leave them out";
        if !faults.require(sweep.to > sweep.from, format!("{HERE}/from_m"), detail) {
            return;
        }
    }
    let positions: usize = sweeps.iter().map(|sweep| sweep.parts() + 1).sum();
    let detail = format!("{positions} positions are too many: keep to {MOST_POSITIONS} by a larger step_m");
    if !faults.require(positions <= MOST_POSITIONS, format!("{HERE}/step_m"), detail) {
        return;
    }
    let axles: usize = moving.iter().map(|moving| moving.vehicle.patches().count()).sum();
    let looks = positions * axles * structure.surfaces.len();
    let detail =
        format!("positions times axles times upper faces come to {looks}: keep to {MOST_LOOKS} by a larger step_m");
    if !faults.require(looks <= MOST_LOOKS, format!("{HERE}/step_m"), detail) {
        return;
    }
    let numbers = vehicles(request).map(|(i, _)| i).filter(|&i| moves(&request.loads[i]));
    for (i, MovingVehicle { vehicle, coefficient, .. }) in numbers.zip(moving) {
        let places = sweeps.iter().flat_map(|sweep| sweep.positions().map(|x| (x, sweep.reversed)));
        let on = |x: f64, reversed: bool| Load::Vehicle(vehicle.at(x, reversed)).on(structure, *coefficient);
        let fault = places.map(|(x, reversed)| (x, on(x, reversed))).find_map(|(x, forces)| Some((x, forces.err()?)));
        if let Some((x, fault)) = fault {
            let field = match request.loads[i].load.field_of(fault) {
                Some("x_m") | None => format!("{HERE}/from_m"),
                Some(field) => format!("/loads/{i}/load/vehicle/{field}"),
            };
            faults.add(field, format!("with the vehicle at x = {} m {fault}: correct it", Shown(x)));
        }
    }
}
