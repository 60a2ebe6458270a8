//! What has to make room for what.

use super::Table;
use crate::jobs::accounts::Account;
use crate::jobs::job::JobId;
use crate::jobs::memory::Limits;
use crate::jobs::store::{Refusal, Submission};
use std::sync::Arc;
use std::time::Duration;

impl Table {
    /// Makes room for so many bytes, or says why there is none.
    pub(super) fn admit(&mut self, submission: &Submission, bytes: usize) -> Result<(), Refusal> {
        let Limits { queue, queue_per_client, bytes: most, bytes_per_client, kept, .. } = self.limits;
        if !self.open {
            return Err(Refusal::Closed);
        }
        if self.waiting >= queue {
            return Err(Refusal::QueueFull(self.waiting));
        }
        let of_client = |table: &Table| {
            table.accounts.get(&submission.client).map_or((0, 0), |account| (account.waiting.len(), account.bytes))
        };
        let (waiting, _) = of_client(self);
        if waiting >= queue_per_client {
            return Err(Refusal::ClientQueueFull(waiting));
        }
        self.make_room_of(&submission.client, bytes);
        let (_, held) = of_client(self);
        if held.saturating_add(bytes) > bytes_per_client {
            return Err(Refusal::ClientMemoryFull(held));
        }
        self.make_room(bytes);
        if self.bytes.saturating_add(bytes) > most || self.finished.len() > kept {
            return Err(Refusal::MemoryFull(self.bytes));
        }
        Ok(())
    }

    /// Forgets what is too old, and promises that are.
    pub(in crate::jobs) fn tidy(&mut self) {
        while let Some(oldest) = self.promised.first_entry()
            && oldest.get().elapsed() >= self.limits.promised
        {
            oldest.remove();
        }
        while let Some((_, &id)) = self.finished.first_key_value()
            && self.age(id) > self.limits.kept_for
        {
            self.remove(id);
        }
        while let Some((known, bytes)) = self.keys.expire(self.limits.keys_for, |id| self.jobs.contains_key(&id)) {
            self.discharge(&known.client, bytes);
        }
    }

    /// How long ago a job has ended.
    pub(super) fn age(&self, id: JobId) -> Duration {
        let ended = self.jobs.get(&id).and_then(|entry| entry.ended);
        ended.map_or(Duration::ZERO, |(_, at)| at.elapsed())
    }

    /// The job of an account that has to make room first: the one read that ended first, then the one unread that did, if it has
    /// been kept as long as was promised.
    fn first_to_go(&self, account: &Account) -> Option<JobId> {
        let read = account.read.first_key_value();
        let unread = || account.unread.first_key_value().filter(|(_, id)| self.age(**id) >= self.limits.promised);
        read.or_else(unread).map(|(_, &id)| id)
    }

    /// Forgets jobs of one client until so many bytes more are within what one may have.
    pub(super) fn make_room_of(&mut self, client: &Arc<str>, bytes: usize) {
        while let Some(account) = self.accounts.get(client)
            && account.bytes.saturating_add(bytes) > self.limits.bytes_per_client
            && let Some(id) = self.first_to_go(account)
        {
            self.evict(id);
        }
    }

    /// Forgets jobs until so many bytes more are within what all may have, first those of whoever has most.
    pub(super) fn make_room(&mut self, bytes: usize) {
        while self.bytes.saturating_add(bytes) > self.limits.bytes || self.finished.len() > self.limits.kept {
            let candidates = self.accounts.iter().filter_map(|(_, account)| {
                let id = self.first_to_go(account)?;
                Some((account.bytes, id))
            });
            let Some((_, id)) = candidates.max_by_key(|(bytes, _)| *bytes) else { return };
            self.evict(id);
        }
    }

    fn evict(&mut self, id: JobId) {
        self.evicted += 1;
        self.remove(id);
    }
}
