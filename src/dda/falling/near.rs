//! Which parts of bodies are near to each other, and where they touch.

use super::body::Position;
use super::entrance::{AtCorner, CutPolygon, Entrance, Touching, entrances, separation};
use super::step::{Falling, NEAR, OVERLAP};
use crate::budget::{Budget, Stopped};
use crate::geometry::Vec2;

/// Parts further apart than this share of the thickness cannot meet in a step.
const REACH: f64 = 0.1;
/// Work of seeing how two parts lie to each other, in multiplications.
const SEEN: usize = 100;

/// An entrance of two parts, the first of which belongs to what lies before their interface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PlacedEntrance {
    pub parts: [usize; 2],
    /// Which of two, along a side of the first part.
    pub end: usize,
    pub entrance: Entrance,
    /// The interface of their members that is nearest, if they have any, and which end of it.
    pub interface: Option<(usize, usize)>,
}

impl Falling {
    pub(super) fn outlines(&self, places: &[Position]) -> Vec<CutPolygon> {
        let outline = |part: &super::body::Part| {
            let place = &places[part.body];
            part.arms.iter().map(|&(arm, real)| (place.point(arm), real)).collect()
        };
        self.parts.iter().map(outline).collect()
    }

    /// Pairs of parts of different bodies, one of which can move, whose boxes are nearer than the reach of a step.
    ///
    /// # Errors
    /// When stopped.
    pub(super) fn near(&self, outlines: &[CutPolygon], budget: &Budget) -> Result<Vec<[usize; 2]>, Stopped> {
        let reach = Vec2::repeat(0.5 * REACH * self.thickness);
        let around = |outline: &CutPolygon| {
            let of = |pick: fn(&Vec2, &Vec2) -> Vec2| outline.iter().fold(outline[0].0, |all, c| pick(&all, &c.0));
            [of(Vec2::inf) - reach, of(Vec2::sup) + reach]
        };
        let boxes: Vec<[Vec2; 2]> = outlines.iter().map(around).collect();
        let mut order: Vec<usize> = (0..boxes.len()).collect();
        order.sort_by(|&i, &j| boxes[i][0].x.total_cmp(&boxes[j][0].x));
        let (mut pairs, mut open) = (Vec::new(), Vec::new());
        for i in order {
            open.retain(|&j: &usize| boxes[j][1].x >= boxes[i][0].x);
            budget.work(open.len())?;
            let meets = |&&j: &&usize| boxes[j][1].y >= boxes[i][0].y && boxes[i][1].y >= boxes[j][0].y;
            pairs.extend(open.iter().filter(meets).map(|&j| self.ordered(i, j)).filter(|pair| self.can_touch(pair)));
            open.push(i);
        }
        pairs.sort_unstable();
        budget.work(SEEN * pairs.len())?;
        Ok(pairs)
    }

    /// Two parts, first the one that lies before their interface.
    fn ordered(&self, i: usize, j: usize) -> [usize; 2] {
        let (low, high) = (i.min(j), i.max(j));
        let members = [low, high].map(|part| self.parts[part].member);
        let turned = self.between(members).first().is_some_and(|&k| self.interfaces[k].between[0] != members[0]);
        if turned { [high, low] } else { [low, high] }
    }

    fn can_touch(&self, pair: &[usize; 2]) -> bool {
        let bodies = pair.map(|part| self.parts[part].body);
        bodies[0] != bodies[1]
            && bodies.iter().any(|&body| self.bodies[body].movable())
            && self.apart.binary_search(pair).is_err()
    }

    /// Interfaces between two members.
    fn between(&self, members: [usize; 2]) -> &[usize] {
        let key = [members[0].min(members[1]), members[0].max(members[1])];
        self.by_members.get(&key).map_or(&[], |all| all)
    }

    /// Where a pair of parts touches.
    pub(super) fn placed(
        &self,
        parts: [usize; 2],
        outlines: &[CutPolygon],
        at_corner: AtCorner,
    ) -> Vec<PlacedEntrance> {
        let pair = parts.map(|part| &outlines[part]);
        let best = separation(pair);
        if best.distance > REACH * self.thickness {
            return Vec::new();
        }
        let all = entrances(pair, &best, at_corner).into_iter().enumerate();
        let placed = |(end, entrance): (usize, Option<Entrance>)| {
            let entrance = entrance?;
            let touching = entrance.touching(pair);
            let yields = parts.iter().any(|&part| self.bodies[self.parts[part].body].yields_to(touching.normal));
            let interface = self.nearest_end(parts, touching.at);
            yields.then_some(PlacedEntrance { parts, end, entrance, interface })
        };
        all.filter_map(placed).collect()
    }

    /// All of these pairs that touch; corners may pass each other on either side.
    pub(super) fn touching(&self, pairs: &[[usize; 2]], outlines: &[CutPolygon]) -> Vec<PlacedEntrance> {
        let free = AtCorner::Free(NEAR * self.thickness);
        pairs.iter().flat_map(|&pair| self.placed(pair, outlines, free)).collect()
    }

    fn nearest_end(&self, parts: [usize; 2], at: Vec2) -> Option<(usize, usize)> {
        let members = parts.map(|part| self.parts[part].member);
        let ends = self.between(members).iter().flat_map(|&k| [(k, 0), (k, 1)]);
        let distance = |&(k, end): &(usize, usize)| (self.end_of(k, end)[0] - at).norm();
        ends.min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// How far these pairs of parts overlap at most, m, and which do by more than is allowed.
    pub(super) fn overlaps(&self, pairs: &[[usize; 2]], outlines: &[CutPolygon]) -> (f64, Vec<[usize; 2]>) {
        let (mut most, mut beyond): (f64, Vec<[usize; 2]>) = (0.0, Vec::new());
        for pair in pairs {
            let outlines = pair.map(|part| &outlines[part]);
            let best = separation(outlines);
            // Beyond a cut another part of the same member is entered.
            if -best.distance > most && outlines[best.owner][best.side].1 {
                most = -best.distance;
            }
            if -best.distance > OVERLAP * self.thickness {
                beyond.push(*pair);
            }
        }
        (most, beyond)
    }

    pub(super) fn at(&self, placed: &PlacedEntrance, outlines: &[CutPolygon]) -> Touching {
        placed.entrance.touching(placed.parts.map(|part| &outlines[part]))
    }

    /// Largest displacement of a corner since the start, m.
    pub(super) fn displacement(&self) -> f64 {
        let moved = |(body, place): (&super::body::RigidBody, &Position)| body.moved(&body.start(), place);
        self.bodies.iter().zip(&self.places).map(moved).fold(0.0, f64::max)
    }
}
