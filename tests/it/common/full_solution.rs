//! Whether forces and velocities of an answer are a full solution without dilation, from plain numbers alone.

use super::largest::{larger, largest};
use super::oracle::{Bond, Point, Problem, Push};
use voussoir::collapse::PathEnd;

/// How far an answer is from a full solution; all shares of the loads, of the fastest corner, or of both.
#[derive(Debug, Clone, Copy, Default)]
pub struct Gap {
    /// Forces on some stone that do not balance.
    pub unbalanced: f64,
    /// Tension, or shear beyond Coulomb's law.
    pub inadmissible: f64,
    /// Corners that enter each other.
    pub entering: f64,
    /// Force at a corner that opens, or opening where there is force: the product.
    pub opens_under_force: f64,
    /// Friction that does not act against the sliding in full: its lack, times the sliding.
    pub slides_freely: f64,
    /// Power of the scaled loads, as a share of the most that they could do.
    pub driving: f64,
}

impl Gap {
    /// The largest of all but the power.
    pub fn worst(&self) -> f64 {
        let all = [self.unbalanced, self.inadmissible, self.entering, self.opens_under_force, self.slides_freely];
        largest(all)
    }
}

/// Measures the end of a path; `centroids` are those of the stones as the report means them.
pub fn measure(problem: &Problem, centroids: &[Point], end: &PathEnd) -> Gap {
    let mut gap = Gap::default();
    let pushes = || problem.fixed.iter().map(|p| (p, 1.0)).chain(problem.scaled.iter().map(|p| (p, end.load_factor)));
    let forces = |joint: usize| {
        let (thrust, length) = (&end.thrust_line[joint], length(problem, joint));
        let share = thrust.eccentricity / length;
        [thrust.normal * (0.5 - share), thrust.normal * (0.5 + share), thrust.shear]
    };
    let largest = (0..problem.seams.len()).map(|k| end.thrust_line[k].normal.abs()).fold(0.0, f64::max);
    let loads = pushes().map(|(p, by)| (p.force[0] * by).hypot(p.force[1] * by)).sum::<f64>().max(largest);
    for (block, centre) in centroids.iter().enumerate() {
        let mut sum = [0.0; 3];
        let mut add = |at: Point, [fx, fy]: Point, by: f64| {
            sum[0] += by * fx;
            sum[1] += by * fy;
            sum[2] += by * ((at[0] - centre[0]) * fy - (at[1] - centre[1]) * fx);
        };
        pushes().filter(|(p, _)| p.block == block).for_each(|(p, by): (&Push, f64)| add(p.at, p.force, by));
        for (joint, by) in [(block, 1.0), (block + 1, -1.0)] {
            let (seam, [inner, outer, shear], (normal, along)) =
                (&problem.seams[joint], forces(joint), axes(problem, joint));
            add(seam.intrados, normal.map(|n| n * inner), by);
            add(seam.extrados, normal.map(|n| n * outer), by);
            add(seam.intrados, along.map(|t| t * shear), by);
        }
        let arm = length(problem, block);
        gap.unbalanced = [sum[0], sum[1], sum[2] / arm].iter().fold(gap.unbalanced, |w, x| larger(w, x.abs() / loads));
    }
    let moved = |block: Option<usize>, at: Point| match block {
        Some(k) if k < centroids.len() => {
            let [u, v, w] = end.mechanism.velocities[k];
            [u - w * (at[1] - centroids[k][1]), v + w * (at[0] - centroids[k][0])]
        }
        _ => [0.0; 2],
    };
    let fastest =
        problem.seams.iter().enumerate().flat_map(|(k, s)| [moved(Some(k), s.intrados), moved(Some(k), s.extrados)]);
    let fastest = fastest.map(|v| v[0].hypot(v[1])).fold(f64::MIN_POSITIVE, f64::max);
    for (k, seam) in problem.seams.iter().enumerate() {
        let ([inner, outer, shear], (normal, along)) = (forces(k), axes(problem, k));
        let Bond::Dry { friction, cohesion } = seam.bond else { continue };
        let capacity = friction * (inner + outer) + cohesion * length(problem, k);
        gap.inadmissible =
            [-inner, -outer, shear.abs() - capacity].iter().fold(gap.inadmissible, |w, x| larger(w, x / loads));
        for (corner, force) in [(seam.intrados, inner), (seam.extrados, outer)] {
            let (after, before) = (moved(Some(k), corner), moved(k.checked_sub(1), corner));
            let rate = [after[0] - before[0], after[1] - before[1]].map(|v| v / fastest);
            let opening = rate[0] * normal[0] + rate[1] * normal[1];
            let slip = rate[0] * along[0] + rate[1] * along[1];
            gap.entering = larger(gap.entering, -opening);
            gap.opens_under_force = larger(gap.opens_under_force, opening * force.max(0.0) / loads);
            // What touches and slides is held back by all its friction, and by its cohesion unless the other corner opens.
            if force > 1e-9 * loads {
                let opens = inner.min(outer) <= 1e-9 * loads;
                let held = friction * (inner + outer) + slip.signum() * shear;
                let held = if opens { held } else { held + cohesion * length(problem, k) };
                let held = if opens && cohesion > 0.0 { held.max(0.0) } else { held.abs() };
                gap.slides_freely = larger(gap.slides_freely, slip.abs() * held / loads);
            }
        }
    }
    let (mut done, mut possible) = (0.0, f64::MIN_POSITIVE);
    for push in &problem.scaled {
        let v = moved(Some(push.block), push.at);
        done += push.force[0] * v[0] + push.force[1] * v[1];
        possible += push.force[0].hypot(push.force[1]) * fastest;
    }
    gap.driving = done / possible;
    gap
}

fn length(problem: &Problem, joint: usize) -> f64 {
    let seam = &problem.seams[joint];
    (seam.extrados[0] - seam.intrados[0]).hypot(seam.extrados[1] - seam.intrados[1])
}

/// Unit normal, from the stone before the joint into the one after it, and unit vector towards the extrados.
fn axes(problem: &Problem, joint: usize) -> (Point, Point) {
    let seam = &problem.seams[joint];
    let along = [0, 1].map(|i| (seam.extrados[i] - seam.intrados[i]) / length(problem, joint));
    ([along[1], -along[0]], along)
}
