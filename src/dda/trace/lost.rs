//! Why a path could not be followed.

use super::Tracer;

/// Why a path could not be followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Lost {
    /// No step, however short, leads back to equilibrium: it is out by this share of the loads.
    OutOfBalance(f64),
    /// A contact is beyond its law, and no change of state leads back within it.
    AgainstLaw(Violation),
    /// So many changes of contact state without any movement.
    Ties(usize),
    /// So many changes of contact state, or steps, without an end.
    Endless(usize),
}

/// A contact whose force is not that of the law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Violation {
    /// Which contact.
    pub contact: usize,
    /// How far it is beyond a border of its state, a gap being worth what it would press with, as a share of the load scale.
    pub beyond: f64,
}

impl Tracer<'_> {
    /// Why the path was lost, where it was.
    pub fn lost(&self) -> Option<Lost> {
        self.lost
    }

    /// Why no step leads on from a point that was gone back to.
    pub(super) fn why_stuck(&self, residual: f64) -> Lost {
        self.stuck.map_or(Lost::OutOfBalance(residual), Lost::AgainstLaw)
    }
}
