//! Whether forces and velocities are a full solution without dilation, from plain numbers alone.

use super::recheck::Reported;
use super::{Problem, area_and_centroid, total};
use crate::common::largest::larger;

/// How far from a full solution they are; velocities count as shares of the fastest corner, forces as shares of the loads.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Gap {
    /// Corners of joints that enter each other.
    pub entering: f64,
    /// Force at a corner that opens: the product.
    pub opens_under_force: f64,
    /// Friction short of its bound, or with the sliding, where a joint slides: the product.
    pub slides_freely: f64,
    /// Power of the scaled loads.
    pub power: f64,
}

/// `velocities` are (u, v, spin) of every block, at its centroid.
pub fn measure(problem: &Problem, factor: f64, forces: &[Reported], velocities: &[[f64; 3]]) -> Gap {
    let centres: Vec<_> = problem.blocks.iter().map(|corners| area_and_centroid(corners).1).collect();
    let at = |block: Option<usize>, [x, y]: [f64; 2]| {
        let Some(block) = block else { return [0.0; 2] };
        let ([u, v, spin], [cx, cy]) = (velocities[block], centres[block]);
        [u - spin * (y - cy), v + spin * (x - cx)]
    };
    let fastest = (0..problem.blocks.len())
        .flat_map(|block| problem.blocks[block].iter().map(move |corner| at(Some(block), *corner)))
        .fold(0.0, |most: f64, [u, v]| most.max(u.hypot(v)));
    let loads = total(&problem.loads_at(factor));
    let mut gap = Gap::default();
    for (contact, force) in problem.contacts.iter().zip(forces) {
        let (normal, along) = contact.unit_vectors();
        let lean = force.normal * force.eccentricity / contact.length();
        let ends = [0.5 * force.normal - lean, 0.5 * force.normal + lean];
        let rate = |end: [f64; 2], way: [f64; 2]| {
            let [before, after] = contact.between.map(|block| at(block, end));
            ((after[0] - before[0]) * way[0] + (after[1] - before[1]) * way[1]) / fastest
        };
        for (end, force) in contact.ends.into_iter().zip(ends) {
            let opening = rate(end, normal);
            gap.entering = larger(gap.entering, -opening);
            gap.opens_under_force = larger(gap.opens_under_force, opening.max(0.0) * force.abs() / loads);
        }
        let slip = rate(contact.ends[0], along);
        let bound = contact.friction * force.normal + contact.cohesion * contact.length();
        // Friction acts on what lies after the joint, against its sliding.
        let short = bound + slip.signum() * force.shear;
        gap.slides_freely = larger(gap.slides_freely, slip.abs() * short / loads);
    }
    let power = |push: &super::Push| {
        let [u, v] = at(Some(push.block), push.at);
        (push.force[0] * u + push.force[1] * v) / fastest
    };
    gap.power = problem.scaled.iter().map(power).sum::<f64>() / total(&problem.scaled);
    gap
}
