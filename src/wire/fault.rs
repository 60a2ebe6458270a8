//! What is wrong with a request, for whoever wrote it.

use serde::{Deserialize, Serialize};
use std::fmt;
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
const MOST_FAULTS_LISTED: usize = 100;

/// The faults as they are listed: the first hundred, and whether there are more.
pub fn listed(mut faults: Vec<Fault>) -> Vec<Fault> {
    if faults.len() > MOST_FAULTS_LISTED {
        faults.truncate(MOST_FAULTS_LISTED);
        faults.push(Fault { pointer: String::new(), detail: "and more: mend these first".to_owned() });
    }
    faults
}

/// Collects faults.
#[derive(Debug, Default)]
pub struct Faults {
    all: Vec<Fault>,
    strays: usize,
}

impl Faults {
    /// Adds a fault.
    pub fn add(&mut self, pointer: impl Into<String>, detail: impl Into<String>) {
        self.all.push(Fault { pointer: pointer.into(), detail: detail.into() });
    }

    /// Adds a fault unless `holds`; says whether it holds.
    pub fn require(&mut self, holds: bool, pointer: impl Into<String>, detail: impl Into<String>) -> bool {
        if !holds {
            self.add(pointer, detail);
        }
        holds
    }

    /// Requires a number that is not 0, of a load or a factor of it.
    pub fn not_zero(&mut self, pointer: &str, value: f64) {
        self.require(value != 0.0, pointer, "0 makes this load vanish: give another number or leave the load out");
    }

    /// Adds the fault of a field that does not belong or is missing beside another: the others can be read without it.
    pub fn stray(&mut self, pointer: impl Into<String>, detail: impl Into<String>) {
        self.add(pointer, detail);
        self.strays += 1;
    }

    /// True when there are more than are listed: looking for others is in vain.
    pub fn is_full(&self) -> bool {
        self.all.len() > MOST_FAULTS_LISTED
    }

    /// True when nothing is wrong but fields that do not belong, and all of it is known.
    pub fn only_strays(&self) -> bool {
        self.all.len() == self.strays && !self.is_full()
    }

    /// True when nothing is wrong so far.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// How many so far.
    pub fn len(&self) -> usize {
        self.all.len()
    }

    /// All of them.
    pub fn into_vec(self) -> Vec<Fault> {
        self.all
    }
}

/// A number as a fault shows it: all its digits, and an exponent where it is very large or small.
#[derive(Debug, Clone, Copy)]
pub struct Shown(pub f64);

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plain = self.0 == 0.0 || (1e-5..1e7).contains(&self.0.abs());
        if plain { write!(f, "{}", self.0) } else { write!(f, "{:e}", self.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_whole() {
        for (value, text) in
            [(1e300, "1e300"), (-2.5e-9, "-2.5e-9"), (0.0, "0"), (90.000_001, "90.000001"), (4e6, "4000000")]
        {
            assert_eq!(Shown(value).to_string(), text);
        }
    }

    #[test]
    fn pointers_are_escaped() {
        assert_eq!(child("/a", "b/c~d"), "/a/b~1c~0d");
    }
}
