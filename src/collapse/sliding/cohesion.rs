//! Joints with cohesion, in chains of bodies.
//!
//! A joint that opens, however little, may have lost its cohesion. So the sum of two motions, in one of which a joint slides while it
//! opens in the other, has other conditions than both, and may have a lower load than either: corners of all motions are not enough.
//! The sums that matter move no more joints than one of their parts, as every joint that moves costs a condition; or they are even.

use super::super::mechanism::Released;
use super::hunt::{Costs, Hunt, Moves};
use crate::limit::Release;

/// Other motions of the same joints that are added to one.
const OTHERS: usize = 2;
/// Random motions of everything: so many over the number of joints, but no fewer and no more than these.
const TRIES: usize = 40_000;
const FEWEST: usize = 400;
const MOST: usize = 3000;

impl Hunt<'_> {
    /// How many motions of everything a structure whose joints have cohesion is worth (measured on 120 random arches, each of them
    /// whole, by halves and mirrored: with a tenth of them twice as many loads are too high).
    pub(super) fn adhesive_tries(&self) -> usize {
        (TRIES / self.search.theorem.joints().max(1)).clamp(FEWEST, MOST)
    }

    /// Sums of one of the motions of these releases with others of the joints that it moves and, where the mirror image of a motion is
    /// another one, with that.
    pub(super) fn sums(&mut self, released: &[Released], motion: &Moves) -> Vec<Moves> {
        let moves = |(joint, _): &&Released| motion.0.iter().any(|(other, _)| other == joint);
        let here: Vec<Released> = released.iter().filter(moves).copied().collect();
        let mut sums = Vec::new();
        for _ in 0..OTHERS {
            let Some(other) = self.motion(&here, Costs::Even) else { break };
            sums.extend(sum(motion, &other));
        }
        if self.even {
            let last = self.search.theorem.joints() - 1;
            let even = |motion: &Moves| sum(motion, &mirrored(motion, last));
            let of_sums: Vec<_> = sums.iter().filter_map(even).collect();
            sums.extend(even(motion).into_iter().chain(of_sums));
        }
        sums
    }
}

/// The sum of two motions; none where a joint would slide one way in the one, and the other way in the other.
fn sum(one: &Moves, other: &Moves) -> Option<Moves> {
    let mut sum: Vec<(Released, f64)> = Vec::new();
    for (release, rate) in [one, other].into_iter().flat_map(|(moving, rates)| moving.iter().zip(rates)) {
        match sum.iter_mut().find(|(known, _)| known == release) {
            Some((_, of_both)) => *of_both += rate,
            None => sum.push((*release, *rate)),
        }
    }
    sum.sort_by_key(|((joint, _), _)| *joint);
    let slides = |((joint, release), _): &(Released, f64)| matches!(release, Release::Sliding(_)).then_some(*joint);
    let sliding: Vec<usize> = sum.iter().filter_map(slides).collect();
    sliding.windows(2).all(|pair| pair[0] != pair[1]).then(|| sum.into_iter().unzip())
}

/// The mirror image of a motion of joints from the first to the `last`.
fn mirrored((moving, rates): &Moves, last: usize) -> Moves {
    let image = |&(joint, release): &Released| match release {
        Release::Sliding(sign) => (last - joint, Release::Sliding(-sign)),
        rotation => (last - joint, rotation),
    };
    (moving.iter().map(image).collect(), rates.clone())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::Face;

    const INTRADOS: Release = Release::Rotation(Face::Intrados);

    #[test]
    fn motions_add_up_joint_by_joint() {
        let slide = Release::Sliding(1.0);
        let one = (vec![(3, slide), (1, INTRADOS)], vec![1.0, 2.0]);
        let other = (vec![(1, INTRADOS), (3, INTRADOS)], vec![3.0, 4.0]);
        let both = (vec![(1, INTRADOS), (3, slide), (3, INTRADOS)], vec![5.0, 1.0, 4.0]);
        assert_eq!(sum(&one, &other), Some(both));
        assert_eq!(sum(&one, &(vec![(3, Release::Sliding(-1.0))], vec![1.0])), None);
    }

    #[test]
    fn a_mirror_image_slides_the_other_way() {
        let motion = (vec![(0, Release::Sliding(1.0)), (2, INTRADOS)], vec![1.0, 2.0]);
        let image = (vec![(7, Release::Sliding(-1.0)), (5, INTRADOS)], vec![1.0, 2.0]);
        assert_eq!(mirrored(&motion, 7), image);
        assert_eq!(mirrored(&image, 7), motion);
    }
}
