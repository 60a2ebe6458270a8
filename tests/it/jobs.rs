//! The job store, with stand-ins for the mechanics.
#![allow(clippy::disallowed_methods, reason = "tests wait for jobs by looking again")]

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::sleep;
use std::time::{Duration, Instant};
use voussoir::budget::{Budget, LoadStep};
use voussoir::collapse::AnalysisError;
use voussoir::jobs::{
    Dismissal, Failure, Job, JobId, JobState, JobStore, Limits, Product, Refusal, Rendering, Status, Submission,
};

const QUICK: f64 = 0.0;
const ENDLESS: f64 = 1.0;
const PANIC: f64 = 2.0;
const ERROR: f64 = 3.0;

/// Bytes of an answer.
const ANSWER: usize = 1000;

/// Does what the request says.
fn stand_in(order: f64, budget: &Budget) -> Result<Product, Failure> {
    if order == ENDLESS {
        return endless(budget);
    }
    assert!(order != PANIC, "asked to panic");
    if order == ERROR {
        return Err(failed().into());
    }
    Ok(answer())
}

/// Steps on until told to stop.
fn endless(budget: &Budget) -> Result<Product, Failure> {
    let mut step = LoadStep { load_factor: 0.0, events: 0 };
    while budget.step(step.load_factor, step.events).is_continue() {
        step = LoadStep { load_factor: step.load_factor + 0.5, events: step.events + 1 };
        sleep(Duration::from_millis(1));
    }
    Err(AnalysisError::from(budget.stopped()).into())
}

fn failed() -> AnalysisError {
    AnalysisError::NotFinite { what: "asked to fail".to_owned() }
}

/// In two parts, and without a third.
fn answer() -> Product {
    let part = |name: &str, body| Rendering { names: vec![name.to_owned()], format: "json", body, packed_from: None };
    let of = |bytes: usize| Ok(vec![b' '; bytes].into());
    [part("most", of(ANSWER - 1)), part("rest", of(1)), part("third", Err("not here".to_owned()))].into()
}

fn limits(workers: usize, queue: usize, kept: usize) -> Limits {
    let (kept_for, time) = (Duration::from_secs(1000), Duration::from_secs(1000));
    Limits { workers, queue, queue_per_client: queue, kept, kept_for, bytes: 1 << 30, time }
}

fn store(workers: usize, queue: usize, kept: usize) -> JobStore<f64> {
    with(limits(workers, queue, kept))
}

fn with(limits: Limits) -> JobStore<f64> {
    JobStore::start(limits, stand_in, |_| {}).unwrap()
}

/// What is submitted, of 100 bytes.
fn order(request: f64) -> Submission<f64> {
    Submission { work: request, request: bytes(100, request), name: None, client: "me".to_owned(), key: None }
}

/// A request as it is given out, of so many bytes.
fn bytes(size: usize, request: f64) -> bytes::Bytes {
    format!("{request:>size$}").into()
}

fn keyed(request: f64, key: &str) -> Submission<f64> {
    Submission { key: Some(key.to_owned()), ..order(request) }
}

/// Waits until `done` says so of the job.
fn until<W>(store: &JobStore<W>, id: JobId, done: impl Fn(&Job) -> bool) -> Job {
    let clock = Instant::now();
    loop {
        let job = store.get(id).expect("the job is kept");
        if done(&job) {
            return job;
        }
        assert!(clock.elapsed() < Duration::from_secs(20), "{:?} for too long", job.status());
        sleep(Duration::from_millis(1));
    }
}

fn ended(job: &Job) -> bool {
    job.finished.is_some()
}

fn running(job: &Job) -> bool {
    job.status() == Status::Running
}

#[test]
fn a_job_runs_to_its_report() {
    let store = store(1, 10, 10);
    let accepted = store.submit(order(QUICK)).unwrap();
    assert_eq!((accepted.status(), accepted.request), (Status::Accepted, bytes(100, QUICK)));
    let job = until(&store, accepted.id, ended);
    assert_eq!(job.state, JobState::Successful(answer()));
    assert!(job.wall_time().is_some());
    assert_eq!(job.id.get_version_num(), 7);
}

#[test]
fn a_panic_fails_the_job_and_nothing_else() {
    let store = store(1, 10, 10);
    let bad = store.submit(order(PANIC)).unwrap();
    let good = store.submit(order(QUICK)).unwrap();
    assert_eq!(until(&store, bad.id, ended).state, JobState::Failed(Failure::Defect));
    assert_eq!(until(&store, good.id, ended).status(), Status::Successful);
}

#[test]
fn an_error_is_kept_with_the_job() {
    let store = store(1, 10, 10);
    let job = store.submit(order(ERROR)).unwrap();
    assert_eq!(until(&store, job.id, ended).state, JobState::Failed(Failure::Analysis(failed())));
}

#[test]
fn progress_is_seen_and_cancel_is_heard() {
    let store = store(1, 10, 10);
    let endless = store.submit(order(ENDLESS)).unwrap();
    let next = store.submit(order(QUICK)).unwrap();
    let job = until(&store, endless.id, |job| job.progress.step().is_some_and(|step| step.events > 2));
    assert_eq!(job.status(), Status::Running);
    let step = job.progress.step().unwrap();
    assert!(step.load_factor > 0.0);
    let clock = Instant::now();
    let Some(Dismissal::Cancelled(job)) = store.dismiss(endless.id) else { panic!("it was running") };
    assert_eq!(job.status(), Status::Dismissed);
    until(&store, next.id, ended);
    assert!(clock.elapsed() < Duration::from_secs(5), "the worker was not freed");
    assert_eq!(store.get(endless.id).unwrap().status(), Status::Dismissed);
}

#[test]
fn a_waiting_job_is_dismissed_and_a_finished_one_forgotten() {
    let store = store(1, 10, 10);
    let endless = store.submit(order(ENDLESS)).unwrap();
    let waiting = store.submit(order(QUICK)).unwrap();
    assert!(matches!(store.dismiss(waiting.id), Some(Dismissal::Cancelled(_))));
    assert!(matches!(store.dismiss(waiting.id), Some(Dismissal::Forgotten)));
    assert!(store.get(waiting.id).is_none() && store.dismiss(waiting.id).is_none());
    store.dismiss(endless.id);
}

#[test]
fn work_is_kept_until_a_worker_takes_it_or_its_job_ends() {
    let handed = |work: (Arc<()>, bool), budget: &Budget| if work.1 { endless(budget) } else { Ok(answer()) };
    let store = JobStore::start(limits(1, 10, 10), handed, |_| {}).unwrap();
    let (taken, dismissed, waits) = (Arc::new(()), Arc::new(()), Arc::new(()));
    let submit = |work: &Arc<()>, endless: bool| {
        let work = (work.clone(), endless);
        store.submit(Submission { work, request: bytes(100, QUICK), name: None, client: String::new(), key: None })
    };
    let first = submit(&taken, true).unwrap();
    until(&store, first.id, running);
    let (second, third) = (submit(&dismissed, false).unwrap(), submit(&waits, false).unwrap());
    store.dismiss(second.id);
    assert_eq!([&dismissed, &waits].map(Arc::strong_count), [1, 2]);
    store.dismiss(first.id);
    until(&store, third.id, ended);
    assert!(store.shutdown(Duration::from_secs(20)) && store.get(third.id).is_some());
    assert_eq!([&taken, &dismissed, &waits].map(Arc::strong_count), [1; 3]);
}

#[test]
fn a_full_queue_refuses_and_loses_nothing() {
    let store = store(1, 3, 100);
    let first = store.submit(order(ENDLESS)).unwrap();
    until(&store, first.id, running);
    let accepted: Vec<_> = (0..3).map(|_| store.submit(order(QUICK)).unwrap().id).collect();
    assert_eq!(store.submit(order(QUICK)).unwrap_err(), Refusal::QueueFull(3));
    store.dismiss(first.id);
    for id in accepted {
        assert_eq!(until(&store, id, ended).status(), Status::Successful);
    }
    assert!(store.submit(order(QUICK)).is_ok());
}

#[test]
fn the_job_that_finished_first_is_forgotten_first() {
    let store = store(1, 100, 2);
    let ids: Vec<_> = (0..5).map(|_| store.submit(order(QUICK)).unwrap().id).collect();
    until(&store, ids[4], ended);
    let kept: Vec<_> = store.list(None, None, 10).iter().map(|job| job.id).collect();
    assert_eq!(kept, [ids[4], ids[3]], "newest first, the oldest three forgotten");
}

#[test]
fn jobs_that_have_not_ended_are_never_forgotten() {
    let store = store(1, 100, 0);
    let first = store.submit(order(ENDLESS)).unwrap();
    let others: Vec<_> = (0..5).map(|_| store.submit(order(QUICK)).unwrap().id).collect();
    assert_eq!(store.list(None, None, 10).len(), 6);
    // Nothing finished is kept here, yet dismissing still answers.
    assert!(matches!(store.dismiss(others[2]), Some(Dismissal::Cancelled(_))));
    assert!(store.get(others[2]).is_none());
    assert_eq!(store.list(None, None, 10).len(), 5);
    store.dismiss(first.id);
}

#[test]
fn the_queue_is_first_in_first_out() {
    let seen = Arc::new(Mutex::new(Vec::new()));
    let log = seen.clone();
    let note = move |order: f64, _: &Budget| {
        log.lock().unwrap().push(order);
        Ok(answer())
    };
    let store = JobStore::start(limits(1, 100, 100), note, |_| {}).unwrap();
    for number in 0..20 {
        store.submit(order(f64::from(number))).unwrap();
    }
    assert!(store.shutdown(Duration::from_secs(20)));
    assert_eq!(*seen.lock().unwrap(), (0..20).map(f64::from).collect::<Vec<_>>());
}

#[test]
fn shutdown_lets_accepted_jobs_end_and_accepts_no_more() {
    let store = store(2, 100, 100);
    let ids: Vec<_> = (0..50).map(|_| store.submit(order(QUICK)).unwrap().id).collect();
    store.close();
    assert_eq!(store.submit(order(QUICK)).unwrap_err(), Refusal::Closed);
    assert!(store.shutdown(Duration::from_secs(20)));
    for id in ids {
        assert_eq!(store.get(id).unwrap().status(), Status::Successful);
    }
}

#[test]
fn shutdown_cancels_what_takes_too_long() {
    let store = store(1, 100, 100);
    let running = store.submit(order(ENDLESS)).unwrap();
    let waiting = store.submit(order(ENDLESS)).unwrap();
    assert!(store.shutdown(Duration::from_millis(20)), "all workers ended");
    for job in [running, waiting] {
        assert_eq!(store.get(job.id).unwrap().status(), Status::Dismissed);
    }
}

#[test]
fn a_second_shutdown_waits_for_nothing() {
    let deaf = |_: f64, _: &Budget| {
        sleep(Duration::from_secs(4));
        Ok(answer())
    };
    let store = JobStore::start(limits(1, 1, 1), deaf, |_| {}).unwrap();
    let job = store.submit(order(QUICK)).unwrap();
    until(&store, job.id, |job| job.status() == Status::Running);
    assert!(!store.shutdown(Duration::ZERO), "this one does not listen");
    let start = Instant::now();
    drop(store);
    assert!(start.elapsed() < Duration::from_secs(1));
}

#[test]
fn jobs_dismissed_at_any_moment_leave_the_workers_whole() {
    let (begun, over) = (Arc::new(AtomicUsize::new(0)), Arc::new(AtomicUsize::new(0)));
    let counters = (begun.clone(), over.clone());
    let counted = move |order: f64, budget: &Budget| {
        counters.0.fetch_add(1, Ordering::SeqCst);
        let result = stand_in(order, budget);
        counters.1.fetch_add(1, Ordering::SeqCst);
        result
    };
    let store = JobStore::start(limits(3, 1000, 1000), counted, |_| {}).unwrap();
    for round in 0..200u64 {
        let job = store.submit(order(ENDLESS)).unwrap();
        sleep(Duration::from_micros(37 * (round % 53)));
        assert!(matches!(store.dismiss(job.id), Some(Dismissal::Cancelled(_))));
    }
    let last: Vec<_> = (0..6).map(|_| store.submit(order(QUICK)).unwrap().id).collect();
    for id in last {
        assert_eq!(until(&store, id, ended).status(), Status::Successful);
    }
    assert!(store.shutdown(Duration::from_secs(20)));
    assert_eq!(begun.load(Ordering::SeqCst), over.load(Ordering::SeqCst));
}

#[test]
fn a_key_names_one_submission() {
    let store = store(1, 100, 100);
    let first = store.submit(keyed(QUICK, "a")).unwrap();
    assert_eq!(store.submit(keyed(QUICK, "a")).unwrap().id, first.id);
    assert_eq!(store.submit(keyed(ERROR, "a")).unwrap_err(), Refusal::KeyTaken(first.id));
    assert_ne!(store.submit(keyed(QUICK, "b")).unwrap().id, first.id);
    until(&store, first.id, ended);
    assert_eq!(store.submit(keyed(QUICK, "a")).unwrap().status(), Status::Successful, "replayed when it has ended");
    store.close();
    assert_eq!(store.submit(keyed(QUICK, "a")).unwrap().id, first.id, "and when nothing more is accepted");
    store.dismiss(first.id);
    assert_eq!(store.submit(keyed(QUICK, "a")).unwrap_err(), Refusal::Closed, "a forgotten job gives its key back");
}

#[test]
fn one_client_cannot_fill_the_queue_of_all() {
    let store = with(Limits { queue_per_client: 2, ..limits(1, 10, 10) });
    let running = store.submit(order(ENDLESS)).unwrap();
    until(&store, running.id, self::running);
    let waiting = [store.submit(order(QUICK)).unwrap(), store.submit(order(QUICK)).unwrap()];
    assert_eq!(store.submit(order(QUICK)).unwrap_err(), Refusal::ClientQueueFull(2));
    let other = Submission { client: "you".to_owned(), ..order(QUICK) };
    assert!(store.submit(other).is_ok());
    store.dismiss(waiting[0].id);
    let last = store.submit(order(QUICK)).unwrap();
    assert_eq!(last.position, Some(3), "counted in the whole queue");
    store.dismiss(running.id);
    until(&store, last.id, ended);
    assert!(store.submit(order(ENDLESS)).is_ok());
}

#[test]
fn what_is_kept_is_bounded_in_bytes() {
    let store = with(Limits { bytes: 3500, ..limits(1, 100, 100) });
    let ids: Vec<_> = (0..5).map(|_| store.submit(order(QUICK)).unwrap().id).collect();
    until(&store, ids[4], ended);
    let kept: Vec<_> = store.list(None, None, 10).iter().map(|job| job.id).collect();
    assert_eq!(kept, [ids[4], ids[3], ids[2]], "three of 1100 bytes fit");
    assert_eq!(store.load().bytes, 3300);
    let large = Submission { request: bytes(3000, ENDLESS), ..order(ENDLESS) };
    let active = store.submit(large).unwrap();
    assert_eq!(store.list(None, None, 10).len(), 2, "the one that ended last stays beside it");
    assert_eq!(
        store.submit(Submission { request: bytes(600, QUICK), ..order(QUICK) }).unwrap_err(),
        Refusal::MemoryFull(3000)
    );
    store.dismiss(active.id);
    assert!(store.submit(Submission { request: bytes(600, QUICK), ..order(QUICK) }).is_ok());
}

#[test]
fn an_answer_larger_than_all_that_is_kept_can_still_be_read() {
    let store = with(Limits { bytes: 500, ..limits(1, 100, 100) });
    let first = store.submit(order(QUICK)).unwrap();
    assert!(matches!(until(&store, first.id, ended).state, JobState::Successful(_)));
    let second = store.submit(order(QUICK)).unwrap();
    until(&store, second.id, ended);
    assert!(store.get(first.id).is_none());
}

#[test]
fn what_is_kept_grows_old() {
    let store = with(Limits { kept_for: Duration::from_millis(100), ..limits(1, 100, 100) });
    let id = store.submit(order(QUICK)).unwrap().id;
    let clock = Instant::now();
    while store.get(id).is_some() {
        assert!(clock.elapsed() < Duration::from_secs(20), "never forgotten");
        sleep(Duration::from_millis(5));
    }
    assert_eq!(store.load().bytes, 0);
}

#[test]
fn a_job_that_takes_too_long_fails() {
    let store = with(Limits { time: Duration::from_millis(30), ..limits(1, 10, 10) });
    let late = store.submit(order(ENDLESS)).unwrap();
    let job = until(&store, late.id, ended);
    assert!(matches!(job.state, JobState::Failed(Failure::Overdue { events, .. }) if events > 0), "{:?}", job.state);
    let next = store.submit(order(QUICK)).unwrap();
    assert_eq!(until(&store, next.id, ended).status(), Status::Successful);
}

#[test]
fn pages_of_the_list_hold_every_job_once() {
    let store = store(1, 100, 100);
    let ids: Vec<_> = (0..7).map(|i| store.submit(order(if i == 3 { ERROR } else { QUICK })).unwrap().id).collect();
    until(&store, ids[6], ended);
    let (mut seen, mut before) = (vec![], None);
    loop {
        let page = store.list(None, before, 3);
        let Some(last) = page.last() else { break };
        before = Some(last.id);
        seen.extend(page.iter().map(|job| job.id));
    }
    assert!(seen.iter().eq(ids.iter().rev()));
    let failed: Vec<_> = store.list(Some(Status::Failed), None, 10).iter().map(|job| job.id).collect();
    assert_eq!(failed, [ids[3]]);
}

#[test]
fn every_end_is_told_once() {
    let told = Arc::new(Mutex::new(Vec::new()));
    let log = told.clone();
    let note = move |job: &Job| log.lock().unwrap().push((job.id, job.status()));
    let store = JobStore::start(limits(2, 1000, 3), stand_in, note).unwrap();
    let endless = store.submit(order(ENDLESS)).unwrap().id;
    let waiting: Vec<_> = (0..200).map(|i| store.submit(order(f64::from(i % 5) / 4.0 * 3.0)).unwrap().id).collect();
    for id in waiting.iter().step_by(3) {
        store.dismiss(*id);
    }
    store.dismiss(endless);
    assert!(store.shutdown(Duration::from_millis(100)));
    let mut told = told.lock().unwrap().clone();
    assert!(told.iter().all(|(_, status)| status.is_final()));
    told.sort_by_key(|(id, _)| *id);
    assert!(told.iter().map(|(id, _)| *id).eq(std::iter::once(endless).chain(waiting)));
}

#[test]
fn those_who_wait_are_told_of_the_end() {
    let store = store(1, 10, 10);
    let job = store.submit(order(ENDLESS)).unwrap();
    let runtime = tokio::runtime::Builder::new_current_thread().enable_time().build().unwrap();
    assert!(!runtime.block_on(async { ended_within(&job, Duration::from_millis(20)).await }));
    store.dismiss(job.id);
    assert!(runtime.block_on(async { ended_within(&job, Duration::from_secs(20)).await }));
}

async fn ended_within(job: &Job, patience: Duration) -> bool {
    tokio::time::timeout(patience, job.progress.ended()).await.is_ok()
}
