//! Every job there is, and who is next: plain bookkeeping, to be used under the store's lock.

use super::Limits;
use super::job::{Job, JobId, JobState, Moment, Status};
use bytes::Bytes;
use std::collections::{BTreeMap, VecDeque};
use std::mem;

/// A request on its way into the store.
#[derive(Debug, Clone)]
pub struct Submission<W> {
    /// What a worker is handed.
    pub work: W,
    /// What is asked, as it is given out; two that are the same ask the same.
    pub request: Bytes,
    /// What the request calls itself.
    pub name: Option<String>,
    /// Who asks.
    pub client: String,
    /// A name the client gave this submission, so that sending it twice does no harm.
    pub key: Option<String>,
}

/// Why a request was not accepted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    /// As many jobs wait as may.
    #[error("the queue is full: {0} jobs are waiting")]
    QueueFull(usize),
    /// As many jobs of this client wait as may.
    #[error("{0} jobs of this client are waiting, as many as one client may have there")]
    ClientQueueFull(usize),
    /// The jobs that have not ended fill the memory.
    #[error("the jobs that have not ended hold {0} bytes, and with this one more than they may")]
    MemoryFull(usize),
    /// The key names another request.
    #[error("job {0} was submitted with the same key and another request")]
    KeyTaken(JobId),
    /// The store is shutting down.
    #[error("the service is shutting down")]
    Closed,
}

/// What the store holds just now.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Occupancy {
    /// Jobs that wait.
    pub waiting: usize,
    /// Jobs in the hands of workers, dismissed ones included until their worker is free.
    pub running: usize,
    /// Jobs that have ended and are kept.
    pub finished: usize,
    /// What their requests and answers take, bytes.
    pub bytes: usize,
}

/// One job and what only the books know of it.
#[derive(Debug)]
struct Entry<W> {
    job: Job,
    /// Until a worker takes it, or the job ends.
    work: Option<W>,
    bytes: usize,
    client: String,
    key: Option<String>,
}

/// The books. Ids sort by time of submission, and so do the map and the queue.
#[derive(Debug)]
pub(super) struct Table<W> {
    limits: Limits,
    jobs: BTreeMap<JobId, Entry<W>>,
    waiting: VecDeque<JobId>,
    /// How many jobs of each client wait.
    clients: BTreeMap<String, usize>,
    /// Jobs by the key they were submitted with.
    keys: BTreeMap<String, JobId>,
    /// In the order in which they reached a final state.
    finished: VecDeque<JobId>,
    /// In the hands of workers, dismissed ones included.
    running: Vec<JobId>,
    /// What all jobs take, and those that have not ended.
    bytes: usize,
    active_bytes: usize,
    /// Taken off the books, to be dropped outside the lock.
    forgotten: Vec<Job>,
    open: bool,
}

impl<W> Table<W> {
    pub(super) fn new(limits: Limits) -> Self {
        Table {
            limits,
            jobs: BTreeMap::new(),
            waiting: VecDeque::new(),
            clients: BTreeMap::new(),
            keys: BTreeMap::new(),
            finished: VecDeque::new(),
            running: Vec::new(),
            bytes: 0,
            active_bytes: 0,
            forgotten: Vec::new(),
            open: true,
        }
    }

    /// Hands out the job that has waited longest.
    pub(super) fn take(&mut self) -> Option<(Job, W)> {
        let id = self.waiting.pop_front()?;
        let entry = self.jobs.get_mut(&id)?;
        left(&mut self.clients, &entry.client);
        let work = entry.work.take()?;
        entry.job.turn(JobState::Running);
        self.running.push(id);
        Some((entry.job.clone(), work))
    }

    /// A worker is done with `id`: the job as it has ended, unless it had before.
    pub(super) fn give_back(&mut self, id: JobId, state: JobState) -> Option<Job> {
        self.running.retain(|&other| other != id);
        self.end(id, state)
    }

    /// Cancels a job that has not ended and returns it; its worker, if any, is told to stop.
    pub(super) fn cancel(&mut self, id: JobId) -> Option<Job> {
        if let Ok(place) = self.waiting.binary_search(&id) {
            self.waiting.remove(place);
            left(&mut self.clients, &self.jobs.get(&id)?.client);
        }
        self.jobs.get(&id)?.job.progress.cancel();
        self.end(id, JobState::Dismissed)
    }

    /// Ends a job that has not ended yet and returns it.
    fn end(&mut self, id: JobId, state: JobState) -> Option<Job> {
        let bytes = state.bytes();
        let entry = self.jobs.get_mut(&id).filter(|entry| !entry.job.status().is_final())?;
        entry.job.turn(state);
        entry.work = None;
        self.active_bytes -= entry.bytes;
        entry.bytes += bytes;
        self.bytes += bytes;
        let job = entry.job.clone();
        self.finished.push_back(id);
        self.tidy();
        Some(job)
    }

    /// Forgets finished jobs, oldest first, until what is left is within the limits. The one that ended last stays
    /// whatever it costs, or nobody could ever read it.
    pub(super) fn tidy(&mut self) {
        let (Limits { kept, kept_for, bytes, .. }, now) = (self.limits, Moment::now());
        while let Some(&oldest) = self.finished.front() {
            let ended = self.jobs.get(&oldest).and_then(|entry| entry.job.finished);
            let old = ended.is_none_or(|ended| now.since(&ended) > kept_for);
            let surplus = self.finished.len() > kept || (self.bytes > bytes && self.finished.len() > 1);
            if !old && !surplus {
                break;
            }
            self.finished.pop_front();
            self.remove(oldest);
        }
    }

    /// Drops a finished job from the books.
    pub(super) fn forget(&mut self, id: JobId) {
        self.finished.retain(|&other| other != id);
        self.remove(id);
    }

    fn remove(&mut self, id: JobId) {
        let Some(entry) = self.jobs.remove(&id) else { return };
        self.bytes -= entry.bytes;
        if let Some(key) = &entry.key {
            self.keys.remove(key);
        }
        self.forgotten.push(entry.job);
    }

    /// What has been taken off the books since the last call.
    pub(super) fn forgotten(&mut self) -> Vec<Job> {
        mem::take(&mut self.forgotten)
    }

    pub(super) fn get(&self, id: JobId) -> Option<Job> {
        self.jobs.get(&id).map(|entry| self.seen(entry))
    }

    /// At most `limit` jobs, newest first, of one status if asked, submitted before `before` if asked.
    pub(super) fn list(&self, status: Option<Status>, before: Option<JobId>, limit: usize) -> Vec<Job> {
        let end = before.unwrap_or(JobId::max());
        let wanted = |entry: &&Entry<W>| status.is_none_or(|status| entry.job.status() == status);
        let entries = self.jobs.range(..end).rev().map(|(_, entry)| entry);
        entries.filter(wanted).take(limit).map(|entry| self.seen(entry)).collect()
    }

    /// The job with its place in the queue.
    fn seen(&self, entry: &Entry<W>) -> Job {
        let waits = entry.job.status() == Status::Accepted;
        let place = if waits { self.waiting.binary_search(&entry.job.id).ok() } else { None };
        Job { position: place.map(|place| place + 1), ..entry.job.clone() }
    }

    /// Ids of all jobs that have not ended.
    pub(super) fn active(&self) -> Vec<JobId> {
        self.waiting.iter().chain(&self.running).copied().collect()
    }

    pub(super) fn load(&self) -> Occupancy {
        let (waiting, running) = (self.waiting.len(), self.running.len());
        Occupancy { waiting, running, finished: self.finished.len(), bytes: self.bytes }
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

    /// Puts a request at the end of the queue; the job that already has its key and asks the same is left as it is.
    pub(super) fn accept(&mut self, submission: Submission<W>) -> Result<Job, Refusal> {
        if let Some(&id) = submission.key.as_ref().and_then(|key| self.keys.get(key)) {
            let known = self.get(id).filter(|job| job.request == submission.request);
            return known.ok_or(Refusal::KeyTaken(id));
        }
        self.check(&submission)?;
        let Submission { work, request, name, client, key } = submission;
        let bytes = request.len();
        // Named under the lock, so that the order of ids is the order of the queue.
        let id = JobId::now_v7();
        *self.clients.entry(client.clone()).or_default() += 1;
        self.keys.extend(key.clone().map(|key| (key, id)));
        self.waiting.push_back(id);
        self.bytes += bytes;
        self.active_bytes += bytes;
        let entry = Entry { job: Job::accepted(id, name, request), work: Some(work), bytes, client, key };
        let job = entry.job.clone();
        self.jobs.insert(id, entry);
        self.tidy();
        Ok(Job { position: Some(self.waiting.len()), ..job })
    }

    fn check(&self, submission: &Submission<W>) -> Result<(), Refusal> {
        let of_client = self.clients.get(&submission.client).copied().unwrap_or(0);
        let (waiting, limits) = (self.waiting.len(), &self.limits);
        if !self.open {
            Err(Refusal::Closed)
        } else if waiting >= limits.queue {
            Err(Refusal::QueueFull(waiting))
        } else if self.active_bytes.saturating_add(submission.request.len()) > limits.bytes {
            Err(Refusal::MemoryFull(self.active_bytes))
        } else if of_client >= limits.queue_per_client {
            Err(Refusal::ClientQueueFull(of_client))
        } else {
            Ok(())
        }
    }
}

/// One job of this client waits no more.
fn left(clients: &mut BTreeMap<String, usize>, client: &str) {
    if let Some(count) = clients.get_mut(client) {
        *count -= 1;
        if *count == 0 {
            clients.remove(client);
        }
    }
}
