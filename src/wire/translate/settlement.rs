//! Movements of supports.

use super::site::Unloaded;
use super::structure::Layout;
use crate::collapse::{Direction, SupportMovement};
use crate::geometry::Vec2;
use crate::structure::{Side, Structure};
use crate::wire::fault::{Faults, Shown};
use crate::wire::prose::Digits;
use crate::wire::request::{
    AnalysisRequest, MovementRequest, ReportRequest, SettlementRequest, SupportMovementRequest,
};

const HERE: &str = "/analysis/settlement";
/// So many names are shown as an example, and so many letters of each.
const FEW: usize = 4;
const SHOWN: usize = 40;
const MOVED_SUPPORTS: &str = "/analysis/settlement/supports";

/// Whether a movement of supports can be followed.
pub fn check(request: &AnalysisRequest, settlement: &SettlementRequest, site: &Unloaded<'_>, faults: &mut Faults) {
    match request.arch {
        Some(_) => check_springings(request, settlement, site.size(), faults),
        None => check_supports(settlement, site, faults),
    }
    check_idle(request, "while supports move", "a movement of supports", faults);
}

fn check_springings(request: &AnalysisRequest, settlement: &SettlementRequest, size: Option<f64>, faults: &mut Faults) {
    let sides = [("left", settlement.left), ("right", settlement.right)];
    for (side, movement) in sides {
        let shift = [("outwards_m", movement.outwards_m), ("downwards_m", movement.downwards_m)];
        check_movement(&format!("{HERE}/{side}"), shift, size, faults);
    }
    let detail = "an arch has no named supports: give left or right";
    faults.require(settlement.supports.is_empty(), MOVED_SUPPORTS, detail);
    let detail = "nothing moves: give left or right a movement, such as outwards_m";
    faults.require(sides.iter().any(|(_, movement)| !still(*movement)), HERE, detail);
    let detail = "the other half moves as the mirror image of this one: move left only, or set half to false";
    faults.require(!request.half() || still(settlement.right), format!("{HERE}/right"), detail);
}

fn check_supports(settlement: &SettlementRequest, site: &Unloaded<'_>, faults: &mut Faults) {
    for (side, movement) in [("left", settlement.left), ("right", settlement.right)] {
        let detail = "only an arch has this: name the support in settlement.supports";
        faults.require(still(movement), format!("{HERE}/{side}"), detail);
    }
    let list = &settlement.supports;
    let (size, names) = (site.size(), site.layout().map(|layout| &layout.supports));
    for (i, moved) in list.iter().enumerate() {
        let here = format!("{MOVED_SUPPORTS}/{i}");
        let support = format!("{here}/support");
        if let Some(names) = names {
            let few = names.iter().take(FEW).map(|name| name.chars().take(SHOWN).collect::<String>());
            let detail = format!("there is no such support: give its name, as {}", few.collect::<Vec<_>>().join(", "));
            faults.require(names.iter().any(|name| **name == *moved.support), support.as_str(), detail);
        }
        let again = list[..i].iter().any(|other| other.support == moved.support);
        faults.require(!again, support, "this support moves twice: keep one movement");
        let shift = [("rightwards_m", moved.rightwards_m), ("downwards_m", moved.downwards_m)];
        check_movement(&here, shift, size, faults);
    }
    let moves = |by: &SupportMovementRequest| [by.rightwards_m, by.downwards_m, by.rotation_deg] != [0.0; 3];
    let detail = "nothing moves: give one of supports a movement, such as downwards_m";
    faults.require(list.iter().any(moves), HERE, detail);
}

fn still(movement: MovementRequest) -> bool {
    movement == MovementRequest::default()
}

/// What means something only where loads grow keeps its default.
pub fn check_idle(request: &AnalysisRequest, then: &str, what: &str, faults: &mut Faults) {
    for (i, _) in request.loads.iter().enumerate().filter(|(_, entry)| entry.scaled) {
        let detail = format!("{then} no load grows: set scaled to false, or leave the load out");
        faults.add(format!("/loads/{i}/scaled"), detail);
    }
    let (factor, usual) = (&request.load_factor, ReportRequest::default());
    let detail = format!("{then} no load grows: leave this out");
    faults.require(factor.direction == Direction::Increase, "/load_factor/direction", detail.clone());
    faults.require(factor.cap.is_none(), "/load_factor/cap", detail);
    let detail = format!("{what} shows no stress fields: leave them out");
    faults.require(request.report.stress_fields.is_empty(), "/report/stress_fields", detail);
    let detail = format!("{what} shows nothing on the way to collapse: leave this out");
    let same = request.report.share_of_collapse == usual.share_of_collapse;
    faults.require(same, "/report/share_of_collapse", detail.clone());
    faults.require(request.report.first_yield_length_m.is_none(), "/report/first_yield_length_m", detail.clone());
    faults.require(!request.report.history, "/report/history", detail);
}

fn check_movement(here: &str, shift: [(&str, f64); 2], size: Option<f64>, faults: &mut Faults) {
    let most = size.unwrap_or(f64::INFINITY);
    let largest = Digits(most);
    for (name, by) in shift {
        let pointer = format!("{here}/{name}");
        let detail = format!("{} is too far: keep within {largest} m, the size of the arch, either way", Shown(by));
        faults.require(by.abs() <= most, pointer, detail);
    }
}

/// The movements of the supports of this structure.
pub fn movements(settlement: &SettlementRequest, layout: &Layout) -> Vec<SupportMovement> {
    let structure = &layout.structure;
    if layout.supports.is_empty() {
        return springings(settlement, structure).to_vec();
    }
    let number = |name: &str| layout.supports.iter().position(|other| other == name);
    let movement = |moved: &SupportMovementRequest| {
        let support = number(&moved.support)?;
        Some(SupportMovement {
            support,
            about: moved.about_m.map_or_else(|| middle(structure, support), Vec2::from),
            by: Vec2::new(moved.rightwards_m, -moved.downwards_m),
            rotation: moved.rotation_deg.to_radians(),
        })
    };
    settlement.supports.iter().filter_map(movement).collect()
}

/// Those of both springings: outwards is to the left on the left, and a rotation that opens the intrados there turns clockwise.
fn springings(settlement: &SettlementRequest, structure: &Structure) -> [SupportMovement; 2] {
    let ends = [structure.ring().first(), structure.ring().last()];
    [(0, -1.0, settlement.left), (1, 1.0, settlement.right)].map(|(support, sign, moved)| SupportMovement {
        support,
        about: ends[support].map_or(Vec2::zeros(), |joint| joint.middle()),
        by: Vec2::new(sign * moved.outwards_m, -moved.downwards_m),
        rotation: sign * moved.rotation_deg.to_radians(),
    })
}

/// The middle of a support's joints, each with the weight of its length.
fn middle(structure: &Structure, support: usize) -> Vec2 {
    let joints = || structure.joints.iter().filter(|joint| joint.between.contains(&Side::Support(support)));
    let length: f64 = joints().map(|joint| joint.length()).sum();
    joints().map(|joint| joint.middle() * (joint.length() / length)).sum()
}
