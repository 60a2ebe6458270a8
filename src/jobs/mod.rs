//! Who runs when: a store of jobs, and the workers that take them from it.
//!
//! A job is the bytes of a request on their way to the bytes of an answer. Nothing here knows of HTTP, or what the bytes say.
//! Clocks live here and not below, so the same request gives the same answer.

mod accounts;
mod job;
mod journal;
mod keys;
mod memory;
#[cfg(feature = "postgres")]
mod postgres;
mod progress;
mod resident;
mod store;
mod table;
mod workers;

pub use job::{Failure, Job, JobId, JobState, Part, Product, Rendering, Status};
pub use memory::{Limits, Memory};
#[cfg(feature = "postgres")]
pub use postgres::Postgres;
pub use progress::Progress;
pub use resident::resident;
pub use store::{Cancelled, Ending, Lease, Occupancy, Refusal, Store, Submission, Unavailable, Which};
pub use workers::{Analyse, Ended, Work, Workers};
