//! Small groups of bodies that touch: what may move while all else stands.

use crate::structure::{Joint, Structure};
use std::collections::BTreeSet;

/// Up to how many bodies they are grouped with two others, too.
const FEW: usize = 12;
/// Of more groups some are left out: programmes of large structures take long.
const MOST_GROUPS: usize = 60;

/// The joints beside every group.
pub(super) fn joints_beside(structure: &Structure) -> Vec<Vec<usize>> {
    let between: Vec<Vec<usize>> = structure.joints.iter().map(bodies_beside).collect();
    let groups = touching(structure.bodies.len(), &between);
    let joints = |together: &Vec<usize>| {
        let touched = |k: &usize| between[*k].iter().any(|body| together.contains(body));
        (0..between.len()).filter(touched).collect()
    };
    groups.iter().step_by(groups.len().div_ceil(MOST_GROUPS).max(1)).map(joints).collect()
}

/// Every body by itself and with one that it touches; where there are few, with two, too. `between`: the bodies beside every joint.
fn touching(bodies: usize, between: &[Vec<usize>]) -> BTreeSet<Vec<usize>> {
    let pairs: BTreeSet<Vec<usize>> =
        between.iter().filter(|beside| beside.len() == 2).map(|beside| joined(beside, &[])).collect();
    let mut all: BTreeSet<Vec<usize>> = (0..bodies).map(|body| vec![body]).chain(pairs.iter().cloned()).collect();
    if bodies <= FEW {
        let threes = pairs.iter().flat_map(|a| pairs.iter().map(|b| joined(a, b)));
        all.extend(threes.filter(|bodies| bodies.len() == 3));
    }
    all
}

/// Bodies of two groups, in order and each once.
fn joined(a: &[usize], b: &[usize]) -> Vec<usize> {
    BTreeSet::from_iter(a.iter().chain(b).copied()).into_iter().collect()
}

/// The bodies beside a joint.
fn bodies_beside(joint: &Joint) -> Vec<usize> {
    joint.between.iter().filter_map(|side| side.body()).collect()
}
