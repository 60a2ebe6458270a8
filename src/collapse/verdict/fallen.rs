//! Arches that do not stand where the load path starts.

use super::{Attempted, Setup};
use crate::collapse::certificate::{Fell, any_fixed};
use crate::collapse::discretise::Model;
use crate::collapse::{AnalysisError, CollapseReport, Doubt, LoadRange, Note, Outcome, PathEnd, Task, ending, motion};
use crate::dda::Tracer;

/// What slides by less than this share of what hinges open by may only be strained (measured: a thousandth).
const STRAIN: f64 = 1e-2;

impl Setup<'_> {
    /// The arch did not stand under its loads at the start.
    pub(super) fn fallen(
        &self,
        mut report: CollapseReport,
        model: &Model,
        tracer: &Tracer,
    ) -> Result<Attempted, AnalysisError> {
        // Without fixed loads the smallest load factor is one too many.
        let load_factor = if any_fixed(self.analysis) { self.start } else { 0.0 };
        let mut fall = ending::at_fall(self.analysis, model, tracer, self.start, load_factor);
        fall.range = self.range_of(&fall);
        let fell = Fell {
            at: self.start,
            sign: self.sign,
            power: motion::power(self.analysis, &fall.mechanism, self.start),
            slides: self.slides_in(&fall),
        };
        let doubt = self.certificate.fallen(fell, self.budget);
        self.budget.check()?;
        let doubt = doubt.or(self.certificate.standing_doubt(fall.residual));
        if self.certificate.ends_at_zero(self.sign) {
            report.notes.extend(doubt.is_none().then_some(Note::FallsFromZero));
            return Ok(Attempted { report: self.at_zero(report, fall), doubt });
        }
        let safety = matches!(self.analysis.task, Task::Safety(_));
        report.notes.extend(self.certificate.out_of_reach(self.start, safety));
        let slides = doubt == Some(Doubt::SlidesInside);
        report.outcome = if slides { Outcome::SlidesAsBuilt } else { Outcome::FallsAsBuilt };
        report.end = Some(fall);
        Ok(Attempted { report, doubt })
    }

    /// The answer, in doubt, where some stone has slid out of its joint as the loads at the start came on and limit analysis finds
    /// equilibrium there: by small displacements it may stand far away, but rounding blurs what follows.
    pub(super) fn slid_out(&self, before: &CollapseReport, model: &Model, tracer: &Tracer) -> Option<Attempted> {
        let (analysis, displacements) = (self.analysis, tracer.displacements());
        let stands = self.certificate.stands_at(self.start) && !self.certificate.ends_at_zero(self.sign);
        if !any_fixed(analysis) || !stands || !ending::slid_out(model, &analysis.structure, displacements) {
            return None;
        }
        let mut fall = ending::at_criterion(analysis, model, displacements, self.start, tracer.worst_residual());
        if !self.slides_in(&fall) {
            return None;
        }
        (fall.range, fall.thrust_line) = (self.range_of(&fall), Vec::new());
        let mut report = self.blank(before.cost.unknowns);
        (report.notes, report.outcome, report.end) = (before.notes.clone(), Outcome::SlidesAsBuilt, Some(fall));
        Some(Attempted { report, doubt: Some(Doubt::SlidesInside) })
    }

    /// Whether joints slide in a fall by more than stones strain.
    fn slides_in(&self, fall: &PathEnd) -> bool {
        let joints = &self.analysis.structure.joints;
        let openings = fall.mechanism.hinges.iter().map(|hinge| hinge.rotation * joints[hinge.joint].length());
        let least = STRAIN * openings.fold(0.0, f64::max);
        fall.mechanism.slides.iter().any(|slide| slide.rate.abs() > least)
    }

    /// Where it slides although limit analysis finds equilibrium: the load at which it fell, and the window's end.
    fn range_of(&self, fall: &PathEnd) -> Option<LoadRange> {
        let greatest = self.certificate.end(self.sign).filter(|_| self.certificate.stands_at(fall.load_factor))?;
        let (least, path) = (fall.load_factor, fall.load_factor);
        self.slides_in(fall).then_some(LoadRange { least, greatest, path, mechanisms_tried: 0 })
    }

    /// The arch stands at load factor 0, and at none beyond it, where it fell.
    fn at_zero(&self, mut report: CollapseReport, fall: PathEnd) -> CollapseReport {
        let thrust_line = match any_fixed(self.analysis) {
            true => Vec::new(),
            false => ending::no_thrust(&self.analysis.structure),
        };
        report.outcome = Outcome::Collapse;
        report.end = Some(PathEnd { load_factor: 0.0, thrust_line, ..fall });
        report
    }
}
