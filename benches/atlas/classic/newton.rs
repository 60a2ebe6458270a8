//! Newton's method with the consistent (unsymmetric) tangent of Coulomb's law and a backtracking line search on the residual
//! (Wriggers, Computational Contact Mechanics, 2006; Armijo's rule as in Nocedal & Wright, Numerical Optimization, 2006).

use super::march::{State, Stuck, force, largest, residual};
use super::model::{Law, Model};

const ITERATIONS: usize = 25;
const BACKTRACKS: usize = 12;
/// Largest residual, share of the loads.
const CONVERGED: f64 = 1e-9;
/// Added to the diagonal, share of its largest entry: a stone held by nothing for a moment must not end the iteration.
const SHIFT: f64 = 1e-10;

/// With the line search and, where it gets stuck, once more with full steps.
pub fn correct(model: &Model, from: &State, loads: &[f64], weight: f64) -> Result<State, Stuck> {
    iterate(model, from, loads, weight, BACKTRACKS)
        .or_else(|stuck| iterate(model, from, loads, weight, 0).map_err(|_| stuck))
}

fn iterate(model: &Model, from: &State, loads: &[f64], weight: f64, backtracks: usize) -> Result<State, Stuck> {
    let mut state = from.clone();
    let mut moves_away = false;
    let squares = |r: &[f64]| r.iter().map(|x| x * x).sum::<f64>();
    let mut left = residual(model, &state, loads);
    for _ in 0..ITERATIONS {
        if largest(&left) <= CONVERGED * weight {
            return Ok(state);
        }
        let mut matrix = model.stiffness(&tangents(model, &state));
        matrix.shift(SHIFT);
        let Some(step) = matrix.solve(left.clone()) else { return Err(Stuck { moves_away: true }) };
        moves_away = largest(&step) > model.size;
        let (before, mut length) = (squares(&left), 1.0);
        for trial in 0..=backtracks {
            let d = state.d.iter().zip(&step).map(|(d, s)| d + length * s).collect();
            let next = State { d, anchors: state.anchors.clone() };
            let found = residual(model, &next, loads);
            if backtracks == 0 || squares(&found) <= (1.0 - 2e-4 * length) * before {
                (state, left) = (next, found);
                break;
            }
            if trial == backtracks {
                return Err(Stuck { moves_away });
            }
            length *= 0.5;
        }
    }
    Err(Stuck { moves_away })
}

/// Derivatives of (-N, -T) by gap and slip.
fn tangents(model: &Model, state: &State) -> Vec<[[f64; 2]; 2]> {
    let k = model.penalty;
    let one = |(contact, anchor): (&super::model::Contact, &f64)| {
        let opening = model.opening(contact, &state.d);
        let trial = -k * (opening[1] - anchor);
        let [normal, shear] = force(model, contact, opening, *anchor);
        match contact.law {
            Law::Bonded => [[k, 0.0], [0.0, k]],
            Law::Mirror => [[k, 0.0], [0.0, 0.0]],
            Law::Coulomb { .. } if normal == 0.0 && opening[0] > 0.0 => [[0.0; 2]; 2],
            Law::Coulomb { friction, .. } if shear != trial => [[k, 0.0], [trial.signum() * friction * k, 0.0]],
            Law::Coulomb { friction: 0.0, cohesion: 0.0 } => [[k, 0.0], [0.0, 0.0]],
            Law::Coulomb { .. } => [[k, 0.0], [0.0, k]],
        }
    };
    model.contacts.iter().zip(&state.anchors).map(one).collect()
}
