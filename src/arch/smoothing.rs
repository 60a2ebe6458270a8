//! Surveyed points, smoothed: each goes along the normal on to a parabola fitted to the points round it.
//!
//! Local regression (W. S. Cleveland, "Robust locally weighted regression and smoothing scatterplots", J. Am. Stat. Assoc. 74,
//! 1979): x and y are parabolas in the length along the chords, fitted to the points nearer than a given length with its weights
//! (1 - u^3)^3. Points stay where they are along the curve: a joint is not moved to its neighbour.

use crate::geometry::{Vec2, perpendicular};

/// A parabola goes through three points whatever they are: so many have to be near for any to be smoothed.
pub const LEAST_POINTS: usize = 4;

/// A point near the one that is smoothed: its distance from that along the chords, its weight and its place.
type Near = (f64, f64, Vec2);

/// The points smoothed over `length`, m.
///
/// # Errors
/// The number of the first point that has fewer than [`LEAST_POINTS`] nearer than `length`, itself among them, or of the first that
/// coincides with another.
pub fn smoothed(points: &[Vec2], length: f64) -> Result<Vec<Vec2>, usize> {
    let mut along = vec![0.0; points.len()];
    for k in 1..points.len() {
        along[k] = along[k - 1] + (points[k] - points[k - 1]).norm();
    }
    let of = |k: usize| {
        let near: Vec<Near> = points.iter().zip(&along).filter_map(|(at, s)| near(s - along[k], length, *at)).collect();
        let [place, slope] = parabola(&near).filter(|_| near.len() >= LEAST_POINTS).ok_or(k)?;
        let normal = perpendicular(slope) / slope.norm();
        let moved = points[k] + normal * normal.dot(&(place - points[k]));
        if moved.x.is_finite() && moved.y.is_finite() { Ok(moved) } else { Err(k) }
    };
    (0..points.len()).map(of).collect()
}

fn near(distance: f64, length: f64, at: Vec2) -> Option<Near> {
    let share = (distance / length).abs();
    (share < 1.0).then(|| (distance, (1.0 - share.powi(3)).powi(3), at))
}

/// Place and slope at distance 0 of the parabola that fits these points best, from polynomials that are orthogonal on them. None
/// where they stand at fewer than three distances.
fn parabola(near: &[Near]) -> Option<[Vec2; 2]> {
    let at = |[a, b, c]: [f64; 3], d: f64| a + d * (b + d * c);
    let product = |p: [f64; 3], q: [f64; 3]| near.iter().map(|(d, w, _)| w * at(p, *d) * at(q, *d)).sum::<f64>();
    let mut basis: Vec<[f64; 3]> = Vec::new();
    let [mut place, mut slope] = [Vec2::zeros(); 2];
    for power in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
        let mut next = power;
        for known in &basis {
            let share = product(power, *known) / product(*known, *known);
            next = std::array::from_fn(|i| next[i] - share * known[i]);
        }
        let size = product(next, next);
        if size.is_nan() || size <= DEPENDENT * product(power, power) {
            return None;
        }
        let fitted: Vec2 = near.iter().map(|(d, w, point)| point * (w * at(next, *d) / size)).sum();
        place += fitted * next[0];
        slope += fitted * next[1];
        basis.push(next);
    }
    Some([place, slope])
}

/// What is left of a power of the distance beside lower ones is rounding below this share of its square.
const DEPENDENT: f64 = 1e-12;

#[cfg(test)]
mod tests {
    use super::*;

    fn row(count: usize, y: impl Fn(usize) -> f64) -> Vec<Vec2> {
        (0..count).map(|k| Vec2::new(k as f64, y(k))).collect()
    }

    #[test]
    fn a_straight_row_stays_where_it_is_however_its_points_are_spaced() {
        let row: Vec<Vec2> = [0.0, 0.7, 1.0, 2.2, 2.9, 3.1, 4.5].map(|x| Vec2::new(x, 0.3 * x - 1.0)).to_vec();
        for (before, after) in row.iter().zip(smoothed(&row, 3.0).unwrap()) {
            assert!((before - after).norm() < 1e-12, "{before} {after}");
        }
    }

    /// On points at equal distances a parabola at their middle takes the share w_k (m_4 - m_2 d_k^2) / (m_0 m_4 - m_2^2) of point k,
    /// where m_i are the moments of the weights.
    #[test]
    fn a_point_out_of_line_goes_back_by_what_the_moments_of_the_weights_say() {
        let (bump, length) = (1e-5, 3.5);
        let points = row(9, |k| if k == 4 { bump } else { 0.0 });
        let weights: Vec<(f64, f64)> =
            (-3..=3i32).map(|d| (f64::from(d), (1.0 - (f64::from(d).abs() / length).powi(3)).powi(3))).collect();
        let moment = |power: i32| weights.iter().map(|(d, w)| w * d.powi(power)).sum::<f64>();
        let share =
            |d: f64, w: f64| w * (moment(4) - moment(2) * d * d) / (moment(0) * moment(4) - moment(2) * moment(2));
        let after = smoothed(&points, length).unwrap();
        assert!((after[4].y / bump - share(0.0, 1.0)).abs() < 1e-4, "{} of it are left", after[4].y / bump);
        let beside = share(1.0, weights[4].1);
        assert!((after[3].y / bump - beside).abs() < 1e-4 && (after[5].y / bump - beside).abs() < 1e-4);
        assert!(after[0].y.abs() < 1e-12, "{}", after[0]);
    }

    /// What a parabola cannot follow is of the fourth order in the length over the radius.
    #[test]
    fn a_circle_is_hardly_moved_and_the_less_the_shorter_the_length() {
        let points: Vec<Vec2> = (0..=60)
            .map(|k| std::f64::consts::PI * (1.0 - k as f64 / 60.0))
            .map(|a| 10.0 * Vec2::new(a.cos(), a.sin()))
            .collect();
        let moved = |length: f64| {
            let after = smoothed(&points, length).unwrap();
            (after[30] - points[30]).norm()
        };
        let (long, short) = (moved(4.0), moved(2.0));
        assert!(long < 10.0 * 0.4f64.powi(4) / 24.0, "{long}");
        assert!((10.0..25.0).contains(&(long / short)), "{}", long / short);
    }

    #[test]
    fn a_mirrored_row_is_smoothed_to_the_mirror_image() {
        let points: Vec<Vec2> = (0..12)
            .map(|k| 0.2 * f64::from(k) + 0.02 * f64::from(k * k % 5))
            .map(|a| Vec2::new(-5.0 * a.cos(), 5.0 * a.sin() + 0.01 * (9.0 * a).sin()))
            .collect();
        let mirror = |points: &[Vec2]| points.iter().rev().map(|p| Vec2::new(-p.x, p.y)).collect::<Vec<_>>();
        let (once, other) = (smoothed(&points, 4.5).unwrap(), smoothed(&mirror(&points), 4.5).unwrap());
        assert!(mirror(&once).iter().zip(&other).all(|(a, b)| (a - b).norm() < 1e-12));
    }

    #[test]
    fn too_few_points_and_coincident_ones_are_told_by_their_number() {
        assert_eq!(smoothed(&row(9, |_| 0.0), 1.5), Err(0));
        let far = |k: usize| [0.0, 5.0, 10.0][(k > 4) as usize + (k > 5) as usize];
        let apart: Vec<Vec2> = row(12, |_| 0.0).iter().enumerate().map(|(k, at)| at + Vec2::new(far(k), 0.0)).collect();
        assert_eq!(smoothed(&apart, 3.5), Err(5));
        assert!(smoothed(&[Vec2::zeros(); 6], 1.0).is_err());
    }
}
