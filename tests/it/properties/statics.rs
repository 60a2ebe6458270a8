//! Statics of an answer, worked out anew from its own numbers: every stone in equilibrium, every joint within its law.

use super::scene::Solved;
use crate::common::largest::{larger, largest};
use voussoir::collapse::{Face, PathEnd, Snapshot};
use voussoir::geometry::Vec2;
use voussoir::structure::Joint;

/// Force and moment about a point, the moment over a length.
type Wrench = [f64; 3];

fn wrench(force: Vec2, at: Vec2, about: Vec2, length: f64) -> Wrench {
    let arm = at - about;
    [force.x, force.y, (arm.x * force.y - arm.y * force.x) / length]
}

fn add(sum: &mut Wrench, part: Wrench, sign: f64) {
    (0..3).for_each(|i| sum[i] += sign * part[i]);
}

/// Largest out-of-balance force or moment (over the joint's length) of any stone as a share of all loads: `joint(k, about, length)` is what
/// joint `k` does to the stone after it.
fn imbalance(solved: &Solved, factor: f64, joint: impl Fn(usize, Vec2, f64) -> Wrench) -> f64 {
    let analysis = &solved.analysis;
    let mut worst = 0f64;
    for (k, stone) in analysis.structure.voussoirs().iter().enumerate() {
        let (about, length) = (stone.region.centroid, analysis.structure.joints[k].length());
        let mut sum = joint(k, about, length);
        add(&mut sum, joint(k + 1, about, length), -1.0);
        for (loads, times) in [(&analysis.fixed, 1.0), (&analysis.scaled, factor)] {
            for load in loads.iter().filter(|load| load.body == k) {
                add(&mut sum, wrench(load.force * times, load.at, about, length), 1.0);
            }
        }
        worst = sum.iter().map(|part| part.abs()).fold(worst, larger);
    }
    worst / solved.weight(factor)
}

/// Imbalance of the stones under the thrust line at the end of a path.
pub fn of_thrust_line(solved: &Solved, end: &PathEnd) -> f64 {
    let joints = &solved.analysis.structure.ring();
    imbalance(solved, end.load_factor, |k, about, length| {
        let (joint, thrust) = (&joints[k], &end.thrust_line[k]);
        let force = joint.normal() * thrust.normal + joint.tangent() * thrust.shear;
        wrench(force, joint.middle() + joint.tangent() * thrust.eccentricity, about, length)
    })
}

/// Imbalance of the stones under the contact forces of a snapshot.
pub fn of_snapshot(solved: &Solved, snapshot: &Snapshot) -> f64 {
    let joints = &solved.analysis.structure.ring();
    imbalance(solved, snapshot.load_factor, |k, about, length| {
        let mut sum = [0.0; 3];
        for contact in snapshot.contacts.iter().filter(|contact| contact.joint == k) {
            let joint = &joints[k];
            let at = joint.intrados + (joint.extrados - joint.intrados) * contact.position;
            let force = joint.normal() * contact.normal + joint.tangent() * contact.tangential;
            add(&mut sum, wrench(force, at, about, length), 1.0);
        }
        sum
    })
}

/// By how much the thrust line leaves any joint or exceeds its friction, as a share of all loads; and how far any
/// point of it lies from where its eccentricity says, as a share of the joint.
pub fn excess(solved: &Solved, end: &PathEnd) -> [f64; 3] {
    let mut worst = [0f64; 3];
    for (joint, thrust) in solved.analysis.structure.ring().iter().zip(&end.thrust_line) {
        let Some([friction, cohesion]) = joint.law.coulomb() else { continue };
        let (half, normal) = (0.5 * joint.length(), thrust.normal);
        let outside = (normal * thrust.eccentricity.abs() - normal * half) / half;
        let slipping = thrust.shear.abs() - friction * normal - cohesion * joint.length();
        let astray = (thrust.at - joint.middle() - joint.tangent() * thrust.eccentricity).norm() / half;
        worst = [larger(larger(worst[0], outside), -normal), larger(worst[1], slipping), larger(worst[2], astray)];
    }
    let weight = solved.weight(end.load_factor);
    [worst[0] / weight, worst[1] / weight, worst[2]]
}

/// Velocity of the point `at` moving with stone `k`; the ground on either side stands still.
fn velocity(solved: &Solved, end: &PathEnd, k: Option<usize>, at: Vec2) -> (Vec2, f64) {
    let stones = &solved.analysis.structure.voussoirs();
    match k {
        Some(k) if k < stones.len() => {
            let ([u, v, spin], arm) = (end.mechanism.velocities[k], at - stones[k].region.centroid);
            (Vec2::new(u - spin * arm.y, v + spin * arm.x), spin)
        }
        _ => (Vec2::zeros(), 0.0),
    }
}

/// How far the velocities of the stones are from what hinges, slides and joints that part say, joint by joint: the velocity of
/// the stone after a joint relative to the one before it, at the hinge's face or at both ends, over the joint's length.
pub fn inconsistency(solved: &Solved, end: &PathEnd) -> f64 {
    let arch = &solved.analysis.structure;
    let mut worst = 0f64;
    for (k, joint) in arch.ring().iter().enumerate() {
        let wall = arch.is_half() && k == arch.voussoirs().len();
        let hinge = end.mechanism.hinges.iter().find(|hinge| hinge.joint == k);
        let slide = end.mechanism.slides.iter().find(|slide| slide.joint == k).map_or(0.0, |slide| slide.rate);
        let lift_off = end.mechanism.lift_offs.iter().find(|lift_off| lift_off.joint == k);
        let relative = |at: Vec2| {
            let (after, before) = (velocity(solved, end, Some(k), at), velocity(solved, end, k.checked_sub(1), at));
            (after.0 - before.0, after.1 - before.1)
        };
        let faces = hinge.map_or(vec![Face::Intrados, Face::Extrados], |hinge| vec![hinge.face]);
        for face in faces {
            let (jump, spin) = relative(corner(joint, face));
            let along = if wall { 0.0 } else { jump.dot(&joint.tangent()) - slide };
            let opens = lift_off.map_or(0.0, |l| if face == Face::Intrados { l.intrados } else { l.extrados });
            let opening = jump.dot(&joint.normal()) - opens;
            worst = largest([worst, opening.abs() / joint.length(), along.abs() / joint.length()]);
            // Turning about the intrados opens the extrados: the stone after the joint turns clockwise.
            let turning = hinge.map_or(0.0, |h| if h.face == Face::Intrados { -h.rotation } else { h.rotation });
            let spin = if lift_off.is_some() { turning } else { spin };
            worst = larger(worst, (spin - turning).abs());
        }
    }
    worst
}

fn corner(joint: &Joint, face: Face) -> Vec2 {
    if face == Face::Intrados { joint.intrados } else { joint.extrados }
}
