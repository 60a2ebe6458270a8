//! Every job there is, and who is next: plain bookkeeping, to be used under the store's lock.

use super::job::{Job, JobId, Moment, Progress, State};
use super::store::Limits;
use crate::collapse::Question;
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

/// Why a job was not accepted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    /// As many jobs wait as may.
    #[error("the queue is full: {0} jobs are waiting")]
    QueueFull(usize),
    /// The store is shutting down.
    #[error("the service is shutting down")]
    Closed,
}

/// A job taken from the queue.
pub(super) struct Task {
    pub(super) id: JobId,
    pub(super) question: Question,
    pub(super) progress: Arc<Progress>,
}

/// The books. Ids sort by time, so the map does too.
pub(super) struct Table<T> {
    jobs: BTreeMap<JobId, Job<T>>,
    waiting: VecDeque<Task>,
    /// Ids in the order in which they reached a final state; may name jobs forgotten since.
    finished: VecDeque<JobId>,
    /// Tasks in the hands of workers, dismissed ones included.
    running: Vec<JobId>,
    open: bool,
}

impl<T> Table<T> {
    pub(super) fn new() -> Self {
        Table {
            jobs: BTreeMap::new(),
            waiting: VecDeque::new(),
            finished: VecDeque::new(),
            running: Vec::new(),
            open: true,
        }
    }

    pub(super) fn accept(&mut self, job: Job<T>, question: Question, limits: &Limits) -> Result<(), Refusal> {
        if !self.open {
            return Err(Refusal::Closed);
        }
        if self.waiting.len() >= limits.queue {
            return Err(Refusal::QueueFull(self.waiting.len()));
        }
        self.waiting.push_back(Task { id: job.id, question, progress: job.progress.clone() });
        self.jobs.insert(job.id, job);
        Ok(())
    }

    /// Hands out the job that has waited longest.
    pub(super) fn take(&mut self) -> Option<Task> {
        let task = self.waiting.pop_front()?;
        self.running.push(task.id);
        if let Some(job) = self.jobs.get_mut(&task.id) {
            job.state = State::Running;
            job.started = Some(Moment::now());
        }
        Some(task)
    }

    /// A worker is done with `id`. Returns what had to be forgotten to keep within `kept`.
    pub(super) fn give_back(&mut self, id: JobId, state: State, kept: usize) -> Vec<Job<T>> {
        self.running.retain(|&other| other != id);
        self.end(id, state, kept)
    }

    /// Ends a job that has not ended yet; returns what had to be forgotten to keep within `kept`.
    pub(super) fn end(&mut self, id: JobId, state: State, kept: usize) -> Vec<Job<T>> {
        match self.jobs.get_mut(&id) {
            Some(job) if job.finished.is_none() => {
                job.state = state;
                job.finished = Some(Moment::now());
            }
            _ => return Vec::new(),
        }
        self.finished.push_back(id);
        let surplus = self.finished.len().saturating_sub(kept);
        self.finished.drain(..surplus).filter_map(|old| self.jobs.remove(&old)).collect()
    }

    /// Cancels a job that has not ended; its worker, if any, is told to stop.
    pub(super) fn cancel(&mut self, id: JobId, kept: usize) -> Vec<Job<T>> {
        self.waiting.retain(|task| task.id != id);
        if let Some(job) = self.jobs.get(&id) {
            job.progress.cancel();
        }
        self.end(id, State::Dismissed, kept)
    }

    /// Drops a finished job from the books.
    pub(super) fn forget(&mut self, id: JobId) -> Option<Job<T>> {
        self.finished.retain(|&other| other != id);
        self.jobs.remove(&id)
    }

    /// Ids of all jobs that have not ended.
    pub(super) fn active(&self) -> Vec<JobId> {
        self.waiting.iter().map(|task| task.id).chain(self.running.iter().copied()).collect()
    }

    pub(super) fn close(&mut self) {
        self.open = false;
    }

    pub(super) fn is_open(&self) -> bool {
        self.open
    }

    pub(super) fn has_work(&self) -> bool {
        !self.waiting.is_empty()
    }

    pub(super) fn is_idle(&self) -> bool {
        self.waiting.is_empty() && self.running.is_empty()
    }
}

impl<T: Clone> Table<T> {
    pub(super) fn get(&self, id: JobId) -> Option<Job<T>> {
        self.jobs.get(&id).cloned()
    }

    /// At most `limit` jobs, newest first.
    pub(super) fn newest(&self, limit: usize) -> Vec<Job<T>> {
        self.jobs.values().rev().take(limit).cloned().collect()
    }
}
