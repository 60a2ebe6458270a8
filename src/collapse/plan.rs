//! The least model that answers as accurately as asked.
//!
//! The collapse load of rigid stones does not depend on the mesh, so one subblock per voussoir gives it; how far path and
//! limit window are apart tells how well. Stress needs a mesh. It starts coarse, and those voussoirs are refined
//! whose share of the error is too large, until the estimate is small enough (see [`estimate`]).

mod beam;
mod estimate;
mod mesh;
mod refine;
mod states;
mod unfold;

pub(super) use beam::solve as beam;
pub use mesh::{LOAD_PIECES, can_be_refined};
pub(super) use mesh::{MOST_EACH_WAY, around};

use super::near_point::near_points;
use super::{
    Accuracy, Analysis, AnalysisError, CollapseReport, Direction, Estimate, Mesh, Outcome, PathEnd, Plan, PlanReason,
    Task, verdict,
};
use crate::budget::Budget;
use crate::structure::is_symmetric;
use states::States;

/// Subblocks across all stones together from which on solving for the states on a mesh is worth a try. Measured on semicircles under a
/// load over the quarter point, over the time of the path: 27 of 2 x 2 2.5, of 4 x 4 1.0, of 8 x 8 0.8, of 12 x 12 0.6; 15 of 16 x 16
/// and 9 of 24 x 24 0.7; 61 of 2 x 2 1.6, of 4 x 4 0.7, of 8 x 8 0.35; 101 of 2 x 2 1.0; 201 of 2 x 2 0.4, of 4 x 4 0.25; 1,001 of 2 x 2 0.1.
const PAYS: usize = 200;
/// Velocities of a mechanism, as a share of the largest, that differ by less are the same.
const SAME_VELOCITY: f64 = 1e-6;

/// The answer to the accuracy asked, but for what follows from path and limit window. `rigid` is that on the mesh given, where
/// stress is asked for one subblock per voussoir.
pub(super) fn refined(
    analysis: &Analysis,
    accuracy: Accuracy,
    rigid: CollapseReport,
    budget: &Budget,
) -> Result<CollapseReport, AnalysisError> {
    let mut plan = Plan {
        half: false,
        subblocks: analysis.mesh.subblocks.clone(),
        order: analysis.mesh.order,
        spacing: analysis.mesh.spacing,
        collapse_intensity: None,
        stress: accuracy.stress.map(|asked| Estimate { asked, estimate: None, met: false }),
        first_yield: None,
        meshes: Vec::new(),
        why: vec![why_load(&rigid)],
    };
    let mut report = match accuracy.stress {
        Some(asked) => on_finer_meshes(analysis, accuracy.most_subblocks, asked, rigid, &mut plan, budget)?,
        None => {
            plan.why.push(PlanReason::MeshAsGiven);
            rigid
        }
    };
    report.plan = Some(plan);
    Ok(report)
}

/// Says in the plan how well the collapse load is known, where that is asked for.
pub(super) fn judge_load(report: &mut CollapseReport, task: &Task) {
    let asked = task.accuracy().and_then(|accuracy| accuracy.collapse_intensity);
    let estimate = asked.map(|asked| intensity(report, task.direction(), asked));
    if let Some(plan) = &mut report.plan {
        plan.collapse_intensity = estimate;
    }
}

/// The answer on the mesh given, its states solved for one by one from those of whole stones; none where it is one of whole stones, or
/// the path has to be followed on it, or is followed in less time.
pub(super) fn on_given_mesh(analysis: &Analysis, budget: &Budget) -> Result<Option<CollapseReport>, AnalysisError> {
    let refined = analysis.task.accuracy().is_some_and(|accuracy| accuracy.stress.is_some());
    let across: usize = analysis.mesh.subblocks.iter().map(|[radial, _]| radial).sum();
    let pays = across >= PAYS && analysis.mesh.subblocks.iter().any(|each| *each != [1, 1]);
    if refined || !pays || !States::may_solve(analysis) {
        return Ok(None);
    }
    let whole = verdict::solve(&of_whole_stones(analysis), budget)?;
    // Near a symmetric mechanism there mostly are several states, and the path is short.
    if whole.end.is_some() && half_of(analysis, &whole).is_some() {
        return Ok(None);
    }
    let Some(mut states) = States::solve(analysis, &whole, None, budget)? else { return Ok(None) };
    let mut report = states.report(analysis, &whole)?;
    report.cost.join(whole.cost);
    Ok(states.complete(&mut report, &whole)?.then_some(report))
}

/// The answer on the least mesh whose stress is accurate enough; `rigid` where there is none.
fn on_finer_meshes(
    analysis: &Analysis,
    most: usize,
    asked: f64,
    mut rigid: CollapseReport,
    plan: &mut Plan,
    budget: &Budget,
) -> Result<CollapseReport, AnalysisError> {
    let stands = rigid.at_start.is_some() && rigid.outcome != Outcome::CannotTell;
    if !stands || rigid.stress_fields.is_empty() {
        plan.why.push(if stands { PlanReason::NoField } else { PlanReason::NoStress });
        return Ok(rigid);
    }
    let half = half_of(analysis, &rigid);
    let modelled = half.as_ref().unwrap_or(analysis);
    let whole = match &half {
        Some(half) => verdict::solve(&of_whole_stones(half), budget)?,
        None => rigid.clone(),
    };
    let mut found = match refine::solve(modelled, &whole, most, asked, budget)? {
        Ok(found) => found,
        Err((why, cost)) => {
            plan.why.push(why);
            rigid.cost.join(cost);
            return Ok(rigid);
        }
    };
    found.report.cost.join(rigid.cost);
    plan.why.extend([why_half(analysis, half.is_some()), found.why]);
    plan.why.extend(found.one_by_one.then_some(PlanReason::StatesOneByOne));
    plan.why.extend(near_points(modelled).iter().any(|near| !near.is_empty()).then_some(PlanReason::NearPointsLeftOut));
    (plan.order, plan.spacing) = mesh::drawing(&modelled.structure);
    (plan.stress, plan.first_yield, plan.meshes) = (Some(found.stress), found.first_yield, found.meshes);
    (plan.half, plan.subblocks) = match half {
        Some(_) => (true, unfold::subblocks(&analysis.structure, &found.subblocks)),
        None => (false, found.subblocks),
    };
    Ok(if plan.half { unfold::whole(&analysis.structure, found.report, &rigid) } else { found.report })
}

/// The same question on a mesh that is found.
pub(super) fn with_mesh(analysis: &Analysis, subblocks: Vec<[usize; 2]>) -> Analysis {
    let (order, spacing) = mesh::drawing(&analysis.structure);
    Analysis { mesh: Mesh { order, spacing, ..Mesh::of(subblocks) }, ..analysis.clone() }
}

/// The same question of whole stones.
pub(super) fn of_whole_stones(analysis: &Analysis) -> Analysis {
    Analysis { mesh: Mesh::of(vec![[1, 1]; analysis.structure.voussoirs().len()]), ..analysis.clone() }
}

/// How well the collapse load is known: path and limit window come to it from two sides; where joints slide, it is a range from
/// the least found to the end of the window, where they crush, too, of that of plastic sections.
fn intensity(report: &CollapseReport, direction: Direction, asked: f64) -> Estimate {
    let apart = |end: &PathEnd, increases: bool| {
        let window = report.limit_window?;
        let end = report.crushing.on_path[usize::from(increases)].as_ref().unwrap_or(end);
        let limit = if increases { window.highest } else { window.lowest };
        let limit = end.range.map_or(limit, |range| range.greatest);
        match (limit - end.load_factor).abs() {
            0.0 => Some(0.0),
            apart => Some(apart / limit.abs().max(end.load_factor.abs())).filter(|_| limit.is_finite()),
        }
    };
    let increases = direction == Direction::Increase;
    let ends = report.end.iter().map(|end| apart(end, increases));
    let ends: Option<Vec<f64>> = ends.chain(report.other_end.iter().map(|end| apart(end, !increases))).collect();
    let worst = ends.and_then(|ends| ends.into_iter().reduce(f64::max));
    match report.outcome {
        Outcome::CannotTell => Estimate { asked, estimate: None, met: false },
        Outcome::Collapse | Outcome::StandsInWindow => {
            Estimate { asked, estimate: worst, met: worst.is_some_and(|error| error <= asked) }
        }
        // There is no load that could be inaccurate.
        _ => Estimate { asked, estimate: None, met: true },
    }
}

fn why_load(report: &CollapseReport) -> PlanReason {
    let slides = report.end.iter().chain(&report.other_end).any(|end| end.mechanism.slips());
    match report.outcome {
        Outcome::FallsAsBuilt => PlanReason::NoEquilibrium,
        Outcome::SlidesAsBuilt => PlanReason::SlidesAsLoaded,
        Outcome::Stands => PlanReason::NoEndInReach,
        Outcome::CannotTell => PlanReason::Disagreement,
        _ if slides => PlanReason::SlidesAtCollapse,
        _ => PlanReason::LoadNeedsNoMesh,
    }
}

/// The left half, where the arch, its loads and the mechanism found are symmetric, no joint slides in it and no soil resists.
fn half_of(analysis: &Analysis, rigid: &CollapseReport) -> Option<Analysis> {
    let (structure, axis) = (&analysis.structure, analysis.structure.axis());
    let symmetric = |forces: &[_]| is_symmetric(forces, structure.voussoirs().len(), axis);
    let mut ends = rigid.end.iter().chain(&rigid.other_end);
    // Of other structures joints and bodies are not numbered from left to right.
    let passive = !structure.passive.is_empty();
    let mirrored = structure.asymmetry().is_none() && structure.asymmetric_stone().is_none();
    let whole = structure.is_one_ring() && !structure.is_half() && !passive && mirrored;
    if !(whole && symmetric(&analysis.fixed) && symmetric(&analysis.scaled) && ends.all(falls_evenly)) {
        return None;
    }
    let half = structure.left_half(None);
    let [fixed, scaled] = [&analysis.fixed, &analysis.scaled].map(|forces| structure.on_left_half(&half, forces));
    Some(Analysis { structure: half, fixed, scaled, ..analysis.clone() })
}

/// True where nothing slides and every stone moves as the mirror image of its partner.
fn falls_evenly(end: &PathEnd) -> bool {
    let velocities = &end.mechanism.velocities;
    let largest = velocities.iter().flatten().fold(0.0f64, |most, v| most.max(v.abs()));
    let mirror_image = |([u, v, r], [x, y, q]): (&[f64; 3], &[f64; 3])| {
        [u + x, v - y, r + q].iter().all(|apart| apart.abs() <= SAME_VELOCITY * largest)
    };
    !end.mechanism.slips() && velocities.iter().zip(velocities.iter().rev()).all(mirror_image)
}

fn why_half(analysis: &Analysis, half: bool) -> PlanReason {
    match half {
        true => PlanReason::HalfModelled,
        false if analysis.structure.is_half() => PlanReason::HalfAlready,
        false => PlanReason::WholeModelled,
    }
}
