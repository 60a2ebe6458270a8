//! What two positions that were solved say of those between.

use super::super::PositionQuestion;
use super::{Mechanism, Place};
use crate::budget::Budget;

/// Parts of a gap at whose ends is looked first.
const PARTS: usize = 5;
/// What is no more than this share above the least load factor there may dip below it between two of them.
const MAY_DIP: f64 = 0.02;
/// Narrowings, by the golden section, of where the load factor may be lowest: to 5e-4 of a gap.
const NARROWED: usize = 14;

/// Between two neighbouring positions a and b that were solved.
///
/// Loads that are 1 - t times those at a and t times those at b are borne by a mean of the joint forces found there (static theorem).
/// If loads were linear in the position, 1 / lambda would therefore lie nowhere above its chord, and lambda nowhere below both ends.
/// They are not where an axle passes from body to body. By how much their work in a mechanism is above its own chord, as a share of
/// what the mechanism takes, is how far that mechanism's lambda sags. The most that any found at a or b does is allowed for:
///
/// ```text
/// lambda_0 / lambda <= (1 - t) lambda_0 / lambda_a + t lambda_0 / lambda_b + max (W(t) - (1 - t) W_a - t W_b)
/// ```
///
/// with the work W of the loads at the lower load factor of both ends, lambda_0. One that governs between the two only, and was not
/// found, is taken to sag no more than those: it is much like them. That is not proven.
pub(super) struct Gap<'q> {
    question: &'q PositionQuestion,
    ends: [&'q Place; 2],
    /// Load factors of both.
    solved: [f64; 2],
    budget: &'q Budget<'q>,
}

/// What is said of one place between.
#[derive(Debug, Clone)]
pub(super) struct Estimate {
    pub place: Place,
    /// Where in the gap it is, 0 to 1.
    t: f64,
    /// The load factor is not lower, as far as the mechanisms of both ends tell.
    pub load_factor: f64,
}

impl<'q> Gap<'q> {
    /// None where nothing is known of an end, the two are of different directions, or neither load factor has an end.
    pub fn new(question: &'q PositionQuestion, ends: [&'q Place; 2], budget: &'q Budget<'q>) -> Option<Self> {
        let [a, b] = ends;
        let solved = [a.load_factor()?, b.load_factor()?];
        let told = a.reversed == b.reversed && solved.iter().any(|load_factor| load_factor.is_finite());
        told.then_some(Gap { question, ends, solved, budget })
    }

    /// At the place where the load factor may be lowest; `least` is the least that is known.
    pub fn lowest(&self, least: f64) -> Option<Estimate> {
        let part = |i: usize| i as f64 / PARTS as f64;
        let looks = (1..PARTS).filter_map(|i| self.at(part(i)));
        let lowest = looks.min_by(|a, b| a.load_factor.total_cmp(&b.load_factor))?;
        if lowest.load_factor > least * (1.0 + MAY_DIP) {
            return Some(lowest);
        }
        self.narrowed([lowest.t - part(1), lowest.t + part(1)])
    }

    /// At this share of the way from one end to the other.
    pub fn at(&self, t: f64) -> Option<Estimate> {
        let [a, b] = self.ends;
        let place = Place::new(self.question, between([a.x, b.x], t), a.reversed, self.budget)?;
        let level = self.solved[0].min(self.solved[1]);
        let sag = |mechanism: &Mechanism| {
            let chord = between(self.ends.map(|end| mechanism.driven(end, level)), t);
            mechanism.driven(&place, level) - chord
        };
        // A mechanism that takes nothing bounds nothing.
        let larger = |a: f64, b: f64| if b.is_nan() { f64::INFINITY } else { a.max(b) };
        let sag = a.mechanisms.iter().chain(&b.mechanisms).map(sag).fold(0.0, larger);
        let chord = between(self.solved.map(|load_factor| level / load_factor), t);
        Some(Estimate { place, t, load_factor: level / (chord + sag) })
    }

    /// The lowest between two, by the golden section.
    fn narrowed(&self, [mut from, mut to]: [f64; 2]) -> Option<Estimate> {
        let golden = 0.5 * (5f64.sqrt() - 1.0);
        let mut inner = [self.at(to - golden * (to - from))?, self.at(from + golden * (to - from))?];
        for _ in 0..NARROWED {
            let [left, right] = inner;
            inner = if left.load_factor <= right.load_factor {
                to = right.t;
                [self.at(to - golden * (to - from))?, left]
            } else {
                from = left.t;
                [right, self.at(from + golden * (to - from))?]
            };
        }
        inner.into_iter().min_by(|a, b| a.load_factor.total_cmp(&b.load_factor))
    }
}

fn between([from, to]: [f64; 2], t: f64) -> f64 {
    (1.0 - t) * from + t * to
}
