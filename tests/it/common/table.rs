//! Expected and got, row by row.

use super::door::solve;
use serde_json::Value;
use voussoir::collapse::{Face, Outcome, PathEnd};

/// A table of expected and got; every row is printed, then all must hold.
#[derive(Default)]
pub struct Table {
    failures: Vec<String>,
}

impl Table {
    pub fn titled(title: &str) -> Table {
        println!("{title}");
        Table::default()
    }

    pub fn note(&mut self, line: String, holds: bool) {
        println!("  {} {line}", if holds { "ok  " } else { "FAIL" });
        if !holds {
            self.failures.push(line);
        }
    }

    pub fn number(&mut self, name: &str, expected: f64, got: f64, tolerance: f64) {
        let error = got / expected - 1.0;
        let line = format!(
            "{name:<46} expected {expected:>12.7} got {got:>12.7} error {error:>9.1e} (at most {tolerance:.0e})"
        );
        self.note(line, error.abs() <= tolerance);
    }

    /// Equal to the decimals given.
    pub fn printed(&mut self, name: &str, expected: f64, decimals: i32, got: f64) {
        let half = 0.5 * 10f64.powi(-decimals);
        let line = format!("{name:<46} expected {expected:>12} got {got:>14.6}");
        self.note(line, (got - expected).abs() <= half * 1.0001);
    }

    pub fn words(&mut self, name: &str, expected: &str, got: &str) {
        self.note(format!("{name:<46} expected {expected} got {got}"), expected == got);
    }

    /// Stands half a per cent above `thickness`, falls half a per cent below.
    pub fn least(&mut self, name: &str, thickness: f64, request: impl Fn(f64) -> Value) {
        let [above, below] = [1.005, 0.995].map(|factor| solve(&request(factor * thickness)).outcome);
        let line = format!("{name:<46} {thickness:>10.7}: above {above:?}, below {below:?}");
        self.note(line, above == Outcome::Stands && below == Outcome::FallsAsBuilt);
    }
}

impl Drop for Table {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            assert!(self.failures.is_empty(), "{} rows fail:\n{}", self.failures.len(), self.failures.join("\n"));
        }
    }
}

/// "2i 6e 14i": joints and faces of the hinges.
pub fn hinges(end: &PathEnd) -> String {
    let name = |face| if face == Face::Intrados { "i" } else { "e" };
    let all: Vec<String> = end.mechanism.hinges.iter().map(|h| format!("{}{}", h.joint, name(h.face))).collect();
    all.join(" ")
}

/// "5 20": joints that slide.
pub fn slides(end: &PathEnd) -> String {
    end.mechanism.slides.iter().map(|s| s.joint.to_string()).collect::<Vec<_>>().join(" ")
}
