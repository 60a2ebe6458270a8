//! The atlas as it is drawn: for every map and method the worst mark in each place. Written as `atlas.json` beside the pictures, which
//! can be drawn again from it.

use serde::{Deserialize, Serialize};

/// A map: what it is of, its axes, and what every method made of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Cells {
    pub name: String,
    pub title: String,
    pub across: Scale,
    pub up: Scale,
    pub methods: Vec<Method>,
}

/// An axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Scale {
    pub label: String,
    pub values: Vec<f64>,
}

/// What one method made of a map.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Method {
    pub name: String,
    /// One line for every value upwards, the greatest first; in it one of [`MARKS`] for every value across.
    pub rows: Vec<String>,
}

/// How a place is marked, best first: right, not told by the oracle, given up, not proven, wrong; and not run, or no arch.
pub const MARKS: [char; 6] = ['.', 'o', '-', '|', 'x', ' '];
/// The last of them.
pub const NOT_RUN: usize = MARKS.len() - 1;

impl Cells {
    /// With the marks that the classic methods, all but the first, had on the same map earlier, if they did.
    pub fn with_classic_of(mut self, earlier: &[Cells]) -> Self {
        let same = |other: &&Cells| other.name == self.name && other.across == self.across && other.up == self.up;
        if let Some(other) = earlier.iter().find(same) {
            self.methods.truncate(1);
            self.methods.extend(other.methods.iter().skip(1).cloned());
        }
        self
    }
}

impl Method {
    /// Of the worst of the marks (numbers of [`MARKS`]) in every place, across before up; what is not run counts only where nothing was.
    pub fn of(name: &str, [across, up]: [usize; 2], marks: impl Fn([usize; 2]) -> Vec<usize>) -> Self {
        let worst = |at| marks(at).into_iter().filter(|&mark| mark != NOT_RUN).max().unwrap_or(NOT_RUN);
        let row = |j| (0..across).map(|i| MARKS[worst([i, j])]).collect();
        Method { name: name.to_owned(), rows: (0..up).rev().map(row).collect() }
    }

    /// Number of the mark in a place, across before up.
    pub fn mark(&self, [i, j]: [usize; 2]) -> usize {
        let row = self.rows.len().checked_sub(j + 1).and_then(|row| self.rows.get(row));
        let mark = row.and_then(|row| row.chars().nth(i));
        MARKS.iter().position(|&known| Some(known) == mark).unwrap_or(NOT_RUN)
    }
}
