//! Blocks of a request, joined.

use super::stone::Stones;
use super::structure::Layout;
use crate::blocks::{Blocks, BlocksFault, GivenJoint, GivenLaw, Joints, Polygon, Rest, Support};
use crate::geometry::Vec2;
use crate::wire::fault::Faults;
use crate::wire::request::{
    BlockJointsRequest, BlocksRequest, GivenJointRequest, PolygonRequest, SupportRequest, Text,
};

const POLYGONS: &str = "/blocks/polygons";
const GIVEN: &str = "/blocks/joints/given";
const SUPPORTS: &str = "/blocks/supports";

/// The structure of these blocks, or faults.
pub fn blocks(request: &BlocksRequest, stones: &Stones<'_>, faults: &mut Faults) -> Option<Layout> {
    let before = faults.len();
    let polygons = polygons(request, stones, faults);
    let joints = match &request.joints {
        BlockJointsRequest::Found => Joints::Found,
        BlockJointsRequest::Given(list) => Joints::Given(given(&list.0, faults)),
    };
    let supports = request.supports.iter().map(support).collect();
    if faults.len() > before {
        return None;
    }
    let blocks = Blocks { polygons, joints, supports, tolerance: request.tolerance_m, stones: stones.all.clone() };
    match blocks.build() {
        Ok(structure) => Some(Layout {
            structure,
            bodies: request.polygons.iter().map(|polygon| polygon.name.to_string()).collect(),
            supports: request.supports.iter().map(|support| support.name.to_string()).collect(),
        }),
        Err(found) => {
            for fault in &found {
                faults.add(place(fault, request), words(fault));
            }
            None
        }
    }
}

fn polygons(request: &BlocksRequest, stones: &Stones<'_>, faults: &mut Faults) -> Vec<Polygon> {
    let one = |(i, polygon): (usize, &PolygonRequest)| Polygon {
        name: polygon.name.to_string(),
        corners: polygon.corners_m.iter().map(|&corner| corner.into()).collect(),
        stone: stones.named(polygon.stone.as_deref(), &format!("{POLYGONS}/{i}/stone"), faults),
    };
    request.polygons.iter().enumerate().map(one).collect()
}

fn given(list: &[GivenJointRequest], faults: &mut Faults) -> Vec<GivenJoint> {
    let one = |(j, joint): (usize, &GivenJointRequest)| {
        let holds = joint.friction_angle_deg.is_some() || joint.cohesion_pa.is_some();
        let detail = "a bonded joint has neither friction nor cohesion: leave them out, or set bonded to false";
        faults.require(!(joint.bonded && holds), format!("{GIVEN}/{j}/bonded"), detail);
        let law = match joint.bonded {
            true => GivenLaw::Bonded,
            false => GivenLaw::Dry {
                friction_angle: joint.friction_angle_deg.map(f64::to_radians),
                cohesion: joint.cohesion_pa,
            },
        };
        let between = joint.between.each_ref().map(Text::to_string);
        GivenJoint { between, ends: joint.ends_m.map(Vec2::from), law }
    };
    list.iter().enumerate().map(one).collect()
}

fn support(support: &SupportRequest) -> Support {
    let sides = support.sides.iter().map(|side| Rest::Side { polygon: side.block.to_string(), side: side.side });
    let lines = support.segments_m.iter().map(|segment| Rest::Line(segment.0.map(Vec2::from)));
    Support { name: support.name.to_string(), carries: sides.chain(lines).collect() }
}

/// Where in a request a fault is best mended.
fn place(fault: &BlocksFault, request: &BlocksRequest) -> String {
    use BlocksFault as F;
    let polygon = |name: &str, rest: &str| match request.polygons.iter().position(|polygon| *polygon.name == *name) {
        Some(i) => format!("{POLYGONS}/{i}{rest}"),
        None => POLYGONS.to_owned(),
    };
    match fault {
        F::NoPolygons | F::TooManyPolygons { .. } | F::TooManyCornersInAll { .. } => POLYGONS.to_owned(),
        F::NoSupports => SUPPORTS.to_owned(),
        F::NameTwice { name } => twice(name, request),
        F::TooManyCorners { polygon: name, .. }
        | F::TooFewCorners { polygon: name, .. }
        | F::CrossesItself { polygon: name, .. }
        | F::NoArea { polygon: name, .. } => polygon(name, "/corners_m"),
        F::CornerNotFinite { polygon: name, corner } | F::SideTooShort { polygon: name, side: corner, .. } => {
            polygon(name, &format!("/corners_m/{corner}"))
        }
        F::UnknownStone { polygon: name, .. } => polygon(name, "/stone"),
        F::Tolerance { .. } => "/blocks/tolerance_m".to_owned(),
        F::Overlap { polygons: [_, name], .. } => polygon(name, "/corners_m"),
        F::NearMiss { between, .. } => {
            // The first name may be a support's.
            let block = between.iter().rfind(|name| request.polygons.iter().any(|polygon| *polygon.name == ***name));
            block.map_or_else(|| POLYGONS.to_owned(), |name| polygon(name, "/corners_m"))
        }
        F::TouchesNothing { polygon: name } => polygon(name, "/corners_m"),
        F::NotSupported { .. } => SUPPORTS.to_owned(),
        F::SharedSide { polygon: name, .. } => match request.joints {
            BlockJointsRequest::Given(_) => GIVEN.to_owned(),
            BlockJointsRequest::Found => polygon(name, "/corners_m"),
        },
        F::UnknownPolygon { .. }
        | F::UnknownSide { .. }
        | F::BadLine { .. }
        | F::UnknownName { .. }
        | F::NothingOnLine { .. }
        | F::BadPair { .. }
        | F::OffSide { .. }
        | F::NotFacing { .. }
        | F::BadLaw { .. } => at(builders_place(fault), request),
    }
}

/// The place that the builder names; empty where it names none.
fn builders_place(fault: &BlocksFault) -> &str {
    use BlocksFault as F;
    match fault {
        F::UnknownPolygon { place, .. }
        | F::UnknownSide { place, .. }
        | F::BadLine { place, .. }
        | F::UnknownName { place, .. }
        | F::NothingOnLine { place }
        | F::BadPair { place }
        | F::OffSide { place, .. }
        | F::NotFacing { place, .. }
        | F::BadLaw { place } => place,
        _ => "",
    }
}

/// The second bearer of a name.
fn twice(name: &str, request: &BlocksRequest) -> String {
    let polygons = request.polygons.iter().enumerate().map(|(i, polygon)| (&polygon.name, format!("{POLYGONS}/{i}")));
    let supports = request.supports.iter().enumerate().map(|(i, support)| (&support.name, format!("{SUPPORTS}/{i}")));
    let second = polygons.chain(supports).filter(|(given, _)| ***given == *name).nth(1);
    second.map_or_else(|| "/blocks".to_owned(), |(_, place)| format!("{place}/name"))
}

/// The pointer to a place that the builder names: `joints[2] ...`, or `supports[0].carries[1] ...` where sides come before
/// segments.
fn at(place: &str, request: &BlocksRequest) -> String {
    let numbers = |text: &str| -> Vec<usize> {
        text.split(['[', ']']).skip(1).step_by(2).take(2).filter_map(|digits| digits.parse().ok()).collect()
    };
    match (place.starts_with("joints["), numbers(place).as_slice()) {
        (true, &[joint, ..]) => format!("{GIVEN}/{joint}"),
        (false, &[support, rest]) => {
            let sides = request.supports.get(support).map_or(0, |support| support.sides.len());
            match rest.checked_sub(sides) {
                None => format!("{SUPPORTS}/{support}/sides/{rest}"),
                Some(segment) => format!("{SUPPORTS}/{support}/segments_m/{segment}"),
            }
        }
        _ => "/blocks".to_owned(),
    }
}

/// A fault in words, without the builder's own place.
fn words(fault: &BlocksFault) -> String {
    let words = fault.to_string();
    words.strip_prefix(builders_place(fault)).map_or(words.as_str(), |rest| rest.trim_start_matches(": ")).to_owned()
}
