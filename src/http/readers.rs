//! Whose body is read when: as many at once as there are cores, and one at least is left to small ones.

use std::num::NonZeroUsize;
use std::sync::Arc;
use std::thread::available_parallelism;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};

/// Bodies of more bytes may take so long to read that others do not wait behind them.
const SMALL: usize = 64 << 10;

/// Who reads.
#[derive(Debug)]
pub(super) struct Readers {
    all: Arc<Semaphore>,
    large: Arc<Semaphore>,
}

/// One body's turn, until it is dropped.
pub(super) struct Turn {
    _any: OwnedSemaphorePermit,
    _large: Option<OwnedSemaphorePermit>,
}

impl Readers {
    /// One for each core.
    pub(super) fn new() -> Self {
        let cores = available_parallelism().map_or(1, NonZeroUsize::get);
        // On a single core two take turns.
        let all = cores.max(2);
        Readers { all: Arc::new(Semaphore::new(all)), large: Arc::new(Semaphore::new(all - 1)) }
    }

    /// Waits until a body of so many bytes may be read. How many wait is bounded by the memory for bodies.
    pub(super) async fn turn(&self, bytes: usize) -> Option<Turn> {
        // First among the large ones: who waits for those holds back no small one.
        let _large = match bytes > SMALL {
            true => Some(self.large.clone().acquire_owned().await.ok()?),
            false => None,
        };
        Some(Turn { _any: self.all.clone().acquire_owned().await.ok()?, _large })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use futures_util::FutureExt;

    #[test]
    fn small_bodies_do_not_wait_for_large_ones() {
        let readers = Readers::new();
        let turn = |bytes: usize| readers.turn(bytes).now_or_never();
        let large: Vec<_> = std::iter::from_fn(|| turn(SMALL + 1)).collect();
        assert!(!large.is_empty() && turn(SMALL + 1).is_none());
        let small = turn(SMALL);
        assert!(small.is_some() && turn(SMALL).is_none());
        drop(large);
        assert!(turn(SMALL).is_some());
    }
}
