//! Where points and joints lie on a stone that is cut.

use super::patch::{Patch, Polyline};
use super::spacing::shares;
use super::{Grid, ON_LINE};
use crate::geometry::{Vec2, cross, distance_from_segment, lies_inside};

/// Newton steps that find a point's place in a stone, whose map is bilinear or nearly so: a few are enough.
const PLACE_STEPS: usize = 20;
/// Step of the central differences that stand for the map's derivatives there.
const PLACE_DIFFERENCE: f64 = 1e-6;

/// One or two subblocks, each with its share.
pub(in super::super) type Shares = [(usize, f64); 2];

/// Where a joint lies on a stone: on which side, and the places of its ends there, from 0 to 1.
///
/// Of a stone of one part sides 0 and 1 run from intrados to extrados, at the joint before and at the joint after; 2 and 3 run
/// along the stone, at the intrados and at the extrados. Of any other, side k runs from the corner of part k to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in super::super) struct OnSide {
    pub side: usize,
    ends: [f64; 2],
}

impl Grid {
    /// The sides of a stone that is cut.
    fn sides(&self) -> Vec<Polyline> {
        match self.patches.as_slice() {
            [patch] => patch.sides.to_vec(),
            patches => {
                let next = patches.iter().cycle().skip(1);
                let side = |(here, next): (&Patch, &Patch)| {
                    let hither = next.sides[0].points.iter().rev().skip(1);
                    here.sides[2].points.iter().chain(hither).copied().collect::<Vec<_>>().into()
                };
                patches.iter().zip(next).map(side).collect()
            }
        }
    }

    /// Where a joint with these ends lies: on the side nearest to them.
    pub(in super::super) fn beside(&self, joint: [Vec2; 2]) -> OnSide {
        if self.is_whole() {
            return OnSide { side: 0, ends: [0.0, 1.0] };
        }
        // Ends at a corner are there to the last digit, so that points of whole sides are where subblocks meet.
        let snapped = |place: f64| if (place - place.round()).abs() < ON_LINE { place.round() } else { place };
        let mut best = (OnSide { side: 0, ends: [0.0, 1.0] }, f64::INFINITY);
        for (side, line) in self.sides().iter().enumerate() {
            let ends = joint.map(|end| line.nearest(end));
            let far = ends[0].0 + ends[1].0;
            if far < best.1 {
                best = (OnSide { side, ends: ends.map(|(_, place)| snapped(place)) }, far);
            }
        }
        best.0
    }

    /// Places of the ends of the subblocks along a side.
    fn ends_on(&self, side: usize) -> Vec<f64> {
        let [across, along] = &self.lines;
        match self.patches.len() {
            0 | 1 => self.lines[side / 2].clone(),
            // There and back in the next part.
            _ => along.iter().map(|x| 0.5 * x).chain(across.iter().rev().skip(1).map(|x| 1.0 - 0.5 * x)).collect(),
        }
    }

    /// Number of the subblock at a side that is number `k` there.
    fn at_side(&self, side: usize, k: usize) -> usize {
        let (parts, last) = (self.patches.len(), self.radial - 1);
        match side {
            _ if parts > 1 && k <= last => self.number(0, side * self.radial + k),
            _ if parts > 1 => self.number(2 * last + 1 - k, (side + 1) % parts * self.radial),
            0 => k,
            1 => self.number(k, self.along - 1),
            2 => self.number(0, k),
            _ => self.number(last, k),
        }
    }

    /// Places on a joint, from 0 to 1, where two subblocks of this stone meet.
    pub(in super::super) fn lines_on(&self, OnSide { side, ends: [from, to] }: OnSide) -> impl Iterator<Item = f64> {
        let mut ends = self.ends_on(side);
        ends.pop();
        let places = ends.into_iter().skip(1).map(move |end| (end - from) / (to - from));
        places.filter(|place| (ON_LINE..1.0 - ON_LINE).contains(place))
    }

    /// Subblocks that the point `eta` of a joint touches. Between two, each takes as much as lies on its side of what the
    /// point stands for: `below` towards the joint's first end, `above` towards its second.
    pub(in super::super) fn on_joint(
        &self,
        OnSide { side, ends: [from, to] }: OnSide,
        eta: f64,
        around: [f64; 2],
    ) -> Shares {
        let [mut lower, mut upper] = shares(from + (to - from) * eta, &self.ends_on(side), ON_LINE);
        if upper.1 > 0.0 {
            let [below, above] = if from < to { around } else { [around[1], around[0]] };
            (lower.1, upper.1) = (below / (below + above), above / (below + above));
        }
        [lower, upper].map(|(k, share)| (self.at_side(side, k), share))
    }

    /// Number of the subblock in which a point lies.
    pub(in super::super) fn cell_at(&self, at: Vec2) -> usize {
        self.at(at).first().map_or(0, |(cell, _)| *cell)
    }

    /// Subblocks on which a force at `at` acts.
    pub(in super::super) fn at(&self, at: Vec2) -> Vec<(usize, f64)> {
        let patch = match self.patches.as_slice() {
            [] => return vec![(0, 1.0)],
            [patch] if patch.has_straight_sides() => patch,
            _ => return self.nearest(at),
        };
        let (xi, eta) = if self.is_whole() { (0.5, 0.5) } else { place(patch, at) };
        let [rows, columns] = [(eta, 0), (xi, 1)].map(|(place, way)| shares(place, &self.lines[way], ON_LINE));
        let cells = columns.map(|(j, along)| rows.map(|(i, share)| (self.number(i, j), along * share)));
        cells.into_iter().flatten().filter(|(_, share)| *share > 0.0).collect()
    }

    /// The subblocks that lie nearest to a point, with the same share each.
    pub(super) fn nearest(&self, at: Vec2) -> Vec<(usize, f64)> {
        let far = |corners: &Vec<Vec2>| {
            let ends = corners.iter().zip(corners.iter().cycle().skip(1));
            let outside = || ends.map(|(a, b)| distance_from_segment(at, *a, *b)).fold(f64::INFINITY, f64::min);
            if lies_inside(at, corners) { 0.0 } else { outside() }
        };
        let far: Vec<f64> = self.outlines.iter().map(far).collect();
        let least = far.iter().copied().fold(f64::INFINITY, f64::min) + ON_LINE * self.whole.area.sqrt();
        let near: Vec<usize> = (0..far.len()).filter(|&cell| far[cell] <= least).collect();
        near.iter().map(|&cell| (cell, 1.0 / near.len() as f64)).collect()
    }
}

/// The place (xi, eta) of a point, by Newton's method.
pub(super) fn place(patch: &Patch, at: Vec2) -> (f64, f64) {
    let (mut xi, mut eta) = (0.5, 0.5);
    let step = PLACE_DIFFERENCE;
    for _ in 0..PLACE_STEPS {
        let here = patch.point(xi, eta);
        let by_xi = (patch.point(xi + step, eta) - patch.point(xi - step, eta)) / (2.0 * step);
        let by_eta = (patch.point(xi, eta + step) - patch.point(xi, eta - step)) / (2.0 * step);
        let (miss, area) = (at - here, cross(by_xi, by_eta));
        if area == 0.0 {
            break;
        }
        xi += cross(miss, by_eta) / area;
        eta += cross(by_xi, miss) / area;
    }
    (xi, eta)
}
