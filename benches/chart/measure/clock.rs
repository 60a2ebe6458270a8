//! How long something takes.

use std::fs;
use std::time::Instant;

/// Runs are repeated until they take this long together, s: on Linux CPU time is known to some milliseconds.
const ENOUGH: f64 = 0.25;

/// How long something took.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timed {
    /// Time of one run, s.
    pub seconds: f64,
    /// How many it was taken over.
    pub repetitions: usize,
}

/// What `run` gives, and its time: CPU time of this thread where the system tells (Linux), so that other work on the machine
/// counts as little as it can, else time gone by.
pub fn timed<T>(run: impl Fn() -> T) -> (T, Timed) {
    let gone_by = Instant::now();
    let now = || cpu_seconds().unwrap_or_else(|| gone_by.elapsed().as_secs_f64());
    let mut repetitions = 1;
    loop {
        let start = now();
        let mut result = run();
        for _ in 1..repetitions {
            result = run();
        }
        let seconds = now() - start;
        if seconds >= ENOUGH {
            return (result, Timed { seconds: seconds / repetitions as f64, repetitions });
        }
        repetitions *= 2;
    }
}

/// CPU time of this thread, s: the first number of `schedstat`, in nanoseconds.
fn cpu_seconds() -> Option<f64> {
    let text = fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(1e-9 * text.split(' ').next()?.parse::<f64>().ok()?)
}
