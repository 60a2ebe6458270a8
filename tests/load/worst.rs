//! Searches for the request that takes the most memory, against its estimate and in all, and that ends latest after its time:
//! `cargo test --release --locked --test worst -- --seconds 600 --seed 1`. Paths of requests are measured instead of searched.
//! Each is analysed and its answer written in a process of its own, whose peak of resident memory is read.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::print_stdout, reason = "a test stops, and says its figures")]
#![allow(clippy::disallowed_methods, reason = "how long an analysis goes on is measured")]

#[path = "../it/common/dice.rs"]
#[allow(dead_code, reason = "others use the rest")]
mod dice;
mod scenes;

use dice::Dice;
use mimalloc::MiMalloc;
use scenes::Scene;
use serde_json::{Value, json};
use std::cell::Cell;
use std::io::{Read, Write};
use std::ops::ControlFlow;
use std::process::{Command, ExitCode, Stdio};
use std::time::{Duration, Instant};
use voussoir::budget::Budget;
use voussoir::collapse::{answer, cost::estimate};
use voussoir::wire::read::read_question;
use voussoir::wire::rendering::renderings;

/// As the program has it.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

const MIB: f64 = 1024.0 * 1024.0;
/// Peaks below this tell of the process more than of the request, MiB.
const SMALL: f64 = 20.0;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |name: &str, default: f64| {
        let at = arguments.iter().position(|argument| argument == name);
        at.and_then(|at| arguments.get(at + 1)).map_or(default, |text| text.parse().expect("a number"))
    };
    let job_time = number("--job-time", 10.0);
    let limit = number("--work-memory", 1152.0 * MIB);
    if arguments.iter().any(|argument| argument == "--one") {
        one(Duration::from_secs_f64(job_time), limit);
        return ExitCode::SUCCESS;
    }
    println!(
        "{:>9} {:>9} {:>6} {:>9} {:>8} {:>8} {:>8}  request",
        "peak MiB", "estimate", "ratio", "work", "seconds", "read s", "gap s"
    );
    let files: Vec<&String> = arguments.iter().filter(|argument| argument.ends_with(".json")).collect();
    for file in &files {
        let measured = measure(&std::fs::read(file).unwrap(), job_time, limit);
        row(&measured, file);
    }
    match files.is_empty() {
        true => search(number("--seconds", 600.0), number("--seed", 1.0) as u64, limit, job_time),
        false => ExitCode::SUCCESS,
    }
}

/// Reads a request from standard input, answers it and writes the answer, and prints what that took. Its estimate is what the
/// service would count for it.
fn one(job_time: Duration, limit: f64) {
    let mut body = Vec::new();
    std::io::stdin().read_to_end(&mut body).unwrap();
    let (before, clock) = (peak(), Instant::now());
    let (request, question) = match read_question(&body) {
        Ok(read) => read,
        Err(faults) => {
            println!("{}", json!({"refused": faults[0].detail, "read": clock.elapsed().as_secs_f64()}));
            return;
        }
    };
    let (read, counting) = (clock.elapsed(), Instant::now());
    let demand = estimate(&question);
    let counted = counting.elapsed();
    let (clock, last, gap) = (Instant::now(), Cell::new(Instant::now()), Cell::new(Duration::ZERO));
    let look = || {
        gap.set(gap.get().max(last.get().elapsed()));
        last.set(Instant::now());
    };
    let ask = |_| {
        look();
        if clock.elapsed() > job_time { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let answered = answer(&question, &Budget::new(&ask));
    let outcome = match &answered {
        Ok(answer) => renderings(&request, &question, answer, clock.elapsed()).map_or("failed", |_| "answered"),
        Err(_) => "stopped",
    };
    look();
    let [read, counted, seconds, gap] = [read, counted, clock.elapsed(), gap.get()].map(|time| time.as_secs_f64());
    println!(
        "{}",
        json!({"before": before, "peak": peak(), "memory": (demand.memory as f64).min(limit.max(demand.uncrushed as f64)), "work": demand.work, "read": read,
            "counted": counted, "seconds": seconds, "gap": gap, "outcome": outcome})
    );
}

/// Most memory that was resident so far, bytes.
fn peak() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap();
    1024.0 * line.trim().trim_end_matches(" kB").parse::<f64>().unwrap()
}

/// What a request took, in a process of its own.
fn measure(body: &[u8], job_time: f64, limit: f64) -> Value {
    let mut command = Command::new(std::env::current_exe().unwrap());
    let [time, memory] = [job_time, limit].map(|number| number.to_string());
    command.args(["--one", "--job-time", &time, "--work-memory", &memory]);
    command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.spawn().unwrap();
    child.stdin.take().unwrap().write_all(body).unwrap();
    let output = child.wait_with_output().unwrap();
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| json!({"died": output.status.to_string()}))
}

/// What the analysis took beyond the process itself, and that over its estimate.
fn taken(measured: &Value) -> [f64; 2] {
    let of = |name: &str| measured[name].as_f64().unwrap_or(f64::NAN);
    let taken = of("peak") - of("before");
    [taken, taken / of("memory")]
}

fn row(measured: &Value, name: &str) {
    let of = |name: &str| measured[name].as_f64().unwrap_or(f64::NAN);
    let [taken, ratio] = taken(measured);
    let outcome = ["outcome", "refused", "died"].iter().find_map(|name| measured[*name].as_str()).unwrap_or_default();
    println!(
        "{:9.1} {:9.1} {ratio:6.2} {:9.1e} {:8.2} {:8.3} {:8.3}  {outcome}: {name}",
        taken / MIB,
        of("memory") / MIB,
        of("work"),
        of("seconds"),
        of("read") + of("counted"),
        of("gap"),
    );
}

/// What a search climbs towards: its name, and how far a measured run has come.
type Aim = (&'static str, fn(&Value) -> f64);

/// Climbs from random requests, a third of the time each, towards more memory over the estimate, more memory, and later ends.
fn search(seconds: f64, seed: u64, limit: f64, job_time: f64) -> ExitCode {
    let clock = Instant::now();
    let mut dice = Dice::new(seed);
    let aims: [Aim; 3] = [
        ("memory over estimate", |measured| taken(measured)[1] * f64::from(u8::from(taken(measured)[0] > SMALL * MIB))),
        ("memory", |measured| taken(measured)[0]),
        ("longest time between questions", |measured| measured["gap"].as_f64().unwrap_or(0.0)),
    ];
    let mut broken = false;
    for (number, (name, aim)) in aims.into_iter().enumerate() {
        let mut best: Option<(f64, Scene, Value)> = None;
        let mut stale = 0;
        let mut worst: Option<(f64, Scene, Value)> = None;
        while clock.elapsed().as_secs_f64() < seconds * (number + 1) as f64 / 3.0 {
            let scene = match &best {
                // After so many that are no worse, from another place.
                Some((_, scene, _)) if stale < 12 => scene.changed(&mut dice),
                _ => {
                    (best, stale) = (None, 0);
                    Scene::any(&mut dice)
                }
            };
            let body = scene.request().to_string();
            let Ok((_, question)) = read_question(body.as_bytes()) else { continue };
            if estimate(&question).uncrushed as f64 > limit {
                continue;
            }
            let measured = measure(body.as_bytes(), job_time, limit);
            let (value, [taken, ratio]) = (aim(&measured), taken(&measured));
            let late = measured["seconds"].as_f64().unwrap_or(f64::INFINITY) > job_time + 2.0;
            // A small analysis takes some of what the process takes anyway.
            let outgrown = ratio > 1.0 && taken > SMALL * MIB;
            if late || outgrown || measured["died"].is_string() {
                broken = true;
                row(&measured, &format!("{scene:?}"));
            }
            if best.as_ref().is_none_or(|(before, ..)| value > *before) {
                (best, stale) = (Some((value, scene.clone(), measured.clone())), 0);
            } else {
                stale += 1;
            }
            if worst.as_ref().is_none_or(|(before, ..)| value > *before) {
                worst = Some((value, scene, measured));
            }
        }
        if let Some((_, scene, measured)) = worst {
            row(&measured, &format!("{name}: {scene:?}"));
            std::fs::write(std::env::temp_dir().join(format!("worst-{number}.json")), scene.request().to_string())
                .unwrap();
        }
    }
    if broken { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}
