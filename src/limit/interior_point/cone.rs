//! The scaling of Nesterov and Todd (1997) of rows s >= 0 and of second-order cones s_0 >= |(s_1, s_2)|: W z = W^-1 s.
//!
//! Of a row W^2 is s / z. Of a cone W^-1 has the eigenvectors (1, u) / sqrt 2, (1, -u) / sqrt 2 and (0, v) with unit vectors u and
//! v across it: kept apart, the light ones keep their digits beside the heavy ones.

use super::super::linear_program::dot;
use super::{Point, Sparse};
use std::f64::consts::FRAC_1_SQRT_2;

type Triple = [f64; 3];

/// One cone.
struct Cone {
    /// Eigenvectors of W^-1, and its eigenvalues.
    axes: [Triple; 3],
    roots: Triple,
    /// W z.
    scaled: Triple,
}

/// All rows and cones at a point.
pub(super) struct Scaling {
    /// z / s of the rows.
    weights: Vec<f64>,
    cones: Vec<Cone>,
}

impl Scaling {
    pub(super) fn new(programme: &Sparse, point: &Point) -> Self {
        let linear = programme.linear();
        let weights = point.s[..linear].iter().zip(&point.z).map(|(s, z)| z / s).collect();
        let cones = point.s[linear..].chunks_exact(3).zip(point.z[linear..].chunks_exact(3));
        Scaling { weights, cones: cones.map(|(s, z)| Cone::new(triple(s), triple(z))).collect() }
    }

    /// Rows of W^-1 A with the block that they belong to; a row of A has the entries of its block.
    pub(super) fn rows(&self, programme: &Sparse) -> Vec<(usize, Triple)> {
        let rows = &programme.rows;
        let linear = rows.iter().zip(&self.weights).map(|(row, weight)| (row.block, row.a.map(|a| a * weight.sqrt())));
        let cones = rows[self.weights.len()..].chunks_exact(3).zip(&self.cones).flat_map(|(rows, cone)| {
            [0, 1, 2].map(|k| {
                let along = |i: usize| (0..3).map(|r| cone.axes[k][r] * rows[r].a[i]).sum::<f64>();
                (rows[0].block, [0, 1, 2].map(|i| cone.roots[k] * along(i)))
            })
        });
        linear.chain(cones).collect()
    }

    /// W^-2 v.
    pub(super) fn weighted(&self, v: &[f64]) -> Vec<f64> {
        let (linear, cones) = v.split_at(self.weights.len());
        let of_cone = |(v, cone): (&[f64], &Cone)| cone.times(triple(v), 2);
        let cones = cones.chunks_exact(3).zip(&self.cones).flat_map(of_cone);
        linear.iter().zip(&self.weights).map(|(v, w)| v * w).chain(cones).collect()
    }

    /// What W^-2 ds + dz has to be for the products of s and z to go to `centre`, their present value and what a step `tried`
    /// (in s and z) would leave of them taken away.
    pub(super) fn aim(&self, point: &Point, tried: Option<&Point>, centre: f64) -> Vec<f64> {
        let linear = self.weights.len();
        let of_row = |i: usize| {
            let second = tried.map_or(0.0, |step| step.s[i] * step.z[i]);
            (centre - second) / point.s[i] - point.z[i]
        };
        let of_cone = |(k, cone): (usize, &Cone)| {
            let at = linear + 3 * k;
            let mut target = product(cone.scaled, cone.scaled).map(|x| -x);
            target[0] += centre;
            if let Some(step) = tried {
                let [s, z] = [(&step.s, 1), (&step.z, -1)].map(|(v, power)| cone.times(triple(&v[at..]), power));
                target = minus(target, product(s, z));
            }
            cone.times(quotient(target, cone.scaled), 1)
        };
        (0..linear).map(of_row).chain(self.cones.iter().enumerate().flat_map(of_cone)).collect()
    }
}

impl Cone {
    fn new(s: Triple, z: Triple) -> Self {
        let [size_s, size_z] = [s, z].map(|v| determinant(v).sqrt());
        let [s_bar, z_bar] = [s.map(|x| x / size_s), z.map(|x| x / size_z)];
        let gamma = (0.5 * (1.0 + dot(&s_bar, &z_bar))).sqrt();
        let across = [1, 2].map(|i| 0.5 * (s_bar[i] - z_bar[i]) / gamma);
        let length = across[0].hypot(across[1]);
        let u = if length > 0.0 { across.map(|x| x / length) } else { [1.0, 0.0] };
        // The first eigenvalue is (sqrt(1 + length^2) - length) / eta, the second its reciprocal over eta squared.
        let (long, eta) = (length.hypot(1.0) + length, (size_s / size_z).sqrt());
        let half = u.map(|x| x * FRAC_1_SQRT_2);
        let axes = [[FRAC_1_SQRT_2, half[0], half[1]], [FRAC_1_SQRT_2, -half[0], -half[1]], [0.0, -u[1], u[0]]];
        let mut cone = Cone { axes, roots: [1.0 / (long * eta), long / eta, 1.0 / eta], scaled: [0.0; 3] };
        cone.scaled = cone.times(z, -1);
        cone
    }

    /// W^-power v.
    fn times(&self, v: Triple, power: i32) -> Triple {
        let parts = [0, 1, 2].map(|k| self.roots[k].powi(power) * dot(&self.axes[k], &v));
        [0, 1, 2].map(|i| (0..3).map(|k| self.axes[k][i] * parts[k]).sum())
    }
}

/// How far from s in a direction d the boundary of a cone is.
pub(super) fn reach(s: &[f64], d: &[f64]) -> f64 {
    let (s, d) = (triple(s), triple(d));
    // The smallest positive root of a t^2 + 2 b t + c.
    let (a, b, c) = (determinant(d), s[0] * d[0] - s[1] * d[1] - s[2] * d[2], determinant(s));
    let root = (b * b - a * c).max(0.0).sqrt();
    if a >= 0.0 && b >= 0.0 {
        f64::INFINITY
    } else if b > 0.0 {
        (b + root) / -a
    } else {
        c / (root - b)
    }
}

/// v_0^2 - v_1^2 - v_2^2.
fn determinant(v: Triple) -> f64 {
    let across = v[1].hypot(v[2]);
    (v[0] - across) * (v[0] + across)
}

fn product(a: Triple, b: Triple) -> Triple {
    [dot(&a, &b), a[0] * b[1] + b[0] * a[1], a[0] * b[2] + b[0] * a[2]]
}

/// x with product(by, x) = a.
fn quotient(a: Triple, by: Triple) -> Triple {
    let first = (by[0] * a[0] - by[1] * a[1] - by[2] * a[2]) / determinant(by);
    [first, (a[1] - first * by[1]) / by[0], (a[2] - first * by[2]) / by[0]]
}

fn minus(a: Triple, b: Triple) -> Triple {
    [0, 1, 2].map(|i| a[i] - b[i])
}

fn triple(v: &[f64]) -> Triple {
    [v[0], v[1], v[2]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scaling_takes_s_and_z_to_the_same_point_and_a_step_ends_on_the_cone() {
        let unit = [1.0, 0.0, 0.0];
        for (s, z) in [([2.0, 1.0, -0.5], [1.0, 0.3, 0.9]), ([1.0, 0.999, 0.0], [3.0, -1.0, 2.8]), (unit, unit)] {
            let cone = Cone::new(s, z);
            let (one, other) = (cone.times(s, 1), cone.scaled);
            assert!((0..3).all(|i| (one[i] - other[i]).abs() < 1e-12), "{one:?} {other:?}");
            let back = quotient(product(s, z), s);
            assert!((0..3).all(|i| (back[i] - z[i]).abs() < 1e-9));
        }
        for (d, bounded) in [([-1.0, 0.0, 0.0], true), ([0.1, 1.0, 1.0], true), ([1.0, 0.5, 0.0], false)] {
            let s = [2.0, 0.5, -1.0];
            let length = reach(&s, &d);
            assert_eq!(length.is_finite(), bounded);
            let end = [0, 1, 2].map(|i| s[i] + length * d[i]);
            assert!(!bounded || (determinant(end).abs() < 1e-12 && end[0] >= 0.0), "{d:?} {end:?}");
        }
    }
}
