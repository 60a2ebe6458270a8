//! What the springings stand on: piers and abutments.

use super::backing::Covered;
use super::fault::BridgeFault;
use super::set_out::SetOut;
use super::{Bridge, BridgeEnd, Works};
use crate::geometry::Vec2;
use crate::structure::{Side, Surface};

/// Points nearer to each other than this share of the size are one.
pub(super) const SAME_POINT: f64 = 1e-9;

/// How far the points of a springing reach below y = 0, m.
fn depth(springing: &[Vec2]) -> f64 {
    springing.iter().map(|point| -point.y).fold(0.0, f64::max)
}

impl Bridge {
    /// # Errors
    /// Piers and abutments too small for the springings on them; backing too low or too high.
    pub(super) fn check_below(&self, spans: &[SetOut]) -> Result<(), Vec<BridgeFault>> {
        let mut faults = Vec::new();
        for (j, pier) in self.piers.iter().enumerate() {
            let (least, width) = (spans[j].reach(1) + spans[j + 1].reach(0), pier.top_width);
            if least > width * (1.0 + SAME_POINT) {
                faults.push(BridgeFault::PierTooNarrow { place: format!("piers[{j}].top_width"), width, least });
            }
            let height = pier.height / pier.courses as f64;
            let depth = depth(&spans[j].springing(1)).max(depth(&spans[j + 1].springing(0)));
            if height <= depth * (1.0 + SAME_POINT) {
                faults.push(BridgeFault::TooLow { place: format!("piers[{j}].height"), height, depth, courses: true });
            }
        }
        for (end, what) in self.ends.iter().enumerate() {
            let BridgeEnd::Abutment { height, width, .. } = *what else { continue };
            let span = &spans[if end == 0 { 0 } else { spans.len() - 1 }];
            let (least, depth) = (span.reach(end), depth(&span.springing(end)));
            // Springings that stand plumb reach nowhere: then a width has to be given.
            let width = width.unwrap_or(least);
            if width < least * (1.0 - SAME_POINT) || width <= SAME_POINT * span.width() {
                faults.push(BridgeFault::AbutmentTooNarrow { place: format!("ends[{end}].width"), width, least });
            }
            if height <= depth * (1.0 + SAME_POINT) {
                faults.push(BridgeFault::TooLow {
                    place: format!("ends[{end}].height"),
                    height,
                    depth,
                    courses: false,
                });
            }
        }
        faults.extend((0..spans.len()).filter_map(|span| self.feet_meet(span, spans[span].width())));
        faults.extend(self.check_backing(spans));
        if faults.is_empty() { Ok(()) } else { Err(faults) }
    }

    /// Whether what stands on both sides of a span meets below it.
    fn feet_meet(&self, span: usize, width: f64) -> Option<BridgeFault> {
        // Height and batter; nothing stands on ground.
        let pier = |j: usize| self.piers.get(j).map(|pier| (pier.height, pier.batter));
        let abutment = |end: usize| match self.ends[end] {
            BridgeEnd::Abutment { height, .. } => Some((height, 0.0)),
            BridgeEnd::Ground => None,
        };
        let left = span.checked_sub(1).map_or_else(|| abutment(0), pier)?;
        let right = pier(span).or_else(|| abutment(1))?;
        let between = width - (left.1 + right.1) * left.0.min(right.0);
        (between <= SAME_POINT * width).then(|| BridgeFault::FeetMeet { place: format!("spans[{span}]") })
    }
}

impl Works<'_> {
    /// Courses from the ground up; the uppermost ends in the springings of both spans.
    pub(super) fn pier(&mut self, j: usize) {
        let pier = self.bridge.piers[j];
        let (left, right) = (self.spans[j].springing(1), self.spans[j + 1].springing(0));
        let (x, course) = ([left[0].x, right[0].x], pier.height / pier.courses as f64);
        let ends_at = |k: usize| {
            let y = course * k as f64 - pier.height;
            [Vec2::new(x[0] + pier.batter * y, y), Vec2::new(x[1] - pier.batter * y, y)]
        };
        let mut below = Side::Support(j + 1);
        for k in 0..pier.courses {
            let bed = ends_at(k);
            let mut corners = bed.to_vec();
            if k + 1 < pier.courses {
                corners.extend(ends_at(k + 1).iter().rev());
            } else {
                corners.extend(&right);
                // Springings that meet in a point have one corner there.
                let kept = if self.level_top_of_pier(j).is_none() { left.len() - 1 } else { left.len() };
                corners.extend(left[..kept].iter().rev());
            }
            let body = Side::Body(self.add(corners, pier.stone));
            self.join([below, body], [bed[1], bed[0]], [pier.stone; 2]);
            below = body;
        }
    }

    /// The abutment at the left (0) or right (1) end.
    pub(super) fn end(&mut self, end: usize) {
        let BridgeEnd::Abutment { height, stone, .. } = self.bridge.ends[end] else { return };
        let Some(back) = self.back(end) else { return };
        let springing = self.span_at(end).springing(end);
        let face = springing[0].x;
        let outer = springing[springing.len() - 1];
        // In the sense of the left end; that of the right is the other way round.
        let mut corners = vec![Vec2::new(back, -height), Vec2::new(face, -height)];
        corners.extend(&springing);
        if back != outer.x {
            corners.push(Vec2::new(back, outer.y));
        }
        let mut bed = [corners[1], corners[0]];
        if end == 1 {
            corners.reverse();
            bed.reverse();
        }
        let body = self.add(corners, stone);
        let support = if end == 0 { 0 } else { self.bridge.piers.len() + 1 };
        self.join([Side::Support(support), Side::Body(body)], bed, [stone; 2]);
    }

    pub(super) fn span_at(&self, end: usize) -> &SetOut {
        &self.spans[if end == 0 { 0 } else { self.spans.len() - 1 }]
    }

    /// Abscissa of the back of an abutment, m; that of the outer end of the springings where there is only round-off between.
    pub(super) fn back(&self, end: usize) -> Option<f64> {
        let BridgeEnd::Abutment { width, .. } = self.bridge.ends[end] else { return None };
        let span = self.span_at(end);
        let out = if end == 0 { -1.0 } else { 1.0 };
        let back = span.springing(end)[0].x + out * width.unwrap_or(span.reach(end));
        let outer = span.outer_end(end).x;
        Some(if (back - outer).abs() <= SAME_POINT * span.width() { outer } else { back })
    }

    /// The top of a pier, or of the backing on it.
    pub(super) fn top_of_pier(&self, j: usize, covered: &[Covered]) -> Option<Surface> {
        if let (Some(left), Some(right)) = (covered[j][1], covered[j + 1][0]) {
            return Some(Surface { body: left.body, ends: [left.at, right.at] });
        }
        self.level_top_of_pier(j)
    }

    /// The top of a pier between the outer ends of the springings; none where they meet.
    pub(super) fn level_top_of_pier(&self, j: usize) -> Option<Surface> {
        let pier = self.bridge.piers[j];
        let ends = [self.spans[j].outer_end(1), self.spans[j + 1].outer_end(0)];
        let body = self.numbers.piers[j] + pier.courses - 1;
        ((ends[1] - ends[0]).norm() > SAME_POINT * pier.top_width).then_some(Surface { body, ends })
    }

    /// The level top of an abutment.
    pub(super) fn top_of_abutment(&self, end: usize) -> Option<Surface> {
        let (outer, back) = (self.span_at(end).outer_end(end), self.back(end)?);
        let body = self.numbers.ends[end]?;
        (back != outer.x).then(|| Surface { body, ends: level_top(end, back, outer) })
    }

    /// The level top of an end: that of the backing, else that of the abutment.
    pub(super) fn top_of_end(&self, end: usize, covered: &[Covered]) -> Option<Surface> {
        let here = covered[if end == 0 { 0 } else { covered.len() - 1 }][end];
        let Some(top) = here else { return self.top_of_abutment(end) };
        Some(Surface { body: top.body, ends: level_top(end, self.back_of_backing(end), top.at) })
    }
}

/// From the back to the inner end, or the other way round, from left to right.
fn level_top(end: usize, back: f64, inner: Vec2) -> [Vec2; 2] {
    let back = Vec2::new(back, inner.y);
    if end == 0 { [back, inner] } else { [inner, back] }
}
