//! What a scenario measured, and whether the promises held.

use std::fmt::Display;
use std::time::Duration;

/// The figures of one scenario, printed as they come.
#[derive(Debug, Default)]
pub struct Report {
    pub broken: usize,
}

impl Report {
    pub fn figure(&self, name: &str, value: impl Display) {
        println!("   {name:<58} {value}");
    }

    pub fn promise(&mut self, kept: bool, promise: &str) {
        println!("   {} {promise}", if kept { "kept:  " } else { "BROKEN:" });
        self.broken += usize::from(!kept);
    }

    /// The promise that goes with every scenario.
    pub fn quiet(&mut self, troubles: &[String]) {
        for line in troubles.iter().take(5) {
            println!("   log: {line}");
        }
        self.promise(troubles.is_empty(), "no error and no panic in the log");
    }
}

/// The time that this share of all times does not exceed.
pub fn percentile(times: &mut [Duration], share: f64) -> Duration {
    times.sort_unstable();
    let place = (share * times.len() as f64).ceil() as usize;
    times.get(place.saturating_sub(1)).copied().unwrap_or_default()
}

/// Times in a few words.
pub fn spread(times: &mut [Duration]) -> String {
    let [p50, p99, most] = [0.5, 0.99, 1.0].map(|share| milliseconds(percentile(times, share)));
    format!("p50 {p50:.2} ms, p99 {p99:.2} ms, most {most:.2} ms, of {}", times.len())
}

pub fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}
