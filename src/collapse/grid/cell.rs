//! Places in a subblock: in its part of the stone they count from 0 to 1 either way, along first.

use super::{Grid, Order, places};
use crate::dda::{GAUSS_3, SecondOrder};
use crate::geometry::{Vec2, cross};

/// Step of the central differences that stand for the derivatives of a part's map.
const DIFFERENCE: f64 = 1e-5;

impl Grid {
    /// Places where stress in subblock (i, j) is known best: its centroid, or the samples of one of second order.
    pub(in super::super) fn samples(&self, i: usize, j: usize) -> Vec<[f64; 2]> {
        match self.order {
            Order::Second => SecondOrder::SAMPLES.map(|local| self.place_in(i, j, local)).to_vec(),
            Order::First if self.patches.is_empty() => vec![[0.5; 2]],
            Order::First => {
                let (xi, eta) = places::place(&self.patches[j / self.columns()], self.region(i, j).centroid);
                vec![[xi, eta]]
            }
        }
    }

    /// Places of the corners of subblock (i, j), as many as its outline has.
    pub(in super::super) fn corners(&self, i: usize, j: usize) -> Vec<[f64; 2]> {
        let outline = &self.outlines[self.number(i, j)];
        match self.patches.get(j / self.columns()) {
            None => vec![[0.5; 2]; outline.len()],
            Some(_) if outline.len() == 4 => {
                [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|local| self.place_in(i, j, local)).to_vec()
            }
            Some(patch) => outline.iter().map(|&corner| <[f64; 2]>::from(places::place(patch, corner))).collect(),
        }
    }

    /// The rows from which to which, and the columns, of so many neighbours either way of a subblock, itself in the middle where there are as
    /// many on either side in its part.
    pub(in super::super) fn around(&self, [i, j]: [usize; 2], count: usize) -> [usize; 4] {
        let (columns, part) = (self.columns(), j / self.columns());
        let range = |k: usize, all: usize| {
            let size = count.min(all);
            let first = k.saturating_sub(size / 2).min(all - size);
            [first, first + size]
        };
        let ([low, high], [from, to]) = (range(i, self.radial), range(j % columns, columns));
        [low, high, part * columns + from, part * columns + to]
    }

    /// Places of Gauss's rule in subblock (i, j) of a stone that is cut: in it from -1 to 1, in its part, and the area that each stands
    /// for, m2.
    pub(in super::super) fn quadrature(&self, i: usize, j: usize) -> Vec<([f64; 2], [f64; 2], f64)> {
        let (patch, column) = (&self.patches[j / self.columns()], j % self.columns());
        let sizes = [self.lines[1][column + 1] - self.lines[1][column], self.lines[0][i + 1] - self.lines[0][i]];
        let all = GAUSS_3.iter().flat_map(|x| GAUSS_3.iter().map(move |y| (*x, *y)));
        all.map(|((x, w), (y, v))| {
            let [xi, eta] = self.place_in(i, j, [x, y]);
            let by_xi = (patch.point(xi + DIFFERENCE, eta) - patch.point(xi - DIFFERENCE, eta)) / (2.0 * DIFFERENCE);
            let by_eta = (patch.point(xi, eta + DIFFERENCE) - patch.point(xi, eta - DIFFERENCE)) / (2.0 * DIFFERENCE);
            ([x, y], [xi, eta], 0.25 * w * v * sizes[0] * sizes[1] * cross(by_xi, by_eta))
        })
        .collect()
    }

    /// The point at a place in the part that has column `j`, m.
    pub(in super::super) fn point(&self, j: usize, [xi, eta]: [f64; 2]) -> Vec2 {
        self.patches[j / self.columns()].point(xi, eta)
    }

    /// The place in its part of a place in subblock (i, j), from -1 to 1.
    fn place_in(&self, i: usize, j: usize, local: [f64; 2]) -> [f64; 2] {
        let between = |lines: &[f64], k: usize, local: f64| {
            0.5 * (lines[k] + lines[k + 1]) + 0.5 * local * (lines[k + 1] - lines[k])
        };
        [between(&self.lines[1], j % self.columns(), local[0]), between(&self.lines[0], i, local[1])]
    }
}
