//! Forces that an answer reports, judged by equilibrium and by the law of the joints alone.

use super::{Contact, Problem, area_and_centroid, total};
use crate::common::largest::{larger, largest};

/// The force of a joint as an answer reports it: all that goes through the joint, acting on what lies after it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reported {
    /// Compression is positive, N per metre of width.
    pub normal: f64,
    /// From the first end of the joint to its second, N per metre of width.
    pub shear: f64,
    /// Where the normal force acts: from the middle of the joint towards its second end, m.
    pub eccentricity: f64,
}

impl Reported {
    /// From the normal forces at both ends and the shear force.
    pub fn of_ends(contact: &Contact, [first, second, shear]: super::Forces) -> Reported {
        let normal = first + second;
        let eccentricity = if normal == 0.0 { 0.0 } else { 0.5 * contact.length() * (second - first) / normal };
        Reported { normal, shear, eccentricity }
    }
}

/// What an end of an answer on the wire reports of its joints, in their order: its `thrust_line`, which has these very signs.
#[cfg(feature = "server")]
pub fn of_end(end: &serde_json::Value) -> Vec<Reported> {
    let column = |name: &str| {
        let values = end["thrust_line"][name].as_array().unwrap_or_else(|| panic!("no thrust_line/{name}"));
        values.iter().map(|value| value.as_f64().expect("a number")).collect::<Vec<_>>()
    };
    let rows = column("normal_n_per_m").into_iter().zip(column("shear_n_per_m")).zip(column("eccentricity_m"));
    rows.map(|((normal, shear), eccentricity)| Reported { normal, shear, eccentricity }).collect()
}

/// The worst of all, as a share of the sum of all loads; moments are over the size of their block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worst {
    /// What a block lacks to equilibrium, and which one.
    pub residual: f64,
    pub block: usize,
    /// Tension at an end of a joint or shear beyond Coulomb's bound, and at which joint.
    pub violation: f64,
    pub joint: usize,
}

/// Holds the forces of all `problem.contacts`, in their order, against equilibrium under the fixed loads and `factor` times the
/// scaled ones, and against the law of the joints.
///
/// # Panics
/// Where a force is no number or one is missing.
pub fn recheck(problem: &Problem, factor: f64, forces: &[Reported]) -> Worst {
    assert_eq!(forces.len(), problem.contacts.len(), "a force for every joint");
    let numbers = forces.iter().flat_map(|f| [f.normal, f.shear, f.eccentricity]);
    assert!(numbers.chain([factor]).all(f64::is_finite), "forces are numbers");
    let loads = problem.loads_at(factor);
    let unit = total(&loads).max(f64::MIN_POSITIVE);
    let mut sums = vec![[0.0; 3]; problem.blocks.len()];
    let centres: Vec<_> = problem.blocks.iter().map(|corners| area_and_centroid(corners).1).collect();
    let mut add = |block: usize, at: [f64; 2], force: [f64; 2]| {
        let arm = [at[0] - centres[block][0], at[1] - centres[block][1]];
        let wrench = [force[0], force[1], arm[0] * force[1] - arm[1] * force[0]];
        (0..3).for_each(|k| sums[block][k] += wrench[k]);
    };
    loads.iter().for_each(|push| add(push.block, push.at, push.force));
    for (contact, force) in problem.contacts.iter().zip(forces) {
        let (normal, along) = contact.unit_vectors();
        let [a, b] = contact.ends;
        let at = [0, 1].map(|i| 0.5 * (a[i] + b[i]) + force.eccentricity * along[i]);
        let whole = [0, 1].map(|i| force.normal * normal[i] + force.shear * along[i]);
        for (block, sign) in [(contact.between[0], -1.0), (contact.between[1], 1.0)] {
            if let Some(block) = block {
                add(block, at, whole.map(|f| sign * f));
            }
        }
    }
    let residual = |(block, sum): (usize, &[f64; 3])| {
        let size = size(&problem.blocks[block], centres[block]);
        (block, largest([sum[0], sum[1], sum[2] / size].map(f64::abs)) / unit)
    };
    let (block, residual) = worst(sums.iter().enumerate().map(residual));
    let all = problem.contacts.iter().zip(forces).map(|(contact, force)| violation(contact, force) / unit);
    let (joint, violation) = worst(all.enumerate());
    Worst { residual, block, violation, joint }
}

/// Tension at an end, or shear beyond its bound, N; 0 where the law holds.
fn violation(contact: &Contact, force: &Reported) -> f64 {
    let lean = force.normal * force.eccentricity / contact.length();
    let ends = [0.5 * force.normal - lean, 0.5 * force.normal + lean];
    let bound = contact.friction * force.normal.max(0.0) + contact.cohesion * contact.length();
    largest([-ends[0], -ends[1], force.shear.abs() - bound])
}

fn size(corners: &[[f64; 2]], centre: [f64; 2]) -> f64 {
    corners.iter().map(|c| (c[0] - centre[0]).hypot(c[1] - centre[1])).fold(0.0, f64::max)
}

fn worst(all: impl Iterator<Item = (usize, f64)>) -> (usize, f64) {
    all.fold(
        (0, 0.0),
        |worst, one| if larger(one.1, worst.1) == worst.1 { worst } else { (one.0, larger(one.1, worst.1)) },
    )
}
