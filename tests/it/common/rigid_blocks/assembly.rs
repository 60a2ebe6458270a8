//! The coefficients of equilibrium.

use super::{Point, Problem, Push, area_and_centroid, total};

/// Equilibrium of all blocks, rows 3 b to 3 b + 2 for block b: forces along x and y, moment about its centroid over its size.
pub struct Equilibrium {
    /// Columns as (row, coefficient): three a contact, for its two normal forces and its shear force.
    pub columns: Vec<[Vec<(usize, f64)>; 3]>,
    /// Fixed and scaled loads, rows added up, in units of `force`; the scaled ones in units of `factor` too.
    pub fixed: Vec<f64>,
    pub scaled: Vec<f64>,
    /// Units in which the numbers are of order one.
    pub force: f64,
    pub factor: f64,
}

impl Equilibrium {
    pub fn of(problem: &Problem) -> Equilibrium {
        let (fixed, scaled) = (total(&problem.fixed), total(&problem.scaled));
        let force = if fixed > 0.0 { fixed } else { scaled.max(f64::MIN_POSITIVE) };
        let factor = if scaled > 0.0 { force / scaled } else { 1.0 };
        let centres: Vec<(Point, f64)> = problem.blocks.iter().map(|corners| centre_and_size(corners)).collect();
        let wrench = |block: usize, at: Point, force: Point| {
            let (centre, size) = centres[block];
            let moment = (at[0] - centre[0]) * force[1] - (at[1] - centre[1]) * force[0];
            [force[0], force[1], moment / size]
        };
        let columns = problem.contacts.iter().map(|contact| {
            let (normal, along) = contact.unit_vectors();
            let [a, b] = contact.ends;
            [(a, normal), (b, normal), (a, along)].map(|(at, direction)| {
                let mut column = Vec::new();
                for (block, sign) in [(contact.between[0], -1.0), (contact.between[1], 1.0)] {
                    let Some(block) = block else { continue };
                    let rows = wrench(block, at, direction).into_iter().enumerate();
                    column.extend(rows.map(|(k, value)| (3 * block + k, sign * value)));
                }
                column
            })
        });
        let sum = |pushes: &[Push], unit: f64| {
            let mut rows = vec![0.0; 3 * problem.blocks.len()];
            for push in pushes {
                let wrench = wrench(push.block, push.at, push.force);
                (0..3).for_each(|k| rows[3 * push.block + k] += wrench[k] / unit);
            }
            rows
        };
        let columns = columns.collect();
        Equilibrium {
            columns,
            fixed: sum(&problem.fixed, force),
            scaled: sum(&problem.scaled, force / factor),
            force,
            factor,
        }
    }
}

fn centre_and_size(corners: &[Point]) -> (Point, f64) {
    let (_, centre) = area_and_centroid(corners);
    let size = corners.iter().map(|c| (c[0] - centre[0]).hypot(c[1] - centre[1])).fold(0.0, f64::max);
    (centre, size)
}
