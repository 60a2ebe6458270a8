//! Plane geometry: polygons, circular segments, orientation.

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

    /// The union of two disjoint regions (a negative area cuts away).
    pub fn join(self, other: Region) -> Region {
        let area = self.area + other.area;
        Region { area, centroid: (self.centroid * self.area + other.centroid * other.area) / area }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
