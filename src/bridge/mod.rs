//! Bridges: spans of one or more rings between abutments and piers, with backing over the haunches.
//!
//! The springing level of all spans is y = 0; x = 0 lies in the middle between the first springing and the last. Each ring stands
//! on the extrados of the ring below. The line between two rings is a polyline through the ends of the joints of both, and both
//! stones follow it: chords of different length would leave gaps and overlaps that are not in the masonry.

mod backing;
mod below;
mod check;
mod fault;
mod set_out;

pub use fault::{BridgeFault, MAX_BODIES, MAX_RINGS};

use crate::arch::profile::Profile;
use crate::geometry::{Region, Vec2};
use crate::structure::{Body, Joint, JointLaw, Side, Sides, Span, Stone, Structure, Surface};
use set_out::SetOut;

/// One ring of a span.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RingCourse {
    /// Thickness at the crown, m. Between crown and springings it is linear in the arc length of the profile.
    pub crown_thickness: f64,
    /// Thickness at the springings, m.
    pub springing_thickness: f64,
    /// Number of voussoirs, of one length along the profile each. Rings of one number have their joints in line.
    pub voussoirs: usize,
    /// Which of the stones it is made of.
    pub stone: usize,
}

/// One span.
#[derive(Debug, Clone, PartialEq)]
pub struct BridgeSpan {
    /// The intrados of the lowest ring.
    pub profile: Profile,
    /// From the lowest outwards. Joints are normal to the profile.
    pub rings: Vec<RingCourse>,
}

/// A pier between two spans. It stands on a support of its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pier {
    /// Distance between the springings of the two intrados, m.
    pub top_width: f64,
    /// From the ground to the springing level, m.
    pub height: f64,
    /// Courses of one height each; the uppermost carries the springings.
    pub courses: usize,
    /// By how much each side leans inwards, horizontal run per height.
    pub batter: f64,
    /// Which of the stones it is made of.
    pub stone: usize,
}

/// What an end of the bridge stands on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BridgeEnd {
    /// The springings stand on the ground.
    Ground,
    /// The springings stand on a block with a plumb face under the springing of the intrados, a plumb back, and a level bed with a
    /// dry joint on the ground. Where it is wider than the springings its top is level.
    Abutment {
        /// From the ground to the springing level, m.
        height: f64,
        /// Width of the bed, m; as wide as the springings if not given.
        width: Option<f64>,
        /// Which of the stones it is made of.
        stone: usize,
    },
}

/// Masonry over the haunches: a block above every pier, and one at each end from the extrados to a plumb back above the outer end
/// of the springings, with the ground behind it, or above the back of the abutment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Backing {
    /// Level of its top, m.
    pub level: f64,
    /// Which of the stones it is made of.
    pub stone: usize,
}

/// A bridge. Supports are counted from the left: the left end, the piers, the right end.
#[derive(Debug, Clone, PartialEq)]
pub struct Bridge {
    /// From left to right.
    pub spans: Vec<BridgeSpan>,
    /// From left to right, one between every two spans.
    pub piers: Vec<Pier>,
    /// The left end and the right end.
    pub ends: [BridgeEnd; 2],
    /// Masonry over the haunches.
    pub backing: Option<Backing>,
    /// Friction angle between two rings of a span, rad; none: that of the rings' stones. There is no cohesion between them.
    pub ring_friction_angle: Option<f64>,
    /// What all is made of. Between two of them the lower friction and the lower cohesion hold.
    pub stones: Vec<Stone>,
}

/// Body numbers, known before anything is built: voussoirs ring by ring, piers from the ground up, abutments, backing.
struct Numbers {
    /// First voussoir of every ring of every span.
    rings: Vec<Vec<usize>>,
    /// First course of every pier.
    piers: Vec<usize>,
    /// The abutments.
    ends: [Option<usize>; 2],
}

impl Numbers {
    fn new(bridge: &Bridge) -> Numbers {
        let mut next = 0;
        let mut take = |count: usize| {
            next += count;
            next - count
        };
        let rings =
            bridge.spans.iter().map(|span| span.rings.iter().map(|ring| take(ring.voussoirs)).collect()).collect();
        let piers = bridge.piers.iter().map(|pier| take(pier.courses)).collect();
        let ends = bridge.ends.map(|end| (end != BridgeEnd::Ground).then(|| take(1)));
        Numbers { rings, piers, ends }
    }
}

/// A bridge half built.
struct Works<'a> {
    bridge: &'a Bridge,
    spans: Vec<SetOut>,
    numbers: Numbers,
    structure: Structure,
}

impl Bridge {
    /// The structure. Each ring is a span of it. Joints between two rings have the lower ring before them, bed joints what lies
    /// below. The surfaces are the extrados of the outer rings, and the level tops of piers, abutments and backing between them.
    ///
    /// # Errors
    /// All numbers out of range; if there are none, all stones that cannot exist; if there are none, all blocks too small for the
    /// springings on them, and backing that does not stand over the haunches.
    pub fn build(&self) -> Result<Structure, Vec<BridgeFault>> {
        self.check()?;
        let spans = self.set_out()?;
        self.check_below(&spans)?;
        let structure = Structure {
            stones: self.stones.clone(),
            bodies: Vec::new(),
            joints: Vec::new(),
            spans: Vec::new(),
            surfaces: Vec::new(),
            passive: Vec::new(),
            supports: self.piers.len() + 2,
        };
        let mut works = Works { bridge: self, spans, numbers: Numbers::new(self), structure };
        for span in 0..self.spans.len() {
            works.rings(span);
        }
        for span in 0..self.spans.len() {
            works.between_rings(span);
        }
        (0..self.piers.len()).for_each(|pier| works.pier(pier));
        (0..2).for_each(|end| works.end(end));
        let covered = works.backing();
        works.surfaces(&covered);
        Ok(works.structure)
    }

    /// All spans, each in its place.
    fn set_out(&self) -> Result<Vec<SetOut>, Vec<BridgeFault>> {
        let (mut spans, mut faults) = (Vec::new(), Vec::new());
        for (j, span) in self.spans.iter().enumerate() {
            match SetOut::new(span, &format!("spans[{j}]")) {
                Ok(set_out) => spans.push(set_out),
                Err(more) => faults.extend(more),
            }
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        let widths: Vec<f64> = spans.iter().map(SetOut::width).collect();
        let length: f64 = widths.iter().sum::<f64>() + self.piers.iter().map(|pier| pier.top_width).sum::<f64>();
        let mut left = -0.5 * length;
        for (j, span) in spans.iter_mut().enumerate() {
            span.shift(left + 0.5 * widths[j]);
            left += widths[j] + self.piers.get(j).map_or(0.0, |pier| pier.top_width);
        }
        Ok(spans)
    }
}

impl Works<'_> {
    fn add(&mut self, corners: Vec<Vec2>, stone: usize) -> usize {
        let region = Region::polygon(&corners);
        self.structure.bodies.push(Body { corners, sides: Sides::Straight, region, stone });
        self.structure.bodies.len() - 1
    }

    /// A dry joint with the law of the weaker of its stones; the first end, to the second's right, as seen from what lies before.
    fn join(&mut self, between: [Side; 2], ends: [Vec2; 2], stones: [usize; 2]) {
        let law = self.bridge.stones[stones[0]].dry_joint_with(&self.bridge.stones[stones[1]]);
        self.structure.joints.push(Joint { between, intrados: ends[0], extrados: ends[1], law });
    }

    /// The ground at the left (0) or right (1) end of the bridge.
    fn ground(&self, end: usize) -> Side {
        Side::Support(if end == 0 { 0 } else { self.bridge.piers.len() + 1 })
    }

    /// What the left (0) or right (1) end of a span stands on, and its stone.
    fn under(&self, span: usize, end: usize) -> (Side, Option<usize>) {
        let pier = if end == 0 { span.checked_sub(1) } else { Some(span) };
        if let Some((j, pier)) = pier.and_then(|j| Some((j, self.bridge.piers.get(j)?))) {
            return (Side::Body(self.numbers.piers[j] + pier.courses - 1), Some(pier.stone));
        }
        match (self.numbers.ends[end], self.bridge.ends[end]) {
            (Some(body), BridgeEnd::Abutment { stone, .. }) => (Side::Body(body), Some(stone)),
            _ => (self.ground(end), None),
        }
    }

    /// The rings of a span: each a row of voussoirs and a row of joints.
    fn rings(&mut self, span: usize) {
        for (m, course) in self.bridge.spans[span].rings.iter().enumerate() {
            let (first, joints, n) = (self.structure.bodies.len(), self.structure.joints.len(), course.voussoirs);
            for k in 0..n {
                self.add(self.spans[span].corners(m, k), course.stone);
            }
            for k in 0..=n {
                let before = if k == 0 { self.under(span, 0) } else { (Side::Body(first + k - 1), None) };
                let after = if k == n { self.under(span, 1) } else { (Side::Body(first + k), None) };
                let stones = [before, after].map(|(_, stone)| stone.unwrap_or(course.stone));
                self.join([before.0, after.0], self.spans[span].joint(m, k), stones);
            }
            self.structure.spans.push(Span { bodies: first..first + n, joints: joints..joints + n + 1 });
        }
    }

    fn between_rings(&mut self, span: usize) {
        let Bridge { stones, spans, ring_friction_angle, .. } = self.bridge;
        for (m, pair) in self.numbers.rings[span].windows(2).enumerate() {
            let [lower, upper] = [m, m + 1].map(|ring| &stones[spans[span].rings[ring].stone]);
            let angle = ring_friction_angle.unwrap_or_else(|| lower.friction_angle_on(upper));
            let law = JointLaw::Dry { friction: angle.tan(), cohesion: 0.0 };
            for (below, above, [left, right]) in self.spans[span].between_rings(m) {
                let between = [Side::Body(pair[0] + below), Side::Body(pair[1] + above)];
                self.structure.joints.push(Joint { between, intrados: right, extrados: left, law });
            }
        }
    }

    /// The surfaces from left to right; `covered[span][end]` tells what the backing leaves free.
    fn surfaces(&mut self, covered: &[backing::Covered]) {
        let spans = self.spans.len();
        self.structure.surfaces.extend(self.top_of_end(0, covered));
        for (j, span) in self.spans.iter().enumerate() {
            let (outer, m) = (span.outer(), span.rings() - 1);
            let [left, right] = backing::free(&covered[j], outer.len() - 1);
            for k in left.0..=right.0 {
                let from = if k == left.0 { left.1.unwrap_or(outer[k]) } else { outer[k] };
                let to = if k == right.0 { right.1.unwrap_or(outer[k + 1]) } else { outer[k + 1] };
                if (to - from).norm() > below::SAME_POINT * span.width() {
                    let body = self.numbers.rings[j][m] + k;
                    self.structure.surfaces.push(Surface { body, ends: [from, to] });
                }
            }
            if j + 1 < spans {
                self.structure.surfaces.extend(self.top_of_pier(j, covered));
            }
        }
        self.structure.surfaces.extend(self.top_of_end(1, covered));
    }
}

#[cfg(test)]
mod tests;
