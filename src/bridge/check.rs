//! Numbers out of range.

use super::fault::{BridgeFault, MAX_BODIES, MAX_RINGS};
use super::{Bridge, BridgeEnd};
use std::f64::consts::FRAC_PI_2;

const POSITIVE: &str = "finite and more than 0";

/// Faults as they are found.
struct Checks {
    faults: Vec<BridgeFault>,
    stones: usize,
}

impl Checks {
    fn number(&mut self, place: String, value: f64, holds: bool, needs: &'static str) {
        if !(value.is_finite() && holds) {
            self.faults.push(BridgeFault::BadNumber { place, value, needs });
        }
    }

    fn positive(&mut self, place: String, value: f64) {
        self.number(place, value, value > 0.0, POSITIVE);
    }

    fn count(&mut self, place: String, count: usize) {
        self.number(place, count as f64, count > 0, "1 at least");
    }

    fn stone(&mut self, place: String, stone: usize) {
        let stones = self.stones;
        if stone >= stones {
            self.faults.push(BridgeFault::UnknownStone { place, stone, stones });
        }
    }
}

impl Bridge {
    /// # Errors
    /// All numbers out of range.
    pub(super) fn check(&self) -> Result<(), Vec<BridgeFault>> {
        let mut checks = Checks { faults: Vec::new(), stones: self.stones.len() };
        if self.spans.is_empty() {
            checks.faults.push(BridgeFault::NoSpans);
        } else if self.piers.len() + 1 != self.spans.len() {
            checks.faults.push(BridgeFault::PierCount { piers: self.piers.len(), spans: self.spans.len() });
        }
        self.check_rings(&mut checks);
        for (j, pier) in self.piers.iter().enumerate() {
            let place = |field: &str| format!("piers[{j}].{field}");
            checks.positive(place("top_width"), pier.top_width);
            checks.positive(place("height"), pier.height);
            checks.count(place("courses"), pier.courses);
            let leans = (0.0..=1.0).contains(&pier.batter);
            checks.number(place("batter"), pier.batter, leans, "between 0 and 1, horizontal run per height");
            checks.stone(place("stone"), pier.stone);
        }
        for (end, what) in self.ends.iter().enumerate() {
            if let BridgeEnd::Abutment { height, width, stone } = *what {
                checks.positive(format!("ends[{end}].height"), height);
                width.into_iter().for_each(|width| checks.positive(format!("ends[{end}].width"), width));
                checks.stone(format!("ends[{end}].stone"), stone);
            }
        }
        if let Some(backing) = self.backing {
            checks.number("backing.level".to_owned(), backing.level, true, "finite");
            checks.stone("backing.stone".to_owned(), backing.stone);
        }
        let bodies = self.bodies();
        if bodies > MAX_BODIES {
            checks.faults.push(BridgeFault::TooManyBodies { bodies });
        }
        if checks.faults.is_empty() { Ok(()) } else { Err(checks.faults) }
    }

    fn check_rings(&self, checks: &mut Checks) {
        for (j, span) in self.spans.iter().enumerate() {
            if span.rings.is_empty() {
                checks.faults.push(BridgeFault::NoRings { place: format!("spans[{j}].rings") });
            }
            if span.rings.len() > MAX_RINGS {
                checks
                    .faults
                    .push(BridgeFault::TooManyRings { place: format!("spans[{j}].rings"), rings: span.rings.len() });
            }
            for (m, ring) in span.rings.iter().enumerate() {
                let place = |field: &str| format!("spans[{j}].rings[{m}].{field}");
                checks.positive(place("crown_thickness"), ring.crown_thickness);
                checks.positive(place("springing_thickness"), ring.springing_thickness);
                checks.count(place("voussoirs"), ring.voussoirs);
                checks.stone(place("stone"), ring.stone);
            }
        }
        let between_rings = self.spans.iter().any(|span| span.rings.len() > 1);
        if let Some(angle) = self.ring_friction_angle.filter(|_| between_rings) {
            let needs = "at least 0 and less than 90 degrees";
            checks.number("ring_friction_angle".to_owned(), angle, (0.0..FRAC_PI_2).contains(&angle), needs);
        }
    }

    /// Number of bodies, backing included.
    fn bodies(&self) -> usize {
        let rings = self.spans.iter().flat_map(|span| &span.rings).map(|ring| ring.voussoirs);
        let courses = self.piers.iter().map(|pier| pier.courses);
        let backing = if self.backing.is_some() { self.spans.len() + 1 } else { 0 };
        let ends = self.ends.iter().filter(|&&end| end != BridgeEnd::Ground).count();
        rings.chain(courses).fold(backing + ends, usize::saturating_add)
    }
}
