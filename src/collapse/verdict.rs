//! From the limit window and the load path to one answer, or to saying that we cannot tell.

mod blank;
mod crushing;
mod directly;
mod fallen;
mod least;
mod leg;
mod mesh;
mod moved;
mod softer;

pub(super) use mesh::{is_cohesive, notes_on_mesh};

use super::certificate::{Certificate, ThrustLines, settled};
use super::discretise::{Discretisation, Model};
use super::path::{ATTEMPTS, Attempt, disturbed, nothing_grows, stand, total};
use super::snapshot::snapshot;
use super::state::{Standing, States};
use super::strips::Strips;
use super::{
    Analysis, AnalysisError, CollapseReport, Cost, Crushing, Doubt, Geometry, Method, Note, Order, Outcome, Task,
    ThrustRange, falling, geometric, plan, rounding, safety,
};
use crate::budget::Budget;
use crate::dda::{self, Tracer};
use least::Searched;

use std::cell::RefCell;
use std::ops::ControlFlow;
use std::rc::Rc;

/// By default the load factor is raised until the scaled loads are so many times the fixed ones.
const DEFAULT_CAP: f64 = 1e6;

/// What all attempts at one analysis share.
struct Setup<'a> {
    analysis: &'a Analysis,
    budget: &'a Budget<'a>,
    certificate: Certificate,
    /// +1 where the load factor increases, -1 where it decreases.
    sign: f64,
    /// Load factor from which the path starts.
    start: f64,
    cap: f64,
    /// Sum of all loads at the start, N/m.
    weight: f64,
    /// Thrusts under the fixed loads, and the lines of thrust at either end.
    thrust: (Option<ThrustRange>, ThrustLines),
    /// What limit analysis says of crushing.
    crushing: Crushing,
    /// Limit window of rigid stones.
    rigid: Option<[f64; 2]>,
    /// The answer of whole stones to the same question, where it is known.
    whole: Option<&'a CollapseReport>,
    /// Least loads at which joints slide that were found, with contacts of any stiffness.
    searched: Rc<RefCell<Searched>>,
    /// Joints that crush on the path.
    strips: Strips,
}

/// A report, and why it is not believed as it stands, if so.
struct Attempted {
    report: CollapseReport,
    doubt: Option<Doubt>,
}

/// Is told of every event: the tracer and its load factor.
type OnEvent<'w> = dyn FnMut(&Tracer, f64) -> ControlFlow<()> + 'w;

/// The whole answer; stones that are in `built` already are not condensed again.
pub(super) fn run<'a>(analysis: &'a Analysis, built: &mut Discretisation<'a>) -> Result<CollapseReport, AnalysisError> {
    let question = Setup::new(analysis, built.budget)?;
    let report = softer::as_asked(&question, built)?;
    softer::or_softer(&question, report, built)
}

/// Limit window and load path on the mesh given; what follows from them is left to [`run`].
pub(super) fn solve(analysis: &Analysis, budget: &Budget) -> Result<CollapseReport, AnalysisError> {
    Setup::new(analysis, budget)?.solve(&mut Discretisation::new(budget))
}

/// The same where the answer of whole stones is known.
pub(super) fn solve_beside(
    analysis: &Analysis,
    whole: &CollapseReport,
    budget: &Budget,
) -> Result<CollapseReport, AnalysisError> {
    let setup = Setup { whole: Some(whole), ..Setup::new(analysis, budget)? };
    setup.solve(&mut Discretisation::new(budget))
}

impl Attempted {
    fn contradicts(&self) -> bool {
        self.doubt.as_ref().is_some_and(Doubt::is_contradiction)
    }

    /// The less doubtful of two attempts, with the work of both.
    fn or_better(self, next: Attempted) -> Attempted {
        let better = next.doubt.is_none() || (self.contradicts() && !next.contradicts());
        let (mut kept, other) = if better { (next, self) } else { (self, next) };
        kept.report.cost.join(other.report.cost);
        kept
    }
}

impl<'a> Setup<'a> {
    fn new(analysis: &'a Analysis, budget: &'a Budget<'a>) -> Result<Self, AnalysisError> {
        let mut certificate = Certificate::new(analysis, budget)?;
        let rigid = certificate.window;
        let (mut crushing, forces) = certificate.crushing(analysis, budget)?;
        if analysis.task.crushes_on_path() {
            certificate.hold_to(&crushing);
        }
        if !matches!(analysis.task.method(), Method::EventPath(_)) {
            // The path itself is the answer.
            crushing.plastic_section.iter_mut().for_each(|plastic| plastic.ends = Default::default());
        }
        let (fixed, scaled) = (total(&analysis.fixed), total(&analysis.scaled));
        let balance = if fixed > 0.0 && scaled > 0.0 { fixed / scaled } else { 1.0 };
        let (sign, settled) = (analysis.task.sign(), settled(analysis));
        let cap = match &analysis.task {
            Task::Collapse(task) => task.cap.unwrap_or(DEFAULT_CAP * balance),
            Task::Safety(task) => task.cap.unwrap_or(DEFAULT_CAP * balance.max(1.0)),
            Task::Settlement(_) | Task::GeometricSafety(_) => DEFAULT_CAP * balance,
        };
        let start = match &analysis.task {
            Task::Safety(_) => certificate.full_load(settled, cap),
            _ => certificate.start(settled, sign, cap),
        };
        let thrust = certificate.thrust_range(analysis, budget);
        budget.check()?;
        let weight = fixed + scaled * start.abs();
        let mut strips = Strips::default();
        if analysis.task.crushes_on_path() {
            strips = Strips::new(&analysis.structure, !certificate.stands_at(start));
            let ends = forces.iter().zip([-1.0, 1.0]).filter(|(_, end)| *end == sign || !certificate.stands_at(0.0));
            ends.for_each(|(forces, _)| strips.expect(forces));
        }
        Ok(Setup {
            analysis,
            budget,
            certificate,
            thrust,
            crushing,
            rigid,
            strips,
            whole: None,
            searched: Rc::default(),
            sign,
            start,
            cap,
            weight,
        })
    }

    /// Limit window, load path and all that follows from them.
    fn answer(&self, built: &mut Discretisation<'a>) -> Result<CollapseReport, AnalysisError> {
        let (analysis, budget) = (self.analysis, self.budget);
        let mut report = match plan::on_given_mesh(analysis, budget)? {
            Some(report) => report,
            None => self.solve(built)?,
        };
        if let Some(accuracy) = analysis.task.accuracy() {
            report = plan::refined(analysis, accuracy, report, budget)?;
        }
        report.settle_fields(analysis);
        report.leave_out_far_states(&analysis.structure);
        let mesh = &analysis.mesh;
        let unbent = mesh.order == Order::First && mesh.subblocks.iter().any(|[radial, _]| *radial == 1);
        if analysis.task.geometry() == Geometry::Updated && unbent && report.at_start.is_some() {
            report.notes.push(Note::UnbentStones);
        }
        report.updated = self.updated(&mut report, built)?;
        match &analysis.task {
            Task::Collapse(_) => {
                safety::crushed(&mut report, analysis.task.crushes_on_path());
                report = self.follow_crushing(report, built)?;
            }
            Task::Safety(task) => {
                report = self.follow_crushing(report, built)?;
                safety::judge(&mut report, &analysis.task, task.crushing);
            }
            Task::Settlement(task) => self.settle(&mut report, &task.movements, built)?,
            Task::GeometricSafety(task) => {
                geometric::judge(&mut report, analysis, &self.certificate.theorem, task, budget)
            }
        }
        plan::judge_load(&mut report, &analysis.task);
        falling::follow(analysis, &mut report, budget)?;
        budget.ask()?;
        Ok(report)
    }

    /// The answer of the first attempt that is not in doubt, or of the one least so.
    fn solve(&self, built: &mut Discretisation<'a>) -> Result<CollapseReport, AnalysisError> {
        let slender = rounding::too_slender(&self.analysis.structure);
        let attempted = match slender {
            Some(doubt) => Attempted { report: self.blank(0), doubt: Some(doubt) },
            None => self.attempts(built)?,
        };
        let Attempted { mut report, doubt } = attempted;
        if let Some(doubt) = doubt {
            if doubt.is_contradiction() {
                report.outcome = Outcome::CannotTell;
            }
            report.notes.push(Note::Doubt(doubt));
        }
        Ok(report)
    }

    /// The first attempt that is not in doubt, or the one least so; of paths that are lost fewer where softer contacts are left.
    fn attempts(&self, built: &mut Discretisation<'a>) -> Result<Attempted, AnalysisError> {
        let mut attempted = self.attempt(Attempt::number(0), built)?;
        for i in 1..ATTEMPTS {
            let Some(doubt) = &attempted.doubt else { break };
            if i == softer::BEFORE && doubt.is_lost() && softer::are_left(self.analysis) {
                break;
            }
            let next = self.attempt(Attempt::number(i), built)?;
            attempted = attempted.or_better(next);
        }
        Ok(attempted)
    }

    /// Until no joint crushes at the end of the path but those in strips.
    fn attempt(&self, attempt: Attempt, built: &mut Discretisation<'a>) -> Result<Attempted, AnalysisError> {
        let (mut strips, mut cost) = (self.strips.clone(), Cost::default());
        loop {
            let mut attempted = self.attempt_with(&strips, attempt, built)?;
            attempted.report.cost.join(cost);
            cost = attempted.report.cost;
            let report = &attempted.report;
            if !self.analysis.task.crushes_on_path() {
                return Ok(attempted);
            }
            let mut more = false;
            for end in report.end.iter().chain(&report.other_end) {
                more |= strips.expect_more(&end.thrust_line);
            }
            if !more {
                return Ok(attempted);
            }
        }
    }

    fn attempt_with(
        &self,
        strips: &Strips,
        attempt: Attempt,
        built: &mut Discretisation<'a>,
    ) -> Result<Attempted, AnalysisError> {
        let model = built.crushing(self.analysis, strips, attempt)?;
        let fixed = disturbed(model, self.start, attempt);
        let mut progress = |tracer: &Tracer, load_factor: f64| self.budget.step(load_factor, tracer.events());
        if attempt.is_first()
            && let Some(report) = self.directly(model, &fixed, &mut progress)?
        {
            return Ok(Attempted { report, doubt: None });
        }
        let mut report = self.blank(model.assembly.unknowns());
        report.notes = notes_on_mesh(self.analysis, model);
        let (tracer, end) =
            stand(model, &fixed, self.start, self.weight, &mut |t| progress(t, self.start * t.parameter()));
        report.cost.add(&tracer, Cost::default());
        let slid = self.slid_out(&report, model, &tracer);
        let attempted = self.go_on(report, model, (tracer, end), &fixed, &mut progress)?;
        Ok(match slid {
            Some(slid) if attempted.contradicts() => attempted.or_better(slid),
            _ => attempted,
        })
    }

    /// From where the loads at the start have come on, or where they no longer could.
    fn go_on(
        &self,
        mut report: CollapseReport,
        model: &Model,
        (mut tracer, end): (Tracer, dda::End),
        fixed: &[f64],
        progress: &mut OnEvent,
    ) -> Result<Attempted, AnalysisError> {
        let analysis = self.analysis;
        match end {
            dda::End::Stopped => return Err(self.budget.stopped().into()),
            dda::End::Reached if self.certificate.stands_at(self.start) => {}
            dda::End::Reached => return Ok(Attempted { report, doubt: Some(self.certificate.outside()) }),
            dda::End::Mechanism => return self.fallen(report, model, &tracer),
            dda::End::Rising | dda::End::Lost => return Ok(Attempted { report, doubt: Some(Doubt::NotLoaded) }),
        }
        let mut states = States::new(model);
        let at_start = states.find(self.start, tracer.displacements())?;
        report.at_start = at_start.as_ref().map(|state| snapshot(model, state)).transpose()?;
        if nothing_grows(model, total(&analysis.scaled)) {
            self.stands_still(&mut report, model, at_start)?;
            let doubt = states.tell(&mut report);
            return Ok(Attempted { report, doubt });
        }
        let back = self.goes_both_ways().then(|| tracer.clone());
        let mut doubt = self.leg(&mut report, &mut states, &mut tracer, fixed, self.sign, progress)?;
        if let Some(mut back) = back {
            report.outcome = Outcome::StandsInWindow;
            let mut other = self.blank(model.assembly.unknowns());
            doubt = doubt.or(self.leg(&mut other, &mut states, &mut back, fixed, -self.sign, progress)?);
            report.join_other_end(other);
        }
        let doubt = doubt.or(states.tell(&mut report));
        Ok(Attempted { report, doubt })
    }

    /// Whether the structure falls under too little load and under too much.
    fn goes_both_ways(&self) -> bool {
        matches!(self.analysis.task, Task::Collapse(_)) && !self.certificate.stands_at(0.0)
    }

    /// The answer where nothing grows: the state at the start is all there is.
    fn stands_still(
        &self,
        report: &mut CollapseReport,
        model: &Model,
        at_start: Option<Standing>,
    ) -> Result<(), AnalysisError> {
        report.outcome = Outcome::Stands;
        at_start.map(|state| report.fields_at_rest(self.analysis, model, &state)).transpose()?;
        let cancel = !self.analysis.scaled.is_empty();
        report.notes.extend(self.analysis.task.grows().then_some(Note::NothingGrows { cancel }));
        Ok(())
    }
}
