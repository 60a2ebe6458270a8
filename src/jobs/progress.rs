//! How far a job has come, and the wish to stop it: what its worker and everyone else share.

use super::job::{JobState, Stand};
use crate::budget::LoadStep;
use std::cell::Cell;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use tokio::sync::watch;

/// Written by the job's worker, read by anyone.
#[derive(Debug)]
pub struct Progress {
    load_factor: AtomicU64,
    events: AtomicUsize,
    stop: AtomicBool,
    stand: watch::Sender<Stand>,
}

impl Default for Progress {
    fn default() -> Self {
        let stand = watch::Sender::new(Stand { state: JobState::Accepted, started: None, finished: None });
        Progress {
            load_factor: AtomicU64::default(),
            events: AtomicUsize::default(),
            stop: AtomicBool::default(),
            stand,
        }
    }
}

impl Progress {
    /// The last step seen; none before the first.
    pub fn step(&self) -> Option<LoadStep> {
        let events = self.events.load(Ordering::Acquire);
        let load_factor = f64::from_bits(self.load_factor.load(Ordering::Relaxed));
        // Stored one too high, so that zero means "not yet".
        events.checked_sub(1).map(|events| LoadStep { load_factor, events })
    }

    /// How the job stands, and whatever becomes of it.
    pub fn stand(&self) -> watch::Receiver<Stand> {
        self.stand.subscribe()
    }

    /// Returns when the job has reached a final state.
    pub async fn ended(&self) {
        // The sender lives as long as `self`, so there is always an answer.
        let _ = self.stand().wait_for(|stand| stand.state.status().is_final()).await;
    }

    /// Asks the analysis to stop at its next step.
    pub(super) fn cancel(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// Lets those who wait know where the job stands.
    pub(super) fn tell(&self, stand: Stand) {
        self.stand.send_replace(stand);
    }
}

/// The worker's eye on one analysis.
pub(super) struct Observer<'a> {
    progress: &'a Progress,
    due: Option<Instant>,
    overdue: Cell<bool>,
}

impl<'a> Observer<'a> {
    /// Sees an analysis that begins now and may take so long.
    pub(super) fn new(progress: &'a Progress, limit: Duration) -> Self {
        Observer { progress, due: Instant::now().checked_add(limit), overdue: Cell::new(false) }
    }

    /// Notes a step; breaks where the job is cancelled, or its time is over.
    pub(super) fn see(&self, step: LoadStep) -> ControlFlow<()> {
        // Shown to whoever asks, who can do nothing with one that is no number.
        if step.load_factor.is_finite() {
            self.progress.load_factor.store(step.load_factor.to_bits(), Ordering::Relaxed);
        }
        self.progress.events.store(step.events.saturating_add(1), Ordering::Release);
        self.overdue.set(self.due.is_some_and(|due| Instant::now() > due));
        match self.overdue.get() || self.progress.stop.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }

    /// True once the analysis has been told to stop because its time was over.
    pub(super) fn overdue(&self) -> bool {
        self.overdue.get()
    }
}
