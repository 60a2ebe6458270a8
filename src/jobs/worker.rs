//! A worker: takes a job, runs it, writes down how it ended, and takes the next.

use super::job::{Failure, Observer, Progress, State};
use super::lock;
use super::store::{Analyse, Shared};
use super::table::Task;
use crate::collapse::{AnalysisError, Question};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, PoisonError};

/// The life of a worker thread.
pub(super) fn work<T>(shared: &Shared<T>) {
    while let Some(task) = next(shared) {
        let span = tracing::info_span!("job", job.id = %task.id);
        let _entered = span.enter();
        tracing::info!("started");
        let state = attempt(&*shared.analyse, &task.question, &task.progress);
        match &state {
            State::Failed(Failure::Analysis(error @ AnalysisError::Stopped { .. })) => tracing::info!("{error}"),
            State::Failed(failure) => tracing::warn!(%failure, "failed"),
            _ => tracing::info!("ended"),
        }
        let forgotten = lock(&shared.table).give_back(task.id, state, shared.limits.kept);
        shared.back.notify_all();
        drop(forgotten);
    }
}

/// Waits for a task; none once the store is closed and the queue empty.
fn next<T>(shared: &Shared<T>) -> Option<Task> {
    let table = lock(&shared.table);
    let mut table = shared
        .work
        .wait_while(table, |table| table.is_open() && !table.has_work())
        .unwrap_or_else(PoisonError::into_inner);
    table.take()
}

/// Answers one question; whatever happens in it, there is a final state.
fn attempt(analyse: &Analyse, question: &Question, progress: &Arc<Progress>) -> State {
    // The answer is built from `question` alone and is lost with a panic, so nothing half-built is seen.
    match catch_unwind(AssertUnwindSafe(|| analyse(question, &mut Observer(progress)))) {
        Ok(Ok(answer)) => State::Successful(Arc::new(answer)),
        Ok(Err(error)) => State::Failed(Failure::Analysis(error)),
        Err(_) => State::Failed(Failure::Panicked),
    }
}
