//! Symmetric states to the last digit: displacements of the nodes are, but what follows from them is rounded in frames that are
//! turned otherwise on either side. The mean of both sides is given.

use super::{BlockState, SubblockStress};
use crate::geometry::mirrored;

impl BlockState {
    /// Of the stone on the other side of a symmetric arch.
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

/// States of the stones of a symmetric arch, from left to right, each the mean of itself and its partner's mirror image.
pub(super) fn evened_blocks(blocks: &[BlockState]) -> Vec<BlockState> {
    blocks.iter().zip(blocks.iter().rev()).map(|(here, there)| here.mean(there.mirror_image())).collect()
}

/// The same for stresses in the subblocks of a symmetric mesh; `radial`: how many there are from intrados to extrados in
/// every voussoir.
pub(super) fn evened_stresses(subblocks: &[SubblockStress], radial: &[usize]) -> Vec<SubblockStress> {
    // Columns from joint to joint, whose order is turned round on the other side, and in them from intrados to extrados.
    let mut columns: Vec<&[SubblockStress]> = Vec::new();
    let mut rest = subblocks;
    while let Some(first) = rest.first() {
        let (column, more) = rest.split_at(radial[first.voussoir].clamp(1, rest.len()));
        columns.push(column);
        rest = more;
    }
    let pairs = columns.iter().zip(columns.iter().rev()).flat_map(|(here, there)| here.iter().zip(there.iter()));
    let evened = |(here, there): (&SubblockStress, &SubblockStress)| {
        let [x, y, tau] = there.stress;
        SubblockStress { stress: mean(here.stress, [x, y, -tau]), ..*here }
    };
    pairs.map(evened).collect()
}
