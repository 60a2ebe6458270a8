//! The store: accepts, shows, cancels and forgets jobs, and stops in order.

use super::job::{Failure, Job, JobId, Product, Status};
use super::table::{Occupancy, Refusal, Submission, Table};
use super::{Limits, lock, worker};
use crate::budget::Budget;
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// What the workers do.
pub type Analyse<W> = dyn Fn(W, &Budget) -> Result<Product, Failure> + Send + Sync;

/// Sees every job that has ended, once.
pub type Ended = dyn Fn(&Job) + Send + Sync;

/// How long a cancelled analysis may take to notice before its thread is given up.
const LAST_STEP: Duration = Duration::from_secs(2);

/// What [`JobStore::dismiss`] did.
#[derive(Debug, Clone)]
pub enum Dismissal {
    /// The job had not ended: it is cancelled now.
    Cancelled(Box<Job>),
    /// The job had ended: it is forgotten now.
    Forgotten,
}

/// What store and workers share.
pub(super) struct Shared<W> {
    pub(super) analyse: Box<Analyse<W>>,
    pub(super) ended: Box<Ended>,
    pub(super) limits: Limits,
    pub(super) table: Mutex<Table<W>>,
    /// There is work, or there will never be again.
    pub(super) work: Condvar,
    /// A worker has come back.
    pub(super) back: Condvar,
}

impl<W> Shared<W> {
    /// Works on the books; what that takes off them is dropped when others may have them again.
    pub(super) fn books<V>(&self, work: impl FnOnce(&mut Table<W>) -> V) -> V {
        let mut table = lock(&self.table);
        table.tidy();
        let value = work(&mut table);
        let forgotten = table.forgotten();
        drop(table);
        drop(forgotten);
        value
    }
}

/// All jobs and the threads that run them. `W` is what a worker is handed.
pub struct JobStore<W> {
    shared: Arc<Shared<W>>,
    workers: Mutex<Vec<JoinHandle<()>>>,
    /// How the shutdown ended, once it has.
    over: Mutex<Option<bool>>,
}

impl<W: Send + 'static> JobStore<W> {
    /// Starts the workers, which `analyse`; `ended` is told of every job that has ended.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn start(
        limits: Limits,
        analyse: impl Fn(W, &Budget) -> Result<Product, Failure> + Send + Sync + 'static,
        ended: impl Fn(&Job) + Send + Sync + 'static,
    ) -> std::io::Result<Self> {
        let shared = Arc::new(Shared {
            analyse: Box::new(analyse),
            ended: Box::new(ended),
            limits,
            table: Mutex::new(Table::new(limits)),
            work: Condvar::new(),
            back: Condvar::new(),
        });
        let store = JobStore { shared, workers: Mutex::default(), over: Mutex::default() };
        for number in 0..limits.workers.max(1) {
            let shared = store.shared.clone();
            let name = format!("voussoir-worker-{number}");
            let handle = thread::Builder::new().name(name).spawn(move || worker::work(&shared))?;
            lock(&store.workers).push(handle);
        }
        Ok(store)
    }

    /// Puts a request at the end of the queue. One whose key is known and asks the same gives the job it named.
    ///
    /// # Errors
    /// When the queue or the memory is full, the key names another request, or the store is shutting down; nothing is
    /// accepted then.
    pub fn submit(&self, submission: Submission<W>) -> Result<Job, Refusal> {
        let job = self.shared.books(|table| table.accept(submission))?;
        self.shared.work.notify_one();
        Ok(job)
    }
}

impl<W> JobStore<W> {
    /// The job as it stands.
    pub fn get(&self, id: JobId) -> Option<Job> {
        self.shared.books(|table| table.get(id))
    }

    /// At most `limit` jobs, newest first; of one `status` only, and submitted before the job `before` only, if asked.
    pub fn list(&self, status: Option<Status>, before: Option<JobId>, limit: usize) -> Vec<Job> {
        self.shared.books(|table| table.list(status, before, limit))
    }

    /// What the store holds just now.
    pub fn load(&self) -> Occupancy {
        self.shared.books(|table| table.load())
    }

    /// False once the store accepts nothing more.
    pub fn is_open(&self) -> bool {
        self.shared.books(|table| table.is_open())
    }

    /// Cancels a job that has not ended, forgets one that has. None when there is no such job.
    pub fn dismiss(&self, id: JobId) -> Option<Dismissal> {
        let dismissal = self.shared.books(|table| {
            table.get(id)?;
            Some(match table.cancel(id) {
                Some(job) => Dismissal::Cancelled(Box::new(job)),
                None => {
                    table.forget(id);
                    Dismissal::Forgotten
                }
            })
        })?;
        if let Dismissal::Cancelled(job) = &dismissal {
            (self.shared.ended)(job);
        }
        Some(dismissal)
    }

    /// Accepts nothing more. What was accepted still runs.
    pub fn close(&self) {
        self.shared.books(|table| table.close());
        self.shared.work.notify_all();
    }

    /// Accepts nothing more, lets accepted jobs end within `grace`, cancels the rest and ends the workers.
    /// A second call waits for nothing more and says the same.
    /// False when an analysis would not stop and its thread had to be left behind.
    pub fn shutdown(&self, grace: Duration) -> bool {
        let mut over = lock(&self.over);
        if let Some(idle) = *over {
            return idle;
        }
        self.close();
        if !self.wait_until_idle(grace) {
            self.cancel_all();
        }
        let idle = self.wait_until_idle(LAST_STEP);
        if idle {
            for worker in lock(&self.workers).drain(..) {
                // A worker cannot panic: the analysis is the only foreign code and its panics are caught.
                let _ = worker.join();
            }
        }
        *over = Some(idle);
        idle
    }

    /// Cancels every job that has not ended.
    pub fn cancel_all(&self) {
        for id in self.shared.books(|table| table.active()) {
            if let Some(job) = self.shared.books(|table| table.cancel(id)) {
                (self.shared.ended)(&job);
            }
        }
        self.shared.work.notify_all();
        self.shared.back.notify_all();
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

impl<W> Drop for JobStore<W> {
    fn drop(&mut self) {
        self.shutdown(Duration::ZERO);
    }
}
