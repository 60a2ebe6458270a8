//! Who runs when: an in-memory store of jobs, a bounded queue, and the threads that work it off.
//!
//! A job is work on its way to the bytes of an answer. Nothing here knows of HTTP, what the work is made of, or what the
//! bytes say. Clocks live here and not below, so the same request gives the same answer.

mod job;
mod progress;
mod store;
mod table;
mod worker;

pub use job::{Failure, Job, JobId, JobState, Moment, Product, Rendering, Stand, Status};
pub use progress::Progress;
pub use store::{Analyse, Dismissal, Ended, JobStore};
pub use table::{Occupancy, Refusal, Submission};

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// How much the store takes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Worker threads, at least 1.
    pub workers: usize,
    /// Jobs that may wait.
    pub queue: usize,
    /// Jobs of one client that may wait.
    pub queue_per_client: usize,
    /// Finished jobs that are kept; beyond it the one that ended first is forgotten.
    pub kept: usize,
    /// How long a finished job is kept.
    pub kept_for: Duration,
    /// What requests and answers of all jobs may take, bytes: beyond it finished ones are forgotten, the one that ended first before
    /// others, and where those that have not ended take more, nothing is accepted.
    pub bytes: usize,
    /// How long a worker may be at one job.
    pub time: Duration,
}

/// Locks, whatever happened to the last holder: no code of ours can leave the data half written.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
