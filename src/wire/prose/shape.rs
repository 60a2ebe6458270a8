//! The size and shape of what was analysed, in words, so that a slip in the request shows.

use crate::wire::prose::Digits;
use crate::wire::request::{BridgeAbutment, BridgeRequest, PierRequest, RingRequest, SpanRequest};
use crate::wire::response::{AnalysisResult, JointBody, StructureBody};

/// Most lines of a bridge.
const LINES: usize = 8;

/// Size and shape, as they were set out; none of half an arch.
pub fn shape(result: &AnalysisResult) -> Option<String> {
    let (request, structure) = (&result.request, &result.structure);
    match (&request.arch, &request.bridge) {
        (Some(arch), _) if arch.half => None,
        (Some(_), _) => arch(structure),
        (None, Some(request)) => Some(bridge(request, structure)),
        (None, None) => Some(extent(structure)),
    }
}

fn arch(structure: &StructureBody) -> Option<String> {
    let voussoirs = structure.bodies.iter().filter(|body| body.name.starts_with("voussoir")).count();
    let ring: Vec<_> = structure.joints.iter().take(voussoirs + 1).collect();
    let length = |joint: &JointBody| {
        let [[a, b], [c, d]] = joint.ends_m;
        Digits((c - a).hypot(d - b))
    };
    let joints = [length(ring.first()?), length(ring.get(voussoirs / 2)?)];
    Some(format!("{}; joints {} m long at the springing, {} m at the crown", intrados(&ring)?, joints[0], joints[1]))
}

/// Span and rise of a ring between its first joint and its last.
fn intrados(ring: &[&JointBody]) -> Option<String> {
    let end = |joint: &JointBody| joint.ends_m[0];
    let ([a, b], [c, d]) = (end(ring.first()?), end(ring.last()?));
    let top = ring.iter().map(|joint| end(joint)[1]).fold(f64::NEG_INFINITY, f64::max);
    let [span, rise] = [(c - a).hypot(d - b), top - 0.5 * (b + d)].map(Digits);
    Some(format!("clear span {span} m, rise {rise} m to the highest joint"))
}

/// A line for all spans, piers and abutments that are alike.
fn bridge(bridge: &BridgeRequest, structure: &StructureBody) -> String {
    let span = |(j, span): (usize, &SpanRequest)| {
        let ring: Vec<_> = structure.joints.iter().filter(|joint| is_of_lowest_ring(joint, j)).collect();
        let rings: Vec<_> = span.rings.iter().map(ring_in_words).collect();
        (format!("span{j}"), format!("{}; {}", intrados(&ring).unwrap_or_default(), rings.join("; ")))
    };
    let spans = bridge.spans.iter().enumerate().map(span);
    let piers = bridge.piers.iter().enumerate().map(|(j, pier)| (format!("pier{j}"), pier_in_words(pier)));
    let sides = bridge.abutments.iter().flat_map(|ends| [("left", &ends.left), ("right", &ends.right)]);
    let abutments = sides.filter_map(|(side, end)| Some((format!("abutment.{side}"), abutment(end.as_ref()?))));
    let mut groups: Vec<([String; 2], String)> = Vec::new();
    for (name, words) in spans.chain(piers).chain(abutments) {
        match groups.last_mut() {
            Some(([_, last], same)) if *same == words => *last = name,
            _ => groups.push(([name.clone(), name], words)),
        }
    }
    let line = |([first, last], words): &([String; 2], String)| match first == last {
        true => format!("{first}: {words}"),
        false => format!("{first} to {last}, each: {words}"),
    };
    let mut lines: Vec<String> = groups.iter().take(LINES).map(line).collect();
    let more = groups.len() - lines.len();
    lines.extend((more > 0).then(|| format!("and {more} more lines of spans, piers and abutments")));
    lines.join("\n")
}

/// Whether a joint is one across the lowest ring of a span, or at its springings.
fn is_of_lowest_ring(joint: &JointBody, span: usize) -> bool {
    let ring = format!("span{span}.ring0.");
    let [before, after] = &joint.between;
    let carries = |name: &str| ["ground", "pier", "abutment"].iter().any(|word| name.starts_with(word));
    match (before.starts_with(&ring), after.starts_with(&ring)) {
        (true, true) => true,
        (true, false) => carries(after),
        (false, true) => carries(before),
        (false, false) => false,
    }
}

fn ring_in_words(ring: &RingRequest) -> String {
    let springings = ring.springing_thickness_m.filter(|thickness| *thickness != ring.thickness_m);
    let springings = springings.map(|thickness| format!(" at the crown, {} m at the springings", Digits(thickness)));
    format!("ring of {} voussoirs, {} m{}", ring.voussoirs, Digits(ring.thickness_m), springings.unwrap_or_default())
}

fn pier_in_words(pier: &PierRequest) -> String {
    let batter = if pier.batter > 0.0 { format!(", batter {}", Digits(pier.batter)) } else { String::new() };
    let [height, width] = [pier.height_m, pier.top_width_m].map(Digits);
    format!("{height} m high, {width} m wide at the top, courses: {}{batter}", pier.courses)
}

fn abutment(end: &BridgeAbutment) -> String {
    let width = end.width_m.map_or("as wide as the springings".to_owned(), |width| format!("{} m wide", Digits(width)));
    format!("{} m high, {width}", Digits(end.height_m))
}

/// How wide and how high blocks are together.
fn extent(structure: &StructureBody) -> String {
    let along = |k: usize| {
        let all = structure.bodies.iter().flat_map(|body| &body.corners_m).map(|corner| corner[k]);
        let (least, most) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        Digits(most - least)
    };
    format!("{} m wide and {} m high in all", along(0), along(1))
}
