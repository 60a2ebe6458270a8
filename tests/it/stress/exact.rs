//! The curved beam of section 3.3 of the paper in the theory of elasticity, written down from an Airy function.

use std::f64::consts::FRAC_PI_2;

/// The quarter ring a <= r <= b, bent by a shear force P at the end theta = 0.
///
/// Airy function (A r^3 + B / r + C r ln r) sin theta (Timoshenko and Goodier); the faces are free where
/// B = -A a^2 b^2 and C = -2 A (a^2 + b^2).
#[derive(Debug, Clone, Copy)]
pub struct Ring {
    pub radii: [f64; 2],
    pub shear: f64,
}

/// sigma_r, sigma_theta, tau_r_theta, Pa.
pub type Polar = [f64; 3];

impl Ring {
    /// The stress from the derivatives of the Airy function, its size from the resultant P.
    pub fn stress(&self, r: f64, theta: f64) -> Polar {
        let [a, b] = self.radii.map(|r| r * r);
        // The integral of A (2 r - 2 a^2 b^2 / r^3 - 2 (a^2 + b^2) / r) ... over the thickness is -P.
        let scale = 0.5 * self.shear / (a - b + 0.5 * (a + b) * (b / a).ln());
        let (cubic, inverse, log) = (scale, -scale * a * b, -2.0 * scale * (a + b));
        // phi / r' and phi'' of f(r) = cubic r^3 + inverse / r + log r ln r.
        let f = cubic * r.powi(3) + inverse / r + log * r * r.ln();
        let first = 3.0 * cubic * r * r - inverse / (r * r) + log * (r.ln() + 1.0);
        let second = 6.0 * cubic * r + 2.0 * inverse / r.powi(3) + log / r;
        let (sin, cos) = theta.sin_cos();
        [(first / r - f / (r * r)) * sin, second * sin, (f / (r * r) - first / r) * cos]
    }

    /// Equivalent stress of Tresca, eq. (4) of the paper, Pa.
    pub fn tresca(&self, r: f64, theta: f64) -> f64 {
        tresca(self.stress(r, theta))
    }

    /// sigma_x, sigma_y and tau_xy at a point, Pa; theta runs from the x axis.
    pub fn at(&self, x: f64, y: f64) -> [f64; 3] {
        let theta = y.atan2(x);
        let ([radial, hoop, shear], (sin, cos)) = (self.stress(x.hypot(y), theta), theta.sin_cos());
        [
            radial * cos * cos + hoop * sin * sin - 2.0 * shear * sin * cos,
            radial * sin * sin + hoop * cos * cos + 2.0 * shear * sin * cos,
            (radial - hoop) * sin * cos + shear * (cos * cos - sin * sin),
        ]
    }

    /// Strain energy in plane stress, J/m, by Gauss's rule of five points on 64 x 64 cells.
    pub fn energy(&self, youngs_modulus: f64, poissons_ratio: f64) -> f64 {
        let density = |r: f64, theta: f64| {
            let [s, t, tau] = self.stress(r, theta);
            let twice = s * s + t * t - 2.0 * poissons_ratio * s * t + 2.0 * (1.0 + poissons_ratio) * tau * tau;
            0.5 * twice / youngs_modulus * r
        };
        integral(|theta| integral(|r| density(r, theta), self.radii), [0.0, FRAC_PI_2])
    }
}

/// The largest of |s_1 - s_2|, |s_1| and |s_2| of a state (s_x, s_y, tau), by the roots of its characteristic equation.
pub fn tresca([x, y, tau]: [f64; 3]) -> f64 {
    let (trace, determinant) = (x + y, x * y - tau * tau);
    let root = (trace * trace - 4.0 * determinant).max(0.0).sqrt();
    [root, 0.5 * (trace + root), 0.5 * (trace - root)].into_iter().map(f64::abs).fold(0.0, f64::max)
}

/// Gauss's rule of five points on 64 parts.
pub fn integral(f: impl Fn(f64) -> f64, [from, to]: [f64; 2]) -> f64 {
    let [near, far] = [-1.0, 1.0].map(|s: f64| (5.0 + s * 2.0 * (10.0f64 / 7.0).sqrt()).sqrt() / 3.0);
    let [heavy, light] = [1.0, -1.0].map(|s: f64| (322.0 + s * 13.0 * 70f64.sqrt()) / 900.0);
    let rule = [(0.0, 128.0 / 225.0), (near, heavy), (-near, heavy), (far, light), (-far, light)];
    let (parts, width) = (64, (to - from) / 64.0);
    let part = |i: i32| {
        let middle = from + (f64::from(i) + 0.5) * width;
        rule.iter().map(|(place, weight)| weight * f(middle + 0.5 * width * place)).sum::<f64>() * 0.5 * width
    };
    (0..parts).map(part).sum()
}

/// Facts of `curved_beam_exact.json` (a = 0.5, b = 0.7 m, P = 2500 N/m, E = 1e9 Pa, nu = 0.25, plane stress).
pub const PAPER: Ring = Ring { radii: [0.5, 0.7], shear: 2500.0 };

fn near(got: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((got / expected - 1.0).abs() <= tolerance, "{what}: {got}, not {expected}");
}

#[test]
fn the_exact_stress_is_in_equilibrium_and_compatible() {
    let h = 1e-4;
    for (r, theta) in [(0.52, 0.3), (0.58, 1.1), (0.6, 0.02), (0.66, 1.5), (0.69, 0.8)] {
        let at = |dr: f64, dtheta: f64| PAPER.stress(r + dr * h, theta + dtheta * h);
        let by = |i: usize, k: usize| {
            let step = |s: f64| if k == 0 { at(s, 0.0)[i] } else { at(0.0, s)[i] };
            (step(-2.0) - 8.0 * step(-1.0) + 8.0 * step(1.0) - step(2.0)) / (12.0 * h)
        };
        let [s, t, tau] = at(0.0, 0.0);
        let radial = by(0, 0) + by(2, 1) / r + (s - t) / r;
        let circumferential = by(2, 0) + by(1, 1) / r + 2.0 * tau / r;
        let sum = |dr: f64, dtheta: f64| at(dr, dtheta)[..2].iter().sum::<f64>();
        let laplacian = (sum(1.0, 0.0) + sum(-1.0, 0.0) - 2.0 * sum(0.0, 0.0)) / (h * h)
            + (sum(1.0, 0.0) - sum(-1.0, 0.0)) / (2.0 * h * r)
            + (sum(0.0, 1.0) + sum(0.0, -1.0) - 2.0 * sum(0.0, 0.0)) / (h * h * r * r);
        let gradient = 2.7e5 / 0.2;
        assert!(radial.abs() <= 1e-6 * gradient && circumferential.abs() <= 1e-6 * gradient, "{r} {theta}");
        assert!(laplacian.abs() <= 1e-4 * gradient / 0.2, "compatibility at {r} {theta}: {laplacian}");
    }
}

#[test]
fn the_exact_stress_has_free_faces_and_the_resultant_p() {
    for ring in [PAPER, Ring { radii: [0.4, 0.7], shear: 2500.0 }] {
        let [a, b] = ring.radii;
        for theta in [0.0, 0.4, 1.0, FRAC_PI_2] {
            for r in ring.radii {
                let [radial, _, shear] = ring.stress(r, theta);
                assert!(radial.abs().max(shear.abs()) <= 1e-6, "a face at {theta} carries {radial} {shear}");
            }
        }
        near(integral(|r| ring.stress(r, 0.0)[2], [a, b]), 2500.0, 1e-10, "shear at theta = 0");
        near(integral(|r| ring.stress(r, FRAC_PI_2)[1], [a, b]).abs(), 2500.0, 1e-10, "thrust at 90 degrees");
        // P at the outer end, on the ray theta = 0 at the middle of the force's line: moment about the centre is zero
        // there, so that of sigma_theta at 90 degrees is zero as well.
        let moment = integral(|r| r * ring.stress(r, FRAC_PI_2)[1], [a, b]);
        assert!(moment.abs() <= 1e-6, "moment about the centre {moment}");
    }
}

#[test]
fn the_exact_stress_has_the_reference_numbers() {
    near(PAPER.stress(0.5, FRAC_PI_2)[1], -266_979.475, 1e-8, "sigma_theta at the inner face");
    near(PAPER.stress(0.7, FRAC_PI_2)[1], 190_699.625, 1e-8, "sigma_theta at the outer face");
    near(PAPER.tresca(0.5, FRAC_PI_2), 266_979.475, 1e-8, "largest equivalent stress");
    near(PAPER.energy(1e9, 0.25), 0.808_161_67, 1e-7, "strain energy");
    for (n, norm) in [(4, 374_448.280_598), (7, 669_407.503_382), (10, 961_712.507_6), (16, 1_543_576.493_475)] {
        let share = |k: usize| (k as f64 + 0.5) / n as f64;
        let cells = (0..n * n).map(|c| PAPER.tresca(0.5 + 0.2 * share(c % n), FRAC_PI_2 * share(c / n)));
        near(cells.map(|t| t * t).sum::<f64>().sqrt(), norm, 1e-9, "norm at the cells' middles");
    }
}
