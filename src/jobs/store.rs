//! What every store of jobs does.

use super::job::{Job, JobId, JobState, Part, Product, Status};
use super::progress::Progress;
use bytes::Bytes;
use std::sync::Arc;
use std::time::Duration;

/// What a client submits.
#[derive(Debug, Clone)]
pub struct Submission {
    /// The request, as it is given out and as a worker reads it.
    pub request: Bytes,
    /// What the request calls itself.
    pub name: Option<String>,
    /// Who submits it.
    pub client: Arc<str>,
    /// What its analysis takes at most, as it was estimated, bytes.
    pub memory: usize,
    /// Names this submission: sent again with the same request it gives the same job, as long as the key lives.
    pub key: Option<String>,
}

/// Why a submission is not accepted.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    /// As many jobs wait as may.
    #[error("the queue is full: {0} jobs are waiting")]
    QueueFull(usize),
    /// As many jobs of this client wait as may.
    #[error("{0} jobs of this client are waiting, as many as one client may have there")]
    ClientQueueFull(usize),
    /// What has to be kept takes as many bytes as all jobs may.
    #[error("{0} bytes are kept for jobs that have not ended or whose answers were not read yet; read or forget some")]
    MemoryFull(usize),
    /// What has to be kept of this client takes as many bytes as one client may.
    #[error(
        "{0} bytes are kept for jobs of this client that have not ended or whose answers it has not read yet; read or forget some"
    )]
    ClientMemoryFull(usize),
    /// The key names another request.
    #[error("job {0} was submitted with the same key and another request")]
    KeyTaken(JobId),
    /// The key names a job that is forgotten; to run it again would break what the key promises.
    #[error(
        "job {0} was submitted with the same key, and has been forgotten; submit with another key to have it run again"
    )]
    KeySpent(JobId),
    /// The service is ending.
    #[error("the service is shutting down")]
    Closed,
    /// Nobody knows.
    #[error(transparent)]
    Unavailable(#[from] Unavailable),
}

/// The store cannot be reached: what was asked may have happened or not.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the store of jobs cannot be reached: {0}")]
pub struct Unavailable(pub String);

/// Which jobs are listed.
#[derive(Debug, Clone, Default)]
pub struct Which {
    /// Those of this client only.
    pub client: Option<Arc<str>>,
    /// Those of this status only.
    pub status: Option<Status>,
    /// Those submitted before this one only.
    pub before: Option<JobId>,
    /// At most so many.
    pub limit: usize,
}

/// What became of a wish to cancel.
#[derive(Debug, Clone)]
pub enum Cancelled {
    /// The job had not ended, and is dismissed now.
    Now(Job),
    /// It had ended before, so.
    Before(Job),
}

/// A job in the hands of a worker.
pub struct Lease {
    /// Which job.
    pub id: JobId,
    /// Its request.
    pub request: Bytes,
    /// What its analysis takes at most, as it was estimated, bytes.
    pub memory: usize,
    /// What the analysis tells of itself, and where it is told to stop.
    pub progress: Arc<Progress>,
}

/// How an analysis has ended.
#[derive(Debug, Clone)]
pub struct Ending {
    /// Successful or failed.
    pub state: JobState,
    /// The answer of one that was successful.
    pub product: Product,
    /// How long the worker was at it.
    pub wall_time: Duration,
}

/// How full a store is.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Occupancy {
    /// Jobs that wait.
    pub waiting: usize,
    /// Jobs in the hands of workers.
    pub running: usize,
    /// Jobs that have ended and are kept.
    pub finished: usize,
    /// Of those, the ones that are promised to be kept still: not read, and ended a short while ago.
    pub unread: usize,
    /// What requests, answers and keys take, bytes.
    pub bytes: usize,
    /// Finished jobs that had to make room for others so far.
    pub evicted: u64,
    /// Seconds a worker is at a job, mean of late.
    pub seconds: f64,
}

/// Holds jobs: queue, records, requests and answers.
///
/// A job that was accepted is never lost before it has ended. Its answer is kept for a minimum time or until it was read.
#[async_trait::async_trait]
pub trait Store: Send + Sync {
    /// Accepts a job, or gives the one that its key names.
    async fn submit(&self, submission: Submission) -> Result<Job, Refusal>;

    /// A job as it stands.
    async fn job(&self, id: JobId) -> Result<Option<Job>, Unavailable>;

    /// Jobs as they stand, newest first.
    async fn list(&self, which: Which) -> Result<Vec<Job>, Unavailable>;

    /// A job's request.
    async fn request(&self, id: JobId) -> Result<Option<Bytes>, Unavailable>;

    /// A part of a successful job's answer. The job counts as read.
    async fn part(&self, id: JobId, name: &str, format: &str) -> Result<Option<Part>, Unavailable>;

    /// Notes that a client has learnt how a job ended that has no answer to read.
    async fn seen(&self, id: JobId) -> Result<(), Unavailable>;

    /// Waits until a job's status is another than `known`; none where it is forgotten and nobody can tell any more.
    async fn wait(&self, id: JobId, known: Status) -> Result<Option<Job>, Unavailable>;

    /// Dismisses a job that has not ended; its analysis stops at its next step. None where there is no such job.
    async fn cancel(&self, id: JobId) -> Result<Option<Cancelled>, Unavailable>;

    /// Forgets a job that has ended; false where there is none.
    async fn forget(&self, id: JobId) -> Result<bool, Unavailable>;

    /// Waits for the next job; none once the store is closed and, where the store ends with this process, nothing waits.
    async fn take(&self) -> Result<Option<Lease>, Unavailable>;

    /// Writes down how a job has ended. None where it had ended before, or is not this worker's any more.
    async fn end(&self, lease: &Lease, ending: Ending) -> Result<Option<Job>, Unavailable>;

    /// How full it is.
    async fn occupancy(&self) -> Result<Occupancy, Unavailable>;

    /// Accepts no more jobs from here on.
    fn close(&self);

    /// True until it is closed.
    fn is_open(&self) -> bool;

    /// True when jobs and answers are kept though this process ends.
    fn outlives_the_process(&self) -> bool;

    /// Stops what this process still has: a store that ends with it dismisses all that waits or runs, one that others share
    /// gives its running jobs back. Those dismissed are returned.
    async fn abandon(&self) -> Vec<Job>;
}
