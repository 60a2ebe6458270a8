//! What becomes of a structure that stands, as it deforms or its supports move.

use super::Setup;
use crate::collapse::discretise::Discretisation;
use crate::collapse::path::total;
use crate::collapse::updated::{self, Course};
use crate::collapse::{
    AnalysisError, CollapseReport, Geometry, Note, Outcome, SettlementEnd, SupportMovement, TaskReport,
    UpdatedGeometry, cracks, safety, settlement,
};

impl<'a> Setup<'a> {
    /// The answer on moving geometry, where it is asked for and the arch stands at first order.
    pub(super) fn updated(
        &self,
        report: &mut CollapseReport,
        built: &mut Discretisation<'a>,
    ) -> Result<Option<UpdatedGeometry>, AnalysisError> {
        let stands = report.at_start.is_some() && report.outcome != Outcome::CannotTell;
        if self.analysis.task.geometry() == Geometry::FirstOrder || !stands || !self.analysis.task.grows() {
            return Ok(None);
        }
        let (start, sign, cap, weight) = (self.start, self.sign, self.cap, self.weight);
        let as_much = weight / total(&self.analysis.scaled).max(f64::MIN_POSITIVE);
        let rise = report.end.as_ref().map_or(as_much, |end| (end.on_path() - start).abs());
        let course = Course { start, sign, cap, rise, ends: report.end.is_some(), weight };
        updated::follow(self.analysis, course, &mut report.cost, built).map(Some)
    }

    /// What becomes of a standing structure as its supports move.
    pub(super) fn settle(
        &self,
        report: &mut CollapseReport,
        movements: &[SupportMovement],
        built: &mut Discretisation<'a>,
    ) -> Result<(), AnalysisError> {
        safety::crushed(report, false);
        if report.at_start.is_none() || report.outcome == Outcome::CannotTell {
            return Ok(());
        }
        let settlement = settlement::follow(self.analysis, movements, self.weight, &mut report.cost, built)?;
        let shared =
            settlement.as_ref().and_then(|report| cracks::shared(&self.analysis.structure, &report.first_order));
        report.notes.extend(shared.map(Note::CracksShared));
        if report.outcome != Outcome::Crushes {
            report.outcome = match settlement.as_ref().map(|s| s.updated.as_ref().unwrap_or(&s.first_order).end) {
                Some(SettlementEnd::Follows) => Outcome::FollowsMovement,
                Some(SettlementEnd::Collapse | SettlementEnd::FallsAsLoaded) => Outcome::FallsByMovement,
                Some(SettlementEnd::CannotTell) | None => Outcome::CannotTell,
            };
        }
        report.task = TaskReport::Settlement(settlement.map(Box::new));
        Ok(())
    }
}
