//! Half spaces, stored so that many are looked at together.

use super::norm;

/// Rows that are multiplied at a time.
pub(super) const LANES: usize = 8;

/// Half spaces `row . x + constant >= 0` whose rows have unit length and point inside.
#[derive(Debug, Clone, PartialEq)]
pub struct HalfSpaces {
    pub(super) unknowns: usize,
    rows: usize,
    /// So many rows at a time: their coefficients of every unknown, then their constants.
    pub(super) tiles: Vec<[f64; LANES]>,
}

impl HalfSpaces {
    /// None, over so many unknowns.
    pub fn new(unknowns: usize) -> Self {
        HalfSpaces { unknowns, rows: 0, tiles: Vec::new() }
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.unknowns
    }

    /// Adds `row . x + constant >= 0`, scaled to unit length.
    pub fn push(&mut self, row: &[f64], constant: f64) {
        let norm = norm(row);
        let lane = self.rows % LANES;
        if lane == 0 {
            // Rows that fill a tile up are never violated.
            self.tiles.extend(std::iter::repeat_n([0.0; LANES], self.unknowns));
            self.tiles.push([1.0; LANES]);
        }
        let start = self.tiles.len() - self.unknowns - 1;
        for (tile, value) in self.tiles[start..].iter_mut().zip(row.iter().chain([&constant])) {
            tile[lane] = value / norm;
        }
        self.rows += 1;
    }

    /// Shifts every half space outwards.
    pub fn relax(&mut self, by: f64) {
        let constants = self.tiles.chunks_exact_mut(self.unknowns + 1).map(|tile| &mut tile[self.unknowns]);
        constants.flatten().for_each(|constant| *constant += by);
    }

    /// Coefficient `j` of a row, its constant if `j` is the number of unknowns.
    pub(super) fn entry(&self, row: usize, j: usize) -> f64 {
        self.tiles[row / LANES * (self.unknowns + 1) + j][row % LANES]
    }
}
