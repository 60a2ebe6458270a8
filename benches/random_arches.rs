//! Thousands of random arches against the limit window, and a share of them against the oracle.
//!
//! `cargo bench --bench random_arches -- [count] [first seed] [oracle every n-th]`, by default 10000 0 10; or
//! `... -- look SEED [picture.svg]` for one arch in full; or `... -- states [count] [first seed]`, by default 10000 0, for the
//! reported states of as many arches, judged by the contact law.
#![allow(clippy::print_stdout, clippy::disallowed_methods, missing_docs)]

#[path = "../tests/it/common/mod.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod common;

use common::state::{Broken, broken, broken_line};
use common::verify::{Checked, check};
use std::collections::BTreeMap;
use std::time::Instant;
use voussoir::render::figure::{Drawing, State, svg};

fn main() {
    // Cargo passes `--bench` on.
    let arguments: Vec<String> = std::env::args().skip(1).filter(|arg| !arg.starts_with("--")).collect();
    if arguments.first().is_some_and(|word| word == "look") {
        return look(arguments.get(1).and_then(|seed| seed.parse().ok()).unwrap_or(0), arguments.get(2));
    }
    if arguments.first().is_some_and(|word| word == "states") {
        return states(arguments[1..].iter().filter_map(|arg| arg.parse().ok()).collect());
    }
    // A panic is a finding here, not a page of text.
    std::panic::set_hook(Box::new(|_| {}));
    let numbers: Vec<u64> = arguments.iter().filter_map(|arg| arg.parse().ok()).collect();
    let number = |i: usize, default: u64| numbers.get(i).copied().unwrap_or(default);
    let (count, first, every) = (number(0, 10_000), number(1, 0), number(2, 10).max(1));
    let start = Instant::now();
    let all: Vec<Checked> = (first..first + count).map(|seed| check(seed, seed % every == 0)).collect();
    println!("{count} random arches, seeds {first} to {}, {:.1} s", first + count - 1, start.elapsed().as_secs_f64());
    outcomes(&all);
    measures(&all);
    times(&all);
    ratios(&all);
    complaints(&all);
}

fn outcomes(all: &[Checked]) {
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for checked in all {
        let name = checked.outcome.map_or("none (see complaints)".to_owned(), |outcome| format!("{outcome:?}"));
        *counts.entry(name).or_default() += 1;
    }
    println!("\noutcomes");
    for (name, count) in counts {
        println!("  {name:<24} {count:>7}  {:5.1} %", 100.0 * count as f64 / all.len() as f64);
    }
}

/// The largest of a measure and its seed.
fn worst(all: &[Checked], measure: impl Fn(&Checked) -> Option<f64>) -> String {
    let found: Vec<(f64, u64)> = all.iter().filter_map(|c| Some((measure(c)?, c.seed))).collect();
    match found.iter().max_by(|a, b| a.0.total_cmp(&b.0)) {
        Some((value, seed)) => format!("{value:>9.1e}  (seed {seed}, of {})", found.len()),
        None => "none".to_owned(),
    }
}

fn measures(all: &[Checked]) {
    println!("\nworst");
    println!("  above the limit window, relative        {}", worst(all, |c| c.excess));
    println!("  off it where no joint slides, relative  {}", worst(all, |c| c.deviation));
    println!("  limit window against oracle, relative   {}", worst(all, |c| c.window_error));
    println!("  equilibrium residual, share of weight   {}", worst(all, |c| Some(c.residual)));
    println!("  work in the mechanism without sliding     {}", worst(all, |c| Some(c.power)));
}

fn quantiles(mut values: Vec<f64>, unit: &str, scale: f64) -> String {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| scale * values[((values.len() - 1) as f64 * share).round() as usize];
    let shown = [0.0, 0.05, 0.5, 0.95, 1.0].map(|share| format!("{:.3}", at(share)));
    format!("{} {unit} (least, 5 %, median, 95 %, greatest; {} arches)", shown.join("  "), values.len())
}

fn times(all: &[Checked]) {
    println!("\ntime of one analysis by number of voussoirs");
    for (low, high) in [(5, 10), (11, 30), (31, 80), (81, 201)] {
        let some = all.iter().filter(|c| (low..=high).contains(&c.voussoirs) && c.seconds > 0.0);
        let values: Vec<f64> = some.map(|c| c.seconds).collect();
        if !values.is_empty() {
            println!("  {low:>3} to {high:<3}  {}", quantiles(values, "ms", 1e3));
        }
    }
}

fn ratios(all: &[Checked]) {
    let values: Vec<f64> = all.iter().filter_map(|c| c.ratio).collect();
    println!("\nintensity over the end of the limit window where joints slide");
    if values.is_empty() {
        return println!("  none");
    }
    let equal = values.iter().filter(|v| (**v - 1.0).abs() < 1e-6).count();
    let close = values.iter().filter(|v| (**v - 1.0).abs() < 0.03).count();
    println!("  equal to 1e-6: {equal}, to 3 %: {close}, of {}", values.len());
    println!("  {}", quantiles(values, "", 1.0));
    let mut lowest: Vec<(f64, u64)> = all.iter().filter_map(|c| Some((c.ratio?, c.seed))).collect();
    lowest.sort_by(|a, b| a.0.total_cmp(&b.0));
    let shown: Vec<String> = lowest.iter().take(12).map(|(ratio, seed)| format!("{ratio:.4} (seed {seed})")).collect();
    println!("  lowest: {}", shown.join(", "));
    println!("  stones entering each other in the mechanism (share of the fastest corner), by that intensity:");
    for (name, low, high) in [("equal", 1.0 - 1e-6, 2.0), ("within 3 %", 0.97, 1.0 - 1e-6), ("lower", -1.0, 0.97)] {
        let some: Vec<&Checked> = all.iter().filter(|c| c.ratio.is_some_and(|r| r > low && r <= high)).collect();
        let count = |share: f64| some.iter().filter(|c| c.entering > share).count();
        println!("    {name:<12} {:>6} arches, over 1e-6: {}, over 1e-2: {}", some.len(), count(1e-6), count(1e-2));
    }
}

fn complaints(all: &[Checked]) {
    let bad: Vec<&Checked> = all.iter().filter(|c| !c.complaints.is_empty()).collect();
    println!("\ncomplaints: {} of {} arches", bad.len(), all.len());
    let mut kinds: BTreeMap<String, Vec<u64>> = BTreeMap::new();
    for checked in &bad {
        for words in &checked.complaints {
            // Numbers away: what is left is the kind.
            let kind: String = words.chars().filter(|c| !c.is_ascii_digit()).take(72).collect();
            kinds.entry(kind).or_default().push(checked.seed);
        }
    }
    for (kind, seeds) in kinds {
        println!("  {:>5}  {kind}  (seeds {:?} ...)", seeds.len(), &seeds[..seeds.len().min(5)]);
    }
    for checked in bad.iter().take(200) {
        println!("  seed {} ({} voussoirs): {}", checked.seed, checked.voussoirs, checked.complaints.join("; "));
    }
}

/// Reported states against the contact law.
fn states(numbers: Vec<u64>) {
    let (count, first) = (numbers.first().copied().unwrap_or(10_000), numbers.get(1).copied().unwrap_or(0));
    let (mut seen, mut all, mut bad) = (0, Broken::default(), 0);
    let (mut lines, mut worst_line) = (0, Broken::default());
    for seed in first..first + count {
        let request = common::random_arch::request(seed);
        let analysis = match common::door::analysis(&request) {
            Ok(analysis) => analysis,
            Err(faults) => {
                println!("seed {seed}, refused: {faults}");
                continue;
            }
        };
        let report = common::door::solve(&request);
        for end in common::state::ends(&analysis, &report) {
            let broken = broken_line(&analysis, end);
            (lines, worst_line) = (lines + 1, worst_line.join(broken));
            if broken.worst() > 1e-6 {
                println!("seed {seed}, thrust line ({:?}): {broken:?}", report.outcome);
            }
        }
        for (name, state) in common::state::states(&report) {
            let broken = broken(&analysis, common::state::order(&analysis, &report), state);
            seen += 1;
            all = all.join(broken);
            if broken.worst() > 1e-6 {
                bad += 1;
                println!("seed {seed}, {name} ({:?}, {} stones): {broken:?}", report.outcome, state.blocks.len());
            }
        }
    }
    println!("{lines} thrust lines, worst {worst_line:?}");
    println!("{seen} states of {count} arches: {bad} break the law by more than 1e-6 of the loads; worst {all:?}");
}

/// One arch: request, answer, checks and picture.
fn look(seed: u64, picture: Option<&String>) {
    let request = common::random_arch::request(seed);
    println!("{request}");
    let report = common::door::solve(&request);
    println!("{:?}, window {:?}, {:?}", report.outcome, report.limit_window, report.cost);
    report.notes.iter().for_each(|note| println!("{note}"));
    for end in [&report.end, &report.other_end].into_iter().flatten() {
        println!("load factor {}, residual {:e}", end.load_factor, end.residual);
        println!("{:#?}\n{:#?}", end.mechanism.hinges, end.mechanism.slides);
    }
    println!("{:#?}", check(seed, true));
    if let (Some(file), Some(end)) = (picture, &report.end) {
        let analysis = common::door::analysis(&request).unwrap_or_else(|faults| panic!("{faults}"));
        let title = format!("{:?} at load factor {:.6}: {:?}", report.outcome, end.load_factor, end.mechanism.mode);
        let drawing = Drawing {
            structure: &analysis.structure,
            fills: Vec::new(),
            loads: Vec::new(),
            altered: Vec::new(),
            state: State::Falls(end),
            title,
            caption: String::new(),
            description: String::new(),
        };
        let svg = svg(&drawing);
        std::fs::write(file, svg).unwrap_or_else(|error| panic!("{file}: {error}"));
    }
}
