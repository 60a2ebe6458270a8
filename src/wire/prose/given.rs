//! What was given, in words: the structure and its loads.

use super::noun::noun;
use crate::wire::prose::Digits;
use crate::wire::request::{AnalysisRequest, ArchRequest, BridgeRequest, LoadEntry, LoadRequest, ProfileRequest};

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

/// The fixed or the scaled loads, a line each; the backfill is among the fixed ones.
pub fn loads(request: &AnalysisRequest, scaled: bool) -> String {
    let backfill = request.backfill.as_ref();
    let entries: Vec<&LoadEntry> = request.loads.iter().filter(|entry| entry.scaled == scaled).collect();
    let listed =
        |(i, entry): &(usize, &&LoadEntry)| *i < LOADS_LISTED || matches!(entry.load, LoadRequest::FillPressure(_));
    let mut lines: Vec<String> = entries
        .iter()
        .enumerate()
        .filter(listed)
        .map(|(_, entry)| match (entry.coefficient == 1.0, entry.per_abscissa) {
            (true, false) => entry.load.words(backfill),
            (false, false) => format!("{} times: {}", Digits(entry.coefficient), entry.load.words(backfill)),
            (true, true) => format!("abscissa times: {}", entry.load.words(backfill)),
            (false, true) => {
                format!("{} times abscissa times: {}", Digits(entry.coefficient), entry.load.words(backfill))
            }
        })
        .collect();
    let more = entries.len() - lines.len();
    if more > 0 {
        lines.push(format!("and {more} more"));
    }
    if let Some(backfill) = backfill.filter(|_| !scaled) {
        lines.insert(0, backfill.words());
    }
    if lines.is_empty() { "none".to_owned() } else { lines.join("\n") }
}
