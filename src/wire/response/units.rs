//! Numbers that look as if they were in another unit.

use super::structure::StructureBody;
use crate::wire::prose::Digits;
use crate::wire::request::{AnalysisRequest, LoadRequest};

/// Densities that there are, of stone and of fill, kg/m3: from lightweight fill to ore.
const OF_STONE: [f64; 2] = [500.0, 5000.0];
const OF_FILL: [f64; 2] = [200.0, 3500.0];

/// Lengths that there are of masonry structures, and the greatest width, m.
const LENGTHS: [f64; 2] = [0.02, 1000.0];
const WIDEST: f64 = 200.0;

/// Below, a friction angle is none of stone, degrees: it may be a tangent, or in radians.
const LEAST_ANGLE: f64 = 5.0;

/// Below, an axle is none of a vehicle, N.
const LIGHTEST_AXLE: f64 = 1000.0;

/// A note on each.
pub(super) fn notes(request: &AnalysisRequest, structure: &StructureBody) -> Vec<String> {
    let all = [densities_of_stone(request), densities_of_fill(request), angles(request), axles(request)].concat();
    let all = all.into_iter().chain(length(structure)).chain(width(request));
    all.map(|said| format!("Is the unit right? {said}")).collect()
}

/// Those that lie outside; nothing may stand for what has no weight.
fn outside(
    values: impl IntoIterator<Item = f64>,
    [least, most]: [f64; 2],
    words: impl Fn(Digits) -> String,
) -> Vec<String> {
    let strange = values.into_iter().filter(|value| *value > 0.0 && !(least..=most).contains(value));
    strange.map(|value| words(Digits(value))).collect()
}

fn densities_of_stone(request: &AnalysisRequest) -> Vec<String> {
    let others = request.stones.iter().filter_map(|stone| stone.density_kg_m3);
    let all = std::iter::once(request.stone.density_kg_m3).chain(others);
    outside(all, OF_STONE, |density| format!("No stone has a density of {density} kg/m3; most have 1500 to 3000."))
}

fn densities_of_fill(request: &AnalysisRequest) -> Vec<String> {
    let of_backfill = request.backfill.iter().flat_map(|fill| {
        let layers = fill.layers.iter().map(|layer| layer.density_kg_m3);
        layers.chain(fill.backing.as_ref().map(|backing| backing.density_kg_m3)).chain([fill.density_kg_m3])
    });
    let of_loads = request.loads.iter().flat_map(|entry| match &entry.load {
        LoadRequest::FillPressure(fill) => vec![fill.fill_density_kg_m3, fill.embankment_density_kg_m3],
        _ => Vec::new(),
    });
    let words = |density| format!("Fill of {density} kg/m3 is none of soil; most has 1500 to 2300.");
    outside(of_backfill.chain(of_loads), OF_FILL, words)
}

fn angles(request: &AnalysisRequest) -> Vec<String> {
    let others = request.stones.iter().filter_map(|stone| stone.friction_angle_deg);
    let rings = request.bridge.iter().filter_map(|bridge| bridge.ring_friction_angle_deg);
    let all = std::iter::once(request.stone.friction_angle_deg).chain(others).chain(rings);
    outside(all, [LEAST_ANGLE, f64::INFINITY], |angle| {
        format!("A friction angle of {angle} degrees is next to none; joints of masonry have 25 to 40.")
    })
}

fn axles(request: &AnalysisRequest) -> Vec<String> {
    let forces = request.loads.iter().flat_map(|entry| match &entry.load {
        LoadRequest::Vehicle(vehicle) => {
            vehicle.axles.as_deref().unwrap_or_default().iter().map(|axle| axle.force_n).collect()
        }
        _ => Vec::new(),
    });
    outside(forces, [LIGHTEST_AXLE, f64::INFINITY], |force| {
        format!("An axle of {force} N is lighter than that of a cart; forces of axles are in N.")
    })
}

fn length(structure: &StructureBody) -> Vec<String> {
    let across = structure.bodies.iter().flat_map(|body| &body.corners_m).map(|corner| corner[0]);
    let [first, last] = across.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
    outside([last - first], LENGTHS, |length| format!("The structure is {length} m long: lengths are in metres."))
}

fn width(request: &AnalysisRequest) -> Vec<String> {
    outside(request.width_m, [0.0, WIDEST], |width| format!("The structure is {width} m wide: width_m is in metres."))
}
