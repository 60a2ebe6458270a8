//! The books of the store in memory: every job, what it takes, and who has to make room.

mod room;

use super::accounts::{Account, Accounts};
use super::job::{Job, JobId, JobState, Product, Status};
use super::journal::Journal;
use super::keys::{self, Keys};
use super::memory::Limits;
use super::progress::Progress;
use super::store::{Cancelled, Ending, Lease, Occupancy, Refusal, Submission, Unavailable, Which};
use bytes::Bytes;
use std::collections::BTreeMap;
use std::mem;
use std::sync::Arc;
use std::time::{Duration, Instant, SystemTime};
use tokio::sync::watch;

/// What a job takes beside its request and its answer, bytes: its record, its places in the books, the names of its parts.
pub(super) const RECORD: usize = 2048;

/// Share of the latest job in the mean of their times.
const LATEST: f64 = 0.05;

/// A job with all that belongs to it.
#[derive(Debug)]
struct Entry {
    /// The job; those who wait for it are told of every change.
    job: watch::Sender<Job>,
    request: Bytes,
    product: Product,
    progress: Arc<Progress>,
    /// What its analysis takes.
    memory: usize,
    bytes: usize,
    /// Its place in the order of ends, and when that was.
    ended: Option<(u64, Instant)>,
}

/// All jobs.
#[derive(Debug)]
pub(super) struct Table {
    limits: Limits,
    jobs: BTreeMap<JobId, Entry>,
    accounts: Accounts,
    keys: Keys,
    /// Jobs that have ended, by the order of their ends.
    finished: BTreeMap<u64, JobId>,
    /// Of these, the ones that nobody has read and that are promised to be kept still, with when each ended.
    promised: BTreeMap<u64, Instant>,
    /// How many have ended so far.
    ends: u64,
    waiting: usize,
    /// Jobs in the hands of workers, and what their analyses take.
    running: BTreeMap<JobId, usize>,
    bytes: usize,
    evicted: u64,
    seconds: f64,
    open: bool,
    journal: Option<Journal>,
    /// What was taken out of the books and is to be dropped where nobody waits for it.
    removed: Vec<(Bytes, Product)>,
}

impl Table {
    pub(super) fn new(limits: Limits) -> Self {
        Table {
            limits,
            jobs: BTreeMap::new(),
            accounts: Accounts::default(),
            keys: Keys::default(),
            finished: BTreeMap::new(),
            promised: BTreeMap::new(),
            ends: 0,
            waiting: 0,
            running: BTreeMap::new(),
            bytes: 0,
            evicted: 0,
            seconds: 0.0,
            open: true,
            journal: None,
            removed: Vec::new(),
        }
    }

    /// Accepts a job, or gives the one that was accepted under the same key.
    pub(super) fn accept(&mut self, submission: Submission) -> Result<Job, Refusal> {
        if let Some(known) = submission.key.as_ref().and_then(|key| self.keys.get(key)) {
            let (id, same) = (known.id, known.asked_for(&submission.request));
            return if same { self.get(id).ok_or(Refusal::KeySpent(id)) } else { Err(Refusal::KeyTaken(id)) };
        }
        self.admit(&submission, RECORD + submission.request.len() + keys::bytes(submission.key.as_deref()))?;
        let id = JobId::now_v7();
        if let Some(journal) = &mut self.journal {
            journal.accepted(id, &submission).map_err(|error| Unavailable(format!("the journal: {error}")))?;
        }
        self.enter(id, submission);
        self.get(id).ok_or(Refusal::Closed)
    }

    /// Enters a job into the books: it waits from here on.
    pub(super) fn enter(&mut self, id: JobId, submission: Submission) {
        let Submission { request, name, client, memory, key } = submission;
        let bytes = RECORD + request.len();
        if let Some(key) = key {
            self.keys.name(&key, id, client.clone(), &request);
            self.charge(&client, keys::bytes(Some(&key)));
        }
        self.accounts.queue(&client, id);
        self.waiting += 1;
        self.charge(&client, bytes);
        let job = watch::Sender::new(Job::accepted(id, name, client));
        let (product, progress) = (Product::default(), Arc::default());
        self.jobs.insert(id, Entry { job, request, product, progress, memory, bytes, ended: None });
    }

    /// From here on what is owed is noted.
    pub(super) fn keep_journal(&mut self, journal: Journal) {
        self.journal = Some(journal);
    }

    /// From here on nothing is noted: what is owed now is owed when the store is opened again, whatever becomes of it here.
    pub(super) fn close_journal(&mut self) {
        self.journal = None;
    }

    /// A job is owed no more: its end is known to its client, or it is forgotten.
    fn settle(&mut self, id: JobId) {
        if let Some(Err(error)) = self.journal.as_mut().map(|journal| journal.over(id)) {
            // It runs once more, if the store is opened again: a pity, and no loss.
            tracing::error!(%error, "the journal cannot be written");
        }
    }

    /// Hands out the next job; none where nobody waits, or where answers that are promised leave no room for more of them.
    pub(super) fn take(&mut self) -> Option<Lease> {
        let Limits { bytes, bytes_per_client, kept, .. } = self.limits;
        for client in self.accounts.over(bytes_per_client) {
            self.make_room_of(&client, 0);
        }
        self.make_room(0);
        if self.bytes > bytes || self.finished.len() > kept {
            return None;
        }
        let may = |account: &Account| account.bytes <= bytes_per_client;
        let memory = self.jobs.get(&self.accounts.peek(may)?)?.memory;
        let taken = self.running.values().sum::<usize>();
        // Nobody goes before a large one, or it would wait for ever.
        if taken > 0 && taken.saturating_add(memory) > self.limits.work_memory {
            return None;
        }
        let id = self.accounts.next(may)?;
        let entry = self.jobs.get(&id)?;
        self.waiting -= 1;
        self.running.insert(id, memory);
        entry.job.send_modify(|job| (job.state, job.started) = (JobState::Running, Some(SystemTime::now())));
        Some(Lease { id, request: entry.request.clone(), memory, progress: entry.progress.clone() })
    }

    /// A worker gives its job back. None where that had ended before.
    pub(super) fn end(&mut self, id: JobId, ending: Ending) -> Option<Job> {
        self.running.remove(&id);
        let seconds = ending.wall_time.as_secs_f64();
        let first = self.seconds == 0.0;
        self.seconds = if first { seconds } else { self.seconds + LATEST * (seconds - self.seconds) };
        self.finish(id, ending.state, ending.product, Some(ending.wall_time))
    }

    /// Dismisses a job that has not ended.
    pub(super) fn cancel(&mut self, id: JobId) -> Option<Cancelled> {
        let before = self.get(id)?;
        if self.accounts.unqueue(&before.client, id) {
            self.waiting -= 1;
        }
        self.jobs.get(&id)?.progress.cancel();
        let now = self.finish(id, JobState::Dismissed, Product::default(), None);
        Some(now.map_or(Cancelled::Before(before), Cancelled::Now))
    }

    /// The end of a job that had none.
    fn finish(&mut self, id: JobId, state: JobState, product: Product, wall_time: Option<Duration>) -> Option<Job> {
        let entry = self.jobs.get_mut(&id).filter(|entry| entry.ended.is_none())?;
        let bytes = product.iter().map(|one| one.part.body.as_ref().map_or(0, Bytes::len)).sum::<usize>();
        self.ends += 1;
        let now = Instant::now();
        (entry.product, entry.ended) = (product, Some((self.ends, now)));
        entry.bytes += bytes;
        // Whoever dismissed a job knows of it.
        let read = state == JobState::Dismissed;
        entry.job.send_modify(|job| {
            (job.finished, job.wall_time) = (Some(SystemTime::now()), wall_time);
            (job.progress, job.state) = (entry.progress.step(), state);
        });
        let job = entry.job.borrow().clone();
        self.charge(&job.client, bytes);
        self.finished.insert(self.ends, id);
        let account = self.accounts.of(&job.client);
        if read { &mut account.read } else { &mut account.unread }.insert(self.ends, id);
        if read {
            self.settle(id);
        } else {
            self.promised.insert(self.ends, now);
        }
        self.make_room_of(&job.client, 0);
        self.make_room(0);
        Some(job)
    }

    /// A client has learnt how a job has ended: from here on it may make room for others.
    pub(super) fn seen(&mut self, id: JobId) {
        let Some(entry) = self.jobs.get(&id) else { return };
        let Some((end, _)) = entry.ended else { return };
        let client = entry.job.borrow().client.clone();
        let account = self.accounts.of(&client);
        account.unread.remove(&end);
        account.read.insert(end, id);
        self.promised.remove(&end);
        self.settle(id);
    }

    /// Forgets a job that has ended; false where there is none.
    pub(super) fn forget(&mut self, id: JobId) -> bool {
        let ended = self.jobs.get(&id).is_some_and(|entry| entry.ended.is_some());
        ended && self.remove(id).is_some()
    }

    fn remove(&mut self, id: JobId) -> Option<()> {
        let Entry { job, request, product, bytes, ended, .. } = self.jobs.remove(&id)?;
        let client = job.borrow().client.clone();
        if let Some((end, _)) = ended {
            self.finished.remove(&end);
            self.promised.remove(&end);
            let account = self.accounts.of(&client);
            account.read.remove(&end);
            account.unread.remove(&end);
        }
        self.discharge(&client, bytes);
        self.settle(id);
        self.removed.push((request, product));
        Some(())
    }

    fn charge(&mut self, client: &Arc<str>, bytes: usize) {
        self.accounts.of(client).bytes += bytes;
        self.bytes += bytes;
    }

    fn discharge(&mut self, client: &Arc<str>, bytes: usize) {
        self.accounts.of(client).bytes -= bytes;
        self.bytes -= bytes;
        self.accounts.close(client);
    }

    /// What was taken out, to be dropped where nobody waits for it.
    pub(super) fn removed(&mut self) -> Vec<(Bytes, Product)> {
        mem::take(&mut self.removed)
    }

    /// A job as it stands.
    pub(super) fn get(&self, id: JobId) -> Option<Job> {
        self.jobs.get(&id).map(|entry| self.view(entry))
    }

    fn view(&self, entry: &Entry) -> Job {
        let mut job = entry.job.borrow().clone();
        match job.status() {
            Status::Accepted => job.position = self.accounts.position(&job.client, job.id),
            Status::Running => job.progress = entry.progress.step(),
            _ => {}
        }
        job
    }

    /// Told of every change of a job.
    pub(super) fn watch(&self, id: JobId) -> Option<watch::Receiver<Job>> {
        self.jobs.get(&id).map(|entry| entry.job.subscribe())
    }

    pub(super) fn request(&self, id: JobId) -> Option<Bytes> {
        self.jobs.get(&id).map(|entry| entry.request.clone())
    }

    pub(super) fn product(&self, id: JobId) -> Option<Product> {
        self.jobs.get(&id).map(|entry| entry.product.clone())
    }

    pub(super) fn list(&self, which: &Which) -> Vec<Job> {
        let Which { client, status, before, limit } = which;
        let entries = self.jobs.range(..before.unwrap_or(JobId::max())).rev().map(|(_, entry)| entry);
        let wanted = |entry: &&Entry| {
            let job = entry.job.borrow();
            status.is_none_or(|status| job.status() == status)
                && client.as_ref().is_none_or(|client| job.client == *client)
        };
        entries.filter(wanted).take(*limit).map(|entry| self.view(entry)).collect()
    }

    /// Every job that has not ended.
    pub(super) fn active(&self) -> Vec<JobId> {
        self.jobs.iter().filter(|(_, entry)| entry.ended.is_none()).map(|(&id, _)| id).collect()
    }

    pub(super) fn occupancy(&self) -> Occupancy {
        Occupancy {
            waiting: self.waiting,
            running: self.running.len(),
            finished: self.finished.len(),
            unread: self.promised.len(),
            bytes: self.bytes,
            evicted: self.evicted,
            seconds: self.seconds,
        }
    }

    pub(super) fn close(&mut self) {
        self.open = false;
    }

    pub(super) fn is_open(&self) -> bool {
        self.open
    }

    /// How many jobs wait.
    pub(super) fn waiting(&self) -> usize {
        self.waiting
    }
}
