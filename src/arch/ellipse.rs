//! A half ellipse measured along its arc.

use crate::geometry::Vec2;
use std::f64::consts::FRAC_PI_2;

/// Panels into which the quarter is cut; with the rule below, lengths are good to round-off for axis ratios
/// from 0.01 to 100.
const PANELS: usize = 256;

/// Nodes and weights of the five-point Gauss-Legendre rule on (-1, 1).
const GAUSS_5: [(f64, f64); 5] = [
    (0.0, 128.0 / 225.0),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// The ellipse x = -a sin(phi), y = b cos(phi), measured from the crown (phi = 0) to the left.
#[derive(Debug, Clone, PartialEq)]
pub struct Ellipse {
    half_span: f64,
    rise: f64,
    /// Arc length from the crown to the end of every panel, m.
    lengths: Vec<f64>,
}

impl Ellipse {
    /// From half the span and the rise, m.
    pub fn new(half_span: f64, rise: f64) -> Self {
        let mut ellipse = Ellipse { half_span, rise, lengths: vec![0.0] };
        let mut total = 0.0;
        for panel in 0..PANELS {
            total += ellipse.length_between(panel_start(panel), panel_start(panel + 1));
            ellipse.lengths.push(total);
        }
        ellipse
    }

    /// Arc length of the quarter, m.
    pub fn quarter(&self) -> f64 {
        self.lengths[PANELS]
    }

    /// Least radius of curvature, m.
    pub fn least_radius(&self) -> f64 {
        let (a, b) = (self.half_span, self.rise);
        (a * a / b).min(b * b / a)
    }

    /// Point and unit tangent (of travel from left to right) at arc length `u` from the crown to the left;
    /// beyond the crown (`u` < 0) and the springing the ellipse simply goes on.
    pub fn at(&self, u: f64) -> (Vec2, Vec2) {
        let quarter = self.quarter();
        let phi = if u < 0.0 {
            -self.parameter(-u)
        } else if u > quarter {
            2.0 * FRAC_PI_2 - self.parameter(2.0 * quarter - u)
        } else {
            self.parameter(u)
        };
        let (sin, cos) = phi.sin_cos();
        let tangent = Vec2::new(self.half_span * cos, self.rise * sin).normalize();
        (Vec2::new(-self.half_span * sin, self.rise * cos), tangent)
    }

    /// phi at arc length `u` in [0, quarter] by Newton's method inside one panel.
    fn parameter(&self, u: f64) -> f64 {
        let panel = self.lengths.partition_point(|&length| length <= u).clamp(1, PANELS) - 1;
        let (start, end) = (panel_start(panel), panel_start(panel + 1));
        let (from, to) = (self.lengths[panel], self.lengths[panel + 1]);
        let mut phi = start + (end - start) * ((u - from) / (to - from)).clamp(0.0, 1.0);
        for _ in 0..8 {
            let step = (from + self.length_between(start, phi) - u) / self.speed(phi);
            phi = (phi - step).clamp(start, end);
            if step.abs() < 1e-15 {
                break;
            }
        }
        phi
    }

    /// d(arc length)/d(phi), m.
    fn speed(&self, phi: f64) -> f64 {
        (self.half_span * phi.cos()).hypot(self.rise * phi.sin())
    }

    fn length_between(&self, from: f64, to: f64) -> f64 {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        half * GAUSS_5.iter().map(|&(node, weight)| weight * self.speed(middle + half * node)).sum::<f64>()
    }
}

fn panel_start(panel: usize) -> f64 {
    FRAC_PI_2 * panel as f64 / PANELS as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_perimeters_are_those_of_the_tables() {
        // a E(m): E(3/4) = 1.2110560275684594, E(0) = pi/2; Abramowitz & Stegun, table 17.1.
        assert!((Ellipse::new(1.0, 0.5).quarter() - 1.211_056_027_568_459_4).abs() < 1e-14);
        assert!((Ellipse::new(0.5, 1.0).quarter() - 1.211_056_027_568_459_4).abs() < 1e-14);
        assert!((Ellipse::new(2.0, 2.0).quarter() - 2.0 * FRAC_PI_2).abs() < 1e-14);
        // Flat: a (1 + ...) tends to the half span.
        assert!((Ellipse::new(1.0, 0.01).quarter() - 1.000_274_6).abs() < 1e-6);
    }

    #[test]
    fn arc_length_is_inverted_to_round_off() {
        for (a, b) in [(1.0, 0.5), (1.0, 0.01), (1.0, 30.0)] {
            let ellipse = Ellipse::new(a, b);
            for i in 0..=37 {
                let u = ellipse.quarter() * f64::from(i) / 37.0;
                let phi = ellipse.parameter(u);
                let panels = 4000;
                let step = phi / f64::from(panels);
                let back: f64 =
                    (0..panels).map(|k| ellipse.length_between(step * f64::from(k), step * f64::from(k + 1))).sum();
                assert!((back - u).abs() < 1e-12 * ellipse.quarter(), "{a} {b} {u} {back}");
            }
        }
    }

    #[test]
    fn tangent_is_the_derivative_and_the_curve_goes_on_beyond_its_ends() {
        let ellipse = Ellipse::new(3.0, 1.2);
        let h = 1e-5;
        for u in [-0.4, 0.0, 0.3, 2.0, ellipse.quarter() - 0.01, ellipse.quarter() + 0.3] {
            let slope = (ellipse.at(u - h).0 - ellipse.at(u + h).0) / (2.0 * h);
            assert!((slope - ellipse.at(u).1).norm() < 1e-8, "{u}");
        }
    }
}
