//! Drives the real program on the loopback as hard as it promises to bear: `cargo test --release --locked --test load`,
//! see README.md here.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::print_stdout, reason = "a test stops at the first surprise")]
#![allow(clippy::disallowed_methods, reason = "many clients at once, each waiting by the clock")]

mod cancel;
mod client;
mod clients;
mod connections;
mod crowd;
#[cfg(feature = "postgres")]
#[path = "../it/common/database.rs"]
mod database;
#[path = "../it/common/dice.rs"]
#[allow(dead_code, reason = "others use the rest")]
mod dice;
mod draining;
#[cfg(feature = "postgres")]
mod fleet;
mod heaviest;
mod hostile;
mod overload;
mod process;
mod report;
mod requests;
#[allow(dead_code, reason = "the search uses the rest")]
mod scenes;
#[cfg(feature = "postgres")]
mod shared;
mod sigterm;
mod soak;
#[path = "load.rs"]
mod throughput;
mod workers;

use report::Report;
use std::process::ExitCode;
use std::time::Instant;

/// One scenario, with counts and times divided by its first argument.
type Scenario = fn(usize, &mut Report);

const SCENARIOS: &[(&str, Scenario)] = &[
    ("load", throughput::run),
    ("overload", overload::run),
    ("soak", soak::run),
    ("cancel", cancel::run),
    ("workers", workers::run),
    ("connections", connections::run),
    ("sigterm", sigterm::run),
    ("heaviest", heaviest::run),
    ("crowd", crowd::run),
    #[cfg(feature = "postgres")]
    ("shared", shared::run),
];

fn main() -> ExitCode {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    let part = match arguments.iter().position(|argument| argument == "--part") {
        Some(place) => arguments.drain(place..).nth(1).and_then(|count| count.parse().ok()).filter(|&part| part > 0),
        None => Some(1),
    };
    let known = |name: &String| SCENARIOS.iter().any(|(known, _)| known == name);
    let (Some(part), true) = (part, arguments.iter().all(known)) else {
        println!(
            "load [SCENARIO ...] [--part N]: N-th part of the counts; scenarios {:?}",
            SCENARIOS.iter().map(|s| s.0).collect::<Vec<_>>()
        );
        return ExitCode::FAILURE;
    };
    let mut broken = 0;
    for &(name, run) in SCENARIOS {
        if arguments.is_empty() || arguments.iter().any(|argument| argument == name) {
            broken += one(name, run, part);
        }
    }
    if broken == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Runs one scenario; how many promises it broke.
fn one(name: &str, run: Scenario, part: usize) -> usize {
    println!("{name}{}", if part > 1 { format!(" (1/{part} of the counts)") } else { String::new() });
    let (clock, mut report) = (Instant::now(), Report::default());
    run(part, &mut report);
    report.figure("time, s", format_args!("{:.1}", clock.elapsed().as_secs_f64()));
    // Whatever else the machine does shows in the times.
    let busy = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    report.figure("load average of the machine", busy.split(' ').next().unwrap_or_default());
    report.broken
}
