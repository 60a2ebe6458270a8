//! What is wrong with a request, for whoever wrote it.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::RangeInclusive;
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

/// The faults as they are listed: the first hundred, and how many more there are.
pub fn listed(mut faults: Vec<Fault>) -> Vec<Fault> {
    let more = faults.len().saturating_sub(MOST_FAULTS_LISTED);
    faults.truncate(MOST_FAULTS_LISTED);
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
        let rule = format!("it must be greater than {} and at most {}", Shown(least), Shown(most));
        self.in_range(value > least && value <= most, pointer, value, &rule)
    }

    /// Requires `least <= value < below`.
    pub fn from_to(&mut self, pointer: impl Into<String>, value: f64, least: f64, below: f64) -> bool {
        let rule = format!("it must be at least {} and less than {}", Shown(least), Shown(below));
        self.in_range(value >= least && value < below, pointer, value, &rule)
    }

    /// Requires `above < value < below`.
    pub fn inside(&mut self, pointer: impl Into<String>, value: f64, above: f64, below: f64) -> bool {
        let rule = format!("it must lie between {} and {}, both excluded", Shown(above), Shown(below));
        self.in_range(value > above && value < below, pointer, value, &rule)
    }

    /// Requires `-most <= value <= most`.
    pub fn either_way(&mut self, pointer: impl Into<String>, value: f64, most: f64) -> bool {
        let rule = format!("it must be from -{most} to {most}", most = Shown(most));
        self.in_range(value.abs() <= most, pointer, value, &rule)
    }

    /// A fault of a number alone, whatever the rest of the request: the schema has the same bounds.
    pub fn in_range(&mut self, holds: bool, pointer: impl Into<String>, value: f64, rule: &str) -> bool {
        holds || self.require(false, pointer, format!("{} is out of range: {rule}", Shown(value)))
    }

    /// Requires a count, or an index, to lie in a range; `what` it counts.
    pub fn counted(
        &mut self,
        pointer: impl Into<String>,
        count: usize,
        range: RangeInclusive<usize>,
        what: &str,
    ) -> bool {
        let (least, most) = (range.start(), range.end());
        let detail = format!("{count} is out of range: {what} run from {least} to {most}");
        self.require(range.contains(&count), pointer, detail)
    }

    /// Requires a list to have so many items.
    pub fn listing(
        &mut self,
        pointer: impl Into<String>,
        count: usize,
        range: RangeInclusive<usize>,
        what: &str,
    ) -> bool {
        let (least, most) = (range.start(), range.end());
        let words = if *least == 0 { format!("at most {most}") } else { format!("{least} to {most}") };
        let detail = format!("{count} {what}, which is out of range: list {words}");
        self.require(range.contains(&count), pointer, detail)
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
