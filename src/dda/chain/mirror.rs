//! A chain and its mirror image about a vertical axis.
//!
//! The mirror image of body `i` of `n` is body `n - 1 - i`, that of interface `k` is interface `n - k`, and the body before an
//! interface becomes the one after it. Normals point from the body before to the one after, so a node's displacement along
//! the normal changes its sign, and that along the tangent (the normal turned by +90 degrees) keeps it; gaps stay, slips change
//! their sign.

use super::Chain;
use crate::dda::contact::Contact;

/// Numbers of two mirror images that differ by this share of the largest differ by rounding.
const ROUNDING: f64 = 1e-9;
/// The same for the stiffness of condensed bodies, which took many operations.
const STIFFNESS_ROUNDING: f64 = 1e-7;

impl Chain {
    /// Displacements of the nodes (or loads on them) of the mirror image, where the chain is its own.
    pub fn mirrored(&self, d: &[f64]) -> Vec<f64> {
        let faces = self.elastic.rows();
        let of_face = |face: usize| d[self.elastic.range(faces - 1 - face)].chunks_exact(2);
        (0..faces).flat_map(of_face).flat_map(|pair| [-pair[0], pair[1]]).collect()
    }

    /// The mean of displacements of the nodes and their mirror image, where the chain is its own: symmetric to the last digit.
    pub fn symmetrised(&self, d: &[f64]) -> Vec<f64> {
        self.mirrored(d).iter().zip(d).map(|(there, here)| 0.5 * (there + here)).collect()
    }

    /// True where `loads` on the nodes are their own mirror image.
    pub fn are_symmetric(&self, loads: &[f64]) -> bool {
        near(&self.mirrored(loads), loads, ROUNDING)
    }

    /// True where the chain is its own mirror image: normals, exact contacts and elastic stiffness.
    pub fn is_symmetric(&self) -> bool {
        let n = self.bodies.len();
        let interface = |k: usize| {
            let (here, there) = (self.at_interface(k), self.at_interface(n - k));
            here.len() == there.len() && here.zip(there).all(|(p, q)| self.alike(p, q))
        };
        (0..=n / 2).all(interface) && (0..n.div_ceil(2)).all(|i| self.has_mirror_image(i))
    }

    fn alike(&self, p: usize, q: usize) -> bool {
        let (a, b) = (self.sites[p].normal, self.sites[q].normal);
        let same = |a: &Contact, b: &Contact| a.law == b.law && near(&a.stiffness, &b.stiffness, ROUNDING);
        near(&[a.x, a.y], &[b.x, -b.y], ROUNDING) && same(&self.exact[p], &self.exact[q])
    }

    /// Whether the stiffness of body `i` is the mirror image of that of its partner, the faces of either exchanged.
    fn has_mirror_image(&self, i: usize) -> bool {
        let (a, b) = (self.stiffness_of(i), self.stiffness_of(self.bodies.len() - 1 - i));
        let size = a.nrows();
        let first = self.elastic.range(2 * (self.bodies.len() - 1 - i)).len();
        // Where node `j` of the one is on the other: first the nodes of its other face.
        let place = |j: usize| if j < size - first { first + j } else { j + first - size };
        let sign = |j: usize| if j.is_multiple_of(2) { -1.0 } else { 1.0 };
        let image = |i: usize, j: usize| sign(i) * sign(j) * b[(place(i), place(j))];
        let apart = |i: usize, j: usize| (a[(i, j)] - image(i, j)).abs();
        b.nrows() == size
            && (0..size)
                .all(|i| (0..size).all(|j| apart(i, j) <= STIFFNESS_ROUNDING * a[(i, i)].abs().max(a[(j, j)].abs())))
    }
}

/// True where two lists are the same but for rounding.
fn near(a: &[f64], b: &[f64], rounding: f64) -> bool {
    let scale = a.iter().chain(b).fold(0.0f64, |most, x| most.max(x.abs()));
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= rounding * scale)
}
