//! How the arch moves when it falls: hinges, slides and the mode, from the joints that are at their limits.

mod released;

use super::motion::Motion;
use super::rigid_parts::RigidParts;
use super::smallest_motion::smallest_motion;
use super::{Face, Hinge, LiftOff, Mechanism, Mode, Slide};
use crate::budget::Budget;
use crate::geometry::{Vec2, mirrored};
use crate::limit::{Release, Resultant, releases};
use crate::structure::{Joint, JointLaw, Loops, PointForce, Side, Structure};
pub(super) use released::{columns, motions, unknowns};
use std::ops::Range;

/// Releases slower than this share of the fastest do not move.
const SLOWEST: f64 = 1e-6;
/// In a direction of the load path, joint motions below this share of the fastest corner are elastic strain or rounding.
pub(super) const ELASTIC: f64 = 1e-5;
/// The same on a path on moving geometry, where joints go on straining as the arch falls: measured, real hinges turn at a
/// hundredth or more of the fastest.
const MOVING_ELASTIC: f64 = 3e-4;

/// A joint whose force is below this share of the largest, times the share below which a corner's is none, carries none.
const NO_FORCE: f64 = 1e-3;
/// A joint parts altogether where one end opens by at least this share of what the other opens by; less is elastic strain of a
/// hinge.
const PARTS: f64 = 1e-3;

/// A joint and a motion that it allows.
pub(super) type Released = (usize, Release);

/// Finds the mechanism of an arch whose joints carry `resultants` at collapse: of all motions that open and slide only
/// joints at their limits, and in which the `driving` loads do work, the smallest (so that a symmetric arch under
/// symmetric loads falls symmetrically). None when the joints at their limits do not make a mechanism.
///
/// `slipping` holds the sign of the shear where a joint is known to slide (a hinge that slides has only half of the
/// joint's cohesion left, which the resultant alone does not tell). The structure's passive elements hold whom they press on: it
/// has those alone that are between their limits. `at_limit` is the share of a joint's force below which
/// a corner's is none, and within which its shear is at capacity; a joint that carries next to nothing of what others do
/// carries none. None, too, where the budget is spent.
pub(super) fn from_statics(
    structure: &Structure,
    resultants: &[Resultant],
    slipping: &[Option<f64>],
    driving: &[PointForce],
    at_limit: f64,
    budget: &Budget,
) -> Option<Mechanism> {
    let releases = all_releases(structure, resultants, slipping, at_limit);
    let parts = RigidParts::new(structure, &releases)?;
    let loops = Loops::new(&parts.structure).ok()?;
    let columns = columns(&parts.structure, &loops, &parts.released, &parts.loads(driving));
    let rates = smallest_motion(&columns, unknowns(&parts.structure, &loops), budget)?;
    Some(describe(structure, &Loops::new(structure).ok()?, &releases, &parts.of_all(&rates, releases.len())))
}

/// What all joints at their limits let happen; see [`from_statics`].
pub(super) fn all_releases(
    structure: &Structure,
    resultants: &[Resultant],
    slipping: &[Option<f64>],
    at_limit: f64,
) -> Vec<Released> {
    let none = NO_FORCE * at_limit * resultants.iter().map(Resultant::size).fold(0.0, f64::max);
    let of_joint = |(k, forces): (usize, &Resultant)| {
        let mut found = releases(&structure.joints[k], forces, none.max(at_limit * forces.size()));
        if let Some(sign) = slipping.get(k).copied().flatten()
            && !found.contains(&Release::Sliding(-sign))
        {
            found.push(Release::Sliding(-sign));
        }
        found.into_iter().map(move |release| (k, release))
    };
    resultants.iter().enumerate().flat_map(of_joint).collect()
}

/// The releases that a mechanism moves.
pub(super) fn released(mechanism: &Mechanism) -> Vec<Released> {
    let hinges = mechanism.hinges.iter().map(|hinge| (hinge.joint, Release::Rotation(hinge.face)));
    let slides = mechanism.slides.iter().map(|slide| (slide.joint, Release::Sliding(slide.rate.signum())));
    let both = |joint| [Face::Intrados, Face::Extrados].map(|face| (joint, Release::Rotation(face)));
    let lift_offs = mechanism.lift_offs.iter().flat_map(|lift_off| {
        let along = (lift_off.along != 0.0).then(|| (lift_off.joint, Release::Sliding(lift_off.along.signum())));
        both(lift_off.joint).into_iter().chain(along)
    });
    hinges.chain(slides).chain(lift_offs).collect()
}

/// The mechanism of these releases at their rates.
pub(super) fn describe(structure: &Structure, loops: &Loops, releases: &[Released], rates: &[f64]) -> Mechanism {
    let fastest = rates.iter().copied().fold(0.0, f64::max);
    let joints = structure.joints.len();
    let (mut openings, mut slid) = (vec![[0.0; 2]; joints], vec![0.0; joints]);
    for (&(k, release), &rate) in releases.iter().zip(rates) {
        match release {
            _ if rate <= SLOWEST * fastest => {}
            Release::Rotation(Face::Intrados) => openings[k][1] += rate,
            Release::Rotation(Face::Extrados) => openings[k][0] += rate,
            Release::Sliding(sign) => slid[k] += sign * rate,
        }
    }
    let motions = motions(structure, loops, releases, rates);
    assemble(structure, &motions[..structure.voussoirs().len()], &openings, &slid, &vec![false; joints])
}

/// Reads a mechanism off velocities of the stones; for paths whose peak is not a mechanism of the joints at their limits.
pub(super) fn from_velocities(structure: &Structure, motions: &[Motion]) -> Mechanism {
    let rates: Vec<_> = structure.ring().iter().map(|joint| corner_rates(joint, motions)).collect();
    read_off(structure, motions, &rates, &vec![false; rates.len()], ELASTIC)
}

/// Rates of gap and slip at the ends of a joint, intrados first.
pub(super) fn corner_rates(joint: &Joint, motions: &[Motion]) -> [[f64; 2]; 2] {
    let [before, after] = joint.between.map(|side| motion_of(side, motions).unwrap_or(Motion::STILL));
    let rate = |v: Vec2| [v.dot(&joint.normal()), v.dot(&joint.tangent())];
    [joint.intrados, joint.extrados].map(|corner| rate(after.plus(before, -1.0).at(corner)))
}

/// Speed of the fastest corner, of the bodies on both sides of each joint.
pub(super) fn fastest(structure: &Structure, motions: &[Motion]) -> f64 {
    let beside = |joint: &Joint| joint.between.map(|side| motion_of(side, motions)).into_iter().flatten();
    let speed = |joint: &Joint, m: Motion| m.at(joint.intrados).norm().max(m.at(joint.extrados).norm());
    structure.ring().iter().flat_map(|joint| beside(joint).map(move |m| speed(joint, m))).fold(0.0, f64::max)
}

/// Motion of what lies on a side of a joint, if it moves.
fn motion_of(side: Side, motions: &[Motion]) -> Option<Motion> {
    motions.get(side.body()?).copied()
}

/// Reads a mechanism off the rates of gap and slip at the corners of every joint, intrados first; `apart`: whether it carries
/// no force, being open at both ends.
pub(super) fn from_rates(
    structure: &Structure,
    motions: &[Motion],
    rates: &[[[f64; 2]; 2]],
    apart: &[bool],
) -> Mechanism {
    read_off(structure, motions, rates, apart, MOVING_ELASTIC)
}

/// Elastic strain and rounding are no joint motion: below this share of the fastest corner nothing opens or slides.
pub(super) fn read_off(
    structure: &Structure,
    motions: &[Motion],
    rates: &[[[f64; 2]; 2]],
    apart: &[bool],
    elastic: f64,
) -> Mechanism {
    let still = elastic * fastest(structure, motions);
    let moves = |rate: f64| if rate.abs() < still { 0.0 } else { rate };
    let opening = |((joint, [[i, _], [e, _]]), &apart): ((&Joint, &[[f64; 2]; 2]), &bool)| {
        let (i, e) = (moves(*i) / joint.length(), moves(*e) / joint.length());
        match apart || i.min(e) > PARTS * i.max(e) {
            true => [i, e],
            false if i > e => [i.max(0.0), 0.0],
            false => [0.0, e.max(0.0)],
        }
    };
    let slide = |(joint, [[_, i], [_, e]]): (&Joint, &[[f64; 2]; 2])| match joint.law {
        JointLaw::Bonded => 0.0,
        _ => moves(0.5 * (i + e)),
    };
    let openings: Vec<_> = structure.ring().iter().zip(rates).zip(apart).map(opening).collect();
    let slid: Vec<_> = structure.ring().iter().zip(rates).map(slide).collect();
    assemble(structure, motions, &openings, &slid, apart)
}

/// A mechanism from the motions of stones and joints: `openings` about the extrados and about the intrados, rad; `slid`, m.
/// Joints that open about both, or are `apart`, lift off, whatever they do along the joint.
fn assemble(
    structure: &Structure,
    motions: &[Motion],
    openings: &[[f64; 2]],
    slid: &[f64],
    apart: &[bool],
) -> Mechanism {
    let lifts = |k: usize| apart[k] || (openings[k][0] > 0.0 && openings[k][1] > 0.0);
    let lifted = lift_offs(structure, openings, slid, lifts);
    let sliding =
        || slid.iter().enumerate().filter(|&(k, &s)| s != 0.0 && !structure.joints[k].is_symmetry() && !lifts(k));
    let turning = || openings.iter().enumerate().filter(|&(k, o)| !lifts(k) && o[0] != o[1]);
    let hinge_rate = turning().flat_map(|(_, o)| *o).fold(0.0, f64::max);
    let slide_rate = sliding().map(|(_, s)| s.abs()).fold(0.0, f64::max);
    let lift_rate = lifted.iter().map(|l| l.intrados.abs().max(l.extrados.abs())).fold(0.0, f64::max);
    // A direction in which no joint moves keeps its own scale.
    let scale = 1.0 / [hinge_rate, slide_rate, lift_rate].into_iter().find(|&rate| rate > 0.0).unwrap_or(1.0);
    let hinges = turning().map(|(joint, o)| {
        // Open at the intrados, pressed at the extrados, and the other way round.
        let face = if o[0] > o[1] { Face::Extrados } else { Face::Intrados };
        let (angle_from_springing, angle_from_crown) = angles(structure, joint).unzip();
        let at = structure.joints[joint].end(face);
        Hinge { joint, face, at, angle_from_springing, angle_from_crown, rotation: (o[0] - o[1]).abs() * scale }
    });
    let slide = |(joint, &s)| Slide { joint, at: structure.joints[joint].middle(), rate: s * scale };
    let slides: Vec<Slide> = sliding().map(slide).collect();
    let motions: Vec<Motion> = motions.iter().map(|&m| Motion::STILL.plus(m, scale)).collect();
    let velocities = structure.voussoirs().iter().zip(&motions).map(|(v, m)| {
        let velocity = m.at(v.region.centroid);
        [velocity.x, velocity.y, m.spin]
    });
    let opening = turning().map(|(k, o)| (o[0] - o[1]).abs() * structure.joints[k].length()).fold(lift_rate, f64::max);
    let fastest_slide = slides.iter().map(|s| s.rate.abs()).fold(0.0, f64::max);
    let mode = match fastest_slide > opening * scale {
        true => Mode::Sliding,
        false if structure.spans.is_empty() => Mode::Overturning,
        false => crown_mode(structure, &motions),
    };
    let by = |l: LiftOff| {
        let [intrados, extrados, along] = [l.intrados, l.extrados, l.along].map(|rate| rate * scale);
        LiftOff { intrados, extrados, along, ..l }
    };
    let lift_offs = lifted.into_iter().map(by).collect();
    Mechanism { mode, hinges: hinges.collect(), slides, lift_offs, velocities: velocities.collect() }
}

impl Mechanism {
    /// With the mode of the span that carries the most of the scaled loads, where there are several.
    pub(super) fn under(mut self, scaled: &[PointForce], structure: &Structure) -> Self {
        let by_crown = matches!(self.mode, Mode::CrownRises | Mode::CrownDescends | Mode::Sway);
        if by_crown && structure.spans.len() > 1 && !scaled.is_empty() {
            let velocity = crown(structure, scaled).map(|body| {
                let [x, y, _] = self.velocities[body];
                Vec2::new(x, y)
            });
            self.mode = way(structure, 0.5 * (velocity[0] + velocity[1]));
        }
        self
    }

    /// With the places of the joints in `structure`, but those that they turn about.
    pub(super) fn placed_in(mut self, structure: &Structure) -> Self {
        for hinge in &mut self.hinges {
            (hinge.angle_from_springing, hinge.angle_from_crown) = angles(structure, hinge.joint).unzip();
        }
        self.slides.iter_mut().for_each(|slide| slide.at = structure.joints[slide.joint].middle());
        self.lift_offs.iter_mut().for_each(|lift_off| lift_off.at = structure.joints[lift_off.joint].middle());
        self
    }
}

/// The joints that lift off and move, with the rates at which their ends open and move along them, m.
fn lift_offs(
    structure: &Structure,
    openings: &[[f64; 2]],
    slid: &[f64],
    lifts: impl Fn(usize) -> bool,
) -> Vec<LiftOff> {
    let moving = openings.iter().zip(slid).enumerate().filter(|&(k, (o, s))| lifts(k) && (*o != [0.0; 2] || *s != 0.0));
    let rates = |(joint, (o, &along)): (usize, (&[f64; 2], &f64))| {
        let [intrados, extrados] = o.map(|rate| rate * structure.joints[joint].length());
        LiftOff { joint, at: structure.joints[joint].middle(), intrados, extrados, along }
    };
    moving.map(rates).collect()
}

/// Which way the crown goes; of several spans the one that moves fastest.
fn crown_mode(structure: &Structure, motions: &[Motion]) -> Mode {
    let velocity = |(_, [a, b]): (_, [usize; 2])| {
        let top = 0.5 * (structure.bodies[a].region.centroid + structure.bodies[b].region.centroid);
        0.5 * (motions[a].at(top) + motions[b].at(top))
    };
    let faster = |most: Vec2, next: Vec2| if next.norm() > most.norm() { next } else { most };
    way(structure, crowns(structure).map(velocity).fold(Vec2::zeros(), faster))
}

/// The mode of a crown that moves like this.
fn way(structure: &Structure, velocity: Vec2) -> Mode {
    if velocity.x.abs() > velocity.y.abs() && !structure.is_half() {
        Mode::Sway
    } else if velocity.y > 0.0 {
        Mode::CrownRises
    } else {
        Mode::CrownDescends
    }
}

/// The bodies whose mean is the crown; of several spans that of the one that carries the most of `forces`.
pub(super) fn crown(structure: &Structure, forces: &[PointForce]) -> [usize; 2] {
    let carried = |bodies: &Range<usize>| -> f64 {
        forces.iter().filter(|force| bodies.contains(&force.body)).map(|force| force.force.norm()).sum()
    };
    let weighed = crowns(structure).map(|(bodies, crown)| (carried(&bodies), crown));
    weighed.reduce(|most, next| if next.0 > most.0 { next } else { most }).map_or([0, 0], |(_, crown)| crown)
}

/// The bodies of every span (of a structure without spans: all), and its crown: the highest of them twice, or the two that are
/// equally high.
fn crowns(structure: &Structure) -> impl Iterator<Item = (Range<usize>, [usize; 2])> {
    let all = structure.spans.is_empty().then(|| 0..structure.voussoirs().len());
    all.into_iter().chain(structure.spans.iter().map(|span| span.bodies.clone())).map(|bodies| {
        let heights = structure.bodies[bodies.clone()].iter().map(|body| body.region.centroid.y);
        let (low, high) = heights.clone().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), y| (l.min(y), h.max(y)));
        let mut top = heights.enumerate().filter(|(_, y)| *y >= high - 1e-9 * (high - low)).map(|(k, _)| k);
        let first = top.next().unwrap_or(0);
        (bodies.clone(), [first, top.next_back().unwrap_or(first)].map(|k| bodies.start + k))
    })
}

/// Angles of a joint's middle about the middle between those of the springing joints of its span: from the nearer springing, and
/// from the crown (left negative), rad; None of a joint of no span.
fn angles(structure: &Structure, joint: usize) -> Option<(f64, f64)> {
    let span = structure.span_of(joint)?;
    let [first, last] = [span.joints.start, span.joints.end - 1].map(|k| &structure.joints[k]);
    // Half an arch ends on its axis.
    let other = if last.is_symmetry() { mirrored(first.middle(), last.middle().x) } else { last.middle() };
    let centre = 0.5 * (first.middle() + other);
    let from_vertical = |k: usize| {
        let r = structure.joints[k].middle() - centre;
        r.x.atan2(r.y)
    };
    let here = from_vertical(joint);
    // A plane of symmetry is no springing.
    let springings =
        [span.joints.start, span.joints.end - 1].into_iter().filter(|&k| !structure.joints[k].is_symmetry());
    let nearest = springings.map(|k| (from_vertical(k) - here).abs()).fold(f64::INFINITY, f64::min);
    Some((nearest, here))
}

#[cfg(test)]
mod tests;
