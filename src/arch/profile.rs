//! Profile lines: the one curve from which an arch is set out.
//!
//! Every profile is symmetric about x = 0 and springs from y = 0. Only the left half is kept; places are named by
//! the arc length `sigma` from the crown, negative on the left.

use super::ellipse::Ellipse;
use crate::geometry::{Vec2, mirrored, perpendicular};

/// A place on a profile line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// The point, m.
    pub point: Vec2,
    /// Unit tangent, in the sense of travel from left to right.
    pub tangent: Vec2,
}

impl Station {
    /// Unit normal, towards the extrados.
    pub fn outward(&self) -> Vec2 {
        perpendicular(self.tangent)
    }

    /// The same place on the other half.
    pub fn mirrored(self) -> Station {
        Station { point: mirrored(self.point, 0.0), tangent: Vec2::new(self.tangent.x, -self.tangent.y) }
    }
}

/// One circular arc of the left half; `lean` is the angle of its outward normal from the vertical, to the left.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Arc {
    centre: Vec2,
    radius: f64,
    /// Arc length and lean at the end nearer the crown.
    start: f64,
    lean: f64,
}

impl Arc {
    fn at(&self, u: f64) -> Station {
        let (sin, cos) = (self.lean + (u - self.start) / self.radius).sin_cos();
        Station { point: self.centre + self.radius * Vec2::new(-sin, cos), tangent: Vec2::new(cos, sin) }
    }
}

#[derive(Debug, Clone, PartialEq)]
enum Half {
    /// From the crown to the springing.
    Arcs(Vec<Arc>),
    Ellipse(Ellipse),
}

/// A symmetric profile line.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    half: Half,
    half_length: f64,
}

impl Profile {
    /// A circular arc from its radius, m, and its full opening angle, rad.
    pub fn circular(radius: f64, opening: f64) -> Self {
        Self::arcs(0.0, &[(radius, 0.5 * opening)])
    }

    /// A circular arc from its span and rise, m: R = (h^2 + f^2) / 2f with half span h and rise f.
    pub fn circular_by_span(span: f64, rise: f64) -> Self {
        let half = 0.5 * span;
        Self::circular((half * half + rise * rise) / (2.0 * rise), 4.0 * (rise / half).atan())
    }

    /// Two arcs of radius `radius` whose centres lie at the springing level, that of the left arc at x = +`offset`, m.
    pub fn pointed(radius: f64, offset: f64) -> Self {
        let lean = (offset / radius).asin();
        Self::arcs(lean, &[(radius, std::f64::consts::FRAC_PI_2 - lean)])
    }

    /// A pointed profile from its span and rise, m: R + c = f^2 / h and R - c = h.
    pub fn pointed_by_span(span: f64, rise: f64) -> Self {
        let half = 0.5 * span;
        let sum = rise * rise / half;
        Self::pointed(0.5 * (sum + half), 0.5 * (sum - half))
    }

    /// Half an ellipse, m.
    pub fn elliptical(span: f64, rise: f64) -> Self {
        let ellipse = Ellipse::new(0.5 * span, rise);
        Profile { half_length: ellipse.quarter(), half: Half::Ellipse(ellipse) }
    }

    /// Tangent arcs (radius in m, angle in rad) from the left springing to the crown, where the tangent is horizontal.
    pub fn multi_centre(arcs: &[(f64, f64)]) -> Self {
        let from_crown: Vec<_> = arcs.iter().rev().copied().collect();
        Self::arcs(0.0, &from_crown)
    }

    fn arcs(lean_at_crown: f64, from_crown: &[(f64, f64)]) -> Self {
        let (mut lean, mut start, mut point) = (lean_at_crown, 0.0, Vec2::zeros());
        let mut arcs = Vec::new();
        for &(radius, angle) in from_crown {
            let centre = point - radius * Vec2::new(-lean.sin(), lean.cos());
            arcs.push(Arc { centre, radius, start, lean });
            lean += angle;
            start += radius * angle;
            point = centre + radius * Vec2::new(-lean.sin(), lean.cos());
        }
        for arc in &mut arcs {
            arc.centre.y -= point.y;
        }
        Profile { half: Half::Arcs(arcs), half_length: start }
    }

    /// Arc length from springing to springing, m.
    pub fn length(&self) -> f64 {
        2.0 * self.half_length
    }

    /// Least radius of curvature, m.
    pub fn least_radius(&self) -> f64 {
        match &self.half {
            Half::Arcs(arcs) => arcs.iter().map(|arc| arc.radius).fold(f64::INFINITY, f64::min),
            Half::Ellipse(ellipse) => ellipse.least_radius(),
        }
    }

    /// True when the two halves meet at an angle, as in a pointed arch.
    pub fn has_apex(&self) -> bool {
        matches!(&self.half, Half::Arcs(arcs) if arcs[0].lean > 1e-12)
    }

    /// The place at arc length `sigma` from the crown, negative on the left. At an apex: that of the left half.
    pub fn at(&self, sigma: f64) -> Station {
        if sigma > 0.0 { self.left_at(sigma).mirrored() } else { self.left_at(-sigma) }
    }

    /// The place on the left half at arc length `u` from the crown; beyond its ends the half goes on smoothly.
    pub fn left_at(&self, u: f64) -> Station {
        match &self.half {
            Half::Arcs(arcs) => arcs[arc_at(arcs, u)].at(u),
            Half::Ellipse(ellipse) => {
                let (point, tangent) = ellipse.at(u);
                Station { point, tangent }
            }
        }
    }

    /// Places between two arcs (an apex included), as `sigma` in rising order; none on an ellipse.
    pub fn breaks(&self) -> Vec<f64> {
        let Half::Arcs(arcs) = &self.half else { return Vec::new() };
        let inner = || arcs.iter().skip(1).map(|arc| arc.start);
        let mut breaks: Vec<f64> = inner().rev().map(|u| -u).collect();
        if self.has_apex() {
            breaks.push(0.0);
        }
        breaks.extend(inner());
        breaks
    }

    /// Centre of the circle on which the place `sigma` lies; `None` on an ellipse.
    pub fn centre_at(&self, sigma: f64) -> Option<Vec2> {
        let Half::Arcs(arcs) = &self.half else { return None };
        let centre = arcs[arc_at(arcs, sigma.abs())].centre;
        Some(if sigma > 0.0 { mirrored(centre, 0.0) } else { centre })
    }
}

fn arc_at(arcs: &[Arc], u: f64) -> usize {
    arcs.iter().rposition(|arc| arc.start <= u).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn all() -> Vec<Profile> {
        vec![
            Profile::circular(10.0, PI),
            Profile::circular(1.0, 240f64.to_radians()),
            Profile::circular_by_span(10.0, 2.0),
            Profile::pointed(5.0, 1.5),
            Profile::elliptical(8.0, 3.0),
            Profile::multi_centre(&oval()),
        ]
    }

    fn oval() -> [(f64, f64); 3] {
        [(3.25, 50.0), (7.3, 60.0), (3.5, 15.0)].map(|(radius, angle)| (radius, f64::to_radians(angle)))
    }

    #[test]
    fn every_profile_springs_from_the_level_and_is_symmetric() {
        for profile in all() {
            let half = 0.5 * profile.length();
            assert!(profile.at(-half).point.y.abs() < 1e-14);
            assert!(profile.at(0.0).point.x.abs() < 1e-14);
            for share in [0.1, 0.5, 0.77, 1.0] {
                let (left, right) = (profile.at(-share * half), profile.at(share * half));
                assert_eq!(left.point, mirrored(right.point, 0.0));
                assert_eq!(left.outward(), mirrored(right.outward(), 0.0));
            }
        }
    }

    #[test]
    fn tangents_are_derivatives() {
        for profile in all() {
            let (half, h) = (0.5 * profile.length(), 1e-6);
            for share in [-0.93, -0.41, 0.23, 0.64] {
                let sigma = share * half;
                let slope = (profile.at(sigma + h).point - profile.at(sigma - h).point) / (2.0 * h);
                assert!((slope - profile.at(sigma).tangent).norm() < 1e-8);
            }
        }
    }

    #[test]
    fn span_and_rise_give_the_same_circle_as_radius_and_angle() {
        let (radius, half_angle) = (7.0f64, 1.1f64);
        let by_span = Profile::circular_by_span(2.0 * radius * half_angle.sin(), radius * (1.0 - half_angle.cos()));
        let by_radius = Profile::circular(radius, 2.0 * half_angle);
        assert!((by_span.length() - by_radius.length()).abs() < 1e-13);
        assert!((by_span.at(-2.0).point - by_radius.at(-2.0).point).norm() < 1e-14);
        assert!((by_span.centre_at(0.0).unwrap() - Vec2::new(0.0, -radius * half_angle.cos())).norm() < 1e-14);
    }

    #[test]
    fn a_pointed_profile_has_its_span_rise_and_apex() {
        let (span, rise) = (6.0, 4.0);
        let profile = Profile::pointed_by_span(span, rise);
        assert!((profile.at(0.0).point - Vec2::new(0.0, rise)).norm() < 1e-14);
        assert!((profile.at(-0.5 * profile.length()).point - Vec2::new(-3.0, 0.0)).norm() < 1e-14);
        assert!(profile.has_apex() && profile.breaks() == [0.0]);
        assert!(!Profile::pointed(1.0, 0.0).has_apex());
        assert_eq!(profile.centre_at(-1.0).map(|c| -c.x), profile.centre_at(1.0).map(|c| c.x));
    }

    #[test]
    fn the_oval_axis_passes_through_the_published_fit() {
        // Joints of the left half axis, references/paper_oval.json.
        let axis = [
            (-5.59073, 0.0),
            (-6.13024, 1.30621),
            (-6.06435, 2.71793),
            (-5.56173, 4.04853),
            (-4.81062, 5.2564),
            (-3.83955, 6.2957),
            (-2.68537, 7.12696),
            (-1.3919, 7.71862),
            (0.0, 7.98642),
        ];
        let profile = Profile::multi_centre(&oval());
        for (k, (x, y)) in axis.into_iter().enumerate() {
            let point = profile.at(profile.length() * (k as f64 / 16.0 - 0.5)).point;
            assert!((point - Vec2::new(x, y)).amax() < 6e-6, "{k} {point}");
        }
        assert_eq!(profile.breaks().len(), 4);
    }
}
