//! How the collapse load depends on surveyed points: limit analysis of the structure with points moved within their tolerances.
//!
//! Every survey is solved for itself, with its own stones and loads: no derivative is taken. All points at their worst together
//! are looked for from the survey in which each is where it alone does most harm: one point after the other goes to the end of its
//! tolerance, or back, where that lowers the load factor, until none does. The load factor found is that of a survey within the
//! tolerances, so the least of all is no higher; that it is no lower is not proven.

use super::discretise::Discretisation;
use super::{AnalysisError, CollapseReport, MovedPoint, Note, SurveyQuestion, SurveyReport, TaskReport, verdict};
use super::{Resurveyed, SurveyedLimit};
use crate::budget::Budget;
use crate::limit::{StaticTheorem, Unsolved};

/// Rounds over all points in search of their worst; seen: three.
const MOST_ROUNDS: usize = 8;
/// Load factors that differ by this share are the same.
const SAME: f64 = 1e-9;

/// Moves the points and answers for the structure as surveyed.
pub(super) fn find(question: &SurveyQuestion, budget: &Budget) -> Result<CollapseReport, AnalysisError> {
    let report = Search { question, budget, solved: 0 }.report()?;
    let mut answer = verdict::run(&question.analysis, &mut Discretisation::new(budget))?;
    let unknown =
        report.points.iter().flat_map(|moved| [moved.outwards, moved.inwards]).filter(Option::is_none).count();
    answer.notes.push(Note::PointsMoved { solved: report.solved, settled: report.settled });
    answer.notes.extend((unknown > 0).then_some(Note::PointsUnknown(unknown)));
    answer.task = TaskReport::SurveyTolerance(Box::new(report));
    Ok(answer)
}

struct Search<'q> {
    question: &'q SurveyQuestion,
    budget: &'q Budget<'q>,
    solved: usize,
}

impl Search<'_> {
    fn report(mut self) -> Result<SurveyReport, AnalysisError> {
        let points = &self.question.points;
        let still = vec![0.0; points.len()];
        let as_surveyed = self.limit(&still)?;
        let mut moved = Vec::with_capacity(points.len());
        for (k, point) in points.iter().enumerate() {
            self.budget.done(k, points.len());
            let mut alone = |by: f64| {
                let mut all = still.clone();
                all[k] = by;
                self.limit(&all)
            };
            let (outwards, inwards) = (alone(point.tolerance)?, alone(-point.tolerance)?);
            moved.push(MovedPoint { point: *point, outwards, inwards, at_worst: 0.0 });
        }
        let first_order = as_surveyed.and_then(|at| first_order(at, &moved));
        let (by, all_at_worst, settled) = self.worst(as_surveyed, &moved)?;
        moved.iter_mut().zip(by).for_each(|(moved, by)| moved.at_worst = by);
        Ok(SurveyReport { as_surveyed, points: moved, all_at_worst, settled, first_order, solved: self.solved })
    }

    /// How far outwards all points are moved at their worst, the load factor there, and whether the search came to its end.
    fn worst(
        &mut self,
        as_surveyed: SurveyedLimit,
        moved: &[MovedPoint],
    ) -> Result<(Vec<f64>, SurveyedLimit, bool), AnalysisError> {
        let mut by: Vec<f64> = moved.iter().map(|of| worst_alone(as_surveyed, of)).collect();
        let mut least = self.limit(&by)?;
        if least.is_none() {
            (by, least) = (vec![0.0; moved.len()], as_surveyed);
        }
        for _ in 0..MOST_ROUNDS {
            let before = least;
            for (k, MovedPoint { point, .. }) in moved.iter().enumerate() {
                for other in [point.tolerance, 0.0, -point.tolerance] {
                    // Nothing is lower than to fall at any load.
                    if other == by[k] || least == Some(f64::NEG_INFINITY) {
                        continue;
                    }
                    let mut tried = by.clone();
                    tried[k] = other;
                    let limit = self.limit(&tried)?;
                    if is_less(limit, least) {
                        (by, least) = (tried, limit);
                    }
                }
            }
            if before == least {
                return Ok((by, least, true));
            }
        }
        Ok((by, least, false))
    }

    /// What limit analysis says of the survey with its points moved outwards by these lengths.
    fn limit(&mut self, by: &[f64]) -> Result<SurveyedLimit, AnalysisError> {
        self.budget.ask()?;
        self.solved += 1;
        let limit = self.question.resurvey.at(by).and_then(|resurveyed| governing(&resurveyed, self.budget).ok());
        self.budget.check()?;
        Ok(limit)
    }
}

/// The lower of the upper ends of stone that does not crush, and of stone that does.
fn governing(of: &Resurveyed, budget: &Budget) -> Result<f64, Unsolved> {
    let theorem = StaticTheorem::new(&of.structure, &of.fixed, &of.scaled).map_err(|_| Unsolved)?;
    let strengths = of.structure.joint_strengths();
    let (instability, _) = theorem.upper_end(budget)?;
    if !theorem.crushes(&strengths) {
        return Ok(instability);
    }
    let (crushing, _) = theorem.crushing_upper_end(&strengths, budget)?;
    Ok(instability.min(crushing))
}

/// Where a point alone does most harm: how far outwards it is moved there.
fn worst_alone(as_surveyed: SurveyedLimit, MovedPoint { point, outwards, inwards, .. }: &MovedPoint) -> f64 {
    let ends = [(*outwards, point.tolerance), (*inwards, -point.tolerance)];
    let worse = |(least, by): (SurveyedLimit, f64), (limit, to): (SurveyedLimit, f64)| {
        if is_less(limit, least) { (limit, to) } else { (least, by) }
    };
    ends.into_iter().fold((as_surveyed, 0.0), worse).1
}

/// Whether a load factor is known to be less than another, and not by rounding.
fn is_less(a: SurveyedLimit, b: SurveyedLimit) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => a < b && (b.is_infinite() || a < b - SAME * b.abs()),
        _ => false,
    }
}

/// The load factor less what every point alone takes off.
fn first_order(as_surveyed: f64, moved: &[MovedPoint]) -> Option<f64> {
    let taken = |of: &MovedPoint| Some(as_surveyed - of.outwards?.min(of.inwards?).min(as_surveyed));
    let taken = moved.iter().map(taken).sum::<Option<f64>>()?;
    Some(as_surveyed - taken).filter(|at| at.is_finite())
}
