//! One job and where it stands.

use super::progress::Progress;
use crate::collapse::AnalysisError;
use bytes::Bytes;
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use std::time::{Duration, Instant, SystemTime};

/// Names a job; version 7, so that ids sort by time of submission.
pub type JobId = uuid::Uuid;

/// Status words of OGC API - Processes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = StatusWord)]
pub enum Status {
    /// Waits in the queue.
    Accepted,
    /// Under way.
    Running,
    /// There are results.
    Successful,
    /// There are none; `problem` says why.
    Failed,
    /// Cancelled.
    Dismissed,
}

impl Status {
    /// All of them.
    pub const ALL: [Status; 5] =
        [Status::Accepted, Status::Running, Status::Successful, Status::Failed, Status::Dismissed];

    /// The word.
    pub fn word(self) -> &'static str {
        match self {
            Status::Accepted => "accepted",
            Status::Running => "running",
            Status::Successful => "successful",
            Status::Failed => "failed",
            Status::Dismissed => "dismissed",
        }
    }

    /// True for a state that a job never leaves.
    pub fn is_final(self) -> bool {
        self > Status::Running
    }
}

/// Where a job stands, with what belongs to it there.
#[derive(Debug, Clone, PartialEq)]
pub enum JobState {
    /// Waits in the queue.
    Accepted,
    /// A worker is at it.
    Running,
    /// Done.
    Successful(Product),
    /// Ended without an answer.
    Failed(Failure),
    /// Cancelled.
    Dismissed,
}

impl JobState {
    /// What an answer takes, bytes.
    pub(super) fn bytes(&self) -> usize {
        let JobState::Successful(product) = self else { return 0 };
        product.iter().map(|rendering| rendering.body.as_ref().map_or(0, Bytes::len)).sum()
    }

    /// In one word.
    pub fn status(&self) -> Status {
        match self {
            JobState::Accepted => Status::Accepted,
            JobState::Running => Status::Running,
            JobState::Successful(_) => Status::Successful,
            JobState::Failed(_) => Status::Failed,
            JobState::Dismissed => Status::Dismissed,
        }
    }
}

/// One part of an answer in one format, as it is given out.
#[derive(Debug, Clone, PartialEq)]
pub struct Rendering {
    /// What the part is called; it may go by several names.
    pub names: Vec<String>,
    /// The format's name.
    pub format: &'static str,
    /// The bytes, or why this answer has no such part.
    pub body: Result<Bytes, String>,
    /// How many bytes the part has, where those kept are packed (gzip).
    pub packed_from: Option<usize>,
}

/// What a worker makes of a request: the answer in every form in which it is given out. Copies share it.
pub type Product = Arc<[Rendering]>;

/// Why a job has no answer.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Failure {
    /// The mechanics said why.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// It took longer than a job may.
    #[error(
        "the analysis took longer than the {} s it may, and was stopped at load factor {load_factor} after {events} \
         events; a coarser mesh, fewer voussoirs or fewer abscissae take less", limit.as_secs_f64()
    )]
    Overdue {
        /// The time it may take.
        limit: Duration,
        /// Load factor reached.
        load_factor: f64,
        /// Events so far.
        events: usize,
    },
    /// A defect of the program: the analysis panicked, or its answer cannot be written down.
    #[error("the analysis ended in an internal error; it is a defect of the program, not of the request")]
    Defect,
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

/// How a job stands: what changes of it.
#[derive(Debug, Clone)]
pub struct Stand {
    /// Where it stands.
    pub state: JobState,
    /// When a worker took it.
    pub started: Option<Moment>,
    /// When it reached a final state.
    pub finished: Option<Moment>,
}

/// A job as it stood when the store was asked; cheap to copy.
#[derive(Debug, Clone)]
pub struct Job {
    /// Its name.
    pub id: JobId,
    /// What the request calls itself.
    pub name: Option<Arc<str>>,
    /// What is asked, as it is given out.
    pub request: Bytes,
    /// How far the analysis has come.
    pub progress: Arc<Progress>,
    /// When it was accepted.
    pub created: Moment,
    /// When a worker took it.
    pub started: Option<Moment>,
    /// When it reached a final state.
    pub finished: Option<Moment>,
    /// Where it stands.
    pub state: JobState,
    /// How many jobs go first, this one included, while it waits.
    pub position: Option<usize>,
}

impl Job {
    /// A job just accepted.
    pub(super) fn accepted(id: JobId, name: Option<String>, request: Bytes) -> Self {
        Job {
            id,
            name: name.map(Into::into),
            request,
            progress: Arc::default(),
            created: Moment::now(),
            started: None,
            finished: None,
            state: JobState::Accepted,
            position: None,
        }
    }

    /// Brings it to another state.
    pub(super) fn turn(&mut self, state: JobState) {
        self.state = state;
        let (now, status) = (Moment::now(), self.status());
        match status {
            Status::Running => self.started = Some(now),
            _ => self.finished = Some(now),
        }
        let Job { state, started, finished, .. } = &*self;
        self.progress.tell(Stand { state: state.clone(), started: *started, finished: *finished });
    }

    /// The job as it stands now, also where the store has forgotten it.
    pub fn now(&self) -> Self {
        let Stand { state, started, finished } = self.progress.stand().borrow().clone();
        Job { state, started, finished, position: None, ..self.clone() }
    }

    /// The state in one word.
    pub fn status(&self) -> Status {
        self.state.status()
    }

    /// Time a worker spent on it, once it has ended.
    pub fn wall_time(&self) -> Option<Duration> {
        Some(self.finished?.since(&self.started?))
    }
}
