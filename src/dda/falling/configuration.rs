//! What a step leads to.

use super::body::Position;
use super::interface::Opening;
use crate::geometry::Vec2;

/// A force between two members.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Carried {
    /// Numbers of the members.
    pub between: [usize; 2],
    /// Their interface, or the nearest of several; none where they had none.
    pub interface: Option<usize>,
    /// Where, m.
    pub at: Vec2,
    /// Unit normal, into the second member.
    pub direction: Vec2,
    /// Normal force, N/m.
    pub normal: f64,
    /// Tangential force on the second member, positive to the left of the normal, N/m.
    pub tangential: f64,
    /// Gap, m.
    pub gap: f64,
}

/// The bodies after a step.
#[derive(Debug, Clone, PartialEq)]
pub struct Configuration {
    /// Sum of all steps of the time-like parameter, s2.
    pub parameter: f64,
    /// Every body's place.
    pub places: Vec<Position>,
    /// How the sides of every interface lie to each other.
    pub openings: Vec<Opening>,
    /// Contacts that touch, with the forces that they carried in the step.
    pub carried: Vec<Carried>,
    /// Largest displacement of a corner since the start, m.
    pub displacement: f64,
    /// Largest overlap of bodies, m.
    pub overlap: f64,
    /// Work of the loads in the step, N.
    pub work: f64,
    /// Largest residual of equilibrium of any body, as a share of the loads.
    pub residual: f64,
    /// By how much friction is beyond its bound at most, as a share of the loads.
    pub excess: f64,
}

/// What a step led to.
#[derive(Debug, Clone, PartialEq)]
pub enum Advance {
    /// The bodies have moved.
    Moved(Box<Configuration>),
    /// Nothing moves: the bodies are in equilibrium where they are, under these forces.
    Rest(Box<Configuration>),
}

/// No step was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("no quasi-static step was found that keeps rigid bodies out of each other")]
pub struct Stuck;
