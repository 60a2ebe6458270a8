//! The job store, with stand-ins for the mechanics.
#![cfg(feature = "server")]
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test stops at the first surprise")]
#![allow(clippy::disallowed_methods, reason = "tests wait for jobs by looking again")]

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::sleep;
use std::time::{Duration, Instant};
use voussoir::arch::{Arch, Stone};
use voussoir::collapse::{
    Aim, Analysis, AnalysisError, Answer, CollapseReport, Cost, Direction, Geometry, LoadStep, Mesh, Method, Outcome,
    PlaneModel, Question, Seams, Watch,
};
use voussoir::geometry::Vec2;
use voussoir::jobs::{Dismissal, Failure, Job, JobId, JobStore, Limits, Refusal, State, Status};

/// A question that says what the stand-in is to do.
fn order(what: f64) -> Question {
    let arch =
        Arch { voussoirs: vec![], joints: vec![], abutments: [None; 2], half: false, angle_centre: Vec2::zeros() };
    Question::One(Box::new(Analysis {
        arch,
        stone: Stone::default(),
        plane: PlaneModel::Stress,
        penalty_ratio: what,
        fixed: vec![],
        scaled: vec![],
        direction: Direction::Increase,
        cap: None,
        method: Method::EventPath,
        geometry: Geometry::FirstOrder,
        share: 0.999,
        mesh: Mesh { subblocks: vec![], seams: Seams::Split },
        fields: vec![],
        motion: None,
        aim: Aim::Collapse,
    }))
}

const QUICK: f64 = 0.0;
const ENDLESS: f64 = 1.0;
const PANIC: f64 = 2.0;
const ERROR: f64 = 3.0;

/// What an order says.
fn what(question: &Question) -> f64 {
    match question {
        Question::One(analysis) => analysis.penalty_ratio,
        _ => panic!("no order of ours"),
    }
}

fn stand_in(question: &Question, watch: &mut dyn Watch) -> Result<Answer, AnalysisError> {
    let what = what(question);
    if what == ENDLESS {
        return endless(watch);
    }
    assert!(what != PANIC, "asked to panic");
    if what == ERROR {
        return Err(AnalysisError::NotFinite { what: "asked to fail" });
    }
    Ok(report())
}

/// Steps on until told to stop.
fn endless(watch: &mut dyn Watch) -> Result<Answer, AnalysisError> {
    let mut step = LoadStep { load_factor: 0.0, events: 0 };
    while watch.on_step(&step).is_continue() {
        step = LoadStep { load_factor: step.load_factor + 0.5, events: step.events + 1 };
        sleep(Duration::from_millis(1));
    }
    Err(AnalysisError::Stopped { load_factor: step.load_factor, events: step.events })
}

fn report() -> Answer {
    Answer::One(Box::new(CollapseReport {
        outcome: Outcome::NeverCollapses,
        limit_window: None,
        thrust_range: None,
        end: None,
        other_end: None,
        start: 0.0,
        cap: 1.0,
        share: 0.999,
        near_collapse: None,
        at_unit_load: None,
        at_start: None,
        stress_fields: vec![],
        crushing: None,
        updated: None,
        settlement: None,
        safety: None,
        history: vec![],
        motion: None,
        other_motion: None,
        cost: Cost::default(),
        notes: vec![],
    }))
}

fn store(workers: usize, queue: usize, kept: usize) -> JobStore<&'static str> {
    JobStore::start(Limits { workers, queue, kept }, stand_in).unwrap()
}

/// Waits until `done` says so of the job.
fn until<T: Clone + Send + Sync + 'static>(store: &JobStore<T>, id: JobId, done: impl Fn(&Job<T>) -> bool) -> Job<T> {
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

fn ended<T>(job: &Job<T>) -> bool {
    job.finished.is_some()
}

fn running<T>(job: &Job<T>) -> bool {
    job.status() == Status::Running
}

#[test]
fn a_job_runs_to_its_report() {
    let store = store(1, 10, 10);
    let accepted = store.submit(order(QUICK), "mine").unwrap();
    assert_eq!((accepted.status(), *accepted.attachment), (Status::Accepted, "mine"));
    let job = until(&store, accepted.id, ended);
    assert_eq!(job.state, State::Successful(Arc::new(report())));
    assert!(job.wall_time().is_some());
    assert_eq!(job.id.get_version_num(), 7);
}

#[test]
fn a_panic_fails_the_job_and_nothing_else() {
    let store = store(1, 10, 10);
    let bad = store.submit(order(PANIC), "").unwrap();
    let good = store.submit(order(QUICK), "").unwrap();
    assert_eq!(until(&store, bad.id, ended).state, State::Failed(Failure::Panicked));
    assert_eq!(until(&store, good.id, ended).status(), Status::Successful);
}

#[test]
fn an_error_is_kept_with_the_job() {
    let store = store(1, 10, 10);
    let job = store.submit(order(ERROR), "").unwrap();
    let error = AnalysisError::NotFinite { what: "asked to fail" };
    assert_eq!(until(&store, job.id, ended).state, State::Failed(Failure::Analysis(error)));
}

#[test]
fn progress_is_seen_and_cancel_is_heard() {
    let store = store(1, 10, 10);
    let endless = store.submit(order(ENDLESS), "").unwrap();
    let next = store.submit(order(QUICK), "").unwrap();
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
    let endless = store.submit(order(ENDLESS), "").unwrap();
    let waiting = store.submit(order(QUICK), "").unwrap();
    assert!(matches!(store.dismiss(waiting.id), Some(Dismissal::Cancelled(_))));
    assert!(matches!(store.dismiss(waiting.id), Some(Dismissal::Forgotten)));
    assert!(store.get(waiting.id).is_none() && store.dismiss(waiting.id).is_none());
    store.dismiss(endless.id);
}

#[test]
fn a_full_queue_refuses_and_loses_nothing() {
    let store = store(1, 3, 100);
    let first = store.submit(order(ENDLESS), "").unwrap();
    until(&store, first.id, running);
    let accepted: Vec<_> = (0..3).map(|_| store.submit(order(QUICK), "").unwrap().id).collect();
    assert_eq!(store.submit(order(QUICK), "").unwrap_err(), Refusal::QueueFull(3));
    store.dismiss(first.id);
    for id in accepted {
        assert_eq!(until(&store, id, ended).status(), Status::Successful);
    }
    assert!(store.submit(order(QUICK), "").is_ok());
}

#[test]
fn the_job_that_finished_first_is_forgotten_first() {
    let store = store(1, 100, 2);
    let ids: Vec<_> = (0..5).map(|_| store.submit(order(QUICK), "").unwrap().id).collect();
    until(&store, ids[4], ended);
    let kept: Vec<_> = store.newest(10).iter().map(|job| job.id).collect();
    assert_eq!(kept, [ids[4], ids[3]], "newest first, the oldest three forgotten");
}

#[test]
fn jobs_that_have_not_ended_are_never_forgotten() {
    let store = store(1, 100, 0);
    let first = store.submit(order(ENDLESS), "").unwrap();
    let others: Vec<_> = (0..5).map(|_| store.submit(order(QUICK), "").unwrap().id).collect();
    assert_eq!(store.newest(10).len(), 6);
    // Nothing finished is kept here, yet dismissing still answers.
    assert!(matches!(store.dismiss(others[2]), Some(Dismissal::Cancelled(_))));
    assert!(store.get(others[2]).is_none());
    assert_eq!(store.newest(10).len(), 5);
    store.dismiss(first.id);
}

#[test]
fn the_queue_is_first_in_first_out() {
    let seen = Arc::new(Mutex::new(Vec::new()));
    let log = seen.clone();
    let store = JobStore::start(Limits { workers: 1, queue: 100, kept: 100 }, move |question, _| {
        log.lock().unwrap().push(what(question));
        Ok(report())
    })
    .unwrap();
    for number in 0..20 {
        store.submit(order(f64::from(number)), ()).unwrap();
    }
    assert!(store.shutdown(Duration::from_secs(20)));
    assert_eq!(*seen.lock().unwrap(), (0..20).map(f64::from).collect::<Vec<_>>());
}

#[test]
fn shutdown_lets_accepted_jobs_end_and_accepts_no_more() {
    let store = store(2, 100, 100);
    let ids: Vec<_> = (0..50).map(|_| store.submit(order(QUICK), "").unwrap().id).collect();
    store.close();
    assert_eq!(store.submit(order(QUICK), "").unwrap_err(), Refusal::Closed);
    assert!(store.shutdown(Duration::from_secs(20)));
    for id in ids {
        assert_eq!(store.get(id).unwrap().status(), Status::Successful);
    }
}

#[test]
fn shutdown_cancels_what_takes_too_long() {
    let store = store(1, 100, 100);
    let running = store.submit(order(ENDLESS), "").unwrap();
    let waiting = store.submit(order(ENDLESS), "").unwrap();
    assert!(store.shutdown(Duration::from_millis(20)), "all workers ended");
    for job in [running, waiting] {
        assert_eq!(store.get(job.id).unwrap().status(), Status::Dismissed);
    }
}

#[test]
fn a_second_shutdown_waits_for_nothing() {
    let analyse = |_: &Question, _: &mut dyn Watch| {
        sleep(Duration::from_secs(4));
        Ok(report())
    };
    let store = JobStore::start(Limits { workers: 1, queue: 1, kept: 1 }, analyse).unwrap();
    store.submit(order(QUICK), ()).unwrap();
    sleep(Duration::from_millis(50));
    assert!(!store.shutdown(Duration::ZERO), "this one does not listen");
    let start = Instant::now();
    drop(store);
    assert!(start.elapsed() < Duration::from_secs(1));
}

#[test]
fn jobs_dismissed_at_any_moment_leave_the_workers_whole() {
    let (begun, over) = (Arc::new(AtomicUsize::new(0)), Arc::new(AtomicUsize::new(0)));
    let counters = (begun.clone(), over.clone());
    let store = JobStore::start(Limits { workers: 3, queue: 1000, kept: 1000 }, move |question, watch| {
        counters.0.fetch_add(1, Ordering::SeqCst);
        let result = stand_in(question, watch);
        counters.1.fetch_add(1, Ordering::SeqCst);
        result
    })
    .unwrap();
    for round in 0..200u64 {
        let job = store.submit(order(ENDLESS), ()).unwrap();
        sleep(Duration::from_micros(37 * (round % 53)));
        assert!(matches!(store.dismiss(job.id), Some(Dismissal::Cancelled(_))));
    }
    let last: Vec<_> = (0..6).map(|_| store.submit(order(QUICK), ()).unwrap().id).collect();
    for id in last {
        assert_eq!(until(&store, id, ended).status(), Status::Successful);
    }
    assert!(store.shutdown(Duration::from_secs(20)));
    assert_eq!(begun.load(Ordering::SeqCst), over.load(Ordering::SeqCst));
}
