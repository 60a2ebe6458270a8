//! The answer by the force method: states solved for one by one, and of the load path only the last of the way to collapse, or all of it
//! where its history is asked for.
//!
//! Limit analysis says how far the loads go. The path is followed by the contact law alone, and has to end where limit analysis says,
//! without sliding; its last way is traced where the force method does not tell it. Where anything is missed or in doubt, or joints
//! slide, on which states depend, the path that is traced from the unstressed start tells.

use super::leg::LegStart;
use super::{OnEvent, Setup};
use crate::collapse::chain_path::follow_chain;
use crate::collapse::discretise::Model;
use crate::collapse::path::{from_state, nothing_grows, total};
use crate::collapse::record::Recorder;
use crate::collapse::snapshot::snapshot;
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
        if analysis.task.yields(&self.crushing) || !exact || !stands {
            return Ok(None);
        }
        let Some(method) = ForceMethod::new(&model.assembly, self.budget)? else { return Ok(None) };
        let loads = [&model.fixed.on_nodes[..], &model.scaled.on_nodes];
        let chain = method.loaded(model.assembly.exact_contacts(), loads);
        let on_path = method.loaded(model.assembly.contacts(), [fixed, loads[1]]);
        let mut states = States::of_chain(model, chain);
        let states_from = if analysis.task.history() { StatesFrom::LoadPath } else { StatesFrom::DirectSolution };
        let mut report = CollapseReport { states_from, ..self.blank(model.assembly.unknowns()) };
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
        let (analysis, history) = (self.analysis, self.analysis.task.history());
        let recorder = || {
            let mut recorder = Recorder::new(model, analysis, None, [self.start, sign]);
            recorder.asked_before(near).into_iter().for_each(|at| recorder.know(at, &[]));
            recorder
        };
        // The whole path tells for itself that no joint slides.
        let exact = if history { states.of_the_chain(self.start)? } else { states.on_the_way(self.start, near)? };
        let Some(exact) = exact else { return Ok(false) };
        let from = exact.load_factor;
        let Some(state) = on_path.state(from, Some(&exact), self.budget)? else { return Ok(false) };
        let mut seen = recorder();
        let doubt = match follow_chain(model, on_path, &state, [self.cap, self.weight], &mut seen)? {
            Some(followed) => self.end_of_leg(followed, seen, report, states)?,
            None if history => return Ok(false),
            None => {
                let [fixed, _] = on_path.loads();
                let mut tracer = from_state(model, fixed, from, self.weight, &on_path.displacements(&state));
                let start = LegStart { load_factor: from, fixed, recorder: recorder() };
                self.leg_from(start, report, states, &mut tracer, progress)?
            }
        };
        let falls = report.end.as_ref().is_some_and(|end| end.range.is_none() && !end.mechanism.slips());
        Ok(doubt.is_none() && falls && !states.missed_some())
    }
}
