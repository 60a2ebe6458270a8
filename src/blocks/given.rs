//! Supports, and joints that are given.

use super::contacts::{Meeting, joint, meetings};
use super::fault::BlocksFault;
use super::outline::{Edge, Outline};
use super::{Blocks, GivenJoint, GivenLaw, Rest};
use crate::geometry::{Vec2, distance_from_segment};
use crate::structure::{Joint, JointLaw, Side, Stone};
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

/// Polygons and supports by name.
pub(super) struct Names<'a>(BTreeMap<&'a str, Side>);

impl<'a> Names<'a> {
    /// All names, and those that are given twice.
    pub fn new(blocks: &'a Blocks) -> (Self, Vec<BlocksFault>) {
        let polygons = blocks.polygons.iter().enumerate().map(|(i, polygon)| (polygon.name.as_str(), Side::Body(i)));
        let supports = blocks.supports.iter().enumerate().map(|(i, support)| (support.name.as_str(), Side::Support(i)));
        let (mut names, mut faults) = (BTreeMap::new(), Vec::new());
        for (name, side) in polygons.chain(supports) {
            if names.insert(name, side).is_some() {
                faults.push(BlocksFault::NameTwice { name: name.to_owned() });
            }
        }
        (Names(names), faults)
    }

    fn polygon(&self, name: &str, place: &str) -> Result<usize, BlocksFault> {
        let unknown = || BlocksFault::UnknownPolygon { place: place.to_owned(), name: name.to_owned() };
        self.0.get(name).and_then(|side| side.body()).ok_or_else(unknown)
    }

    fn any(&self, name: &str, place: &str) -> Result<Side, BlocksFault> {
        let unknown = || BlocksFault::UnknownName { place: place.to_owned(), name: name.to_owned() };
        self.0.get(name).copied().ok_or_else(unknown)
    }
}

/// Joints between the supports and what they carry.
pub(super) fn grounds(
    blocks: &Blocks,
    names: &Names<'_>,
    outlines: &[Outline],
    tolerance: f64,
    faults: &mut Vec<BlocksFault>,
) -> Vec<Joint> {
    let mut joints = Vec::new();
    for (s, support) in blocks.supports.iter().enumerate() {
        for (r, rest) in support.carries.iter().enumerate() {
            let place = format!("supports[{s}].carries[{r}] of {:?}", support.name);
            let found = match rest {
                Rest::Side { polygon, side } => whole_side(names, outlines, polygon, *side, &place)
                    .map(|pair| vec![pair])
                    .map_err(|fault| vec![fault]),
                Rest::Line(line) => on_line(blocks, outlines, *line, (&place, &support.name), tolerance),
            };
            match found {
                Ok(found) => {
                    let at = |(body, run): (usize, Edge)| ground(blocks, s, body, run);
                    joints.extend(found.into_iter().map(at));
                }
                Err(more) => faults.extend(more),
            }
        }
    }
    joints
}

/// The joint between a support and a face of a body, given in the sense of the body's outline.
fn ground(blocks: &Blocks, support: usize, body: usize, run: Edge) -> Joint {
    let stone = &blocks.stones[blocks.polygons[body].stone];
    joint([Side::Support(support), Side::Body(body)], [run.to, run.from], stone.dry_joint_with(stone))
}

fn whole_side(
    names: &Names<'_>,
    outlines: &[Outline],
    polygon: &str,
    side: usize,
    place: &str,
) -> Result<(usize, Edge), BlocksFault> {
    let body = names.polygon(polygon, place)?;
    let unknown = || BlocksFault::UnknownSide {
        place: place.to_owned(),
        polygon: polygon.to_owned(),
        side,
        sides: outlines[body].sides(),
    };
    Ok((body, outlines[body].side(side).ok_or_else(unknown)?))
}

/// All faces on a line, on either side of it.
fn on_line(
    blocks: &Blocks,
    outlines: &[Outline],
    [from, to]: [Vec2; 2],
    (place, support): (&str, &str),
    tolerance: f64,
) -> Result<Vec<(usize, Edge)>, Vec<BlocksFault>> {
    let (line, place) = (Edge { from, to }, place.to_owned());
    let length = (to - from).norm();
    if !length.is_finite() || length <= tolerance {
        return Err(vec![BlocksFault::BadLine { place, tolerance }]);
    }
    let (mut found, mut faults) = (Vec::new(), Vec::new());
    for (body, outline) in outlines.iter().enumerate() {
        for meeting in meetings(&[line, line.reversed()], outline, tolerance) {
            if meeting.touches(tolerance) {
                found.push((body, Edge { from: meeting.ends[1], to: meeting.ends[0] }));
            } else if let Some((at, gap)) = meeting.near_miss(tolerance) {
                let between = [blocks.polygons[body].name.clone(), support.to_owned()];
                faults.push(BlocksFault::NearMiss { between, at, gap, tolerance });
            }
        }
    }
    if found.is_empty() && faults.is_empty() {
        faults.push(BlocksFault::NothingOnLine { place });
    }
    if faults.is_empty() { Ok(found) } else { Err(faults) }
}

/// The joints of a list.
pub(super) fn given(
    blocks: &Blocks,
    names: &Names<'_>,
    outlines: &[Outline],
    list: &[GivenJoint],
    tolerance: f64,
    faults: &mut Vec<BlocksFault>,
) -> Vec<Joint> {
    let mut joints = Vec::new();
    for (k, given) in list.iter().enumerate() {
        match one(blocks, names, outlines, given, &format!("joints[{k}]"), tolerance) {
            Ok(joint) => joints.push(joint),
            Err(fault) => faults.push(fault),
        }
    }
    joints
}

fn one(
    blocks: &Blocks,
    names: &Names<'_>,
    outlines: &[Outline],
    given: &GivenJoint,
    place: &str,
    tolerance: f64,
) -> Result<Joint, BlocksFault> {
    let sides = [names.any(&given.between[0], place)?, names.any(&given.between[1], place)?];
    let face = |body: usize| {
        let lies =
            |run: &&Edge| given.ends.iter().all(|&end| distance_from_segment(end, run.from, run.to) <= tolerance);
        let off =
            || BlocksFault::OffSide { place: place.to_owned(), polygon: blocks.polygons[body].name.clone(), tolerance };
        let run = outlines[body].runs.iter().find(lies).ok_or_else(off)?;
        // The ends in the sense of the face.
        let [p, q] = given.ends;
        let ends = if (q - p).dot(&run.direction()) >= 0.0 { [p, q] } else { [q, p] };
        let short = (q - p).norm() <= tolerance;
        if short { Err(off()) } else { Ok((*run, ends)) }
    };
    let stone = |body: usize| &blocks.stones[blocks.polygons[body].stone];
    match sides {
        [Side::Body(a), Side::Body(b)] if a != b => {
            let (a, b) = (a.min(b), a.max(b));
            let ((run, ends), (other, _)) = (face(a)?, face(b)?);
            if Meeting::of(run, other, tolerance).is_none() {
                let between = [a, b].map(|body| blocks.polygons[body].name.clone());
                return Err(BlocksFault::NotFacing { place: place.to_owned(), between });
            }
            Ok(joint([Side::Body(a), Side::Body(b)], ends, law(given.law, stone(a), stone(b), place)?))
        }
        [Side::Body(body), Side::Support(support)] | [Side::Support(support), Side::Body(body)] => {
            let [from, to] = face(body)?.1;
            let held = law(given.law, stone(body), stone(body), place)?;
            Ok(joint([Side::Support(support), Side::Body(body)], [to, from], held))
        }
        _ => Err(BlocksFault::BadPair { place: place.to_owned() }),
    }
}

fn law(given: GivenLaw, a: &Stone, b: &Stone, place: &str) -> Result<JointLaw, BlocksFault> {
    let GivenLaw::Dry { friction_angle, cohesion } = given else { return Ok(JointLaw::Bonded) };
    let angle = friction_angle.unwrap_or_else(|| a.friction_angle_on(b));
    let cohesion = cohesion.unwrap_or(a.cohesion.min(b.cohesion));
    if !((0.0..FRAC_PI_2).contains(&angle) && cohesion.is_finite() && cohesion >= 0.0) {
        return Err(BlocksFault::BadLaw { place: place.to_owned() });
    }
    Ok(JointLaw::Dry { friction: angle.tan(), cohesion })
}
