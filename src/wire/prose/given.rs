//! What was given, in words: the structure and its loads.

use super::noun::noun;
use crate::wire::prose::Digits;
use crate::wire::request::{
    AnalysisRequest, ArchRequest, BridgeRequest, JointOverride, LoadEntry, LoadRequest, NamedStone, ProfileRequest,
    StoneOf, StoneRequest,
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
    let smoothed = match &arch.profile {
        ProfileRequest::Surveyed(surveyed) => surveyed.smoothing_length_m,
        _ => None,
    };
    let smoothed = smoothed.map(|length| format!(", smoothed over {} m", Digits(length))).unwrap_or_default();
    let count = arch.voussoirs.unwrap_or(joints.saturating_sub(1));
    let half = match (arch.half, count.is_multiple_of(2)) {
        (false, _) => "",
        (true, true) => ", the left half of it against a frictionless wall",
        (true, false) => ", the left half of it, the keystone cut on the axis",
    };
    let part = |part: &StoneOf| match part.from == part.to {
        true => format!("; voussoir {} of {}", part.from, part.stone),
        false => format!("; voussoirs {} to {} of {}", part.from, part.to, part.stone),
    };
    let parts: String = arch.stone_of.iter().take(STONES_LISTED).map(part).collect();
    let more = if arch.stone_of.len() > STONES_LISTED { "; and so on" } else { "" };
    format!("{shape}{smoothed}, {count} voussoirs, {} joints{half}{parts}{more}", count + 1)
}

/// Most runs of voussoirs of other stones that are listed.
const STONES_LISTED: usize = 6;

/// What marks a value that is the default.
pub fn mark(value: f64, default: f64) -> &'static str {
    if value == default { " (default)" } else { "" }
}

/// A value in words, marked where it is the default.
pub fn or_default(words: impl Fn(f64) -> String, value: f64, default: f64) -> String {
    format!("{}{}", words(value), mark(value, default))
}

/// The stone, and others in what they differ from it; strengths stand elsewhere.
pub fn stone(request: &AnalysisRequest) -> String {
    let (stone, default) = (&request.stone, StoneRequest::default());
    let density = |density: f64| format!("{} kg/m3", Digits(density));
    let modulus = |modulus: f64| format!("Young's modulus {} GPa", Digits(modulus / 1e9));
    let friction = |angle: f64| format!("friction of joints {} deg", Digits(angle));
    let cohesion = |cohesion: f64| format!("cohesion {} kPa", Digits(cohesion / 1e3));
    let mut of_most = vec![
        or_default(density, stone.density_kg_m3, default.density_kg_m3),
        or_default(modulus, stone.youngs_modulus_pa, default.youngs_modulus_pa),
        or_default(friction, stone.friction_angle_deg, default.friction_angle_deg),
    ];
    of_most.extend((stone.cohesion_pa > 0.0).then(|| cohesion(stone.cohesion_pa)));
    let other = |other: &NamedStone| {
        let parts = [
            other.density_kg_m3.map(density),
            other.youngs_modulus_pa.map(modulus),
            other.friction_angle_deg.map(friction),
            other.cohesion_pa.map(cohesion),
        ];
        let parts: Vec<String> = parts.into_iter().flatten().collect();
        (!parts.is_empty()).then(|| format!("; {}: {}", other.name, parts.join(", ")))
    };
    let others: String = request.stones.iter().filter_map(other).collect();
    format!("{}{others}", of_most.join(", "))
}

/// Strength beyond that of any matter, Pa: the request means none.
const NO_LIMIT_PA: f64 = 1e15;

/// Whether a stone of this strength crushes at all.
pub fn crushes(strength: f64) -> bool {
    strength < NO_LIMIT_PA
}

/// Compressive strength of the stone, and of others that have one of their own.
pub fn strengths(request: &AnalysisRequest) -> String {
    let over = match request.factors().stone_strength {
        1.0 => String::new(),
        factor => format!(" / {}", Digits(factor)),
    };
    let words = |strength: f64, mark: &str| match crushes(strength) {
        true => format!("{} MPa{mark}{over}", Digits(strength / 1e6)),
        false => "not limited".to_owned(),
    };
    let other = |stone: &NamedStone| Some(format!("; {}: {}", stone.name, words(stone.compressive_strength_pa?, "")));
    let others: String = request.stones.iter().filter_map(other).collect();
    let (strength, default) = (request.stone.compressive_strength_pa, StoneRequest::default().compressive_strength_pa);
    format!("{}{others}", words(strength, mark(strength, default)))
}

/// Most joints that are listed.
const JOINTS_LISTED: usize = 6;

/// The joints that differ from the rest.
pub fn altered_joints(overrides: &[JointOverride]) -> Option<String> {
    let part =
        |name: &str, value: Option<f64>, unit: &str| value.map(|value| format!("{name} {}{unit}", Digits(value)));
    let joint = |of: &JointOverride| {
        let parts = [
            part("friction", of.friction_angle_deg, " deg"),
            part("cohesion", of.cohesion_pa, " Pa"),
            part("lost at the intrados", of.lost_at_intrados_m, " m"),
            part("lost at the extrados", of.lost_at_extrados_m, " m"),
        ];
        format!("{}: {}", of.joint, parts.into_iter().flatten().collect::<Vec<_>>().join(", "))
    };
    let more = overrides.len().saturating_sub(JOINTS_LISTED);
    let more = if more > 0 { format!("; and {more} more") } else { String::new() };
    let listed = overrides.iter().take(JOINTS_LISTED).map(joint).collect::<Vec<_>>().join("; ");
    (!overrides.is_empty()).then(|| format!("{listed}{more}"))
}

/// Most loads listed, beside fill, which always is.
const LOADS_LISTED: usize = 6;

/// What multiplies a load, in words.
fn factored(factor: f64) -> String {
    if factor == 1.0 { String::new() } else { format!("partial factor {} times: ", Digits(factor)) }
}

/// The fixed or the scaled loads, a line each; the backfill is among the fixed ones.
pub fn loads(request: &AnalysisRequest, scaled: bool) -> String {
    let (backfill, factors) = (request.backfill.as_ref(), request.factors());
    let entries: Vec<&LoadEntry> = request.loads.iter().filter(|entry| entry.scaled == scaled).collect();
    let listed =
        |(i, entry): &(usize, &&LoadEntry)| *i < LOADS_LISTED || matches!(entry.load, LoadRequest::FillPressure(_));
    let mut lines: Vec<String> = entries
        .iter()
        .enumerate()
        .filter(listed)
        .map(|(_, entry)| {
            let times = match (entry.coefficient == 1.0, entry.per_abscissa) {
                (true, false) => String::new(),
                (false, false) => format!("{} times: ", Digits(entry.coefficient)),
                (true, true) => "abscissa times: ".to_owned(),
                (false, true) => format!("{} times abscissa times: ", Digits(entry.coefficient)),
            };
            format!("{}{times}{}", factored(factors.of(entry)), entry.load.words(backfill))
        })
        .collect();
    let more = entries.len() - lines.len();
    if more > 0 {
        lines.push(format!("and {more} more"));
    }
    if let Some(backfill) = backfill.filter(|_| !scaled) {
        let over = match factors.soil_resistance {
            1.0 => String::new(),
            factor => format!("; its resistance is divided by the partial factor {}", Digits(factor)),
        };
        lines.insert(0, format!("{}{}{over}", factored(factors.fill), backfill.words()));
    }
    if lines.is_empty() { "none".to_owned() } else { lines.join("\n") }
}
