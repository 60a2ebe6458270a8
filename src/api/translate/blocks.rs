//! Blocks of a request, joined.

use super::stone::{Stones, friction_angle};
use super::structure::Layout;
use super::{MAX_LENGTH_M, MAX_STRESS_PA, check_text};
use crate::api::fault::{Faults, child};
use crate::api::request::{BlockJointsRequest, BlocksRequest, GivenJointRequest, MAX_GIVEN_JOINTS, SupportRequest};
use crate::blocks::{
    Blocks, BlocksFault, GivenJoint, GivenLaw, Joints, MAX_CORNERS, MAX_POLYGONS, Polygon, Rest, Support,
};
use crate::geometry::Vec2;

/// Most coordinates out of range that are listed.
const MAX_COORDINATE_FAULTS: usize = 20;

const POLYGONS: &str = "/blocks/polygons";
const GIVEN: &str = "/blocks/joints/given";
const SUPPORTS: &str = "/blocks/supports";

/// The structure of these blocks, or faults.
pub fn blocks(request: &BlocksRequest, stones: &Stones<'_>, faults: &mut Faults) -> Option<Layout> {
    let before = faults.len();
    let polygons = polygons(request, stones, faults);
    let joints = match &request.joints {
        BlockJointsRequest::Found => Joints::Found,
        BlockJointsRequest::Given(list) => Joints::Given(given(list, faults)),
    };
    let supports = supports(&request.supports, faults);
    if let Some(tolerance) = request.tolerance_m {
        faults.within("/blocks/tolerance_m", tolerance, 0.0, MAX_LENGTH_M);
    }
    if faults.len() > before {
        return None;
    }
    let blocks = Blocks { polygons, joints, supports, tolerance: request.tolerance_m, stones: stones.all.clone() };
    match blocks.build() {
        Ok(structure) => Some(Layout {
            structure,
            bodies: request.polygons.iter().map(|polygon| polygon.name.clone()).collect(),
            supports: request.supports.iter().map(|support| support.name.clone()).collect(),
        }),
        Err(found) => {
            for fault in &found {
                faults.add(place(fault, request), mended(fault));
            }
            None
        }
    }
}

fn polygons(request: &BlocksRequest, stones: &Stones<'_>, faults: &mut Faults) -> Vec<Polygon> {
    if !faults.listing(POLYGONS, request.polygons.len(), 1..=MAX_POLYGONS, "blocks") {
        return Vec::new();
    }
    let mut polygons = Vec::with_capacity(request.polygons.len());
    for (i, polygon) in request.polygons.iter().enumerate() {
        let here = child(POLYGONS, &i.to_string());
        check_text(&child(&here, "name"), &polygon.name, faults);
        let corners = child(&here, "corners_m");
        faults.listing(&corners, polygon.corners_m.len(), 3..=MAX_CORNERS, "corners");
        check_points(&corners, &polygon.corners_m, faults);
        let stone = stones.named(polygon.stone.as_deref(), &child(&here, "stone"), faults);
        let corners = polygon.corners_m.iter().map(|&corner| corner.into()).collect();
        polygons.push(Polygon { name: polygon.name.clone(), corners, stone });
    }
    polygons
}

fn given(list: &[GivenJointRequest], faults: &mut Faults) -> Vec<GivenJoint> {
    if !faults.listing(GIVEN, list.len(), 0..=MAX_GIVEN_JOINTS, "joints") {
        return Vec::new();
    }
    let mut joints = Vec::with_capacity(list.len());
    for (j, joint) in list.iter().enumerate() {
        let here = child(GIVEN, &j.to_string());
        for (k, name) in joint.between.iter().enumerate() {
            check_text(&format!("{here}/between/{k}"), name, faults);
        }
        check_points(&child(&here, "ends_m"), &joint.ends_m, faults);
        if let Some(angle) = joint.friction_angle_deg {
            friction_angle(&child(&here, "friction_angle_deg"), angle, faults);
        }
        if let Some(cohesion) = joint.cohesion_pa {
            faults.from_to(child(&here, "cohesion_pa"), cohesion, 0.0, MAX_STRESS_PA);
        }
        let holds = joint.friction_angle_deg.is_some() || joint.cohesion_pa.is_some();
        let detail = "a bonded joint has neither friction nor cohesion: leave them out, or set bonded to false";
        faults.require(!(joint.bonded && holds), child(&here, "bonded"), detail);
        let law = match joint.bonded {
            true => GivenLaw::Bonded,
            false => GivenLaw::Dry {
                friction_angle: joint.friction_angle_deg.map(f64::to_radians),
                cohesion: joint.cohesion_pa,
            },
        };
        joints.push(GivenJoint { between: joint.between.clone(), ends: joint.ends_m.map(Vec2::from), law });
    }
    joints
}

fn supports(list: &[SupportRequest], faults: &mut Faults) -> Vec<Support> {
    if !faults.listing(SUPPORTS, list.len(), 1..=MAX_POLYGONS, "supports") {
        return Vec::new();
    }
    let mut supports = Vec::with_capacity(list.len());
    for (s, support) in list.iter().enumerate() {
        let here = child(SUPPORTS, &s.to_string());
        check_text(&child(&here, "name"), &support.name, faults);
        faults.listing(child(&here, "sides"), support.sides.len(), 0..=MAX_POLYGONS, "sides");
        faults.listing(child(&here, "segments_m"), support.segments_m.len(), 0..=MAX_POLYGONS, "segments");
        for (k, side) in support.sides.iter().enumerate().take(MAX_POLYGONS) {
            let here = format!("{here}/sides/{k}");
            check_text(&child(&here, "block"), &side.block, faults);
            faults.counted(child(&here, "side"), side.side, 0..=MAX_CORNERS - 1, "sides");
        }
        for (k, segment) in support.segments_m.iter().enumerate().take(MAX_POLYGONS) {
            check_points(&format!("{here}/segments_m/{k}"), segment, faults);
        }
        let sides = support.sides.iter().map(|side| Rest::Side { polygon: side.block.clone(), side: side.side });
        let lines = support.segments_m.iter().map(|segment| Rest::Line(segment.map(Vec2::from)));
        supports.push(Support { name: support.name.clone(), carries: sides.chain(lines).collect() });
    }
    supports
}

/// Whether points, in m, lie within the bounds of coordinates.
fn check_points(here: &str, points: &[[f64; 2]], faults: &mut Faults) {
    let far = |point: &&[f64; 2]| !point.iter().all(|value| value.abs() <= MAX_LENGTH_M);
    for (k, point) in points.iter().enumerate().filter(|(_, point)| far(point)).take(MAX_COORDINATE_FAULTS) {
        for (i, &coordinate) in point.iter().enumerate() {
            faults.either_way(format!("{here}/{k}/{i}"), coordinate, MAX_LENGTH_M);
        }
    }
}

/// Where in a request a fault is best mended.
fn place(fault: &BlocksFault, request: &BlocksRequest) -> String {
    use BlocksFault as F;
    let polygon = |name: &str, rest: &str| match request.polygons.iter().position(|polygon| polygon.name == name) {
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
            let block = between.iter().rfind(|name| request.polygons.iter().any(|polygon| polygon.name == **name));
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
    let second = polygons.chain(supports).filter(|(given, _)| *given == name).nth(1);
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

/// A fault in words, with its remedy; without the builder's own place.
fn mended(fault: &BlocksFault) -> String {
    use BlocksFault as F;
    let words = fault.to_string();
    let words = words.strip_prefix(builders_place(fault)).map_or(words.as_str(), |rest| rest.trim_start_matches(": "));
    let remedy = match fault {
        F::NameTwice { .. } => "give one of them another name",
        F::NoArea { .. } => "give at least three corners that do not lie on one line",
        F::Overlap { .. } => "move a corner of one of them, or raise tolerance_m",
        F::TouchesNothing { .. } => "move it to its neighbours, or leave it out",
        F::Tolerance { .. } => "give one between them, or leave tolerance_m out",
        F::UnknownPolygon { .. } | F::UnknownName { .. } => "correct the name",
        F::UnknownSide { .. } => "give a side of the block",
        F::NothingOnLine { .. } => "move the segment under the blocks, or leave it out",
        F::BadLine { .. } => "give two ends",
        F::BadPair { .. } => "correct the names",
        F::OffSide { .. } => "move the ends onto the side, or raise tolerance_m",
        F::NotFacing { .. } => "name the two blocks that meet there",
        F::TooManyCornersInAll { .. } => "leave corners out",
        _ => return words.to_owned(),
    };
    format!("{words}; {remedy}")
}
