//! Very many small jobs pass through a bounded memory.

use super::clients::{Stopper, insist};
use super::process::Voussoir;
use super::report::Report;
use super::requests::tiny;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread::{scope, sleep};
use std::time::{Duration, Instant};

const JOBS: usize = 100_000;
const CLIENTS: usize = 4;
const SAMPLES: usize = 10;

/// Resident memory after the first tenth of the jobs and after the last differ by this share at most.
const FLAT: f64 = 0.05;

pub fn run(part: usize, report: &mut Report) {
    let (body, count) = (tiny(), JOBS / part);
    let kept = ["--jobs-kept", "1000", "--kept-at-least", "0"];
    let service = Voussoir::serve(&[kept.as_slice(), &["--queue", "1000", "--queue-per-client", "1000"]].concat());
    let (next, failed, clock) = (AtomicUsize::new(0), AtomicBool::new(false), Instant::now());
    let work = || {
        let (mut client, stopper) = (service.client(), Stopper(&failed));
        while next.fetch_add(1, Ordering::Relaxed) < count {
            insist(&mut client, &body, Duration::from_millis(20));
        }
        std::mem::forget(stopper);
    };
    let memory = scope(|scope| {
        for _ in 0..CLIENTS {
            scope.spawn(work);
        }
        samples(&service, count, &failed)
    });
    report.figure("jobs per second", format_args!("{:.0}", count as f64 / clock.elapsed().as_secs_f64()));
    report.figure("resident memory, KiB, after every tenth of the jobs", format_args!("{memory:?}"));
    let drift = memory[SAMPLES - 1] as f64 / memory[0] as f64 - 1.0;
    report.figure("last over first", format_args!("{:+.1} %", 100.0 * drift));
    report.promise(drift < FLAT, "resident memory does not grow by more than 5 %");
    let outcomes = ["successful", "failed", "dismissed"].map(|outcome| service.outcomes(outcome));
    report.promise(outcomes == [count as u64, 0, 0], "every job is successful");
    report.promise(service.metric("voussoir_jobs_kept") == 1000.min(count as u64), "1000 jobs are kept");
    report.figure("bytes held for jobs, KiB", service.metric("voussoir_held_bytes") / 1024);
    report.quiet(&service.troubles());
}

/// Resident memory after every tenth of the jobs.
fn samples(service: &Voussoir, count: usize, failed: &AtomicBool) -> Vec<u64> {
    let mut memory = Vec::new();
    while memory.len() < SAMPLES {
        let due = count * (memory.len() + 1) / SAMPLES;
        assert!(!failed.load(Ordering::Relaxed), "a client gave up");
        match service.outcomes("successful") >= due as u64 {
            true => memory.push(service.resident()),
            false => sleep(Duration::from_millis(20)),
        }
    }
    memory
}
