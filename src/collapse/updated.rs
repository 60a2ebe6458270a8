//! Collapse on moving geometry: the load path of the arch in the place to which its loads have moved it.

use super::certificate::UNBALANCED;
use super::discretise::{Model, discretise};
use super::path::{Attempt, FALLEN, MOVED, Moved, disturbed, first_that_tells, stand_moved};
use super::pulse::Pulse;
use super::{Analysis, AnalysisError, Cost, UpdatedEnd, UpdatedGeometry, ending, mechanism};
use crate::dda::{Drive, End, Patience, Tracer};

/// Note on stones that are one subblock thick.
pub(super) const UNBENT: &str = "On moving geometry stones that are one subblock thick do not bend; only their joints give. \
     With soft stone the arch then seems stronger than it is: compare a mesh of at least 2 x 2.";

/// From where to where the load factor goes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Course {
    /// Load factor at the start, at which the arch stands at first order.
    pub start: f64,
    /// +1 where it increases, -1 where it decreases.
    pub sign: f64,
    /// Largest absolute load factor to try.
    pub cap: f64,
    /// How much the load factor rises at first order; where there is no end to it, by how much loads as large as those at
    /// the start would raise it. Dips are measured by it.
    pub rise: f64,
    /// Sum of all loads at the start, N/m.
    pub weight: f64,
}

impl Course {
    fn patience(&self) -> Patience {
        Patience { fall: FALLEN, rise: self.rise, movement: MOVED, creep: FALLEN, lost_is_over: true }
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
    pulse: &Pulse,
) -> Result<UpdatedGeometry, AnalysisError> {
    let tells = |answer: &UpdatedGeometry| answer.end != UpdatedEnd::CannotTell;
    first_that_tells(tells, |number| attempt(analysis, course, number, cost, pulse))
}

fn attempt(
    analysis: &Analysis,
    course: Course,
    attempt: Attempt,
    cost: &mut Cost,
    pulse: &Pulse,
) -> Result<UpdatedGeometry, AnalysisError> {
    let model = discretise(analysis, attempt.seed, pulse)?;
    let fixed = disturbed(&model, course.start, attempt);
    let see = |tracer: &Tracer, load_factor: f64| pulse.step(load_factor, tracer.events());
    let at_start = &mut |t: &Tracer| see(t, course.start);
    let (mut tracer, stood) = stand_moved(&model, &fixed, course.start, course.weight, cost, at_start);
    let mut end = End::Stopped;
    if stood == Moved::Stands {
        tracer.drive_on(drive(&model, fixed, course.sign), course.sign * course.start);
        end = tracer.trace_moving(course.cap, course.patience(), &mut |t| see(t, course.sign * t.parameter()));
    }
    cost.add(&tracer, Cost::default());
    if matches!((stood, end), (Moved::Stopped, _) | (Moved::Stands, End::Stopped)) {
        return Err(pulse.stopped());
    }
    // A path that runs back past its start has found the other end of the loads that the arch can bear.
    let turned_back = tracer.parameter() < course.sign * course.start;
    let falls = end == End::Mechanism && !turned_back && tracer.return_to_peak();
    let end = match (stood, end) {
        _ if tracer.worst_residual() > UNBALANCED => UpdatedEnd::CannotTell,
        (Moved::Falls(_), _) => UpdatedEnd::FallsAsLoaded,
        (Moved::Stands, End::Mechanism) if falls => UpdatedEnd::Collapse,
        (Moved::Stands, End::Reached) => UpdatedEnd::StandsToCap,
        (Moved::Stands, End::Rising) => UpdatedEnd::BeyondModel,
        _ => UpdatedEnd::CannotTell,
    };
    let share = if let (Moved::Falls(share), UpdatedEnd::FallsAsLoaded) = (stood, end) { Some(share) } else { None };
    Ok(describe(analysis, &model, &tracer, course.sign, end, share))
}

fn drive(model: &Model, fixed: Vec<f64>, sign: f64) -> Drive {
    let signed = |loads: &[f64]| loads.iter().map(|load| load * sign).collect::<Vec<_>>();
    Drive {
        base: fixed,
        rate: signed(&model.scaled.on_nodes),
        turned: [model.turned[0].clone(), signed(&model.turned[1])],
        ..Drive::default()
    }
}

fn describe(
    analysis: &Analysis,
    model: &Model,
    tracer: &Tracer,
    sign: f64,
    end: UpdatedEnd,
    share: Option<f64>,
) -> UpdatedGeometry {
    let (known, grows) = (end != UpdatedEnd::CannotTell, !analysis.scaled.is_empty());
    let falls = matches!(end, UpdatedEnd::Collapse | UpdatedEnd::FallsAsLoaded);
    let of = |voussoir: usize| tracer.mean_motion(model.first_voussoir + voussoir).displacement;
    let [left, right] = mechanism::crown(&analysis.arch);
    let largest = (0..model.voussoirs).map(|v| of(v).norm()).fold(0.0, f64::max);
    UpdatedGeometry {
        end,
        load_factor: (known && share.is_none() && grows).then(|| sign * tracer.parameter()),
        share_of_loads: share,
        crown: known.then(|| 0.5 * (of(left) + of(right))),
        largest: known.then_some(largest),
        mechanism: falls.then(|| ending::at_rates(analysis, model, tracer)),
        snap: tracer.snap().filter(|_| known && share.is_none()).map(|at| sign * at),
        residual: tracer.worst_residual(),
    }
}
