//! The answer without the load path: states solved for one by one, and only the last of the way to collapse followed.
//!
//! Limit analysis says how far the loads go. The states that are reported are found by the force method; the load path is followed from
//! the one near collapse on, by the contact law alone, and has to end where limit analysis says, without sliding. Where anything is
//! missed or in doubt, or joints slide, on which states depend, the path from the unstressed start tells.

use super::leg::LegStart;
use super::{OnEvent, Setup};
use crate::collapse::discretise::Model;
use crate::collapse::path::{from_state, nothing_grows, total};
use crate::collapse::record::{Recorder, snapshot};
use crate::collapse::state::States;
use crate::collapse::verdict::notes_on_mesh;
use crate::collapse::{AnalysisError, CollapseReport, Method, Outcome, StatesFrom};
use crate::dda::{ForceMethod, Loaded};

impl Setup<'_> {
    /// The answer; none where the path from the unstressed start has to be followed.
    pub(super) fn directly(
        &self,
        model: &Model,
        fixed: &[f64],
        progress: &mut OnEvent,
    ) -> Result<Option<CollapseReport>, AnalysisError> {
        let analysis = self.analysis;
        let exact = matches!(analysis.task.method(), Method::EventPath(_));
        let stands = self.certificate.solved && self.certificate.stands_at(self.start);
        if analysis.task.history() || analysis.task.yields(&self.crushing) || !exact || !stands {
            return Ok(None);
        }
        let Some(method) = ForceMethod::new(&model.assembly, self.budget)? else { return Ok(None) };
        let loads = [&model.fixed.on_nodes[..], &model.scaled.on_nodes];
        let chain = method.loaded(model.assembly.exact_contacts(), loads);
        let on_path = method.loaded(model.assembly.contacts(), [fixed, loads[1]]);
        let mut states = States::of_chain(model, chain);
        let mut report =
            CollapseReport { states_from: StatesFrom::DirectSolution, ..self.blank(model.assembly.unknowns()) };
        report.notes = notes_on_mesh(analysis, model);
        let at_start = states.find(self.start, &[])?;
        report.at_start = at_start.as_ref().map(|state| snapshot(model, state)).transpose()?;
        if states.missed_some() {
            return Ok(None);
        }
        if nothing_grows(model, total(&analysis.scaled)) {
            self.stands_still(&mut report, model, at_start)?;
        } else {
            let both_ways = self.goes_both_ways();
            if !self.leg_directly(&mut report, &mut states, &on_path, self.sign, progress)? {
                return Ok(None);
            }
            if both_ways {
                report.outcome = Outcome::StandsInWindow;
                let mut other = self.blank(model.assembly.unknowns());
                if !self.leg_directly(&mut other, &mut states, &on_path, -self.sign, progress)? {
                    return Ok(None);
                }
                report.join_other_end(other);
            }
        }
        let missed = states.missed_some();
        let doubt = states.tell(&mut report);
        Ok((!missed && doubt.is_none()).then_some(report))
    }

    /// Finds the states on one way to collapse, and follows the path from the one near it; false where that does not tell.
    fn leg_directly(
        &self,
        report: &mut CollapseReport,
        states: &mut States,
        on_path: &Loaded,
        sign: f64,
        progress: &mut OnEvent,
    ) -> Result<bool, AnalysisError> {
        let model = states.model;
        let Some(end) = self.certificate.end(sign).filter(|end| sign * end < self.cap) else { return Ok(false) };
        let near = self.start + self.analysis.task.share() * (end - self.start);
        if sign * (near - self.start) <= 0.0 {
            return Ok(false);
        }
        let mut recorder = Recorder::new(model, self.analysis, None, [self.start, sign]);
        recorder.asked_before(near).into_iter().for_each(|at| recorder.know(at, &[]));
        let Some(state) = states.on_the_way(self.start, near)? else { return Ok(false) };
        let Some(state) = on_path.state(near, Some(state), self.budget)? else { return Ok(false) };
        let [fixed, _] = on_path.loads();
        let mut tracer = from_state(model, fixed, near, self.weight, &on_path.displacements(&state));
        let start = LegStart { load_factor: near, fixed, recorder };
        let doubt = self.leg_from(start, report, states, &mut tracer, progress)?;
        let falls = report.end.as_ref().is_some_and(|end| end.range.is_none() && !end.mechanism.slips());
        Ok(doubt.is_none() && falls && !states.missed_some())
    }
}
