//! Motion after collapse: every run ends by one of its ends, stones keep their shape and stay out of each other.
#![cfg(feature = "server")]
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may panic, and prints what it measured")]

mod common;

use common::falling::{Measured, measure};
use common::{door, random_arch};
use serde_json::{Value, json};
use std::path::Path;
use voussoir::collapse::{Analysis, CollapseReport, FallingMotion, MotionEnd, Unwatched, run};

/// Deepest overlap of stones, share of the thickness.
const OVERLAP: f64 = 1e-3;
/// Largest change of an area, share of it.
const AREA: f64 = 1e-9;
/// Largest residual of equilibrium, share of the loads.
const RESIDUAL: f64 = 1e-9;
/// How many random arches.
const ARCHES: usize = 200;

fn with_motion(mut request: Value) -> Value {
    request["motion"] = json!({});
    request
}

fn case(name: &str) -> Value {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name).join("request.json");
    with_motion(serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap())
}

fn solve(request: &Value) -> (Analysis, CollapseReport) {
    let analysis = door::analysis(request).unwrap_or_else(|faults| panic!("{faults}"));
    let report = run(&analysis, &mut Unwatched).unwrap();
    (analysis, report)
}

/// What is wrong with a motion.
fn complaints(motion: &FallingMotion, measured: &Measured) -> Vec<String> {
    let mut words = Vec::new();
    let mut complain = |fails: bool, what: String| words.extend(fails.then_some(what));
    complain(motion.end == MotionEnd::Lost, "lost".to_owned());
    complain(measured.overlap >= OVERLAP, format!("overlap {:e}", measured.overlap));
    complain(measured.area >= AREA, format!("area {:e}", measured.area));
    complain(measured.residual >= RESIDUAL, format!("residual {:e}", measured.residual));
    words
}

fn say(name: &str, motion: &FallingMotion, m: &Measured) {
    let moved = motion.frames.last().unwrap().displacement / motion.span;
    println!(
        "{name}: {:?} after {} steps, {moved:.3} of the span; overlap {:.1e}, area {:.1e}, residual {:.1e}, friction \
         beyond its bound {:.1e} ({} steps), least work {:.1e}",
        motion.end,
        m.frames - 1,
        m.overlap,
        m.area,
        m.residual,
        m.excess,
        m.beyond,
        m.work
    );
}

#[test]
fn the_arches_of_the_paper_fall() {
    let names = [
        "paper-case-1-9",
        "paper-case-1-17",
        "paper-case-1-27",
        "paper-case-1-61",
        "paper-oval-embankment-lower",
        "paper-oval-embankment-upper",
        "paper-oval-crown-load",
        "first-arch",
        "lateral-7",
        "sliding-arch",
    ];
    let mut all = Vec::new();
    for name in names {
        let (analysis, report) = solve(&case(name));
        let both = name.starts_with("paper-oval");
        assert!(report.motion.is_some() && report.other_motion.is_some() == both, "{name}");
        for motion in report.motion.iter().chain(&report.other_motion) {
            let measured = measure(&analysis.arch, motion);
            say(name, motion, &measured);
            all.extend(complaints(motion, &measured).into_iter().map(|words| format!("{name}: {words}")));
            let moved = matches!(motion.end, MotionEnd::Moved | MotionEnd::StoneFree { .. });
            assert!(moved, "{name}: {:?}", motion.end);
        }
    }
    assert!(all.is_empty(), "{all:#?}");
}

#[test]
fn random_arches_fall_to_one_of_the_ends() {
    let (mut all, mut seen, mut seed) = (Vec::new(), Vec::new(), 0);
    while seen.len() < ARCHES {
        let name = format!("seed {seed}");
        let (analysis, report) = solve(&with_motion(random_arch::request(seed)));
        seed += 1;
        for motion in report.motion.iter().chain(&report.other_motion) {
            let measured = measure(&analysis.arch, motion);
            say(&name, motion, &measured);
            all.extend(complaints(motion, &measured).into_iter().map(|words| format!("{name}: {words}")));
            seen.push((motion.end, motion.frames.last().unwrap().slides.len()));
        }
    }
    let count = |end: fn(&MotionEnd) -> bool| seen.iter().filter(|(e, _)| end(e)).count();
    println!(
        "{} motions of {seed} arches: {} free, {} moved, {} at rest, {} met, {} out of steps, {} with sliding",
        seen.len(),
        count(|end| matches!(end, MotionEnd::StoneFree { .. })),
        count(|end| matches!(end, MotionEnd::Moved)),
        count(|end| matches!(end, MotionEnd::AtRest)),
        count(|end| matches!(end, MotionEnd::StonesMeet { .. })),
        count(|end| matches!(end, MotionEnd::StepLimit)),
        seen.iter().filter(|(_, slides)| *slides > 0).count()
    );
    assert!(all.is_empty(), "{} complaints: {all:#?}", all.len());
}
