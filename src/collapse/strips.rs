//! Where the contact points of joints that crush are.
//!
//! A joint of plastic sections carries its force N by an even pressure, the strength f, over a block of length b = N / f at one
//! face: |M| <= N (L - N / f) / 2. Contact points stand for strips of the joint, each in the middle of its strip and capped at f
//! times its length. As the joint turns about one face, strip after strip is capped; where whole strips are, N and M are those of
//! a block that ends between two strips. What the points can carry is therefore a polygon with its corners on that parabola: it
//! lies within plastic sections, on the safe side. Between two corners one strip, of width w, is partly loaded, and the
//! eccentricity falls short by w^2 / (8 b) at most. A coarse grid whose strips widen as the square root of their distance from the
//! face falls short by the same everywhere; where limit analysis expects a block to end, one narrow strip lies about its end.

use super::Thrust;
use crate::limit::Resultant;
use crate::structure::{Face, Joint, Structure};

/// Ends of the strips of the coarse grid of one half of a joint, as shares of the joint: i^2 / 50.
const COARSE: [f64; 5] = [0.02, 0.08, 0.18, 0.32, 0.5];
/// Half the width of the strip about the expected end of a block, as a share of the block.
const NARROW: f64 = 0.01;
/// Blocks that differ by less than this share of theirs are the same: rounding must not part those of mirror images.
const SAME: f64 = 0.005;
/// Shortest block, as a share of the joint: shorter ones have hardly a lever, and contacts much softer than others cost the path
/// its digits.
const SHORTEST_BLOCK: f64 = 1e-3;
/// A joint with a block shorter than this share of it does not crush.
pub(super) const NO_BLOCK: f64 = 1e-5;
/// Most blocks in a joint that are expected: both faces, at either end of the limit window.
const MOST_BLOCKS: usize = 4;
/// Most contact points of a joint that crushes: one between two ends of strips of the coarse grid, two more for every block.
pub(super) const MOST_POINTS: usize = 2 * COARSE.len() + 2 * MOST_BLOCKS;
/// Joints crush that need this share of their pressed length where limit analysis expects it, and where a path ends.
const ALMOST: f64 = 0.99;
const CRUSHED: f64 = 1.0 + 1e-6;
/// A joint crushes only under a normal force above this share of the largest.
const PRESSED_ENOUGH: f64 = 1e-6;

/// Places of a joint's contact points, from 0 at its first end to 1 at its second; and how much of the joint each stands for, towards
/// either end.
pub(super) type Points = (Vec<f64>, Vec<[f64; 2]>);

/// Contact points at these places, in their order, each with what is nearest to it.
pub(super) fn nearest(places: Vec<f64>) -> Points {
    let sides = |(j, &eta): (usize, &f64)| {
        let below = if j == 0 { eta } else { 0.5 * (eta - places[j - 1]) };
        let above = if j + 1 == places.len() { 1.0 - eta } else { 0.5 * (places[j + 1] - eta) };
        [below, above]
    };
    let sides = places.iter().enumerate().map(sides).collect();
    (places, sides)
}

/// Contact points at the ends and in the middles of the stretches between these places, each with what it stands for: by Simpson's rule
/// displacements of second order on either side do as much work at them as under an even pressure.
pub(super) fn consistent(lines: &[f64]) -> Points {
    let last = lines.len() - 1;
    let length = |k: usize| if (1..=last).contains(&k) { lines[k] - lines[k - 1] } else { 0.0 };
    let end = |k: usize| (lines[k], [length(k) / 6.0, length(k + 1) / 6.0]);
    let middle = |k: usize| (0.5 * (lines[k] + lines[k + 1]), [length(k + 1) / 3.0; 2]);
    (0..=2 * last).map(|i| if i % 2 == 0 { end(i / 2) } else { middle(i / 2) }).unzip()
}

/// Strips of every joint that crushes.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Strips {
    joints: Vec<CrushableJoint>,
}

/// A joint that may crush.
#[derive(Debug, Clone, PartialEq)]
struct CrushableJoint {
    /// Length, m, and force that it bears where it is crushed all over, N/m; infinite where it does not crush.
    length: f64,
    capacity: f64,
    /// Whether it crushes, and the blocks that are expected, each at a face, as a share of the joint.
    blocks: Option<Vec<(Face, f64)>>,
}

impl Strips {
    /// Of the joints of a structure, none of which crushes; or `any` dry one may, where nothing is expected.
    pub(super) fn new(structure: &Structure, any: bool) -> Self {
        let section = |joint: &Joint| {
            let (dry, length) = (joint.law.coulomb().is_some(), joint.length());
            let capacity = if dry { structure.strength_at(joint) * length } else { f64::INFINITY };
            CrushableJoint { length, capacity, blocks: (any && dry).then(Vec::new) }
        };
        Strips { joints: structure.joints.iter().map(section).collect() }
    }

    /// The contact points of a joint that crushes: the middles of its strips.
    pub(super) fn points(&self, joint: usize) -> Option<Points> {
        let strip = |ends: &[f64]| (0.5 * (ends[0] + ends[1]), [0.5 * (ends[1] - ends[0]); 2]);
        self.of(joint).map(|ends| ends.windows(2).map(strip).unzip())
    }

    /// Ends of the strips of a joint, from 0 at its first end to 1 at its second; none where it does not crush.
    fn of(&self, joint: usize) -> Option<Vec<f64>> {
        let blocks = self.joints.get(joint)?.blocks.as_ref()?;
        let mut ends: Vec<f64> = COARSE.iter().flat_map(|&at| [at, 1.0 - at]).chain([0.0, 1.0]).collect();
        for &(face, block) in blocks {
            let place = |at: f64| if face == Face::Intrados { at } else { 1.0 - at };
            let clear = |at: f64| (place(at) - block).abs() > 2.0 * NARROW * block;
            ends.retain(|&at| at == 0.0 || at == 1.0 || clear(at));
            let narrow = [1.0 - NARROW, 1.0 + NARROW].map(|share| share * block);
            ends.extend(narrow.into_iter().filter(|&at| at < 1.0 - SHORTEST_BLOCK).map(place));
        }
        ends.sort_by(f64::total_cmp);
        ends.dedup_by(|a, b| *a - *b < NARROW * SHORTEST_BLOCK);
        Some(ends)
    }

    /// Takes in the joints that these forces, at an end of the window of plastic sections, crush or almost do.
    pub(super) fn expect(&mut self, forces: &[Resultant]) {
        let least = PRESSED_ENOUGH * forces.iter().map(Resultant::normal).fold(0.0, f64::max);
        for (section, force) in self.joints.iter_mut().zip(forces).filter(|(_, force)| force.normal() > least) {
            let off = 0.5 * (force.extrados - force.intrados) / force.normal();
            section.take_in(force.normal(), off, ALMOST);
        }
    }

    /// Takes in the joints that crush, though they are not among those that may, where a path ends; true where there are any.
    pub(super) fn expect_more(&mut self, thrust: &[Thrust]) -> bool {
        let least = PRESSED_ENOUGH * thrust.iter().map(|thrust| thrust.normal).fold(0.0, f64::max);
        let mut more = false;
        for &Thrust { joint, normal, eccentricity, .. } in thrust.iter().filter(|thrust| thrust.normal > least) {
            let section = &mut self.joints[joint];
            more |= section.blocks.is_none() && section.take_in(normal, eccentricity / section.length, CRUSHED);
        }
        more
    }
}

impl CrushableJoint {
    /// Takes in the block of a force so far off the middle, as a share of the joint, that needs this share of the pressed length that
    /// plastic sections have for it; true where it does.
    fn take_in(&mut self, normal: f64, off: f64, share: f64) -> bool {
        let (block, pressed) = (normal / self.capacity, 1.0 - 2.0 * off.abs());
        if block < share * pressed || block < NO_BLOCK {
            return false;
        }
        let face = if off > 0.0 { Face::Extrados } else { Face::Intrados };
        let rounded = ((block.max(SHORTEST_BLOCK).ln() / SAME).round() * SAME).exp();
        let blocks = self.blocks.get_or_insert_default();
        if !blocks.contains(&(face, rounded)) && blocks.len() < MOST_BLOCKS {
            blocks.push((face, rounded));
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest and least share of the eccentricity of plastic sections that strips bear, over blocks from a share to another.
    fn borne(strips: &[f64], blocks: [f64; 2]) -> [f64; 2] {
        let share = |i: usize| {
            let block = blocks[0] + (blocks[1] - blocks[0]) * i as f64 / 1000.0;
            let full: Vec<f64> = strips.windows(2).map(|s| (block.min(s[1]) - s[0]).max(0.0)).collect();
            let moment: f64 = strips.windows(2).zip(&full).map(|(s, n)| n * (0.5 - 0.5 * (s[0] + s[1]))).sum();
            moment / (0.5 * block * (1.0 - block))
        };
        (0..=1000).map(share).fold([f64::INFINITY, 0.0], |[low, high], s| [low.min(s), high.max(s)])
    }

    #[test]
    fn strips_bear_no_more_than_plastic_sections_and_hardly_less_where_a_block_ends() {
        for block in [0.003, 0.05, 0.3, 0.7, 0.99] {
            let [near, far] = [0.5 * block, 1.0 - 0.5 * block].map(|at| 2e6 * block * at);
            for (intrados, extrados) in [(far, near), (near, far)] {
                let mut strips = Strips { joints: vec![CrushableJoint { length: 2.0, capacity: 2e6, blocks: None }] };
                assert!(strips.of(0).is_none());
                strips.expect(&[Resultant { intrados, extrados, shear: 0.0 }]);
                let mut ends = strips.of(0).unwrap();
                if intrados < extrados {
                    ends = ends.iter().rev().map(|at| 1.0 - at).collect();
                }
                assert!(ends.len() <= 13 && ends.windows(2).all(|s| s[0] < s[1]), "{ends:?}");
                let ([least, most], [here, _]) =
                    (borne(&ends, [1e-3, 1.0 - 1e-9]), borne(&ends, [0.995 * block, 1.005 * block]));
                // w^2 / (8 b) of the eccentricity (1 - b) / 2.
                let short = 1.2 * NARROW * NARROW * block / (1.0 - 1.005 * block);
                assert!(least > 0.96 && most < 1.0 + 1e-12 && here > 1.0 - short, "{block}: {least} {most} {here}");
            }
        }
    }
}
