//! The classic methods, each as its textbook has it, on one block of six unknowns per voussoir and two contacts per joint.

mod band;
mod interior_point;
mod march;
mod model;
mod newton;
mod open_close;

pub use model::{Elastic, Model};

use march::{Corrector, march};

/// What is asked: the load factor goes from `start`, where the arch is known to stand (a help that a user does not have),
/// in steps of `step` (signed) until `most`.
#[derive(Debug, Clone, Copy)]
pub struct Loading {
    pub start: f64,
    pub step: f64,
    pub most: f64,
}

/// What a method says.
#[derive(Debug, Clone, PartialEq)]
pub enum Found {
    /// Stands up to this load factor and no further.
    FallsAt(f64),
    /// Stands up to the most that was asked.
    Stands,
    /// The loads at the start cannot be borne.
    FallsAsBuilt,
    /// No convergence, and no sign of collapse either.
    GaveUp,
}

/// What a method is.
pub type Method = fn(&Model, Loading) -> Found;

/// The methods by name.
pub const METHODS: [(&str, Method); 3] = [
    ("open-close iteration", |model, loading| march(model, loading, open_close::correct)),
    ("Newton, line search", |model, loading| march(model, loading, newton::correct)),
    ("interior point", interior_point::bisect),
];

/// Whether the first two bear the loads at the start from the unstressed arch, without the interior point's help.
pub fn bear_alone(model: &Model, loading: Loading) -> [bool; 2] {
    [open_close::correct, newton::correct].map(|correct: Corrector| march::ramp(model, loading.start, correct).is_ok())
}
