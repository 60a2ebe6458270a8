//! Load stepping: fixed steps, halved where the corrector does not converge, until it has to stop.
//!
//! A step that does not converge is no collapse in itself. It counts as one where the corrector was about to move the arch by
//! more than its thickness; else the method has given up. That is the kinder reading: taken as collapse throughout, as is usual,
//! every "gave up" would be a wrong load.

use super::model::{Contact, Law, Model};
use super::{Found, Loading, interior_point};

/// Steps in which the loads at the start come on.
const STARTING: usize = 10;
/// A step is halved so many times.
const HALVINGS: usize = 7;

/// Displacements, and the slip at which every contact carries no shear.
#[derive(Debug, Clone)]
pub struct State {
    pub d: Vec<f64>,
    pub anchors: Vec<f64>,
}

/// Why a corrector stopped: whether it was about to move the arch by more than its thickness.
#[derive(Debug, Clone, Copy)]
pub struct Stuck {
    pub moves_away: bool,
}

/// Finds equilibrium under loads of this size from a state.
pub type Corrector = fn(&Model, &State, &[f64], f64) -> Result<State, Stuck>;

/// Brings the loads on from the unstressed arch.
pub fn ramp(model: &Model, factor: f64, correct: Corrector) -> Result<State, Stuck> {
    let mut state = State { d: vec![0.0; model.unknowns()], anchors: vec![0.0; model.contacts.len()] };
    let weight = model.weight(factor);
    for i in 0..STARTING {
        let [from, to] = [i, i + 1].map(|i| i as f64 / STARTING as f64);
        let loads = |s: f64| (model.loads(s, factor), weight);
        advance(model, &mut state, [from, to], correct, &loads).map_err(|(_, stuck)| stuck)?;
    }
    Ok(state)
}

/// Equilibrium at the start: from the unstressed arch or, where that fails, from the equilibrium of the interior point, a help
/// without which these methods seldom get further.
fn set_out(model: &Model, factor: f64, correct: Corrector) -> Result<State, Stuck> {
    ramp(model, factor, correct).or_else(|stuck| {
        let guess = interior_point::equilibrium(model, factor).ok_or(stuck)?;
        correct(model, &guess, &model.loads(1.0, factor), model.weight(factor))
    })
}

/// Brings the loads on, then steps the load factor.
pub fn march(model: &Model, loading: Loading, correct: Corrector) -> Found {
    let mut state = match set_out(model, loading.start, correct) {
        Ok(state) => commit(model, state),
        Err(Stuck { moves_away: true }) => return Found::FallsAsBuilt,
        Err(_) => return Found::GaveUp,
    };
    if model.weight(1.0) == model.weight(0.0) {
        return Found::Stands;
    }
    let at = |factor: f64| (model.loads(1.0, factor), model.weight(factor));
    let mut factor = loading.start;
    while (factor - loading.start).abs() < (loading.most - loading.start).abs() {
        match advance(model, &mut state, [factor, factor + loading.step], correct, &at) {
            Ok(()) => factor += loading.step,
            Err((reached, Stuck { moves_away: true })) => return Found::FallsAt(reached),
            Err(_) => return Found::GaveUp,
        }
    }
    Found::Stands
}

/// One step, in halves of halves where it has to be; the parameter reached where it stops.
fn advance(
    model: &Model,
    state: &mut State,
    [from, to]: [f64; 2],
    correct: Corrector,
    loads: &dyn Fn(f64) -> (Vec<f64>, f64),
) -> Result<(), (f64, Stuck)> {
    let (mut reached, mut step, mut halvings) = (from, to - from, 0);
    while (reached - to).abs() > 1e-12 * to.abs().max(from.abs()) {
        let (forces, weight) = loads(reached + step);
        match correct(model, state, &forces, weight) {
            Ok(next) => {
                reached += step;
                *state = commit(model, next);
            }
            Err(stuck) if halvings == HALVINGS => return Err((reached, stuck)),
            Err(_) => {
                step *= 0.5;
                halvings += 1;
            }
        }
        // Halves do not always end in `to` to the last digit.
        step = if (to - reached).abs() < step.abs() { to - reached } else { step };
    }
    Ok(())
}

/// Force at a contact by its law.
pub fn force(model: &Model, contact: &Contact, [gap, slip]: [f64; 2], anchor: f64) -> [f64; 2] {
    let (pressure, trial) = (-model.penalty * gap, -model.penalty * (slip - anchor));
    match contact.law {
        Law::Bonded => [pressure, trial],
        Law::Mirror => [pressure, 0.0],
        Law::Coulomb { .. } if pressure <= 0.0 => [0.0, 0.0],
        Law::Coulomb { friction, cohesion } => {
            let capacity = friction * pressure + cohesion;
            [pressure, trial.clamp(-capacity, capacity)]
        }
    }
}

/// Residual of equilibrium.
pub fn residual(model: &Model, state: &State, loads: &[f64]) -> Vec<f64> {
    let mut residual = loads.to_vec();
    model.take_elastic(&state.d, &mut residual);
    for (contact, anchor) in model.contacts.iter().zip(&state.anchors) {
        model.push(contact, force(model, contact, model.opening(contact, &state.d), *anchor), &mut residual);
    }
    residual
}

/// Contacts that slid or opened keep the shear they have, and no more, for the next step.
fn commit(model: &Model, mut state: State) -> State {
    for (contact, anchor) in model.contacts.iter().zip(&mut state.anchors) {
        let opening = model.opening(contact, &state.d);
        let [_, shear] = force(model, contact, opening, *anchor);
        *anchor = opening[1] + shear / model.penalty;
    }
    state
}

/// Largest entry of a vector.
pub fn largest(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |most, x| most.max(x.abs()))
}
