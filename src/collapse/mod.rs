//! Incremental limit analysis: what grows, how far, and what happens then.

mod certificate;
mod digits;
mod discretise;
mod ending;
mod mechanism;
mod motion;
mod path;
mod record;
pub mod report;
mod smallest_motion;
mod verdict;

pub use digits::Digits;
pub use report::*;

use crate::arch::{Arch, PointForce, Stone};
use std::ops::ControlFlow;

/// Which way the load factor goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// From 0 upwards.
    Increase,
    /// From 0 downwards.
    Decrease,
}

/// Plane stress or plane strain inside the stones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlaneModel {
    /// sigma_z = 0.
    Stress,
    /// eps_z = 0.
    Strain,
}

/// How the load path is read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// Followed exactly from event to event to the peak of the path.
    EventPath,
    /// As in section 4.2 of the paper, for comparison only: the path is looked at every `step` of load factor, and
    /// collapse is the first step at which `hinges` joints have opened by more than `opening`.
    FixedSteps {
        /// Step of the load factor.
        step: f64,
        /// Critical opening of a joint's corner, m.
        opening: f64,
        /// How many joints must have opened.
        hinges: usize,
    },
}

/// One question to the mechanics, in SI units and radians.
#[derive(Debug, Clone, PartialEq)]
pub struct Analysis {
    /// The arch.
    pub arch: Arch,
    /// Its stone.
    pub stone: Stone,
    /// Plane stress or plane strain.
    pub plane: PlaneModel,
    /// Contact penalty as a multiple of Young's modulus (per metre of depth and contact point).
    pub penalty_ratio: f64,
    /// Loads that stay.
    pub fixed: Vec<PointForce>,
    /// Loads that the load factor multiplies.
    pub scaled: Vec<PointForce>,
    /// Which way the load factor goes.
    pub direction: Direction,
    /// Largest absolute load factor to try; by default the one at which the scaled loads are 1e6 times the fixed ones.
    pub cap: Option<f64>,
    /// How the path is read.
    pub method: Method,
    /// At which share of the way to collapse displacements and contact forces are reported, in (0, 1).
    pub share: f64,
}

/// Where an analysis stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadStep {
    /// Load factor now.
    pub load_factor: f64,
    /// Contact events so far.
    pub events: usize,
}

/// Asked to stop by the watcher.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stop;

/// Sees an analysis go by and may stop it.
pub trait Watch {
    /// Called at every event.
    fn on_step(&mut self, step: &LoadStep) -> ControlFlow<Stop>;
}

/// Watches nothing.
pub struct Unwatched;

impl Watch for Unwatched {
    fn on_step(&mut self, _: &LoadStep) -> ControlFlow<Stop> {
        ControlFlow::Continue(())
    }
}

/// Why there is no report.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum AnalysisError {
    /// The watcher asked to stop.
    #[error("stopped at load factor {load_factor} after {events} events")]
    Stopped {
        /// Load factor reached.
        load_factor: f64,
        /// Events so far.
        events: usize,
    },
    /// The fixed step is so small that the path cannot be walked in it.
    #[error("the load path has more than {most} of the fixed steps asked for; take a larger step")]
    TooManySteps {
        /// Most steps of one path.
        most: usize,
    },
    /// A number in the report is not finite.
    #[error("the analysis produced a number that is not finite ({what}); check the units of the request")]
    NotFinite {
        /// Which quantity.
        what: &'static str,
    },
}

/// Runs the analysis: limit window, then the load path from where it says the arch stands, then the comparison.
///
/// # Errors
/// When stopped by `watch`, or when a result is not finite.
pub fn run(analysis: &Analysis, watch: &mut dyn Watch) -> Result<CollapseReport, AnalysisError> {
    verdict::run(analysis, watch)
}
