//! What releases of joints do to a structure: to its loops, to soil, and to the work of loads.

use super::super::motion::Motion;
use super::super::smallest_motion::Column;
use super::Released;
use crate::geometry::Vec2;
use crate::limit::Release;
use crate::structure::{Face, Loops, PassiveElement, PointForce, Structure, resultants};

/// Closures of all loops, the velocity of every passive element, and the power: what [`columns`] has entries for.
pub(in crate::collapse) fn unknowns(structure: &Structure, loops: &Loops) -> usize {
    3 * loops.len() + structure.passive.len() + 1
}

/// What each release does to the closure of every loop (two velocities over the size of the structure, and a spin), to the velocity
/// of every passive element over that size, and its power under the `driving` loads: what the joint carries of them down the tree
/// does no work but in its own motion.
pub(in crate::collapse) fn columns(
    structure: &Structure,
    loops: &Loops,
    releases: &[Released],
    driving: &[PointForce],
) -> Vec<Column> {
    let carried = loops.carried(&resultants(structure.bodies.len(), driving, Vec2::zeros()));
    let total = driving.iter().map(|f| f.force.norm()).sum::<f64>();
    let size = structure.joints.iter().map(|j| j.middle().norm()).fold(0.0, f64::max);
    let last = unknowns(structure, loops) - 1;
    let mut soil = vec![Vec::new(); structure.joints.len()];
    for (e, element) in structure.passive.iter().enumerate() {
        let down = loops.way_down(element.body);
        down.for_each(|(k, sign)| soil[k].push((3 * loops.len() + e, sign, element)));
    }
    let column = |&(k, release): &Released| {
        let motion = relative_motion(structure, k, release);
        let ([fx, fy, moment], closure) = (carried[k], motion.velocity / size);
        let power = -(fx * motion.velocity.x + fy * motion.velocity.y + moment * motion.spin) / (total * size);
        let parts = [closure.x, closure.y, motion.spin];
        let round = |&(number, sign): &(usize, f64)| [0, 1, 2].map(|i| (3 * number + i, sign * parts[i]));
        // A release moves all that hangs on its joint.
        let approach = |&(row, sign, element): &(usize, f64, &PassiveElement)| {
            (row, sign * element.way * motion.at(element.at).x / size)
        };
        let soil = soil[k].iter().map(approach);
        loops.through(k).iter().flat_map(round).chain(soil).chain([(last, power)]).collect()
    };
    releases.iter().map(column).collect()
}

/// Motion of what lies after joint `k` relative to what lies before it, for a release of unit rate.
fn relative_motion(structure: &Structure, k: usize, release: Release) -> Motion {
    let joint = &structure.joints[k];
    match release {
        // Clockwise about the intrados, counter-clockwise about the extrados: the other end opens.
        Release::Rotation(Face::Intrados) => Motion::about(joint.intrados, -1.0),
        Release::Rotation(Face::Extrados) => Motion::about(joint.extrados, 1.0),
        Release::Sliding(sign) => Motion { velocity: joint.tangent() * sign, spin: 0.0 },
    }
}

/// Motions of all bodies in which joints are released at these rates.
pub(in crate::collapse) fn motions(
    structure: &Structure,
    loops: &Loops,
    releases: &[Released],
    rates: &[f64],
) -> Vec<Motion> {
    let mut relative = vec![Motion::STILL; structure.joints.len()];
    for (&(k, release), &rate) in releases.iter().zip(rates) {
        relative[k] = relative[k].plus(relative_motion(structure, k, release), rate);
    }
    let relative: Vec<_> = relative.iter().map(|m| [m.velocity.x, m.velocity.y, m.spin]).collect();
    let motion = |[x, y, spin]: [f64; 3]| Motion { velocity: Vec2::new(x, y), spin };
    loops.motions(&relative).into_iter().map(motion).collect()
}
