//! In words what was modelled, and how accurate it is.

use crate::collapse::{Estimate, PlanReason};
use crate::wire::prose::Digits;
use crate::wire::response::PlanBody;
use std::fmt;

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
        (Some(error), false) if error <= estimate.asked => {
            format!("estimated at {}, but NOT SURE to be within the {asked} asked for", percent(error))
        }
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

impl fmt::Display for PlanReason {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            PlanReason::CoarsestTooLarge { subblocks, allowed } => {
                return write!(
                    out,
                    "The coarsest mesh that bends would have {subblocks} subblocks, and {allowed} are allowed."
                );
            }
            PlanReason::NextTooLarge { subblocks, allowed } => {
                return write!(out, "The next mesh would have {subblocks} subblocks, and {allowed} are allowed.");
            }
            PlanReason::NoEquilibrium => NO_EQUILIBRIUM,
            PlanReason::SlidesAsLoaded => "The arch slides as its loads come on: nothing to refine.",
            PlanReason::NoEndInReach => "Limit analysis finds equilibrium at any load in reach.",
            PlanReason::Disagreement => "Path and limit analysis do not agree, which no mesh would mend.",
            PlanReason::SlidesAtCollapse => SLIDES_AT_COLLAPSE,
            PlanReason::LoadNeedsNoMesh => LOAD_NEEDS_NO_MESH,
            PlanReason::MeshAsGiven => "No accuracy of the stress is asked for: the mesh is the request's own.",
            PlanReason::NoStress => "No load is known under which it stands, so there is no stress to be found.",
            PlanReason::NoField => "The load path passes none of the stress fields asked for.",
            PlanReason::HalfModelled => HALF_MODELLED,
            PlanReason::HalfAlready => "The arch is half an arch already.",
            PlanReason::WholeModelled => WHOLE_MODELLED,
            PlanReason::CoarsestLost => "On the coarsest mesh that bends the load path could not be followed.",
            PlanReason::NextLost => "On the next mesh the load path could not be followed to the same fields.",
            PlanReason::Finest => "No finer mesh is left: next to a hinge, stress has no bound.",
            PlanReason::AccurateEnough => "The stress is as accurate as asked.",
            PlanReason::StatesOneByOne => STATES_ONE_BY_ONE,
            PlanReason::NearPointsLeftOut => NEAR_POINTS_LEFT_OUT,
        })
    }
}

const NO_EQUILIBRIUM: &str =
    "Limit analysis finds no equilibrium that the arch could be loaded from: nothing to refine.";
const SLIDES_AT_COLLAPSE: &str = "Joints slide at collapse: the load may be any from the least found to the end of the limit \
     window. How far these are apart stands for the error; no mesh makes it smaller.";
const LOAD_NEEDS_NO_MESH: &str =
    "The collapse load of stones that do not slide does not depend on the mesh: path and limit window give it.";
const HALF_MODELLED: &str = "Arch, loads and mechanism are symmetric: half the arch is modelled for the stress.";
const STATES_ONE_BY_ONE: &str = "The states on this mesh were solved for one by one. The load path is that of \
     whole stones.";
const NEAR_POINTS_LEFT_OUT: &str = "Next to a force on a point, stress has no bound: the error leaves out what is nearer to it than a tenth of \
     the body's longest joint, or than a quarter of its least width where that is less.";
const WHOLE_MODELLED: &str =
    "Arch, loads or mechanism are not symmetric, or joints slide: the whole arch is modelled for the stress.";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_is_told_beside_what_was_asked() {
        for (estimate, met, words) in [
            (Some(0.03), true, "estimated at 3 %; asked: 5 %"),
            (Some(0.048), false, "estimated at 4.8 %, but NOT SURE to be within the 5 % asked for"),
            (Some(0.0501), false, "estimated a little above the 5 % asked for"),
            (Some(0.07), false, "estimated at 7 %, MORE than the 5 % asked for"),
            (None, true, "no load to be off; asked: 5 %"),
            (None, false, "NOT KNOWN; asked: 5 %"),
        ] {
            assert_eq!(error(Estimate { asked: 0.05, estimate, met }), words);
        }
    }
}
