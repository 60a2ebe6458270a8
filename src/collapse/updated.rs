//! Collapse on moving geometry: the load path of the arch in the place to which its loads have moved it.

use super::certificate::UNBALANCED;
use super::discretise::{Model, discretise};
use super::path::{ATTEMPTS, Attempt, disturbed, stand};
use super::{Analysis, AnalysisError, Cost, LoadStep, UpdatedEnd, UpdatedGeometry, Watch, ending, mechanism};
use crate::dda::{Drive, End, Patience, Tracer};
use std::cell::Cell;

/// An arch falls that has to give up this share of its first-order load to stay in equilibrium, or to move by this share of
/// its size before it can carry more. Shorter dips are snaps.
const FALLEN: [f64; 2] = [0.1, 0.01];

/// From where to where the load factor goes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Course {
    /// Load factor at the start, at which the arch stands at first order.
    pub start: f64,
    /// +1 where it increases, -1 where it decreases.
    pub sign: f64,
    /// Largest absolute load factor to try.
    pub cap: f64,
    /// Load factor of collapse at first order, where there is one.
    pub first_order: Option<f64>,
    /// Sum of all loads at the start, N/m.
    pub weight: f64,
}

impl Course {
    fn patience(&self) -> Patience {
        let rise = self.first_order.map_or(0.0, |collapse| (collapse - self.start).abs());
        Patience { fall: FALLEN[0], rise, movement: FALLEN[1] }
    }
}

/// Follows the load path on moving geometry; the work is added to `cost`.
///
/// # Errors
/// When stopped by `watch`.
pub(super) fn follow(
    analysis: &Analysis,
    course: Course,
    cost: &mut Cost,
    watch: &mut dyn Watch,
) -> Result<UpdatedGeometry, AnalysisError> {
    let mut answer = attempt(analysis, course, Attempt::number(0), cost, watch)?;
    for i in 1..ATTEMPTS {
        if answer.end != UpdatedEnd::CannotTell {
            break;
        }
        answer = attempt(analysis, course, Attempt::number(i), cost, watch)?;
    }
    Ok(answer)
}

fn attempt(
    analysis: &Analysis,
    course: Course,
    attempt: Attempt,
    cost: &mut Cost,
    watch: &mut dyn Watch,
) -> Result<UpdatedGeometry, AnalysisError> {
    let model = discretise(analysis, attempt.seed)?;
    let fixed = disturbed(&model, course.start, attempt);
    let reached = Cell::new(course.start);
    let mut see = |tracer: &Tracer, load_factor: f64| {
        reached.set(load_factor);
        watch.on_step(&LoadStep { load_factor, events: tracer.events() }).map_break(|_| ())
    };
    let (mut tracer, mut end) =
        stand(&model, &fixed, course.start, course.weight, &mut |t| see(t, course.start * t.parameter()));
    let mut moved = false;
    if end == End::Reached {
        end = tracer
            .move_on(drive(&model, fixed, course.sign), course.sign * course.start, &mut |t| see(t, course.start));
        if end == End::Reached {
            moved = true;
            end = tracer.trace_moving(course.cap, course.patience(), &mut |t| see(t, course.sign * t.parameter()));
        }
    }
    cost.add(&tracer, Cost::default());
    if end == End::Stopped {
        return Err(AnalysisError::Stopped { load_factor: reached.get(), events: tracer.events() });
    }
    let falls = end == End::Mechanism && tracer.return_to_peak();
    let end = match end {
        _ if tracer.worst_residual() > UNBALANCED => UpdatedEnd::CannotTell,
        End::Mechanism if moved && falls => UpdatedEnd::Collapse,
        End::Mechanism | End::Rising if !moved => UpdatedEnd::FallsAsLoaded,
        End::Reached => UpdatedEnd::StandsToCap,
        End::Rising => UpdatedEnd::BeyondModel,
        _ => UpdatedEnd::CannotTell,
    };
    Ok(describe(analysis, &model, &tracer, course.sign, end))
}

fn drive(model: &Model, fixed: Vec<f64>, sign: f64) -> Drive {
    let signed = |loads: &[f64]| loads.iter().map(|load| load * sign).collect::<Vec<_>>();
    Drive {
        base: fixed,
        rate: signed(&model.scaled.on_nodes),
        turned: [model.fixed.turned.clone(), signed(&model.scaled.turned)],
        ..Drive::default()
    }
}

fn describe(analysis: &Analysis, model: &Model, tracer: &Tracer, sign: f64, end: UpdatedEnd) -> UpdatedGeometry {
    let residual = tracer.worst_residual();
    if matches!(end, UpdatedEnd::FallsAsLoaded | UpdatedEnd::CannotTell) {
        return UpdatedGeometry {
            end,
            load_factor: None,
            crown: None,
            largest: None,
            mechanism: None,
            snap: None,
            residual,
        };
    }
    let falls = end == UpdatedEnd::Collapse;
    let of = |voussoir: usize| tracer.mean_motion(model.first_voussoir + voussoir).displacement;
    let [left, right] = mechanism::crown(&analysis.arch);
    let largest = (0..model.voussoirs).map(|v| of(v).norm()).fold(0.0, f64::max);
    let mechanism = falls.then(|| ending::at_rates(analysis, model, tracer));
    UpdatedGeometry {
        end,
        load_factor: Some(sign * tracer.parameter()),
        crown: Some(0.5 * (of(left) + of(right))),
        largest: Some(largest),
        mechanism,
        snap: tracer.snap().map(|at| sign * at),
        residual,
    }
}
