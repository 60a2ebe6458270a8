//! Where joints slide and stone crushes: the load path on which they do both.
//!
//! Limit analysis lets joints dilate as they slide, and so bounds from above alone what they bear that crush. The least load at which
//! joints slide without dilating is that of stone that does not crush. The path may end far below both: rings upon each other lost a
//! tenth by it in the median, and two thirds at most (33 random bridges). So it is followed, too, and governs where it ends first.

use super::{Setup, is_cohesive};
use crate::collapse::certificate::range_note;
use crate::collapse::discretise::Discretisation;
use crate::collapse::{
    Analysis, AnalysisError, CollapseReport, CollapseTask, Direction, End, GovernedBy, LoadRange, Method, Note,
    Outcome, PathEnd, StatesAsked, Task, Thrust, WhichEnd, plan, tolerances,
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
                let cohesive = is_cohesive(self.analysis);
                path.ends().into_iter().for_each(|end| report.take_lower(end, cohesive));
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
        let task = CollapseTask { direction, cap, method: Method::CrushingPath, states, motion: None };
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

impl CollapseReport {
    /// Takes in where the path of joints that crush ends, if that is first. Where nothing slides there it is the load of plastic sections
    /// but for what strips leave out. Where joints are `cohesive` and none crushes, it is first because cohesion is shared out to more
    /// contact points, which has nothing to do with crushing.
    fn take_lower(&mut self, end: End, cohesive: bool) {
        let (side, sign) = if end.which == WhichEnd::Lowest { (0, -1.0) } else { (1, 1.0) };
        let lower = |governs: &End| {
            let (before, now) = (governs.state.load_factor, end.state.load_factor);
            governs.which == end.which && sign * (before - now) > tolerances::SAME_CRUSHING * before.abs()
        };
        let by_mesh = cohesive && end.state.crushed.is_empty();
        if !end.state.mechanism.slips() || by_mesh || !self.ends().iter().any(lower) {
            return;
        }
        if !end.state.crushed.is_empty() {
            self.crushing.on_path[side] = Some(end.state.clone());
            return;
        }
        // Nothing has crushed where it ends: that is a load of stone that does not.
        let asked = (sign > 0.0) == (self.direction == Direction::Increase);
        let path = if asked { &mut self.end } else { &mut self.other_end };
        let old = path.as_ref().and_then(|path| path.range);
        let range = end.state.range.map(|new| LoadRange { least: new.least, ..old.unwrap_or(new) });
        self.notes.retain(|note| !old.as_ref().is_some_and(|old| *note == range_note(old)));
        self.notes.extend(range.as_ref().map(range_note));
        *path = Some(PathEnd { range, ..end.state.clone() });
        if self.outcome == Outcome::Stands {
            self.outcome = Outcome::Collapse;
        }
    }
}
