//! Openings: the points at which nothing presses.

use super::{Linear, Loaded, Three, dot, value};
use crate::dda::contact::Law;
use crate::dda::force_method::is_smooth;

/// Most points that come and go until none pulls.
const STEPS: usize = 60;
/// A tension that is less than this share of the largest normal force is rounding.
const ROUNDING: f64 = 1e-13;
/// A point whose normal force does not change by this share as it is pushed apart is held by the others.
const HELD: f64 = 1e-12;
/// A pivot below this, of rows whose largest entry is 1, is nought.
const SINGULAR: f64 = 1e-14;
/// Most equations: three redundants, three openings and a smooth interface.
const MOST: usize = 7;

/// A point that is open.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Opening {
    pub interface: usize,
    pub point: usize,
    /// Its gap, m.
    pub gap: f64,
}

/// The gaps of points that are open, those first.
pub(super) type Gaps = [f64; MOST];
/// A small system, its right-hand side behind every row.
type System = [[f64; MOST + 1]; MOST];

impl Loaded<'_> {
    /// The redundants at which no point pulls: those in `open` do not press and have their gaps. None where there are none.
    ///
    /// A point that pulls is pushed apart until it does not; one that closes meanwhile is let go (Goldfarb and Idnani 1983).
    pub(super) fn find_openings(
        &self,
        gradient: &[Linear; 3],
        load_factor: f64,
        open: &mut Vec<Opening>,
    ) -> Option<Three> {
        let mut redundants = self.with_gaps(gradient, load_factor, open)?;
        for _ in 0..STEPS {
            let Some(pulls) = self.most_pulling(&redundants, load_factor, open) else { return Some(redundants) };
            self.push_apart(gradient, load_factor, pulls, open, &mut redundants)?;
        }
        None
    }

    /// The redundants with which points in `open` do not press; those that would overlap are let go.
    fn with_gaps(&self, gradient: &[Linear; 3], load_factor: f64, open: &mut Vec<Opening>) -> Option<Three> {
        loop {
            let (redundants, gaps) = self.balanced(gradient, load_factor, open)?;
            open.iter_mut().zip(gaps).for_each(|(opening, gap)| opening.gap = gap);
            let worst = (0..open.len()).min_by(|&a, &b| open[a].gap.total_cmp(&open[b].gap));
            match worst.filter(|&worst| open[worst].gap < 0.0) {
                Some(worst) => open.remove(worst),
                None => return Some(redundants),
            };
        }
    }

    /// Pushes a point that pulls apart until it does not.
    fn push_apart(
        &self,
        gradient: &[Linear; 3],
        load_factor: f64,
        mut pulls: Opening,
        open: &mut Vec<Opening>,
        redundants: &mut Three,
    ) -> Option<()> {
        let normal = self.normal(&pulls);
        let row = [normal[0], normal[1], normal[2]];
        loop {
            let (along, gaps) = self.bordered(gradient, row, [0.0; 2], open)?;
            let (tension, relief) = (value(&normal, redundants, load_factor), dot(&row, &along));
            let held = relief <= HELD * (dot(&row, &row) * dot(&along, &along)).sqrt();
            let opens = if held { f64::INFINITY } else { -tension / relief };
            let closes = (0..open.len()).filter(|&j| gaps[j] < 0.0).map(|j| (open[j].gap / -gaps[j], j));
            let closes = closes.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|(closes, _)| *closes < opens);
            let step = closes.map_or(opens, |(closes, _)| closes);
            if !step.is_finite() {
                return None;
            }
            (0..3).for_each(|a| redundants[a] += step * along[a]);
            open.iter_mut().zip(gaps).for_each(|(opening, gap)| opening.gap += step * gap);
            pulls.gap += step;
            match closes {
                Some((_, j)) => open.remove(j),
                None => break,
            };
        }
        open.push(pulls);
        Some(())
    }

    /// The redundants with which points in `open` do not press, and the gaps of these.
    pub(super) fn balanced(&self, gradient: &[Linear; 3], load_factor: f64, open: &[Opening]) -> Option<(Three, Gaps)> {
        let right = gradient.each_ref().map(|row| -row[3] - row[4] * load_factor);
        self.bordered(gradient, right, [1.0, load_factor], open)
    }

    /// Change of redundants and gaps with the load factor, all points staying as they are.
    pub(super) fn rates(&self, gradient: &[Linear; 3], open: &[Opening]) -> Option<(Three, Gaps)> {
        let right = gradient.each_ref().map(|row| -row[4]);
        self.bordered(gradient, right, [0.0, 1.0], open)
    }

    /// Whether the chain can take on load with these points open.
    pub(super) fn holds(&self, open: &[Opening]) -> bool {
        open.len() + usize::from(self.smooth().is_some()) <= 3
    }

    /// How gaps go on where one point more is open than the chain holds with, that of the last by 1; none where that is no motion of them all.
    pub(super) fn mechanism(&self, open: &[Opening]) -> Option<Vec<f64>> {
        let (last, others) = open.split_last()?;
        let columns: Vec<Linear> = others.iter().map(|opening| self.normal(opening)).chain(self.smooth()).collect();
        if columns.len() != 3 {
            return None;
        }
        let (mut system, right): (System, _) = ([[0.0; MOST + 1]; MOST], self.normal(last));
        for a in 0..3 {
            columns.iter().enumerate().for_each(|(c, column)| system[a][c] = column[a]);
            system[a][MOST] = -right[a];
        }
        let gaps = solve(&mut system, 3)?;
        Some(gaps[..others.len()].iter().copied().chain([1.0]).collect())
    }

    /// The shear through the last interface, where it is smooth.
    fn smooth(&self) -> Option<Linear> {
        let last = self.method.statics.len() - 1;
        is_smooth(&self.contacts[2 * last]).then(|| self.linear(last, &self.method.statics[last].shear))
    }

    /// Normal force of a point.
    fn normal(&self, opening: &Opening) -> Linear {
        self.linear(opening.interface, &self.method.statics[opening.interface].normals[opening.point])
    }

    /// The point that pulls most.
    fn most_pulling(&self, redundants: &Three, load_factor: f64, open: &[Opening]) -> Option<Opening> {
        let (mut most, mut least, mut largest) = (None, 0.0, 0.0f64);
        for (k, statics) in self.method.statics.iter().enumerate() {
            let resultant = self.resultant(k, redundants, load_factor);
            for point in 0..2 {
                let normal = dot(&statics.normals[point], &resultant);
                largest = largest.max(normal.abs());
                if normal < least && self.contacts[2 * k + point].law != Law::Bonded {
                    let is_open = |o: &Opening| o.interface == k && o.point == point;
                    if !open.iter().any(is_open) {
                        (least, most) = (normal, Some(Opening { interface: k, point, gap: 0.0 }));
                    }
                }
            }
        }
        most.filter(|_| least < -ROUNDING * largest)
    }

    /// The redundants x and gaps g with `gradient` x - sum of g normals = `right`, and normal forces of none at points in `open` where
    /// so many times the loads act; nor shear through an interface that is smooth.
    fn bordered(
        &self,
        gradient: &[Linear; 3],
        right: Three,
        loads: [f64; 2],
        open: &[Opening],
    ) -> Option<(Three, Gaps)> {
        let borders = open.iter().map(|opening| self.normal(opening)).chain(self.smooth());
        let mut system: System = [[0.0; MOST + 1]; MOST];
        let mut n = 3;
        for border in borders {
            if n == MOST {
                return None;
            }
            for a in 0..3 {
                system[a][n] = -border[a];
                system[n][a] = border[a];
            }
            system[n][MOST] = -border[3] * loads[0] - border[4] * loads[1];
            n += 1;
        }
        for a in 0..3 {
            system[a][..3].copy_from_slice(&gradient[a][..3]);
            system[a][MOST] = right[a];
        }
        let x = solve(&mut system, n)?;
        let mut gaps = [0.0; MOST];
        gaps[..n - 3].copy_from_slice(&x[3..n]);
        Some(([x[0], x[1], x[2]], gaps))
    }
}

/// Solves the first `n` equations of a small system; none where it is singular.
fn solve(system: &mut System, n: usize) -> Option<[f64; MOST]> {
    for row in &mut system[..n] {
        let scale = row[..n].iter().fold(0.0f64, |most, x| most.max(x.abs()));
        row.iter_mut().for_each(|x| *x /= scale);
    }
    for k in 0..n {
        let pivot = (k..n).max_by(|&a, &b| system[a][k].abs().total_cmp(&system[b][k].abs()))?;
        system.swap(k, pivot);
        let above = system[k];
        if above[k].abs() < SINGULAR || !above[k].is_finite() {
            return None;
        }
        for row in &mut system[k + 1..n] {
            let factor = row[k] / above[k];
            row.iter_mut().zip(above).for_each(|(x, above)| *x -= factor * above);
        }
    }
    let mut x = [0.0; MOST];
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|c| system[k][c] * x[c]).sum();
        x[k] = (system[k][MOST] - known) / system[k][k];
    }
    Some(x)
}
