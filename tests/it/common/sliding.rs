//! One arch whose joints slide, held against every variant of its path, against every mechanism and against a programme of its
//! own.

use super::exhaustive;
use super::full_solution::{self, Gap};
use super::largest::larger;
use super::oracle::{Aim, Bond, Limit, Problem, Seam};
use super::{door, sliding_arch};
use serde_json::Value;
use voussoir::budget::Budget;
use voussoir::collapse::{Analysis, CollapseReport, Direction, Note, PathEnd, run};
use voussoir::structure::Face;

/// Load factors that differ by less than this share of their size, or of that at which the scaled loads are as large as the
/// fixed ones, are the same.
pub const SAME: f64 = 1e-6;
/// A full solution may violate its conditions by this share of the loads, and of the fastest motion.
pub const FULL: f64 = 1e-7;
/// Most stones for which every mechanism is tried.
pub const EXHAUSTED: usize = 9;

/// One end of an answer, and what was held against it.
#[derive(Debug, Clone)]
#[allow(dead_code, reason = "the benchmark reads what the tests do not")]
pub struct Checked {
    /// Load factor from which the path went.
    pub start: f64,
    pub least: f64,
    pub greatest: f64,
    pub path: f64,
    /// Lowest end of any variant's path.
    pub variants: f64,
    /// Least of all mechanisms, where there are few stones.
    pub exhaustive: Option<f64>,
    pub slides: bool,
    pub gap: Gap,
    /// Whether it is a full solution without dilation; else nothing but that limit analysis allows no more.
    pub full: bool,
    /// Everything that is wrong.
    pub complaints: Vec<String>,
}

/// The ends of an answer with the direction in which its path went to each.
fn ends<'r>(analysis: &Analysis, report: &'r CollapseReport) -> Vec<(&'r PathEnd, f64)> {
    let sign = if analysis.task.direction() == Direction::Increase { 1.0 } else { -1.0 };
    let ends = report.end.iter().map(|end| (end, sign)).chain(report.other_end.iter().map(|end| (end, -sign)));
    if report.at_start.is_none() { Vec::new() } else { ends.collect() }
}

fn answer(analysis: &Analysis) -> CollapseReport {
    run(analysis, &Budget::unlimited()).unwrap_or_else(|error| panic!("{error}"))
}

/// Checks every end of the answer; none where the arch is refused, or does not fall.
pub fn check(request: &Value) -> Vec<Checked> {
    let Ok(analysis) = door::analysis(request) else { return Vec::new() };
    let report = answer(&analysis);
    let of_end = |(end, sign): (&PathEnd, f64)| Checked::new(&analysis, &report, end, sign);
    ends(&analysis, &report).into_iter().map(of_end).collect()
}

impl Checked {
    fn new(analysis: &Analysis, report: &CollapseReport, end: &PathEnd, sign: f64) -> Checked {
        let problem = door::problem(analysis);
        let centroids: Vec<_> = analysis.structure.voussoirs().iter().map(|v| v.region.centroid.into()).collect();
        let window = report.limit_window.map_or([f64::NAN; 2], |window| [window.lowest, window.highest]);
        let exhaustive = (centroids.len() <= EXHAUSTED && problem.seams.iter().all(plain))
            .then(|| exhaustive::least(&problem, report.start, sign));
        let mut checked = Checked {
            start: report.start,
            least: end.load_factor,
            greatest: if sign > 0.0 { window[1] } else { window[0] },
            path: end.on_path(),
            variants: lowest_variant(analysis, end, sign),
            exhaustive,
            slides: end.mechanism.slips(),
            gap: full_solution::measure(&problem, &centroids, end),
            full: false,
            complaints: Vec::new(),
        };
        checked.judge(&problem, report, end, sign);
        checked
    }

    fn judge(&mut self, problem: &Problem, report: &CollapseReport, end: &PathEnd, sign: f64) {
        let scale = self.least.abs().max(balance(problem));
        let lower = |a: f64, b: f64| sign * (b - a) > SAME * scale;
        let mut complain = |fails: bool, words: String| {
            if fails {
                self.complaints.push(words);
            }
        };
        // At some ends of the window no motion without dilation is driven by the scaled loads: the answer says so.
        let full = !self.exhaustive.is_some_and(f64::is_infinite) && !report.notes.contains(&Note::LaterMechanism);
        complain(full && exceeds(self.gap.worst(), FULL), format!("no full solution: {:?}", self.gap));
        complain(
            full && exceeds(1e-9, sign * self.gap.driving),
            format!("scaled loads do work {:e}", self.gap.driving),
        );
        complain(
            !full && lower(self.least, self.greatest),
            format!("{} is neither full nor the window's end", self.least),
        );
        self.full = full;
        complain(
            lower(self.variants, self.least),
            format!("a variant falls at {}, least {}", self.variants, self.least),
        );
        complain(lower(self.greatest, self.least), format!("window {}, least {}", self.greatest, self.least));
        if let Some(exhaustive) = self.exhaustive.filter(|_| full) {
            let apart = (exhaustive - self.least).abs();
            complain(
                exceeds(apart, SAME * scale),
                format!("least of all mechanisms {exhaustive}, least {}", self.least),
            );
        }
        let open = lower(self.least, self.greatest);
        let silent = (self.slides || open)
            && (end.range.is_none()
                || !report
                    .notes
                    .iter()
                    .any(|note| matches!(note, Note::SoleSlidingLoad(_) | Note::ManySlidingLoads(_))));
        complain(silent, "slides without a range or a note".into());
        if self.slides && full {
            let by_programme = Problem { limits: limits(end), ..problem.clone() };
            let aim = if sign > 0.0 { Aim::Lowest } else { Aim::Highest };
            let nearest = by_programme.solve(aim).value(aim).unwrap_or(f64::NAN);
            let nearest = if sign * (nearest - report.start) > 0.0 { nearest } else { report.start };
            let apart = (nearest - self.least).abs();
            complain(
                exceeds(apart, 1e-5 * scale),
                format!("the mechanism's own programme {nearest}, least {}", self.least),
            );
        }
    }
}

/// The lowest end of any variant's path, seen from the start; `end` where none falls.
fn lowest_variant(analysis: &Analysis, end: &PathEnd, sign: f64) -> f64 {
    let mut lowest = sign * end.on_path();
    for variant in sliding_arch::variants(analysis, end.load_factor) {
        let report = answer(&variant.analysis);
        for (end, way) in ends(&variant.analysis, &report) {
            if way == sign {
                lowest = -larger(-lowest, -sign * (end.on_path() + variant.before));
            }
        }
    }
    sign * lowest
}

/// True, too, where one of the two is no number.
fn exceeds(value: f64, most: f64) -> bool {
    value.is_nan() || most.is_nan() || value > most
}

/// A dry joint without cohesion.
fn plain(seam: &Seam) -> bool {
    matches!(seam.bond, Bond::Dry { cohesion: 0.0, .. })
}

/// Fixed over scaled loads: the size of a load factor that matters.
fn balance(problem: &Problem) -> f64 {
    let total = |pushes: &[super::oracle::Push]| pushes.iter().map(|p| p.force[0].hypot(p.force[1])).sum::<f64>();
    total(&problem.fixed) / total(&problem.scaled)
}

/// The limits of the joints that move.
fn limits(end: &PathEnd) -> Vec<(usize, Limit)> {
    let opens = |face: Face| if face == Face::Intrados { Limit::NoForce(1) } else { Limit::NoForce(0) };
    let hinges = end.mechanism.hinges.iter().map(|hinge| (hinge.joint, opens(hinge.face)));
    let both = |joint| [(joint, Limit::NoForce(0)), (joint, Limit::NoForce(1))];
    let parted = end.mechanism.lift_offs.iter().flat_map(|lift_off| both(lift_off.joint));
    hinges
        .chain(parted)
        .chain(end.mechanism.slides.iter().map(|slide| (slide.joint, Limit::Shear(-slide.rate.signum()))))
        .collect()
}
