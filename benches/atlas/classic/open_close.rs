//! Shi's open-close iteration (Discontinuous deformation analysis, PhD thesis, Berkeley 1988), statics: with every contact
//! open, sliding or locked, the linear system is solved, the states are looked at again, until they stay. Friction of sliding
//! contacts acts as a load, from the normal force of the iteration before.

use super::march::{State, Stuck, largest, residual};
use super::model::{Contact, Law, Model};

/// Shi stops after six iterations and takes a smaller step; more do no harm here.
const ITERATIONS: usize = 20;
const CONVERGED: f64 = 1e-9;
/// As in Newton's method; statics lacks the inertia that keeps Shi's matrix regular.
const SHIFT: f64 = 1e-10;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Mode {
    Open,
    /// Sign of the shear on the block after.
    Slide(f64),
    Lock,
}

pub fn correct(model: &Model, from: &State, loads: &[f64], weight: f64) -> Result<State, Stuck> {
    let mut state = from.clone();
    let look = |state: &State| -> Vec<Mode> {
        model
            .contacts
            .iter()
            .zip(&state.anchors)
            .map(|(contact, anchor)| mode(model, contact, state, *anchor))
            .collect()
    };
    let (mut modes, mut moves_away) = (look(&state), false);
    for _ in 0..ITERATIONS {
        let mut right = loads.to_vec();
        model.take_elastic(&state.d, &mut right);
        for ((contact, mode), anchor) in model.contacts.iter().zip(&modes).zip(&state.anchors) {
            model.push(contact, held(model, contact, *mode, &state, *anchor), &mut right);
        }
        let springs: Vec<_> = model.contacts.iter().zip(&modes).map(|(c, m)| springs(model, c, *m)).collect();
        let mut matrix = model.stiffness(&springs);
        matrix.shift(SHIFT);
        let Some(step) = matrix.solve(right) else { return Err(Stuck { moves_away: true }) };
        moves_away = largest(&step) > model.size;
        state.d.iter_mut().zip(&step).for_each(|(d, s)| *d += s);
        let next = look(&state);
        if next == modes && largest(&residual(model, &state, loads)) <= CONVERGED * weight {
            return Ok(state);
        }
        modes = next;
    }
    Err(Stuck { moves_away })
}

/// Springs of a mode.
fn springs(model: &Model, contact: &Contact, mode: Mode) -> [[f64; 2]; 2] {
    let k = model.penalty;
    match (contact.law, mode) {
        (Law::Bonded, _) => [[k, 0.0], [0.0, k]],
        (Law::Mirror, _) => [[k, 0.0], [0.0, 0.0]],
        (_, Mode::Open) => [[0.0; 2]; 2],
        (_, Mode::Slide(_)) => [[k, 0.0], [0.0, 0.0]],
        (_, Mode::Lock) => [[k, 0.0], [0.0, k]],
    }
}

/// Force of a contact in a mode where it is; friction from the normal force there.
fn held(model: &Model, contact: &Contact, mode: Mode, state: &State, anchor: f64) -> [f64; 2] {
    let [gap, slip] = model.opening(contact, &state.d);
    let (normal, trial) = (-model.penalty * gap, -model.penalty * (slip - anchor));
    match (contact.law, mode) {
        (Law::Bonded, _) => [normal, trial],
        (Law::Mirror, _) => [normal, 0.0],
        (_, Mode::Open) => [0.0, 0.0],
        (Law::Coulomb { friction, cohesion }, Mode::Slide(sign)) => {
            [normal, sign * (friction * normal.max(0.0) + cohesion)]
        }
        (_, Mode::Lock) => [normal, trial],
    }
}

/// Open on tension, locked on penetration, sliding where the lock would need more than Coulomb's bound.
fn mode(model: &Model, contact: &Contact, state: &State, anchor: f64) -> Mode {
    let Law::Coulomb { friction, cohesion } = contact.law else { return Mode::Lock };
    let [gap, slip] = model.opening(contact, &state.d);
    let (trial, capacity) = (-model.penalty * (slip - anchor), friction * -model.penalty * gap + cohesion);
    if gap > 0.0 {
        Mode::Open
    } else if trial.abs() > capacity || (friction == 0.0 && cohesion == 0.0) {
        Mode::Slide(if trial < 0.0 { -1.0 } else { 1.0 })
    } else {
        Mode::Lock
    }
}
