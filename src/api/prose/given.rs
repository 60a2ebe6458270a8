//! What was given, in words: the structure and its loads.

use super::noun::noun;
use crate::api::prose::Digits;
use crate::api::request::{
    AnalysisRequest, ArchRequest, BridgeRequest, FillPressure, LoadEntry, LoadRequest, PointLoad, ProfileRequest,
};

/// What the structure is called, and the structure in a few words.
pub fn structure(request: &AnalysisRequest) -> (&'static str, String) {
    let words = match request {
        AnalysisRequest { arch: Some(request), .. } => arch(request),
        AnalysisRequest { bridge: Some(request), .. } => bridge(request),
        AnalysisRequest { blocks: Some(request), .. } => {
            format!("blocks: {}, supports: {}", request.polygons.len(), request.supports.len())
        }
        _ => "-".to_owned(),
    };
    (noun(request), words)
}

fn bridge(bridge: &BridgeRequest) -> String {
    let rings = bridge.spans.iter().map(|span| span.rings.len().to_string()).collect::<Vec<_>>().join(", ");
    let backing =
        bridge.backing.as_ref().map_or(String::new(), |b| format!(", backing up to y = {} m", Digits(b.level_m)));
    let spans = if bridge.spans.len() == 1 { "span" } else { "spans" };
    format!("{} {spans}, rings in each: {rings}{backing}", bridge.spans.len())
}

/// The arch in a few words.
fn arch(arch: &ArchRequest) -> String {
    let (shape, joints) = match &arch.profile {
        ProfileRequest::Circular(_) => ("circular", 0),
        ProfileRequest::Pointed(_) => ("pointed", 0),
        ProfileRequest::Elliptical(_) => ("elliptical", 0),
        ProfileRequest::MultiCentre(_) => ("multi-centre", 0),
        ProfileRequest::Surveyed(surveyed) => ("surveyed", surveyed.intrados_m.len()),
    };
    let count = arch.voussoirs.unwrap_or(joints.saturating_sub(1));
    let half = match (arch.half, count.is_multiple_of(2)) {
        (false, _) => "",
        (true, true) => ", the left half of it against a frictionless wall",
        (true, false) => ", the left half of it, the keystone cut on the axis",
    };
    format!("{shape}, {count} voussoirs, {} joints{half}", count + 1)
}

/// Most loads listed, beside fill, which always is.
const LOADS_LISTED: usize = 6;

/// The fixed or the scaled loads, a line each.
pub fn loads(entries: &[LoadEntry], scaled: bool) -> String {
    let entries: Vec<&LoadEntry> = entries.iter().filter(|entry| entry.scaled == scaled).collect();
    let listed =
        |(i, entry): &(usize, &&LoadEntry)| *i < LOADS_LISTED || matches!(entry.load, LoadRequest::FillPressure(_));
    let mut lines: Vec<String> = entries
        .iter()
        .enumerate()
        .filter(listed)
        .map(|(_, entry)| match (entry.coefficient == 1.0, entry.per_abscissa) {
            (true, false) => load(&entry.load),
            (false, false) => format!("{} times: {}", Digits(entry.coefficient), load(&entry.load)),
            (true, true) => format!("abscissa times: {}", load(&entry.load)),
            (false, true) => format!("{} times abscissa times: {}", Digits(entry.coefficient), load(&entry.load)),
        })
        .collect();
    let more = entries.len() - lines.len();
    if more > 0 {
        lines.push(format!("and {more} more"));
    }
    if lines.is_empty() { "none".to_owned() } else { lines.join("\n") }
}

fn load(load: &LoadRequest) -> String {
    match load {
        LoadRequest::SelfWeight(_) => "self weight".to_owned(),
        LoadRequest::FillPressure(pressure) => fill(pressure),
        LoadRequest::LateralPressure(lateral) => format!("lateral pressure, bands of height: {}", lateral.bands.len()),
        LoadRequest::PointLoad(point) => {
            format!("{} kN/m {}", Digits(point.force_n_per_m / 1e3), place(point))
        }
        LoadRequest::PatchLoad(patch) => {
            let [force, width, centre] = [patch.force_n_per_m / 1e3, patch.width_m, patch.centre_x_m].map(Digits);
            format!("{force} kN/m, spread over {width} m about x = {centre} m")
        }
        LoadRequest::PointForce(force) => {
            let [fx, fy] = force.force_n_per_m.map(|force| Digits(force / 1e3));
            let [x, y] = force.at_m.map(Digits);
            format!("({fx}, {fy}) kN/m on {} at ({x}, {y}) m", force.block)
        }
        LoadRequest::BodyAcceleration(body) => {
            format!("acceleration of {} g to the right, {} g upwards", Digits(body.x_g), Digits(body.y_g))
        }
    }
}

/// Fill with all that is assumed of it.
fn fill(fill: &FillPressure) -> String {
    let density = |density: f64| format!("{} kg/m3", Digits(density));
    let level = fill.fill_height_m.map(|height| {
        let density = density(fill.fill_density_kg_m3);
        format!("fill of {density} up to y = {} m", Digits(height))
    });
    let above = (fill.embankment_thickness_m > 0.0).then(|| {
        let (density, thickness) = (density(fill.embankment_density_kg_m3), Digits(fill.embankment_thickness_m));
        let bare = if level.is_none() { " on the extrados" } else { "" };
        format!("{thickness} m of embankment of {density}{bare}")
    });
    let what = level.into_iter().chain(above).collect::<Vec<_>>().join(" and ");
    let ratio = Digits(fill.ratio());
    let horizontal = match fill.fill_friction_angle_deg {
        _ if fill.ratio() == 0.0 => "no horizontal pressure".to_owned(),
        Some(angle) => format!("horizontal pressure {ratio} of the vertical (at rest, 1 - sin {} deg)", Digits(angle)),
        None => format!("horizontal pressure {ratio} of the vertical (as given)"),
    };
    format!("{what}; {horizontal}")
}

fn place(point: &PointLoad) -> String {
    match (point.x_m, point.voussoir) {
        (None, Some(voussoir)) => format!("on voussoir {voussoir}"),
        (x, _) => format!("at x = {} m", Digits(x.unwrap_or(0.0))),
    }
}
