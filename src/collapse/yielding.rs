//! First yield: where on the path the equivalent stress of mean stress, of some subblock or of a window of the length asked for, reaches
//! the strength of its stone.
//!
//! The mean of a subblock is a parameter of the mesh: next to a hinge, where stress grows without end towards the joint's end, it grows with
//! every refinement. That of windows of one length comes to a limit.

mod averaged;
mod below;

use super::discretise::Model;
use super::record::PathPoint;
use super::report::tresca;
use super::state::Standing;
use super::{AnalysisError, ElasticCrushing, MeanStress};
use crate::budget::Stopped;
pub(super) use averaged::Averaged;
use below::Below;
use std::rc::Rc;

/// Equivalent stress that is less than this share of another is less, however both are rounded.
const ROUNDED: f64 = 1.0 - 1e-12;

/// Where the stone first yields.
#[derive(Debug, Clone)]
struct YieldPoint {
    at: Rc<PathPoint>,
    voussoir: usize,
    /// Number of the subblock, or of the window.
    mean: usize,
}

/// The largest equivalent stress over its strength, where it is, and what is needed of the point of the path to know its stress.
#[derive(Debug, Clone)]
struct Largest {
    share: f64,
    load_factor: f64,
    voussoir: usize,
    mean: usize,
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
/// first reached (infinite: nowhere), each with its voussoir and the number of its mean there.
struct Found {
    largest: (f64, usize, usize),
    crossing: (f64, usize, usize),
}

/// Looks at the mean stress of subblocks or windows along a path.
///
/// Between two points of the path stresses are linear, and the equivalent stress of Tresca is a convex function of them;
/// so it is largest at one of the two, and passes the strength at most once on the way up.
pub(super) struct Yielding<'a> {
    model: &'a Model<'a>,
    averaged: Averaged,
    /// Strength of every body that is told of, Pa, and the work of finding its stress.
    bodies: Vec<(f64, usize)>,
    /// What of bodies need not be looked at; none where bounds on subblocks do not hold.
    below: Option<Below>,
    /// Mean stresses of a body, three numbers each: here, and at the point before.
    here: Vec<f64>,
    before: Vec<f64>,
    seen: SoFar,
    /// What had been seen at the highest load, where it is not what is seen: what comes after the peak does not count.
    answer: Option<SoFar>,
}

impl<'a> Yielding<'a> {
    pub(super) fn new(model: &'a Model<'a>, averaged: Averaged, strengths: &[f64]) -> Self {
        let bodies = (0..model.bodies).map(|body| (strengths[body], averaged.work(model, body))).collect();
        let below = averaged.is_bounded(model).then(Below::default);
        let (here, before) = (Vec::new(), Vec::new());
        Yielding { model, averaged, bodies, below, here, before, seen: SoFar::default(), answer: None }
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
        let where_largest = match (first, largest) {
            (Some(first), _) => Some(self.averaged.told(self.model, (first.voussoir, first.mean), &first.at)),
            (None, Some(largest)) => {
                let assembly = &self.model.assembly;
                let mut displacements = vec![0.0; assembly.node_unknowns()];
                displacements[assembly.nodes_of(largest.voussoir)].copy_from_slice(&largest.nodes);
                let at = (largest.load_factor, displacements);
                Some(self.averaged.told(self.model, (largest.voussoir, largest.mean), &at))
            }
            (None, None) => None,
        };
        let load_factor = first.as_ref().map(|f| f.at.0);
        ElasticCrushing { load_factor, at_start: *at_start, length: self.averaged.length(), where_largest }
    }

    /// The largest share of its strength that mean stress has in a state, and where.
    ///
    /// # Errors
    /// When stopped.
    pub(super) fn largest_in(&self, state: &Standing) -> Result<Option<(f64, MeanStress)>, AnalysisError> {
        let strengths: Vec<f64> = self.bodies.iter().map(|(strength, _)| *strength).collect();
        self.averaged.largest(self.model, state, &strengths)
    }

    /// Where on the way to the highest load the stone first yields.
    pub(super) fn yields_at(&self) -> Option<&PathPoint> {
        self.found().first.as_ref().map(|found| found.at.as_ref())
    }

    fn look(&mut self, before: Option<&Rc<PathPoint>>, now: &Rc<PathPoint>) {
        // The path is stopped at the end of this event.
        let Ok(Found { largest, crossing }) = self.look_at_all(before, now) else { return };
        let (share, voussoir, mean) = largest;
        if share > self.seen.largest.as_ref().map_or(f64::NEG_INFINITY, |largest| largest.share) {
            let nodes = now.1[self.model.assembly.nodes_of(voussoir)].to_vec();
            self.seen.largest = Some(Largest { share, load_factor: now.0, voussoir, mean, nodes });
        }
        let (share, voussoir, mean) = crossing;
        if share.is_finite() {
            let at = before.map_or_else(|| Rc::clone(now), |before| Rc::new(between(before, now, share)));
            self.seen.at_start = before.is_none();
            self.seen.first = Some(YieldPoint { at, voussoir, mean });
        }
    }

    /// Looks for what is above all that was seen, and for the strength.
    fn look_at_all(&mut self, before: Option<&Rc<PathPoint>>, now: &Rc<PathPoint>) -> Result<Found, Stopped> {
        let most = self.seen.largest.as_ref().map_or(f64::NEG_INFINITY, |largest| largest.share);
        let mut found = Found { largest: (most, 0, 0), crossing: (f64::INFINITY, 0, 0) };
        for voussoir in 0..self.bodies.len() {
            let (strength, work) = self.bodies[voussoir];
            let below = |below: &Below| below.is_below(self.model, (voussoir, strength), now, found.largest.0.min(1.0));
            if self.below.as_ref().is_some_and(below) {
                continue;
            }
            self.model.budget.work(work)?;
            self.look_at(voussoir, before, now, &mut found);
        }
        Ok(found)
    }

    /// The same in one body.
    fn look_at(&mut self, voussoir: usize, before: Option<&Rc<PathPoint>>, now: &PathPoint, found: &mut Found) {
        let (model, strength) = (self.model, self.bodies[voussoir].0);
        let whole = self.averaged.of_whole(model, voussoir, now);
        let stresses = match &whole {
            Some(stress) => std::slice::from_ref(stress),
            None => {
                self.averaged.of(model, voussoir, now, &mut self.here);
                let stresses = self.here.as_chunks::<3>().0;
                if let Some(below) = &mut self.below {
                    below.looked(model, voussoir, now, stresses.iter().map(|&s| tresca(s) / strength));
                }
                stresses
            }
        };
        let (mut worth, mut looked_back) = (found.largest.0.min(1.0) * strength, false);
        for (k, stress) in stresses.iter().enumerate() {
            if !may_exceed(*stress, worth) {
                continue;
            }
            let equivalent = tresca(*stress);
            if equivalent / strength > found.largest.0 {
                found.largest = (equivalent / strength, voussoir, k);
                worth = found.largest.0.min(1.0) * strength;
            }
            if equivalent >= strength {
                let share = before.map_or(0.0, |before| {
                    if !std::mem::replace(&mut looked_back, true) {
                        self.averaged.of(model, voussoir, before, &mut self.before);
                    }
                    reaches(&self.before[3 * k..3 * k + 3], stress, strength)
                });
                found.crossing = if share < found.crossing.0 { (share, voussoir, k) } else { found.crossing };
            }
        }
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
mod tests;
