//! Plane geometry: polygons, circular segments, orientation, where lines meet.

use nalgebra::Vector2;

/// A point or a vector in the plane, metres; x to the right, y upwards.
pub type Vec2 = Vector2<f64>;

/// z component of the cross product `a x b`; positive when `b` lies counter-clockwise of `a`.
pub fn cross(a: Vec2, b: Vec2) -> f64 {
    a.x * b.y - a.y * b.x
}

/// `v` turned by +90 degrees.
pub fn perpendicular(v: Vec2) -> Vec2 {
    Vec2::new(-v.y, v.x)
}

/// `v` mirrored about the vertical x = `axis`.
pub fn mirrored(v: Vec2, axis: f64) -> Vec2 {
    Vec2::new(2.0 * axis - v.x, v.y)
}

/// True when the closed segments `a`-`b` and `c`-`d` have a point in common, be it an end.
pub fn segments_meet(a: Vec2, b: Vec2, c: Vec2, d: Vec2) -> bool {
    // Their boxes first: on nearly one line the signs below are those of round-off.
    let overlap = |p: f64, q: f64, r: f64, s: f64| p.max(q) >= r.min(s) && r.max(s) >= p.min(q);
    if !(overlap(a.x, b.x, c.x, d.x) && overlap(a.y, b.y, c.y, d.y)) {
        return false;
    }
    let side = |p: Vec2, q: Vec2, r: Vec2| cross(q - p, r - p);
    let (d1, d2) = (side(c, d, a), side(c, d, b));
    let (d3, d4) = (side(a, b, c), side(a, b, d));
    d1 * d2 <= 0.0 && d3 * d4 <= 0.0
}

/// Distance of the point `p` from the closed segment `a`-`b`, m.
pub fn distance_from_segment(p: Vec2, a: Vec2, b: Vec2) -> f64 {
    let along = b - a;
    let share = ((p - a).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
    (p - a - share * along).norm()
}

/// True when the point lies inside the polygon (even-odd rule, corners in either sense). Points on its outline may be either.
pub fn lies_inside(p: Vec2, corners: &[Vec2]) -> bool {
    let mut inside = false;
    let mut a = corners[corners.len() - 1];
    for &b in corners {
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y)) {
            inside = !inside;
        }
        a = b;
    }
    inside
}

/// Distance along the unit vector `direction` from a point inside a circle to the circle, m; `None` from outside.
pub fn exit_from_circle(from: Vec2, direction: Vec2, centre: Vec2, radius: f64) -> Option<f64> {
    let arm = from - centre;
    let inside = radius * radius - arm.norm_squared();
    if inside <= 0.0 {
        return None;
    }
    let half = arm.dot(&direction);
    let root = (half * half + inside).sqrt();
    // The form without cancellation, whichever way the ray looks.
    Some(if half > 0.0 { inside / (root + half) } else { root - half })
}

/// Area and centroid of a plane region.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Region {
    /// Area in m2, positive for a counter-clockwise boundary.
    pub area: f64,
    /// Centre of area, m.
    pub centroid: Vec2,
}

impl Region {
    /// The region inside a simple polygon, vertices in order (either sense; the sign of `area` tells which).
    pub fn polygon(vertices: &[Vec2]) -> Self {
        // Summed about the first vertex, so that a small block far from the origin keeps its digits.
        let base = vertices[0];
        let (mut area, mut moment) = (0.0, Vec2::zeros());
        for i in 1..vertices.len() - 1 {
            let (a, b) = (vertices[i] - base, vertices[i + 1] - base);
            let triangle = 0.5 * cross(a, b);
            area += triangle;
            moment += (a + b) * (triangle / 3.0);
        }
        Region { area, centroid: base + moment / area }
    }

    /// The circular segment between the chord `from`-`to` and the arc about `centre` (shorter than half a circle).
    ///
    /// The area `r^2 (theta - sin theta) / 2` is positive for a counter-clockwise arc; the centroid lies at
    /// `4 r sin^3(theta/2) / (3 (theta - sin theta))` from the centre (textbook closed forms).
    pub fn segment(centre: Vec2, from: Vec2, to: Vec2) -> Self {
        let (a, b) = (from - centre, to - centre);
        let radius = 0.5 * (a.norm() + b.norm());
        let theta = cross(a, b).atan2(a.dot(&b));
        let excess = angle_less_sine(theta);
        let area = 0.5 * radius * radius * excess;
        if area == 0.0 {
            return Region { area, centroid: 0.5 * (from + to) };
        }
        let arm = 4.0 * radius * (0.5 * theta).sin().powi(3) / (3.0 * excess);
        let bisector = perpendicular(to - from) * -theta.signum();
        Region { area, centroid: centre + bisector.normalize() * arm }
    }

    /// The union of two disjoint regions (a negative area cuts away).
    pub fn join(self, other: Region) -> Region {
        let area = self.area + other.area;
        Region { area, centroid: (self.centroid * self.area + other.centroid * other.area) / area }
    }
}

/// theta - sin theta without cancellation.
fn angle_less_sine(theta: f64) -> f64 {
    if theta.abs() > 0.1 {
        return theta - theta.sin();
    }
    let sq = theta * theta;
    theta * sq / 6.0 * (1.0 - sq / 20.0 * (1.0 - sq / 42.0 * (1.0 - sq / 72.0 * (1.0 - sq / 110.0))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn square_has_its_area_and_centre() {
        let square = [(1.0, 1.0), (3.0, 1.0), (3.0, 4.0), (1.0, 4.0)].map(|(x, y)| Vec2::new(x, y));
        let region = Region::polygon(&square);
        assert_eq!((region.area, region.centroid), (6.0, Vec2::new(2.0, 2.5)));
    }

    #[test]
    fn orientation_changes_the_sign_of_the_area_only() {
        let mut quad = [(0.0, 0.0), (2.0, 0.2), (2.2, 1.0), (-0.1, 0.9)].map(|(x, y)| Vec2::new(x, y));
        let forward = Region::polygon(&quad);
        quad.reverse();
        let backward = Region::polygon(&quad);
        assert!((forward.area + backward.area).abs() < 1e-15);
        assert!((forward.centroid - backward.centroid).norm() < 1e-15);
    }

    #[test]
    fn quarter_of_a_disc_less_its_triangle() {
        let centre = Vec2::new(3.0, -2.0);
        let region = Region::segment(centre, centre + Vec2::new(2.0, 0.0), centre + Vec2::new(0.0, 2.0));
        assert!((region.area - (PI - 2.0)).abs() < 1e-14);
        // First moment about the x axis through the centre: quarter disc r^3/3, triangle r^3/6.
        let lever = (8.0 / 3.0 - 8.0 / 6.0) / (PI - 2.0);
        assert!((region.centroid - centre - Vec2::new(lever, lever)).norm() < 1e-14);
    }

    #[test]
    fn a_clockwise_segment_is_cut_away_and_lies_in_the_same_place() {
        let (a, b) = (Vec2::new(1.0, 0.1), Vec2::new(0.2, 1.0));
        let (a, b) = (a.normalize(), b.normalize());
        let (there, back) = (Region::segment(Vec2::zeros(), a, b), Region::segment(Vec2::zeros(), b, a));
        assert!((there.area + back.area).abs() < 1e-16 && there.area > 0.0);
        assert!((there.centroid - back.centroid).norm() < 1e-14);
    }

    #[test]
    fn segments_of_small_angle_keep_their_digits() {
        assert!((angle_less_sine(0.1) - (0.1 - 0.1f64.sin())).abs() < 1e-16);
        assert!((angle_less_sine(1e-4) / (1e-12 / 6.0) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn segments_meet_when_they_cross_or_touch_only() {
        let p = |x: f64, y: f64| Vec2::new(x, y);
        assert!(segments_meet(p(0.0, 0.0), p(2.0, 2.0), p(0.0, 2.0), p(2.0, 0.0)));
        assert!(segments_meet(p(0.0, 0.0), p(1.0, 0.0), p(1.0, 0.0), p(1.0, 5.0)));
        assert!(segments_meet(p(0.0, 0.0), p(2.0, 0.0), p(1.0, 0.0), p(3.0, 0.0)));
        assert!(!segments_meet(p(0.0, 0.0), p(1.0, 0.0), p(2.0, 0.0), p(3.0, 0.0)));
        assert!(!segments_meet(p(0.0, 0.0), p(1.0, 0.0), p(0.0, 1.0), p(1.0, 1.0)));
        assert!(!segments_meet(p(0.0, 0.0), p(1.0, 1.0), p(3.0, 0.0), p(0.0, 3.0)));
        // One after the other on a level line, but for round-off.
        let level = |x: f64, y: f64| p(x, y * 1e-16);
        assert!(!segments_meet(level(-2.8, 2.1), level(-5.1, 5.7), level(-5.5, 5.2), level(-6.6, 3.8)));
    }

    #[test]
    fn points_are_as_far_from_a_segment_as_from_its_nearest_point() {
        let (a, b) = (Vec2::new(1.0, 1.0), Vec2::new(4.0, 1.0));
        for (p, far) in
            [((2.0, 3.0), 2.0), ((2.0, 0.5), 0.5), ((7.0, 5.0), 5.0), ((-3.0, -2.0), 5.0), ((4.0, 1.0), 0.0)]
        {
            assert!((distance_from_segment(Vec2::new(p.0, p.1), a, b) - far).abs() < 1e-15);
        }
    }

    #[test]
    fn points_in_a_notch_are_outside() {
        let u = [(0.0, 0.0), (3.0, 0.0), (3.0, 2.0), (2.0, 2.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)];
        let mut u = u.map(|(x, y)| Vec2::new(x, y));
        for _ in 0..2 {
            for (p, inside) in
                [((1.5, 1.5), false), ((0.5, 1.5), true), ((2.5, 1.5), true), ((1.5, 0.5), true), ((4.0, 1.0), false)]
            {
                assert_eq!(lies_inside(Vec2::new(p.0, p.1), &u), inside, "{p:?}");
            }
            u.reverse();
        }
    }

    #[test]
    fn a_ray_leaves_the_circle_it_starts_in() {
        let (centre, up) = (Vec2::new(0.0, -1.0), Vec2::new(0.0, 1.0));
        assert_eq!(exit_from_circle(Vec2::new(0.0, 1.0), up, centre, 3.0), Some(1.0));
        assert_eq!(exit_from_circle(Vec2::new(0.0, 1.0), -up, centre, 3.0), Some(5.0));
        assert_eq!(exit_from_circle(Vec2::new(0.0, 3.0), up, centre, 3.0), None);
    }
}
