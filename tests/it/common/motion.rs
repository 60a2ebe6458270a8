//! The kinematic side, checked with nothing but the velocities in a report: no stone enters another or the ground,
//! and where no joint slides the loads do no work in the mechanism (the kinematic theorem).

use super::largest::larger;
use super::oracle::{Point, Problem};
use voussoir::collapse::Mechanism;

/// What the velocities of a mechanism say.
#[derive(Debug, Clone, Copy)]
pub struct Motion {
    /// Fastest closing of any corner of a dry joint, as a share of the fastest corner.
    pub entering: f64,
    /// Power of all loads, as a share of the sum of the powers' sizes.
    pub power: f64,
    /// Power of the scaled loads, in the same share.
    pub driving: f64,
}

/// Velocity of `at` on a stone whose centroid moves with (u, v) and turns with w.
fn velocity([u, v, w]: [f64; 3], centroid: Point, at: Point) -> Point {
    [u - w * (at[1] - centroid[1]), v + w * (at[0] - centroid[0])]
}

/// Measures a mechanism at a load factor; `centroids` of the stones as the report means them.
pub fn measure(problem: &Problem, centroids: &[Point], mechanism: &Mechanism, load_factor: f64) -> Motion {
    let moved = |block: Option<usize>, at: Point| match block {
        Some(k) if k < centroids.len() => velocity(mechanism.velocities[k], centroids[k], at),
        _ => [0.0; 2],
    };
    let (mut closing, mut fastest) = (0.0f64, 0.0f64);
    for (k, seam) in problem.seams.iter().enumerate() {
        let along = [0, 1].map(|i| seam.extrados[i] - seam.intrados[i]);
        let length = along[0].hypot(along[1]);
        for corner in [seam.intrados, seam.extrados] {
            let (after, before) = (moved(Some(k), corner), moved(k.checked_sub(1), corner));
            let opening = ((after[0] - before[0]) * along[1] - (after[1] - before[1]) * along[0]) / length;
            closing = larger(closing, -opening);
            fastest = [after, before].iter().map(|v| v[0].hypot(v[1])).fold(fastest, f64::max);
        }
    }
    let (mut power, mut size, mut driving) = (0.0, 0.0, 0.0);
    for (pushes, factor) in [(&problem.fixed, 1.0), (&problem.scaled, load_factor)] {
        for push in pushes {
            let v = moved(Some(push.block), push.at);
            let work = push.force[0] * v[0] + push.force[1] * v[1];
            power += factor * work;
            size += (factor * work).abs();
            driving += if std::ptr::eq(pushes, &problem.scaled) { work } else { 0.0 };
        }
    }
    let size = size.max(f64::MIN_POSITIVE);
    Motion { entering: closing / fastest.max(f64::MIN_POSITIVE), power: power / size, driving: driving / size }
}
