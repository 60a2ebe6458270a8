//! How much the stress in a body can have changed, without looking at every subblock.
//!
//! Stress is linear in the displacements of the nodes, and what they share with a rigid motion of the body gives none.

use super::{Assembly, Kind, Loads};
use crate::dda::condense::Node;
use crate::geometry::Vec2;
use nalgebra::{DMatrix, SMatrix, SVector};

/// Of a square that is the difference of two much larger ones, rounding leaves this share of them.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A body's rigid motions, and the steepness of its stress.
#[derive(Debug, Clone)]
pub(super) struct Strain {
    /// The three rigid motions of the nodes, orthonormal, by unknowns.
    rigid: Vec<[f64; 3]>,
    /// The most that (sigma_x, sigma_y, tau_xy) of any subblock changes by per change of the nodes' displacements, Pa/m, both
    /// as vectors.
    steepest: f64,
}

impl Strain {
    /// Of a body with such nodes and the stress of its subblocks by their displacements, three rows each.
    pub(super) fn new(nodes: &[Node], stress_of_nodes: &DMatrix<f64>) -> Self {
        let centre = nodes.iter().map(|node| node.at).sum::<Vec2>() / nodes.len().max(1) as f64;
        let velocity = |motion: usize, at: Vec2| match motion {
            0 => Vec2::x(),
            1 => Vec2::y(),
            _ => Vec2::new(centre.y - at.y, at.x - centre.x),
        };
        let motion = |i: usize, m: usize| velocity(m, nodes[i / 2].at).dot(&nodes[i / 2].axes[i % 2]);
        let motions = DMatrix::from_fn(2 * nodes.len(), 3, motion).qr().q();
        let rigid = motions.row_iter().map(|row| [row[0], row[1], row[2]]).collect();
        // Of every subblock the squares of its rows and their products.
        let mut squares = vec![SMatrix::<f64, 3, 3>::zeros(); stress_of_nodes.nrows() / 3];
        for column in stress_of_nodes.as_slice().chunks_exact(stress_of_nodes.nrows().max(1)) {
            for (sum, stress) in squares.iter_mut().zip(column.as_chunks::<3>().0) {
                let stress = SVector::from(*stress);
                *sum += stress * stress.transpose();
            }
        }
        let steepest = squares.iter().map(|of| of.symmetric_eigenvalues().max()).fold(0.0, f64::max).sqrt();
        Strain { rigid, steepest }
    }

    /// The most that the stress of any subblock changes by, as a vector, for such a change of the nodes' displacements, Pa.
    fn most(&self, change: impl Iterator<Item = f64>) -> f64 {
        let (mut all, mut along) = (0.0, [0.0; 3]);
        for (change, rigid) in change.zip(&self.rigid) {
            all += change * change;
            (0..3).for_each(|motion| along[motion] += rigid[motion] * change);
        }
        let rigid: f64 = along.iter().map(|along| along * along).sum();
        self.steepest * ((all - rigid).max(0.0) + ROUNDING * all).sqrt()
    }
}

impl Assembly {
    /// The most that (sigma_x, sigma_y, tau_xy) of any subblock of body `i` changes by, as a vector, from displacements `then` of
    /// its nodes to `now` of all nodes, Pa; infinite where that is not known.
    pub fn most_stress_change(&self, i: usize, now: &[f64], then: &[f64]) -> f64 {
        let Kind { strain: Some(strain), .. } = &self.kinds[self.bodies[i].kind] else { return f64::INFINITY };
        strain.most(now[self.nodes_of(i)].iter().zip(then).map(|(now, then)| now - then))
    }
}

impl Loads {
    /// The largest stress of any subblock of body `i` with its nodes held, as a vector, Pa.
    pub fn most_stress(&self, i: usize) -> f64 {
        let sizes = self.stress[i].as_chunks::<3>().0.iter().map(|[x, y, tau]| (x * x + y * y + tau * tau).sqrt());
        sizes.fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bound_is_above_every_change_and_nought_for_rigid_motions() {
        let at = [[0.0, 0.0], [1.0, 0.2], [0.9, 1.1], [-0.1, 1.0]].map(|[x, y]| Vec2::new(x, y));
        let turned = |a: f64| [Vec2::new(a.cos(), a.sin()), Vec2::new(-a.sin(), a.cos())];
        let node = |(i, at): (usize, Vec2)| Node {
            at,
            axes: turned(0.3 * i as f64),
            link: [1.0; 2],
            holds: [(0, 1.0), (0, 0.0)],
        };
        let nodes: Vec<Node> = at.into_iter().enumerate().map(node).collect();
        let raw = DMatrix::from_fn(6, 8, |i, j| ((3 * i + 5 * j + i * j) as f64).sin());
        let still = {
            let rigid = Strain::new(&nodes, &raw).rigid;
            let q = DMatrix::from_fn(8, 3, |i, motion| rigid[i][motion]);
            DMatrix::identity(8, 8) - &q * q.transpose()
        };
        let stress = raw * &still;
        let strain = Strain::new(&nodes, &stress);
        for turn in 0..40 {
            let change = nalgebra::DVector::from_fn(8, |i, _| (1.7 * turn as f64 + 0.9 * (i * i) as f64).cos());
            let found = &stress * &change;
            let largest = (0..2).map(|i| found.rows(3 * i, 3).norm()).fold(0.0, f64::max);
            let most = strain.most(change.iter().copied());
            assert!(largest <= most && most < 30.0 * largest, "{largest} {most}");
        }
        let rigid = strain.rigid.iter().map(|[along, _, turning]| 0.7 * along - 1.9 * turning);
        assert!(strain.most(rigid) < 1e-6 * strain.steepest);
    }
}
