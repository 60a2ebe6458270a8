//! What is its own mirror image, and symmetric states to the last digit.
//!
//! Displacements of the nodes are symmetric, but what follows from them is rounded in frames that are turned otherwise on either side.
//! The mean of both sides is given.

use super::grid::Grid;
use super::recovery::mirrored_corners;
use super::{Analysis, BlockState, SubblockStress};
use crate::geometry::{Vec2, mirrored};
use crate::structure::is_symmetric;

/// Whether a ring is its own mirror image in all that limit analysis sees: then the mirror image of a solution is one, too, and so is
/// their mean.
pub(super) fn is_even(analysis: &Analysis) -> bool {
    let structure = &analysis.structure;
    let (axis, n) = (structure.axis(), structure.joints.len());
    let strength = |k: usize| structure.strength_at(&structure.joints[k]);
    let symmetric = |forces: &[_]| is_symmetric(forces, structure.bodies.len(), axis);
    let ring = structure.is_one_ring() && structure.ring().len() == n && structure.bodies.len() + 1 == n;
    ring && !structure.is_half()
        && structure.asymmetry().is_none()
        && (0..n).all(|k| strength(k) == strength(n - 1 - k))
        && symmetric(&analysis.fixed)
        && symmetric(&analysis.scaled)
        && symmetric(&structure.passive.iter().map(|element| element.force(element.most)).collect::<Vec<_>>())
}

impl BlockState {
    /// Of the stone on the other side of a symmetric structure.
    pub(super) fn mirror_image(self) -> Self {
        let [x, y, tau] = self.stress;
        BlockState { displacement: mirrored(self.displacement, 0.0), rotation: -self.rotation, stress: [x, y, -tau] }
    }

    fn mean(self, other: Self) -> Self {
        BlockState {
            displacement: 0.5 * (self.displacement + other.displacement),
            rotation: 0.5 * (self.rotation + other.rotation),
            stress: mean(self.stress, other.stress),
        }
    }
}

fn mean(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| 0.5 * (a[i] + b[i]))
}

/// Displacements of the bodies of a symmetric structure, each the mean of itself and the mirror image of its partner's.
pub(super) fn evened(shifts: &[Vec2], images: &[usize]) -> Vec<Vec2> {
    shifts.iter().zip(images).map(|(here, &there)| 0.5 * (here + mirrored(shifts[there], 0.0))).collect()
}

/// States of the bodies of a symmetric structure, each the mean of itself and the mirror image of its partner.
pub(super) fn evened_blocks(blocks: &[BlockState], images: &[usize]) -> Vec<BlockState> {
    blocks.iter().zip(images).map(|(here, &there)| here.mean(blocks[there].mirror_image())).collect()
}

/// The same for stresses in the subblocks of a symmetric mesh; the axis is at this abscissa, m.
pub(super) fn evened_stresses(
    subblocks: &[SubblockStress],
    grids: &[Grid],
    (images, axis): (&[usize], f64),
) -> Vec<SubblockStress> {
    let counted = grids.iter().scan(0, |before, grid| Some(std::mem::replace(before, *before + grid.cells().count())));
    let first: Vec<usize> = counted.collect();
    let evened = |here: &SubblockStress| {
        let image = images[here.voussoir];
        let there = &subblocks[first[image] + grids[image].cell_at(mirrored(here.centre, axis))];
        let [x, y, tau] = there.stress;
        let corners = here.corner_stress.iter().zip(mirrored_corners(here, there, axis));
        let corner_stress = corners.map(|(&here, there)| mean(here, there)).collect();
        SubblockStress { stress: mean(here.stress, [x, y, -tau]), corner_stress, ..here.clone() }
    };
    subblocks.iter().map(evened).collect()
}
