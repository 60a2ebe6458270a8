//! From the limit window and the load path to one answer, or to saying that we cannot tell.

use super::discretise::{Model, discretise};
use super::path::{ATTEMPTS, Attempt, Leg, Loads, disturb, follow, stand};
use super::record::{Recorder, snapshot};
use super::{
    Analysis, AnalysisError, CollapseReport, Cost, Digits, Direction, LimitWindow, LoadStep, Method, Outcome, PathEnd,
    ThrustRange, Watch, ending, mechanism,
};
use crate::arch::PointForce;
use crate::dda::{End, Tracer};
use crate::limit::StaticTheorem;
use std::ops::ControlFlow;

/// Path and certificate agree when their load factors differ by less than this share.
const AGREES: f64 = 1e-7;
/// The path may pass the limit window by this share before it is disbelieved.
const ABOVE: f64 = 1e-6;
/// By default the load factor is raised until the scaled loads are so many times the fixed ones.
const DEFAULT_CAP: f64 = 1e6;

/// What all attempts share.
struct Question<'a> {
    analysis: &'a Analysis,
    theorem: StaticTheorem,
    window: Option<[f64; 2]>,
    sign: f64,
    start: f64,
    cap: f64,
    /// Sum of all loads at the start, N/m.
    weight: f64,
}

/// One attempt: a report, and why it is not believed, if so.
struct Attempted {
    report: CollapseReport,
    doubt: Option<String>,
}

pub(super) fn run(analysis: &Analysis, watch: &mut dyn Watch) -> Result<CollapseReport, AnalysisError> {
    let question = Question::new(analysis);
    let mut last = None;
    for i in 0..ATTEMPTS {
        let attempted = question.attempt(Attempt::number(i), watch)?;
        if attempted.doubt.is_none() {
            return Ok(attempted.report);
        }
        last = Some(attempted);
    }
    let Some(Attempted { mut report, doubt }) = last else { return Err(AnalysisError::NotFinite { what: "attempts" }) };
    report.outcome = Outcome::CannotTell;
    report.notes.extend(doubt);
    Ok(report)
}

/// Sum of the sizes of all forces, N/m.
fn total(loads: &[PointForce]) -> f64 {
    loads.iter().map(|l| l.force.norm()).sum()
}

impl<'a> Question<'a> {
    fn new(analysis: &'a Analysis) -> Self {
        let theorem = StaticTheorem::new(&analysis.arch, &analysis.fixed, &analysis.scaled);
        let (fixed, scaled) = (total(&analysis.fixed), total(&analysis.scaled));
        let balance = if fixed > 0.0 && scaled > 0.0 { fixed / scaled } else { 1.0 };
        let sign = if analysis.direction == Direction::Increase { 1.0 } else { -1.0 };
        // A corner at 0 comes out of the linear programme as a rounding error.
        let tidy = |end: f64| if end.abs() < 1e-12 * balance { 0.0 } else { end };
        let window = theorem.window().map(|ends| ends.map(tidy));
        let start = first_start(window, fixed > 0.0, sign);
        let (cap, weight) = (analysis.cap.unwrap_or(DEFAULT_CAP * balance), fixed + scaled * start.abs());
        Question { analysis, theorem, window, sign, start, cap, weight }
    }

    /// True where limit analysis finds equilibrium at the start of the path.
    fn expected_to_stand(&self) -> bool {
        self.window.is_some_and(|[low, high]| low <= self.start && self.start <= high)
    }

    /// True where the arch stands at load factor 0.
    fn stands_unloaded(&self) -> bool {
        self.window.is_some_and(|[low, high]| low <= 0.0 && high >= 0.0)
    }

    fn attempt(&self, attempt: Attempt, watch: &mut dyn Watch) -> Result<Attempted, AnalysisError> {
        let analysis = self.analysis;
        let model = discretise(analysis, attempt.seed);
        let exact = Loads { fixed: model.loads(&analysis.fixed), scaled: model.loads(&analysis.scaled) };
        let loads = disturb(&exact, self.start, attempt);
        let mut report = self.blank(&model);
        let mut progress = |load_factor: f64, tracer: &Tracer| {
            let step = LoadStep { load_factor, events: tracer.events() };
            watch.on_step(&step).map_break(|_| ())
        };
        let (mut tracer, end) = stand(&model, &loads, self.start, self.weight, &mut |tracer| {
            progress(self.start * tracer.parameter(), tracer)
        });
        report.cost.events = tracer.events();
        report.cost.factorisations = tracer.factorisations();
        match end {
            End::Stopped => return Err(self.stopped(&tracer)),
            End::Reached => {}
            _ => return Ok(self.fallen(report, &model, &tracer, end)),
        }
        if !self.expected_to_stand() {
            let doubt = "the load path stands where limit analysis finds no equilibrium";
            return Ok(Attempted { report, doubt: Some(doubt.into()) });
        }
        report.at_start = Some(snapshot(&model, self.start, tracer.displacements()));
        if total(&analysis.scaled) == 0.0 {
            report.outcome = Outcome::NeverCollapses;
            report
                .notes
                .push("No load is scaled by the load factor: the answer says only that the arch stands.".into());
            return Ok(Attempted { report, doubt: None });
        }
        let mut other = tracer.clone();
        let mut doubt = self.leg(&mut report, &model, &mut tracer, &loads, self.sign, &mut progress)?;
        if !self.stands_unloaded() {
            let mut opposite = self.blank(&model);
            doubt = doubt.or(self.leg(&mut opposite, &model, &mut other, &loads, -self.sign, &mut progress)?);
            report.other_end = opposite.end;
            report.notes.append(&mut opposite.notes);
            report.cost.events += opposite.cost.events;
            report.cost.factorisations += opposite.cost.factorisations;
        }
        Ok(Attempted { report, doubt })
    }

    /// Follows the path one way and writes down its end; returns a doubt where path and certificate disagree.
    fn leg(
        &self,
        report: &mut CollapseReport,
        model: &Model,
        tracer: &mut Tracer,
        loads: &Loads,
        sign: f64,
        progress: &mut dyn FnMut(f64, &Tracer) -> ControlFlow<()>,
    ) -> Result<Option<String>, AnalysisError> {
        let analysis = self.analysis;
        let crown = mechanism::crown(&analysis.arch);
        let mut recorder = Recorder::new(model, analysis.method, analysis.share, self.start, crown);
        let (events, factorisations) = (tracer.events(), tracer.factorisations());
        let leg = follow(tracer, loads, self.start, sign, self.cap, &mut recorder, &mut |tracer| {
            progress(sign * tracer.parameter(), tracer)
        });
        report.cost.events += tracer.events() - events;
        report.cost.factorisations += tracer.factorisations() - factorisations;
        report.at_unit_load = recorder.at_one.as_ref().map(|d| snapshot(model, 1.0, d));
        let end = match leg {
            Leg::Stopped => return Err(self.stopped(tracer)),
            Leg::Lost => return Ok(Some("the load path could not be followed to its end".into())),
            Leg::Endless => {
                report.history = recorder.history;
                report.outcome = self.outcome(false);
                return Ok(self.endless(sign));
            }
            Leg::Criterion(load_factor) => {
                let displacements = recorder.displacements();
                ending::at_fall(analysis, model, displacements, load_factor, tracer.worst_residual())
            }
            Leg::Peak(peak) => ending::at_peak(analysis, model, &self.theorem, &peak, sign, tracer.worst_residual()),
        };
        let near = recorder.near(end.load_factor);
        report.near_collapse = near.map(|(factor, d)| snapshot(model, factor, &d));
        report.history = recorder.history;
        report.outcome = self.outcome(true);
        let doubt = self.compare(&end, sign, &mut report.notes);
        report.end = Some(end);
        Ok(doubt)
    }

    fn outcome(&self, collapses: bool) -> Outcome {
        match (self.stands_unloaded(), collapses) {
            (false, _) => Outcome::StandsInWindow,
            (true, true) => Outcome::Collapse,
            (true, false) => Outcome::NeverCollapses,
        }
    }

    /// Holds the collapse load against the limit window.
    fn compare(&self, end: &PathEnd, sign: f64, notes: &mut Vec<String>) -> Option<String> {
        let limit = self.window.map_or(0.0, |[low, high]| if sign > 0.0 { high } else { low });
        if self.analysis.method != Method::EventPath {
            return None;
        }
        let scale = limit.abs().max(end.load_factor.abs()).max(1e-6 * self.theorem.load_factor_scale());
        let short = sign * (limit - end.load_factor) / scale;
        let (path, edge) = (Digits(end.load_factor), Digits(limit));
        if short < -ABOVE {
            return Some(format!("the load path passes the limit window (load factor {path} against {edge})"));
        }
        if short <= AGREES {
            return None;
        }
        if end.mechanism.slides.is_empty() {
            return Some(format!(
                "the load path ends at load factor {path} without sliding, short of the limit window's end {edge}"
            ));
        }
        notes.push(format!(
            "Joints slide without dilating, so the arch falls at load factor {path} although limit analysis, which lets \
             sliding joints dilate (associated friction), allows {edge}. With sliding the answer depends on the \
             stiffness of the joints and on the order of loading by a few per cent. Of the two use {path}, which \
             leaves the arch less room."
        ));
        None
    }

    /// Nothing happened up to the cap; that is believed if the limit window says so too.
    fn endless(&self, sign: f64) -> Option<String> {
        let limit = self.window.map_or(0.0, |[low, high]| if sign > 0.0 { high } else { low });
        let edge = Digits(limit);
        (sign * limit < self.cap).then(|| format!("the load path passes the limit window's end {edge} and goes on"))
    }

    /// The arch did not stand under its loads at the start.
    fn fallen(&self, mut report: CollapseReport, model: &Model, tracer: &Tracer, end: End) -> Attempted {
        let Some(peak) = tracer.peak().filter(|_| end == End::Mechanism) else {
            return Attempted { report, doubt: Some("the loads could not be brought on".into()) };
        };
        // Without fixed loads the smallest load factor is one too many.
        let load_factor = if total(&self.analysis.fixed) > 0.0 { self.start } else { 0.0 };
        let fall = ending::at_fall(self.analysis, model, &peak.direction, load_factor, tracer.worst_residual());
        let slides = !fall.mechanism.slides.is_empty();
        report.end = Some(fall);
        report.outcome = Outcome::FallsAsBuilt;
        let doubt = if !self.expected_to_stand() {
            None
        } else if slides {
            Some("sliding without dilatancy lets the arch fall where limit analysis finds equilibrium".into())
        } else {
            Some("the arch falls under loads for which limit analysis finds equilibrium".into())
        };
        Attempted { report, doubt }
    }

    fn stopped(&self, tracer: &Tracer) -> AnalysisError {
        AnalysisError::Stopped { load_factor: tracer.parameter(), events: tracer.events() }
    }

    fn blank(&self, model: &Model) -> CollapseReport {
        let thrust = if total(&self.analysis.fixed) > 0.0 { self.theorem.thrust_range(0.0) } else { None };
        CollapseReport {
            outcome: Outcome::CannotTell,
            limit_window: self.window.map(|[lowest, highest]| LimitWindow { lowest, highest }),
            thrust_range: thrust.map(|[lowest, highest]| ThrustRange { lowest, highest }),
            end: None,
            other_end: None,
            start: self.start,
            cap: self.cap,
            share: self.analysis.share,
            near_collapse: None,
            at_unit_load: None,
            at_start: None,
            history: Vec::new(),
            cost: Cost { unknowns: 6 * model.chain.blocks().len(), ..Cost::default() },
            notes: Vec::new(),
        }
    }
}

/// Where the path starts: unloaded where that stands, else inside the limit window.
fn first_start(window: Option<[f64; 2]>, any_fixed: bool, sign: f64) -> f64 {
    match window {
        // Without fixed loads nothing is known of the contacts at 0; where the window has no end, or only 0, every
        // load factor of one sign is like any other.
        _ if !any_fixed => {
            let end = window.map_or(0.0, |[low, high]| if sign > 0.0 { high } else { low });
            if end.is_finite() && end != 0.0 { 0.5 * end } else { sign }
        }
        None => 0.0,
        Some([low, high]) if low <= 0.0 && high >= 0.0 => 0.0,
        Some([low, high]) if low.is_finite() && high.is_finite() => 0.5 * (low + high),
        Some([low, _]) if low.is_finite() => 2.0 * low,
        Some([_, high]) => 2.0 * high,
    }
}
