//! What is wrong with a request, for whoever wrote it.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// One thing that is wrong with a request, and how to mend it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Fault {
    /// JSON Pointer (RFC 6901) to the offending value; empty for the whole body.
    pub pointer: String,
    /// What is wrong and how to mend it.
    pub detail: String,
}

/// `parent` extended by one member name or index, escaped as RFC 6901 asks.
pub fn child(parent: &str, key: &str) -> String {
    format!("{parent}/{}", key.replace('~', "~0").replace('/', "~1"))
}

/// True for the same place and for what it contains.
pub fn lies_under(pointer: &str, place: &str) -> bool {
    pointer.strip_prefix(place).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
}

/// Most faults that are listed.
const MOST_LISTED: usize = 100;

/// The faults as they are listed: the first hundred, and how many more there are.
pub fn listed(mut faults: Vec<Fault>) -> Vec<Fault> {
    let more = faults.len().saturating_sub(MOST_LISTED);
    faults.truncate(MOST_LISTED);
    if more > 0 {
        faults.push(Fault { pointer: String::new(), detail: format!("and {more} more: mend these first") });
    }
    faults
}

/// Collects faults.
#[derive(Debug, Default)]
pub struct Faults(Vec<Fault>);

impl Faults {
    /// Adds a fault.
    pub fn add(&mut self, pointer: impl Into<String>, detail: impl Into<String>) {
        self.0.push(Fault { pointer: pointer.into(), detail: detail.into() });
    }

    /// Adds a fault unless `holds`; says whether it holds.
    pub fn require(&mut self, holds: bool, pointer: impl Into<String>, detail: impl Into<String>) -> bool {
        if !holds {
            self.add(pointer, detail);
        }
        holds
    }

    /// Requires `least < value <= most`.
    pub fn within(&mut self, pointer: impl Into<String>, value: f64, least: f64, most: f64) -> bool {
        let detail = format!("{value} is out of range: it must be greater than {least} and at most {most}");
        self.require(value > least && value <= most, pointer, detail)
    }

    /// Requires `least <= value < below`.
    pub fn from_to(&mut self, pointer: impl Into<String>, value: f64, least: f64, below: f64) -> bool {
        let detail = format!("{value} is out of range: it must be at least {least} and less than {below}");
        self.require(value >= least && value < below, pointer, detail)
    }

    /// True when nothing is wrong so far.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// How many so far.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// All of them.
    pub fn into_vec(self) -> Vec<Fault> {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pointers_are_escaped() {
        assert_eq!(child("/a", "b/c~d"), "/a/b~1c~0d");
    }
}
