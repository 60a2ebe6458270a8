//! Backing: masonry over the haunches up to a level.

use super::below::SAME_POINT;
use super::fault::BridgeFault;
use super::set_out::SetOut;
use super::{Backing, Bridge, BridgeEnd, Works};
use crate::geometry::Vec2;
use crate::structure::Side;

/// Where backing ends on an extrados.
#[derive(Debug, Clone, Copy)]
pub(super) struct Top {
    /// The backing.
    pub body: usize,
    /// Which voussoir of the outer ring it ends on.
    pub voussoir: usize,
    /// Where its top meets the extrados, m.
    pub at: Vec2,
}

/// What covers the left and the right haunch of a span.
pub(super) type Covered = [Option<Top>; 2];

/// First and last voussoir of an outer ring of `n` that is not all covered, and where its free part begins or ends.
pub(super) fn free(covered: &Covered, n: usize) -> [(usize, Option<Vec2>); 2] {
    let end = |end: usize, all: usize| covered[end].map_or((all, None), |top| (top.voussoir, Some(top.at)));
    [end(0, 0), end(1, n - 1)]
}

/// One haunch of an extrados, from the springing up to the level: points and the voussoirs between them.
struct Haunch {
    points: Vec<Vec2>,
    voussoirs: Vec<usize>,
}

/// The haunch at the left (0) or right (1) end of a span; `None` where the extrados does not cross the level on that side.
fn haunch(span: &SetOut, end: usize, level: f64) -> Option<Haunch> {
    let mut outer = span.outer();
    let n = outer.len() - 1;
    if end == 1 {
        outer.reverse();
    }
    let close = SAME_POINT * span.width();
    if outer[0].y > level - close {
        return None;
    }
    let middle = 0.5 * (outer[0].x + outer[n].x);
    let mut haunch = Haunch { points: vec![outer[0]], voussoirs: Vec::new() };
    for (k, pair) in outer.windows(2).enumerate() {
        let [a, b] = [pair[0], pair[1]];
        haunch.voussoirs.push(if end == 0 { k } else { n - 1 - k });
        if b.y > level - close {
            // A joint within round-off of the level is taken to be on it.
            let share = if b.y <= level + close { 1.0 } else { (level - a.y) / (b.y - a.y) };
            let at = a + share * (b - a);
            haunch.points.push(if share < 1.0 { Vec2::new(at.x, level) } else { b });
            // Beyond the middle it is the other haunch.
            return (if end == 0 { at.x < middle } else { at.x > middle }).then_some(haunch);
        }
        haunch.points.push(b);
    }
    None
}

impl Bridge {
    pub(super) fn check_backing(&self, spans: &[SetOut]) -> Vec<BridgeFault> {
        let Some(Backing { level, .. }) = self.backing else { return Vec::new() };
        let crossed = spans.iter().all(|span| (0..2).all(|end| haunch(span, end, level).is_some()));
        if crossed {
            return self.pinched(spans, level);
        }
        let springings = spans.iter().flat_map(|span| [span.outer_end(0).y, span.outer_end(1).y]);
        let crown = |span: &SetOut| span.outer().iter().map(|point| point.y).fold(f64::NEG_INFINITY, f64::max);
        let (least, most) =
            (springings.fold(f64::NEG_INFINITY, f64::max), spans.iter().map(crown).fold(f64::INFINITY, f64::min));
        vec![BridgeFault::BackingLevel { level, least, most }]
    }

    /// Backing that an overhanging extrados cuts in two: it touches the back of the backing, or the extrados of the next span.
    fn pinched(&self, spans: &[SetOut], level: f64) -> Vec<BridgeFault> {
        // How far a haunch reaches beyond the springing of its intrados, if further than the outer end of the springings.
        let overhang = |span: &SetOut, end: usize| {
            let out = if end == 0 { -1.0 } else { 1.0 };
            let beyond = |point: &Vec2| out * (point.x - span.springing(end)[0].x);
            let reach = haunch(span, end, level)?.points.iter().map(beyond).fold(0.0, f64::max);
            (reach > beyond(&span.outer_end(end)) + SAME_POINT * span.width()).then_some(reach)
        };
        let mut faults = Vec::new();
        for (end, what) in self.ends.iter().enumerate() {
            let span = &spans[if end == 0 { 0 } else { spans.len() - 1 }];
            let width = if let BridgeEnd::Abutment { width, .. } = what { *width } else { None };
            let pinches = |reach: &f64| width.unwrap_or(0.0) <= reach + SAME_POINT * span.width();
            if let Some(least) = overhang(span, end).filter(pinches) {
                faults.push(BridgeFault::BackingPinched { place: format!("ends[{end}]"), least });
            }
        }
        for (j, pier) in self.piers.iter().enumerate() {
            let reach = [overhang(&spans[j], 1), overhang(&spans[j + 1], 0)];
            let least = spans[j].reach(1) + spans[j + 1].reach(0);
            if reach.iter().any(Option::is_some) && pier.top_width <= least * (1.0 + SAME_POINT) {
                faults.push(BridgeFault::BackingPinched { place: format!("piers[{j}]"), least });
            }
        }
        faults
    }
}

impl Works<'_> {
    /// Builds the backing; what it covers of every span.
    pub(super) fn backing(&mut self) -> Vec<Covered> {
        let mut covered = vec![[None; 2]; self.spans.len()];
        let Some(backing) = self.bridge.backing else { return covered };
        for gap in 0..=self.spans.len() {
            let left = gap.checked_sub(1).and_then(|span| Some((span, haunch(&self.spans[span], 1, backing.level)?)));
            let right = self.spans.get(gap).and_then(|span| Some((gap, haunch(span, 0, backing.level)?)));
            let corners = self.outline(gap, left.as_ref(), right.as_ref(), backing.level);
            let body = self.add(corners, backing.stone);
            for (end, (span, haunch)) in [(1, left), (0, right)].into_iter().filter_map(|(end, h)| Some((end, h?))) {
                covered[span][end] = Some(self.bed(body, span, end, &haunch));
            }
            self.bed_on_top(body, gap);
            if gap == 0 || gap == self.spans.len() {
                self.lean(body, usize::from(gap > 0), backing.level);
            }
        }
        covered
    }

    /// The joint between the plumb back of the backing at an end of the bridge and the ground behind it, where the springings stand
    /// on the ground: without it the backing would slide off the haunch.
    fn lean(&mut self, body: usize, end: usize, level: f64) {
        if self.bridge.ends[end] != BridgeEnd::Ground {
            return;
        }
        let back = self.back_of_backing(end);
        let ends = [self.span_at(end).outer_end(end).y, level].map(|y| Vec2::new(back, y));
        let stone = self.structure.bodies[body].stone;
        let (ground, body) = (self.ground(end), Side::Body(body));
        self.join(if end == 0 { [ground, body] } else { [body, ground] }, ends, [stone; 2]);
    }

    /// Corners, counter-clockwise: along the extrados from left to right, then back along the level.
    fn outline(
        &self,
        gap: usize,
        left: Option<&(usize, Haunch)>,
        right: Option<&(usize, Haunch)>,
        level: f64,
    ) -> Vec<Vec2> {
        let down = left.iter().flat_map(|(_, haunch)| haunch.points.iter().rev().copied());
        let up = right.iter().flat_map(|(_, haunch)| haunch.points.iter().copied());
        let mut corners: Vec<Vec2> = down.collect();
        let end = if left.is_none() { 0 } else { 1 };
        if left.is_none() || right.is_none() {
            // At an end: a plumb back, and what overhangs the outer end of the springings.
            let (back, outer) = (self.back_of_backing(end), self.span_at(end).outer_end(end));
            let mut plumb = vec![Vec2::new(back, level)];
            if back != outer.x {
                plumb.push(Vec2::new(back, outer.y));
            }
            if end == 1 {
                plumb.reverse();
            }
            corners.extend(plumb);
        }
        // Springings that meet in a point have one corner there.
        let on_pier = left.is_some() && right.is_some();
        let meet = on_pier && self.level_top_of_pier(gap - 1).is_none();
        corners.extend(up.skip(usize::from(meet)));
        corners
    }

    /// Abscissa of the back of the backing at an end, m.
    pub(super) fn back_of_backing(&self, end: usize) -> f64 {
        let span = self.span_at(end);
        let out = if end == 0 { -1.0 } else { 1.0 };
        let outer = span.outer_end(end).x;
        let reach = span.springing(end)[0].x + out * span.reach(end);
        let plumb = if (reach - outer).abs() <= SAME_POINT * span.width() { outer } else { reach };
        self.back(end).unwrap_or(plumb)
    }

    /// Joints between a haunch and the backing on it.
    fn bed(&mut self, body: usize, span: usize, end: usize, haunch: &Haunch) -> Top {
        let course = self.spans[span].rings() - 1;
        let (first, stone) = (self.numbers.rings[span][course], self.bridge.spans[span].rings[course].stone);
        let mut top = Top { body, voussoir: 0, at: haunch.points[0] };
        for (pair, &voussoir) in haunch.points.windows(2).zip(&haunch.voussoirs) {
            // Seen from the voussoir its extrados runs from right to left.
            let ends = if end == 0 { [pair[1], pair[0]] } else { [pair[0], pair[1]] };
            let between = [Side::Body(first + voussoir), Side::Body(body)];
            let backing = self.structure.bodies[body].stone;
            self.join(between, ends, [stone, backing]);
            top = Top { body, voussoir, at: pair[1] };
        }
        top
    }

    /// The joint between the level top of a pier or an abutment and the backing on it.
    fn bed_on_top(&mut self, body: usize, gap: usize) {
        let on_pier = gap > 0 && gap < self.spans.len();
        let top = if on_pier { self.level_top_of_pier(gap - 1) } else { self.top_of_abutment(usize::from(gap > 0)) };
        if let Some(top) = top {
            let stones = [self.structure.bodies[top.body].stone, self.structure.bodies[body].stone];
            self.join([Side::Body(top.body), Side::Body(body)], [top.ends[1], top.ends[0]], stones);
        }
    }
}
