//! Motion after collapse: from a structure, its loads and its report to rigid bodies on the move, and back to frames.

use super::{
    Analysis, AnalysisError, CollapseReport, Direction, FallingMotion, MotionAsked, MotionContact, MotionEnd,
    MotionFrame, Note, OpenHinge, Outcome, Slid,
};
use crate::budget::Budget;

use crate::dda::falling::{Advance, Carried, Configuration, Falling, Interface, Member, Opening, RigidBody};
use crate::geometry::Vec2;
use crate::structure::{Face, Joint, JointLaw, Side, Structure};

/// The scaled loads are so much larger in the motion than at collapse, lest a perfectly balanced arch stay where it is.
const OVERLOAD: f64 = 0.01;
/// A load factor counts as at least this share of the one at which scaled and fixed loads are equal.
const SMALL: f64 = 0.01;
/// Stones closer than this share of the thickness touch; joints that open or slide by more are hinges and slides.
const NEAR: f64 = 1e-3;
/// A structure that has moved by less than this share of its thickness has not begun to fall.
const BEGUN: f64 = 0.02;
/// Joints on one line to this share of the extent share the ground between them.
const ON_LINE: f64 = 1e-6;
/// The ground at a level and the wall at the crown of half an arch go on for so many extents.
const FAR: f64 = 10.0;

/// Friction beyond its bound by more than this share of the loads is told.
const BEYOND: f64 = 1e-6;

/// A load factor and how far it is beyond that of collapse.
type Loading = (f64, f64);

/// Moves the arch on from the collapse in a report, and from the other end of a window too.
pub(super) fn follow(analysis: &Analysis, report: &mut CollapseReport, budget: &Budget) -> Result<(), AnalysisError> {
    let Some(asked) = analysis.motion else { return Ok(()) };
    let as_built = matches!(report.outcome, Outcome::FallsAsBuilt | Outcome::SlidesAsBuilt);
    let falls = as_built || matches!(report.outcome, Outcome::Collapse | Outcome::StandsInWindow);
    if !falls || (report.end.is_none() && report.other_end.is_none()) {
        return Ok(());
    }
    let sign = if analysis.direction == Direction::Increase { 1.0 } else { -1.0 };
    let of_end = |end: bool, report: &CollapseReport| {
        let (end, sign) = if end { (&report.end, sign) } else { (&report.other_end, -sign) };
        end.as_ref().map(|end| loadings(analysis, report, end.load_factor, sign))
    };
    if let Some(loadings) = of_end(true, report) {
        report.motion = Some(first_to_begin(analysis, asked, &loadings, report, budget)?);
    }
    if let Some(loadings) = of_end(false, report) {
        report.other_motion = Some(first_to_begin(analysis, asked, &loadings, report, budget)?);
    }
    let lost = |motion: &Option<FallingMotion>| motion.as_ref().is_some_and(|motion| motion.end == MotionEnd::Lost);
    if lost(&report.motion) || lost(&report.other_motion) {
        report.notes.push(Note::MotionLost);
    }
    let frames = report.motion.iter().chain(&report.other_motion).flat_map(|motion| &motion.frames);
    let excess = frames.filter(|frame| frame.excess > BEYOND).map(|frame| frame.excess);
    if let Some(worst) = excess.reduce(f64::max) {
        report.notes.push(Note::MotionBeyondFriction(worst));
    }
    Ok(())
}

/// Load factors to try: a little beyond collapse; and, where sliding joints let the arch fall below it, a little beyond the
/// limit window, where no equilibrium is left.
fn loadings(analysis: &Analysis, report: &CollapseReport, at: f64, sign: f64) -> Vec<Loading> {
    if matches!(report.outcome, Outcome::FallsAsBuilt | Outcome::SlidesAsBuilt) {
        return vec![(report.start, 0.0)];
    }
    if at == 0.0 && report.at_start.is_none() {
        // It falls as soon as the load factor leaves 0: the path was tried from there.
        return vec![(report.start, report.start)];
    }
    let total = |forces: &[crate::structure::PointForce]| forces.iter().map(|f| f.force.norm()).sum::<f64>();
    let small = SMALL * total(&analysis.fixed) / total(&analysis.scaled).max(f64::MIN_POSITIVE);
    let beyond = |at: f64| at + sign * OVERLOAD * at.abs().max(small);
    let limit = report.limit_window.map(|window| if sign > 0.0 { window.highest } else { window.lowest });
    let further = limit.filter(|limit| limit.is_finite() && sign * (beyond(*limit) - beyond(at)) > 0.0);
    std::iter::once(at).chain(further).map(|from| (beyond(from), beyond(from) - at)).collect()
}

/// The first motion that begins; the last one if none does.
fn first_to_begin(
    analysis: &Analysis,
    asked: MotionAsked,
    loadings: &[Loading],
    report: &CollapseReport,
    budget: &Budget,
) -> Result<FallingMotion, AnalysisError> {
    let mut motion = run(analysis, asked, loadings[0], report, budget)?;
    for &loading in &loadings[1..] {
        let moved = motion.frames.last().map_or(0.0, |frame| frame.displacement);
        if motion.end == MotionEnd::AtRest && moved < BEGUN * motion.thickness {
            motion = run(analysis, asked, loading, report, budget)?;
        }
    }
    Ok(motion)
}

fn run(
    analysis: &Analysis,
    asked: MotionAsked,
    (load_factor, overload): Loading,
    report: &CollapseReport,
    budget: &Budget,
) -> Result<FallingMotion, AnalysisError> {
    let moving = Moving::new(analysis, load_factor, asked.ground_level);
    let Moving { mut falling, span, thickness, .. } = moving.clone();
    let mut configuration = falling.configuration();
    let mut frames = vec![moving.read(&configuration)];
    let end = loop {
        let events = report.cost.events + frames.len();
        if budget.step(load_factor, events).is_break() {
            return Err(budget.stopped().into());
        }
        if configuration.displacement >= asked.share_of_span * span {
            break MotionEnd::Moved;
        }
        if frames.len() > asked.most_frames {
            break MotionEnd::StepLimit;
        }
        let advance = falling.advance(budget);
        budget.check()?;
        match advance {
            Ok(Advance::Moved(next)) => configuration = *next,
            Ok(Advance::Rest) => break MotionEnd::AtRest,
            Err(_) => break MotionEnd::Lost,
        }
        frames.push(moving.read(&configuration));
    };
    Ok(FallingMotion { end, load_factor, overload, span, thickness, frames })
}

/// A structure as rigid bodies: stones that are bonded are one, and what is bonded to the ground cannot move.
#[derive(Clone)]
struct Moving<'a> {
    structure: &'a Structure,
    falling: Falling,
    /// The rigid body of every stone that is told of, and the stone's centroid from that body's at the start, m.
    stones: Vec<(usize, Vec2)>,
    span: f64,
    thickness: f64,
}

impl<'a> Moving<'a> {
    fn new(analysis: &'a Analysis, load_factor: f64, ground_level: Option<f64>) -> Self {
        let structure = &analysis.structure;
        let (span, thickness) = (span(structure), thickness(structure));
        let group = groups(structure);
        let mut of_group = vec![usize::MAX; structure.bodies.len()];
        let mut bodies = Vec::new();
        for first in (0..group.len()).filter(|&k| group[k] == k) {
            of_group[first] = bodies.len();
            let members = (first..group.len()).filter(|&k| group[k] == first).map(|k| member(structure, k)).collect();
            bodies.push(RigidBody::new(members));
        }
        for joint in &structure.joints {
            let ([Some(body), None] | [None, Some(body)]) = joint.between.map(Side::body) else { continue };
            match joint.law {
                JointLaw::Bonded => bodies[of_group[group[body]]].free = [false; 3],
                // What the plane of symmetry cuts through stays upright on it.
                JointLaw::Mirror => bodies[of_group[group[body]]].free = [false, true, false],
                _ => {}
            }
        }
        for (forces, factor) in [(&analysis.fixed, 1.0), (&analysis.scaled, load_factor)] {
            forces.iter().for_each(|f| bodies[of_group[group[f.body]]].push(f.at, f.force * factor));
        }
        let centroid = |k: usize| RigidBody::new(vec![member(structure, k)]).centroid;
        let stone = |k: usize| (of_group[group[k]], centroid(k) - bodies[of_group[group[k]]].centroid);
        let stones = (0..structure.voussoirs().len()).map(stone).collect();
        bodies.extend(grounds(structure, span, ground_level));
        let falling =
            Falling::new(bodies, structure.joints.iter().map(|j| interface(structure, j)).collect(), thickness);
        Moving { structure, falling, stones, span, thickness }
    }

    fn read(&self, configuration: &Configuration) -> MotionFrame {
        let near = NEAR * self.thickness;
        let body = |number: usize| (number < self.structure.bodies.len()).then_some(number);
        let contact = |c: &Carried| MotionContact {
            bodies: c.between.map(body),
            joint: c.interface,
            at: c.at,
            direction: c.direction,
            normal: c.normal,
            tangential: c.tangential,
            gap: c.gap,
        };
        let (mut hinges, mut slides) = (Vec::new(), Vec::new());
        let joints = self.structure.joints.iter().map(|joint| joint.law.coulomb().is_some());
        for (joint, (opening, dry)) in configuration.openings.iter().zip(joints).enumerate() {
            let Opening { gaps, slid, angle, facing } = *opening;
            let open = gaps.map(|gap| gap > near);
            if !dry || !facing || open == [true; 2] {
                continue;
            }
            if open[0] != open[1] {
                let face = if open[0] { Face::Extrados } else { Face::Intrados };
                hinges.push(OpenHinge { joint, face, opening: angle.abs() });
            }
            if slid.abs() > near {
                slides.push(Slid { joint, by: slid });
            }
        }
        let places = || self.stones.iter().map(|&(body, arm)| (&configuration.places[body], arm));
        MotionFrame {
            parameter: configuration.parameter,
            centroids: places().map(|(place, arm)| place.point(arm)).collect(),
            rotations: places().map(|(place, _)| place.angle).collect(),
            contacts: configuration.carried.iter().map(contact).collect(),
            hinges,
            slides,
            displacement: configuration.displacement,
            penetration: configuration.overlap / self.thickness,
            residual: configuration.residual,
            excess: configuration.excess,
            work: configuration.work,
        }
    }
}

fn member(structure: &Structure, k: usize) -> Member {
    let stone = structure.stone_of(k);
    let corners = structure.bodies[k].corners.clone();
    Member { number: k, corners, density: stone.density, friction: stone.friction_angle.tan() }
}

/// Supports are members too, after all bodies.
fn interface(structure: &Structure, joint: &Joint) -> Interface {
    let [friction, cohesion] = joint.law.coulomb().unwrap_or_default();
    let number = |side: Side| match side {
        Side::Body(body) => body,
        Side::Support(support) => structure.bodies.len() + support,
    };
    let ends = [joint.intrados, joint.extrados];
    Interface { between: joint.between.map(number), ends, friction, cohesion: cohesion * joint.length() }
}

/// The longer side of the box around all stones.
fn extent(structure: &Structure) -> f64 {
    let corners = || structure.bodies.iter().flat_map(|body| &body.corners);
    let low = corners().fold(Vec2::repeat(f64::INFINITY), |low, corner| low.inf(corner));
    (corners().fold(low, |high, corner| high.sup(corner)) - low).amax()
}

/// The longest between the middles of springing joints; of half an arch, twice the half; of blocks their extent.
fn span(structure: &Structure) -> f64 {
    let ends = |range: &std::ops::Range<usize>| {
        structure.joints[range.end - 1].middle() - structure.joints[range.start].middle()
    };
    let of = |span: &crate::structure::Span| match structure.is_half() {
        true => 2.0 * ends(&span.joints).x.abs(),
        false => ends(&span.joints).norm(),
    };
    structure.spans.iter().map(of).reduce(f64::max).unwrap_or_else(|| extent(structure))
}

/// Of the longest joint of every stone, the shortest.
fn thickness(structure: &Structure) -> f64 {
    let longest = |all: &Vec<usize>| all.iter().map(|&k| structure.joints[k].length()).reduce(f64::max);
    structure.joints_of_bodies().iter().filter_map(longest).fold(f64::INFINITY, f64::min)
}

/// For every body the lowest of those that it is bonded to, directly or through others.
fn groups(structure: &Structure) -> Vec<usize> {
    let mut group: Vec<usize> = (0..structure.bodies.len()).collect();
    let bonded = structure.joints.iter().filter(|joint| joint.law == JointLaw::Bonded);
    let pairs: Vec<[usize; 2]> =
        bonded.filter_map(|joint| Some([joint.between[0].body()?, joint.between[1].body()?])).collect();
    loop {
        let before = group.clone();
        for &[a, b] in &pairs {
            let low = group[a].min(group[b]);
            (group[a], group[b]) = (low, low);
        }
        if group == before {
            return group;
        }
    }
}

/// The ground of every support: below its joints, from the first to the last of those on one line, and as deep as that is
/// wide. The wall at the crown of half an arch goes on above and below. And the ground at a level, if one is stated.
fn grounds(structure: &Structure, span: f64, level: Option<f64>) -> Vec<RigidBody> {
    let extent = extent(structure);
    let far = FAR * (span + extent);
    let mut grounds: Vec<(Ground, usize, f64)> = Vec::new();
    for joint in &structure.joints {
        let (support, normal) = match joint.between {
            [Side::Support(support), _] => (support, joint.normal()),
            [_, Side::Support(support)] => (support, -joint.normal()),
            _ => continue,
        };
        let beyond = if joint.is_symmetry() { joint.tangent() * far } else { Vec2::zeros() };
        let friction = if joint.is_symmetry() { 0.0 } else { f64::INFINITY };
        let ground = Ground::new([joint.intrados - beyond, joint.extrados + beyond], normal);
        let number = structure.bodies.len() + support;
        let same = |(other, known, _): &&mut (Ground, usize, f64)| {
            *known == number && other.in_line(&ground, ON_LINE * extent)
        };
        match grounds.iter_mut().find(same) {
            Some((other, ..)) => other.reach_to(&ground),
            None => grounds.push((ground, number, friction)),
        }
    }
    let level = level.map(|y| Ground::new([Vec2::new(-far, y), Vec2::new(far, y)], Vec2::y()));
    grounds.extend(level.map(|level| (level, structure.bodies.len() + structure.supports, f64::INFINITY)));
    grounds.into_iter().map(|(ground, number, friction)| RigidBody::fixed(ground.corners(), number, friction)).collect()
}

/// Ground below a straight line: from one end to the other, and the unit normal out of it.
struct Ground {
    ends: [Vec2; 2],
    normal: Vec2,
}

impl Ground {
    /// With these ends in either order.
    fn new([a, b]: [Vec2; 2], normal: Vec2) -> Self {
        let ends = if normal.perp(&(b - a)) < 0.0 { [a, b] } else { [b, a] };
        Ground { ends, normal }
    }

    fn in_line(&self, other: &Ground, tolerance: f64) -> bool {
        let off = other.ends.map(|end| self.normal.dot(&(end - self.ends[0])).abs());
        self.normal.dot(&other.normal) > 0.0 && off.iter().all(|&off| off < tolerance)
    }

    fn reach_to(&mut self, other: &Ground) {
        let along = self.ends[1] - self.ends[0];
        let further = |a: Vec2, b: Vec2, sign: f64| if sign * along.dot(&(b - a)) > 0.0 { b } else { a };
        self.ends = [further(self.ends[0], other.ends[0], -1.0), further(self.ends[1], other.ends[1], 1.0)];
    }

    fn corners(&self) -> Vec<Vec2> {
        let [from, to] = self.ends;
        let down = self.normal * -(to - from).norm();
        vec![from + down, to + down, to, from]
    }
}
