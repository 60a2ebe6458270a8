//! What a step leads to.

use super::block::Place;
use super::contact::Meeting;
use crate::geometry::Vec2;

/// A force between two blocks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Carried {
    /// Which interface.
    pub interface: usize,
    /// Where, m.
    pub at: Vec2,
    /// Unit normal, into the block after.
    pub direction: Vec2,
    /// Normal force, N/m.
    pub normal: f64,
    /// Tangential force on the block after, positive to the left of the normal, N/m.
    pub tangential: f64,
    /// Gap, m.
    pub gap: f64,
}

/// The chain after a step.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Sum of all steps of the time-like parameter, s2.
    pub parameter: f64,
    /// Every block's place.
    pub places: Vec<Place>,
    /// How blocks lie at every interface; none where there is nothing after the last block.
    pub meetings: Vec<Option<Meeting>>,
    /// How far the block after every interface has slid towards the outer end, m.
    pub slid: Vec<f64>,
    /// Contacts that touch, with the forces that they carried in the step.
    pub carried: Vec<Carried>,
    /// Largest displacement of a corner since the start, m.
    pub displacement: f64,
    /// Largest overlap of neighbours, m.
    pub overlap: f64,
    /// Work of the loads in the step, N.
    pub work: f64,
    /// Largest residual of equilibrium of any block, as a share of the loads.
    pub residual: f64,
    /// By how much friction is beyond its bound at most, as a share of the loads.
    pub excess: f64,
}

/// What a step led to.
#[derive(Debug, Clone, PartialEq)]
pub enum Advance {
    /// The blocks have moved.
    Moved(Box<Frame>),
    /// Nothing moves: the blocks are in equilibrium.
    Rest,
    /// Going on, these two, no neighbours, would enter each other (none: the ground).
    Meet([Option<usize>; 2]),
}

/// No step was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("no quasi-static step was found that keeps rigid blocks out of each other")]
pub struct Stuck;
