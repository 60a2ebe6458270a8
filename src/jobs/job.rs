//! A job, from its submission to its end.

use crate::budget::LoadStep;
use crate::collapse::AnalysisError;
use bytes::Bytes;
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use std::time::{Duration, SystemTime};

/// A job's name, of version 7, and so later ones are larger.
pub type JobId = uuid::Uuid;

/// Where a job stands, in the words of OGC API - Processes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = StatusWord)]
pub enum Status {
    /// It waits for a worker.
    Accepted,
    /// A worker has it.
    Running,
    /// It has a result.
    Successful,
    /// It has none, and says why.
    Failed,
    /// A client cancelled it.
    Dismissed,
}

impl Status {
    /// Every status there is.
    pub const ALL: [Status; 5] =
        [Status::Accepted, Status::Running, Status::Successful, Status::Failed, Status::Dismissed];

    /// The same word as in JSON.
    pub fn word(self) -> &'static str {
        match self {
            Status::Accepted => "accepted",
            Status::Running => "running",
            Status::Successful => "successful",
            Status::Failed => "failed",
            Status::Dismissed => "dismissed",
        }
    }

    /// True when it will not change any more.
    pub fn is_final(self) -> bool {
        self > Status::Running
    }
}

/// Where a job stands, with what belongs to it.
#[derive(Debug, Clone, PartialEq)]
pub enum JobState {
    /// It waits for a worker.
    Accepted,
    /// A worker has it.
    Running,
    /// It has a result, kept in parts.
    Successful,
    /// It has none, and says why.
    Failed(Failure),
    /// A client cancelled it.
    Dismissed,
}

impl JobState {
    /// The same without what belongs to it.
    pub fn status(&self) -> Status {
        match self {
            JobState::Accepted => Status::Accepted,
            JobState::Running => Status::Running,
            JobState::Successful => Status::Successful,
            JobState::Failed(_) => Status::Failed,
            JobState::Dismissed => Status::Dismissed,
        }
    }
}

/// A part of an answer in one format.
#[derive(Debug, Clone, PartialEq)]
pub struct Rendering {
    /// What the part is called, one name or more.
    pub names: Vec<String>,
    /// Its format, as the query names it.
    pub format: &'static str,
    /// What is kept of it.
    pub part: Part,
}

/// A part as it is kept.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Its bytes, or why the answer has none.
    pub body: Result<Bytes, String>,
    /// How many bytes the part has, where those kept are packed (gzip).
    pub packed_from: Option<usize>,
}

impl Rendering {
    /// True when it is the part of this name in this format.
    pub fn is(&self, name: &str, format: &str) -> bool {
        self.format == format && self.names.iter().any(|other| other == name)
    }
}

/// An answer in all its parts and formats.
pub type Product = Arc<[Rendering]>;

/// Why an analysis has no result.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, thiserror::Error)]
pub enum Failure {
    /// The mechanics says no.
    #[error("{0}")]
    Analysis(String),
    /// It took longer than a job may.
    #[error(
        "the analysis took longer than the {} s it may, and was stopped at load factor {load_factor} after {events} \
         events; a coarser mesh, fewer voussoirs or fewer abscissae take less", limit.as_secs_f64()
    )]
    Overdue {
        /// How long a job may take.
        limit: Duration,
        /// Load factor it had reached.
        load_factor: f64,
        /// Contact events it had seen.
        events: usize,
    },
    /// So many workers were lost while they were at it.
    #[error(
        "the analysis was given up: {workers} processes ended while they were at it, perhaps for the memory it takes; a coarser \
         mesh, fewer voussoirs or fewer abscissae take less"
    )]
    Lost {
        /// How many.
        workers: u16,
    },
    /// The process came to take more memory than it may, and this was the largest of its analyses.
    #[error(
        "the service came to take more than the {} MiB of memory it may, and the largest of the analyses that ran, this one, was \
         stopped at load factor {load_factor} after {events} events; a coarser mesh, fewer stones or fewer stress fields take less",
        limit >> 20
    )]
    Outgrown {
        /// Memory that the process may take, bytes.
        limit: usize,
        /// Load factor it had reached.
        load_factor: f64,
        /// Contact events it had seen.
        events: usize,
    },
    /// The analysis panicked.
    #[error("the analysis ended in an internal error; it is a defect of the program, not of the request")]
    Defect,
}

impl From<AnalysisError> for Failure {
    fn from(error: AnalysisError) -> Self {
        Failure::Analysis(error.to_string())
    }
}

/// One submitted request and what became of it.
#[derive(Debug, Clone)]
pub struct Job {
    /// Names it.
    pub id: JobId,
    /// What its request calls itself.
    pub name: Option<Arc<str>>,
    /// Who submitted it.
    pub client: Arc<str>,
    /// When it was accepted.
    pub created: SystemTime,
    /// When a worker took it.
    pub started: Option<SystemTime>,
    /// When it ended.
    pub finished: Option<SystemTime>,
    /// How long the worker was at it, once it has ended.
    pub wall_time: Option<Duration>,
    /// How far the analysis has come; none before its first step.
    pub progress: Option<LoadStep>,
    /// Where it stands.
    pub state: JobState,
    /// Its turn among those that wait, 1 for the next; none unless it waits.
    pub position: Option<usize>,
}

impl Job {
    /// A job that waits.
    pub(super) fn accepted(id: JobId, name: Option<String>, client: Arc<str>) -> Self {
        Job {
            id,
            name: name.map(Into::into),
            client,
            created: SystemTime::now(),
            started: None,
            finished: None,
            wall_time: None,
            progress: None,
            state: JobState::Accepted,
            position: None,
        }
    }

    /// The state without what belongs to it.
    pub fn status(&self) -> Status {
        self.state.status()
    }
}
