//! The store in memory: nothing to install, and gone with the process.

use super::job::{Job, JobId, Part, Status};
use super::journal::Journal;
use super::store::{Cancelled, Ending, Lease, Occupancy, Refusal, Store, Submission, Unavailable, Which};
use super::table::Table;
use bytes::Bytes;
use std::io;
use std::path::Path;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;
use tokio::sync::Notify;
use tokio::time::timeout;

/// Answers that are promised may keep workers waiting; so often it is looked whether they still are.
const LOOK: Duration = Duration::from_millis(250);

/// How much the store takes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Jobs that may wait.
    pub queue: usize,
    /// Jobs of one client that may wait.
    pub queue_per_client: usize,
    /// Jobs that have ended and are kept; beyond it some are forgotten.
    pub kept: usize,
    /// How long a job that has ended is kept at most.
    pub kept_for: Duration,
    /// How long it is kept at least, unless its answer is read before.
    pub promised: Duration,
    /// How long a key lives at least.
    pub keys_for: Duration,
    /// What requests, answers and keys of all may take, bytes; beyond it jobs that have ended are forgotten, those of whoever has
    /// most first. Where all are promised, nothing is accepted or taken. An answer that comes on top may take more.
    pub bytes: usize,
    /// What those of one client may take.
    pub bytes_per_client: usize,
    /// What all analyses that run may take together, bytes; one that takes more runs alone.
    pub work_memory: usize,
}

#[cfg(test)]
impl Limits {
    /// Room for all that a test does.
    pub(crate) fn ample() -> Self {
        let (many, long) = (1 << 30, Duration::from_secs(1000));
        Limits {
            queue: many,
            queue_per_client: many,
            kept: many,
            kept_for: long,
            promised: long,
            keys_for: long,
            bytes: many,
            bytes_per_client: many,
            work_memory: many,
        }
    }
}

/// Jobs in memory.
pub struct Memory {
    table: Mutex<Table>,
    /// Rung when there may be something to take. It wakes one worker; whoever takes a job wakes the next if there are more.
    work: Notify,
}

impl Memory {
    /// An empty store.
    pub fn new(limits: Limits) -> Self {
        Memory { table: Mutex::new(Table::new(limits)), work: Notify::new() }
    }

    /// A store that notes in a file what it owes to whom, and begins with what that file says is owed.
    ///
    /// # Errors
    /// When the file cannot be read or written, or is no such file.
    pub fn with_journal(limits: Limits, path: &Path) -> io::Result<Self> {
        let (journal, owed) = Journal::open(path)?;
        let mut table = Table::new(limits);
        for (id, submission) in owed {
            table.enter(id, submission);
        }
        table.keep_journal(journal);
        Ok(Memory { table: Mutex::new(table), work: Notify::new() })
    }

    /// Does something with the books. What has been forgotten is dropped when others may use them again: it may be large.
    fn books<V>(&self, work: impl FnOnce(&mut Table) -> V) -> V {
        // No code of ours can leave the data half written.
        let mut table = self.table.lock().unwrap_or_else(PoisonError::into_inner);
        table.tidy();
        let value = work(&mut table);
        let removed = table.removed();
        drop(table);
        if !removed.is_empty() {
            self.work.notify_one();
        }
        value
    }
}

#[async_trait::async_trait]
impl Store for Memory {
    async fn submit(&self, submission: Submission) -> Result<Job, Refusal> {
        let job = self.books(|table| table.accept(submission))?;
        self.work.notify_one();
        Ok(job)
    }

    async fn job(&self, id: JobId) -> Result<Option<Job>, Unavailable> {
        Ok(self.books(|table| table.get(id)))
    }

    async fn list(&self, which: Which) -> Result<Vec<Job>, Unavailable> {
        Ok(self.books(|table| table.list(&which)))
    }

    async fn request(&self, id: JobId) -> Result<Option<Bytes>, Unavailable> {
        Ok(self.books(|table| table.request(id)))
    }

    async fn part(&self, id: JobId, name: &str, format: &str) -> Result<Option<Part>, Unavailable> {
        let product = self.books(|table| {
            table.seen(id);
            table.product(id)
        });
        Ok(product.and_then(|product| product.iter().find(|one| one.is(name, format)).map(|one| one.part.clone())))
    }

    async fn seen(&self, id: JobId) -> Result<(), Unavailable> {
        self.books(|table| table.seen(id));
        Ok(())
    }

    async fn wait(&self, id: JobId, known: Status) -> Result<Option<Job>, Unavailable> {
        let Some(mut job) = self.books(|table| table.watch(id)) else { return Ok(None) };
        // One that is forgotten meanwhile has ended, and the last that was heard of it says how.
        let _ = job.wait_for(|job| job.status() != known).await;
        let job = job.borrow().clone();
        Ok(Some(job).filter(|job| job.status() != known))
    }

    async fn cancel(&self, id: JobId) -> Result<Option<Cancelled>, Unavailable> {
        Ok(self.books(|table| table.cancel(id)))
    }

    async fn forget(&self, id: JobId) -> Result<bool, Unavailable> {
        Ok(self.books(|table| table.forget(id)))
    }

    async fn take(&self) -> Result<Option<Lease>, Unavailable> {
        loop {
            let rung = self.work.notified();
            let (lease, waiting, open) = self.books(|table| (table.take(), table.waiting(), table.is_open()));
            match (&lease, waiting) {
                (None, 0) if !open => return Ok(None),
                // The last one: those who wait for another go home.
                (Some(_), 0) if !open => self.work.notify_waiters(),
                (Some(_), 1..) => self.work.notify_one(),
                _ => {}
            }
            if lease.is_some() {
                return Ok(lease);
            }
            let _ = timeout(LOOK, rung).await;
        }
    }

    async fn end(&self, lease: &Lease, ending: Ending) -> Result<Option<Job>, Unavailable> {
        // What it took may be what others wait for: its worker takes the first of them next, and wakes more.
        Ok(self.books(|table| table.end(lease.id, ending)))
    }

    async fn occupancy(&self) -> Result<Occupancy, Unavailable> {
        Ok(self.books(|table| table.occupancy()))
    }

    fn close(&self) {
        self.books(Table::close);
        self.work.notify_waiters();
    }

    fn is_open(&self) -> bool {
        self.books(|table| table.is_open())
    }

    fn outlives_the_process(&self) -> bool {
        false
    }

    async fn abandon(&self) -> Vec<Job> {
        let ids = self.books(|table| {
            // No client has dismissed them.
            table.close_journal();
            table.active()
        });
        let cancel = |id| match self.books(|table| table.cancel(id)) {
            Some(Cancelled::Now(job)) => Some(job),
            _ => None,
        };
        let dismissed = ids.into_iter().filter_map(cancel).collect();
        self.work.notify_waiters();
        dismissed
    }
}
