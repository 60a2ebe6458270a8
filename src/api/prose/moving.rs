//! Moving geometry and moving supports in words.

use super::wording::{self, word};
use crate::api::prose::Digits;
use crate::api::response::{AnalysisResult, SettlementBody, SettlementPathBody, UpdatedBody};
use crate::collapse::{SettlementEnd, UpdatedEnd};

/// One sentence on supports that move.
pub fn headline(settlement: &SettlementBody) -> String {
    let path = settlement.updated_geometry.as_ref().unwrap_or(&settlement.first_order);
    let share = format!("{} %", Digits(100.0 * path.share_of_movement));
    match (path.end, &settlement.updated_geometry) {
        (SettlementEnd::Follows, Some(_)) => {
            format!("The arch follows its springings through their whole movement{}.", snaps(path))
        }
        (SettlementEnd::Follows, None) => {
            "At first order the arch follows its springings; only on updated geometry can they bring it down.".into()
        }
        (SettlementEnd::Collapse, _) => {
            format!("The arch falls when its springings have done {share} of their movement{}.", snaps(path))
        }
        (SettlementEnd::FallsAsLoaded, _) => {
            "On updated geometry the arch falls under its loads before its springings move.".into()
        }
        (SettlementEnd::CannotTell, _) => {
            let safe = Digits(100.0 * path.safe_share_of_movement);
            format!("No answer: the movement could not be followed beyond {safe} % of it.")
        }
    }
}

/// Half a sentence on the first snap, where there is one.
fn snaps(path: &SettlementPathBody) -> String {
    let words = |at: f64| {
        format!(", but first snaps into another shape at {} %: rely on no more than that", Digits(100.0 * at))
    };
    path.snap_share_of_movement.map(words).unwrap_or_default()
}

/// Why there is no answer, after a colon.
fn because(why: Option<&String>) -> String {
    why.map(|why| format!(": {}", why.trim_end_matches('.'))).unwrap_or_default()
}

/// A sentence on an arch that falls on moving geometry before the loads at the start are on in full.
pub fn before_the_start(result: &AnalysisResult) -> Option<&'static str> {
    let updated = result.updated_geometry.as_ref()?;
    let falls = updated.end == UpdatedEnd::FallsAsLoaded;
    falls.then_some(" On moving geometry it falls before the loads at the start of its path are on in full.")
}

/// Name and value of every line about moving geometry and moving supports.
pub fn facts(result: &AnalysisResult) -> Vec<(&'static str, String)> {
    let mut lines = Vec::new();
    if let Some(updated) = &result.updated_geometry {
        lines.push(("moving geometry", on_moving_geometry(result, updated)));
    }
    if let Some(settlement) = &result.settlement {
        lines.push(("first order", path(&settlement.first_order)));
        if let Some(updated) = &settlement.updated_geometry {
            lines.push(("moving geometry", path(updated)));
        }
    }
    lines
}

fn on_moving_geometry(result: &AnalysisResult, updated: &UpdatedBody) -> String {
    let at = updated.intensity.map(|at| format!("{} {}", Digits(at), wording::unit(result))).unwrap_or_default();
    match updated.end {
        UpdatedEnd::Collapse => {
            let over = updated.over_first_order.map(|over| format!(", {} of the first-order load", Digits(over)));
            let snap = updated.snap_intensity.map(|at| format!("; snaps first at {}", Digits(at)));
            let mode = updated.mode.map(|mode| format!(" ({})", word(&mode))).unwrap_or_default();
            format!("collapse at {at}{mode}{}{}", over.unwrap_or_default(), snap.unwrap_or_default())
        }
        UpdatedEnd::FallsAsLoaded => {
            let share =
                updated.share_of_loads.map(|share| format!("{} % of ", Digits(100.0 * share))).unwrap_or_default();
            format!("falls under {share}the loads at the start of the path")
        }
        UpdatedEnd::StandsToCap if at.is_empty() => "stands".into(),
        UpdatedEnd::StandsToCap => format!("stands up to {at}, the cap"),
        UpdatedEnd::BeyondModel => format!("stands up to {at}, where it is strained or moved beyond the model"),
        UpdatedEnd::CannotTell => format!("could not be followed{}", because(updated.why.as_ref())),
    }
}

fn path(path: &SettlementPathBody) -> String {
    let share = Digits(100.0 * path.share_of_movement);
    let thrust =
        path.thrust_n_per_m.map(|thrust| format!("; thrust then {} kN per metre of depth", Digits(thrust / 1e3)));
    let end = match path.end {
        SettlementEnd::Follows => "follows the whole movement".to_owned(),
        SettlementEnd::Collapse => format!("falls at {share} % of the movement"),
        SettlementEnd::FallsAsLoaded => return "falls under its loads before any movement".to_owned(),
        SettlementEnd::CannotTell => format!("lost after {share} % of the movement{}", because(path.why.as_ref())),
    };
    let safe = Digits(100.0 * path.safe_share_of_movement);
    let snap = if path.snap_share_of_movement.is_some() { format!("; snaps first at {safe} %") } else { String::new() };
    let hinges: Vec<_> = path.hinges.iter().map(|hinge| hinge.joint.to_string()).collect();
    let turning = if hinges.is_empty() { String::new() } else { format!(", turning at joints {}", hinges.join(", ")) };
    format!("{end}{snap}{}{turning}", thrust.unwrap_or_default())
}
