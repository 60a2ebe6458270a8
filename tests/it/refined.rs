//! Refined voussoirs against voussoirs of one subblock: where nothing slides the mesh is nothing to a collapse load;
//! where joints slide it may move the answer, but never above the limit window.

use crate::common::largest::larger;
use crate::common::{dice::Dice, door, random_arch};
use serde_json::{Value, json};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::thread;
use voussoir::budget::Budget;
use voussoir::collapse::{Analysis, CollapseReport, Direction, Face, Outcome, PathEnd, run};

/// A collapse load without sliding is the same on any mesh to this share; a sliding one passes the limit window by this.
const EQUAL: f64 = 1e-6;
/// Seeds of the random arches; and how many of them have to hinge, or slide, for the set to ask real questions.
const HINGING: (u64, usize) = (150, 25);
const SLIDING: (u64, usize) = (700, 250);
/// More stones than this would make the tests slow without asking anything else.
const MOST_VOUSSOIRS: usize = 40;
/// Meshes of the arches that slide, in turn.
const MESHES: [[usize; 2]; 3] = [[2, 2], [3, 2], [4, 4]];

/// The analysis on another mesh: subblocks of each voussoir.
fn meshed(analysis: &Analysis, of: impl FnMut(usize) -> [usize; 2]) -> Analysis {
    let mut refined = analysis.clone();
    refined.mesh.subblocks = (0..analysis.structure.voussoirs().len()).map(of).collect();
    refined
}

fn solve(analysis: &Analysis) -> Result<CollapseReport, String> {
    match catch_unwind(AssertUnwindSafe(|| run(analysis, &Budget::unlimited()))) {
        Ok(Ok(report)) => Ok(report),
        Ok(Err(error)) => Err(format!("error: {error}")),
        Err(_) => Err("panic".into()),
    }
}

/// Ends of the path, each with the end of the limit window it must not pass and the direction it was reached in.
fn ends<'r>(analysis: &Analysis, report: &'r CollapseReport) -> Vec<(&'r PathEnd, f64, f64)> {
    let Some(window) = report.limit_window else { return Vec::new() };
    let sign = if analysis.task.direction() == Direction::Increase { 1.0 } else { -1.0 };
    [(&report.end, sign), (&report.other_end, -sign)]
        .into_iter()
        .filter_map(|(end, sign)| Some((end.as_ref()?, if sign > 0.0 { window.highest } else { window.lowest }, sign)))
        .collect()
}

fn slides(report: &CollapseReport) -> bool {
    [&report.end, &report.other_end].into_iter().flatten().any(|end| end.mechanism.slips())
}

fn falls(report: &CollapseReport) -> bool {
    matches!(report.outcome, Outcome::Collapse | Outcome::StandsInWindow) && report.end.is_some()
}

/// Size of a load factor that matters: fixed over scaled loads.
fn balance(analysis: &Analysis) -> f64 {
    let total = |forces: &[voussoir::structure::PointForce]| forces.iter().map(|f| f.force.norm()).sum::<f64>();
    let (fixed, scaled) = (total(&analysis.fixed), total(&analysis.scaled));
    if fixed > 0.0 && scaled > 0.0 { fixed / scaled } else { 1.0 }
}

/// (joint, face) of every hinge.
fn hinges(end: &PathEnd) -> Vec<(usize, Face)> {
    end.mechanism.hinges.iter().map(|hinge| (hinge.joint, hinge.face)).collect()
}

/// What differs between the answer on a mesh and that of single subblocks.
fn differences(analysis: &Analysis, plain: &CollapseReport, refined: &CollapseReport) -> Vec<String> {
    let mut faults = Vec::new();
    if refined.outcome != plain.outcome {
        faults.push(format!("{:?}, not {:?}: {:?}", refined.outcome, plain.outcome, refined.notes));
    }
    let floor = 1e-3 * balance(analysis);
    for ((a, ..), (b, ..)) in ends(analysis, plain).into_iter().zip(ends(analysis, refined)) {
        let apart = (a.load_factor - b.load_factor).abs() / a.load_factor.abs().max(floor);
        if larger(apart, 0.0) > EQUAL {
            faults.push(format!("falls at {}, not {} ({apart:e})", b.load_factor, a.load_factor));
        }
        if hinges(a) != hinges(b) || !b.mechanism.slides.is_empty() {
            faults.push(format!("hinges {:?}, not {:?}; slides {:?}", hinges(b), hinges(a), b.mechanism.slides));
        }
    }
    faults
}

/// An arch that hinges, on square meshes and on one drawn at random for each voussoir.
fn check_hinging(name: &str, analysis: &Analysis, plain: &CollapseReport, faults: &Mutex<Vec<String>>) {
    let mut dice = Dice::new(analysis.structure.voussoirs().len() as u64);
    let drawn = meshed(analysis, |_| [0; 2].map(|_: usize| 1 + dice.below(4)));
    let square = |n: usize| (format!("{n}x{n}"), meshed(analysis, |_| [n, n]));
    let meshes = [1, 2, 4, 8].map(square).into_iter().chain([("drawn".to_owned(), drawn)]);
    for (mesh, refined) in meshes {
        let found = match solve(&refined) {
            Ok(report) => differences(analysis, plain, &report),
            Err(error) => vec![error],
        };
        faults.lock().unwrap().extend(found.into_iter().map(|words| format!("{name}, {mesh}: {words}")));
    }
}

/// Calls `see` with the seeds from 0 on, on all cores.
fn seeds(end: u64, see: impl Fn(u64) + Sync) {
    let next = AtomicU64::new(0);
    let seed = || Some(next.fetch_add(1, Ordering::Relaxed)).filter(|&seed| seed < end);
    let work = || std::iter::from_fn(seed).for_each(&see);
    let cores = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| (0..cores).for_each(|_| drop(scope.spawn(work))));
}

/// The analysis of a random request with voussoirs not too many.
fn random(request: &Value) -> Option<Analysis> {
    let analysis = door::analysis(request).unwrap_or_else(|faults| panic!("{faults}{request}"));
    Some(analysis).filter(|a| a.structure.voussoirs().len() <= MOST_VOUSSOIRS)
}

#[test]
fn a_mesh_does_not_move_a_collapse_load_without_sliding() {
    let faults = Mutex::new(Vec::new());
    for case in
        ["first-arch", "paper/table-2/9-joints", "paper/table-2/17-joints", "paper/table-2/27-joints", "paper/table-4"]
    {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(case).join("request.json");
        let analysis = door::analysis(&serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()).unwrap();
        let plain = solve(&meshed(&analysis, |_| [1, 1])).unwrap();
        assert!(falls(&plain) && !slides(&plain), "{case} has to hinge");
        check_hinging(case, &analysis, &plain, &faults);
    }
    let checked = AtomicUsize::new(0);
    seeds(HINGING.0, |seed| {
        let Some(analysis) = random(&random_arch::request(seed)) else { return };
        let plain = solve(&analysis).unwrap();
        if falls(&plain) && !slides(&plain) {
            checked.fetch_add(1, Ordering::Relaxed);
            check_hinging(&format!("seed {seed}"), &analysis, &plain, &faults);
        }
    });
    let (faults, checked) = (sorted(faults.into_inner().unwrap()), checked.into_inner());
    println!("refined 1x1, 2x2, 4x4, 8x8 and drawn: {checked} random arches that hinge, and 5 cases");
    assert!(checked >= HINGING.1);
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

/// What was seen of arches that slide.
#[derive(Default)]
struct Seen {
    arches: usize,
    /// Relative change of the load factor, by seed.
    changes: Vec<(f64, u64)>,
    /// Refined answers of another kind, such as one that never collapses.
    others: Vec<String>,
    /// Largest share by which the limit window was passed, and residual.
    above: f64,
    residual: f64,
    faults: Vec<String>,
}

impl Seen {
    fn see(&mut self, seed: u64, analysis: &Analysis, plain: &CollapseReport, refined: Result<CollapseReport, String>) {
        self.arches += 1;
        let report = match refined {
            Ok(report) => report,
            Err(error) => return self.faults.push(format!("seed {seed}: {error}")),
        };
        if report.outcome == Outcome::CannotTell {
            return self.faults.push(format!("seed {seed}: cannot tell: {:?}", report.notes));
        }
        let floor = 1e-3 * balance(analysis);
        for (end, limit, sign) in ends(analysis, &report) {
            let above = if limit.is_finite() { sign * (end.load_factor - limit) / limit.abs().max(floor) } else { 0.0 };
            self.above = larger(self.above, above);
            self.residual = larger(self.residual, end.residual);
            let close = above <= EQUAL && end.residual <= 1e-8;
            if !close {
                self.faults.push(format!("seed {seed}: {above:e} above {limit}, residual {:e}", end.residual));
            }
        }
        if report.outcome != plain.outcome {
            return self.others.push(format!("seed {seed}: {:?}, not {:?}", report.outcome, plain.outcome));
        }
        for ((a, ..), (b, ..)) in ends(analysis, plain).into_iter().zip(ends(analysis, &report)) {
            let change = (b.load_factor - a.load_factor) / a.load_factor.abs().max(floor);
            self.changes.push((change, seed));
        }
    }

    fn print(&mut self) {
        self.changes.sort_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
        let at = |share: f64| self.changes[((self.changes.len() - 1) as f64 * share) as usize].0.abs();
        let many = self.changes.iter().filter(|c| c.0.abs() > EQUAL).count();
        let higher = self.changes.iter().filter(|c| c.0 > EQUAL).count();
        println!(
            "{} arches that slide, meshes {MESHES:?}: change of the load factor, of {} ends: median {:.2e}, 90 % {:.2e}, \
             99 % {:.2e}, max {:.2e}; {many} beyond {EQUAL:e} ({higher} up); above the window at most {:.1e}, \
             residual at most {:.1e}",
            self.arches,
            self.changes.len(),
            at(0.5),
            at(0.9),
            at(0.99),
            at(1.0),
            self.above,
            self.residual
        );
        println!("largest: {:?}", &self.changes[self.changes.len().saturating_sub(5)..]);
        self.others.iter().for_each(|words| println!("other answer: {words}"));
    }
}

/// In the same order whichever core was first.
fn sorted(mut words: Vec<String>) -> Vec<String> {
    words.sort();
    words
}

/// The random request of a seed, with friction from the lower of the two ranges that random arches have.
fn slippery(seed: u64) -> Value {
    let mut request = random_arch::request(seed);
    request["stone"]["friction_angle_deg"] = json!(Dice::new(!seed).between(12.0, 25.0));
    request
}

#[test]
fn refined_arches_that_slide_never_pass_the_limit_window() {
    let seen = Mutex::new(Seen::default());
    seeds(SLIDING.0, |seed| {
        let Some(analysis) = random(&slippery(seed)) else { return };
        let plain = solve(&analysis).unwrap_or_else(|error| panic!("seed {seed}: {error}"));
        if falls(&plain) && slides(&plain) {
            let refined = solve(&meshed(&analysis, |_| MESHES[seed as usize % MESHES.len()]));
            seen.lock().unwrap().see(seed, &analysis, &plain, refined);
        }
    });
    let mut seen = seen.into_inner().unwrap();
    seen.print();
    assert!(seen.arches >= SLIDING.1, "only {} arches slide", seen.arches);
    let faults = sorted(seen.faults);
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}
