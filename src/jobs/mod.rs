//! Who runs when: an in-memory store of jobs, a bounded queue, and the threads that work it off.
//!
//! A job is one [`Question`](crate::collapse::Question) on its way to an answer. Whatever the caller wants to find
//! again beside the answer (the request as it was posted, say) travels with the job as its *attachment*.
//! Nothing here knows of HTTP or JSON. Clocks live here and not below, so the same question gives the same answer.

mod job;
mod store;
mod table;
mod worker;

pub use job::{Failure, Job, JobId, Moment, Progress, State, Status};
pub use store::{Analyse, Dismissal, JobStore, Limits};
pub use table::Refusal;

use std::sync::{Mutex, MutexGuard, PoisonError};

/// Locks, whatever happened to the last holder: no code of ours can leave the data half written.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
