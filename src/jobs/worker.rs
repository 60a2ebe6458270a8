//! A worker: takes a job, runs it, writes down how it ended, and takes the next.

use super::job::{Failure, Job, JobState};
use super::lock;
use super::progress::Observer;
use super::store::Shared;
use crate::budget::{Budget, LoadStep, Stopped};
use crate::collapse::AnalysisError;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::PoisonError;

/// The life of a worker thread.
pub(super) fn work<W>(shared: &Shared<W>) {
    while let Some((job, work)) = next(shared) {
        let span = tracing::info_span!("job", job.id = %job.id);
        let _entered = span.enter();
        tracing::info!("started");
        let state = attempt(shared, &job, work);
        match &state {
            JobState::Failed(Failure::Analysis(error @ AnalysisError::Stopped(_))) => tracing::info!("{error}"),
            JobState::Failed(failure) => tracing::warn!(%failure, "failed"),
            _ => tracing::info!("ended"),
        }
        if let Some(job) = shared.books(|table| table.give_back(job.id, state)) {
            (shared.ended)(&job);
        }
        shared.back.notify_all();
    }
}

/// Waits for a job; none once the store is closed and the queue empty.
fn next<W>(shared: &Shared<W>) -> Option<(Job, W)> {
    let table = lock(&shared.table);
    let mut table = shared
        .work
        .wait_while(table, |table| table.is_open() && !table.has_work())
        .unwrap_or_else(PoisonError::into_inner);
    table.take()
}

/// Answers one request; whatever happens in it, there is a final state.
fn attempt<W>(shared: &Shared<W>, job: &Job, work: W) -> JobState {
    let limit = shared.limits.time;
    let observer = Observer::new(&job.progress, limit);
    let see = |step| observer.see(step);
    // The answer is built from the request alone and is lost with a panic, so nothing half-built is seen.
    match catch_unwind(AssertUnwindSafe(|| (shared.analyse)(work, &Budget::new(&see)))) {
        Ok(Ok(product)) => JobState::Successful(product),
        Ok(Err(Failure::Analysis(AnalysisError::Stopped(Stopped(LoadStep { load_factor, events })))))
            if observer.overdue() =>
        {
            JobState::Failed(Failure::Overdue { limit, load_factor, events })
        }
        Ok(Err(failure)) => JobState::Failed(failure),
        Err(_) => JobState::Failed(Failure::Defect),
    }
}
