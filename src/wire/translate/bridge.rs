//! The bridge of a request, set out.

use super::profile::profile;
use super::stone::Stones;
use super::structure::Layout;
use crate::bridge::{Backing, Bridge, BridgeEnd, BridgeFault, BridgeSpan, Pier, RingCourse};
use crate::wire::fault::{Faults, child};
use crate::wire::request::{BridgeAbutment, BridgeRequest, PierRequest, RingRequest, SpanRequest};

const SPANS: &str = "/bridge/spans";
const PIERS: &str = "/bridge/piers";
const ENDS: [&str; 2] = ["/bridge/abutments/left", "/bridge/abutments/right"];

/// The structure of this bridge, or faults.
pub fn bridge(request: &BridgeRequest, stones: &Stones<'_>, faults: &mut Faults) -> Option<Layout> {
    let before = faults.len();
    let spans = spans(&request.spans, stones, faults);
    let piers = piers(request, stones, faults);
    let (left, right) = request.abutments.as_ref().map_or((None, None), |a| (a.left.as_ref(), a.right.as_ref()));
    let ends = [end(left, ENDS[0], stones, faults), end(right, ENDS[1], stones, faults)];
    let backing = request.backing.as_ref().map(|backing| {
        let stone = stones.named(backing.stone.as_deref(), "/bridge/backing/stone", faults);
        Backing { level: backing.level_m, stone }
    });
    let ring_friction_angle = request.ring_friction_angle_deg.map(f64::to_radians);
    let (spans, piers) = (spans?, piers?);
    if faults.len() > before {
        return None;
    }
    let bridge = Bridge { spans, piers, ends, backing, ring_friction_angle, stones: stones.all.clone() };
    match bridge.build() {
        Ok(structure) => {
            let bodies = names_of_bodies(&bridge, structure.bodies.len());
            Some(Layout { structure, bodies, supports: names_of_supports(&bridge) })
        }
        Err(found) => {
            for fault in &found {
                let (place, words) = placed(fault);
                faults.add(place, words);
            }
            None
        }
    }
}

fn spans(list: &[SpanRequest], stones: &Stones<'_>, faults: &mut Faults) -> Option<Vec<BridgeSpan>> {
    let one = |(j, span): (usize, &SpanRequest)| {
        let here = child(SPANS, &j.to_string());
        let place = child(&here, "profile");
        let profile = profile(&span.profile.clone().into(), &place, faults);
        let here = child(&here, "rings");
        let rings = span.rings.iter().enumerate();
        let rings = rings.map(|(m, course)| ring(course, &child(&here, &m.to_string()), stones, faults)).collect();
        profile.map(|profile| BridgeSpan { profile, rings })
    };
    let spans: Vec<_> = list.iter().enumerate().map(one).collect();
    spans.into_iter().collect()
}

fn ring(course: &RingRequest, here: &str, stones: &Stones<'_>, faults: &mut Faults) -> RingCourse {
    RingCourse {
        crown_thickness: course.thickness_m,
        springing_thickness: course.springing_thickness_m.unwrap_or(course.thickness_m),
        voussoirs: course.voussoirs,
        stone: stones.named(course.stone.as_deref(), &child(here, "stone"), faults),
    }
}

fn piers(request: &BridgeRequest, stones: &Stones<'_>, faults: &mut Faults) -> Option<Vec<Pier>> {
    let (spans, list) = (request.spans.len(), &request.piers);
    let one = |(j, pier): (usize, &PierRequest)| {
        let here = child(PIERS, &j.to_string());
        Pier {
            top_width: pier.top_width_m,
            height: pier.height_m,
            courses: pier.courses,
            batter: pier.batter,
            stone: stones.named(pier.stone.as_deref(), &child(&here, "stone"), faults),
        }
    };
    let piers = list.iter().enumerate().map(one).collect();
    let detail = format!("{} for {spans} spans: give one pier between every two spans", list.len());
    faults.require(list.len() + 1 == spans, PIERS, detail).then_some(piers)
}

fn end(abutment: Option<&BridgeAbutment>, here: &str, stones: &Stones<'_>, faults: &mut Faults) -> BridgeEnd {
    let Some(abutment) = abutment else { return BridgeEnd::Ground };
    let stone = stones.named(abutment.stone.as_deref(), &child(here, "stone"), faults);
    BridgeEnd::Abutment { height: abutment.height_m, width: abutment.width_m, stone }
}

/// Names of the bodies, in the builder's order: voussoirs ring by ring, piers from the ground up, abutments, backing.
fn names_of_bodies(bridge: &Bridge, bodies: usize) -> Vec<String> {
    let mut names = Vec::with_capacity(bodies);
    for (j, span) in bridge.spans.iter().enumerate() {
        for (m, ring) in span.rings.iter().enumerate() {
            names.extend((0..ring.voussoirs).map(|k| format!("span{j}.ring{m}.voussoir{k}")));
        }
    }
    for (j, pier) in bridge.piers.iter().enumerate() {
        names.extend((0..pier.courses).map(|k| format!("pier{j}.course{k}")));
    }
    let blocks = bridge.ends.iter().zip(["left", "right"]).filter(|(end, _)| **end != BridgeEnd::Ground);
    names.extend(blocks.map(|(_, side)| format!("abutment.{side}")));
    let first = names.len();
    names.extend((first..bodies).map(|body| format!("backing{}", body - first)));
    names
}

/// Names of the supports: the left end, the piers, the right end.
fn names_of_supports(bridge: &Bridge) -> Vec<String> {
    let piers = (0..bridge.piers.len()).map(|j| format!("ground.pier{j}"));
    std::iter::once("ground.left".to_owned()).chain(piers).chain(["ground.right".to_owned()]).collect()
}

/// A fault with the pointer to where it is best mended, and its remedy. The builder's words begin with the place that it names.
fn placed(fault: &BridgeFault) -> (String, String) {
    use BridgeFault as F;
    let words = fault.to_string();
    if let F::TooManyBodies { .. } = fault {
        return (SPANS.to_owned(), words);
    }
    let names = |c: char| c.is_ascii_alphanumeric() || "_[].".contains(c);
    let (place, rest) = words.split_at(words.find(|c| !names(c)).unwrap_or(0));
    let rest = match rest.strip_prefix(": ") {
        Some(rest) => rest.to_owned(),
        None => format!("this{rest}"),
    };
    let remedy = match fault {
        F::Arch { .. } => ": give the ring fewer voussoirs, or another thickness",
        F::SpringingsCross { .. } => ": reduce the opening angle or the thickness",
        F::BadProfile { .. } => ": give another profile",
        F::PierTooNarrow { .. } | F::AbutmentTooNarrow { .. } => ": make it wider, or the rings thinner",
        _ => "",
    };
    (pointer(place), format!("{rest}{remedy}"))
}

/// The pointer to a place that the builder names, such as `spans[0].rings[1].crown_thickness`.
fn pointer(place: &str) -> String {
    let mut pointer = "/bridge".to_owned();
    for step in place.split('.') {
        let (name, index) = match step.strip_suffix(']').and_then(|step| step.split_once('[')) {
            Some((name, index)) => (name, Some(index)),
            None => (step, None),
        };
        let field = match (name, index) {
            ("ends", Some("0")) => "abutments/left".to_owned(),
            ("ends", _) => "abutments/right".to_owned(),
            ("crown_thickness", _) => "thickness_m".to_owned(),
            ("springing_thickness" | "top_width" | "height" | "width" | "level", _) => format!("{name}_m"),
            ("ring_friction_angle", _) => "ring_friction_angle_deg".to_owned(),
            (name, Some(index)) => format!("{name}/{index}"),
            (name, None) => name.to_owned(),
        };
        pointer = format!("{pointer}/{field}");
    }
    pointer
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_of_the_builder_become_pointers() {
        for (place, expected) in [
            ("spans[0].rings[1].crown_thickness", "/bridge/spans/0/rings/1/thickness_m"),
            ("piers[2].top_width", "/bridge/piers/2/top_width_m"),
            ("ends[1].height", "/bridge/abutments/right/height_m"),
            ("ends[0]", "/bridge/abutments/left"),
            ("backing.level", "/bridge/backing/level_m"),
            ("spans[3].profile", "/bridge/spans/3/profile"),
        ] {
            assert_eq!(pointer(place), expected);
        }
    }
}
