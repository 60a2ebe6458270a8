//! What every client has in the store, and whose turn it is.

use super::job::JobId;
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

/// What one client has.
#[derive(Debug, Default)]
pub(super) struct Account {
    /// Jobs that wait, the first submitted first.
    pub(super) waiting: VecDeque<JobId>,
    /// Jobs that have ended, by the order of their ends; those whose answer was read, and the others.
    pub(super) read: BTreeMap<u64, JobId>,
    pub(super) unread: BTreeMap<u64, JobId>,
    /// What its requests, answers and keys take.
    pub(super) bytes: usize,
}

impl Account {
    /// How many wait before it. Ids tell nothing: those of a journal may be later than the clock is now.
    fn place(&self, id: JobId) -> Option<usize> {
        self.waiting.iter().position(|waiting| *waiting == id)
    }

    fn is_empty(&self) -> bool {
        self.waiting.is_empty() && self.read.is_empty() && self.unread.is_empty() && self.bytes == 0
    }
}

/// The accounts of all clients. Jobs are taken from one client after the other, so that nobody waits for all jobs of another.
#[derive(Debug, Default)]
pub(super) struct Accounts {
    of: BTreeMap<Arc<str>, Account>,
    /// Clients with jobs that wait, the next one first.
    turns: VecDeque<Arc<str>>,
}

impl Accounts {
    pub(super) fn of(&mut self, client: &Arc<str>) -> &mut Account {
        self.of.entry(client.clone()).or_default()
    }

    pub(super) fn get(&self, client: &str) -> Option<&Account> {
        self.of.get(client)
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = (&Arc<str>, &Account)> {
        self.of.iter()
    }

    /// Takes an account out of the books that has nothing in it.
    pub(super) fn close(&mut self, client: &str) {
        if self.of.get(client).is_some_and(Account::is_empty) {
            self.of.remove(client);
        }
    }

    /// A job waits from here on.
    pub(super) fn queue(&mut self, client: &Arc<str>, id: JobId) {
        let account = self.of(client);
        account.waiting.push_back(id);
        if account.waiting.len() == 1 {
            self.turns.push_back(client.clone());
        }
    }

    /// The next job of the next client for whom `may` holds, left where it is.
    pub(super) fn peek(&self, may: impl Fn(&Account) -> bool) -> Option<JobId> {
        let mut accounts = self.turns.iter().filter_map(|client| self.of.get(client));
        accounts.find(|account| may(account))?.waiting.front().copied()
    }

    /// The next job of the next client for whom `may` holds.
    pub(super) fn next(&mut self, may: impl Fn(&Account) -> bool) -> Option<JobId> {
        let place = self.turns.iter().position(|client| self.of.get(client).is_some_and(&may))?;
        let client = self.turns.remove(place)?;
        let account = self.of.get_mut(&client)?;
        let id = account.waiting.pop_front();
        if !account.waiting.is_empty() {
            self.turns.push_back(client);
        }
        id
    }

    /// Clients with jobs that wait who have more than so many bytes.
    pub(super) fn over(&self, bytes: usize) -> Vec<Arc<str>> {
        let over = |client: &&Arc<str>| self.of.get(*client).is_some_and(|account| account.bytes > bytes);
        self.turns.iter().filter(over).cloned().collect()
    }

    /// A job waits no more, though nobody took it; false where it did not wait.
    pub(super) fn unqueue(&mut self, client: &Arc<str>, id: JobId) -> bool {
        let account = self.of(client);
        let Some(place) = account.place(id) else { return false };
        account.waiting.remove(place);
        if account.waiting.is_empty() {
            self.turns.retain(|other| other != client);
        }
        true
    }

    /// The turn of a job that waits, 1 for the next, if no other is submitted and no client is held back.
    pub(super) fn position(&self, client: &str, id: JobId) -> Option<usize> {
        let before = self.of.get(client)?.place(id)?;
        let turn = self.turns.iter().position(|other| **other == *client)?;
        let of_others = self.turns.iter().enumerate().filter(|&(place, _)| place != turn).map(|(place, other)| {
            let rounds = before + usize::from(place < turn);
            self.of.get(other).map_or(0, |account| account.waiting.len().min(rounds))
        });
        Some(of_others.sum::<usize>() + before + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clients_take_turns_and_positions_say_so() {
        let mut accounts = Accounts::default();
        let ids: Vec<_> = (1..=6).map(JobId::from_u128).collect();
        // One client queues four before another queues two.
        for (client, id) in ["a", "a", "a", "a", "b", "b"].into_iter().zip(&ids) {
            accounts.queue(&Arc::from(client), *id);
        }
        let position = |accounts: &Accounts, at: usize| accounts.position(if at < 4 { "a" } else { "b" }, ids[at]);
        let positions: Vec<_> = (0..6).map(|at| position(&accounts, at)).collect();
        assert_eq!(positions, [1, 3, 5, 6, 2, 4].map(Some));
        let taken: Vec<_> = std::iter::from_fn(|| accounts.next(|_| true)).collect();
        assert_eq!(taken, [0, 4, 1, 5, 2, 3].map(|at| ids[at]));
        assert_eq!(position(&accounts, 0), None);
    }

    #[test]
    fn who_is_held_back_holds_nobody_else_back() {
        let mut accounts = Accounts::default();
        let (a, b) = (Arc::from("a"), Arc::from("b"));
        accounts.queue(&a, JobId::from_u128(1));
        accounts.queue(&b, JobId::from_u128(2));
        accounts.of(&a).bytes = 100;
        assert_eq!(accounts.next(|account| account.bytes < 50), Some(JobId::from_u128(2)));
        assert_eq!(accounts.next(|account| account.bytes < 50), None);
        assert!(accounts.unqueue(&a, JobId::from_u128(1)) && !accounts.unqueue(&a, JobId::from_u128(1)));
        assert_eq!(accounts.next(|_| true), None);
    }

    #[test]
    fn jobs_wait_in_the_order_in_which_they_came_whatever_their_ids() {
        let (mut accounts, a) = (Accounts::default(), Arc::from("a"));
        let ids = [9, 8, 1, 2].map(JobId::from_u128);
        ids.iter().for_each(|id| accounts.queue(&a, *id));
        assert_eq!(ids.map(|id| accounts.position("a", id)), [1, 2, 3, 4].map(Some));
        assert!(accounts.unqueue(&a, ids[0]) && accounts.unqueue(&a, ids[3]));
        assert_eq!([accounts.next(|_| true), accounts.next(|_| true)], [ids[1], ids[2]].map(Some));
        assert_eq!(accounts.next(|_| true), None);
    }
}
