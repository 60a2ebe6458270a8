//! What sees a strip: the topmost sides that look up, between the planes of dispersal, unless others stand in the way.
//!
//! Beside the strip a point that sees any of it sees its nearer edge. From there every point is seen under a slope,
//! distance over depth. It is seen if nothing nearer has a greater slope, and loaded up to the slope of the planes.

use super::super::{LoadFault, LoadedSide};
use crate::geometry::Vec2;

/// Slopes are compared with this slack, so that a side along a line of sight is seen.
const GRAZING: f64 = 1e-12;

/// A part of a side, or of a level line beyond the ends, from left to right.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Part {
    /// Number of the side; `None`: a level line.
    pub side: Option<usize>,
    /// Left end, m.
    pub a: Vec2,
    /// Right end, m.
    pub b: Vec2,
}

/// A strip on the surface.
pub(super) struct Strip {
    /// Abscissae of its left and its right edge, m.
    pub edges: [f64; 2],
    /// Height of the surface, m.
    pub surface: f64,
    /// Slope of the planes of dispersal, horizontal over vertical.
    pub reach: f64,
    /// Lengths up to this are nothing, m.
    pub near: f64,
}

impl Part {
    fn at(&self, x: f64) -> Vec2 {
        self.a + (self.b - self.a) * ((x - self.a.x) / (self.b.x - self.a.x))
    }

    /// The part between two abscissae of it. Its own ends stay what they are.
    fn between(&self, from: f64, to: f64) -> Part {
        let end = |x: f64| match x {
            _ if x <= self.a.x => self.a,
            _ if x >= self.b.x => self.b,
            // Where it is cut belongs to both sides of the cut.
            _ => Vec2::new(x, self.at(x).y),
        };
        Part { a: end(from), b: end(to), ..*self }
    }

    /// The part where what is linear along it is not negative.
    fn within(&self, linear: impl Fn(Vec2) -> f64) -> Option<Part> {
        let cut = |from: f64, to: f64| self.a + (self.b - self.a) * (from / (from - to));
        match (linear(self.a), linear(self.b)) {
            (a, b) if a >= 0.0 && b >= 0.0 => Some(*self),
            (a, b) if a > 0.0 => Some(Part { b: cut(a, b), ..*self }),
            (a, b) if b > 0.0 => Some(Part { a: cut(a, b), ..*self }),
            _ => None,
        }
    }
}

impl Strip {
    /// The parts that are loaded, each belonging to one of `sides` or to the level lines that continue them beyond both ends.
    ///
    /// # Errors
    /// When one of them lies above the surface under the strip.
    pub(super) fn sees(&self, sides: &[LoadedSide]) -> Result<Vec<Part>, LoadFault> {
        let [left, right] = self.edges;
        let side = |(i, &(_, a, b)): (usize, &LoadedSide)| Part { side: Some(i), a, b };
        let all = sides.iter().enumerate().map(side).chain(self.level_lines(sides));
        let top = topmost(all.filter(|part| part.b.x > part.a.x).collect(), self.edges);
        let (before, rest): (Vec<Part>, Vec<Part>) = top.into_iter().partition(|part| part.b.x <= left);
        let (under, after): (Vec<Part>, Vec<Part>) = rest.into_iter().partition(|part| part.b.x <= right);
        let top = under.iter().flat_map(|part| [part.a.y, part.b.y]).fold(f64::NEG_INFINITY, f64::max);
        if top > self.surface + self.near {
            return Err(LoadFault::SurfaceBelowExtrados { top });
        }
        let mut seen = self.beside(before.into_iter().rev(), |x| left - x);
        seen.extend(under);
        seen.extend(self.beside(after.into_iter(), |x| x - right));
        seen.retain(|part| part.b.x - part.a.x > self.near);
        Ok(seen)
    }

    /// From either end of the sides outwards, as far as the planes reach.
    fn level_lines(&self, sides: &[LoadedSide]) -> Vec<Part> {
        let (Some(&(_, first, _)), Some(&(_, _, last))) = (sides.first(), sides.last()) else { return Vec::new() };
        let far = |from: Vec2| self.reach * (self.surface - from.y).max(0.0);
        let end = |x: f64, y: f64| Vec2::new(x, y);
        vec![
            Part { side: None, a: end(self.edges[0] - far(first), first.y), b: first },
            Part { side: None, a: last, b: end(self.edges[1] + far(last), last.y) },
        ]
    }

    /// Of the topmost parts on one side of the strip, from the strip outwards, those that are loaded; `distance` from its edge.
    fn beside(&self, parts: impl Iterator<Item = Part>, distance: impl Fn(f64) -> f64) -> Vec<Part> {
        let depth = |point: Vec2| self.surface - point.y;
        let slope = |point: Vec2| match (distance(point.x), depth(point)) {
            (u, _) if u <= self.near => 0.0,
            (_, z) if z <= 0.0 => f64::INFINITY,
            (u, z) => u / z,
        };
        let (mut horizon, mut loaded) = (0.0f64, Vec::new());
        for part in parts {
            if horizon >= self.reach * (1.0 + GRAZING) {
                break;
            }
            let unhidden = part.within(|p| distance(p.x) - (1.0 - GRAZING) * horizon * depth(p));
            let inside = |part: Part| part.within(|p| self.reach * depth(p) - distance(p.x));
            loaded.extend(unhidden.and_then(inside));
            horizon = horizon.max(slope(part.a)).max(slope(part.b));
        }
        loaded
    }
}

/// At every abscissa the topmost part, from left to right, cut where others begin or end and at `cuts`. They do not cross.
fn topmost(mut parts: Vec<Part>, cuts: [f64; 2]) -> Vec<Part> {
    parts.sort_by(|one, other| one.a.x.total_cmp(&other.a.x));
    let mut stops: Vec<f64> = parts.iter().flat_map(|part| [part.a.x, part.b.x]).chain(cuts).collect();
    stops.sort_unstable_by(f64::total_cmp);
    let (mut waiting, mut open) = (parts.into_iter().peekable(), Vec::<Part>::new());
    let mut top = Vec::new();
    for stop in stops.windows(2).filter(|stop| stop[1] > stop[0]) {
        while let Some(part) = waiting.next_if(|part| part.a.x <= stop[0]) {
            open.push(part);
        }
        open.retain(|part| part.b.x >= stop[1]);
        let height = |part: &Part| part.at(0.5 * (stop[0] + stop[1])).y;
        let highest = open.iter().max_by(|one, other| height(one).total_cmp(&height(other)));
        top.extend(highest.map(|part| part.between(stop[0], stop[1])));
    }
    top
}
