//! Partial factors of a request.

use crate::collapse::Direction;
use crate::structure::Stone;
use crate::structure::load::Passive;
use crate::wire::fault::Faults;
use crate::wire::request::{AnalysisRequest, LoadEntry, LoadRequest, MethodRequest, PartialFactors};

/// Whether every factor acts on something, and whether an adequacy factor means something.
pub fn check(request: &AnalysisRequest, faults: &mut Faults) {
    let (Some(factors), false) = (&request.partial_factors, request.loads.is_empty()) else { return };
    let any = |fits: fn(&LoadEntry) -> bool| request.loads.iter().any(fits);
    let fill = any(|entry| !entry.scaled && matches!(entry.load, LoadRequest::FillPressure(_)));
    let resists = request.backfill.as_ref().is_some_and(|backfill| backfill.passive.is_some());
    for (name, factor, acts, what) in [
        ("dead", factors.dead, any(|e| !e.scaled && matches!(e.load, LoadRequest::SelfWeight(_))), "fixed self weight"),
        ("fill", factors.fill, fill || request.backfill.is_some(), "backfill nor fixed fill pressure"),
        ("live", factors.live, any(|entry| entry.scaled), "scaled load"),
        ("soil_resistance", factors.soil_resistance, resists, "soil that resists (backfill/passive)"),
    ] {
        let detail = format!(
            "there is no {what} for this to act on: leave it out, and give a fixed load that needs a factor a coefficient"
        );
        faults.require(acts || factor == 1.0, format!("/partial_factors/{name}"), detail);
    }
    let detail = "an adequacy factor is of loads that grow: set direction to `increase`, or leave partial_factors out";
    faults.require(request.load_factor.direction == Direction::Increase, "/load_factor/direction", detail);
    let detail = "fixed steps go up to one too far: set method to `event_path`, or leave partial_factors out";
    faults.require(request.method == MethodRequest::EventPath, "/method", detail);
}

impl PartialFactors {
    /// A stone with its strength divided.
    pub(super) fn on_stone(&self, stone: Stone) -> Stone {
        Stone { compressive_strength: stone.compressive_strength / self.stone_strength, ..stone }
    }

    /// What fill of unfactored weight resists with, divided; what it presses with in any case is a load.
    pub(super) fn on_passive(&self, passive: Passive) -> Passive {
        Passive {
            most: passive.most / self.soil_resistance,
            cohesion: passive.cohesion / self.soil_resistance,
            backing: passive.backing.map(|pressure| pressure / self.soil_resistance),
            least: self.fill * passive.least,
            ..passive
        }
    }
}
