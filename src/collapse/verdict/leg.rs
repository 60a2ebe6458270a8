//! One leg of a load path: followed to its end, and the end held against the limit window.

use super::{OnEvent, Setup};
use crate::collapse::certificate::range_note;
use crate::collapse::chain_path::Followed;
use crate::collapse::ending::{self, Ending};
use crate::collapse::path::{Leg, follow};
use crate::collapse::record::{MOST_FIXED_STEPS, Recorder};
use crate::collapse::snapshot::snapshot;
use crate::collapse::state::States;
use crate::collapse::tolerances;
use crate::collapse::yielding::Averaged;
use crate::collapse::{AnalysisError, CollapseReport, Cost, Doubt, LoadRange, Method, Note, Outcome, PathEnd, Task};
use crate::dda::Tracer;

/// Where a leg starts, under these fixed loads on the nodes, and what is known of the path as far.
pub(super) struct LegStart<'l> {
    pub load_factor: f64,
    pub fixed: &'l [f64],
    pub recorder: Recorder<'l>,
}

impl Setup<'_> {
    /// Follows the path one way from the start and writes down what was seen; returns a doubt where path and certificate disagree.
    pub(super) fn leg(
        &self,
        report: &mut CollapseReport,
        states: &mut States,
        tracer: &mut Tracer,
        fixed: &[f64],
        sign: f64,
        progress: &mut OnEvent,
    ) -> Result<Option<Doubt>, AnalysisError> {
        let (analysis, model) = (self.analysis, states.model);
        let averaged = Averaged::asked(analysis, &self.crushing, model).unwrap_or_else(|note| {
            report.notes.extend((sign == self.sign).then_some(note));
            None
        });
        let recorder = Recorder::new(model, analysis, averaged, [self.start, sign]);
        self.leg_from(LegStart { load_factor: self.start, fixed, recorder }, report, states, tracer, progress)
    }

    /// The same of a path that is known to where the leg starts.
    pub(super) fn leg_from(
        &self,
        LegStart { load_factor, fixed, mut recorder }: LegStart,
        report: &mut CollapseReport,
        states: &mut States,
        tracer: &mut Tracer,
        progress: &mut OnEvent,
    ) -> Result<Option<Doubt>, AnalysisError> {
        let before = Cost::of(tracer);
        let leg = follow(tracer, fixed, [load_factor, self.cap], &mut recorder, progress);
        let mut cost = Cost::default();
        cost.add(tracer, before);
        self.end_of_leg(Followed { leg, residual: tracer.worst_residual(), cost }, recorder, report, states)
    }

    /// Writes down what was seen on a leg that has been followed to its end.
    pub(super) fn end_of_leg(
        &self,
        Followed { leg, residual, cost }: Followed,
        recorder: Recorder,
        report: &mut CollapseReport,
        states: &mut States,
    ) -> Result<Option<Doubt>, AnalysisError> {
        let (analysis, model, sign) = (self.analysis, states.model, recorder.sign);
        report.cost.join(cost);
        let at_unit_load = recorder.at(1.0).map(|d| states.find(1.0, d)).transpose()?.flatten();
        report.at_unit_load = at_unit_load.map(|state| snapshot(model, &state)).transpose()?;
        report.crushing.elastic = recorder.yielding.as_ref().map(|found| states.first_yield(found)).transpose()?;
        let mut peak_load = None;
        let (ending, turned_back) = match leg {
            Leg::Stopped => return Err(self.budget.stopped().into()),
            Leg::TooManySteps => return Err(AnalysisError::TooManySteps { most: MOST_FIXED_STEPS }),
            Leg::Lost => return Ok(Some(Doubt::Lost)),
            Leg::Endless => match self.slides_sooner(sign, residual)? {
                None => {
                    report.add_fields(analysis, states, &recorder, None)?;
                    report.history = recorder.history;
                    report.outcome = Outcome::Stands;
                    return Ok(self.certificate.endless(sign, self.cap).or(self.certificate.standing_doubt(residual)));
                }
                Some(end) => {
                    peak_load = Some(end.on_path());
                    (Ending { end, later: false, at_limits: Vec::new() }, false)
                }
            },
            Leg::Criterion(at) => {
                let end = ending::at_criterion(analysis, model, recorder.displacements(), at, residual);
                (Ending { end, later: false, at_limits: Vec::new() }, false)
            }
            Leg::Peak(peak, fall) => {
                let theorem = &self.certificate.theorem;
                let mut ending = ending::at_peak(analysis, model, theorem, &peak, &fall, sign, residual);
                self.budget.check()?;
                peak_load = Some(ending.end.load_factor);
                ending.end.load_factor = self.read_off(ending.end.load_factor, sign);
                if self.looks_for_least() && ending.end.crushed.is_empty() {
                    self.take_least(&mut ending, sign)?;
                }
                (ending, fall.turned_back)
            }
        };
        let near = recorder.near(peak_load.unwrap_or(ending.end.load_factor));
        let near_collapse = near.as_ref().map(|(factor, d)| states.find(*factor, d)).transpose()?.flatten();
        report.near_collapse = near_collapse.map(|state| snapshot(model, &state)).transpose()?;
        report.add_fields(analysis, states, &recorder, near.as_ref())?;
        report.history = recorder.history;
        let doubt = self.conclude(report, ending, sign, turned_back)?;
        Ok(doubt.or(self.certificate.standing_doubt(residual)))
    }

    /// Writes down a collapse, held against the limit window.
    fn conclude(
        &self,
        report: &mut CollapseReport,
        mut ending: Ending,
        sign: f64,
        turned_back: bool,
    ) -> Result<Option<Doubt>, AnalysisError> {
        let path = ending.end.on_path();
        let doubt = match self.analysis.task.method() {
            Method::FixedSteps { step, .. } => {
                let limit = self.certificate.end(sign).unwrap_or(0.0);
                report.notes.push(Note::ReadAtSteps { step, limit });
                None
            }
            Method::EventPath(_) | Method::CrushingPath { .. } => match self.certificate.compare(&ending.end, sign) {
                Err(doubt) => Some(doubt),
                Ok(short) => {
                    // What path and window tell apart there is rounding.
                    if !short && ending.end.range.is_none() && self.certificate.ends_at_zero(sign) {
                        ending.end.load_factor = 0.0;
                    }
                    (turned_back && short && ending.later).then_some(Doubt::TurnedBack(path))
                }
            },
        };
        if let Some(doubt @ (Doubt::TurnedBack(_) | Doubt::Stray { .. })) = &doubt
            && self.crushes_before(&ending.end, sign)
        {
            report.near_collapse = None;
            report.outcome = Outcome::Stands;
            report.notes.push(Note::UnknownBeyondCrushing(doubt.clone()));
            return Ok(None);
        }
        report.notes.extend(ending.later.then_some(Note::LaterMechanism));
        let range = ending.end.range.as_ref().map(range_note);
        let parted = matches!(range, Some(Note::ManySlidingLoads(_))) && ending.end.mechanism.slides.is_empty();
        report.notes.extend(range);
        report.notes.extend(parted.then(|| Note::SlidesParted(ending.end.mechanism.slips_parted().collect())));
        let beside_soil = ending.end.range.is_some() && !self.analysis.structure.passive.is_empty();
        report.notes.extend(beside_soil.then_some(Note::SlidesBesideSoil));
        if self.analysis.task.crushes_on_path() && ending.end.mechanism.slips() && ending.end.range.is_none() {
            let greatest = self.certificate.end(sign).unwrap_or(0.0);
            ending.end.range = Some(LoadRange { least: path, greatest, path, mechanisms_tried: 0 });
            report.notes.push(Note::CrushesAndSlides);
        }
        report.outcome = Outcome::Collapse;
        report.end = Some(ending.end);
        Ok(doubt)
    }

    /// Whether joints of the stone's strength give way at a load below all that the path says of its end, so that what is doubtful
    /// there decides nothing.
    fn crushes_before(&self, end: &PathEnd, sign: f64) -> bool {
        let side = usize::from(sign > 0.0);
        let crushes = self.crushing.plastic_section.as_ref().and_then(|plastic| plastic.ends[side].as_ref());
        let path = end.on_path();
        let least = end.range.as_ref().map_or(path, |range| sign * (sign * range.least).min(sign * path));
        let before = |at: &PathEnd| sign * (least - at.load_factor) > tolerances::SAME_FAILURE * least.abs();
        matches!(self.analysis.task, Task::Collapse(_)) && crushes.is_some_and(before)
    }

    /// The collapse load as the method reads it: exact, or the first whole step beyond.
    fn read_off(&self, load_factor: f64, sign: f64) -> f64 {
        match self.analysis.task.method() {
            Method::EventPath(_) | Method::CrushingPath { .. } => load_factor,
            Method::FixedSteps { step, .. } => {
                let steps = ((load_factor - self.start).abs() / step).floor() + 1.0;
                self.start + sign * steps * step
            }
        }
    }
}
