//! Jobs that wait.

use super::{ENDLESS, ERROR, New, PATIENCE, QUICK};
use super::{answer, ended, limits, of, order, running, submitted, until, work, workers};
use std::sync::{Arc, Mutex};
use std::time::Duration;
use tokio::time::timeout;
use voussoir::budget::Budget;
use voussoir::jobs::{Limits, Refusal, Status, Submission, Which, Workers};

pub(super) async fn a_full_queue_refuses_and_loses_nothing(new: New<'_>) {
    let store = new(Limits { queue: 3, ..limits() });
    let _workers = workers(&store, 1);
    let first = submitted(&store, ENDLESS).await;
    until(&store, first, running).await;
    let mut accepted = vec![];
    for _ in 0..3 {
        accepted.push(submitted(&store, QUICK).await);
    }
    assert_eq!(store.submit(order(QUICK)).await.unwrap_err(), Refusal::QueueFull(3));
    store.cancel(first).await.unwrap();
    for id in accepted {
        assert_eq!(until(&store, id, ended).await.status(), Status::Successful);
    }
    assert!(store.submit(order(QUICK)).await.is_ok());
}

pub(super) async fn one_client_cannot_fill_the_queue_of_all(new: New<'_>) {
    let store = new(Limits { queue_per_client: 2, ..limits() });
    let waiting = submitted(&store, QUICK).await;
    submitted(&store, QUICK).await;
    assert_eq!(store.submit(order(QUICK)).await.unwrap_err(), Refusal::ClientQueueFull(2));
    assert!(store.submit(of("you", QUICK)).await.is_ok());
    store.cancel(waiting).await.unwrap();
    assert!(store.submit(order(QUICK)).await.is_ok());
}

pub(super) async fn clients_take_turns(new: New<'_>) {
    let store = new(limits());
    let mut ids = vec![];
    for number in 0..6 {
        ids.push(store.submit(of("many", &format!("many {number}"))).await.unwrap().id);
    }
    for number in 0..2 {
        let job = store.submit(of("few", &format!("few {number}"))).await.unwrap();
        assert_eq!(job.position, Some(2 + 2 * number), "its turn comes after that many of the other");
    }
    let position = store.job(ids[5]).await.unwrap().unwrap().position;
    assert_eq!(position, Some(8));
    let seen = Arc::new(Mutex::new(Vec::new()));
    let log = seen.clone();
    let note = move |order: &bytes::Bytes, _: &Budget| {
        log.lock().unwrap().push(String::from_utf8(order.to_vec()).unwrap());
        Ok(answer())
    };
    let _workers = Workers::start(store.clone(), work(1), note, |_| {});
    until(&store, ids[5], ended).await;
    let wanted = ["many 0", "few 0", "many 1", "few 1", "many 2", "many 3", "many 4", "many 5"];
    assert_eq!(*seen.lock().unwrap(), wanted);
}

pub(super) async fn a_closed_store_accepts_no_more(new: New<'_>) {
    let store = new(limits());
    let workers = workers(&store, 2);
    let id = submitted(&store, ENDLESS).await;
    until(&store, id, running).await;
    store.close();
    assert!(!store.is_open());
    assert_eq!(store.submit(order(QUICK)).await.unwrap_err(), Refusal::Closed);
    assert!(timeout(Duration::from_millis(50), workers.idle()).await.is_err(), "who is at work stays");
    store.cancel(id).await.unwrap();
    timeout(PATIENCE, workers.idle()).await.unwrap();
    assert_eq!(store.job(id).await.unwrap().unwrap().status(), Status::Dismissed);
}

pub(super) async fn pages_of_the_list_hold_every_job_once(new: New<'_>) {
    let store = new(limits());
    let mut ids = vec![];
    for number in 0..7 {
        ids.push(submitted(&store, if number == 3 { ERROR } else { QUICK }).await);
    }
    let _workers = workers(&store, 1);
    until(&store, ids[6], ended).await;
    let (mut seen, mut before) = (vec![], None);
    loop {
        let page = store.list(Which { before, limit: 3, ..Which::default() }).await.unwrap();
        let Some(last) = page.last() else { break };
        before = Some(last.id);
        seen.extend(page.iter().map(|job| job.id));
    }
    assert!(seen.iter().eq(ids.iter().rev()));
    let failed = Which { status: Some(Status::Failed), limit: 10, ..Which::default() };
    assert_eq!(store.list(failed).await.unwrap().iter().map(|job| job.id).collect::<Vec<_>>(), [ids[3]]);
}

pub(super) async fn a_list_may_be_of_one_client(new: New<'_>) {
    let store = new(limits());
    submitted(&store, QUICK).await;
    let yours = store.submit(of("you", QUICK)).await.unwrap().id;
    let of_client = |client: &str| Which { client: Some(client.into()), limit: 10, ..Which::default() };
    let listed = store.list(of_client("you")).await.unwrap();
    assert_eq!(listed.iter().map(|job| job.id).collect::<Vec<_>>(), [yours]);
    assert!(store.list(of_client("nobody")).await.unwrap().is_empty());
}

pub(super) async fn what_takes_much_memory_waits_and_others_behind_it(new: New<'_>) {
    let store = new(Limits { work_memory: 2500, ..limits() });
    let _workers = workers(&store, 3);
    let first = submitted(&store, ENDLESS).await;
    until(&store, first, running).await;
    let large = store.submit(Submission { memory: 2000, ..of("you", ENDLESS) }).await.unwrap().id;
    let small = submitted(&store, QUICK).await;
    tokio::time::sleep(Duration::from_millis(300)).await;
    for id in [large, small] {
        assert_eq!(store.job(id).await.unwrap().unwrap().status(), Status::Accepted);
    }
    store.cancel(first).await.unwrap();
    until(&store, large, running).await;
    store.cancel(large).await.unwrap();
    until(&store, small, ended).await;
    let alone = store.submit(Submission { memory: 9000, ..of("you", QUICK) }).await.unwrap().id;
    until(&store, alone, ended).await;
}
