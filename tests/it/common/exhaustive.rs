//! The least load at which a small arch may fall without dilation, by trying every mechanism: the oracle of `LoadRange::least`.
//!
//! A chain held at both ends moves where relative motions at its joints add up to none: four releases of any kind (a hinge at
//! either face, a slide either way), or three whose motions are dependent (slides alone; a slide along the line across two
//! hinges). Where four releases move, four forces are at their limits, which fixes the three redundants and the load factor;
//! three leave one unknown open, and its interval is intersected with all conditions. Two parallel slides are left out. Plain numbers and elimination; nothing of `src/` and no linear programme.

use super::oracle::{Bond, Point, Problem, Push};

/// Joint forces (N intrados, N extrados, T) as rows over (Fx, Fy, M about the origin, load factor; 1).
type Forces = [[f64; 5]; 3];

/// A release: the motion (u, v at the origin, spin) of all after the joint, and the row that vanishes where it moves.
struct Release {
    motion: [f64; 3],
    row: [f64; 5],
    /// Power of the scaled loads at unit rate.
    power: f64,
}

/// The arch in units in which forces, lengths and load factors are of order one.
struct Chain {
    releases: Vec<Release>,
    /// Rows that must not be negative.
    conditions: Vec<[f64; 5]>,
    factor: f64,
}

/// Forces may violate a condition by this share of the loads.
const TOLERANCE: f64 = 1e-9;
/// Rates and pivots below this are none.
const NONE: f64 = 1e-10;

/// The least load factor from `start` on, in the direction of `sign`, at which some mechanism without dilation is in
/// equilibrium; infinite where there is none. All joints have to be dry and without cohesion.
pub fn least(problem: &Problem, start: f64, sign: f64) -> f64 {
    let chain = Chain::new(problem);
    let mut least = f64::INFINITY;
    let start = start / chain.factor;
    chain.mechanisms(sign, &mut |moving| {
        for point in chain.solutions(moving) {
            let factor = sign * (point[3] - start);
            if factor > -TOLERANCE && factor < least && chain.is_admissible(&point) {
                least = factor;
            }
        }
    });
    (start + sign * least) * chain.factor
}

impl Chain {
    fn new(problem: &Problem) -> Chain {
        let size = |pushes: &[Push]| pushes.iter().map(|p| p.force[0].hypot(p.force[1])).sum::<f64>();
        let force = if size(&problem.fixed) > 0.0 { size(&problem.fixed) } else { size(&problem.scaled) };
        let factor = force / size(&problem.scaled);
        let length =
            problem.seams.iter().flat_map(|s| [s.intrados, s.extrados]).map(|p| p[0].hypot(p[1])).fold(0.0, f64::max);
        let unit = |p: Point| p.map(|x| x / length);
        let (mut releases, mut conditions) = (Vec::new(), Vec::new());
        for (k, seam) in problem.seams.iter().enumerate() {
            let Bond::Dry { friction, cohesion: 0.0 } = seam.bond else { panic!("dry joints only") };
            let (intrados, extrados) = (unit(seam.intrados), unit(seam.extrados));
            // Loads on all stones before the joint, and on all after it.
            let sum = |pushes: &[Push], before: bool, by: f64| {
                let chosen = pushes.iter().filter(|p| (p.block < k) == before);
                chosen.fold([0.0; 3], |sum, p| {
                    let ([fx, fy], at) = (p.force.map(|f| f * by / force), unit(p.at));
                    [sum[0] + fx, sum[1] + fy, sum[2] + at[0] * fy - at[1] * fx]
                })
            };
            let (fixed, scaled) = (sum(&problem.fixed, true, 1.0), sum(&problem.scaled, true, factor));
            let tail = sum(&problem.scaled, false, factor);
            let [inner, outer, shear] = forces(intrados, extrados, fixed, scaled);
            let bound = |s: f64| std::array::from_fn(|i| friction * (inner[i] + outer[i]) + s * shear[i]);
            conditions.extend([inner, outer, bound(1.0), bound(-1.0)]);
            let along = [0, 1].map(|i| (extrados[i] - intrados[i]) / distance(intrados, extrados));
            let about = |c: Point, spin: f64| [spin * c[1], -spin * c[0], spin];
            let mut add = |motion: [f64; 3], row: [f64; 5]| {
                let power = (0..3).map(|i| motion[i] * tail[i]).sum();
                releases.push(Release { motion, row, power });
            };
            add(about(intrados, -1.0), outer);
            add(about(extrados, 1.0), inner);
            for s in [1.0, -1.0] {
                add([s * along[0], s * along[1], 0.0], bound(s));
            }
        }
        Chain { releases, conditions, factor }
    }

    /// Calls `see` for every set of releases that moves, its scaled loads doing work of this sign.
    fn mechanisms(&self, sign: f64, see: &mut dyn FnMut(&[usize])) {
        let n = self.releases.len();
        let motion = |i: usize| self.releases[i].motion;
        let drives = |set: &[usize], rates: &[f64]| {
            let power: f64 = set.iter().zip(rates).map(|(&i, rate)| rate * self.releases[i].power).sum();
            sign * power > NONE
        };
        for i in 0..n {
            for j in i + 1..n {
                for k in j + 1..n {
                    let ijk = det(motion(i), motion(j), motion(k));
                    if ijk.abs() < NONE {
                        see_if_moving(&[i, j, k], null_vector([motion(i), motion(j), motion(k)]), &drives, see);
                    }
                    for l in k + 1..n {
                        let (jkl, ikl) = (det(motion(j), motion(k), motion(l)), det(motion(i), motion(k), motion(l)));
                        let ijl = det(motion(i), motion(j), motion(l));
                        see_if_moving(&[i, j, k, l], [jkl, -ikl, ijl, -ijk], &drives, see);
                    }
                }
            }
        }
    }

    /// The point at which the releases are at their limits, or the ends of the line of such points within all conditions.
    fn solutions(&self, moving: &[usize]) -> Vec<[f64; 4]> {
        let rows: Vec<[f64; 5]> = moving.iter().map(|&i| self.releases[i].row).collect();
        if moving.len() == 4 {
            return solve(&rows).into_iter().collect();
        }
        // With one unknown held at 0 and at 1 the line is known by two of its points.
        let held = |unknown: usize, at: f64| {
            let mut row = [0.0; 5];
            (row[unknown], row[4]) = (1.0, -at);
            solve(&[rows[0], rows[1], rows[2], row])
        };
        let line = (0..4).find_map(|unknown| held(unknown, 0.0).zip(held(unknown, 1.0)));
        let Some((from, to)) = line else { return Vec::new() };
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        for row in &self.conditions {
            let (value, change) = (value(row, &from), value(row, &to) - value(row, &from));
            if change > NONE {
                low = low.max(-(value + TOLERANCE) / change);
            } else if change < -NONE {
                high = high.min((value + TOLERANCE) / -change);
            } else if value < -TOLERANCE {
                return Vec::new();
            }
        }
        let at = |share: f64| std::array::from_fn(|i| from[i] + share * (to[i] - from[i]));
        if low > high { Vec::new() } else { [low, high].into_iter().filter(|s| s.is_finite()).map(at).collect() }
    }

    fn is_admissible(&self, point: &[f64; 4]) -> bool {
        self.conditions.iter().all(|row| value(row, point) >= -3.0 * TOLERANCE)
    }
}

/// Calls `see` for a set whose rates all have one sign.
fn see_if_moving<const N: usize>(
    set: &[usize; N],
    rates: [f64; N],
    drives: &dyn Fn(&[usize], &[f64]) -> bool,
    see: &mut dyn FnMut(&[usize]),
) {
    let sign = rates[0].signum();
    let largest = rates.iter().fold(0.0f64, |most, rate| most.max(rate.abs()));
    let rates = rates.map(|rate| rate * sign);
    if largest > NONE && rates.iter().all(|&rate| rate > 1e-7 * largest) && drives(set, &rates) {
        see(set);
    }
}

/// Rows of the joint's forces: the first joint pushes the chain with (Fx, Fy, M), loads before this joint add to that.
fn forces(intrados: Point, extrados: Point, fixed: [f64; 3], scaled: [f64; 3]) -> Forces {
    let length = distance(intrados, extrados);
    let along = [0, 1].map(|i| (extrados[i] - intrados[i]) / length);
    let row = |of: [f64; 3]| {
        let dot = |v: [f64; 3]| of[0] * v[0] + of[1] * v[1] + of[2] * v[2];
        [of[0], of[1], of[2], dot(scaled), dot(fixed)]
    };
    // The moment about the extrados end is that of the force at the intrados end, and the other way round.
    let moment_about = |p: Point, by: f64| [p[1] * by, -p[0] * by, by];
    [
        row(moment_about(extrados, 1.0 / length)),
        row(moment_about(intrados, -1.0 / length)),
        row([along[0], along[1], 0.0]),
    ]
}

/// Rates of three dependent motions that add up to none: the largest of the cross products of the matrix's rows.
fn null_vector([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let row = |i: usize| [a[i], b[i], c[i]];
    let cross =
        |p: [f64; 3], q: [f64; 3]| [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
    let products = [cross(row(0), row(1)), cross(row(1), row(2)), cross(row(2), row(0))];
    let size = |v: &[f64; 3]| v.iter().map(|x| x * x).sum::<f64>();
    products.into_iter().max_by(|v, w| size(v).total_cmp(&size(w))).unwrap()
}

fn value(row: &[f64; 5], point: &[f64; 4]) -> f64 {
    (0..4).map(|i| row[i] * point[i]).sum::<f64>() + row[4]
}

fn det(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// The point at which four rows vanish, by Gauss' elimination with full scaling of the rows and column pivots.
fn solve(rows: &[[f64; 5]]) -> Option<[f64; 4]> {
    let mut a: Vec<[f64; 5]> = rows
        .iter()
        .map(|row| {
            let norm = row[..4].iter().map(|x| x * x).sum::<f64>().sqrt();
            row.map(|x| x / norm)
        })
        .collect();
    for column in 0..4 {
        let pivot = (column..4).max_by(|&i, &j| a[i][column].abs().total_cmp(&a[j][column].abs()))?;
        if a[pivot][column].abs() <= NONE {
            return None;
        }
        a.swap(column, pivot);
        let pivot = a[column];
        for (_, row) in a.iter_mut().enumerate().filter(|(i, _)| *i != column) {
            let by = row[column] / pivot[column];
            row.iter_mut().zip(pivot).for_each(|(entry, above)| *entry -= by * above);
        }
    }
    Some(std::array::from_fn(|i| -a[i][4] / a[i][i]))
}

fn distance(a: Point, b: Point) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
