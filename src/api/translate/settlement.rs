//! Movements of springings.

use super::MAX_LENGTH_M;
use super::site::Unloaded;
use crate::api::fault::{Faults, Shown};
use crate::api::prose::Digits;
use crate::api::request::{AnalysisRequest, MovementRequest, ReportRequest, SettlementRequest};
use crate::collapse::{Direction, SpringingMovement};

/// Whether a movement of springings can be followed.
pub fn check(request: &AnalysisRequest, settlement: &SettlementRequest, site: &Unloaded<'_>, faults: &mut Faults) {
    let sides = [("left", settlement.left), ("right", settlement.right)];
    let size = site.size();
    for (side, movement) in sides {
        check_movement(&format!("/analysis/settlement/{side}"), movement, size, faults);
    }
    let still = |movement: MovementRequest| movement == MovementRequest::default();
    let detail = "nothing moves: give left or right a movement, such as outwards_m";
    faults.require(sides.iter().any(|(_, movement)| !still(*movement)), "/analysis/settlement", detail);
    let detail = "the other half moves as the mirror image of this one: move left only, or set half to false";
    faults.require(!request.half() || still(settlement.right), "/analysis/settlement/right", detail);
    for (i, _) in request.loads.iter().enumerate().filter(|(_, entry)| entry.scaled) {
        let detail = "while springings move no load grows: set scaled to false, or leave the load out";
        faults.add(format!("/loads/{i}/scaled"), detail);
    }
    check_idle(request, faults);
    let detail = "a movement shows no stress fields: leave them out";
    faults.require(request.report.stress_fields.is_empty(), "/report/stress_fields", detail);
}

/// What means something only where loads grow keeps its default.
fn check_idle(request: &AnalysisRequest, faults: &mut Faults) {
    let (factor, usual) = (&request.load_factor, ReportRequest::default());
    let detail = "while springings move no load grows: leave this out";
    faults.require(factor.direction == Direction::Increase, "/load_factor/direction", detail);
    faults.require(factor.cap.is_none(), "/load_factor/cap", detail);
    let detail = "a movement of springings shows nothing on the way to collapse: leave this out";
    let same = request.report.share_of_collapse == usual.share_of_collapse;
    faults.require(same, "/report/share_of_collapse", detail);
}

fn check_movement(here: &str, movement: MovementRequest, size: Option<f64>, faults: &mut Faults) {
    let most = size.unwrap_or(f64::INFINITY);
    let largest = Digits(most);
    for (name, by) in [("outwards_m", movement.outwards_m), ("downwards_m", movement.downwards_m)] {
        let pointer = format!("{here}/{name}");
        let detail = format!("{} is too far: keep within {largest} m, the size of the arch, either way", Shown(by));
        let _ = faults.either_way(&pointer, by, MAX_LENGTH_M) && faults.require(by.abs() <= most, pointer, detail);
    }
    faults.either_way(format!("{here}/rotation_deg"), movement.rotation_deg, 90.0);
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
