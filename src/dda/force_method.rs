//! States of a chain of bodies under loads that grow, by the force method.
//!
//! A chain stands between two pieces of ground, joined by interfaces of two contact points each. Equilibrium leaves three redundants,
//! the resultant X at the first interface: the normal force at every point and the shear V through every interface follow from them by
//! statics, whatever state the points are in. What is left besides is one split t an interface, of the shear between its two points,
//! V / 2 + t and V / 2 - t. Redundants and splits make the complementary energy of bodies and contacts stationary. A split meets
//! those of its neighbours only, so that a state takes the solution of a tridiagonal system and one of three equations, a few times.
//!
//! States are found one by one ([`Loaded::state`]), and one after the other along the load path ([`ChainPath`]).
//!
//! - *Openings.* No point pulls: N >= 0, each with its gap for a multiplier. Three redundants hold at most three points at N = 0.
//! - *Friction.* A point that slides has its shear prescribed, T = s mu N, and so the split of its interface; what the split's equation
//!   is then off by is the slip. Shear works against no normal force, for sliding does not dilate: virtual forces leave the shear
//!   of a point that slides alone.
//!
//! Slip is measured from the unstressed start, so the law has no memory. But where a whole interface has slid on the way there may be
//! several states, of which a load path tells one: such states are not told here, see [`Loaded::sticks_between`].

mod compatibility;
mod displacements;
mod friction;
mod openings;
mod path;
mod reduced;
mod shifts;
mod statics;

use super::assembly::{Assembly, Beside};
use super::contact::{Contact, Law};
use crate::budget::{Budget, Stopped};
use compatibility::Compatibility;
use friction::Split;
use openings::Opening;
use reduced::Reduced;
use statics::Statics;

pub use compatibility::Loaded;
pub use path::{ChainPath, ChainStep};
pub use shifts::{Shifts, ShiftsAlong};

/// Most times that splits are renewed for one state (measured: 2 to 25 where they settle at all).
const ROUNDS: usize = 60;
/// Work of renewing an interface, in multiplications.
const RENEWED: usize = 100;

/// Three numbers that go with the redundants.
type Three = [f64; 3];
/// A linear function of redundants and loads: per unit of every redundant, of the loads that stay, and of those that grow.
type Linear = [f64; 5];

/// A chain.
#[derive(Debug)]
pub struct ForceMethod<'a> {
    assembly: &'a Assembly,
    statics: Vec<Statics>,
    compatibility: Compatibility,
}

/// A state of a chain.
#[derive(Debug, Clone)]
pub struct ChainState {
    /// How many times the loads that grow act.
    pub load_factor: f64,
    redundants: Three,
    splits: Vec<Split>,
    open: Vec<Opening>,
    /// The splits by the redundants, as they are here.
    reduced: Reduced,
}

fn dot(a: &Three, b: &Three) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn plus(a: &Three, b: &Three) -> Three {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// The value of a linear function.
fn value(of: &Linear, redundants: &Three, load_factor: f64) -> f64 {
    of[0] * redundants[0] + of[1] * redundants[1] + of[2] * redundants[2] + of[3] + of[4] * load_factor
}

/// True where bodies stand in a row between two pieces of ground, joined by interfaces of two points each.
fn is_chain(assembly: &Assembly) -> bool {
    let n = assembly.bodies();
    let expected = |k: usize, beside: [Beside; 2]| {
        let before = if k == 0 { matches!(beside[0], Beside::Ground(_)) } else { beside[0] == Beside::Body(k - 1) };
        let after = if k == n { matches!(beside[1], Beside::Ground(_)) } else { beside[1] == Beside::Body(k) };
        before && after && assembly.at_interface(k).len() == 2
    };
    n > 0 && assembly.interfaces() == n + 1 && (0..=n).all(|k| expected(k, assembly.beside(k)))
}

/// True where a contact carries shear, by friction or as it is bonded, and no cohesion or crushing comes into it.
fn is_rough(contact: &Contact) -> bool {
    match contact.law {
        Law::Bonded => contact.stiffness[1] > 0.0,
        Law::Coulomb { friction, cohesion, cap } => friction > 0.0 && cohesion == 0.0 && cap == f64::INFINITY,
    }
}

/// True where a contact carries no shear.
fn is_smooth(contact: &Contact) -> bool {
    match contact.law {
        Law::Bonded => contact.stiffness[1] == 0.0,
        Law::Coulomb { friction, cohesion, cap } => friction == 0.0 && cohesion == 0.0 && cap == f64::INFINITY,
    }
}

impl<'a> ForceMethod<'a> {
    /// Of an assembly that is such a chain, its interfaces rough but for the last, which may be smooth; none of another.
    ///
    /// # Errors
    /// When stopped.
    pub fn new(assembly: &'a Assembly, budget: &Budget) -> Result<Option<Self>, Stopped> {
        if !is_chain(assembly) {
            return Ok(None);
        }
        let (before, last) = assembly.contacts().split_at(assembly.contacts().len() - 2);
        if !(before.iter().all(is_rough) && (last.iter().all(is_rough) || last.iter().all(is_smooth))) {
            return Ok(None);
        }
        let Some(statics) = statics::of(assembly) else { return Ok(None) };
        let compatibility = Compatibility::new(assembly, &statics, budget)?;
        Ok(compatibility.map(|compatibility| ForceMethod { assembly, statics, compatibility }))
    }
}

impl Loaded<'_> {
    /// The state at a load factor, looked for from `near` on. None where it is not found, or where a whole interface slides in it.
    ///
    /// # Errors
    /// When stopped.
    pub fn state(
        &self,
        load_factor: f64,
        near: Option<&ChainState>,
        budget: &Budget,
    ) -> Result<Option<ChainState>, Stopped> {
        let (mut splits, mut open) = match near {
            Some(near) => (near.splits.clone(), near.open.clone()),
            None => (self.held(), Vec::new()),
        };
        for _ in 0..ROUNDS {
            budget.work(RENEWED * splits.len())?;
            let reduced = self.reduced(&splits);
            let Some(redundants) = self.find_openings(&reduced.gradient, load_factor, &mut open) else {
                return Ok(None);
            };
            let state = ChainState { load_factor, redundants, splits, open, reduced };
            let next = self.renewed(&state);
            if next == state.splits {
                return Ok((!self.slides(&state)).then_some(state));
            }
            (splits, open) = (next, state.open);
        }
        Ok(None)
    }
}

#[cfg(test)]
mod tests;
