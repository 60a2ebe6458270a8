//! The contact points of a joint: where they are, their stiffness and their law.

use super::super::grid::{Grid, ON_LINE, OnSide};
use super::super::strips::{Points, consistent, nearest};
use super::Analysis;
use crate::collapse::Order;
use crate::dda::{Law, Touch};
use crate::geometry::Vec2;
use crate::structure::{Joint, JointLaw, PassiveElement};

/// Stiffness of the link between a contact point and a stone, over that of the joint there. In series, contact and
/// links (one towards the ground, two between stones) make up the joint's own.
const LINK: f64 = 4.0;

/// Stiffness of the cut through a keystone, where there is no joint, over that of joints: its compliance, a hundredth of theirs, is not
/// seen.
const CUT_STONE: f64 = 100.0;

/// What lies before and after a joint, and where the joint lies on it; none: the ground.
pub(super) type Around<'g> = [Option<(&'g Grid, OnSide)>; 2];

pub(super) fn around<'g>(joint: &Joint, grids: &'g [Grid]) -> Around<'g> {
    let on = |grid: &'g Grid| (grid, grid.beside([joint.intrados, joint.extrados]));
    joint.between.map(|side| side.body().map(|body| on(&grids[body])))
}

/// Normal and tangential contact penalty of a joint, N/m2: that of the softer of two stones.
pub(super) fn penalties(analysis: &Analysis, joint: &Joint) -> [f64; 2] {
    let stiffer = match joint.law {
        JointLaw::Mirror => CUT_STONE,
        // On the plane of symmetry a stone moves half as far towards it as two towards each other.
        law => law.halves(),
    };
    let softest = analysis.structure.stones_at(joint).map(|stone| stone.youngs_modulus).fold(f64::INFINITY, f64::min);
    let penalty = analysis.penalty_ratio * softest;
    [1.0, analysis.shear_penalty_ratio].map(|ratio| stiffer * penalty * ratio)
}

/// Contact points of a joint between two bodies (none: the ground), each with its share of the joint; in strips each is capped at
/// the strength, Pa, times the length of its own.
pub(super) fn touches<'a>(
    joint: &'a Joint,
    strips: Option<Points>,
    strength: f64,
    around: &Around<'a>,
    penalty: [f64; 2],
) -> impl Iterator<Item = Touch> + 'a {
    let [before, after] = *around;
    let links = around.iter().flatten().count() as f64;
    let contact = 1.0 / (1.0 - links / LINK);
    let pressure = if strips.is_some() { strength } else { f64::INFINITY };
    let (places, shares) = points(strips, joint.law, around);
    // A mirror plane holds across and lets slide along.
    let held = [1.0, if joint.law == JointLaw::Mirror { 0.0 } else { 1.0 }];
    (0..places.len()).map(move |j| {
        let eta = places[j];
        let sides = shares[j];
        let share = sides[0] + sides[1];
        // Two corners alone have the penalty each.
        let stiffness = penalty.map(|penalty| 2.0 * penalty * share);
        let nobody = [(0, 0.0); 2];
        Touch {
            at: joint.intrados + (joint.extrados - joint.intrados) * eta,
            normal: joint.normal(),
            stiffness: [0, 1].map(|way| held[way] * contact * stiffness[way]),
            link: stiffness.map(|stiffness| LINK * stiffness),
            law: law(joint, share, pressure),
            before: before.map_or(nobody, |(grid, on)| grid.on_joint(on, eta, sides)),
            after: after.map_or(nobody, |(grid, on)| grid.on_joint(on, eta, sides)),
        }
    })
}

/// The contact point of a passive element on a body cut like this, with that of its stone's joints for a `penalty`.
pub(super) fn passive(element: &PassiveElement, grid: &Grid, penalty: f64) -> Touch {
    // No stiffer than a joint; in series with the link it is as stiff as the soil.
    let (link, stiffness) = (LINK * penalty, (element.most / element.mobilised_at).min(penalty));
    let contact = stiffness * link / (link - stiffness);
    let mut after = [(0, 0.0); 2];
    let shares = grid.at(element.at);
    let all: f64 = shares.iter().take(2).map(|(_, share)| share).sum();
    after.iter_mut().zip(shares).for_each(|(held, (subblock, share))| *held = (subblock, share / all));
    Touch {
        at: element.at,
        normal: Vec2::new(element.way, 0.0),
        stiffness: [contact; 2],
        link: [link; 2],
        law: Law::Coulomb { friction: 0.0, cohesion: 0.0, cap: element.most },
        before: [(0, 0.0); 2],
        after,
    }
}

/// A joint's contact points: those of its strips, where it has any; else each of [`places`], with what is nearest to it; between
/// second-order subblocks, besides, the middles between these.
pub(super) fn points(strips: Option<Points>, law: JointLaw, around: &Around) -> Points {
    let second = around.iter().flatten().any(|(grid, _)| grid.order == Order::Second);
    let drawn = || if second { consistent(&lines(around)) } else { nearest(places(law, around)) };
    strips.unwrap_or_else(drawn)
}

/// Places of the contact points of a joint between two bodies, from 0 at its first end to 1 at its second.
///
/// Those of both sides: points of the finer side alone would put their forces off the middle of the coarser side's
/// subblocks. A cut through a stone is held as a seam is, in the middle of its subblocks: points at their corners would lock in
/// bending.
fn places(law: JointLaw, around: &Around<'_>) -> Vec<f64> {
    if let Some((grid, _)) = around[0].filter(|(grid, _)| law == JointLaw::Mirror && grid.radial > 1) {
        return (0..grid.radial).map(|i| (i as f64 + 0.5) / grid.radial as f64).collect();
    }
    lines(around)
}

/// Places of a joint's ends, and of all lines that meet it from either side.
fn lines(around: &Around<'_>) -> Vec<f64> {
    let lines = around.iter().flatten().flat_map(|(grid, on)| grid.lines_on(*on));
    let mut places: Vec<f64> = [0.0, 1.0].into_iter().chain(lines).collect();
    places.sort_by(f64::total_cmp);
    places.dedup_by(|a, b| *a - *b < ON_LINE);
    places
}

/// Law of a contact point that has this share of the joint, under a pressure of so much at most, Pa.
fn law(joint: &Joint, share: f64, pressure: f64) -> Law {
    match joint.law.coulomb() {
        Some([friction, cohesion]) => {
            let [cohesion, cap] = [cohesion, pressure].map(|stress| share * stress * joint.length());
            Law::Coulomb { friction, cohesion, cap }
        }
        None => Law::Bonded,
    }
}
