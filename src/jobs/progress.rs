//! How far an analysis has come, seen from outside, and how it is told to stop.

use super::job::Failure;
use super::resident::Place;
use crate::budget::{LoadStep, Stopped};
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

/// Time between two looks at the memory of the process.
const LOOK: Duration = Duration::from_millis(20);

/// What a worker's analysis tells its steps to.
pub(super) struct Observer<'a> {
    progress: &'a Progress,
    limit: Duration,
    begun: Instant,
    place: Place<'a>,
    /// When the memory of the process was looked at last.
    looked: Cell<Instant>,
    /// Why the analysis was stopped, where its client did not ask for it.
    reason: Cell<Option<Reason>>,
}

/// Why an analysis was stopped.
#[derive(Clone, Copy)]
enum Reason {
    Overdue,
    /// For the process took more than so many bytes.
    Outgrown(usize),
}

impl<'a> Observer<'a> {
    /// Watches an analysis that may take so long, at its place among those that run.
    pub(super) fn new(progress: &'a Progress, limit: Duration, place: Place<'a>) -> Self {
        let begun = Instant::now();
        Observer { progress, limit, begun, place, looked: Cell::new(begun), reason: Cell::new(None) }
    }

    /// Notes a step; says whether to go on.
    pub(super) fn see(&self, step: LoadStep) -> ControlFlow<()> {
        if step.load_factor.is_finite() {
            self.progress.load_factor.store(step.load_factor.to_bits(), Ordering::Relaxed);
        }
        self.progress.percent.store(step.percent.unwrap_or(f64::NAN).to_bits(), Ordering::Relaxed);
        self.progress.events.store(step.events.saturating_add(1), Ordering::Release);
        self.reason.set(self.reason_to_stop());
        match self.reason.get().is_some() || self.progress.stop.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }

    fn reason_to_stop(&self) -> Option<Reason> {
        let now = Instant::now();
        if now - self.begun > self.limit {
            return Some(Reason::Overdue);
        }
        if now - self.looked.get() < LOOK {
            return None;
        }
        self.looked.set(now);
        self.place.outgrown().map(Reason::Outgrown)
    }

    /// Why it was stopped, where its client did not ask for it. Asked for when all that the analysis had is dropped.
    pub(super) fn failure(&self, Stopped(LoadStep { load_factor, events, .. }): Stopped) -> Option<Failure> {
        Some(match self.reason.get()? {
            Reason::Overdue => Failure::Overdue { limit: self.limit, load_factor, events },
            Reason::Outgrown(limit) => {
                self.place.settle();
                Failure::Outgrown { limit, load_factor, events }
            }
        })
    }
}
