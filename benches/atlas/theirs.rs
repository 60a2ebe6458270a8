//! The classic methods on one scene.

use super::classic::{Elastic, Found, Loading, METHODS, Model, bear_alone};
use super::judge::{Mark, Truth};
use super::ours::Ours;
use std::time::Instant;
use voussoir::collapse::{Analysis, Direction, Task};

/// A classic method may miss the load by this share, or where joints slide the interval of ours by the second.
const CLOSE: [f64; 2] = [0.01, 0.03];
/// Most voussoirs that the classic methods are run on.
const MOST: usize = 101;
/// Steps from the start to the limit: the exact load, which a user does not know, sets the step. No whole number, so that no
/// step ends on it.
const STEPS: f64 = 50.3;

/// What a classic method made of a scene.
#[derive(Debug, Clone)]
pub struct Theirs {
    pub mark: Mark,
    pub found: Found,
    /// It bears the loads at the start from the unstressed arch.
    pub alone: bool,
    pub seconds: f64,
}

/// Runs and judges them; none where they do not apply.
pub fn theirs(analysis: &Analysis, truth: &Truth, ours: &Ours) -> Vec<Option<Theirs>> {
    let apply = matches!(analysis.task, Task::Collapse(_))
        && analysis.task.motion().is_none()
        && analysis.mesh.subblocks.iter().all(|cut| *cut == [1, 1])
        && analysis.structure.abutments() == [None, None]
        && analysis.structure.voussoirs().len() <= MOST;
    if !apply {
        return vec![None; METHODS.len()];
    }
    let sign = if analysis.task.direction() == Direction::Increase { 1.0 } else { -1.0 };
    let loading = loading(truth, sign);
    let stone = &analysis.structure.stones[0];
    let penalty = analysis.penalty_ratio * stone.youngs_modulus;
    let elastic = Elastic { youngs_modulus: stone.youngs_modulus, poissons_ratio: stone.poissons_ratio, penalty };
    let model = Model::new(&truth.problem, elastic);
    let [open_close, newton] = bear_alone(&model, loading);
    METHODS
        .iter()
        .zip([open_close, newton, true])
        .map(|((_, method), alone)| {
            let start = Instant::now();
            let found = method(&model, loading);
            let seconds = start.elapsed().as_secs_f64();
            Some(Theirs { mark: judge(&found, truth, ours, sign), found, alone, seconds })
        })
        .collect()
}

/// Where to start and how to step: inside the window, towards its end.
fn loading(truth: &Truth, sign: f64) -> Loading {
    let far = 100.0 * truth.balance;
    let weightless = truth.problem.fixed.is_empty();
    let Some([low, high]) = truth.window else {
        return Loading { start: 0.0, step: sign * 0.1 * truth.balance, most: sign * far };
    };
    let limit = if sign > 0.0 { high } else { low };
    let start = match [low, high] {
        // Nothing presses the joints of weightless stones at 0.
        _ if truth.bears_nothing() => sign * truth.balance,
        _ if weightless && limit.is_finite() => 0.5 * limit,
        _ if weightless => sign * truth.balance,
        _ if low <= 0.0 && high >= 0.0 => 0.0,
        _ if low.is_finite() && high.is_finite() => 0.5 * (low + high),
        _ if low.is_finite() => 2.0 * low,
        _ => 2.0 * high,
    };
    let way = limit - start;
    let (step, most) = if way.is_finite() && way != 0.0 && !truth.bears_nothing() {
        (way / STEPS, start + 2.0 * way)
    } else {
        (sign * far / STEPS, start + sign * far)
    };
    Loading { start, step, most }
}

fn judge(found: &Found, truth: &Truth, ours: &Ours, sign: f64) -> Mark {
    let sliding = ours.interval.is_some();
    let accepted = ours.accepted(truth, sign);
    let wrong = |words: &str| Mark::Wrong(format!("{words}, right: {accepted:?}"));
    match (found, accepted) {
        (Found::GaveUp, _) => Mark::GaveUp("no convergence".into()),
        _ if truth.undecided() => Mark::Open,
        (Found::FallsAsBuilt, None) => Mark::Right,
        (Found::FallsAsBuilt, _) if truth.bears_nothing() => Mark::Right,
        (Found::FallsAsBuilt, _) if fell_by_sliding(ours) => Mark::Right,
        (Found::FallsAsBuilt, Some(_)) => wrong("falls as built"),
        (_, None) => wrong("stands"),
        (Found::Stands, Some([_, high])) if high.is_infinite() || nothing_scaled(truth) => Mark::Right,
        (Found::Stands, Some([_, high])) if high.abs() > 50.0 * truth.balance => Mark::Open,
        (Found::Stands, _) => wrong("stands"),
        (Found::FallsAt(load), Some([low, high])) => {
            let close = CLOSE[usize::from(sliding)];
            let inside = (low..=high).contains(load);
            let near = [low, high].into_iter().any(|end| truth.apart(*load, end) <= close);
            if inside || near { Mark::Right } else { wrong(&format!("falls at {load}")) }
        }
    }
}

fn nothing_scaled(truth: &Truth) -> bool {
    truth.problem.scaled.is_empty()
}

/// Ours falls by sliding as its loads come on, where limit analysis finds equilibrium.
fn fell_by_sliding(ours: &Ours) -> bool {
    ours.outcome == Some(voussoir::collapse::Outcome::SlidesAsBuilt)
}
