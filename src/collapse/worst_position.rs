//! The worst position of vehicles: where the load factor of collapse is least.
//!
//! Limit analysis alone looks for it: every position on a grid is solved, and with it a mechanism is found. What the loads of
//! positions between do in the mechanisms on either side tells how low the load factor may be there. Where it may be lower than the
//! least found so far it is solved, and so on. Then the analysis is done at the worst position.

mod gap;
mod mechanism;
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
use gap::{Estimate, Gap};
use mechanism::Mechanism;
use places::{Place, places};

/// Between positions no farther apart than this share of the grid's step nothing is looked for: where an axle leaps from body to body
/// what is said of the two sides of the leap would never agree.
const NARROWEST: f64 = 1e-3;
/// Most positions besides the grid; seen: twelve.
const MOST_REFINED: usize = 500;
/// Multiplications of a force's work in the mechanisms of a gap.
const WORK: usize = 200;
/// Load factors that differ by this share are the same: of equal ones the leftmost counts.
const SAME: f64 = 1e-9;

/// Looks for the worst position and answers for it.
pub(super) fn find(question: &PositionQuestion, budget: &Budget) -> Result<CollapseReport, AnalysisError> {
    let mut search = Search::new(question, budget);
    search.scan()?;
    let tolerance = search.refine()?;
    let (worst, report) = search.report();
    let analysis = search.loaded(&search.places[worst]);
    let mut answer = verdict::run(&analysis, &mut Discretisation::new(budget))?;
    let unknown = report.curve.iter().filter(|point| point.instability.is_none() || point.crushing.is_none()).count();
    answer.notes.push(Note::PositionsBetween { solved: report.curve.len(), tolerance });
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
    let forces = places(&few, budget).iter().map(Place::forces).max();
    budget.check()?;
    Ok((question.sweeps.iter().map(|sweep| sweep.parts() + 1).sum(), forces.unwrap_or(0)))
}

struct Search<'q> {
    question: &'q PositionQuestion,
    budget: &'q Budget<'q>,
    strengths: Vec<f64>,
    /// Of every direction those of the grid from left to right, then those between as they are solved.
    places: Vec<Place>,
}

impl<'q> Search<'q> {
    fn new(question: &'q PositionQuestion, budget: &'q Budget<'q>) -> Self {
        let structure = &question.analysis.structure;
        let strengths = structure.joint_strengths();
        Search { question, budget, strengths, places: places(question, budget) }
    }

    fn structure(&self) -> &'q Structure {
        &self.question.analysis.structure
    }

    /// Solves the positions of the grid.
    fn scan(&mut self) -> Result<(), AnalysisError> {
        self.budget.check()?;
        let grid = self.places.len();
        for place in 0..grid {
            self.budget.done(place, grid);
            self.budget.ask()?;
            self.solve(place)?;
        }
        Ok(())
    }

    /// Solves positions between those of the grid until between no two the load factor may be lower than the least by more than the
    /// tolerance. By what share of it it still may be, those between included at which there was no answer.
    fn refine(&mut self) -> Result<f64, AnalysisError> {
        let tolerance = self.question.tolerance;
        let known: Vec<usize> = (0..self.places.len()).filter(|&i| self.places[i].load_factor().is_some()).collect();
        let mut gaps = Vec::new();
        for pair in known.windows(2) {
            gaps.extend(self.gap([pair[0], pair[1]])?);
        }
        let mut unknown = tolerance;
        for _ in 0..MOST_REFINED {
            let Some((lowest, off)) = self.lowest(&gaps) else { return Ok(unknown) };
            if off <= tolerance {
                return Ok(unknown);
            }
            let ([from, to], estimate) = gaps.swap_remove(lowest);
            let between = self.places.len();
            self.places.push(estimate.place);
            self.solve(between)?;
            if self.places[between].load_factor().is_none() {
                unknown = unknown.max(off);
            }
            gaps.extend(self.gap([from, between])?);
            gaps.extend(self.gap([between, to])?);
        }
        Ok(self.lowest(&gaps).map_or(unknown, |(_, off)| off.max(unknown)))
    }

    /// Two neighbouring places, and where between them the load factor may be lowest; none where nothing is to be looked for.
    fn gap(&self, ends: [usize; 2]) -> Result<Option<([usize; 2], Estimate)>, AnalysisError> {
        let [from, to] = ends.map(|end| &self.places[end]);
        self.budget.work(WORK * (from.forces() + to.forces()))?;
        let steps = self.question.sweeps.iter().map(|sweep| (sweep.to - sweep.from) / sweep.parts() as f64);
        let step = steps.fold(f64::INFINITY, f64::min);
        let Some(least) = self.least().filter(|_| to.x - from.x > NARROWEST * step) else { return Ok(None) };
        let lowest = Gap::new(self.question, [from, to], self.budget).and_then(|gap| gap.lowest(least));
        self.budget.check()?;
        Ok(lowest.map(|lowest| (ends, lowest)))
    }

    /// Which gap has the lowest estimate, and by what share that is below the least load factor.
    fn lowest(&self, gaps: &[([usize; 2], Estimate)]) -> Option<(usize, f64)> {
        let least = self.least()?;
        let load_factor = |i: usize| gaps[i].1.load_factor;
        let lowest = (0..gaps.len()).min_by(|&a, &b| load_factor(a).total_cmp(&load_factor(b)))?;
        Some((lowest, 1.0 - load_factor(lowest) / least))
    }

    /// Finds the load factors of a place, and in which mechanisms it collapses.
    fn solve(&mut self, place: usize) -> Result<(), AnalysisError> {
        let ends = self.ends(&self.places[place])?;
        let [_, scaled] = self.forces(&self.places[place]);
        let mechanism = |end: &UpperEnd| Some(Mechanism::new(self.structure(), end.0, &scaled, end.1.clone()?));
        let mechanisms = ends.iter().flatten().filter_map(mechanism).collect();
        self.places[place].found = Some(ends.map(|end| end.map(|(load_factor, _)| load_factor)));
        self.places[place].mechanisms = mechanisms;
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

    /// The place of the least load factor, the leftmost of equal ones; none where it is known at none.
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

    /// The least load factor, where that is one: loads bring down what stands without them.
    fn least(&self) -> Option<f64> {
        let least = self.worst().and_then(|worst| self.places[worst].load_factor());
        least.filter(|least| *least > 0.0 && least.is_finite())
    }

    /// The worst place, and what is told of all that were solved. Where no load factor has an end, the place on which most of the
    /// vehicles stands.
    fn report(&mut self) -> (usize, PositionReport) {
        let first = self.places.first().is_some_and(|place| place.reversed);
        self.places.sort_by(|a, b| (a.reversed != first).cmp(&(b.reversed != first)).then(a.x.total_cmp(&b.x)));
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
