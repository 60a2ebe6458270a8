//! Motion after collapse: from an arch, its loads and its report to rigid blocks on the move, and back to frames.

use super::{
    Analysis, AnalysisError, CollapseReport, Direction, FallingMotion, MotionAsked, MotionContact, MotionEnd,
    MotionFrame, Note, OpenHinge, Outcome, Slid,
};
use crate::budget::Budget;

use crate::dda::falling::{Advance, Block, Corners, Falling, Frame, Friction};
use crate::geometry::Vec2;
use crate::structure::{Face, Joint, JointLaw, Structure};

/// The scaled loads are so much larger in the motion than at collapse, lest a perfectly balanced arch stay where it is.
const OVERLOAD: f64 = 0.01;
/// A load factor counts as at least this share of the one at which scaled and fixed loads are equal.
const SMALL: f64 = 0.01;
/// Stones closer than this share of the thickness touch; joints that open or slide by more are hinges and slides.
const NEAR: f64 = 1e-3;
/// An arch that has moved by less than this share of its thickness has not begun to fall.
const BEGUN: f64 = 0.02;

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
    let halved = analysis.structure.ring().iter().any(|joint| joint.law == JointLaw::Mirror);
    if halved || !holds_together(&analysis.structure) {
        report.notes.push(if halved { Note::MotionOfHalfStone } else { Note::MotionOfBondedStones });
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
    let structure = &analysis.structure;
    let thickness = structure.ring().iter().map(Joint::length).fold(f64::INFINITY, f64::min);
    let span = span(structure);
    let mut falling = falling(analysis, load_factor, thickness);
    let mut frame = falling.frame();
    let mut frames = vec![read(&frame, thickness)];
    let end = loop {
        let events = report.cost.events + frames.len();
        if budget.step(load_factor, events).is_break() {
            return Err(budget.stopped().into());
        }
        if let Some(joint) = falling.parted(&frame) {
            break MotionEnd::StoneFree { voussoir: freed(&frame, &frames, joint), joint };
        }
        if frame.displacement >= asked.share_of_span * span {
            break MotionEnd::Moved;
        }
        if frames.len() > asked.most_frames {
            break MotionEnd::StepLimit;
        }
        let advance = falling.advance(budget);
        budget.check()?;
        match advance {
            Ok(Advance::Moved(next)) => frame = *next,
            Ok(Advance::Rest) => break MotionEnd::AtRest,
            Ok(Advance::Meet(voussoirs)) => break MotionEnd::StonesMeet { voussoirs },
            Err(_) => break MotionEnd::Lost,
        }
        frames.push(read(&frame, thickness));
    };
    Ok(FallingMotion { end, load_factor, overload, span, thickness, frames })
}

/// Of the two stones at a joint that has opened through the one that moved more in the last step.
fn freed(frame: &Frame, frames: &[MotionFrame], joint: usize) -> usize {
    let before = &frames[frames.len().saturating_sub(2)];
    let moved = |k: usize| frame.places.get(k).map(|place| (place.centroid - before.centroids[k]).norm());
    match (joint.checked_sub(1).and_then(moved), moved(joint)) {
        (Some(a), Some(b)) if a > b => joint - 1,
        (Some(_), None) => joint - 1,
        _ => joint,
    }
}

/// Between the middles of the springing joints; of half an arch, twice the half.
fn span(structure: &Structure) -> f64 {
    let (first, last) = (structure.joints[0].middle(), structure.joints[structure.ring().len() - 1].middle());
    if structure.is_half() { 2.0 * (last.x - first.x).abs() } else { (last - first).norm() }
}

/// True unless a bonded joint joins stones that can move.
fn holds_together(structure: &Structure) -> bool {
    let fixed = fixed(structure);
    let bonded = |(k, joint): (usize, &Joint)| {
        let stands = |stone: Option<usize>| stone.and_then(|stone| fixed.get(stone)).is_none_or(|&fixed| fixed);
        joint.law != JointLaw::Bonded || (stands(k.checked_sub(1)) && stands(Some(k)))
    };
    structure.ring().iter().enumerate().all(bonded)
}

/// Stones that are bonded to the ground, directly or through others.
fn fixed(structure: &Structure) -> Vec<bool> {
    let n = structure.voussoirs().len();
    let bonded = |k: &usize| structure.joints[*k].law == JointLaw::Bonded;
    let left = (0..n).take_while(bonded).count();
    let right = (1..=n).rev().take_while(bonded).count();
    (0..n).map(|k| k < left || k + right >= n).collect()
}

fn falling(analysis: &Analysis, load_factor: f64, thickness: f64) -> Falling {
    let structure = &analysis.structure;
    let stone = |(k, two): (usize, &[Joint])| {
        let corners = [two[0].intrados, two[1].intrados, two[1].extrados, two[0].extrados];
        Block::new(corners, structure.stone_of(k).density)
    };
    let mut blocks: Vec<Block> = structure.ring().windows(2).enumerate().map(stone).collect();
    for (block, fixed) in blocks.iter_mut().zip(fixed(structure)) {
        block.fixed = fixed;
    }
    for (forces, factor) in [(&analysis.fixed, 1.0), (&analysis.scaled, load_factor)] {
        forces.iter().for_each(|force| blocks[force.body].push(force.at, force.force * factor));
    }
    let friction = |joint: &Joint| {
        let [coefficient, cohesion] = joint.law.coulomb().unwrap_or_default();
        Friction { coefficient, cohesion: cohesion * joint.length() }
    };
    Falling::new(blocks, grounds(structure), structure.ring().iter().map(friction).collect(), thickness)
}

/// What the springing joints stand on: as wide as they are, and as deep as wide. The wall at the crown of half an arch
/// goes on above and below.
fn grounds(structure: &Structure) -> [Option<Corners>; 2] {
    let [first, last] = [structure.joints[0], structure.joints[structure.ring().len() - 1]];
    let back = first.normal() * -first.length();
    let left = [first.intrados + back, first.intrados, first.extrados, first.extrados + back];
    let on = last.normal() * last.length();
    let beyond: Vec2 = last.tangent() * if structure.is_half() { 10.0 * span(structure) } else { 0.0 };
    let (inner, outer) = (last.intrados - beyond, last.extrados + beyond);
    [Some(left), Some([inner, inner + on, outer + on, outer])]
}

fn read(frame: &Frame, thickness: f64) -> MotionFrame {
    let contact = |c: &crate::dda::falling::Carried| MotionContact {
        joint: c.interface,
        at: c.at,
        direction: c.direction,
        normal: c.normal,
        tangential: c.tangential,
        gap: c.gap,
    };
    let (mut hinges, mut slides) = (Vec::new(), Vec::new());
    for (joint, meeting) in frame.meetings.iter().enumerate() {
        let Some(meeting) = meeting.filter(|m| m.facing && m.distance <= NEAR * thickness) else { continue };
        let open = meeting.touches.map(|touch| touch.is_none_or(|touch| touch.gap > NEAR * thickness));
        if open[0] != open[1] {
            let face = if open[0] { Face::Extrados } else { Face::Intrados };
            hinges.push(OpenHinge { joint, face, opening: meeting.opening.abs() });
        }
        if frame.slid[joint].abs() > NEAR * thickness {
            slides.push(Slid { joint, by: frame.slid[joint] });
        }
    }
    MotionFrame {
        parameter: frame.parameter,
        centroids: frame.places.iter().map(|place| place.centroid).collect(),
        rotations: frame.places.iter().map(|place| place.angle).collect(),
        contacts: frame.carried.iter().map(contact).collect(),
        hinges,
        slides,
        displacement: frame.displacement,
        penetration: frame.overlap / thickness,
        residual: frame.residual,
        excess: frame.excess,
        work: frame.work,
    }
}
