//! The worst position of vehicles: where the load factor of collapse is least.
//!
//! Limit analysis alone looks for it: every position on a grid is solved, and with it a mechanism is found. The load factor at
//! which that mechanism moves under the vehicles at any other position is an upper bound of the load factor there (kinematic
//! theorem), for the price of the loads' work. Positions between those of the grid are solved only where such a bound is lower than
//! the least load factor found so far, so that every one that is solved lowers it. Then the analysis is done at the worst position.

mod bound;
mod places;

use super::discretise::Discretisation;
use super::tolerances::SAME_FAILURE;
use super::{
    Analysis, AnalysisError, CollapseReport, Governs, Note, PositionQuestion, PositionReport, Sweep, TaskReport,
    verdict,
};
use crate::budget::{Budget, Stopped};
use crate::limit::{StaticTheorem, UpperEnd};
use crate::structure::{PointForce, Structure};
use bound::Bound;
use places::{Place, places};

/// Positions between two of the grid at which bounds are looked at.
const BETWEEN: usize = 4;
/// A bound that is no more than this share above the least load factor may dip below it between two such positions.
const MAY_DIP: f64 = 0.02;
/// Halvings, by the golden section, of where a bound dips.
const NARROWED: usize = 14;
/// Most positions besides the grid; seen: ten.
const MOST_REFINED: usize = 500;
/// Multiplications of a force's work.
const WORK: usize = 8;
/// Load factors that differ by this share are the same: of equal ones the leftmost counts.
const SAME: f64 = 1e-9;

/// Looks for the worst position and answers for it.
pub(super) fn find(question: &PositionQuestion, budget: &Budget) -> Result<CollapseReport, AnalysisError> {
    let mut search = Search::new(question, budget);
    search.scan()?;
    search.refine()?;
    let (worst, report) = search.report();
    let analysis = search.loaded(&search.places[worst]);
    let mut answer = verdict::run(&analysis, &mut Discretisation::new(budget))?;
    let unknown = report.curve.iter().filter(|point| point.instability.is_none() || point.crushing.is_none()).count();
    answer.notes.push(Note::PositionsBetween { solved: report.curve.len(), tolerance: question.tolerance });
    answer.notes.extend((unknown > 0).then_some(Note::PositionsUnknown(unknown)));
    let slides = answer.end.as_ref().is_some_and(|end| end.mechanism.slips());
    answer.notes.extend(slides.then_some(Note::PositionsSlide));
    answer.task = TaskReport::WorstPosition(Box::new(report));
    Ok(answer)
}

/// Positions on the grid, and about how many forces there are at most at one.
///
/// # Errors
/// When stopped.
pub(super) fn size(question: &PositionQuestion, budget: &Budget) -> Result<(usize, usize), Stopped> {
    let coarse = question.sweeps.iter().map(|sweep| Sweep { step: (sweep.to - sweep.from) / 8.0, ..*sweep }).collect();
    let few = PositionQuestion { sweeps: coarse, ..question.clone() };
    let forces = places(&few, 0, budget).iter().map(|place| place.fixed.len() + place.scaled.len()).max();
    budget.check()?;
    Ok((question.sweeps.iter().map(|sweep| sweep.parts() + 1).sum(), forces.unwrap_or(0)))
}

struct Search<'q> {
    question: &'q PositionQuestion,
    budget: &'q Budget<'q>,
    strengths: Vec<f64>,
    /// Of every direction those from left to right.
    places: Vec<Place>,
    bounds: Vec<Bound>,
}

impl<'q> Search<'q> {
    fn new(question: &'q PositionQuestion, budget: &'q Budget<'q>) -> Self {
        let structure = &question.analysis.structure;
        let strengths = structure.joints.iter().map(|joint| structure.strength_at(joint)).collect();
        Search { question, budget, strengths, places: places(question, BETWEEN, budget), bounds: Vec::new() }
    }

    fn structure(&self) -> &'q Structure {
        &self.question.analysis.structure
    }

    /// Solves the positions of the grid.
    fn scan(&mut self) -> Result<(), AnalysisError> {
        self.budget.check()?;
        let grid: Vec<usize> = (0..self.places.len()).filter(|&i| self.places[i].on_grid).collect();
        for (done, &place) in grid.iter().enumerate() {
            self.budget.done(done, grid.len());
            self.budget.ask()?;
            self.solve(place)?;
        }
        Ok(())
    }

    /// Solves positions between those of the grid until no bound is lower than the least load factor, to the tolerance.
    fn refine(&mut self) -> Result<(), AnalysisError> {
        for _ in 0..MOST_REFINED {
            let Some(least) = self.worst().and_then(|worst| self.places[worst].load_factor()) else { return Ok(()) };
            if !least.is_finite() {
                return Ok(());
            }
            let Some((after, place)) = self.lowest_dip(least) else { return Ok(self.budget.check()?) };
            self.places.insert(after, place);
            self.solve(after)?;
        }
        Ok(())
    }

    /// Where some bound is lowest, if that is lower than the least load factor by more than the tolerance; and behind which
    /// places it stands.
    fn lowest_dip(&self, least: f64) -> Option<(usize, Place)> {
        let bar = least - self.question.tolerance * least.abs();
        let mut lowest: Option<(f64, usize, Place)> = None;
        for i in 0..self.places.len() {
            let Some((bound, value)) = self.places[i].bound else { continue };
            let same = |j: usize| self.places.get(j).filter(|place| place.reversed == self.places[i].reversed);
            let beside = [i.checked_sub(1).and_then(same), same(i + 1)];
            let higher =
                |place: &Option<&Place>| place.and_then(|place| place.bound).is_none_or(|(_, other)| other >= value);
            if value > least + MAY_DIP * least.abs() || !beside.iter().all(higher) {
                continue;
            }
            let ends = beside.map(|place| place.map_or(self.places[i].x, |place| place.x));
            let Some(dip) = self.dip(&self.bounds[bound], ends, self.places[i].reversed) else { continue };
            let value = self.bounds[bound].at(&dip);
            if value < bar && lowest.as_ref().is_none_or(|(other, ..)| is_less(value, *other)) {
                lowest = Some((value, if dip.x < self.places[i].x { i } else { i + 1 }, dip));
            }
        }
        lowest.map(|(_, after, place)| (after, place))
    }

    /// Where a bound is least between two abscissae, by the golden section.
    fn dip(&self, bound: &Bound, [mut from, mut to]: [f64; 2], reversed: bool) -> Option<Place> {
        let golden = 0.5 * (5f64.sqrt() - 1.0);
        let at = |x: f64| Place::new(self.question, x, reversed, self.budget).map(|place| (bound.at(&place), place));
        let mut inner = [at(to - golden * (to - from))?, at(from + golden * (to - from))?];
        for _ in 0..NARROWED {
            let [left, right] = inner;
            inner = if left.0 <= right.0 {
                to = right.1.x;
                [at(to - golden * (to - from))?, left]
            } else {
                from = left.1.x;
                [right, at(from + golden * (to - from))?]
            };
        }
        let [left, right] = inner;
        Some(if left.0 <= right.0 { left.1 } else { right.1 })
    }

    /// Finds the load factors of a place, and bounds of all others.
    fn solve(&mut self, place: usize) -> Result<(), AnalysisError> {
        let [instability, crushing] = self.ends(&self.places[place])?;
        let value = |end: &Option<UpperEnd>| end.as_ref().map(|(load_factor, _)| *load_factor);
        self.places[place].found = Some([value(&instability), value(&crushing)]);
        for (load_factor, motion) in [instability, crushing].into_iter().flatten() {
            let Some(motion) = motion else { continue };
            let bound = Bound::new(self.structure(), &self.question.analysis, &self.places[place], load_factor, motion);
            let number = self.bounds.len();
            self.budget.work(self.places.iter().map(|place| WORK * (place.scaled.len() + place.fixed.len())).sum())?;
            self.places.iter_mut().for_each(|place| place.lower(number, bound.at(place)));
            self.bounds.push(bound);
        }
        // A place that was inserted has not seen the others.
        for number in 0..self.bounds.len() {
            let value = self.bounds[number].at(&self.places[place]);
            self.places[place].lower(number, value);
        }
        Ok(())
    }

    /// Upper ends of the limit windows of stone that does not crush, and of stone that does; none where rounding kept the
    /// programme from an answer.
    fn ends(&self, place: &Place) -> Result<[Option<UpperEnd>; 2], AnalysisError> {
        let analysis = &self.question.analysis;
        if place.scaled.is_empty() && analysis.scaled.is_empty() {
            return Ok([(); 2].map(|()| Some((f64::INFINITY, None))));
        }
        let [fixed, scaled] = self.forces(place);
        let theorem = StaticTheorem::new(self.structure(), &fixed, &scaled);
        let theorem = theorem.map_err(|bodies| AnalysisError::Unconnected(bodies[0]))?;
        let instability = theorem.upper_end(self.budget).ok();
        let crushing = match theorem.crushes(&self.strengths) {
            true => theorem.crushing_upper_end(&self.strengths, self.budget).ok(),
            false => instability.as_ref().map(|(load_factor, _)| (*load_factor, None)),
        };
        self.budget.check()?;
        Ok([instability, crushing])
    }

    /// All loads that stay, and all that are scaled, with the vehicles at a place.
    fn forces(&self, place: &Place) -> [Vec<PointForce>; 2] {
        let Analysis { fixed, scaled, .. } = &self.question.analysis;
        [[fixed, &place.fixed], [scaled, &place.scaled]].map(|[stay, move_]| [&stay[..], move_].concat())
    }

    fn loaded(&self, place: &Place) -> Analysis {
        let [fixed, scaled] = self.forces(place);
        Analysis { fixed, scaled, ..self.question.analysis.clone() }
    }

    /// The place of the least load factor; none where it is known at none.
    fn worst(&self) -> Option<usize> {
        let mut worst: Option<(usize, f64)> = None;
        for (i, place) in self.places.iter().enumerate() {
            let Some(load_factor) = place.load_factor() else { continue };
            if worst.is_none_or(|(_, least)| is_less(load_factor, least)) {
                worst = Some((i, load_factor));
            }
        }
        worst.map(|(i, _)| i)
    }

    /// The worst place, and what is told of all that were solved. Where no load factor has an end, the place on which most of the
    /// vehicles stands.
    fn report(&self) -> (usize, PositionReport) {
        let finite = self.worst().filter(|&worst| self.places[worst].load_factor() != Some(f64::INFINITY));
        let most =
            || (0..self.places.len()).max_by(|&a, &b| self.places[a].arriving.total_cmp(&self.places[b].arriving));
        let worst = finite.or_else(most).unwrap_or(0);
        let point = self.places[worst].point();
        let governed_by = match (point.instability, point.crushing) {
            _ if finite.is_none() => Governs::Nothing,
            (Some(falls), Some(crushes)) if crushes < falls - SAME_FAILURE * falls.abs() => Governs::Crushing,
            (Some(_), Some(_)) => Governs::Instability,
            _ => Governs::Unknown,
        };
        let curve = self.places.iter().filter(|place| place.found.is_some()).map(Place::point).collect();
        (worst, PositionReport { worst: point, governed_by, curve })
    }
}

/// Whether a load factor is less than another, and not by rounding.
fn is_less(a: f64, b: f64) -> bool {
    a < b && (b.is_infinite() || a < b - SAME * b.abs())
}

#[cfg(test)]
mod tests;
