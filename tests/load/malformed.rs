//! A million malformed and extreme bodies through reader and mechanics:
//! `cargo test --release --test malformed -- --inputs 1000000 --seed 1`. Prints what became of them; fails where one
//! panics, is refused without a word, or is answered with something that is no number.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::print_stdout, reason = "a test stops, and says its counts")]
#![allow(clippy::disallowed_methods, reason = "how long the slowest took is worth knowing")]

use dice::Dice;
use held::{Answers, Solved, is_small, read, seeds, solve};
use inputs::{KINDS, input};
use serde_json::Value;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::time::{Duration, Instant};

#[path = "../it/contract/bodies.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod bodies;
#[path = "../it/common/dice.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod dice;
#[path = "../it/common/folders.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod folders;
mod held;
mod inputs;

const THREADS: u64 = 2;
/// Heartbeats after which an analysis is stopped.
const STEPS: usize = 3000;
/// One of so many small questions is solved.
const SOLVED: f64 = 1.0 / 30.0;

/// What became of the bodies of one kind.
#[derive(Default, Clone)]
struct Count {
    inputs: u64,
    refused: u64,
    accepted: u64,
    answered: u64,
    stopped: u64,
    failed: u64,
}

#[derive(Default)]
struct Tally {
    counts: [Count; KINDS.len()],
    found: Vec<String>,
    slowest: Option<(Duration, String)>,
}

/// The number after `--name`.
fn argument(name: &str, default: u64) -> u64 {
    let arguments: Vec<String> = std::env::args().collect();
    let at = arguments.iter().position(|argument| argument == name);
    at.and_then(|at| arguments.get(at + 1)).map_or(default, |text| text.parse().expect("a number"))
}

fn main() {
    let (inputs, seed, from) = (argument("--inputs", 10_000), argument("--seed", 1), argument("--from", 0));
    let seeds = seeds();
    std::panic::set_hook(Box::new(|_| {}));
    let clock = Instant::now();
    let tally = Mutex::new(Tally::default());
    std::thread::scope(|scope| {
        for thread in 0..THREADS {
            let (tally, seeds) = (&tally, &seeds);
            scope.spawn(move || {
                let answers = Answers::new();
                for number in (from..from + inputs).filter(|number| number % THREADS == thread) {
                    one(seed, number, seeds, &answers, tally);
                }
            });
        }
    });
    report(&tally.into_inner().unwrap(), clock.elapsed());
}

/// Makes one body and sees what becomes of it.
fn one(seed: u64, number: u64, seeds: &[Value], answers: &Answers, tally: &Mutex<Tally>) {
    let mut dice = Dice::new(seed.wrapping_mul(1 << 40).wrapping_add(number));
    let kind = dice.below(KINDS.len());
    let body = input(kind, seeds, &mut dice);
    let clock = Instant::now();
    let mut solved = None;
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        let asked = read(&body)?;
        if is_small(&asked.1) && dice.chance(SOLVED) {
            solved = Some(solve(&asked.0, &asked.1, STEPS, answers));
        }
        Some(())
    }));
    let taken = clock.elapsed();
    let mut tally = tally.lock().unwrap();
    let count = &mut tally.counts[kind];
    count.inputs += 1;
    match &outcome {
        Ok(None) => count.refused += 1,
        Ok(Some(())) => count.accepted += 1,
        Err(_) => {}
    }
    match solved {
        Some(Solved::Answered) => count.answered += 1,
        Some(Solved::Stopped) => count.stopped += 1,
        Some(Solved::Failed) => count.failed += 1,
        None => {}
    }
    let text = || format!("number {number}, {}: {}", KINDS[kind], String::from_utf8_lossy(&body));
    if let Err(panic) = outcome {
        let words = panic.downcast_ref::<String>().cloned();
        let words = words.or_else(|| panic.downcast_ref::<&str>().map(|words| (*words).to_owned()));
        let found = format!("{}\n    {}", words.unwrap_or_default(), text());
        tally.found.push(found);
    }
    if tally.slowest.as_ref().is_none_or(|(slowest, _)| taken > *slowest) {
        tally.slowest = Some((taken, text()));
    }
}

fn report(tally: &Tally, taken: Duration) {
    let row = |name: &str, c: &Count| {
        let Count { inputs, refused, accepted, answered, stopped, failed } = c;
        println!("{name:30} {inputs:8} {refused:8} {accepted:8} {answered:8} {stopped:8} {failed:8}");
    };
    println!("{:30}   inputs  refused accepted answered  stopped   failed", "");
    let mut all = Count::default();
    for (name, count) in KINDS.iter().zip(&tally.counts) {
        row(name, count);
        all.inputs += count.inputs;
        all.refused += count.refused;
        all.accepted += count.accepted;
        all.answered += count.answered;
        all.stopped += count.stopped;
        all.failed += count.failed;
    }
    row("all", &all);
    println!("{} s", taken.as_secs());
    if let Some((slowest, text)) = &tally.slowest {
        println!("slowest, {slowest:?}: {}", text.chars().take(1500).collect::<String>());
    }
    println!("{} things that must not be", tally.found.len());
    tally.found.iter().take(40).for_each(|found| println!("- {}", found.chars().take(2500).collect::<String>()));
    std::process::exit(i32::from(!tally.found.is_empty()));
}
