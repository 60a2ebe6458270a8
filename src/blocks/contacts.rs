//! Where faces meet.

use super::fault::{BlocksFault, MAX_FAULTS};
use super::outline::{Edge, Outline, near};
use super::{Blocks, NEAR_MISS, overlap};
use crate::geometry::{Vec2, cross};
use crate::structure::{Joint, JointLaw, Side, Structure};

/// Faces whose directions differ from opposite ones by more than this cosine never look at each other.
const FACING: f64 = -0.9;

/// The piece that two faces have in common.
pub(super) struct Meeting {
    /// From where to where, in the sense of the first face, m: corners of either face, the first one's where both agree.
    pub ends: [Vec2; 2],
    /// How far the second face lies outside the first there, m.
    gaps: [f64; 2],
}

impl Meeting {
    /// Where two faces look at each other over more than the tolerance, however far apart.
    pub fn of(a: Edge, b: Edge, tolerance: f64) -> Option<Meeting> {
        let (u, v) = (a.direction(), b.direction());
        if u.dot(&v) > FACING {
            return None;
        }
        let along = (u - v).normalize();
        let place = |p: Vec2| (p - a.from).dot(&along);
        let from = if place(b.to) > tolerance { b.to } else { a.from };
        let to = if place(b.from) < place(a.to) - tolerance { b.from } else { a.to };
        if place(to) - place(from) <= tolerance {
            return None;
        }
        let outside = |p: Vec2| cross(p - a.from, along);
        // Height of a face above the place `s`.
        let height = |run: Edge, s: f64| {
            let share = (s - place(run.from)) / (place(run.to) - place(run.from));
            outside(run.from) + share * (outside(run.to) - outside(run.from))
        };
        let gaps = [from, to].map(|end| height(b, place(end)) - height(a, place(end)));
        Some(Meeting { ends: [from, to], gaps })
    }

    /// True when the faces lie on one line.
    pub fn touches(&self, tolerance: f64) -> bool {
        self.gaps.iter().all(|gap| gap.abs() <= tolerance)
    }

    /// Place and size of the gap between faces that were likely meant to meet: nowhere wider than some tolerances, and longer
    /// than that.
    pub fn near_miss(&self, tolerance: f64) -> Option<(Vec2, f64)> {
        let reach = NEAR_MISS * tolerance;
        let wide = if self.gaps[0] > self.gaps[1] { 0 } else { 1 };
        let (least, most) = (self.gaps[1 - wide], self.gaps[wide]);
        let long = (self.ends[1] - self.ends[0]).norm() > reach;
        (long && least >= -tolerance && most > tolerance && most <= reach).then_some((self.ends[wide], most))
    }
}

/// A joint along a face of the body before it: `ends` in the sense of that face, whose outward normal is the joint's.
pub(super) fn joint(between: [Side; 2], ends: [Vec2; 2], law: JointLaw) -> Joint {
    Joint { between, intrados: ends[0], extrados: ends[1], law }
}

/// Polygons that overlap.
pub(super) fn overlaps(
    blocks: &Blocks,
    outlines: &[Outline],
    pairs: &[[usize; 2]],
    tolerance: f64,
) -> Vec<BlocksFault> {
    let name = |body: usize| blocks.polygons[body].name.clone();
    let fault = |&[a, b]: &[usize; 2]| {
        let (at, depth) = overlap::overlap(&outlines[a], &outlines[b], tolerance)?;
        Some(BlocksFault::Overlap { polygons: [name(a), name(b)], at, depth, tolerance })
    };
    pairs.iter().filter_map(fault).take(MAX_FAULTS).collect()
}

/// The joints between polygons, and faces that nearly meet.
pub(super) fn found(
    blocks: &Blocks,
    outlines: &[Outline],
    pairs: &[[usize; 2]],
    tolerance: f64,
    faults: &mut Vec<BlocksFault>,
) -> Vec<Joint> {
    let mut joints = Vec::new();
    for &[a, b] in pairs {
        if faults.len() >= MAX_FAULTS {
            break;
        }
        let stones = [a, b].map(|body| &blocks.stones[blocks.polygons[body].stone]);
        for meeting in meetings(&outlines[a].runs, &outlines[b], tolerance) {
            if meeting.touches(tolerance) {
                let between = [Side::Body(a), Side::Body(b)];
                joints.push(joint(between, meeting.ends, stones[0].dry_joint_with(stones[1])));
            } else if let Some((at, gap)) = meeting.near_miss(tolerance) {
                let between = [a, b].map(|body| blocks.polygons[body].name.clone());
                faults.push(BlocksFault::NearMiss { between, at, gap, tolerance });
            }
        }
    }
    joints
}

/// Where the faces `runs` look at faces of an outline that are near enough to matter.
pub(super) fn meetings(runs: &[Edge], outline: &Outline, tolerance: f64) -> Vec<Meeting> {
    // Faces that touch or nearly do are no farther apart than that.
    let reach = 2.0 * NEAR_MISS * tolerance;
    let mut meetings = Vec::new();
    for &run in runs.iter().filter(|run| near(run.bounds(), outline.bounds, reach)) {
        let others = outline.runs.iter().filter(|other| near(run.bounds(), other.bounds(), reach));
        meetings.extend(others.filter_map(|&other| Meeting::of(run, other, tolerance)));
    }
    meetings
}

/// Pieces of a side with two joints on them.
pub(super) fn doubled(blocks: &Blocks, structure: &Structure, tolerance: f64) -> Vec<BlocksFault> {
    let name = |side: Side| match side {
        Side::Body(body) => blocks.polygons[body].name.clone(),
        Side::Support(support) => blocks.supports[support].name.clone(),
    };
    let mut faults = Vec::new();
    for (body, joints) in structure.joints_of_bodies().iter().enumerate() {
        let with = |joint: &Joint| {
            let [before, after] = joint.between;
            name(if before == Side::Body(body) { after } else { before })
        };
        for (i, &first) in joints.iter().enumerate() {
            for &second in &joints[i + 1..] {
                let pair = [&structure.joints[first], &structure.joints[second]];
                if let Some(at) = shared(pair[0], pair[1], tolerance) {
                    faults.push(BlocksFault::SharedSide { polygon: name(Side::Body(body)), with: pair.map(with), at });
                }
                if faults.len() >= MAX_FAULTS {
                    return faults;
                }
            }
        }
    }
    faults
}

/// The middle of what two joints on one line have in common.
fn shared(a: &Joint, b: &Joint, tolerance: f64) -> Option<Vec2> {
    let along = a.tangent();
    let place = |p: Vec2| (p - a.intrados).dot(&along);
    if [b.intrados, b.extrados].iter().any(|&end| cross(end - a.intrados, along).abs() > 2.0 * tolerance) {
        return None;
    }
    let (p, q) = (place(b.intrados), place(b.extrados));
    let (from, to) = (p.min(q).max(0.0), p.max(q).min(a.length()));
    (to - from > 2.0 * tolerance).then(|| a.intrados + 0.5 * (from + to) * along)
}
