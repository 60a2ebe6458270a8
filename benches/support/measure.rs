//! What the benchmarks measure with.

use std::sync::LazyLock;
use std::time::Instant;

/// Time this thread has had on a processor, s, where the system tells (Linux), so that other work on the machine counts as little as
/// it can; else time gone by.
pub fn processor_seconds() -> f64 {
    static BEGUN: LazyLock<Instant> = LazyLock::new(Instant::now);
    let begun = *BEGUN;
    // The kernel brings it up to date when the thread offers its place to others, else some 250 times a second.
    std::thread::yield_now();
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    // Nought where the system keeps no account.
    let nanoseconds =
        text.split_whitespace().next().and_then(|word| word.parse::<f64>().ok()).filter(|time| *time > 0.0);
    nanoseconds.map_or_else(|| begun.elapsed().as_secs_f64(), |nanoseconds| 1e-9 * nanoseconds)
}

/// Exponent of a power law through these points, by least squares of the logarithms.
pub fn exponent(points: &[(f64, f64)]) -> f64 {
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let mean = |of: &dyn Fn(&(f64, f64)) -> f64| logs.iter().map(of).sum::<f64>() / logs.len() as f64;
    let (x, y) = (mean(&|p| p.0), mean(&|p| p.1));
    mean(&|p| (p.0 - x) * (p.1 - y)) / mean(&|p| (p.0 - x).powi(2))
}
