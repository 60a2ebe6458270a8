//! A ring from points surveyed on its intrados, and the normals of surveyed points.

use super::ring::JointEnds;
use crate::geometry::{Vec2, perpendicular};

/// The joints of a ring of one thickness, one at every point of its intrados, from left to right: each normal to the circle through
/// its point and both neighbours (the first and the last: through the three points at that end). A straight row of points has one
/// normal. None where points coincide or there are fewer than three.
pub fn joints_on_intrados(points: &[Vec2], thickness: f64) -> Option<Vec<JointEnds>> {
    let joint = |(point, outwards): (&Vec2, Vec2)| {
        let end = point + thickness * outwards;
        (end.x.is_finite() && end.y.is_finite()).then_some([*point, end])
    };
    points.iter().zip(outwards(points)?).map(joint).collect()
}

/// Unit normals of a row of points, to the left of its way: out of an arch whose points run from left to right. Each is that of the
/// circle through a point and both neighbours, as [`joints_on_intrados`] has it. None where points coincide or there are fewer than
/// three.
pub fn outwards(points: &[Vec2]) -> Option<Vec<Vec2>> {
    let last = points.len().checked_sub(1).filter(|last| *last >= 2)?;
    let normal = |k: usize| {
        let [back, ahead] = match k {
            0 => [2, 1],
            _ if k == last => [last - 1, last - 2],
            _ => [k - 1, k + 1],
        };
        // Inversion about a point of a circle makes a line of it, in the direction of the tangent there.
        let inverted = |other: usize| {
            let to = points[other] - points[k];
            to / to.norm_squared()
        };
        let along = inverted(ahead) - inverted(back);
        let outwards = perpendicular(along) / along.norm();
        (outwards.x.is_finite() && outwards.y.is_finite()).then_some(outwards)
    };
    (0..=last).map(normal).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joints_of_a_circle_are_radial_however_its_points_are_spaced() {
        let centre = Vec2::new(0.7, -2.0);
        let angles = [2.9, 2.3, 2.1, 1.4, 1.3, 0.2f64];
        let ray = |angle: &f64| Vec2::new(angle.cos(), angle.sin());
        let points: Vec<_> = angles.iter().map(|angle| centre + 5.0 * ray(angle)).collect();
        let joints = joints_on_intrados(&points, 0.4).unwrap();
        for (angle, [intrados, extrados]) in angles.iter().zip(&joints) {
            assert!((intrados - centre - 5.0 * ray(angle)).norm() < 1e-12, "{intrados}");
            assert!((extrados - centre - 5.4 * ray(angle)).norm() < 1e-12, "{extrados}");
        }
    }

    #[test]
    fn a_straight_row_has_one_normal_and_coincident_points_none() {
        let row = [0.0, 1.0, 3.0, 3.5].map(|x| Vec2::new(x, 0.5 * x));
        let joints = joints_on_intrados(&row, 2.0).unwrap();
        let normal = Vec2::new(-1.0, 2.0) / 5f64.sqrt();
        assert!(joints.iter().all(|[a, b]| (b - a - 2.0 * normal).norm() < 1e-12), "{joints:?}");
        assert_eq!(joints_on_intrados(&[row[0], row[1], row[1]], 2.0), None);
        assert_eq!(joints_on_intrados(&row[..2], 2.0), None);
    }
}
