//! Four-sided parts of a stone, and the lines that are drawn in them.

use crate::geometry::{Vec2, cross, distance_from_segment, perpendicular};
use crate::structure::Sides;

/// Shape of the lines of a grid that run along the arch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in super::super) enum Lines {
    /// Straight from joint to joint.
    Straight,
    /// Arcs about one centre, m.
    Arcs(Vec2),
    /// Chords of such arcs, subblock by subblock; for comparison only.
    Chords(Vec2),
}

impl From<Sides> for Lines {
    fn from(sides: Sides) -> Self {
        match sides {
            Sides::Straight | Sides::Compound => Lines::Straight,
            Sides::Arcs { centre } => Lines::Arcs(centre),
        }
    }
}

/// A side: points, m, and their places, from 0 at the first to 1 at the last by the length of the way.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Polyline {
    pub points: Vec<Vec2>,
    pub places: Vec<f64>,
}

impl From<Vec<Vec2>> for Polyline {
    fn from(points: Vec<Vec2>) -> Self {
        let lengths = points.windows(2).scan(0.0, |sum, ends| {
            *sum += (ends[1] - ends[0]).norm();
            Some(*sum)
        });
        let lengths: Vec<f64> = std::iter::once(0.0).chain(lengths).collect();
        let whole = lengths[lengths.len() - 1];
        Polyline { points, places: lengths.iter().map(|length| length / whole).collect() }
    }
}

impl Polyline {
    fn ends(&self) -> [Vec2; 2] {
        [self.points[0], self.points[self.points.len() - 1]]
    }

    pub fn is_straight(&self) -> bool {
        self.points.len() == 2
    }

    /// The point at a place.
    fn at(&self, place: f64) -> Vec2 {
        let k = self.places.partition_point(|&p| p <= place).clamp(1, self.points.len() - 1);
        let [(a, from), (b, to)] = [k - 1, k].map(|k| (self.points[k], self.places[k]));
        a + (b - a) * ((place - from) / (to - from))
    }

    /// Points between two places, which are no points of its own to `near`.
    pub fn between(&self, from: f64, to: f64, near: f64) -> impl DoubleEndedIterator<Item = Vec2> {
        let inside = move |place: f64| place > from + near && place < to - near;
        self.points.iter().zip(&self.places).filter(move |(_, place)| inside(**place)).map(|(point, _)| *point)
    }

    /// Distance of a point, m, and the place of what is nearest to it.
    pub fn nearest(&self, point: Vec2) -> (f64, f64) {
        let segment = |k: usize| {
            let [a, b] = [self.points[k], self.points[k + 1]];
            let share = (point - a).dot(&(b - a)) / (b - a).norm_squared();
            (distance_from_segment(point, a, b), self.places[k] + (self.places[k + 1] - self.places[k]) * share)
        };
        let nearer = |best: (f64, f64), k: usize| if segment(k).0 < best.0 { segment(k) } else { best };
        (1..self.points.len() - 1).fold(segment(0), nearer)
    }

    /// Both halves.
    pub fn halves(&self, near: f64) -> [Vec<Vec2>; 2] {
        let ([from, to], middle) = (self.ends(), self.at(0.5));
        let part = |a: Vec2, [from, to]: [f64; 2], b: Vec2| {
            std::iter::once(a).chain(self.between(from, to, near)).chain([b]).collect()
        };
        [part(from, [0.0, 0.5], middle), part(middle, [0.5, 1.0], to)]
    }
}

/// A part of a stone with four sides. Places in it are (xi, eta): xi from 0 at the side before to 1 at that after, eta from 0
/// at the intrados to 1 at the extrados.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Patch {
    /// Intrados and extrados end of the side before and of the side after, m.
    pub ends: [[Vec2; 2]; 2],
    /// Shape of the lines along the arch.
    pub lines: Lines,
    /// The sides: before and after, each from intrados to extrados; intrados and extrados, each from before to after.
    pub sides: [Polyline; 4],
}

impl Patch {
    /// Between two straight sides, each from intrados to extrados.
    pub fn new(ends: [[Vec2; 2]; 2], lines: Lines) -> Self {
        let [[a, d], [b, c]] = ends;
        let sides = [[a, d], [b, c], [a, b], [d, c]].map(|side| Polyline::from(side.to_vec()));
        Patch { ends, lines, sides }
    }

    /// With these sides, which go round it: intrados, after, extrados and before.
    pub fn within([intrados, after, mut extrados, mut before]: [Vec<Vec2>; 4]) -> Self {
        extrados.reverse();
        before.reverse();
        let sides = [before, after, intrados, extrados].map(Polyline::from);
        Patch { ends: [sides[0].ends(), sides[1].ends()], lines: Lines::Straight, sides }
    }

    pub fn has_straight_sides(&self) -> bool {
        self.sides.iter().all(Polyline::is_straight)
    }

    /// The point at (xi, eta), m; between sides with corners by blending them (Coons 1967).
    pub fn point(&self, xi: f64, eta: f64) -> Vec2 {
        let [before, after] = self.ends.map(|[i, e]| i + (e - i) * eta);
        match self.lines {
            Lines::Straight if self.has_straight_sides() => before + (after - before) * xi,
            Lines::Straight => {
                let blended = |[from, to]: [Vec2; 2], share: f64| from + (to - from) * share;
                let off = |side: usize, place: f64| {
                    let side = &self.sides[side];
                    side.at(place) - blended(side.ends(), place)
                };
                // What the sides are off their chords is added to what lies between straight ones.
                before
                    + (after - before) * xi
                    + blended([off(0, eta), off(1, eta)], xi)
                    + blended([off(2, xi), off(3, xi)], eta)
            }
            Lines::Arcs(centre) | Lines::Chords(centre) => {
                let (a, b) = (before - centre, after - centre);
                let turn = xi * cross(a, b).atan2(a.dot(&b));
                let radius = a.norm() + (b.norm() - a.norm()) * xi;
                let (sin, cos) = turn.sin_cos();
                centre + (a * cos + perpendicular(a) * sin).normalize() * radius
            }
        }
    }

    /// Largest ratio of the longer to the shorter extent of the parts of which there are `radial` from intrados to extrados.
    pub fn slenderness(&self, radial: usize, along: usize) -> f64 {
        let [before, after] = self.ends.map(|[i, e]| (e - i).norm() / radial as f64);
        let [inner, outer] = [0, 1].map(|face| (self.ends[1][face] - self.ends[0][face]).norm() / along as f64);
        let ratio = |a: f64, b: f64| (a / b).max(b / a);
        ratio(before.max(after), inner.min(outer)).max(ratio(before.min(after), inner.max(outer)))
    }
}
