//! How the blocks of a chain lie to each other: neighbours meet, others must not.

use super::block::{Corners, Place};
use super::contact::{Meeting, Touch, meeting, separation};
use super::step::{Falling, OVERLAP};
use crate::budget::Budget;

use crate::geometry::Vec2;

/// Work of seeing that two blocks lie apart, in multiplications.
const APART: usize = 4;

/// A contact of the step's problem and where it belongs: interface and end.
pub(super) type Placed = (usize, usize, Touch);

impl Falling {
    /// True where something at the interface can move.
    pub(super) fn movable(&self, interface: usize) -> bool {
        let moves = |block: usize| self.blocks.get(block).is_some_and(|block| !block.fixed);
        interface.checked_sub(1).is_some_and(moves) || moves(interface)
    }

    pub(super) fn corners(&self, places: &[Place]) -> Vec<Corners> {
        self.blocks.iter().zip(places).map(|(block, place)| block.corners(place)).collect()
    }

    pub(super) fn meetings(&self, places: &[Place]) -> Vec<Option<Meeting>> {
        let corners = self.corners(places);
        let before = |k: usize| k.checked_sub(1).map_or(self.grounds[0], |block| Some(corners[block]));
        let after = |k: usize| corners.get(k).copied().or(self.grounds[1]);
        let at = |k: usize| before(k).zip(after(k)).map(|(a, b)| meeting(&a, &b, self.thickness));
        (0..self.friction.len()).map(at).collect()
    }

    pub(super) fn touches(&self, meetings: &[Option<Meeting>]) -> Vec<Placed> {
        let mut all = Vec::with_capacity(2 * meetings.len());
        for (k, meeting) in meetings.iter().enumerate().filter(|(k, _)| self.movable(*k)) {
            let touches = meeting.iter().flat_map(|meeting| meeting.touches.iter().enumerate());
            all.extend(touches.filter_map(|(end, touch)| touch.map(|touch| (k, end, touch))));
        }
        all
    }

    /// Two that are no neighbours and overlap, if there are any; none where the budget is spent.
    pub(super) fn strangers(&self, places: &[Place], budget: &Budget) -> Option<[Option<usize>; 2]> {
        let corners = self.corners(places);
        let mut all: Vec<(Option<usize>, Corners)> = self.grounds[0].into_iter().map(|c| (None, c)).collect();
        all.extend(corners.into_iter().enumerate().map(|(block, c)| (Some(block), c)));
        all.extend(self.grounds[1].into_iter().map(|c| (None, c)));
        let boxes: Vec<[Vec2; 2]> = all.iter().map(|(_, corners)| around(corners)).collect();
        for i in 0..all.len() {
            budget.work(APART * all.len()).ok()?;
            for j in i + 2..all.len() {
                let [(a, of_a), (b, of_b)] = [&all[i], &all[j]];
                let apart = boxes[i][0].x > boxes[j][1].x
                    || boxes[j][0].x > boxes[i][1].x
                    || boxes[i][0].y > boxes[j][1].y
                    || boxes[j][0].y > boxes[i][1].y;
                let ground = a.is_none() && b.is_none();
                if !apart && !ground && separation(of_a, of_b) < -OVERLAP * self.thickness {
                    return Some([*a, *b]);
                }
            }
        }
        None
    }

    /// Largest displacement of a corner since the start, m.
    pub(super) fn displacement(&self) -> f64 {
        let mut most: f64 = 0.0;
        for (block, place) in self.blocks.iter().zip(&self.places) {
            let (from, to) = (block.corners(&block.start()), block.corners(place));
            most = from.iter().zip(&to).map(|(from, to)| (to - from).norm()).fold(most, f64::max);
        }
        most
    }
}

/// Largest overlap in these meetings, m.
pub(super) fn overlap(meetings: &[Option<Meeting>]) -> f64 {
    meetings.iter().flatten().map(|meeting| -meeting.distance).fold(0.0, f64::max)
}

/// Lowest and highest coordinates.
fn around(corners: &Corners) -> [Vec2; 2] {
    let low = corners.iter().fold(corners[0], |low, corner| low.inf(corner));
    [low, corners.iter().fold(corners[0], |high, corner| high.sup(corner))]
}
