//! The least model that answers as accurately as asked.
//!
//! The collapse load of rigid stones does not depend on the mesh, so one subblock per voussoir gives it; how far path and
//! limit window are apart tells how well. Stress needs a mesh. It starts coarse, and those voussoirs are refined
//! whose share of the error is too large, until the estimate is small enough: two meshes are compared, voussoir by
//! voussoir (see [`estimate`]).

mod beam;
mod estimate;
mod mesh;
mod refine;
mod unfold;

pub(super) use beam::solve as beam;
pub use mesh::LOAD_PIECES;

use super::pulse::Pulse;
use super::{Accuracy, Analysis, AnalysisError, CollapseReport, Estimate, FieldAt, Outcome, PathEnd, Plan, verdict};
use crate::arch::is_symmetric;
use refine::Refined;

/// Velocities of a mechanism, as a share of the largest, that differ by less are the same.
const SAME_VELOCITY: f64 = 1e-6;

/// The answer to the accuracy asked, but for what does not depend on the mesh.
pub(super) fn solve(analysis: &Analysis, accuracy: Accuracy, pulse: &Pulse) -> Result<CollapseReport, AnalysisError> {
    let ones = vec![[1, 1]; analysis.arch.voussoirs.len()];
    let rigid = verdict::solve(&with_mesh(analysis, ones.clone(), Vec::new()), pulse)?;
    let mut plan = Plan {
        half: false,
        subblocks: ones,
        collapse_intensity: accuracy.collapse_intensity.map(|asked| intensity(&rigid, asked)),
        stress: None,
        first_yield: None,
        meshes: Vec::new(),
        why: vec![why_rigid(&rigid)],
    };
    let Some(asked) = accuracy.stress else {
        plan.why.push("No stress is asked for: one subblock per voussoir.".into());
        return Ok(CollapseReport { plan: Some(plan), ..rigid });
    };
    plan.stress = Some(Estimate { asked, estimate: None, met: false });
    if rigid.at_start.is_none() || rigid.outcome == Outcome::CannotTell {
        plan.why.push("No load is known under which it stands, so there is no stress to be found.".into());
        return Ok(CollapseReport { plan: Some(plan), ..rigid });
    }
    let half = half_of(analysis, &rigid);
    let fewest = refine::fewest(half.as_ref().unwrap_or(analysis));
    if fewest > accuracy.most_subblocks {
        let most = accuracy.most_subblocks;
        plan.why.push(format!("The coarsest mesh that bends would have {fewest} subblocks, and {most} are allowed."));
        return Ok(CollapseReport { plan: Some(plan), ..rigid });
    }
    plan.half = half.is_some();
    plan.why.push(why_half(analysis, plan.half));
    let Refined { report, subblocks, stress, first_yield, meshes, why } =
        refine::solve(half.as_ref().unwrap_or(analysis), accuracy, asked, pulse)?;
    let mut report = match half {
        Some(_) => unfold::whole(&analysis.arch, report, &rigid),
        None => report,
    };
    report.cost.join(rigid.cost);
    plan.subblocks = if plan.half { unfold::subblocks(&analysis.arch, &subblocks) } else { subblocks };
    (plan.stress, plan.first_yield, plan.meshes) = (Some(stress), first_yield, meshes);
    plan.why.push(why);
    report.plan = Some(plan);
    Ok(report)
}

/// The same question on another mesh.
fn with_mesh(analysis: &Analysis, subblocks: Vec<[usize; 2]>, fields: Vec<FieldAt>) -> Analysis {
    let mut analysis = Analysis { fields, accuracy: None, ..analysis.clone() };
    analysis.mesh.subblocks = subblocks;
    analysis
}

/// How well the collapse load is known: path and limit window come to it from two sides. Where joints slide, all that is
/// known is that limit analysis allows no more.
fn intensity(report: &CollapseReport, asked: f64) -> Estimate {
    let apart = |end: &PathEnd| {
        let window = report.limit_window?;
        let off = |limit: f64| match (limit - end.load_factor).abs() {
            0.0 => 0.0,
            apart => apart / limit.abs().max(end.load_factor.abs()),
        };
        Some(off(window.lowest).min(off(window.highest)))
    };
    let ends: Option<Vec<f64>> = report.end.iter().chain(&report.other_end).map(apart).collect();
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

fn why_rigid(report: &CollapseReport) -> String {
    let slides = report.end.iter().chain(&report.other_end).any(|end| !end.mechanism.slides.is_empty());
    match report.outcome {
        Outcome::FallsAsBuilt => "Limit analysis finds no equilibrium that the arch could be loaded from: nothing to refine.",
        Outcome::NeverCollapses => "Limit analysis finds equilibrium at any load in reach.",
        Outcome::CannotTell => "Path and limit analysis do not agree, which no mesh would mend.",
        _ if slides => {
            "Joints slide at collapse: the load depends on their stiffness and on the order of loading, and limit analysis \
             bounds it from above only. Its distance to that bound stands for the error; no mesh makes it smaller."
        }
        _ => "The collapse load of stones that do not slide does not depend on the mesh: path and limit window give it.",
    }
    .into()
}

/// The left half, where the arch, its loads and the mechanism found are symmetric and no joint slides in it.
fn half_of(analysis: &Analysis, rigid: &CollapseReport) -> Option<Analysis> {
    let (arch, axis) = (&analysis.arch, analysis.arch.axis());
    let symmetric = |forces: &[_]| is_symmetric(forces, arch.voussoirs.len(), axis);
    let ends = rigid.end.iter().chain(&rigid.other_end);
    let whole = !arch.half && arch.asymmetry().is_none();
    if !(whole && symmetric(&analysis.fixed) && symmetric(&analysis.scaled) && { ends }.all(falls_evenly)) {
        return None;
    }
    let half = arch.left_half(None);
    let loads = [&analysis.fixed, &analysis.scaled].map(|forces| arch.on_left_half(&half, forces));
    let [fixed, scaled] = loads;
    Some(Analysis { arch: half, fixed, scaled, ..analysis.clone() })
}

/// True where nothing slides and every stone moves as the mirror image of its partner.
fn falls_evenly(end: &PathEnd) -> bool {
    let velocities = &end.mechanism.velocities;
    let largest = velocities.iter().flatten().fold(0.0f64, |most, v| most.max(v.abs()));
    let mirror_image = |([u, v, r], [x, y, q]): (&[f64; 3], &[f64; 3])| {
        [u + x, v - y, r + q].iter().all(|apart| apart.abs() <= SAME_VELOCITY * largest)
    };
    end.mechanism.slides.is_empty() && velocities.iter().zip(velocities.iter().rev()).all(mirror_image)
}

fn why_half(analysis: &Analysis, half: bool) -> String {
    match half {
        true => "Arch, loads and mechanism are symmetric: half the arch is modelled for the stress.",
        false if analysis.arch.half => "The arch is half an arch already.",
        false => {
            "Arch, loads or mechanism are not symmetric, or joints slide: the whole arch is modelled for the stress."
        }
    }
    .into()
}
