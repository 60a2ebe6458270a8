//! Geometric safety factors in words.

use crate::wire::prose::{Digits, Rounded};
use crate::wire::response::{GeometricLimitBody, GeometricSafetyBody};
use std::fmt::Display;

/// What the factors mean.
pub const EXPLANATION: &str = "Geometric safety factor, loads held: one over the least share of their lengths to which all \
    joints can be shortened about their middles, with all loads as they are, until limit analysis finds no equilibrium. \
    Weights recomputed: the thickness over the least one of the same arch at which it stands under its loads computed anew. \
    Crushing counts in neither.";

/// What is said where a factor is missing.
pub const MISSING: &str = "A geometric safety factor is left out: rounding kept limit analysis from an answer, or an arch so \
    thin could not be set out.";

/// One sentence on a structure that stands.
pub fn headline(safety: &GeometricSafetyBody) -> String {
    let said = [(&safety.loads_held, "with loads held"), (&safety.weights_recomputed, "with weights recomputed")];
    let said: Vec<_> = said
        .iter()
        .filter_map(|(limit, which)| Some(format!("{} {which}", factor(limit.as_ref()?, Rounded))))
        .collect();
    if said.is_empty() {
        return "The arch stands. Its geometric safety factor could not be found.".into();
    }
    format!("The arch stands. Its geometric safety factor is {}.", said.join(", "))
}

/// Name and value of every line about geometric safety.
pub fn facts(safety: &GeometricSafetyBody) -> Vec<(&'static str, String)> {
    let held = safety.loads_held.as_ref().map(|limit| {
        let at = format!("stands on joints of {} of their lengths", Digits(limit.least_share));
        ("loads held", format!("factor {}; {at}", factor(limit, Digits)))
    });
    let recomputed = safety.weights_recomputed.as_ref().map(|limit| {
        let least = match (limit.least_crown_thickness_m, limit.least_springing_thickness_m) {
            (Some(crown), Some(springing)) if crown == springing => format!("{} m", Digits(crown)),
            (Some(crown), Some(springing)) => {
                format!("{} m at the crown, {} m at the springings", Digits(crown), Digits(springing))
            }
            _ => format!("{} of it", Digits(limit.least_share)),
        };
        let most = if limit.factor.is_none() { " at most" } else { "" };
        ("weights recomputed", format!("factor {}; least thickness{most} {least}", factor(limit, Digits)))
    });
    held.into_iter().chain(recomputed).collect()
}

fn factor<D: Display>(limit: &GeometricLimitBody, shown: fn(f64) -> D) -> String {
    limit.factor.map_or_else(|| "100 or more".to_owned(), |factor| shown(factor).to_string())
}
