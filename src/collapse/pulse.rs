//! The watch on an analysis, as everything in it sees it.

use super::{AnalysisError, LoadStep, Watch};
use crate::dda::Heart;
use std::cell::{Cell, RefCell};
use std::ops::ControlFlow;

/// Tells the watch of every step, and of the same step again at every heartbeat until the next.
pub(super) struct Pulse<'w> {
    last: &'w Cell<LoadStep>,
    /// Events of the paths before this one, and of this one so far.
    events: Cell<[usize; 2]>,
    /// Beats in long work between steps.
    pub heart: Heart<'w>,
}

/// Runs something under a watch. Where that has asked to stop there is no answer, whatever was computed.
///
/// # Errors
/// When stopped, and those of `run`.
pub(super) fn watched<T>(
    watch: &mut dyn Watch,
    run: impl FnOnce(&Pulse) -> Result<T, AnalysisError>,
) -> Result<T, AnalysisError> {
    let (watch, last) = (RefCell::new(watch), Cell::new(LoadStep { load_factor: 0.0, events: 0 }));
    let ask = || watch.borrow_mut().on_step(&last.get()).map_break(|_| ());
    let pulse = Pulse { last: &last, events: Cell::default(), heart: Heart::new(&ask) };
    let result = run(&pulse);
    pulse.check()?;
    result
}

impl Pulse<'_> {
    /// A step of a path, with its events so far; breaks where the watch asks to stop. A path with fewer events than were told
    /// last is another one, so that the watch sees those of all paths together.
    pub(super) fn step(&self, load_factor: f64, events: usize) -> ControlFlow<()> {
        if self.heart.check().is_ok() {
            let [before, latest] = self.events.get();
            let before = if events < latest { before + latest } else { before };
            self.events.set([before, events]);
            self.last.set(LoadStep { load_factor, events: before + events });
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
