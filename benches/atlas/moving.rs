//! The judge of arches that move: settlements against the thrusts that limit analysis allows, motions against themselves.

use super::judge::{EQUAL, Mark, Truth};
use crate::common::falling::measure;
use crate::common::oracle::Aim;
use voussoir::collapse::{
    Analysis, CollapseReport, FallingMotion, MotionEnd, Outcome, SettlementPath, SettlementTask, Task,
};

/// A movement of springings, as a share of the radius, that surely ends on three hinges.
const LARGE: f64 = 1e-3;
/// Deepest overlap of stones, share of the thickness, and most friction beyond its bound, share of the loads.
const MOTION: [f64; 2] = [1e-3, 0.05];
/// Largest residual of equilibrium in a motion, share of the loads.
const RESIDUAL: f64 = 1e-9;

/// Thrusts stay within those of limit analysis, and springings that part or approach far enough find the least or the greatest.
pub fn judge_settlement(analysis: &Analysis, report: &CollapseReport, truth: &Truth) -> Mark {
    if report.outcome == Outcome::CannotTell {
        return Mark::GaveUp(format!("{:?}", report.notes));
    }
    if truth.undecided() {
        return Mark::Open;
    }
    let stands = !truth.falls();
    let Some(settled) = report.settlement() else {
        // Where joints slide, standing depends on how the arch was built.
        let slides = report.end.as_ref().is_some_and(|end| end.mechanism.slips());
        let fits = match report.outcome {
            Outcome::FallsAsBuilt => !stands,
            Outcome::SlidesAsBuilt => slides,
            _ => false,
        };
        return if fits { Mark::Right } else { Mark::Wrong(format!("{:?}, stands: {stands}", report.outcome)) };
    };
    match thrust_fault(analysis, &settled.first_order, truth) {
        None => Mark::Right,
        Some(words) => Mark::Wrong(words),
    }
}

fn thrust_fault(analysis: &Analysis, path: &SettlementPath, truth: &Truth) -> Option<String> {
    let thrust = |aim: Aim| truth.problem.solve(aim).value(aim);
    let (Some(least), Some(greatest)) = (thrust(Aim::LeastThrust), thrust(Aim::GreatestThrust)) else {
        return Some("moves where limit analysis finds no equilibrium".into());
    };
    let slack = EQUAL * greatest.abs().max(least.abs());
    let outside = path.points.iter().find(|p| p.forces[0].x < least - slack || p.forces[0].x > greatest + slack);
    if let Some(point) = outside {
        return Some(format!("thrust {} outside {least} to {greatest}", point.forces[0].x));
    }
    let Task::Settlement(SettlementTask { movements, .. }) = &analysis.task else { return None };
    let [left, right] = movements.as_slice() else { return None };
    let outwards = right.by.x - left.by.x;
    let size = analysis.structure.ring().iter().map(|joint| joint.intrados.y).fold(0.0, f64::max);
    if outwards.abs() < LARGE * size || !path.mechanism.slides.is_empty() {
        return None;
    }
    let (found, limit) = (path.points.last()?.forces[0].x, if outwards > 0.0 { least } else { greatest });
    ((found - limit).abs() > slack).then(|| format!("thrust ends at {found}, limit {limit}"))
}

/// Motions end as one of their ends, stones keep their shape and stay out of each other, in equilibrium.
pub fn judge_motion(analysis: &Analysis, report: &CollapseReport) -> Mark {
    let motions = report.motion.iter().chain(&report.other_motion);
    if motions.clone().any(|motion| motion.end == MotionEnd::Lost) {
        return Mark::GaveUp("the motion was lost".into());
    }
    match motions.filter_map(|motion| motion_fault(analysis, motion)).next() {
        None => Mark::Right,
        Some(words) => Mark::Wrong(words),
    }
}

fn motion_fault(analysis: &Analysis, motion: &FallingMotion) -> Option<String> {
    let found = measure(analysis, motion);
    let holds = found.overlap < MOTION[0]
        && found.area < 1e-9
        && found.excess < MOTION[1]
        && found.residual < RESIDUAL
        && found.work >= 0.0;
    (!holds).then(|| format!("{found:?}"))
}
