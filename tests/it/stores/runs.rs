//! A job in the hands of a worker.

use super::{ANSWER, ENDLESS, ERROR, New, PANIC, PATIENCE, QUICK};
use super::{answer, ended, failed, limits, order, running, stand_in, submitted, until, work, workers};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;
use tokio::time::{sleep, timeout};
use voussoir::budget::Budget;
use voussoir::jobs::{Cancelled, Failure, Job, JobState, Status, Work, Workers, resident};

pub(super) async fn a_job_runs_to_its_answer(new: New<'_>) {
    let store = new(limits());
    let accepted = store.submit(order(QUICK)).await.unwrap();
    assert_eq!((accepted.status(), accepted.position, accepted.id.get_version_num()), (Status::Accepted, Some(1), 7));
    let _workers = workers(&store, 1);
    let job = until(&store, accepted.id, ended).await;
    assert_eq!(job.state, JobState::Successful);
    assert!(job.started.unwrap() >= job.created && job.finished >= job.started && job.wall_time.is_some());
    assert_eq!(store.request(job.id).await.unwrap().unwrap(), QUICK);
    for (name, wanted) in [("most", answer().first()), ("third", answer().last()), ("fourth", None)] {
        assert_eq!(store.part(job.id, name, "json").await.unwrap().as_ref(), wanted.map(|one| &one.part));
    }
    assert_eq!(store.part(job.id, "most", "text").await.unwrap(), None);
    let occupancy = store.occupancy().await.unwrap();
    assert_eq!((occupancy.waiting, occupancy.running, occupancy.finished), (0, 0, 1));
    assert!(occupancy.bytes > ANSWER && occupancy.bytes < ANSWER + 10_000 && occupancy.seconds > 0.0);
}

pub(super) async fn a_panic_fails_the_job_and_nothing_else(new: New<'_>) {
    let store = new(limits());
    let _workers = workers(&store, 1);
    let (bad, good) = (submitted(&store, PANIC).await, submitted(&store, QUICK).await);
    assert_eq!(until(&store, bad, ended).await.state, JobState::Failed(Failure::Defect));
    assert_eq!(until(&store, good, ended).await.status(), Status::Successful);
}

pub(super) async fn an_error_is_kept_with_the_job(new: New<'_>) {
    let store = new(limits());
    let _workers = workers(&store, 1);
    let id = submitted(&store, ERROR).await;
    assert_eq!(until(&store, id, ended).await.state, JobState::Failed(failed()));
    assert_eq!(store.part(id, "most", "json").await.unwrap(), None);
}

pub(super) async fn progress_is_seen_and_cancel_is_heard(new: New<'_>) {
    let store = new(limits());
    let _workers = workers(&store, 1);
    let (endless, next) = (submitted(&store, ENDLESS).await, submitted(&store, QUICK).await);
    let job = until(&store, endless, |job| job.progress.is_some_and(|step| step.events > 2)).await;
    assert!(job.status() == Status::Running && job.progress.unwrap().load_factor > 0.0);
    let Some(Cancelled::Now(job)) = store.cancel(endless).await.unwrap() else { panic!("it was running") };
    assert_eq!(job.status(), Status::Dismissed);
    until(&store, next, ended).await;
    assert_eq!(store.job(endless).await.unwrap().unwrap().status(), Status::Dismissed, "the worker changes nothing");
}

pub(super) async fn a_cancelled_job_stays_until_it_is_forgotten(new: New<'_>) {
    let store = new(limits());
    let id = submitted(&store, QUICK).await;
    assert!(!store.forget(id).await.unwrap(), "it has not ended");
    assert!(matches!(store.cancel(id).await.unwrap(), Some(Cancelled::Now(_))));
    for _ in 0..3 {
        let Some(Cancelled::Before(job)) = store.cancel(id).await.unwrap() else { panic!("it had ended") };
        assert_eq!((job.status(), job.position), (Status::Dismissed, None));
    }
    assert!(store.forget(id).await.unwrap() && !store.forget(id).await.unwrap());
    assert!(store.job(id).await.unwrap().is_none() && store.cancel(id).await.unwrap().is_none());
    assert_eq!(store.occupancy().await.unwrap().bytes, 0);
}

pub(super) async fn a_job_that_takes_too_long_fails(new: New<'_>) {
    let store = new(limits());
    let _workers = Workers::start(store.clone(), Work { time: Duration::from_millis(30), ..work(1) }, stand_in, |_| {});
    let late = submitted(&store, ENDLESS).await;
    let job = until(&store, late, ended).await;
    assert!(matches!(job.state, JobState::Failed(Failure::Overdue { events, .. }) if events > 0), "{:?}", job.state);
    let next = submitted(&store, QUICK).await;
    assert_eq!(until(&store, next, ended).await.status(), Status::Successful);
}

pub(super) async fn a_job_that_outgrows_the_process_fails(new: New<'_>) {
    if resident().is_none() {
        return;
    }
    let store = new(limits());
    let _workers = Workers::start(store.clone(), Work { memory: 1, ..work(1) }, stand_in, |_| {});
    let large = submitted(&store, ENDLESS).await;
    let job = until(&store, large, ended).await;
    assert!(
        matches!(job.state, JobState::Failed(Failure::Outgrown { limit: 1, events, .. }) if events > 0),
        "{:?}",
        job.state
    );
}

pub(super) async fn those_who_wait_are_told_of_every_change(new: New<'_>) {
    let store = new(limits());
    let id = submitted(&store, ENDLESS).await;
    let wait = |known| timeout(PATIENCE, store.wait(id, known));
    assert!(timeout(Duration::from_millis(50), store.wait(id, Status::Accepted)).await.is_err(), "nothing happens");
    let _workers = workers(&store, 1);
    let job = wait(Status::Accepted).await.unwrap().unwrap().unwrap();
    assert_eq!(job.status(), Status::Running);
    let (told, cancelled) = tokio::join!(wait(Status::Running), store.cancel(id));
    assert!(matches!(cancelled.unwrap(), Some(Cancelled::Now(_))));
    assert_eq!(told.unwrap().unwrap().unwrap().status(), Status::Dismissed);
    store.forget(id).await.unwrap();
    assert!(wait(Status::Running).await.unwrap().unwrap().is_none(), "nobody can tell any more");
}

pub(super) async fn every_end_is_told_once(new: New<'_>) {
    let store = new(limits());
    let told = Arc::new(Mutex::new(Vec::new()));
    let log = told.clone();
    let note = move |job: &Job| log.lock().unwrap().push((job.id, job.status()));
    let workers = Workers::start(store.clone(), work(2), stand_in, note);
    let mut ids = vec![submitted(&store, ENDLESS).await];
    for round in 0..100 {
        ids.push(submitted(&store, [QUICK, PANIC, ERROR][round % 3]).await);
    }
    let mut cancelled = vec![];
    for id in ids.iter().step_by(3) {
        cancelled.extend(match store.cancel(*id).await.unwrap() {
            Some(Cancelled::Now(job)) => Some((job.id, job.status())),
            _ => None,
        });
    }
    for id in &ids {
        until(&store, *id, ended).await;
    }
    store.close();
    timeout(PATIENCE, workers.idle()).await.unwrap();
    let mut told = told.lock().unwrap().clone();
    assert!(cancelled.contains(&(ids[0], Status::Dismissed)));
    told.extend(cancelled);
    told.sort();
    ids.sort();
    assert!(told.iter().all(|(_, status)| status.is_final()));
    assert!(told.iter().map(|(id, _)| id).eq(&ids));
}

pub(super) async fn jobs_dismissed_at_any_moment_leave_the_workers_whole(new: New<'_>) {
    let store = new(limits());
    let (begun, over) = (Arc::new(AtomicUsize::new(0)), Arc::new(AtomicUsize::new(0)));
    let counters = (begun.clone(), over.clone());
    let counted = move |order: &bytes::Bytes, budget: &Budget| {
        counters.0.fetch_add(1, Ordering::SeqCst);
        let result = stand_in(order, budget);
        counters.1.fetch_add(1, Ordering::SeqCst);
        result
    };
    let workers = Workers::start(store.clone(), work(3), counted, |_| {});
    for round in 0..100u64 {
        let id = submitted(&store, ENDLESS).await;
        sleep(Duration::from_micros(137 * (round % 53))).await;
        assert!(matches!(store.cancel(id).await.unwrap(), Some(Cancelled::Now(_))));
    }
    for _ in 0..6 {
        let id = submitted(&store, QUICK).await;
        assert_eq!(until(&store, id, ended).await.status(), Status::Successful);
    }
    let last = submitted(&store, ENDLESS).await;
    until(&store, last, running).await;
    store.cancel(last).await.unwrap();
    store.close();
    timeout(PATIENCE, workers.idle()).await.expect("all workers go home");
    assert_eq!(begun.load(Ordering::SeqCst), over.load(Ordering::SeqCst));
}
