//! Geometric safety factors (Heyman, The Stone Skeleton): the thickness over the least in which a line of thrust fits.
//!
//! Both are found by the static theorem alone, on the structure as built.

use super::ending::thrust_line;
use super::{
    Analysis, CollapseReport, GeometricLimit, GeometricSafety, GeometricSafetyTask, Note, Outcome, TaskReport, Thinned,
    Thinner, Thrust, safety,
};
use crate::budget::Budget;
use crate::limit::{StaticTheorem, Unsolved};

/// No share below is tried: a factor is at most 100.
const LEAST: f64 = 0.01;
/// By so much the thickness is made less at a time until the arch falls, which it need not do once and for all: loads change too.
const STEP: f64 = 0.95;
/// The least thickness is known to this much of it.
const KNOWN: f64 = 1e-9;
/// Where rounding keeps limit analysis from an answer next to the least thickness, to this much.
const PUT_UP_WITH: f64 = 1e-6;

/// Adds both factors to the report of a structure that stands under its fixed loads, those of `theorem`.
pub(super) fn judge(
    report: &mut CollapseReport,
    analysis: &Analysis,
    theorem: &StaticTheorem,
    task: &GeometricSafetyTask,
    budget: &Budget,
) {
    safety::crushed(report, false);
    if report.outcome != Outcome::Stands {
        return;
    }
    let loads_held = held(analysis, theorem, budget).ok().flatten();
    let thinner = task.thinner.as_ref();
    let weights_recomputed = thinner.and_then(|thinner| recomputed(thinner, budget).ok().flatten());
    let missing = loads_held.is_none() || (thinner.is_some() && weights_recomputed.is_none());
    report.notes.extend(missing.then_some(Note::NoGeometricSafety));
    report.task = TaskReport::GeometricSafety(Some(Box::new(GeometricSafety { loads_held, weights_recomputed })));
}

fn held(analysis: &Analysis, theorem: &StaticTheorem, budget: &Budget) -> Result<Option<GeometricLimit>, Unsolved> {
    let limit = theorem.shortened_joints(0.0, LEAST, budget)?;
    Ok(limit.map(|limit| GeometricLimit {
        share: limit.share,
        is_least_tried: limit.share <= LEAST,
        thrust_line: thrust_line(&analysis.structure, &limit.forces),
    }))
}

fn recomputed(thinner: &Thinner, budget: &Budget) -> Result<Option<GeometricLimit>, Unsolved> {
    let Some(thrust_line) = standing(thinner, 1.0, budget)? else { return Ok(None) };
    let mut stands = GeometricLimit { share: 1.0, is_least_tried: false, thrust_line };
    let (mut below, mut falls) = (None, 0.0);
    while below.is_none_or(|below| stands.share - below > KNOWN * stands.share) {
        let share = below.map_or((STEP * stands.share).max(LEAST), |below| 0.5 * (stands.share + below));
        match standing(thinner, share, budget) {
            Ok(Some(thrust_line)) => {
                stands = GeometricLimit { share, is_least_tried: share <= LEAST, thrust_line };
                if stands.is_least_tried {
                    return Ok(Some(stands));
                }
            }
            Ok(None) => (below, falls) = (Some(share), share),
            // Next to the least thickness rounding may decide.
            Err(Unsolved) => below = Some(share),
        }
    }
    if stands.share - falls <= PUT_UP_WITH * stands.share { Ok(Some(stands)) } else { Err(Unsolved) }
}

/// The line of thrust of some equilibrium of the arch with this share of its thickness; none where it falls.
fn standing(thinner: &Thinner, share: f64, budget: &Budget) -> Result<Option<Vec<Thrust>>, Unsolved> {
    let Some(Thinned { structure, fixed }) = thinner.at(share) else { return Err(Unsolved) };
    let theorem = StaticTheorem::new(&structure, &fixed, &[]).map_err(|_| Unsolved)?;
    let forces = theorem.forces_at(0.0, budget)?;
    Ok(forces.map(|forces| thrust_line(&structure, &forces)))
}
