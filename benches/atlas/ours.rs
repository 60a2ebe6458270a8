//! The event path on one scene, held against the judge.

use super::judge::{EQUAL, Mark, Truth, slides};
use super::maps::Scene;
use super::moving;
use crate::common::door;
use crate::common::verify::said;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;
use voussoir::budget::Budget;
use voussoir::collapse::{Analysis, CollapseReport, Outcome, Task, run};
use voussoir::structure::{Joint, JointLaw};

/// What our method made of a scene.
#[derive(Debug, Clone)]
pub struct Ours {
    pub mark: Mark,
    pub outcome: Option<Outcome>,
    pub load_factor: Option<f64>,
    /// Joints that slide at collapse.
    pub slides: usize,
    /// Where joints slide: how far the answer is from a full solution, see [`Truth::motion_fault`].
    pub motion_fault: Option<f64>,
    /// Where joints slide: least and greatest load factor over penalties and seeds.
    pub interval: Option<[f64; 2]>,
    /// Analyses run, and of those that panicked.
    pub runs: usize,
    pub panics: usize,
    /// Of the slowest of them.
    pub seconds: f64,
    pub events: usize,
}

/// Penalty ratios over which an answer with sliding is repeated.
const PENALTIES: [f64; 3] = [0.1, 1.0, 100.0];
/// Friction is changed by such shares, one seed each, for an answer with sliding.
const SEEDS: [f64; 2] = [1e-9, -1e-9];

/// Runs an analysis; the words of a panic or an error in place of a report.
fn timed(analysis: &Analysis) -> (Result<CollapseReport, (bool, String)>, f64) {
    let start = Instant::now();
    let result = catch_unwind(AssertUnwindSafe(|| run(analysis, &Budget::unlimited())));
    let result = match result {
        Err(panic) => Err((true, format!("panic: {}", said(&*panic)))),
        Ok(Err(error)) => Err((false, error.to_string())),
        Ok(Ok(report)) => Ok(report),
    };
    (result, start.elapsed().as_secs_f64())
}

/// Runs and judges a scene.
pub fn ours(scene: &Scene, analysis: &Analysis, truth: &Truth) -> Ours {
    let mut ours = Ours {
        mark: Mark::Open,
        outcome: None,
        load_factor: None,
        slides: 0,
        motion_fault: None,
        interval: None,
        runs: 0,
        panics: 0,
        seconds: 0.0,
        events: 0,
    };
    let Some(report) = ours.one(analysis, truth) else { return ours };
    let Some(end) = report.end.as_ref().filter(|end| slides(end)) else { return ours };
    let falls = matches!(report.outcome, Outcome::Collapse | Outcome::StandsInWindow);
    if !falls || !matches!(analysis.task, Task::Collapse(_)) || analysis.task.motion().is_some() {
        return ours;
    }
    ours.motion_fault = Some(truth.motion_fault(analysis, end));
    let others = PENALTIES.iter().filter(|ratio| **ratio != scene.penalty_ratio);
    let stiff = others.map(|&penalty_ratio| Analysis { penalty_ratio, ..analysis.clone() });
    let stiff: Vec<(Analysis, Truth)> = stiff.map(|other| (other, truth.clone())).collect();
    let seeds = SEEDS.iter().map(|share| rougher(analysis, 1.0 + share));
    let seeds = seeds.map(|other| (other.clone(), Truth::of(door::problem(&other))));
    let mut interval = [end.load_factor; 2];
    for (other, truth) in stiff.into_iter().chain(seeds) {
        let before = ours.clone();
        let again = ours.one(&other, &truth);
        let found = again.and_then(|report| report.end).map(|end| end.load_factor);
        if let Some(found) = found.filter(|_| !matches!(ours.mark, Mark::Wrong(_) | Mark::GaveUp(_))) {
            interval = [interval[0].min(found), interval[1].max(found)];
        }
        // What the scene itself gets stays; a wrong number anywhere is a wrong number.
        let worse = if matches!(ours.mark, Mark::Wrong(_)) { ours.mark.clone() } else { before.mark.clone() };
        (ours.mark, ours.outcome) = (worse, before.outcome);
        (ours.load_factor, ours.slides) = (before.load_factor, before.slides);
    }
    ours.interval = Some(interval);
    ours
}

impl Ours {
    /// One run, counted and judged.
    fn one(&mut self, analysis: &Analysis, truth: &Truth) -> Option<CollapseReport> {
        let (result, seconds) = timed(analysis);
        self.runs += 1;
        self.seconds = self.seconds.max(seconds);
        match result {
            Err((panicked, words)) => {
                self.panics += usize::from(panicked);
                self.mark = if panicked { Mark::Wrong(words) } else { Mark::GaveUp(words) };
                None
            }
            Ok(report) => {
                self.mark = match analysis.task {
                    Task::Settlement(_) => moving::judge_settlement(analysis, &report, truth),
                    _ => truth.judge(analysis, &report),
                };
                if analysis.task.motion().is_some() && self.mark == Mark::Right {
                    self.mark = moving::judge_motion(analysis, &report);
                }
                self.outcome = Some(report.outcome);
                self.load_factor = report.end.as_ref().map(|end| end.load_factor);
                self.slides = report.end.as_ref().map_or(0, |end| end.mechanism.slides.len());
                self.events = report.cost.events;
                Some(report)
            }
        }
    }

    /// The load factors that count as right for a method that is content with a hundredth.
    pub fn accepted(&self, truth: &Truth, sign: f64) -> Option<[f64; 2]> {
        let limit = truth.limit(sign)?;
        Some(self.interval.unwrap_or([limit; 2])).filter(|_| truth.apart(limit, limit) <= EQUAL)
    }
}

/// The same arch with friction changed by a factor.
fn rougher(analysis: &Analysis, factor: f64) -> Analysis {
    let mut other = analysis.clone();
    let joints: Vec<Joint> = other
        .structure
        .joints
        .iter()
        .map(|joint| {
            let law = match joint.law {
                JointLaw::Dry { friction, cohesion } => JointLaw::Dry { friction: factor * friction, cohesion },
                other => other,
            };
            Joint { law, ..*joint }
        })
        .collect();
    other.structure.joints = joints;
    other
}
