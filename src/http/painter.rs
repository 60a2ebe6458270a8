//! Drawings in pixels and reports on paper, painted when they are asked for: one at a time, so that whoever asks for many holds up no
//! one else but those who ask for them, too; and of one client after one of another, so that those wait for no more than one of each.

use super::problem::{Problem, kinds};
use super::quota::{Full, Quota, Share};
use crate::jobs::Part;
use crate::wire::format::Format;
use crate::wire::rendering::painted;
use axum::body::Bytes;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError, Weak};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::task::spawn_blocking;

/// How many may wait for their turn, of all clients and of one.
const MOST: usize = 64;
const MOST_EACH: usize = 16;

/// Who paints.
#[derive(Debug)]
pub(super) struct Painter {
    of_all: Arc<Semaphore>,
    of_clients: Mutex<BTreeMap<String, Weak<Semaphore>>>,
    asked: Quota,
}

/// A client's turn, until it is dropped.
#[derive(Debug)]
pub(super) struct Turn {
    _of_all: OwnedSemaphorePermit,
    _of_client: OwnedSemaphorePermit,
    _asked: Share,
}

impl Painter {
    pub(super) fn new() -> Self {
        let of_all = Arc::new(Semaphore::new(1));
        Painter { of_all, of_clients: Mutex::default(), asked: Quota::new(MOST, MOST_EACH) }
    }

    /// Waits for a client's turn: first among what the client itself asks for.
    pub(super) async fn turn(&self, client: &str) -> Result<Turn, Problem> {
        let _asked = self.asked.take(client, 1).map_err(full)?;
        let of_client = self.of_client(client).acquire_owned();
        let _of_client = of_client.await.map_err(|_| Problem::internal())?;
        let _of_all = self.of_all.clone().acquire_owned().await.map_err(|_| Problem::internal())?;
        Ok(Turn { _of_all, _of_client, _asked })
    }

    fn of_client(&self, client: &str) -> Arc<Semaphore> {
        let mut of_clients = self.of_clients.lock().unwrap_or_else(PoisonError::into_inner);
        of_clients.retain(|_, turns| turns.strong_count() > 0);
        let known = of_clients.get(client).and_then(Weak::upgrade);
        known.unwrap_or_else(|| {
            let turns = Arc::new(Semaphore::new(1));
            of_clients.insert(client.to_owned(), Arc::downgrade(&turns));
            turns
        })
    }
}

impl Turn {
    /// What is kept in another format, in this one.
    #[allow(clippy::disallowed_methods, reason = "painting is no analysis: short, and needs no cancelling")]
    pub(super) async fn paint(self, kept: Part, format: Format) -> Result<Bytes, Problem> {
        let painting = spawn_blocking(move || {
            let _turn = self;
            painted(&kept, format)
        });
        painting.await.ok().and_then(Result::ok).ok_or_else(Problem::internal)
    }
}

fn full(full: Full) -> Problem {
    match full {
        Full::OfClient => Problem::of(kinds::CLIENT_ANSWERS_FULL, "wait for the drawings and reports asked for before"),
        Full::OfAll => Problem::of(kinds::ANSWERS_FULL, "too many drawings and reports are asked for by others"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use futures_util::FutureExt;

    #[test]
    fn whoever_asks_for_many_lets_others_take_their_turn() {
        let painter = Painter::new();
        let first = painter.turn("a").now_or_never().unwrap().unwrap();
        let (mut second, mut of_another) = (Box::pin(painter.turn("a")), Box::pin(painter.turn("b")));
        assert!((&mut second).now_or_never().is_none() && (&mut of_another).now_or_never().is_none());
        drop(first);
        assert!((&mut second).now_or_never().is_none());
        let turn = (&mut of_another).now_or_never().unwrap().unwrap();
        assert!((&mut second).now_or_never().is_none(), "one at a time");
        drop(turn);
        assert!((&mut second).now_or_never().unwrap().is_ok());
        drop((second, of_another));
        assert!(painter.turn("b").now_or_never().is_some());
    }

    #[test]
    fn so_many_wait_and_no_more() {
        let painter = Painter::new();
        let clients = ["a", "b", "c", "d"];
        let ask = |client: &'static str| {
            let mut turn = Box::pin(painter.turn(client));
            let answer = (&mut turn).now_or_never();
            (turn, answer)
        };
        let asked: Vec<_> = clients.iter().flat_map(|client| (0..MOST_EACH).map(|_| ask(client))).collect();
        assert_eq!(asked.iter().filter(|(_, answer)| answer.is_some()).count(), 1);
        let refused = |client| ask(client).1.unwrap().unwrap_err();
        assert_eq!((refused("a"), refused("e")), (full(Full::OfClient), full(Full::OfAll)));
        drop(asked);
        assert!(ask("a").1.unwrap().is_ok());
    }
}
