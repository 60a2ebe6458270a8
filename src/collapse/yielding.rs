//! First yield: where on the path the equivalent stress of some subblock reaches the strength of its stone.

use super::discretise::Model;
use super::record::PathPoint;
use super::report::tresca;
use super::{ElasticCrushing, SubblockStress};
use std::rc::Rc;

/// A subblock at a point of the path.
#[derive(Debug, Clone)]
struct YieldPoint {
    at: Rc<PathPoint>,
    voussoir: usize,
    subblock: usize,
}

/// What was found up to some point of the path.
#[derive(Debug, Clone, Default)]
struct SoFar {
    /// The first yield.
    first: Option<YieldPoint>,
    /// True where that was at the start.
    at_start: bool,
    /// The largest equivalent stress over its strength.
    largest: Option<(f64, YieldPoint)>,
}

/// Looks at the stress in every subblock along a path.
///
/// Between two points of the path stresses are linear, and the equivalent stress of Tresca is a convex function of them;
/// so it is largest at one of the two, and passes the strength at most once on the way up.
pub(super) struct Yielding<'a> {
    model: &'a Model<'a>,
    /// Strength of every body, Pa.
    strengths: Vec<f64>,
    /// Stress of every subblock at the last point, three numbers each, voussoir by voussoir; and at this one.
    before: Vec<Vec<f64>>,
    now: Vec<Vec<f64>>,
    seen: SoFar,
    /// What had been seen at the highest load: what comes after the peak does not count.
    answer: SoFar,
}

impl<'a> Yielding<'a> {
    pub(super) fn new(model: &'a Model<'a>, strengths: Vec<f64>) -> Self {
        let empty = vec![Vec::new(); model.bodies];
        let (seen, answer) = (SoFar::default(), SoFar::default());
        Yielding { model, strengths, before: empty.clone(), now: empty, seen, answer }
    }

    /// Takes in the next point of the path; `highest`: no point before had a higher load.
    pub(super) fn see(&mut self, before: Option<&Rc<PathPoint>>, now: &Rc<PathPoint>, highest: bool) {
        if self.seen.first.is_none() {
            self.look(before, now);
        }
        if highest {
            self.answer = self.seen.clone();
        }
    }

    /// What was found up to the highest load.
    pub(super) fn answer(&self) -> ElasticCrushing {
        let SoFar { first, at_start, largest } = &self.answer;
        let found = first.as_ref().or(largest.as_ref().map(|(_, found)| found));
        ElasticCrushing {
            load_factor: first.as_ref().map(|f| f.at.0),
            at_start: *at_start,
            where_largest: found.and_then(|f| self.subblock(f)),
        }
    }

    /// Where on the way to the highest load the stone first yields.
    pub(super) fn yields_at(&self) -> Option<&PathPoint> {
        self.answer.first.as_ref().map(|found| found.at.as_ref())
    }

    fn look(&mut self, before: Option<&Rc<PathPoint>>, now: &Rc<PathPoint>) {
        std::mem::swap(&mut self.before, &mut self.now);
        let (model, loads) = (self.model, self.model.loads_at(now.0));
        // Share of the way from the last point, or the stress, with voussoir and subblock.
        let (mut crossing, mut largest) = ((f64::INFINITY, 0, 0), (f64::NEG_INFINITY, 0, 0));
        for voussoir in 0..model.bodies {
            // The path is stopped at the end of this event.
            if model.budget.work(model.work_of_stresses(voussoir)).is_err() {
                return;
            }
            let (here, strength) = (&mut self.now[voussoir], self.strengths[voussoir]);
            model.assembly.stresses_in_frame(voussoir, &now.1, &loads, here);
            for (subblock, stress) in here.chunks_exact(3).enumerate() {
                let equivalent = tresca([stress[0], stress[1], stress[2]]);
                if equivalent / strength > largest.0 {
                    largest = (equivalent / strength, voussoir, subblock);
                }
                if equivalent >= strength {
                    let start = self.before[voussoir].get(3 * subblock..3 * subblock + 3);
                    let share = start.map_or(0.0, |start| reaches(start, stress, strength));
                    crossing = if share < crossing.0 { (share, voussoir, subblock) } else { crossing };
                }
            }
        }
        let (most, voussoir, subblock) = largest;
        if self.seen.largest.as_ref().is_none_or(|(before, _)| most > *before) {
            self.seen.largest = Some((most, YieldPoint { at: Rc::clone(now), voussoir, subblock }));
        }
        let (share, voussoir, subblock) = crossing;
        if share.is_finite() {
            let at = before.map_or_else(|| Rc::clone(now), |before| Rc::new(between(before, now, share)));
            self.seen.at_start = before.is_none();
            self.seen.first = Some(YieldPoint { at, voussoir, subblock });
        }
    }

    fn subblock(&self, found: &YieldPoint) -> Option<SubblockStress> {
        let (load_factor, displacements) = &*found.at;
        let stresses = self.model.stresses(found.voussoir, *load_factor, displacements);
        let corners = self.model.told(found.voussoir, *load_factor, displacements).corners;
        self.model.grids[found.voussoir].field(found.voussoir, &stresses, corners).into_iter().nth(found.subblock)
    }
}

fn between(a: &PathPoint, b: &PathPoint, share: f64) -> PathPoint {
    let displacements = a.1.iter().zip(&b.1).map(|(x, y)| x + (y - x) * share).collect();
    (a.0 + (b.0 - a.0) * share, displacements)
}

/// Share of the way from stress `a`, below the strength, to `b`, at or above it, at which the equivalent stress equals
/// the strength f.
///
/// |s_1 - s_2| = f is a quadratic in the share: (s_x - s_y)^2 + 4 tau^2 = f^2. |s| = f for a principal stress makes the
/// determinant (s_x -+ f)(s_y -+ f) - tau^2 vanish.
fn reaches(a: &[f64], b: &[f64], strength: f64) -> f64 {
    let line = |i: usize, shift: f64| [a[i] + shift, b[i] - a[i]];
    let (x, y, tau) = (line(0, 0.0), line(1, 0.0), line(2, 0.0));
    let difference = [x[0] - y[0], x[1] - y[1]];
    let shear = [2.0 * tau[0], 2.0 * tau[1]];
    let mut quadratics = vec![sum(
        product(difference, difference),
        sum(product(shear, shear), [-strength * strength, 0.0, 0.0], 1.0),
        1.0,
    )];
    for shift in [-strength, strength] {
        quadratics.push(sum(product(line(0, shift), line(1, shift)), product(tau, tau), -1.0));
    }
    quadratics.into_iter().filter_map(first_root).fold(1.0, f64::min)
}

/// Product of two linear functions p0 + p1 t as the coefficients of 1, t and t^2.
fn product(p: [f64; 2], q: [f64; 2]) -> [f64; 3] {
    [p[0] * q[0], p[0] * q[1] + p[1] * q[0], p[1] * q[1]]
}

fn sum(p: [f64; 3], q: [f64; 3], factor: f64) -> [f64; 3] {
    [0, 1, 2].map(|i| p[i] + factor * q[i])
}

/// Least root in [0, 1] of c + b t + a t^2.
fn first_root([c, b, a]: [f64; 3]) -> Option<f64> {
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return None;
    }
    // The form without cancellation.
    let q = -0.5 * (b + discriminant.sqrt().copysign(b));
    [q / a, c / q].into_iter().filter(|t| (0.0..=1.0).contains(t)).min_by(f64::total_cmp)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(a: [f64; 3], b: [f64; 3], share: f64) -> [f64; 3] {
        [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * share)
    }

    #[test]
    fn the_equivalent_stress_is_that_of_equation_4() {
        assert_eq!(tresca([-3.0, -1.0, 0.0]), 3.0);
        assert_eq!(tresca([-3.0, 1.0, 0.0]), 4.0);
        assert_eq!(tresca([0.0, 0.0, 2.0]), 4.0);
        assert_eq!(tresca([5.0, 2.0, 0.0]), 5.0);
    }

    #[test]
    fn it_reaches_the_strength_where_the_root_says() {
        let ways = [
            ([0.1, -0.2, 0.3], [-4.0, -1.0, 0.5]),
            ([0.0, 0.0, 0.0], [1.0, -2.0, 3.0]),
            ([-0.5, 0.5, -0.2], [6.0, 5.0, 1.0]),
            ([-1.5, -1.5, 0.0], [-1.5, -9.0, 0.0]),
            ([0.0, 0.0, 0.0], [0.0, 0.0, -8.0]),
        ];
        for (a, b) in ways {
            let share = reaches(&a, &b, 2.0);
            assert!((tresca(at(a, b, share)) - 2.0).abs() < 1e-12, "{a:?} {b:?}: {share}");
            // Nowhere before.
            assert!((0..1000).all(|i| tresca(at(a, b, share * f64::from(i) / 1000.0)) < 2.0));
        }
    }
}
