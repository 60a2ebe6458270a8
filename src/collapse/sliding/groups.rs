//! What may move while all else stands: small groups of bodies that touch, and rings of which parts come apart.

use crate::structure::{Joint, Structure};
use std::collections::{BTreeMap, BTreeSet};

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

/// Where rings may come apart: of the joints between two of them those from any one on to either end. So many at most, of all rings.
pub(super) fn partings(structure: &Structure, most: usize) -> Vec<Vec<usize>> {
    let rows = joints_between_rings(structure);
    let ends = |row: &Vec<usize>| (0..row.len()).flat_map(|i| [row[i..].to_vec(), row[..=i].to_vec()]).collect();
    let all: BTreeSet<Vec<usize>> = rows.iter().flat_map(|row| -> Vec<_> { ends(row) }).collect();
    all.iter().step_by(all.len().div_ceil(most).max(1)).cloned().collect()
}

/// The joints between every two rings that lie on each other, along them.
fn joints_between_rings(structure: &Structure) -> Vec<Vec<usize>> {
    let ring = |body: usize| structure.spans.iter().position(|span| span.bodies.contains(&body));
    let mut rows: BTreeMap<Vec<usize>, Vec<usize>> = BTreeMap::new();
    for (k, joint) in structure.joints.iter().enumerate() {
        let rings: Vec<usize> = bodies_beside(joint).into_iter().filter_map(ring).collect();
        if rings.len() == 2 && rings[0] != rings[1] {
            rows.entry(rings).or_default().push(k);
        }
    }
    rows.into_values().collect()
}

/// Every body by itself, with one that it touches and with two. `between`: the bodies beside every joint.
fn touching(bodies: usize, between: &[Vec<usize>]) -> BTreeSet<Vec<usize>> {
    let pairs: BTreeSet<Vec<usize>> =
        between.iter().filter(|beside| beside.len() == 2).map(|beside| joined(beside, &[])).collect();
    let mut all: BTreeSet<Vec<usize>> = (0..bodies).map(|body| vec![body]).chain(pairs.iter().cloned()).collect();
    let threes = pairs.iter().flat_map(|a| pairs.iter().map(|b| joined(a, b)));
    all.extend(threes.filter(|bodies| bodies.len() == 3));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::limit::scenes::wall;
    use crate::structure::{JointLaw, Span};

    #[test]
    fn rings_part_from_any_joint_on_to_either_end() {
        let law = JointLaw::Dry { friction: 0.5, cohesion: 0.0 };
        let mut structure = wall(&[&[1.0, 1.0], &[1.0, 1.0]], 1.0, law);
        assert_eq!(partings(&structure, 8), Vec::<Vec<usize>>::new(), "a wall has no rings");
        // As if both courses were rings.
        structure.spans = [0..2, 2..4].map(|bodies| Span { bodies, joints: 0..0 }).to_vec();
        let across = |k: &usize| {
            bodies_beside(&structure.joints[*k]) == [0, 2] || bodies_beside(&structure.joints[*k]) == [1, 3]
        };
        let row: Vec<usize> = (0..structure.joints.len()).filter(across).collect();
        let [left, right] = row[..] else { panic!("{row:?}") };
        assert_eq!(partings(&structure, 8), [vec![left], vec![left, right], vec![right]]);
        assert_eq!(partings(&structure, 2), [vec![left], vec![right]]);
    }
}
