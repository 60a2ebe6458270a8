//! The watch on an analysis, as everything in it sees it.

use super::{AnalysisError, LoadStep, Watch};
use crate::dda::Heart;
use std::cell::Cell;
use std::cell::RefCell;
use std::ops::ControlFlow;

/// Tells the watch of every step, and of the same step again at every heartbeat until the next.
pub(super) struct Pulse<'w> {
    last: &'w Cell<LoadStep>,
    /// Beats in long work between steps.
    pub heart: Heart<'w>,
}

/// Runs something under a watch.
pub(super) fn watched<T>(watch: &mut dyn Watch, run: impl FnOnce(&Pulse) -> T) -> T {
    let (watch, last) = (RefCell::new(watch), Cell::new(LoadStep { load_factor: 0.0, events: 0 }));
    let ask = || watch.borrow_mut().on_step(&last.get()).map_break(|_| ());
    run(&Pulse { last: &last, heart: Heart::new(&ask) })
}

impl Pulse<'_> {
    /// A step of a path; breaks where the watch asks to stop.
    pub(super) fn step(&self, load_factor: f64, events: usize) -> ControlFlow<()> {
        if self.heart.check().is_ok() {
            self.last.set(LoadStep { load_factor, events });
        }
        self.beat()
    }

    /// A heartbeat as the callback that other rooms ask.
    pub(super) fn beat(&self) -> ControlFlow<()> {
        if self.heart.beat().is_err() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// Notes so much work, in multiplications or so; beats when it has come to some milliseconds.
    pub(super) fn work(&self, done: usize) -> Result<(), AnalysisError> {
        self.heart.work(done).map_err(|_| self.stopped())
    }

    /// A heartbeat between two pieces of work.
    pub(super) fn go_on(&self) -> Result<(), AnalysisError> {
        self.heart.beat().map_err(|_| self.stopped())
    }

    /// An error where the watch has asked to stop, so that what was computed last is no answer.
    pub(super) fn check(&self) -> Result<(), AnalysisError> {
        self.heart.check().map_err(|_| self.stopped())
    }

    /// Stopped at the last step.
    pub(super) fn stopped(&self) -> AnalysisError {
        let LoadStep { load_factor, events } = self.last.get();
        AnalysisError::Stopped { load_factor, events }
    }
}
