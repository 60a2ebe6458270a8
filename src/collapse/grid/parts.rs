//! Into which four-sided parts a body is divided before it is cut.
//!
//! Corners that turn little (a ring's, where joints of the next ring meet it) are left to the sides. A body with four others is one
//! part, as a voussoir is. Any other is divided from its centroid to the middles of its sides, a part at every corner: of a
//! convex body with straight sides each part is convex, for its centroid lies beyond the line between the middles of any
//! two neighbouring sides.

use super::patch::{Patch, Polyline};
use super::{Cut, Grid, ON_LINE};
use crate::geometry::{Vec2, cross, segments_meet};
use crate::structure::{Body, Sides};

/// A corner that turns by less than this, rad, is left to the side: 35 degrees, which no regular polygon has, so that rounding
/// tells none of its corners apart.
const SHARP: f64 = 35.0 * std::f64::consts::PI / 180.0;
/// The same of a round body, which has no sharp corners.
const TURNS: f64 = std::f64::consts::PI / 180.0;
/// Subblocks each way with which a division is tried.
const TRIED: usize = 4;

/// The parts of a body; none where it cannot be cut.
pub(super) fn parts(body: &Body) -> Vec<Patch> {
    if body.is_quadrilateral() {
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| body.corners[i]);
        return vec![Patch::new([[a, d], [b, c]], body.sides.into())];
    }
    let turns: Vec<f64> = (0..body.corners.len()).map(|i| turn(body, i)).collect();
    // NaN turns inwards.
    if body.sides != Sides::Straight || !turns.iter().all(|turn| *turn > -SHARP) {
        return Vec::new();
    }
    let corners = |least: f64| (0..turns.len()).filter(|&i| turns[i] > least).collect::<Vec<_>>();
    let divisions = [SHARP, TURNS].map(corners).into_iter().filter(|corners| corners.len() >= 3);
    let tried = |parts: &Vec<Patch>| [TRIED, TRIED * parts.len()];
    let serves = |parts: &Vec<Patch>| Grid::cut(body, parts.clone(), tried(parts), Cut::default()).is_some();
    divisions.map(|corners| divided(body, &corners)).find(serves).unwrap_or_default()
}

/// By how much the outline turns to the left at a corner, rad.
fn turn(body: &Body, i: usize) -> f64 {
    let n = body.corners.len();
    let [before, here, after] = [i + n - 1, i, i + 1].map(|i| body.corners[i % n]);
    let (a, b) = (here - before, after - here);
    cross(a, b).atan2(a.dot(&b))
}

/// The parts of a body between these of its corners.
fn divided(body: &Body, corners: &[usize]) -> Vec<Patch> {
    let (n, m) = (body.corners.len(), corners.len());
    let side = |k: usize| {
        let (from, to) = (corners[k % m], corners[(k + 1) % m]);
        let count = (to + n - from - 1) % n + 1;
        (from..=from + count).map(|i| body.corners[i % n]).collect::<Vec<Vec2>>()
    };
    if m == 4 {
        return vec![Patch::within([0, 1, 2, 3].map(side))];
    }
    let halves: Vec<[Vec<Vec2>; 2]> = (0..m).map(|k| Polyline::from(side(k)).halves(ON_LINE)).collect();
    let centre = body.region.centroid;
    let part = |k: usize| {
        let ([onwards, _], [_, hither]) = (halves[k].clone(), halves[(k + m - 1) % m].clone());
        let [next, last] = [onwards[onwards.len() - 1], hither[0]];
        Patch::within([onwards, vec![next, centre], vec![centre, last], hither])
    };
    (0..m).map(part).collect()
}

/// Whether no two sides of a polygon cross.
pub(super) fn is_simple(corners: &[Vec2]) -> bool {
    let n = corners.len();
    let side = |i: usize| [corners[i], corners[(i + 1) % n]];
    let meet = |i: usize, j: usize| {
        let ([a, b], [c, d]) = (side(i), side(j));
        segments_meet(a, b, c, d)
    };
    (0..n).all(|i| (i + 2..n).all(|j| (j + 1) % n == i || !meet(i, j)))
}
