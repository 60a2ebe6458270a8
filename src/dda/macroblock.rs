//! The macroblock: constant-strain subblocks bonded at seams (section 3.2 of the paper).

use super::block::{Block, M6, V6};
use crate::geometry::{Vec2, perpendicular};

/// Stiffness of the pair of springs in the middle of a seam, over E L / h.
///
/// Stiff enough that a seam adds a thousandth of a subblock's own compliance; larger values gain nothing and cost
/// digits in the condensation.
const MIDDLE: f64 = 1000.0;
/// Stiffness of the springs on the linear part of a seam's jump, over that of an elastic layer, E L / (12 h).
///
/// Without them subblocks turn on their seams' middles like beads (a fourth mode without energy); from 0.1 on they lock
/// in bending as corner springs do.
const LINEAR: f64 = 0.01;

/// How subblocks are bonded at their seams.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bond {
    /// A stiff pair of springs (normal and tangential) in the middle, a weak one on the jump's linear part.
    Split,
    /// A pair of springs of this stiffness, N/m2, at both ends, as the paper's text reads. Locks in bending.
    Corners(f64),
}

/// The common side of two subblocks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seam {
    /// The two subblocks.
    pub blocks: [usize; 2],
    /// Mean point of the side, m: the middle of a straight one.
    pub at: Vec2,
    /// Its ends, m.
    pub ends: [Vec2; 2],
    /// Unit normal in the mean, from the first subblock into the second.
    pub normal: Vec2,
}

/// Subblocks bonded at seams.
#[derive(Debug, Clone, PartialEq)]
pub struct Macroblock {
    blocks: Vec<Block>,
    seams: Vec<Seam>,
    bond: Bond,
}

impl From<Block> for Macroblock {
    /// A macroblock of one subblock.
    fn from(block: Block) -> Self {
        Macroblock { blocks: vec![block], seams: Vec::new(), bond: Bond::Split }
    }
}

impl Macroblock {
    /// A macroblock of these subblocks, bonded at these seams.
    pub fn new(blocks: Vec<Block>, seams: Vec<Seam>, bond: Bond) -> Self {
        Macroblock { blocks, seams, bond }
    }

    /// The subblocks.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// The seams.
    pub fn seams(&self) -> &[Seam] {
        &self.seams
    }

    /// This macroblock as seen from a frame with the given origin and x axis (unit vector).
    pub(super) fn seen_from(&self, origin: Vec2, x_axis: Vec2) -> Self {
        let turned = |v: Vec2| Vec2::new(v.dot(&x_axis), v.dot(&perpendicular(x_axis)));
        let place = |p: Vec2| turned(p - origin);
        let seam = |s: &Seam| Seam {
            blocks: s.blocks,
            at: place(s.at),
            ends: s.ends.map(place),
            normal: turned(s.normal),
        };
        Macroblock {
            blocks: self.blocks.iter().map(|b| b.moved_to(place(b.centroid()))).collect(),
            seams: self.seams.iter().map(seam).collect(),
            bond: self.bond,
        }
    }

    /// True where another macroblock is this one, up to `rounding` in lengths, m.
    pub(super) fn same_as(&self, other: &Macroblock, rounding: f64) -> bool {
        let near = |a: Vec2, b: Vec2| (a - b).amax() <= rounding;
        let same_block = |(a, b): (&Block, &Block)| a.same_as(b, rounding);
        let same_seam = |(a, b): (&Seam, &Seam)| {
            let length = (a.ends[1] - a.ends[0]).norm();
            a.blocks == b.blocks
                && near(a.at, b.at)
                && a.ends.iter().zip(b.ends).all(|(&a, b)| near(a, b))
                && near(a.normal * length, b.normal * length)
        };
        self.bond == other.bond
            && self.blocks.len() == other.blocks.len()
            && self.blocks.iter().zip(&other.blocks).all(same_block)
            && self.seams.len() == other.seams.len()
            && self.seams.iter().zip(&other.seams).all(same_seam)
    }

    /// Calls `add(i, j, block)` for the stiffness between subblocks `i` and `j` that every subblock's elasticity and
    /// every seam contribute, N/m2.
    pub(super) fn stiffness(&self, mut add: impl FnMut(usize, usize, &M6)) {
        for (i, block) in self.blocks.iter().enumerate() {
            add(i, i, &block.stiffness());
        }
        for seam in &self.seams {
            for (stiffness, rows) in self.springs(seam) {
                for (&i, row) in seam.blocks.iter().zip(&rows) {
                    for (&j, column) in seam.blocks.iter().zip(&rows) {
                        add(i, j, &(row * column.transpose() * stiffness));
                    }
                }
            }
        }
    }

    /// Springs of a seam: stiffness, N/m2, and the jump it resists as rows over the two subblocks.
    fn springs(&self, seam: &Seam) -> Vec<(f64, [V6; 2])> {
        let jump = |at: Vec2, along: Vec2| {
            let [first, second] = seam.blocks.map(|i| self.blocks[i].displacement_row(at, along));
            [-first, second]
        };
        let directions = [seam.normal, perpendicular(seam.normal)];
        match self.bond {
            Bond::Corners(stiffness) => {
                let pair = |at: Vec2| directions.map(|along| (stiffness, jump(at, along)));
                seam.ends.iter().flat_map(|&end| pair(end)).collect()
            }
            Bond::Split => {
                let [first, second] = seam.blocks.map(|i| &self.blocks[i]);
                let distance = (second.centroid() - first.centroid()).dot(&seam.normal);
                let length = (seam.ends[1] - seam.ends[0]).norm();
                // Of two stones of one macroblock that differ, the stiffer may not lose by its softer neighbour.
                let layer = first.youngs_modulus().max(second.youngs_modulus()) * length / distance;
                let linear = |along: Vec2| {
                    let [a, b] = seam.ends.map(|end| jump(end, along));
                    [b[0] - a[0], b[1] - a[1]]
                };
                let middle = directions.map(|along| (MIDDLE * layer, jump(seam.at, along)));
                let linear = directions.map(|along| (LINEAR / 12.0 * layer, linear(along)));
                middle.into_iter().chain(linear).collect()
            }
        }
    }
}
