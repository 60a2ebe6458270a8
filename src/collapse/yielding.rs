//! First yield: where on the path the equivalent stress of some subblock reaches the strength of its stone.

mod below;

use super::discretise::Model;
use super::record::PathPoint;
use super::report::tresca;
use super::{ElasticCrushing, SubblockStress};
use crate::budget::Stopped;
use below::Below;
use std::rc::Rc;

/// Equivalent stress that is less than this share of another is less, however both are rounded.
const ROUNDED: f64 = 1.0 - 1e-12;

/// Where the stone first yields.
#[derive(Debug, Clone)]
struct YieldPoint {
    at: Rc<PathPoint>,
    voussoir: usize,
    subblock: usize,
}

/// The largest equivalent stress over its strength, its subblock, and what is needed of the point of the path to know its stress.
#[derive(Debug, Clone)]
struct Largest {
    share: f64,
    load_factor: f64,
    voussoir: usize,
    subblock: usize,
    /// Displacements of the body's nodes.
    nodes: Vec<f64>,
}

/// What was found up to some point of the path.
#[derive(Debug, Clone, Default)]
struct SoFar {
    /// The first yield.
    first: Option<YieldPoint>,
    /// True where that was at the start.
    at_start: bool,
    largest: Option<Largest>,
}

/// What was found at one point of the path: the largest share of a strength, and where on the way from the point before a strength is
/// first reached (infinite: nowhere), each with its voussoir and subblock.
struct Found {
    largest: (f64, usize, usize),
    crossing: (f64, usize, usize),
}

/// Looks at the stress in every subblock along a path.
///
/// Between two points of the path stresses are linear, and the equivalent stress of Tresca is a convex function of them;
/// so it is largest at one of the two, and passes the strength at most once on the way up.
pub(super) struct Yielding<'a> {
    model: &'a Model<'a>,
    /// Strength of every body that is told of, Pa, and the work of finding its stress.
    bodies: Vec<(f64, usize)>,
    /// What of bodies need not be looked at.
    below: Below,
    /// Stress of every subblock of a body, three numbers each: here, and at the point before.
    here: Vec<f64>,
    before: Vec<f64>,
    seen: SoFar,
    /// What had been seen at the highest load, where it is not what is seen: what comes after the peak does not count.
    answer: Option<SoFar>,
}

impl<'a> Yielding<'a> {
    pub(super) fn new(model: &'a Model<'a>, strengths: Vec<f64>) -> Self {
        let bodies = (0..model.bodies).map(|body| (strengths[body], model.work_of_stresses(body))).collect();
        let (here, before) = (Vec::new(), Vec::new());
        Yielding { model, bodies, below: Below::default(), here, before, seen: SoFar::default(), answer: None }
    }

    /// Takes in the next point of the path; `highest`: no point before had a higher load.
    pub(super) fn see(&mut self, before: Option<&Rc<PathPoint>>, now: &Rc<PathPoint>, highest: bool) {
        if highest {
            self.answer = None;
        } else if self.answer.is_none() {
            self.answer = Some(self.seen.clone());
        }
        if self.seen.first.is_none() {
            self.look(before, now);
        }
    }

    /// What was found up to the highest load.
    fn found(&self) -> &SoFar {
        self.answer.as_ref().unwrap_or(&self.seen)
    }

    /// What was found up to the highest load.
    pub(super) fn answer(&self) -> ElasticCrushing {
        let SoFar { first, at_start, largest } = self.found();
        let of_first = |f: &YieldPoint| self.subblock(f.voussoir, f.subblock, f.at.0, &f.at.1);
        let where_largest = match (first, largest) {
            (Some(first), _) => of_first(first),
            (None, Some(largest)) => {
                let assembly = &self.model.assembly;
                let mut displacements = vec![0.0; assembly.node_unknowns()];
                displacements[assembly.nodes_of(largest.voussoir)].copy_from_slice(&largest.nodes);
                self.subblock(largest.voussoir, largest.subblock, largest.load_factor, &displacements)
            }
            (None, None) => None,
        };
        ElasticCrushing { load_factor: first.as_ref().map(|f| f.at.0), at_start: *at_start, where_largest }
    }

    /// Where on the way to the highest load the stone first yields.
    pub(super) fn yields_at(&self) -> Option<&PathPoint> {
        self.found().first.as_ref().map(|found| found.at.as_ref())
    }

    fn look(&mut self, before: Option<&Rc<PathPoint>>, now: &Rc<PathPoint>) {
        // The path is stopped at the end of this event.
        let Ok(Found { largest, crossing }) = self.look_at_all(before, now) else { return };
        let (share, voussoir, subblock) = largest;
        if share > self.seen.largest.as_ref().map_or(f64::NEG_INFINITY, |largest| largest.share) {
            let nodes = now.1[self.model.assembly.nodes_of(voussoir)].to_vec();
            self.seen.largest = Some(Largest { share, load_factor: now.0, voussoir, subblock, nodes });
        }
        let (share, voussoir, subblock) = crossing;
        if share.is_finite() {
            let at = before.map_or_else(|| Rc::clone(now), |before| Rc::new(between(before, now, share)));
            self.seen.at_start = before.is_none();
            self.seen.first = Some(YieldPoint { at, voussoir, subblock });
        }
    }

    /// Looks for what is above all that was seen, and for the strength.
    fn look_at_all(&mut self, before: Option<&Rc<PathPoint>>, now: &Rc<PathPoint>) -> Result<Found, Stopped> {
        let (model, loads) = (self.model, self.model.loads_at(now.0));
        let most = self.seen.largest.as_ref().map_or(f64::NEG_INFINITY, |largest| largest.share);
        let mut found = Found { largest: (most, 0, 0), crossing: (f64::INFINITY, 0, 0) };
        for (voussoir, &(strength, work)) in self.bodies.iter().enumerate() {
            if self.below.is_below(model, (voussoir, strength), now, found.largest.0.min(1.0)) {
                continue;
            }
            model.budget.work(work)?;
            let mut worth = found.largest.0.min(1.0) * strength;
            let whole = model.assembly.stress_of_whole(voussoir, &now.1, &loads);
            let stresses = match &whole {
                Some(stress) => std::slice::from_ref(stress),
                None => {
                    model.assembly.stresses_in_frame(voussoir, &now.1, &loads, &mut self.here);
                    let stresses = self.here.as_chunks::<3>().0;
                    self.below.looked(model, voussoir, now, stresses.iter().map(|&s| tresca(s) / strength));
                    stresses
                }
            };
            for (subblock, stress) in stresses.iter().enumerate() {
                if !may_exceed(*stress, worth) {
                    continue;
                }
                let equivalent = tresca(*stress);
                if equivalent / strength > found.largest.0 {
                    found.largest = (equivalent / strength, voussoir, subblock);
                    worth = found.largest.0.min(1.0) * strength;
                }
                if equivalent >= strength {
                    let share = before.map_or(0.0, |before| {
                        let loads = model.loads_at(before.0);
                        model.assembly.stresses_in_frame(voussoir, &before.1, &loads, &mut self.before);
                        reaches(&self.before[3 * subblock..3 * subblock + 3], stress, strength)
                    });
                    found.crossing =
                        if share < found.crossing.0 { (share, voussoir, subblock) } else { found.crossing };
                }
            }
        }
        Ok(found)
    }

    fn subblock(
        &self,
        voussoir: usize,
        subblock: usize,
        load_factor: f64,
        displacements: &[f64],
    ) -> Option<SubblockStress> {
        let stresses = self.model.stresses(voussoir, load_factor, displacements);
        let corners = self.model.told(voussoir, load_factor, displacements).corners;
        self.model.grids[voussoir].field(voussoir, &stresses, corners).into_iter().nth(subblock)
    }
}

/// True unless the equivalent stress is below this one for sure: it is r + max(r, |m|) of Mohr's circle, of radius r about m.
fn may_exceed([x, y, tau]: [f64; 3], least: f64) -> bool {
    let (middle, half) = (0.5 * (x + y), 0.5 * (x - y));
    let left = ROUNDED * least - middle.abs().max(0.5 * ROUNDED * least);
    left <= 0.0 || half * half + tau * tau >= left * left
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
    fn what_may_not_exceed_a_stress_is_below_it() {
        let stresses =
            [[-3.0, -1.0, 0.0], [-3.0, 1.0, 0.0], [0.0, 0.0, 2.0], [5.0, 2.0, 0.1], [1.0, -2.5, 0.7], [0.0; 3]];
        for stress in stresses {
            let equivalent = tresca(stress);
            for share in [0.0, 0.3, 0.999, 1.0] {
                assert!(may_exceed(stress, share * equivalent), "{stress:?} {share}");
            }
            for share in [1.0 + 1e-9, 1.001, 2.0] {
                assert!(equivalent == 0.0 || !may_exceed(stress, share * equivalent), "{stress:?} {share}");
            }
            assert!(may_exceed(stress, f64::NEG_INFINITY));
        }
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
