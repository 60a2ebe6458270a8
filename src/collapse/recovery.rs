//! Stress inside a stone as a smooth field, recovered from that of its subblocks; and what the two differ by.
//!
//! Stress at the middle of a constant-strain subblock, and at the four samples of a second-order one, is better than elsewhere in it
//! (Barlow 1976). So around every subblock a polynomial is fitted to that of its neighbours, three either way and all of one stone:
//! stones do not share stress at their joints, which may slide and open. Of constant-strain subblocks what it says is several times
//! better than they are. Of second-order ones it is not, next to hinges; but how far it is from what goes through their samples is about
//! as much as that is off (Zienkiewicz and Zhu 1992).

use super::grid::Grid;
use super::near_point::NearPoint;
use super::report::{Roughness, apart};
use super::{Order, SubblockStress};
use crate::geometry::{Vec2, mirrored};
use nalgebra::DMatrix;

/// Neighbours either way that a fit takes in.
const WINDOW: usize = 3;
/// Powers of the place either way that the polynomial of second-order subblocks has.
const CUBIC: usize = 3;
/// The same of constant-strain ones; and of both places together.
const QUADRATIC: usize = 2;

/// Stress of subblocks, subblock by subblock.
pub(super) struct Told {
    /// At their corners, Pa.
    pub corners: Vec<Vec<[f64; 3]>>,
    /// How far it is from the smooth field; of second order only.
    pub roughness: Roughness,
}

/// A polynomial of the place in a part of a stone, from 0 to 1 either way.
#[derive(Debug, Clone, Default)]
struct Piece {
    middle: [f64; 2],
    half: [f64; 2],
    /// Exponents of the terms, and what each contributes to sigma_x, sigma_y and tau_xy, Pa.
    terms: Vec<([i32; 2], [f64; 3])>,
}

impl Piece {
    fn at(&self, place: [f64; 2]) -> [f64; 3] {
        let [x, y] = self.local(place);
        self.terms.iter().fold([0.0; 3], |sum, (powers, terms)| {
            let share = x.powi(powers[0]) * y.powi(powers[1]);
            [0, 1, 2].map(|c| sum[c] + share * terms[c])
        })
    }

    fn local(&self, place: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|way| (place[way] - self.middle[way]) / self.half[way])
    }
}

/// The field of a stone with these stresses at the samples of its subblocks; how rough it is leaves out what is near forces on points.
pub(super) fn tell(grid: &Grid, samples: &[[f64; 3]], near: &[NearPoint]) -> Told {
    let pieces = recovered(grid, samples);
    match grid.order {
        Order::First => {
            let corners = grid.cells().zip(&pieces);
            let corners =
                corners.map(|((i, j), piece)| grid.corners(i, j).into_iter().map(|at| piece.at(at)).collect());
            Told { corners: corners.collect(), roughness: Roughness::default() }
        }
        Order::Second => {
            let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
            let of_subblock = |of: &[[f64; 3]]| corners.map(|local| through(of, local)).to_vec();
            let corners = samples.chunks_exact(4).map(of_subblock).collect();
            Told { corners, roughness: roughness(grid, samples, &pieces, near) }
        }
    }
}

/// The smooth field.
fn recovered(grid: &Grid, samples: &[[f64; 3]]) -> Vec<Piece> {
    let places: Vec<Vec<[f64; 2]>> = grid.cells().map(|(i, j)| grid.samples(i, j)).collect();
    let (each, second) = (samples.len() / places.len(), grid.order == Order::Second);
    let mut last = ([0; 4], Piece::default());
    let piece = |(i, j): (usize, usize)| {
        let window @ [low, high, from, to] = grid.around([i, j], WINDOW);
        if last.0 != window {
            let numbers = (from..to).flat_map(|j| (low..high).map(move |i| (i, j))).map(|(i, j)| grid.number(i, j));
            let of = |k: usize| places[k].iter().copied().zip(samples[each * k..each * (k + 1)].iter().copied());
            let taken: Vec<([f64; 2], [f64; 3])> = numbers.flat_map(of).collect();
            let (either, together) = if second { (CUBIC, 2 * CUBIC) } else { (QUADRATIC, QUADRATIC) };
            let most = [to - from, high - low].map(|count| (count * each.isqrt() - 1).min(either));
            last = (window, fitted(&taken, most, together));
        }
        last.1.clone()
    };
    grid.cells().map(piece).collect()
}

/// The polynomial of at most so many powers either way, and so many together, nearest to these stresses at their places.
fn fitted(samples: &[([f64; 2], [f64; 3])], most: [usize; 2], together: usize) -> Piece {
    let extents = [0, 1].map(|way: usize| {
        let places = samples.iter().map(|(place, _)| place[way]);
        places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), place| (low.min(place), high.max(place)))
    });
    let middle = extents.map(|(low, high)| 0.5 * (low + high));
    let half = extents.map(|(low, high)| if high > low { 0.5 * (high - low) } else { 1.0 });
    let powers = (0..=most[0]).flat_map(|a| (0..=most[1]).map(move |b| [a, b]));
    let powers: Vec<[i32; 2]> =
        powers.filter(|[a, b]| a + b <= together).map(|powers| powers.map(|p| p as i32)).collect();
    let mut piece = Piece { middle, half, terms: Vec::new() };
    let matrix = DMatrix::from_fn(samples.len(), powers.len(), |row, term| {
        let ([x, y], [a, b]) = (piece.local(samples[row].0), powers[term]);
        x.powi(a) * y.powi(b)
    });
    let right = DMatrix::from_fn(samples.len(), 3, |row, c| samples[row].1[c]);
    let solved = matrix.tr_mul(&matrix).cholesky().map(|normal| normal.solve(&matrix.tr_mul(&right)));
    // Places that differ make it definite.
    let solved = solved.unwrap_or_else(|| DMatrix::from_element(powers.len(), 3, f64::NAN));
    piece.terms = powers.into_iter().enumerate().map(|(t, power)| (power, [0, 1, 2].map(|c| solved[(t, c)]))).collect();
    piece
}

/// How far the smooth field of a stone is from the one that goes through the samples of its subblocks.
fn roughness(grid: &Grid, samples: &[[f64; 3]], pieces: &[Piece], near: &[NearPoint]) -> Roughness {
    let coarse = grid.radial.min(grid.columns()) <= WINDOW;
    let near_point = !near.iter().all(|near| grid.has_lines_through(near.centre));
    let mut sum = Roughness { coarse, near_point, ..Roughness::default() };
    for ((of, (i, j)), piece) in samples.chunks_exact(4).zip(grid.cells()).zip(pieces) {
        let counts = |place: &[f64; 2]| !near.iter().any(|near| near.has(grid.point(j, *place)));
        for (local, place, area) in grid.quadrature(i, j).into_iter().filter(|(_, place, _)| counts(place)) {
            let (here, smooth) = (through(of, local), piece.at(place));
            sum.apart += area * apart(smooth, here);
            sum.whole += area * apart(here, [0.0; 3]);
        }
    }
    sum
}

/// Stress at a place of a second-order subblock, from -1 to 1 either way, by what its samples say, in the order of
/// [`SecondOrder::SAMPLES`](crate::dda::SecondOrder::SAMPLES): bilinear between and beyond them.
pub(super) fn through(samples: &[[f64; 3]], [x, y]: [f64; 2]) -> [f64; 3] {
    let root = 3.0f64.sqrt();
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let shares = corners.map(|[p, q]| 0.25 * (1.0 + p * root * x) * (1.0 + q * root * y));
    [0, 1, 2].map(|c| samples.iter().zip(shares).map(|(stress, share)| share * stress[c]).sum())
}

/// Corners of a subblock as seen from the other side of a mirror: each with the stress at its image in the subblock there.
pub(super) fn mirrored_corners(here: &SubblockStress, image: &SubblockStress, axis: f64) -> Vec<[f64; 3]> {
    let stress = |corner: &Vec2| {
        let wanted = mirrored(*corner, axis);
        let far = |k: &usize| (image.corners[*k] - wanted).norm();
        let nearest = (0..image.corners.len()).min_by(|a, b| far(a).total_cmp(&far(b)));
        let [x, y, tau] = nearest.map_or([f64::NAN; 3], |k| image.corner_stress[k]);
        [x, y, -tau]
    };
    here.corners.iter().map(stress).collect()
}

#[cfg(test)]
mod tests;
