//! The macroblock: constant-strain subblocks bonded at seams (section 3.2 of the paper).

use super::block::{Block, M6, V6};
use crate::geometry::{Vec2, perpendicular};

/// Stiffness of the springs on a seam's mean jump, over E L / h.
///
/// A seam then adds a ten-thousandth of a subblock's own compliance. From 100 to 1e5 the stress does not change; below
/// 1e3 the strain energy grows visibly.
const MEAN: f64 = 1e4;
/// Stiffness of the springs on the linear part of a seam's jump, over that of an elastic layer, E L / (12 h).
///
/// Without them subblocks turn on their seams' middles like beads (a fourth mode without energy); from 0.03 on they
/// begin to lock in bending as corner springs do. A seam through the whole stone has the layer's own: there is no other
/// beside it to make up a couple with.
const LINEAR: f64 = 0.003;

/// Stiffness against subblocks around a corner turning one against the next, over E times a subblock's area.
///
/// Where all of them do (an hourglass mode), no seam's mean jump sees it, and the force of a hinge on a corner subblock would turn
/// them against the weak springs alone. In a smooth field these rotations differ by the square of the subblocks' size only:
/// from 0.01 to 1 the energy of the curved beam keeps four digits and its stress error stays within a fiftieth of itself. What
/// gives next to a hinge does depend on it: on moving geometry the 4 x 4 quarter-load case at 1e10 Pa falls at 225, 229 and
/// 233 kN for 0.01, 0.1 and 1.
const HOURGLASS: f64 = 0.1;

/// How subblocks are bonded at their seams.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bond {
    /// A stiff pair of springs (normal and tangential) on the mean jump, a weak one on what is linear in it.
    Split,
    /// The same, and besides the springs a seam carries the mean traction of both subblocks (Nitsche 1971). Springs alone give as
    /// they carry, by a ten-thousandth of a subblock, which fits together where seams are normal to each other only: a uniform
    /// stress is then exact however they lie.
    Consistent,
    /// A pair of springs of this stiffness, N/m2, at both ends, as the paper's text reads. Locks in bending.
    Corners(f64),
}

/// The common side of two subblocks, straight or an arc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seam {
    /// The two subblocks.
    pub blocks: [usize; 2],
    /// One end, the middle and the other end of the side, m.
    pub points: [Vec2; 3],
    /// Unit normals there, from the first subblock into the second.
    pub normals: [Vec2; 3],
    /// Whether the linear part of the jump along the normal, and along the side, is as stiff as an elastic layer: where the
    /// side runs through the whole stone, nothing but it can carry bending.
    pub stiff: [bool; 2],
}

/// Weights of Simpson's rule for the mean along a side.
const SIMPSON: [f64; 3] = [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0];

impl Seam {
    /// Length of the side, m: exact for a straight one, to the fourth order of its angle for an arc.
    fn length(&self) -> f64 {
        let [a, m, b] = self.points;
        let (chord, halves) = ((b - a).norm(), (m - a).norm() + (b - m).norm());
        (4.0 * halves - chord) / 3.0
    }
}

/// Subblocks bonded at seams.
#[derive(Debug, Clone, PartialEq)]
pub struct Macroblock {
    blocks: Vec<Block>,
    seams: Vec<Seam>,
    /// The subblocks around every inner corner, in a ring, where they are an even number; none where pairs of springs at the corners
    /// hold them.
    corners: Vec<Vec<usize>>,
    bond: Bond,
}

impl From<Block> for Macroblock {
    /// A macroblock of one subblock.
    fn from(block: Block) -> Self {
        Macroblock { blocks: vec![block], seams: Vec::new(), corners: Vec::new(), bond: Bond::Split }
    }
}

impl Macroblock {
    /// A macroblock of these subblocks, bonded at these seams.
    pub fn new(blocks: Vec<Block>, seams: Vec<Seam>, bond: Bond) -> Self {
        let pairs = matches!(bond, Bond::Corners(_));
        let corners = if pairs { Vec::new() } else { inner_corners(blocks.len(), &seams) };
        Macroblock { blocks, seams, corners, bond }
    }

    /// The same with this ring of an even number of subblocks around an inner corner, other than four, which are found.
    pub fn with_corner(mut self, ring: Vec<usize>) -> Self {
        self.corners.push(ring);
        self
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
        let seam =
            |s: &Seam| Seam { blocks: s.blocks, points: s.points.map(place), normals: s.normals.map(turned), ..*s };
        Macroblock {
            blocks: self.blocks.iter().map(|b| b.moved_to(place(b.centroid()))).collect(),
            seams: self.seams.iter().map(seam).collect(),
            corners: self.corners.clone(),
            bond: self.bond,
        }
    }

    /// True where another macroblock is this one, up to `rounding` in lengths, m.
    pub(super) fn same_as(&self, other: &Macroblock, rounding: f64) -> bool {
        let near = |a: Vec2, b: Vec2| (a - b).amax() <= rounding;
        let same_block = |(a, b): (&Block, &Block)| a.same_as(b, rounding);
        let same_seam = |(a, b): (&Seam, &Seam)| {
            let length = a.length();
            (a.blocks, a.stiff) == (b.blocks, b.stiff)
                && a.points.iter().zip(b.points).all(|(&a, b)| near(a, b))
                && a.normals.iter().zip(b.normals).all(|(&a, b)| near(a * length, b * length))
        };
        self.bond == other.bond
            && self.blocks.len() == other.blocks.len()
            && self.blocks.iter().zip(&other.blocks).all(same_block)
            && self.seams.len() == other.seams.len()
            && self.seams.iter().zip(&other.seams).all(same_seam)
    }

    /// Calls `add(i, j, block)` for the stiffness between subblocks `i` and `j` that every subblock's elasticity, every seam
    /// and every inner corner contribute, N/m2.
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
            if self.bond == Bond::Consistent {
                self.tractions(seam, &mut add);
            }
        }
        self.hourglass(add);
    }

    /// Adds the work of the mean traction of both subblocks in the mean jump of a straight seam, and of its like.
    fn tractions(&self, seam: &Seam, add: &mut impl FnMut(usize, usize, &M6)) {
        let normal = seam.normals[1];
        for direction in [normal, perpendicular(normal)] {
            let row = |i: usize| self.blocks[i].displacement_row(seam.points[1], direction);
            let [first, second] = seam.blocks.map(row);
            let jump = [-first, second];
            let traction = seam.blocks.map(|i| self.blocks[i].traction_row(normal, direction) * (0.5 * seam.length()));
            for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let work = traction[a] * jump[b].transpose() + jump[a] * traction[b].transpose();
                add(seam.blocks[a], seam.blocks[b], &work);
            }
        }
    }

    /// Adds hourglass control around inner corners: on the alternating sum of the subblocks' rotations.
    fn hourglass(&self, mut add: impl FnMut(usize, usize, &M6)) {
        for corner in &self.corners {
            let count = corner.len();
            let area = corner.iter().map(|&i| self.blocks[i].area()).sum::<f64>() / count as f64;
            let stiffness = HOURGLASS * self.blocks[corner[0]].youngs_modulus() * area;
            let share = |k: usize| if k.is_multiple_of(2) { 1.0 } else { -1.0 } / self.blocks[corner[k]].size();
            for (k, l) in (0..count).flat_map(|k| (0..count).map(move |l| (k, l))) {
                let mut block = M6::zeros();
                block[(2, 2)] = stiffness * share(k) * share(l);
                add(corner[k], corner[l], &block);
            }
        }
    }

    /// Springs of a seam: stiffness, N/m2, and the jump it resists as rows over the two subblocks.
    ///
    /// Jumps are counted along the side's own normal and tangent. On an arc these turn, and the mean jump along them,
    /// not that at one point, is what an even pressure on the arc does work in.
    fn springs(&self, seam: &Seam) -> [(f64, [V6; 2]); 4] {
        let jump = |point: usize, along: usize| {
            let normal = seam.normals[point];
            let direction = if along == 0 { normal } else { perpendicular(normal) };
            let [first, second] = seam.blocks.map(|i| self.blocks[i].displacement_row(seam.points[point], direction));
            [-first, second]
        };
        let sum = |weights: [f64; 3], along: usize| {
            let rows = [0, 1, 2].map(|point| jump(point, along));
            [0, 1].map(|side| (0..3).map(|i| rows[i][side] * weights[i]).sum::<V6>())
        };
        match self.bond {
            Bond::Corners(stiffness) => {
                [(0, 0), (0, 1), (2, 0), (2, 1)].map(|(end, along)| (stiffness, jump(end, along)))
            }
            Bond::Split | Bond::Consistent => {
                let [first, second] = seam.blocks.map(|i| &self.blocks[i]);
                let distance = (second.centroid() - first.centroid()).dot(&seam.normals[1]);
                let layer = first.youngs_modulus() * seam.length() / distance;
                let (mean, linear) = (SIMPSON, [-1.0, 0.0, 1.0]);
                let [normal, tangential] = seam.stiff.map(|stiff| if stiff { 1.0 } else { LINEAR } / 12.0);
                [(mean, 0, MEAN), (mean, 1, MEAN), (linear, 0, normal), (linear, 1, tangential)]
                    .map(|(weights, along, share)| (share * layer, sum(weights, along)))
            }
        }
    }
}

/// Rings of four subblocks, each sharing a seam with the next.
fn inner_corners(blocks: usize, seams: &[Seam]) -> Vec<Vec<usize>> {
    let mut beside = vec![Vec::new(); blocks];
    for [a, b] in seams.iter().map(|seam| seam.blocks) {
        beside[a].push(b);
        beside[b].push(a);
    }
    let mut corners = Vec::new();
    for a in 0..blocks {
        let after: Vec<usize> = beside[a].iter().copied().filter(|&b| b > a).collect();
        for (n, &b) in after.iter().enumerate() {
            for &c in &after[n + 1..] {
                let across = beside[b].iter().find(|d| **d != a && beside[c].contains(d));
                corners.extend(across.map(|&d| vec![a, b, d, c]));
            }
        }
    }
    corners
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dda::Elasticity;
    use crate::geometry::Region;
    use nalgebra::DMatrix;

    /// A voussoir with straight-sided subblocks.
    fn voussoir([radial, along]: [usize; 2], bond: Bond) -> Macroblock {
        let point = |i: usize, j: usize| {
            let (radius, angle) = (1.0 + 0.4 * i as f64 / radial as f64, 2.0 - 0.5 * j as f64 / along as f64);
            Vec2::new(angle.cos(), angle.sin()) * radius
        };
        let elasticity = Elasticity { youngs_modulus: 1e9, poissons_ratio: 0.25, plane_strain: false };
        let (mut blocks, mut seams) = (Vec::new(), Vec::new());
        let seam = |blocks: [usize; 2], a: Vec2, b: Vec2, sense: f64| {
            let normals = [perpendicular(b - a).normalize() * sense; 3];
            let stiff = if sense > 0.0 { [along == 1, false] } else { [radial == 1; 2] };
            Seam { blocks, points: [a, 0.5 * (a + b), b], normals, stiff }
        };
        for (j, i) in (0..along).flat_map(|j| (0..radial).map(move |i| (j, i))) {
            let corners = [point(i, j), point(i, j + 1), point(i + 1, j + 1), point(i + 1, j)];
            blocks.push(Block::new(Region::polygon(&corners), elasticity));
            let here = j * radial + i;
            if i + 1 < radial {
                seams.push(seam([here, here + 1], corners[3], corners[2], 1.0));
            }
            if j + 1 < along {
                seams.push(seam([here, here + radial], corners[1], corners[2], -1.0));
            }
        }
        Macroblock::new(blocks, seams, bond)
    }

    #[test]
    fn only_the_three_rigid_motions_cost_no_energy() {
        for cells in [[1, 1], [2, 2], [3, 4], [1, 5], [4, 1]] {
            for bond in [Bond::Split, Bond::Consistent, Bond::Corners(1e10)] {
                let body = voussoir(cells, bond);
                let n = 6 * body.blocks().len();
                let mut stiffness = DMatrix::<f64>::zeros(n, n);
                body.stiffness(|i, j, block| {
                    let mut place = stiffness.fixed_view_mut::<6, 6>(6 * i, 6 * j);
                    place += block;
                });
                let mut energies: Vec<f64> = stiffness.symmetric_eigenvalues().iter().copied().collect();
                energies.sort_by(f64::total_cmp);
                let largest = energies[n - 1];
                // Rounding is about n times 1e-16 of the largest; the weak springs stand far above it.
                assert!(
                    energies[2].abs() <= 1e-13 * largest,
                    "{cells:?} {bond:?}: a rigid motion costs {}",
                    energies[2]
                );
                assert!(energies[3] >= 1e-11 * largest, "{cells:?} {bond:?}: a fourth motion costs {}", energies[3]);
                assert!(energies[3] >= 1e3 * energies[2].abs());
            }
        }
    }
}
