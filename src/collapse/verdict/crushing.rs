//! Where joints slide and stone crushes: the load path on which they do both.
//!
//! Limit analysis lets joints dilate as they slide, and so bounds from above alone what they bear that crush. The least load at which
//! joints slide without dilating is that of stone that does not crush. The path may end far below both: rings upon each other lost a
//! tenth by it in the median, and two thirds at most (33 random bridges). So it is followed, too, and governs where it ends first.

use super::{Setup, is_cohesive};
use crate::collapse::certificate::range_note;
use crate::collapse::discretise::Discretisation;
use crate::collapse::ending::Ending;
use crate::collapse::{
    Analysis, AnalysisError, CollapseReport, CollapseTask, Direction, End, GovernedBy, LoadRange, Method, Note,
    Outcome, PathEnd, StatesAsked, Task, Thrust, WhichEnd, mechanism, plan, tolerances,
};
use crate::structure::Joint;

/// Blocks that are crushed, as a share of their joints, that change nothing but by chance.
const SLIGHT: f64 = 1e-2;

impl<'a> Setup<'a> {
    /// The report, held against the load path of joints that crush, where joints slide.
    pub(super) fn follow_crushing(
        &self,
        mut report: CollapseReport,
        built: &mut Discretisation<'a>,
    ) -> Result<CollapseReport, AnalysisError> {
        let exact = matches!(self.analysis.task.method(), Method::EventPath(_));
        if !exact || report.outcome == Outcome::Crushes || !self.crushes() || !slides(&report) {
            return Ok(report);
        }
        // One model at a time.
        *built = Discretisation::new(self.budget);
        let path = super::run(&self.on_crushing_path(), &mut Discretisation::new(self.budget))?;
        report.cost.join(path.cost);
        match path.outcome {
            Outcome::Collapse | Outcome::StandsInWindow | Outcome::Stands => {
                path.ends().iter().try_for_each(|end| self.take_lower(&mut report, end))?;
                let followed = report.crushing.on_path.iter().any(Option::is_some);
                let dilates = report.ends().iter().any(dilates);
                report.notes.extend(followed.then_some(Note::CrushesAndSlides));
                report.notes.extend(dilates.then_some(Note::CrushesAndDilates));
                Ok(report)
            }
            Outcome::FallsAsBuilt | Outcome::SlidesAsBuilt => {
                let told = report.ends().first().map(|end| Note::SlidesAndCrushesAsBuilt(end.state.load_factor));
                let notes = path.notes.into_iter().chain(told).collect();
                Ok(CollapseReport { cost: report.cost, plan: report.plan, notes, ..path })
            }
            _ => {
                let doubt = path.notes.into_iter().find_map(|note| match note {
                    Note::Doubt(doubt) => Some(doubt),
                    _ => None,
                });
                if !report.ends().iter().all(|end| self.crushes_slightly(end.state)) {
                    report.outcome = Outcome::CannotTell;
                }
                report.notes.extend(doubt.map(Note::UnknownWhereSlidingCrushes));
                Ok(report)
            }
        }
    }

    /// Takes in where the path of joints that crush ends, if that is first. Where nothing slides there it is the load of plastic sections
    /// but for what strips leave out. Where joints are cohesive and none crushes, it is first because cohesion is shared out to more
    /// contact points, which has nothing to do with crushing.
    fn take_lower(&self, report: &mut CollapseReport, followed: &End) -> Result<(), AnalysisError> {
        let state = followed.state;
        let by_mesh = is_cohesive(self.analysis) && state.crushed.is_empty();
        if !state.mechanism.slips() || by_mesh || !report.falls_after(followed) {
            return Ok(());
        }
        // Stone that does not crush may fall in the same way.
        let uncrushed = report.at(followed.which).and_then(|end| end.uncrushed).cloned();
        if let Some(end) = uncrushed {
            let mut ending = Ending { end, later: false, at_limits: vec![mechanism::released(&state.mechanism)] };
            self.take_least(&mut ending, sign_of(followed.which))?;
            report.fall_earlier(followed.which, ending.end);
        }
        if !report.falls_after(followed) {
            return Ok(());
        }
        if state.crushed.is_empty() {
            report.fall_earlier(followed.which, state.clone());
        } else {
            report.crushing.on_path[usize::from(followed.which == WhichEnd::Highest)] = Some(state.clone());
        }
        Ok(())
    }

    /// The same question of whole stones whose joints crush on the path.
    fn on_crushing_path(&self) -> Analysis {
        let task = &self.analysis.task;
        let cap = match task {
            Task::Collapse(task) => task.cap,
            Task::Safety(task) => task.cap,
            Task::Settlement(_) | Task::GeometricSafety(_) => None,
        };
        let states = StatesAsked::default();
        let direction = task.direction();
        let task = CollapseTask { direction, cap, method: Method::CrushingPath { least: false }, states, motion: None };
        Analysis { task: Task::Collapse(task), ..plan::of_whole_stones(self.analysis) }
    }

    /// Whether some joint may crush, and plastic sections bear loads of some size.
    fn crushes(&self) -> bool {
        let stands = self.crushing.plastic_section.as_ref().is_some_and(|plastic| plastic.window.is_some());
        stands && self.certificate.theorem.crushes(&self.analysis.structure.joint_strengths())
    }

    /// Whether the forces of a state crush no more than a sliver of any joint.
    fn crushes_slightly(&self, state: &PathEnd) -> bool {
        let structure = &self.analysis.structure;
        let slight = |(thrust, joint): (&Thrust, &Joint)| {
            thrust.normal <= SLIGHT * structure.strength_at(joint) * joint.length()
        };
        !state.thrust_line.is_empty() && state.thrust_line.iter().zip(&structure.joints).all(slight)
    }
}

/// Whether joints slide in a state that governs, or in that of stone that does not crush.
fn slides(report: &CollapseReport) -> bool {
    let states = |end: &End| end.state.mechanism.slips() || end.uncrushed.is_some_and(|path| path.mechanism.slips());
    report.ends().iter().any(states)
}

/// Whether limit analysis governs an end at which joints crush and slide.
fn dilates(end: &End) -> bool {
    end.governed_by == GovernedBy::Crushing && end.state.mechanism.slips() && end.state.range.is_none()
}

/// The direction in which the load factor goes to an end.
fn sign_of(which: WhichEnd) -> f64 {
    if which == WhichEnd::Lowest { -1.0 } else { 1.0 }
}

impl CollapseReport {
    fn at(&self, which: WhichEnd) -> Option<End<'_>> {
        self.ends().into_iter().find(|end| end.which == which)
    }

    /// Whether what governs an end comes after where a path ends.
    fn falls_after(&self, followed: &End) -> bool {
        let now = followed.state.load_factor;
        let after = |before: f64| sign_of(followed.which) * (before - now) > tolerances::SAME_CRUSHING * before.abs();
        self.at(followed.which).is_some_and(|governs| after(governs.state.load_factor))
    }

    /// Takes a state in which stone falls that does not crush, where it comes before the end of the load path.
    fn fall_earlier(&mut self, which: WhichEnd, state: PathEnd) {
        let asked = (which == WhichEnd::Highest) == (self.direction == Direction::Increase);
        let path = if asked { &mut self.end } else { &mut self.other_end };
        let falls_before = |old: &PathEnd| sign_of(which) * (old.load_factor - state.load_factor) <= 0.0;
        if path.as_ref().is_some_and(falls_before) {
            return;
        }
        let old = path.as_ref().and_then(|path| path.range);
        let range = state.range.map(|new| LoadRange { least: new.least, ..old.unwrap_or(new) });
        self.notes.retain(|note| !old.as_ref().is_some_and(|old| *note == range_note(old)));
        self.notes.extend(range.as_ref().map(range_note));
        *path = Some(PathEnd { range, ..state });
        if self.outcome == Outcome::Stands {
            self.outcome = Outcome::Collapse;
        }
    }
}
