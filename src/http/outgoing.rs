//! Answers on their way to clients, who may be slow: together they hold only so much memory.

use super::problem::{Problem, kinds};
use super::quota::{Full, Quota, Share};
use axum::body::Bytes;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError, Weak};

/// Room for answers; copies are the same.
#[derive(Debug, Clone)]
pub(super) struct Outgoing {
    room: Quota,
    under_way: Arc<Mutex<UnderWay>>,
}

/// What is held, by client and by where its bytes are.
type UnderWay = BTreeMap<(String, usize), Weak<Held>>;

/// An answer, and its share of the room until its last byte has gone to the last of the client's requests for it.
#[derive(Debug)]
struct Held {
    answer: Bytes,
    _share: Share,
}

struct Reading(Arc<Held>);

impl AsRef<[u8]> for Reading {
    fn as_ref(&self) -> &[u8] {
        &self.0.answer
    }
}

impl Outgoing {
    /// Room for so many bytes in all, and so many of them for one client.
    pub(super) fn new(most: usize, most_each: usize) -> Self {
        Outgoing { room: Quota::new(most, most_each), under_way: Arc::default() }
    }

    /// The bytes of an answer that hold their share of the room. One that is larger than a client's part takes all of that.
    /// A client that asks for the same bytes several times at once has them once.
    pub(super) fn hold(&self, client: &str, answer: Bytes) -> Result<Bytes, Problem> {
        let place = (client.to_owned(), answer.as_ptr().addr());
        let mut under_way = self.under_way.lock().unwrap_or_else(PoisonError::into_inner);
        under_way.retain(|_, held| held.strong_count() > 0);
        // As long as it is held, no other answer is at its place.
        if let Some(held) = under_way.get(&place).and_then(Weak::upgrade)
            && held.answer.len() == answer.len()
        {
            return Ok(Bytes::from_owner(Reading(held)));
        }
        let _share = self.room.take(client, answer.len().min(self.room.most_each())).map_err(no_room)?;
        let held = Arc::new(Held { answer, _share });
        under_way.insert(place, Arc::downgrade(&held));
        Ok(Bytes::from_owner(Reading(held)))
    }
}

fn no_room(full: Full) -> Problem {
    match full {
        Full::OfClient => Problem::of(kinds::CLIENT_ANSWERS_FULL, "read the large answers that are on their way first"),
        Full::OfAll => Problem::of(kinds::ANSWERS_FULL, "too many large answers are on their way to others"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn room_is_given_back_with_the_last_byte() {
        let outgoing = Outgoing::new(100, 50);
        let hold = |client: &str, bytes: usize| outgoing.hold(client, vec![0; bytes].into());
        let large = hold("a", 1000).unwrap();
        assert!(hold("a", 1).is_err(), "one answer may take all of a client's part");
        let other = hold("b", 50).unwrap();
        assert!(hold("c", 1).is_err());
        drop(large);
        let small: Vec<_> = (0..50).map(|_| hold("a", 1).unwrap()).collect();
        assert!(hold("a", 1).is_err() && hold("b", 1).is_err() && hold("c", 1).is_err());
        drop((small, other));
        assert!(hold("a", 50).is_ok());
    }

    #[test]
    fn a_client_that_reads_an_answer_twice_at_once_holds_it_once() {
        let outgoing = Outgoing::new(100, 50);
        let kept = Bytes::from(vec![7; 50]);
        let readers: Vec<_> = (0..10).map(|_| outgoing.hold("a", kept.clone()).unwrap()).collect();
        assert!(readers.iter().all(|answer| *answer == kept));
        assert!(outgoing.hold("a", vec![7; 1].into()).is_err());
        drop(readers);
        assert!(outgoing.hold("a", vec![7; 50].into()).is_ok());
    }
}
