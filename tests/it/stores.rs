//! What every store of jobs promises, with stand-ins for the mechanics.

mod kept;
mod memory;
mod outgrown;
#[cfg(feature = "postgres")]
mod postgresql;
mod queue;
mod runs;

use std::sync::Arc;
use std::time::{Duration, Instant};
use tokio::runtime::Runtime;
use voussoir::budget::{Budget, LoadStep};
use voussoir::jobs::{
    Failure, Job, JobId, Limits, Memory, Part, Product, Rendering, Status, Store, Submission, Work, Workers,
};

const QUICK: &str = "quick";
const ENDLESS: &str = "endless";
const PANIC: &str = "panic";
const ERROR: &str = "error";

/// Bytes of an answer.
const ANSWER: usize = 100_000;

const PATIENCE: Duration = Duration::from_secs(30);

/// How a test gets its store, empty.
type New<'n> = &'n dyn Fn(Limits) -> Arc<dyn Store>;

/// Every promise, held against every store.
macro_rules! promises {
    ($($module:ident::$name:ident)*) => {
        /// The store in memory.
        mod in_memory {
            $(#[test]
            fn $name() {
                let new = |limits| std::sync::Arc::new(super::Memory::new(limits)) as std::sync::Arc<dyn super::Store>;
                super::within_runtime(super::$module::$name(&new));
            })*
        }

        /// The store in PostgreSQL, every test with a database of its own.
        #[cfg(feature = "postgres")]
        mod in_postgresql {
            $(#[test]
            fn $name() {
                super::within_runtime(super::$module::$name(&super::postgresql::open_new));
            })*
        }
    };
}

promises! {
    runs::a_job_runs_to_its_answer
    runs::a_panic_fails_the_job_and_nothing_else
    runs::an_error_is_kept_with_the_job
    runs::progress_is_seen_and_cancel_is_heard
    runs::a_cancelled_job_stays_until_it_is_forgotten
    runs::a_job_that_takes_too_long_fails
    runs::a_job_that_outgrows_the_process_fails
    runs::those_who_wait_are_told_of_every_change
    runs::every_end_is_told_once
    runs::jobs_dismissed_at_any_moment_leave_the_workers_whole
    queue::a_full_queue_refuses_and_loses_nothing
    queue::one_client_cannot_fill_the_queue_of_all
    queue::clients_take_turns
    queue::what_takes_much_memory_waits_and_others_behind_it
    queue::a_closed_store_accepts_no_more
    queue::pages_of_the_list_hold_every_job_once
    queue::a_list_may_be_of_one_client
    kept::what_was_not_read_is_kept_and_submissions_are_refused
    kept::what_was_read_makes_room_first
    kept::who_holds_most_makes_room_first
    kept::what_is_kept_grows_old
    kept::a_failed_job_is_kept_until_it_was_seen
    kept::a_key_names_one_submission
    kept::a_key_lives_as_long_as_promised
}

/// Runs a test in a runtime, and leaves no analysis behind.
fn within_runtime(test: impl Future<Output = ()>) {
    let runtime = Runtime::new().unwrap();
    runtime.block_on(test);
    runtime.shutdown_background();
}

/// Does what the request says.
fn stand_in(order: &bytes::Bytes, budget: &Budget) -> Result<Product, Failure> {
    match std::str::from_utf8(order).unwrap().trim() {
        ENDLESS => Err(endless(budget)),
        ERROR => Err(failed()),
        PANIC => panic!("asked to panic"),
        _ => Ok(answer()),
    }
}

/// Steps on until told to stop.
#[allow(clippy::disallowed_methods, reason = "stands for an analysis, which runs where it may block")]
fn endless(budget: &Budget) -> Failure {
    let mut step = LoadStep::default();
    while budget.step(step.load_factor, step.events).is_continue() {
        step = LoadStep { load_factor: step.load_factor + 0.5, events: step.events + 1, ..step };
        std::thread::sleep(Duration::from_millis(1));
    }
    Failure::Analysis(budget.stopped().to_string())
}

fn failed() -> Failure {
    Failure::Analysis("asked to fail".to_owned())
}

/// In two parts, and without a third.
fn answer() -> Product {
    let part = |name: &str, body| Rendering {
        names: vec![name.to_owned()],
        format: "json",
        part: Part { body, packed_from: None },
    };
    let of = |bytes: usize| Ok(vec![b' '; bytes].into());
    [part("most", of(ANSWER - 1)), part("rest", of(1)), part("third", Err("not here".to_owned()))].into()
}

/// Room for everything, and nothing promised.
fn limits() -> Limits {
    Limits {
        queue: 1000,
        queue_per_client: 1000,
        kept: 1000,
        kept_for: Duration::from_secs(1000),
        promised: Duration::ZERO,
        keys_for: Duration::from_secs(1000),
        bytes: 1 << 30,
        bytes_per_client: 1 << 30,
        work_memory: 1 << 30,
    }
}

/// So many workers, with all the time and memory they need.
fn work(workers: usize) -> Work {
    Work { workers, time: Duration::from_secs(1000), memory: usize::MAX }
}

fn workers(store: &Arc<dyn Store>, count: usize) -> Workers {
    Workers::start(store.clone(), work(count), stand_in, |_| {})
}

fn order(request: &str) -> Submission {
    Submission { request: request.to_owned().into(), name: None, client: "me".into(), memory: 1000, key: None }
}

fn of(client: &str, request: &str) -> Submission {
    Submission { client: client.into(), ..order(request) }
}

fn keyed(request: &str, key: &str) -> Submission {
    Submission { key: Some(key.to_owned()), ..order(request) }
}

async fn submitted(store: &Arc<dyn Store>, request: &str) -> JobId {
    store.submit(order(request)).await.unwrap().id
}

/// Waits until `done` says so of the job.
async fn until(store: &Arc<dyn Store>, id: JobId, done: impl Fn(&Job) -> bool) -> Job {
    let clock = Instant::now();
    loop {
        let job = store.job(id).await.unwrap().expect("the job is kept");
        if done(&job) {
            return job;
        }
        assert!(clock.elapsed() < PATIENCE, "{:?} for too long", job.status());
        tokio::time::sleep(Duration::from_millis(2)).await;
    }
}

fn ended(job: &Job) -> bool {
    job.status().is_final()
}

fn running(job: &Job) -> bool {
    job.status() == Status::Running
}

/// Waits until a job is forgotten: some make room only when others have ended.
async fn gone(store: &Arc<dyn Store>, id: JobId) {
    let clock = Instant::now();
    while !forgotten(store, id).await {
        assert!(clock.elapsed() < PATIENCE, "never forgotten");
        tokio::time::sleep(Duration::from_millis(5)).await;
    }
}

async fn forgotten(store: &Arc<dyn Store>, id: JobId) -> bool {
    store.job(id).await.unwrap().is_none()
}
