//! Setting out one span: the lines between its rings, cut at the joints on both sides of them.

use super::fault::BridgeFault;
use super::{BridgeSpan, RingCourse};
use crate::arch::ring::{JointLines, Line, Ring, Thickness, stations};
use crate::geometry::{Region, Vec2, segments_meet};

/// Joints of two rings nearer to each other than this share of the length of the profile are one.
const SAME_JOINT: f64 = 1e-9;

/// Where all joints of a span meet all lines between its rings.
#[derive(Debug, Clone)]
pub(super) struct SetOut {
    /// Line `m` is the intrados of ring `m` and the extrados of the ring below; on it a point for every place at which any ring
    /// has a joint, from left to right, m.
    lines: Vec<Vec<Vec2>>,
    /// For every ring the places of its joints.
    joints: Vec<Vec<usize>>,
    /// For every line the places at which it is cut: those of the joints of the ring below it or above it, rising.
    cuts: Vec<Vec<usize>>,
}

impl SetOut {
    /// Sets out a span with the middle between its springings at x = 0.
    ///
    /// # Errors
    /// Joints that miss a line, and stones that cannot exist.
    pub fn new(span: &BridgeSpan, place: &str) -> Result<SetOut, Vec<BridgeFault>> {
        let total = span.profile.length();
        if !(total.is_finite() && total > 0.0) {
            return Err(vec![BridgeFault::BadProfile { place: format!("{place}.profile") }]);
        }
        let (places, joints) = places(&span.rings, total);
        let (mut lines, mut depth) = (Vec::new(), [0.0; 2]);
        for (m, course) in span.rings.iter().enumerate() {
            depth = [depth[0] + course.crown_thickness, depth[1] + course.springing_thickness];
            let ring = Ring {
                profile: span.profile.clone(),
                line: Line::Intrados,
                thickness: Thickness::Linear { crown: depth[0], springing: depth[1] },
                joints: JointLines::Normal,
                stations: places.clone(),
            };
            let place = format!("{place}.rings[{m}]");
            let named = |fault| BridgeFault::Arch { place: place.clone(), fault };
            let ends = ring.set_out().map_err(|faults| faults.into_iter().map(named).collect::<Vec<_>>())?;
            if m == 0 {
                lines.push(ends.iter().map(|ends| ends[0]).collect());
            }
            lines.push(ends.iter().map(|ends| ends[1]).collect::<Vec<_>>());
        }
        let cuts = (0..lines.len()).map(|line| cuts(&joints, line)).collect();
        let set_out = SetOut { lines, joints, cuts };
        let faults = set_out.faults(place);
        if faults.is_empty() { Ok(set_out) } else { Err(faults) }
    }

    /// Stones that cannot exist.
    fn faults(&self, place: &str) -> Vec<BridgeFault> {
        let mut faults = Vec::new();
        for m in 0..self.rings() {
            for k in 0..self.voussoirs(m) {
                let ([a, d], [b, c]) = (self.joint(m, k), self.joint(m, k + 1));
                let [lower, upper] = [self.face(m, m, k), self.face(m + 1, m, k)];
                // A long chord of few voussoirs can cut into a ring of many.
                let faces_meet =
                    lower.windows(2).any(|p| upper.windows(2).any(|q| segments_meet(p[0], p[1], q[0], q[1])));
                // NaN is inside out too.
                let sound =
                    Region::polygon(&self.corners(m, k)).area > 0.0 && !segments_meet(a, d, b, c) && !faces_meet;
                if !sound {
                    faults.push(BridgeFault::InsideOut { place: format!("{place}.rings[{m}]"), voussoir: k });
                }
            }
        }
        let ([a, b], [c, d]) = ([self.springing(0)[0], self.outer_end(0)], [self.springing(1)[0], self.outer_end(1)]);
        // An opening of more than a full turn has its springings on the wrong sides.
        if self.width() <= 0.0 || segments_meet(a, b, c, d) {
            faults.push(BridgeFault::SpringingsCross { place: place.to_owned() });
        }
        faults
    }

    /// Moves it to the right.
    pub fn shift(&mut self, by: f64) {
        self.lines.iter_mut().flatten().for_each(|point| point.x += by);
    }

    /// Number of rings.
    pub fn rings(&self) -> usize {
        self.joints.len()
    }

    /// Number of voussoirs of ring `m`.
    pub fn voussoirs(&self, m: usize) -> usize {
        self.joints[m].len() - 1
    }

    /// Distance between the intrados ends of the springings, m.
    pub fn width(&self) -> f64 {
        self.springing(1)[0].x - self.springing(0)[0].x
    }

    /// Intrados and extrados end of joint `k` of ring `m`, m.
    pub fn joint(&self, m: usize, k: usize) -> [Vec2; 2] {
        let place = self.joints[m][k];
        [self.lines[m][place], self.lines[m + 1][place]]
    }

    /// Corners of voussoir `k` of ring `m`, counter-clockwise from the intrados end of its left joint, m.
    pub fn corners(&self, m: usize, k: usize) -> Vec<Vec2> {
        self.face(m, m, k).into_iter().chain(self.face(m + 1, m, k).into_iter().rev()).collect()
    }

    /// The part of line `line` along voussoir `k` of ring `m`, from left to right, m.
    fn face(&self, line: usize, m: usize, k: usize) -> Vec<Vec2> {
        let cuts = &self.cuts[line];
        let at = |joint: usize| cuts.partition_point(|&place| place < self.joints[m][joint]);
        cuts[at(k)..=at(k + 1)].iter().map(|&place| self.lines[line][place]).collect()
    }

    /// The common faces of ring `m` and the ring above it, from left to right: voussoir below, voussoir above, left and right end.
    pub fn between_rings(&self, m: usize) -> Vec<(usize, usize, [Vec2; 2])> {
        let line = &self.lines[m + 1];
        let of = |ring: usize, place: usize| self.joints[ring].partition_point(|&joint| joint <= place) - 1;
        let face = |pair: &[usize]| (of(m, pair[0]), of(m + 1, pair[0]), [line[pair[0]], line[pair[1]]]);
        self.cuts[m + 1].windows(2).map(face).collect()
    }

    /// The points of the left (0) or right (1) springing, from the intrados of the lowest ring outwards, m.
    pub fn springing(&self, end: usize) -> Vec<Vec2> {
        let place = if end == 0 { 0 } else { self.lines[0].len() - 1 };
        self.lines.iter().map(|line| line[place]).collect()
    }

    /// The outer end of a springing, m.
    pub fn outer_end(&self, end: usize) -> Vec2 {
        self.outer()[if end == 0 { 0 } else { self.voussoirs(self.rings() - 1) }]
    }

    /// The extrados of the outer ring: a point for each of its joints, m.
    pub fn outer(&self) -> Vec<Vec2> {
        let line = &self.lines[self.rings()];
        self.joints[self.rings() - 1].iter().map(|&place| line[place]).collect()
    }

    /// How far the span reaches beyond the intrados end of a springing, m.
    pub fn reach(&self, end: usize) -> f64 {
        let from = self.springing(end)[0].x;
        let beyond = |point: &Vec2| if end == 0 { from - point.x } else { point.x - from };
        self.lines.iter().flatten().map(beyond).fold(0.0, f64::max)
    }
}

/// The places of all joints of all rings, rising, and for every ring which of them are its own.
fn places(rings: &[RingCourse], total: f64) -> (Vec<f64>, Vec<Vec<usize>>) {
    let own: Vec<Vec<f64>> = rings.iter().map(|course| stations(total, &vec![1.0; course.voussoirs])).collect();
    let mut all: Vec<f64> = own.iter().flatten().copied().collect();
    all.sort_by(f64::total_cmp);
    // What lies nearest to the middle stays, so that both halves keep the same places.
    all.dedup_by(|next, kept| {
        let same = *next - *kept <= SAME_JOINT * total;
        if same && next.abs() < kept.abs() {
            *kept = *next;
        }
        same
    });
    let nearest = |sigma: &f64| all.partition_point(|place| *place < sigma - SAME_JOINT * total);
    let joints = own.iter().map(|own| own.iter().map(nearest).collect()).collect();
    (all, joints)
}

/// The places at which line `line` is cut.
fn cuts(joints: &[Vec<usize>], line: usize) -> Vec<usize> {
    let below = line.checked_sub(1).map(|m| &joints[m]);
    let mut cuts: Vec<usize> = below.into_iter().chain(joints.get(line)).flatten().copied().collect();
    cuts.sort_unstable();
    cuts.dedup();
    cuts
}
