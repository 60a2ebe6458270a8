//! One polygon: whether it can be a stone, and its straight faces.

use super::Polygon;
use super::fault::{BlocksFault, MAX_CORNERS};
use crate::geometry::{Region, Vec2, cross, distance_from_segment, segments_meet};

/// A straight piece of an outline: a side, or consecutive sides on one line. The stone lies to its left.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    /// Its beginning, m.
    pub from: Vec2,
    /// Its end, m.
    pub to: Vec2,
}

impl Edge {
    /// Unit vector along it.
    pub fn direction(&self) -> Vec2 {
        (self.to - self.from).normalize()
    }

    /// Least and greatest coordinates, m.
    pub fn bounds(&self) -> [Vec2; 2] {
        [self.from.inf(&self.to), self.from.sup(&self.to)]
    }

    /// The same piece seen from the other side.
    pub fn reversed(&self) -> Edge {
        Edge { from: self.to, to: self.from }
    }
}

/// A polygon that can be a stone.
#[derive(Debug, Clone)]
pub(super) struct Outline {
    /// Corners, counter-clockwise, m.
    pub corners: Vec<Vec2>,
    /// Area (positive) and centroid.
    pub region: Region,
    /// Straight faces, in the order of the outline.
    pub runs: Vec<Edge>,
    /// Least and greatest coordinates, m.
    pub bounds: [Vec2; 2],
    /// True when the corners were given clockwise.
    reversed: bool,
}

impl Outline {
    /// Checks `polygon`.
    ///
    /// # Errors
    /// What keeps it from being a stone: the first of missing corners, coordinates that are not finite, short sides, sides that
    /// cross, no area.
    pub fn new(polygon: &Polygon, tolerance: f64) -> Result<Outline, BlocksFault> {
        let mut corners = open(polygon)?.to_vec();
        let name = || polygon.name.clone();
        let sides = corners.len();
        for side in 0..sides {
            let length = (corners[(side + 1) % sides] - corners[side]).norm();
            if length.is_nan() || length <= tolerance {
                return Err(BlocksFault::SideTooShort { polygon: name(), side, length, tolerance });
            }
        }
        // A triangle does not cross itself; it is flat at worst.
        if let Some(sides) = (sides > 3).then(|| crossing(&corners, tolerance)).flatten() {
            return Err(BlocksFault::CrossesItself { polygon: name(), sides });
        }
        let mut region = Region::polygon(&corners);
        let perimeter: f64 = (0..sides).map(|i| (corners[(i + 1) % sides] - corners[i]).norm()).sum();
        // Two areas by the perimeter is about the thickness of what is thin.
        let thickness = 2.0 * region.area.abs() / perimeter;
        if !thickness.is_finite() || thickness <= tolerance {
            return Err(BlocksFault::NoArea { polygon: name(), tolerance });
        }
        let reversed = region.area < 0.0;
        if reversed {
            corners[1..].reverse();
            region.area = -region.area;
        }
        let bounds = bounds(&corners);
        Ok(Outline { runs: runs(&corners, tolerance), corners, region, bounds, reversed })
    }

    /// The side that was given with number `side`.
    pub fn side(&self, side: usize) -> Option<Edge> {
        let n = self.corners.len();
        let last = n.checked_sub(side + 1)?;
        let here = if self.reversed { last } else { side };
        Some(Edge { from: self.corners[here], to: self.corners[(here + 1) % n] })
    }

    /// Number of sides.
    pub fn sides(&self) -> usize {
        self.corners.len()
    }
}

/// The corners, without the first one if it is given again at the end to close the outline.
///
/// # Errors
/// Too few, too many, not finite.
pub(super) fn open(polygon: &Polygon) -> Result<&[Vec2], BlocksFault> {
    let name = || polygon.name.clone();
    let corners = match polygon.corners.as_slice() {
        [first, inner @ .., last] if inner.len() > 2 && first == last => &polygon.corners[..polygon.corners.len() - 1],
        all => all,
    };
    if corners.len() < 3 {
        return Err(BlocksFault::TooFewCorners { polygon: name(), corners: corners.len() });
    }
    if corners.len() > MAX_CORNERS {
        return Err(BlocksFault::TooManyCorners { polygon: name(), corners: corners.len() });
    }
    match corners.iter().position(|corner| !(corner.x.is_finite() && corner.y.is_finite())) {
        Some(corner) => Err(BlocksFault::CornerNotFinite { polygon: name(), corner }),
        None => Ok(corners),
    }
}

/// Least and greatest coordinates.
pub(super) fn bounds(points: &[Vec2]) -> [Vec2; 2] {
    points.iter().fold([points[0]; 2], |[low, high], point| [low.inf(point), high.sup(point)])
}

/// Whether two boxes, given by their least and greatest coordinates, are no farther apart than `reach` along either axis.
pub(super) fn near(a: [Vec2; 2], b: [Vec2; 2], reach: f64) -> bool {
    (0..2).all(|axis| a[0][axis] <= b[1][axis] + reach && b[0][axis] <= a[1][axis] + reach)
}

/// Two sides with a point in common that they should not have.
fn crossing(corners: &[Vec2], tolerance: f64) -> Option<[usize; 2]> {
    let n = corners.len();
    let side = |i: usize| (corners[i % n], corners[(i + 1) % n]);
    for i in 0..n {
        let ((a, b), (_, c)) = (side(i), side(i + 1));
        // A side that runs back over the one before.
        let (back, ahead) = ((b - a).dot(&(c - b)) < 0.0, (c - b).norm() < (b - a).norm());
        let near = if ahead { distance_from_segment(c, a, b) } else { distance_from_segment(a, b, c) };
        if back && near <= tolerance {
            return Some([i, (i + 1) % n]);
        }
        for j in i + 2..n {
            let (c, d) = side(j);
            if (j + 1) % n != i && segments_meet(a, b, c, d) {
                return Some([i, j]);
            }
        }
    }
    None
}

/// Straight faces: consecutive sides are one where the corners between them lie within the tolerance of the line from end to end.
fn runs(corners: &[Vec2], tolerance: f64) -> Vec<Edge> {
    let n = corners.len();
    let at = |i: usize| corners[i % n];
    // Begun at the sharpest corner, which ends a face however the corners are counted.
    let turn = |i: usize| {
        let (before, after) = (at(i) - at(i + n - 1), at(i + 1) - at(i));
        cross(before, after).atan2(before.dot(&after)).abs()
    };
    let start = (1..n).fold(0, |best, i| if turn(i) > turn(best) { i } else { best });
    let (mut runs, mut from) = (Vec::new(), start);
    while from < start + n {
        let straight = |to: usize| (from + 1..to).all(|i| distance_from_segment(at(i), at(from), at(to)) <= tolerance);
        let mut to = from + 1;
        while to < start + n && straight(to + 1) {
            to += 1;
        }
        runs.push(Edge { from: at(from), to: at(to) });
        from = to;
    }
    runs
}
