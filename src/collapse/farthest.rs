//! How far the body that has moved farthest has moved.
//!
//! From one point of a path to another no body moves by more than the path is long between them. One that was behind by more than
//! that needs no look.

use super::discretise::Model;

/// A bound that is off by less than this share is off by rounding.
const ROUNDING: f64 = 1e-9;

/// Finds the largest mean displacement of a body at one point of a path after the other.
pub(super) struct Farthest {
    /// The most that a body moves by while no node moves by more than 1 m, and while the load factor changes by 1 with nodes held, m.
    most: [f64; 2],
    /// How long the path is so far, as bodies may move along it, m; nodes' way and load factor at the last point.
    length: f64,
    last: [f64; 2],
    /// How far every body had moved less the length of the path when it was looked at last, m.
    bounds: Vec<f64>,
    first: usize,
}

impl Farthest {
    pub(super) fn new(model: &Model) -> Self {
        let most = [model.assembly.most_shift(), model.scaled.most_shift()];
        Farthest { most, length: 0.0, last: [0.0; 2], bounds: vec![f64::INFINITY; model.bodies], first: 0 }
    }

    /// The largest displacement at the next point, by which nodes cannot have gone farther along their axes than `travelled`.
    pub(super) fn at(&mut self, model: &Model, load_factor: f64, displacements: &[f64], travelled: f64) -> f64 {
        let loads = model.loads_at(load_factor);
        let gone = [travelled - self.last[0], (load_factor - self.last[1]).abs()];
        self.length += self.most[0] * gone[0] + self.most[1] * gone[1];
        self.last = [travelled, load_factor];
        let look = |body: usize| model.assembly.shift(body, displacements, &loads);
        // The one that was first is likely to be.
        let mut largest = look(self.first);
        for (body, bound) in self.bounds.iter_mut().enumerate() {
            if *bound + self.length > largest * (1.0 - ROUNDING) {
                let shift = look(body);
                *bound = shift - self.length;
                if shift > largest {
                    (largest, self.first) = (shift, body);
                }
            }
        }
        debug_assert_eq!(largest, (0..self.bounds.len()).map(look).fold(0.0, f64::max), "at load factor {load_factor}");
        largest
    }
}
