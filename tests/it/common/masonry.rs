//! Arches and loads written down a second time, for the oracle alone: nothing of `src/` is used.

use super::oracle::{Bond, Point, Problem, Push, Seam};
use std::f64::consts::{FRAC_PI_2, PI};

/// `thrust_range.json` (derived and checked there): least and greatest thrust over the weight, continuous joints; half opening and t/R.
pub const THRUSTS: [(f64, f64, [f64; 2]); 9] = [
    (90.0, 0.12, [0.190828, 0.207004]),
    (90.0, 0.15, [0.175873, 0.226976]),
    (90.0, 0.2, [0.154042, 0.254554]),
    (80.0, 0.15, [0.197857, 0.314927]),
    (70.0, 0.1, [0.259573, 0.378587]),
    (60.0, 0.1, [0.302835, 0.507605]),
    (60.0, 0.05, [0.353895, 0.441552]),
    (45.0, 0.1, [0.394605, 0.889544]),
    (30.0, 0.05, [0.641035, 1.469093]),
];

/// A ring of stones: joints from left to right as (intrados, extrados), stones by area and centroid.
#[derive(Debug, Clone)]
pub struct Ring {
    pub joints: Vec<(Point, Point)>,
    pub stones: Vec<(f64, Point)>,
}

/// Polar point about (0, 0).
pub fn polar(radius: f64, angle: f64) -> Point {
    [radius * angle.cos(), radius * angle.sin()]
}

/// Area (positive) and centroid of a polygon.
pub fn polygon(corners: &[Point]) -> (f64, Point) {
    let base = corners[0];
    let (mut twice, mut moment) = (0.0, [0.0; 2]);
    for pair in corners[1..].windows(2) {
        let [a, b] = [0, 1].map(|k| [pair[k][0] - base[0], pair[k][1] - base[1]]);
        let area = a[0] * b[1] - a[1] * b[0];
        twice += area;
        moment = [0, 1].map(|i| moment[i] + area * (a[i] + b[i]) / 3.0);
    }
    (twice.abs() / 2.0, [0, 1].map(|i| base[i] + moment[i] / twice))
}

impl Ring {
    /// Straight-sided stones between given joints.
    pub fn straight(joints: Vec<(Point, Point)>) -> Ring {
        let stones = joints.windows(2).map(|j| polygon(&[j[0].0, j[0].1, j[1].1, j[1].0])).collect();
        Ring { joints, stones }
    }

    /// Circular, mean radius 1, half opening `half`, `count` equal straight-edged stones, radial joints.
    pub fn circular(half_deg: f64, thickness: f64, count: usize) -> Ring {
        let half = half_deg.to_radians();
        let joint = |k: usize| {
            let angle = FRAC_PI_2 + half - 2.0 * half * k as f64 / count as f64;
            (polar(1.0 - thickness / 2.0, angle), polar(1.0 + thickness / 2.0, angle))
        };
        Ring::straight((0..=count).map(joint).collect())
    }

    /// The same with the exact annular sectors.
    pub fn sectors(half_deg: f64, thickness: f64, count: usize) -> Ring {
        let mut ring = Ring::circular(half_deg, thickness, count);
        let half = half_deg.to_radians();
        let step = 2.0 * half / count as f64;
        let (inner, outer) = (1.0 - thickness / 2.0, 1.0 + thickness / 2.0);
        let area = step / 2.0 * (outer.powi(2) - inner.powi(2));
        let radius = 2.0 / 3.0 * (outer.powi(3) - inner.powi(3)) * 2.0 * (step / 2.0).sin() / (2.0 * area);
        for (k, stone) in ring.stones.iter_mut().enumerate() {
            *stone = (area, polar(radius, FRAC_PI_2 + half - step * (k as f64 + 0.5)));
        }
        ring
    }

    /// Half ellipse (half span 1, the given rise) as axis, joints normal to it at equal axis length.
    pub fn elliptical(rise: f64, thickness: f64, count: usize) -> Ring {
        let speed = |u: f64| u.sin().hypot(rise * u.cos());
        let steps = 20_000;
        let h = PI / steps as f64;
        let mut lengths = vec![0.0];
        for i in 0..steps {
            let u = i as f64 * h;
            let simpson = h / 6.0 * (speed(u) + 4.0 * speed(u + h / 2.0) + speed(u + h));
            lengths.push(lengths[i] + simpson);
        }
        let joint = |k: usize| {
            let wanted = lengths[steps] * k as f64 / count as f64;
            let i = lengths.partition_point(|&l| l < wanted).clamp(1, steps);
            let share = (wanted - lengths[i - 1]) / (lengths[i] - lengths[i - 1]);
            let u = PI - (i as f64 - 1.0 + share) * h;
            let size = speed(u);
            let (normal, at) = ([rise * u.cos() / size, u.sin() / size], [u.cos(), rise * u.sin()]);
            ([-0.5, 0.5].map(|s| [at[0] + s * thickness * normal[0], at[1] + s * thickness * normal[1]])).into()
        };
        Ring::straight((0..=count).map(joint).collect())
    }

    /// Two arcs of mean radius 1 with centres at +-`centre` from the axis: radial joints at equal angles from the springing
    /// to the apex of the intrados, and a vertical joint at the crown.
    pub fn pointed(centre: f64, thickness: f64, per_half: usize) -> Ring {
        let (inner, outer) = (1.0 - thickness / 2.0, 1.0 + thickness / 2.0);
        let crown = (-centre / inner).acos();
        let left = |k: usize| {
            let angle = PI - (PI - crown) * k as f64 / per_half as f64;
            [inner, outer].map(|r| [centre + r * angle.cos(), r * angle.sin()])
        };
        let mut half: Vec<[Point; 2]> = (0..per_half).map(left).collect();
        let top = [inner, outer].map(|r: f64| [0.0, (r * r - centre * centre).sqrt()]);
        let right: Vec<[Point; 2]> = half.iter().rev().map(|j| j.map(|p| [-p[0], p[1]])).collect();
        half.push(top);
        half.extend(right);
        Ring::straight(half.into_iter().map(|j| (j[0], j[1])).collect())
    }

    /// The buried arch of `paper_case1.json` with `joints` joints.
    pub fn paper_case_1(joints: usize) -> Ring {
        let (inner, crown, springing) = (4.3, 0.35, 1.01);
        let (top, foot) = (inner + crown, inner + springing);
        let drop = (foot * foot - top * top) / (2.0 * top);
        let outer = top + drop;
        let joint = |k: usize| {
            let angle = PI * (1.0 - k as f64 / (joints - 1) as f64);
            let sine = angle.sin();
            // On the ray at distance s from (0, 0): s^2 + 2 s drop sin + drop^2 = outer^2.
            let s = -drop * sine + (outer * outer - drop * drop * (1.0 - sine * sine)).sqrt();
            (polar(inner, angle), polar(s, angle))
        };
        Ring::straight((0..joints).map(joint).collect())
    }

    /// The same ring, `factor` times as large.
    pub fn times(&self, factor: f64) -> Ring {
        let grow = |p: Point| p.map(|c| c * factor);
        Ring {
            joints: self.joints.iter().map(|j| (grow(j.0), grow(j.1))).collect(),
            stones: self.stones.iter().map(|s| (s.0 * factor * factor, grow(s.1))).collect(),
        }
    }

    /// The unloaded arch with cohesionless joints.
    pub fn problem(&self, friction: f64) -> Problem {
        let bond = Bond::Dry { friction, cohesion: 0.0 };
        let seams = self.joints.iter().map(|&(intrados, extrados)| Seam { intrados, extrados, bond }).collect();
        Problem { seams, ..Problem::default() }
    }

    /// Weight of every stone, turned to act along `direction`.
    pub fn body(&self, unit_weight: f64, direction: Point) -> Vec<Push> {
        let push = |(block, &(area, at)): (usize, &(f64, Point))| {
            let force = direction.map(|d| d * area * unit_weight);
            Push { block, at, force }
        };
        self.stones.iter().enumerate().map(push).collect()
    }

    /// Self weight.
    pub fn weight(&self, unit_weight: f64) -> Vec<Push> {
        self.body(unit_weight, [0.0, -1.0])
    }

    /// Unit vertical force at the middle of one stone's extrados.
    pub fn point_load(&self, block: usize) -> Vec<Push> {
        let (a, b) = (self.joints[block].1, self.joints[block + 1].1);
        vec![Push { block, at: [0, 1].map(|i| (a[i] + b[i]) / 2.0), force: [0.0, -1.0] }]
    }

    /// Vertical line pressure `per_metre` over the plan from `from` to `to`: each stone takes the share over it.
    pub fn patch(&self, from: f64, to: f64, per_metre: f64) -> Vec<Push> {
        let mut pushes = Vec::new();
        for (block, j) in self.joints.windows(2).enumerate() {
            let (a, b) = (j[0].1, j[1].1);
            let (low, high) = (from.max(a[0]), to.min(b[0]));
            if high > low {
                let x = (low + high) / 2.0;
                let y = a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]);
                pushes.push(Push { block, at: [x, y], force: [0.0, -per_metre * (high - low)] });
            }
        }
        pushes
    }

    /// Fill up to `height`: q_v = unit_weight (height - y) on plan, q_h = k q_v inwards on elevation.
    pub fn fill(&self, height: f64, unit_weight: f64, k: f64) -> Vec<Push> {
        let mut pushes = Vec::new();
        for (block, j) in self.joints.windows(2).enumerate() {
            let (a, b) = (j[0].1, j[1].1);
            let (p, q) = (unit_weight * (height - a[1]), unit_weight * (height - b[1]));
            let share = if p + q == 0.0 { 0.5 } else { (p + 2.0 * q) / (3.0 * (p + q)) };
            let at = [0, 1].map(|i| a[i] + share * (b[i] - a[i]));
            let mean = (p + q) / 2.0;
            pushes.push(Push { block, at, force: [k * mean * (b[1] - a[1]), -mean * (b[0] - a[0])] });
        }
        pushes
    }

    /// Total area.
    pub fn area(&self) -> f64 {
        self.stones.iter().map(|s| s.0).sum()
    }
}
