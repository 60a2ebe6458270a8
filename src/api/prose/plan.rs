//! In words what was modelled, and how accurate it is.

use crate::api::prose::Digits;
use crate::api::response::PlanBody;
use crate::collapse::Estimate;

/// The mesh that was picked, and the errors.
pub fn facts(plan: &PlanBody) -> Vec<(&'static str, String)> {
    let mut facts = Vec::new();
    if plan.stress.is_some() {
        let half = if plan.half { ", half of the arch modelled" } else { "" };
        facts.push(("mesh", format!("{}{half}", plan.mesh_in_words())));
    }
    let errors = [("intensity error", plan.collapse_intensity), ("stress error", plan.stress)];
    facts.extend(errors.into_iter().filter_map(|(name, estimate)| Some((name, error(estimate?)))));
    facts
}

/// An error beside what was asked.
pub fn error(estimate: Estimate) -> String {
    let asked = percent(estimate.asked);
    match (estimate.estimate, estimate.met) {
        (Some(error), true) => format!("estimated at {}; asked: {asked}", percent(error)),
        (Some(error), false) if percent(error) == asked => format!("estimated a little above the {asked} asked for"),
        (Some(error), false) => format!("estimated at {}, MORE than the {asked} asked for", percent(error)),
        (None, true) => format!("no load to be off; asked: {asked}"),
        (None, false) => format!("NOT KNOWN; asked: {asked}"),
    }
}

fn percent(share: f64) -> String {
    // Two digits are all that an estimate has.
    let digits = format!("{:.1e}", 100.0 * share).parse().unwrap_or(share);
    format!("{} %", Digits(digits))
}
