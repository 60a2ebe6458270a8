//! Movements of springings.

use super::site::Site;
use crate::api::fault::Faults;
use crate::api::request::{AnalysisRequest, MethodRequest, MovementRequest, SettlementRequest};
use crate::collapse::SpringingMovement;

/// Whether a movement of springings can be followed.
pub fn check(request: &AnalysisRequest, settlement: &SettlementRequest, site: &Site<'_>, faults: &mut Faults) {
    let sides = [("left", settlement.left), ("right", settlement.right)];
    let size = site.size();
    for (side, movement) in sides {
        check_movement(&format!("/analysis/settlement/{side}"), movement, size, faults);
    }
    let still = |movement: MovementRequest| movement == MovementRequest::default();
    let detail = "nothing moves: give left or right a movement, such as outwards_m";
    faults.require(sides.iter().any(|(_, movement)| !still(*movement)), "/analysis/settlement", detail);
    let detail = "the other half moves as the mirror image of this one: move left only, or set half to false";
    faults.require(!request.arch.half || still(settlement.right), "/analysis/settlement/right", detail);
    for (i, _) in request.loads.iter().enumerate().filter(|(_, entry)| entry.scaled) {
        let detail = "while springings move no load grows: set scaled to false, or leave the load out";
        faults.add(format!("/loads/{i}/scaled"), detail);
    }
    let detail = "a movement is followed exactly: set method to `event_path`";
    faults.require(request.method == MethodRequest::EventPath, "/method", detail);
    let detail = "a movement shows no stress fields: leave them out";
    faults.require(request.report.stress_fields.is_empty(), "/report/stress_fields", detail);
}

fn check_movement(here: &str, movement: MovementRequest, size: Option<f64>, faults: &mut Faults) {
    let most = size.unwrap_or(f64::INFINITY);
    for (name, by) in [("outwards_m", movement.outwards_m), ("downwards_m", movement.downwards_m)] {
        let detail = format!("{by} is out of range: keep within {most:.6} m, the size of the arch, either way");
        faults.require(by.abs() <= most, format!("{here}/{name}"), detail);
    }
    let turned = movement.rotation_deg;
    let detail = format!("{turned} is out of range: keep within 90 degrees either way");
    faults.require(turned.abs() <= 90.0, format!("{here}/rotation_deg"), detail);
}

impl From<MovementRequest> for SpringingMovement {
    fn from(movement: MovementRequest) -> Self {
        SpringingMovement {
            outwards: movement.outwards_m,
            downwards: movement.downwards_m,
            rotation: movement.rotation_deg.to_radians(),
        }
    }
}
