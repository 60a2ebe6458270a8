//! How far an analysis has come, seen from outside, and how it is told to stop.

use crate::budget::LoadStep;
use std::cell::Cell;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// How far the analysis of a job has come. Written by its worker at every step, read by whoever asks.
#[derive(Debug, Default)]
pub struct Progress {
    load_factor: AtomicU64,
    /// NaN where nobody can tell.
    percent: AtomicU64,
    /// One more than the contact events so far, 0 before the first step.
    events: AtomicUsize,
    stop: AtomicBool,
}

impl Progress {
    /// The last step; none before the first.
    pub fn step(&self) -> Option<LoadStep> {
        let events = self.events.load(Ordering::Acquire);
        let [load_factor, percent] =
            [&self.load_factor, &self.percent].map(|bits| f64::from_bits(bits.load(Ordering::Relaxed)));
        let percent = Some(percent).filter(|percent| percent.is_finite());
        events.checked_sub(1).map(|events| LoadStep { load_factor, events, percent })
    }

    /// Asks the analysis to stop at its next step.
    pub(super) fn cancel(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }
}

/// What a worker's analysis tells its steps to.
pub(super) struct Observer<'a> {
    progress: &'a Progress,
    due: Option<Instant>,
    overdue: Cell<bool>,
}

impl<'a> Observer<'a> {
    /// Watches an analysis that may take so long.
    pub(super) fn new(progress: &'a Progress, limit: Duration) -> Self {
        Observer { progress, due: Instant::now().checked_add(limit), overdue: Cell::new(false) }
    }

    /// Notes a step; says whether to go on.
    pub(super) fn see(&self, step: LoadStep) -> ControlFlow<()> {
        if step.load_factor.is_finite() {
            self.progress.load_factor.store(step.load_factor.to_bits(), Ordering::Relaxed);
        }
        self.progress.percent.store(step.percent.unwrap_or(f64::NAN).to_bits(), Ordering::Relaxed);
        self.progress.events.store(step.events.saturating_add(1), Ordering::Release);
        self.overdue.set(self.due.is_some_and(|due| Instant::now() > due));
        match self.overdue.get() || self.progress.stop.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }

    /// True when it was stopped for the time it took.
    pub(super) fn overdue(&self) -> bool {
        self.overdue.get()
    }
}
