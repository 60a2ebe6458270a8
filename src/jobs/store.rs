//! The store: accepts, shows, cancels and forgets jobs, and stops in order.

use super::job::{Job, JobId};
use super::table::{Refusal, Table};
use super::{lock, worker};
use crate::collapse::{AnalysisError, Answer, Question, Watch};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// What the workers do with a question; [`collapse::answer`](crate::collapse::answer) outside tests.
pub type Analyse = dyn Fn(&Question, &mut dyn Watch) -> Result<Answer, AnalysisError> + Send + Sync;

/// How long a cancelled analysis may take to notice before its thread is given up.
const LAST_STEP: Duration = Duration::from_secs(2);

/// How much the store takes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Worker threads, at least 1.
    pub workers: usize,
    /// Jobs that may wait, at least 1.
    pub queue: usize,
    /// Finished jobs that are kept; beyond it the one that finished first is forgotten.
    pub kept: usize,
}

/// What [`JobStore::dismiss`] did.
#[derive(Debug, Clone)]
pub enum Dismissal<T> {
    /// The job had not ended: it is cancelled now.
    Cancelled(Job<T>),
    /// The job had ended: it is forgotten now.
    Forgotten,
}

/// What store and workers share.
pub(super) struct Shared<T> {
    pub(super) analyse: Box<Analyse>,
    pub(super) limits: Limits,
    pub(super) table: Mutex<Table<T>>,
    /// There is work, or there will never be again.
    pub(super) work: Condvar,
    /// A worker has come back.
    pub(super) back: Condvar,
}

/// All jobs and the threads that run them. `T` is what a caller attaches to a job.
pub struct JobStore<T> {
    shared: Arc<Shared<T>>,
    workers: Mutex<Vec<JoinHandle<()>>>,
    /// How the shutdown ended, once it has.
    ended: Mutex<Option<bool>>,
}

impl<T: Clone + Send + Sync + 'static> JobStore<T> {
    /// Starts the workers.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn start<A>(limits: Limits, analyse: A) -> std::io::Result<Self>
    where
        A: Fn(&Question, &mut dyn Watch) -> Result<Answer, AnalysisError> + Send + Sync + 'static,
    {
        let limits = Limits { workers: limits.workers.max(1), queue: limits.queue.max(1), ..limits };
        let shared = Arc::new(Shared {
            analyse: Box::new(analyse),
            limits,
            table: Mutex::new(Table::new()),
            work: Condvar::new(),
            back: Condvar::new(),
        });
        let store = JobStore { shared, workers: Mutex::default(), ended: Mutex::default() };
        for number in 0..limits.workers {
            let shared = store.shared.clone();
            let name = format!("voussoir-worker-{number}");
            let handle = thread::Builder::new().name(name).spawn(move || worker::work(&shared))?;
            lock(&store.workers).push(handle);
        }
        Ok(store)
    }

    /// Puts a question at the end of the queue.
    ///
    /// # Errors
    /// When the queue is full or the store is shutting down; nothing is accepted then.
    pub fn submit(&self, question: Question, attachment: T) -> Result<Job<T>, Refusal> {
        let mut table = lock(&self.shared.table);
        // Named under the lock, so that the order of ids is the order of the queue.
        let job = Job::accepted(JobId::now_v7(), attachment);
        table.accept(job.clone(), question, &self.shared.limits)?;
        drop(table);
        self.shared.work.notify_one();
        Ok(job)
    }

    /// The job as it stands.
    pub fn get(&self, id: JobId) -> Option<Job<T>> {
        lock(&self.shared.table).get(id)
    }

    /// At most `limit` jobs, newest first.
    pub fn newest(&self, limit: usize) -> Vec<Job<T>> {
        lock(&self.shared.table).newest(limit)
    }

    /// Cancels a job that has not ended, forgets one that has. None when there is no such job.
    pub fn dismiss(&self, id: JobId) -> Option<Dismissal<T>> {
        let kept = self.shared.limits.kept;
        let mut table = lock(&self.shared.table);
        let job = table.get(id)?;
        if job.finished.is_some() {
            let forgotten = table.forget(id);
            drop(table);
            drop(forgotten);
            return Some(Dismissal::Forgotten);
        }
        let surplus = table.cancel(id, kept);
        let ended = table.get(id).or_else(|| surplus.iter().find(|old| old.id == id).cloned());
        drop(table);
        ended.map(Dismissal::Cancelled)
    }
}

impl<T> JobStore<T> {
    /// Accepts nothing more. What was accepted still runs.
    pub fn close(&self) {
        lock(&self.shared.table).close();
        self.shared.work.notify_all();
    }

    /// Accepts nothing more, lets accepted jobs end within `grace`, cancels the rest and ends the workers.
    /// A second call waits for nothing more and says the same.
    /// False when an analysis would not stop and its thread had to be left behind.
    pub fn shutdown(&self, grace: Duration) -> bool {
        let mut ended = lock(&self.ended);
        if let Some(idle) = *ended {
            return idle;
        }
        self.close();
        if !self.wait_until_idle(grace) {
            let mut table = lock(&self.shared.table);
            for id in table.active() {
                // Nothing is forgotten here: the books are about to close anyway.
                table.cancel(id, usize::MAX);
            }
            drop(table);
            self.shared.work.notify_all();
        }
        let idle = self.wait_until_idle(LAST_STEP);
        if idle {
            for worker in lock(&self.workers).drain(..) {
                // A worker cannot panic: the analysis is the only foreign code and its panics are caught.
                let _ = worker.join();
            }
        }
        *ended = Some(idle);
        idle
    }

    fn wait_until_idle(&self, patience: Duration) -> bool {
        let table = lock(&self.shared.table);
        let (table, _) = self
            .shared
            .back
            .wait_timeout_while(table, patience, |table| !table.is_idle())
            .unwrap_or_else(PoisonError::into_inner);
        table.is_idle()
    }
}

impl<T> Drop for JobStore<T> {
    fn drop(&mut self) {
        self.shutdown(Duration::ZERO);
    }
}
