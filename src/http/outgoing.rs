//! Answers on their way to clients, who may be slow: together they hold only so much memory.

use super::problem::{Problem, kinds};
use axum::body::{Body, Bytes};
use std::sync::Arc;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};

/// Memory is given out in pieces of so many bytes.
const PIECE: usize = 1024;

/// Room for answers.
#[derive(Debug, Clone)]
pub(super) struct Outgoing {
    room: Arc<Semaphore>,
    pieces: usize,
}

/// An answer, and its share of the room until the last byte has gone.
struct Held {
    answer: Bytes,
    _share: OwnedSemaphorePermit,
}

impl AsRef<[u8]> for Held {
    fn as_ref(&self) -> &[u8] {
        &self.answer
    }
}

impl Outgoing {
    /// Room for so many bytes.
    pub(super) fn new(bytes: usize) -> Self {
        let pieces = (bytes / PIECE).min(Semaphore::MAX_PERMITS);
        Outgoing { room: Arc::new(Semaphore::new(pieces)), pieces }
    }

    /// A body that holds its share of the room; one larger than all the room takes all of it.
    pub(super) fn body(&self, answer: Bytes) -> Result<Body, Problem> {
        let share = u32::try_from(answer.len().div_ceil(PIECE).min(self.pieces)).unwrap_or(u32::MAX);
        let full = |_| Problem::of(kinds::ANSWERS_FULL, "too many large answers are on their way to others");
        let _share = self.room.clone().try_acquire_many_owned(share).map_err(full)?;
        Ok(Body::from(Bytes::from_owner(Held { answer, _share })))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn room_is_given_back_with_the_last_byte() {
        let outgoing = Outgoing::new(10 * PIECE);
        let body = |bytes: usize| outgoing.body(vec![0; bytes].into());
        let large = body(100 * PIECE).unwrap();
        assert!(body(1).is_err());
        drop(large);
        let small: Vec<_> = (0..10).map(|_| body(1).unwrap()).collect();
        assert!(body(1).is_err());
        drop(small);
        assert!(body(10 * PIECE).is_ok());
    }
}
