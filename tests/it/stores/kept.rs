//! Jobs that have ended, and keys.

use super::{ANSWER, ENDLESS, ERROR, New, QUICK};
use super::{ended, forgotten, gone, keyed, limits, of, order, running, submitted, until, workers};
use std::time::Duration;
use tokio::time::sleep;
use voussoir::jobs::{Limits, Refusal, Status};

/// Long enough that no test sees its end.
const PROMISED: Duration = Duration::from_secs(1000);

pub(super) async fn what_was_not_read_is_kept_and_submissions_are_refused(new: New<'_>) {
    let store = new(Limits { bytes: 2 * ANSWER + ANSWER / 2, promised: PROMISED, ..limits() });
    let mut ids = vec![];
    for _ in 0..4 {
        ids.push(submitted(&store, QUICK).await);
    }
    let _workers = workers(&store, 1);
    // The third answer takes more than there is; the fourth job waits until something may be forgotten.
    until(&store, ids[2], ended).await;
    assert!(matches!(store.submit(order(QUICK)).await.unwrap_err(), Refusal::MemoryFull(bytes) if bytes > 3 * ANSWER));
    sleep(Duration::from_millis(300)).await;
    for (id, status) in ids.iter().zip([Status::Successful, Status::Successful, Status::Successful, Status::Accepted]) {
        assert_eq!(store.job(*id).await.unwrap().expect("it is promised").status(), status);
    }
    assert_eq!(store.occupancy().await.unwrap().unread, 3);
    for id in &ids[..2] {
        assert!(store.part(*id, "most", "json").await.unwrap().is_some());
    }
    until(&store, ids[3], ended).await;
    assert!(!forgotten(&store, ids[2]).await, "what was not read outlives what was");
}

pub(super) async fn what_was_read_makes_room_first(new: New<'_>) {
    let store = new(Limits { kept: 2, ..limits() });
    let _workers = workers(&store, 1);
    let (first, second) = (submitted(&store, QUICK).await, submitted(&store, QUICK).await);
    until(&store, second, ended).await;
    store.part(second, "rest", "json").await.unwrap();
    let third = submitted(&store, QUICK).await;
    until(&store, third, ended).await;
    gone(&store, second).await;
    assert!(!forgotten(&store, first).await, "though it ended before");
    let fourth = submitted(&store, QUICK).await;
    until(&store, fourth, ended).await;
    gone(&store, first).await;
    assert_eq!(store.occupancy().await.unwrap().evicted, 2);
}

pub(super) async fn who_holds_most_makes_room_first(new: New<'_>) {
    let store = new(Limits { bytes: 4 * ANSWER, ..limits() });
    let _workers = workers(&store, 1);
    let small = store.submit(of("small", QUICK)).await.unwrap().id;
    until(&store, small, ended).await;
    let mut large = vec![];
    for _ in 0..8 {
        large.push(store.submit(of("large", QUICK)).await.unwrap().id);
        until(&store, large[large.len() - 1], ended).await;
    }
    assert!(!forgotten(&store, small).await, "though it ended before all others");
    for (place, id) in large.iter().enumerate() {
        if place < 6 {
            gone(&store, *id).await;
        }
        assert_eq!(forgotten(&store, *id).await, place < 6, "{place}: two fit");
    }
}

pub(super) async fn what_is_kept_grows_old(new: New<'_>) {
    let store = new(Limits { kept_for: Duration::from_millis(100), promised: PROMISED, ..limits() });
    let _workers = workers(&store, 1);
    let id = submitted(&store, QUICK).await;
    gone(&store, id).await;
    assert_eq!(store.occupancy().await.unwrap().bytes, 0);
}

pub(super) async fn a_failed_job_is_kept_until_it_was_seen(new: New<'_>) {
    let store = new(Limits { kept: 1, promised: PROMISED, ..limits() });
    let _workers = workers(&store, 1);
    let failed = submitted(&store, ERROR).await;
    until(&store, failed, ended).await;
    let next = submitted(&store, QUICK).await;
    until(&store, next, ended).await;
    assert!(!forgotten(&store, failed).await);
    assert!(matches!(store.submit(order(QUICK)).await.unwrap_err(), Refusal::MemoryFull(_)));
    store.seen(failed).await.unwrap();
    assert!(store.submit(order(QUICK)).await.is_ok() && forgotten(&store, failed).await);
}

pub(super) async fn a_key_names_one_submission(new: New<'_>) {
    let store = new(limits());
    let first = store.submit(keyed(QUICK, "a")).await.unwrap().id;
    assert_eq!(store.submit(keyed(QUICK, "a")).await.unwrap().id, first);
    assert_eq!(store.submit(keyed(ERROR, "a")).await.unwrap_err(), Refusal::KeyTaken(first));
    assert_ne!(store.submit(keyed(QUICK, "b")).await.unwrap().id, first);
    let _workers = workers(&store, 1);
    until(&store, first, ended).await;
    assert_eq!(store.submit(keyed(QUICK, "a")).await.unwrap().status(), Status::Successful, "when it has ended");
    store.close();
    assert_eq!(store.submit(keyed(QUICK, "a")).await.unwrap().id, first, "when nothing more is accepted");
}

pub(super) async fn a_key_lives_as_long_as_promised(new: New<'_>) {
    let store = new(Limits { keys_for: Duration::from_millis(300), ..limits() });
    let workers = workers(&store, 1);
    let first = store.submit(keyed(QUICK, "a")).await.unwrap().id;
    until(&store, first, ended).await;
    assert!(store.forget(first).await.unwrap());
    assert_eq!(store.submit(keyed(QUICK, "a")).await.unwrap_err(), Refusal::KeySpent(first), "it is not run again");
    let lasting = store.submit(keyed(ENDLESS, "b")).await.unwrap().id;
    until(&store, lasting, running).await;
    sleep(Duration::from_millis(400)).await;
    assert_ne!(store.submit(keyed(QUICK, "a")).await.unwrap().id, first, "it is free again");
    assert_eq!(store.submit(keyed(ENDLESS, "b")).await.unwrap().id, lasting, "as long as its job is kept");
    workers.abandon().await;
}
