//! One job and where it stands.

use crate::collapse::{AnalysisError, Answer, LoadStep, Stop, Watch};
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::time::{Duration, Instant, SystemTime};

/// Names a job; version 7, so that ids sort by time of submission.
pub type JobId = uuid::Uuid;

/// Status words of OGC API - Processes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// Waits in the queue.
    Accepted,
    /// A worker is at it.
    Running,
    /// There is an answer.
    Successful,
    /// There is none, and a reason.
    Failed,
    /// Cancelled.
    Dismissed,
}

/// Where a job stands, with what belongs to it there.
#[derive(Debug, Clone, PartialEq)]
pub enum State {
    /// Waits in the queue.
    Accepted,
    /// A worker is at it.
    Running,
    /// Done.
    Successful(Arc<Answer>),
    /// Ended without an answer.
    Failed(Failure),
    /// Cancelled.
    Dismissed,
}

/// Why a job has no answer.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Failure {
    /// The mechanics said why.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// A defect of the program: the analysis panicked.
    #[error("the analysis ended in an internal error; it is a defect of the program, not of the request")]
    Panicked,
}

/// A moment, as the wall clock shows it and as durations are measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Moment {
    /// Wall clock.
    pub wall: SystemTime,
    tick: Instant,
}

impl Moment {
    /// The present moment.
    pub fn now() -> Self {
        Moment { wall: SystemTime::now(), tick: Instant::now() }
    }

    /// Time passed from `earlier` to here.
    pub fn since(&self, earlier: &Moment) -> Duration {
        self.tick.saturating_duration_since(earlier.tick)
    }
}

/// How far a running analysis has come; written by its worker, read by anyone. Also carries the wish to stop.
#[derive(Debug, Default)]
pub struct Progress {
    load_factor: AtomicU64,
    events: AtomicUsize,
    stop: AtomicBool,
}

impl Progress {
    /// The last step seen; none before the first.
    pub fn step(&self) -> Option<LoadStep> {
        let events = self.events.load(Ordering::Acquire);
        let load_factor = f64::from_bits(self.load_factor.load(Ordering::Relaxed));
        // Stored one too high, so that zero means "not yet".
        events.checked_sub(1).map(|events| LoadStep { load_factor, events })
    }

    /// Asks the analysis to stop at its next step.
    pub(super) fn cancel(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }
}

/// The worker's eye on one analysis.
pub(super) struct Observer<'a>(pub(super) &'a Progress);

impl Watch for Observer<'_> {
    fn on_step(&mut self, step: &LoadStep) -> ControlFlow<Stop> {
        self.0.load_factor.store(step.load_factor.to_bits(), Ordering::Relaxed);
        self.0.events.store(step.events.saturating_add(1), Ordering::Release);
        if self.0.stop.load(Ordering::Relaxed) { ControlFlow::Break(Stop) } else { ControlFlow::Continue(()) }
    }
}

/// A job as it stood when the store was asked; cheap to copy.
#[derive(Debug, Clone)]
pub struct Job<T> {
    /// Its name.
    pub id: JobId,
    /// What the caller attached.
    pub attachment: Arc<T>,
    /// How far the analysis has come.
    pub progress: Arc<Progress>,
    /// When it was accepted.
    pub created: Moment,
    /// When a worker took it.
    pub started: Option<Moment>,
    /// When it reached a final state.
    pub finished: Option<Moment>,
    /// Where it stands.
    pub state: State,
}

impl<T> Job<T> {
    /// A job just accepted.
    pub(super) fn accepted(id: JobId, attachment: T) -> Self {
        Job {
            id,
            attachment: Arc::new(attachment),
            progress: Arc::default(),
            created: Moment::now(),
            started: None,
            finished: None,
            state: State::Accepted,
        }
    }

    /// The state in one word.
    pub fn status(&self) -> Status {
        match self.state {
            State::Accepted => Status::Accepted,
            State::Running => Status::Running,
            State::Successful(_) => Status::Successful,
            State::Failed(_) => Status::Failed,
            State::Dismissed => Status::Dismissed,
        }
    }

    /// Time a worker spent on it, once it has ended.
    pub fn wall_time(&self) -> Option<Duration> {
        Some(self.finished?.since(&self.started?))
    }
}
