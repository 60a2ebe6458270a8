//! One random arch through the front door, held against the criteria and the oracle.

use super::largest::larger;
use super::{door, motion, oracle::Problem, random_arch};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;
use voussoir::budget::Budget;
use voussoir::collapse::{Analysis, CollapseReport, Direction, LimitWindow, Outcome, PathEnd, run};

/// The intensity may pass the limit window by this share.
pub const ABOVE: f64 = 1e-6;
/// Where no joint slides the intensity equals the end of the limit window to this share.
pub const EQUAL: f64 = 1e-7;
/// Limit window and oracle agree to this share.
pub const WINDOW: f64 = 1e-7;
/// Equilibrium residual, share of the weight.
pub const RESIDUAL: f64 = 1e-8;
/// A mechanism opens joints only, and without sliding its loads do no work, to this share.
pub const MOTION: f64 = 1e-6;
/// Closer than this to standing or falling the oracle itself cannot say which.
const BALANCE: f64 = 1e-8;
/// Load factors below this share of (fixed loads / scaled loads) are compared absolutely.
const SMALL: f64 = 1e-3;

/// What was measured on one arch.
#[derive(Debug, Default, Clone)]
pub struct Checked {
    pub seed: u64,
    pub outcome: Option<Outcome>,
    /// How far the intensity lies above the limit window, relative; at most zero if it does not.
    pub excess: Option<f64>,
    /// How far it lies from the window's end where no joint slides, relative.
    pub deviation: Option<f64>,
    /// Intensity over the window's end where joints slide.
    pub ratio: Option<f64>,
    /// Difference between limit window and oracle, relative.
    pub window_error: Option<f64>,
    pub residual: f64,
    /// See [`motion::Motion`].
    pub entering: f64,
    pub power: f64,
    pub voussoirs: usize,
    pub events: usize,
    pub seconds: f64,
    /// Everything that is wrong.
    pub complaints: Vec<String>,
}

/// Runs the arch of a seed; `with_oracle` compares the window too.
pub fn check(seed: u64, with_oracle: bool) -> Checked {
    let mut checked = Checked { seed, ..Checked::default() };
    let request = random_arch::request(seed);
    let analysis = match door::analysis(&request) {
        Ok(analysis) => analysis,
        Err(faults) => {
            checked.complaints.push(format!("refused: {faults}"));
            return checked;
        }
    };
    checked.voussoirs = analysis.structure.voussoirs().len();
    let start = Instant::now();
    let result = catch_unwind(AssertUnwindSafe(|| run(&analysis, &Budget::unlimited())));
    checked.seconds = start.elapsed().as_secs_f64();
    match result {
        Err(panic) => checked.complaints.push(format!("panic: {}", said(&*panic))),
        Ok(Err(error)) => checked.complaints.push(format!("error: {error}")),
        Ok(Ok(report)) => {
            checked.measure(&analysis, &report);
            if with_oracle && let Err(panic) = catch_unwind(AssertUnwindSafe(|| checked.compare(&analysis, &report))) {
                checked.complaints.push(format!("oracle: {}", said(&*panic)));
            }
        }
    }
    checked
}

/// The words of a panic.
pub fn said(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no words").to_owned()
}

/// Fixed over scaled loads: the size of a load factor that matters.
fn balance(analysis: &Analysis) -> f64 {
    let total = |forces: &[voussoir::structure::PointForce]| forces.iter().map(|f| f.force.norm()).sum::<f64>();
    let (fixed, scaled) = (total(&analysis.fixed), total(&analysis.scaled));
    if fixed > 0.0 && scaled > 0.0 { fixed / scaled } else { 1.0 }
}

/// The oracle's window of stone that crushes.
fn crushed(problem: Problem, report: &CollapseReport) -> Option<[f64; 2]> {
    problem.of_strength(report.crushing.strength).window().map(|(low, high)| [low, high])
}

/// Difference of two load factors, relative; infinities equal themselves.
fn relative(a: f64, b: f64, floor: f64) -> f64 {
    if a == b { 0.0 } else { (a - b).abs() / a.abs().max(b.abs()).max(floor) }
}

impl Checked {
    fn expect(&mut self, holds: bool, words: impl FnOnce() -> String) {
        if !holds {
            self.complaints.push(words());
        }
    }

    fn measure(&mut self, analysis: &Analysis, report: &CollapseReport) {
        self.outcome = Some(report.outcome);
        self.events = report.cost.events;
        let cannot = report.outcome == Outcome::CannotTell;
        self.expect(!cannot, || {
            let window = report.limit_window.map(|w| (w.lowest, w.highest));
            format!("cannot tell: {:?} (limit window {window:?}, start {})", report.notes, report.start)
        });
        let sign = if analysis.task.direction() == Direction::Increase { 1.0 } else { -1.0 };
        let Some(window) = report.limit_window else { return };
        for (end, sign) in [(&report.end, sign), (&report.other_end, -sign)] {
            if let Some(end) = end {
                self.measure_end(analysis, window, end, sign, cannot);
            }
        }
    }

    fn measure_end(&mut self, analysis: &Analysis, window: LimitWindow, end: &PathEnd, sign: f64, cannot: bool) {
        self.residual = larger(self.residual, end.residual);
        self.expect(end.residual <= RESIDUAL, || format!("residual {:e}", end.residual));
        if cannot {
            return;
        }
        self.measure_motion(analysis, end, sign);
        let limit = if sign > 0.0 { window.highest } else { window.lowest };
        if limit.is_infinite() {
            let explained = end.mechanism.slips();
            self.expect(explained, || format!("falls at {} without sliding, window {limit}", end.load_factor));
            return;
        }
        let floor = SMALL * balance(analysis);
        let excess = sign * (end.load_factor - limit) / limit.abs().max(floor);
        self.excess = Some(self.excess.unwrap_or(f64::NEG_INFINITY).max(excess));
        self.expect(excess <= ABOVE, || format!("{:e} above the window {limit}", excess));
        if !end.mechanism.slips() {
            self.deviation = Some(self.deviation.unwrap_or(0.0).max(excess.abs()));
            self.expect(excess.abs() <= EQUAL, || format!("{excess:e} off the window {limit} without sliding"));
        } else if limit.abs() > floor {
            self.ratio = Some(self.ratio.unwrap_or(1.0).min(end.load_factor / limit));
        }
    }

    fn measure_motion(&mut self, analysis: &Analysis, end: &PathEnd, sign: f64) {
        let centroids: Vec<_> = analysis.structure.voussoirs().iter().map(|v| v.region.centroid.into()).collect();
        if end.mechanism.velocities.len() != centroids.len() {
            return self.complaints.push("the mechanism has no velocities".into());
        }
        let motion = motion::measure(&door::problem(analysis), &centroids, &end.mechanism, end.load_factor);
        self.entering = larger(self.entering, motion.entering);
        // Where joints slide the peak of the path need not be a mechanism (no normality): measured, not judged.
        if !end.mechanism.slips() {
            self.expect(motion.entering <= MOTION, || {
                format!("stones enter each other in the mechanism, {:e}", motion.entering)
            });
            self.power = larger(self.power, motion.power.abs());
            self.expect(motion.power.abs() <= MOTION, || format!("loads do work in the mechanism, {:e}", motion.power));
            self.expect(sign * motion.driving > 0.0, || format!("scaled loads do work {:e}", motion.driving));
        }
    }

    fn compare(&mut self, analysis: &Analysis, report: &CollapseReport) {
        let problem: Problem = door::problem(analysis);
        let give = problem.give();
        if give.abs() <= BALANCE {
            return;
        }
        let oracle = if give < 0.0 { problem.window() } else { None };
        let floor = SMALL * balance(analysis);
        match (oracle, report.limit_window) {
            (None, None) => {}
            (Some((low, high)), Some(window)) => {
                let error = larger(relative(low, window.lowest, floor), relative(high, window.highest, floor));
                self.window_error = Some(error);
                self.expect(error <= WINDOW, || {
                    format!("window [{}, {}], oracle [{low}, {high}]", window.lowest, window.highest)
                });
            }
            (a, b) => self.complaints.push(format!("window {b:?}, oracle {a:?} (give {give:e})")),
        }
        self.consistent(analysis, report, problem, oracle);
    }

    fn consistent(
        &mut self,
        analysis: &Analysis,
        report: &CollapseReport,
        problem: Problem,
        oracle: Option<(f64, f64)>,
    ) {
        let floor = 1e-6 * balance(analysis);
        let slides = report.end.as_ref().is_some_and(|end| end.mechanism.slips());
        let expected = match oracle {
            None => Outcome::FallsAsBuilt,
            Some((low, high)) if low.abs() < floor || high.abs() < floor => return,
            Some((low, high)) if low > 0.0 || high < 0.0 => Outcome::StandsInWindow,
            Some((low, high)) => {
                let limit = if analysis.task.direction() == Direction::Increase { high } else { -low };
                if limit < report.cap { Outcome::Collapse } else { Outcome::Stands }
            }
        };
        let falls = expected == Outcome::Stands && report.outcome == Outcome::Collapse;
        let explained = match report.outcome {
            Outcome::CannotTell => true,
            Outcome::SlidesAsBuilt => slides,
            Outcome::Collapse if falls && slides => true,
            // Its stone crushes, so the oracle's has to.
            Outcome::Crushes => crushed(problem, report).is_none_or(|[low, high]| low >= -floor || high <= floor),
            Outcome::Collapse if falls && report.end.is_none() => {
                crushed(problem, report).is_some_and(|[low, high]| low.abs().min(high) <= report.cap)
            }
            _ => false,
        };
        self.expect(report.outcome == expected || explained, || {
            format!("outcome {:?}, the oracle expects {expected:?}", report.outcome)
        });
    }
}
