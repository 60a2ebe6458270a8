//! Motion after collapse: from a structure, its loads and its report to rigid bodies on the move, and back to frames.

mod grounds;

use super::{
    Analysis, AnalysisError, CollapseReport, FallingMotion, MotionAsked, MotionContact, MotionEnd, MotionFrame, Note,
    OpenHinge, Outcome, Slid,
};
use crate::budget::Budget;
use crate::dda::falling::{Advance, Carried, Configuration, Falling, Interface, Member, Opening, RigidBody};
use crate::geometry::Vec2;
use crate::structure::{Face, Joint, JointLaw, Side, Structure, joined};
use grounds::{around, grounds};
use std::collections::BTreeSet;

/// The scaled loads are so much larger in the motion than at collapse, lest a perfectly balanced arch stay where it is.
const OVERLOAD: f64 = 0.01;
/// A load factor counts as at least this share of the one at which scaled and fixed loads are equal.
const SMALLEST_FACTOR: f64 = 0.01;
/// Stones closer than this share of the thickness touch; joints that open or slide by more are hinges and slides.
const TOUCHING: f64 = 1e-3;
/// A structure that has moved by less than this share of its thickness has not begun to fall.
const BEGUN: f64 = 0.02;
/// Cosine of the angle by which a force between two bodies is off the normal of their joint, from which on it is none of the joint's.
const ACROSS: f64 = 0.999;
/// Forces below this share of the largest are none.
const PRESSES: f64 = 1e-6;

/// Friction beyond its bound by more than this share of the loads is told.
const BEYOND: f64 = 1e-6;

/// A load factor and how far it is beyond that of collapse.
type Loading = (f64, f64);

/// Moves the structure on from the collapse in a report, and from the other end of a window too.
pub(super) fn follow(analysis: &Analysis, report: &mut CollapseReport, budget: &Budget) -> Result<(), AnalysisError> {
    let Some(asked) = analysis.task.motion() else { return Ok(()) };
    let as_built = matches!(report.outcome, Outcome::FallsAsBuilt | Outcome::SlidesAsBuilt);
    let ends = matches!(report.outcome, Outcome::Collapse | Outcome::StandsInWindow | Outcome::Crushes);
    let falls = as_built || ends;
    if !falls || (report.end.is_none() && report.other_end.is_none()) {
        return Ok(());
    }
    let sign = analysis.task.sign();
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
    for (motion, sign) in [(&report.motion, sign), (&report.other_motion, -sign)] {
        let beyond = motion.as_ref().and_then(|motion| rests_beyond(&analysis.structure, report, motion, sign));
        report.notes.extend(beyond);
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
    let small = SMALLEST_FACTOR * total(&analysis.fixed) / total(&analysis.scaled).max(f64::MIN_POSITIVE);
    let beyond = |at: f64| at + sign * OVERLOAD * at.abs().max(small);
    let limit = report.limit_window.map(|window| if sign > 0.0 { window.highest } else { window.lowest });
    let further = limit.filter(|limit| limit.is_finite() && sign * (beyond(*limit) - beyond(at)) > 0.0);
    std::iter::once(at).chain(further).map(|from| (beyond(from), beyond(from) - at)).collect()
}

/// Where a motion does not begin although limit analysis, which knows the joints only, finds no equilibrium at its loads.
fn rests_beyond(structure: &Structure, report: &CollapseReport, motion: &FallingMotion, sign: f64) -> Option<Note> {
    let (window, last) = (report.limit_window?, motion.frames.last()?);
    let (limit, load_factor) = (if sign > 0.0 { window.highest } else { window.lowest }, motion.load_factor);
    let rests = motion.end == MotionEnd::AtRest && last.displacement < BEGUN * motion.thickness;
    let largest = last.contacts.iter().map(|contact| contact.normal).fold(0.0, f64::max);
    let of_joint = |contact: &MotionContact| {
        contact.joint.is_some_and(|k| structure.joints[k].normal().dot(&contact.direction).abs() > ACROSS)
    };
    let beside = last.contacts.iter().filter(|contact| contact.normal > PRESSES * largest && !of_joint(contact));
    let bodies: BTreeSet<usize> = beside.flat_map(|contact| contact.bodies).flatten().collect();
    let bodies = bodies.into_iter().collect();
    (rests && sign * (load_factor - limit) > 0.0).then_some(Note::MotionRestsBeyond { load_factor, limit, bodies })
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
    let moving = RigidStones::new(analysis, load_factor, asked.ground_level);
    let RigidStones { mut falling, span, thickness, .. } = moving.clone();
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
            Ok(Advance::Rest(rest)) => {
                frames.push(moving.read(&rest));
                break MotionEnd::AtRest;
            }
            Err(_) => break MotionEnd::Lost,
        }
        frames.push(moving.read(&configuration));
    };
    Ok(FallingMotion { end, load_factor, overload, span, thickness, frames })
}

/// A structure as rigid bodies: stones that are bonded are one, and what is bonded to the ground cannot move.
#[derive(Clone)]
struct RigidStones<'a> {
    structure: &'a Structure,
    falling: Falling,
    /// The rigid body of every stone that is told of, and the stone's centroid from that body's at the start, m.
    stones: Vec<(usize, Vec2)>,
    span: f64,
    thickness: f64,
}

impl<'a> RigidStones<'a> {
    fn new(analysis: &'a Analysis, load_factor: f64, ground_level: Option<f64>) -> Self {
        let structure = &analysis.structure;
        let (span, thickness) = (span(structure), thickness(structure));
        let group = groups(structure);
        let (mut bodies, mut body_of) = (Vec::new(), vec![0; group.len()]);
        for (k, &first) in group.iter().enumerate() {
            body_of[k] = body_of[first];
            if first == k {
                body_of[k] = bodies.len();
                let members = (k..group.len()).filter(|&other| group[other] == k).map(|k| member(structure, k));
                bodies.push(RigidBody::new(members.collect()));
            }
        }
        for joint in &structure.joints {
            let ([Some(body), None] | [None, Some(body)]) = joint.between.map(Side::body) else { continue };
            match joint.law {
                JointLaw::Bonded => bodies[body_of[body]].free = [false; 3],
                // What the plane of symmetry cuts through stays upright on it.
                JointLaw::Mirror => bodies[body_of[body]].free = [false, true, false],
                _ => {}
            }
        }
        for (forces, factor) in [(&analysis.fixed, 1.0), (&analysis.scaled, load_factor)] {
            forces.iter().for_each(|f| bodies[body_of[f.body]].push(f.at, f.force * factor));
        }
        let centroid = |k: usize| RigidBody::new(vec![member(structure, k)]).centroid;
        let stone = |k: usize| (body_of[k], centroid(k) - bodies[body_of[k]].centroid);
        let stones = (0..structure.voussoirs().len()).map(stone).collect();
        bodies.extend(grounds(structure, ground_level));
        let falling =
            Falling::new(bodies, structure.joints.iter().map(|j| interface(structure, j)).collect(), thickness);
        RigidStones { structure, falling, stones, span, thickness }
    }

    fn read(&self, configuration: &Configuration) -> MotionFrame {
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
        let (hinges, slides) = self.hinges(&configuration.openings);
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

    /// Joints that touch at one end only, and those that have slid.
    fn hinges(&self, openings: &[Opening]) -> (Vec<OpenHinge>, Vec<Slid>) {
        let near = TOUCHING * self.thickness;
        let (mut hinges, mut slides) = (Vec::new(), Vec::new());
        let joints = self.structure.joints.iter().map(|joint| joint.law.coulomb().is_some());
        for (joint, (opening, dry)) in openings.iter().zip(joints).enumerate() {
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
        (hinges, slides)
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

/// The longest between the middles of springing joints; of half an arch, twice the half; of blocks their extent.
fn span(structure: &Structure) -> f64 {
    let ends = |range: &std::ops::Range<usize>| {
        structure.joints[range.end - 1].middle() - structure.joints[range.start].middle()
    };
    let of = |span: &crate::structure::Span| match structure.is_half() {
        true => 2.0 * ends(&span.joints).x.abs(),
        false => ends(&span.joints).norm(),
    };
    structure.spans.iter().map(of).reduce(f64::max).unwrap_or_else(|| around(structure).1)
}

/// Of the longest joint of every stone, the shortest.
fn thickness(structure: &Structure) -> f64 {
    let longest = |all: &Vec<usize>| all.iter().map(|&k| structure.joints[k].length()).reduce(f64::max);
    structure.joints_of_bodies().iter().filter_map(longest).fold(f64::INFINITY, f64::min)
}

/// For every body the lowest of those that it is bonded to, directly or through others.
fn groups(structure: &Structure) -> Vec<usize> {
    let bonded = structure.joints.iter().filter(|joint| joint.law == JointLaw::Bonded);
    let pairs = bonded.filter_map(|joint| Some([joint.between[0].body()?, joint.between[1].body()?]));
    joined(structure.bodies.len(), pairs)
}
