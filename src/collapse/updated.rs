//! Collapse on moving geometry: the load path of the arch in the place to which its loads have moved it.

use super::discretise::{Discretisation, Model};
use super::path::{Attempt, FALLEN, MOVED, Moved, disturbed, first_that_tells, lost, stand_moved};
use super::tolerances;
use super::{Analysis, AnalysisError, Cost, Unfollowed, UpdatedEnd, UpdatedGeometry, ending, mechanism};
use crate::dda::{Drive, End, LOW, Patience, Tracer};

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
    /// Whether that is the rise to a collapse at first order.
    pub ends: bool,
    /// Sum of all loads at the start, N/m.
    pub weight: f64,
}

/// A rise by less than the first of these shares of that at first order is none; one by more than the second is all of it.
const RISEN: [f64; 2] = [LOW, 0.99];

impl Course {
    /// Whether a path that has come down past its start had fallen: it had risen, and moved on as it came down, or had come as far
    /// as limit analysis lets it.
    fn fell(&self, tracer: &Tracer) -> bool {
        let risen = tracer.peak().map_or(0.0, |peak| (peak.parameter - self.sign * self.start) / self.rise);
        (risen > RISEN[0] && !tracer.retraced()) || (self.ends && risen > RISEN[1])
    }

    fn patience(&self) -> Patience {
        Patience { fall: FALLEN, rise: self.rise, movement: MOVED, creep: FALLEN, loads: true }
    }
}

/// Follows the load path on moving geometry; the work is added to `cost`.
///
/// # Errors
/// When stopped.
pub(super) fn follow<'a>(
    analysis: &'a Analysis,
    course: Course,
    cost: &mut Cost,
    built: &mut Discretisation<'a>,
) -> Result<UpdatedGeometry, AnalysisError> {
    let tells = |answer: &UpdatedGeometry| answer.end != UpdatedEnd::CannotTell;
    first_that_tells(tells, |number| attempt(analysis, course, number, cost, built))
}

fn attempt<'a>(
    analysis: &'a Analysis,
    course: Course,
    attempt: Attempt,
    cost: &mut Cost,
    built: &mut Discretisation<'a>,
) -> Result<UpdatedGeometry, AnalysisError> {
    let budget = built.budget;
    let model = built.model(analysis, attempt)?;
    let fixed = disturbed(model, course.start, attempt);
    let see = |tracer: &Tracer, load_factor: f64| budget.step(load_factor, tracer.events());
    let at_start = &mut |t: &Tracer| see(t, course.start);
    let (mut tracer, stood) = stand_moved(model, &fixed, course.start, course.weight, cost, at_start);
    let mut end = End::Stopped;
    if stood == Moved::Stands {
        tracer.drive_on(drive(model, fixed, course.sign), course.sign * course.start);
        end = tracer.trace_moving(course.cap, course.patience(), &mut |t| see(t, course.sign * t.parameter()));
    }
    cost.add(&tracer, Cost::default());
    if matches!((stood, end), (Moved::Stopped, _) | (Moved::Stands, End::Stopped)) {
        return Err(budget.stopped().into());
    }
    // A path that hardly rises, or comes back the way it went, and runs past its start has found the other end of the loads that
    // the arch can bear.
    let turned_back = tracer.parameter() < course.sign * course.start && !course.fell(&tracer);
    let why = lost(model, &tracer);
    let falls = end == End::Mechanism && !turned_back && tracer.return_to_peak();
    let residual = tracer.worst_residual();
    let end = match (stood, end) {
        _ if residual > tolerances::RESIDUAL => Err(Unfollowed::Coarse(residual)),
        (Moved::Falls(share), _) => Ok((UpdatedEnd::FallsAsLoaded, Some(share))),
        (Moved::Stands, End::Mechanism) if falls => Ok((UpdatedEnd::Collapse, None)),
        (Moved::Stands, End::Mechanism) => Err(Unfollowed::TurnedBack),
        (Moved::Stands, End::Reached) => Ok((UpdatedEnd::StandsToCap, None)),
        (Moved::Stands, End::Rising) => Ok((UpdatedEnd::BeyondModel, None)),
        (Moved::Stands, _) => Err(why),
        _ => Err(Unfollowed::NotLoaded),
    };
    Ok(describe(analysis, model, &tracer, course.sign, end))
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
    end: Result<(UpdatedEnd, Option<f64>), Unfollowed>,
) -> UpdatedGeometry {
    let (known, grows, why) = (end.is_ok(), !analysis.scaled.is_empty(), end.err());
    let (end, share) = end.unwrap_or((UpdatedEnd::CannotTell, None));
    let falls = matches!(end, UpdatedEnd::Collapse | UpdatedEnd::FallsAsLoaded);
    let of = |voussoir: usize| tracer.mean_motion(voussoir).displacement;
    let [left, right] = mechanism::crown(&analysis.structure, &analysis.scaled);
    let largest = (0..model.bodies).map(|v| of(v).norm()).fold(0.0, f64::max);
    UpdatedGeometry {
        end,
        why,
        load_factor: (known && share.is_none() && grows).then(|| sign * tracer.parameter()),
        share_of_loads: share,
        crown: known.then(|| 0.5 * (of(left) + of(right))),
        largest: known.then_some(largest),
        mechanism: falls.then(|| ending::at_rates(analysis, model, tracer)),
        snap: tracer.snap().filter(|_| known && share.is_none()).map(|at| sign * at),
        residual: tracer.worst_residual(),
    }
}
