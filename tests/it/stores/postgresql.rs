//! What only a store that processes share does. Every store here stands for a process.

use super::{ANSWER, ENDLESS, PATIENCE, QUICK, answer, limits, order, submitted, workers};
use super::{ended, running, stand_in, until, within_runtime, work};
use crate::common::database::database;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use tokio::time::{sleep, timeout};
use voussoir::budget::Budget;
use voussoir::jobs::{Cancelled, Ending, Failure, JobState, Limits, Postgres, Status, Store, Submission, Workers};

/// How long a worker has its job when nothing is heard of it: longer than any test, and shorter.
const LONG: Duration = Duration::from_secs(1000);
const BRIEF: Duration = Duration::from_millis(500);

/// A store with the tables of this database, where nobody is held for lost.
fn open(url: &str, limits: Limits) -> Arc<dyn Store> {
    open_for(LONG, url, limits)
}

/// A store with the tables of this database.
fn open_for(lease: Duration, url: &str, limits: Limits) -> Arc<dyn Store> {
    let connect = Postgres::connect(url, limits, lease);
    let store = tokio::task::block_in_place(|| tokio::runtime::Handle::current().block_on(connect));
    Arc::new(store.unwrap())
}

/// A store with tables of its own.
pub(super) fn open_new(limits: Limits) -> Arc<dyn Store> {
    open(&database(), limits)
}

/// Two stores with the same tables.
fn pair() -> [Arc<dyn Store>; 2] {
    let url = database();
    [open(&url, limits()), open(&url, limits())]
}

fn success() -> Ending {
    Ending { state: JobState::Successful, product: answer(), wall_time: Duration::from_millis(1) }
}

#[test]
fn what_one_process_accepts_another_ends_and_a_third_reads() {
    within_runtime(async {
        let url = database();
        let [front, back, other] = [(); 3].map(|()| open(&url, limits()));
        let _workers = workers(&back, 1);
        let id = submitted(&front, QUICK).await;
        let job = timeout(PATIENCE, async {
            let mut known = Status::Accepted;
            while !known.is_final() {
                known = other.wait(id, known).await.unwrap().unwrap().status();
            }
            other.job(id).await.unwrap().unwrap()
        });
        assert_eq!(job.await.unwrap().state, JobState::Successful);
        assert_eq!(other.part(id, "most", "json").await.unwrap().unwrap(), answer()[0].part);
        assert_eq!(front.occupancy().await.unwrap(), other.occupancy().await.unwrap());
    });
}

#[test]
fn progress_and_a_wish_to_cancel_cross_processes() {
    within_runtime(async {
        let [front, back] = pair();
        let workers = workers(&back, 1);
        let id = submitted(&front, ENDLESS).await;
        until(&front, id, |job| job.progress.is_some_and(|step| step.events > 2)).await;
        assert!(matches!(front.cancel(id).await.unwrap(), Some(Cancelled::Now(_))));
        back.close();
        timeout(PATIENCE, workers.idle()).await.expect("the analysis elsewhere has stopped");
    });
}

#[test]
fn a_job_is_never_taken_twice() {
    within_runtime(async {
        let url = database();
        let stores = [(); 3].map(|()| open(&url, limits()));
        let runs = Arc::new(AtomicUsize::new(0));
        let count = |runs: Arc<AtomicUsize>| {
            move |_: &bytes::Bytes, _: &Budget| {
                runs.fetch_add(1, Ordering::SeqCst);
                Ok(answer())
            }
        };
        let start = |store: &Arc<dyn Store>| Workers::start(store.clone(), work(3), count(runs.clone()), |_| {});
        let _workers = stores.each_ref().map(start);
        let mut ids = vec![];
        for place in 0..150 {
            ids.push(submitted(&stores[place % 3], QUICK).await);
        }
        for id in ids {
            assert_eq!(until(&stores[0], id, ended).await.status(), Status::Successful);
        }
        assert_eq!(runs.load(Ordering::SeqCst), 150);
        let occupancy = stores[0].occupancy().await.unwrap();
        assert_eq!((occupancy.waiting, occupancy.running, occupancy.finished), (0, 0, 150));
    });
}

#[test]
fn a_lost_worker_s_job_is_run_again_and_its_answer_comes_too_late() {
    within_runtime(async {
        let url = database();
        // This process takes a job, and from then on nothing is heard of it.
        let lost = open_for(BRIEF, &url, limits());
        let id = submitted(&lost, QUICK).await;
        let lease = lost.take().await.unwrap().unwrap();
        tokio::task::block_in_place(|| stop_the_beat(&url));
        let store = open_for(BRIEF, &url, limits());
        let workers = workers(&store, 1);
        let job = until(&store, id, ended).await;
        assert_eq!(job.status(), Status::Successful);
        assert!(job.finished.unwrap().duration_since(job.created).unwrap() > BRIEF / 2, "the lease had to run out");
        let failed = Ending { state: JobState::Failed(Failure::Defect), ..success() };
        assert!(lost.end(&lease, failed).await.unwrap().is_none(), "it is not this worker's any more");
        assert_eq!(store.job(id).await.unwrap().unwrap().state, JobState::Successful);
        store.close();
        timeout(PATIENCE, workers.idle()).await.unwrap();
    });
}

/// Makes every lease that holds just now another worker's, as if it had run out while its worker was asleep.
fn stop_the_beat(url: &str) {
    let taken = "UPDATE jobs SET lease = gen_random_uuid() WHERE status = 1";
    let done = std::process::Command::new("psql").args(["-q", "-c", taken, url]).status().unwrap();
    assert!(done.success());
}

#[test]
fn a_job_that_costs_every_worker_its_life_fails() {
    within_runtime(async {
        let url = database();
        let store = open_for(BRIEF, &url, limits());
        let id = submitted(&store, QUICK).await;
        for _ in 0..5 {
            let lease = timeout(PATIENCE, store.take()).await.unwrap().unwrap().unwrap();
            assert_eq!(lease.id, id);
            tokio::task::block_in_place(|| stop_the_beat(&url));
        }
        let job = until(&store, id, ended).await;
        assert_eq!(job.state, JobState::Failed(Failure::Lost { workers: 5 }));
    });
}

#[test]
fn a_process_that_stops_gives_its_jobs_back_at_once() {
    within_runtime(async {
        let url = database();
        let limits = || Limits { work_memory: 1 << 30, ..limits() };
        let first = open(&url, limits());
        let workers_of_first = workers(&first, 1);
        let (id, waiting) = (submitted(&first, ENDLESS).await, submitted(&first, QUICK).await);
        until(&first, id, running).await;
        first.close();
        assert!(first.abandon().await.is_empty(), "nobody's job is dismissed");
        timeout(PATIENCE, workers_of_first.idle()).await.unwrap();
        let second = open(&url, limits());
        assert_eq!(second.job(id).await.unwrap().unwrap().status(), Status::Accepted);
        let runs = move |request: &bytes::Bytes, budget: &Budget| match &request[..] {
            b"endless" => Ok(answer()),
            _ => stand_in(request, budget),
        };
        let _workers = Workers::start(second.clone(), work(1), runs, |_| {});
        for id in [id, waiting] {
            assert_eq!(until(&second, id, ended).await.status(), Status::Successful);
        }
    });
}

#[test]
fn what_is_kept_outlives_all_processes() {
    let url = database();
    let mut id = None;
    within_runtime(async {
        let store = open(&url, limits());
        let _workers = workers(&store, 1);
        let key = Submission { key: Some("a".to_owned()), ..order(QUICK) };
        id = Some(store.submit(key).await.unwrap().id);
        until(&store, id.unwrap(), ended).await;
    });
    within_runtime(async {
        let store = open(&url, limits());
        assert_eq!(store.part(id.unwrap(), "rest", "json").await.unwrap().unwrap(), answer()[1].part);
        let key = Submission { key: Some("a".to_owned()), ..order(QUICK) };
        assert_eq!(store.submit(key).await.unwrap().id, id.unwrap());
        assert!(store.occupancy().await.unwrap().bytes > ANSWER);
    });
}

#[test]
fn what_postgresql_cannot_write_is_written_otherwise() {
    within_runtime(async {
        let store = open_new(limits());
        let named = Submission { name: Some("a\0b".to_owned()), ..order(QUICK) };
        let job = store.submit(named).await.unwrap();
        assert_eq!(job.name.as_deref(), Some("a\u{fffd}b"));
        let lease = store.take().await.unwrap().unwrap();
        let failure = Failure::Analysis("\0".to_owned());
        let ending = Ending { state: JobState::Failed(failure.clone()), ..success() };
        assert_eq!(store.end(&lease, ending).await.unwrap().unwrap().state, JobState::Failed(failure));
    });
}

/// Has the database refuse everybody for so long.
#[allow(clippy::disallowed_methods, reason = "an outage lasts a while")]
fn shut_out(url: &str, time: Duration) {
    let name = url.split(['/', '?']).nth(3).unwrap();
    let psql = |sql: &str| {
        let other = url.replace(name, "postgres");
        let done = std::process::Command::new("psql").args(["-q", "-o", "/dev/null", "-c", sql, &other]).status();
        assert!(done.unwrap().success());
    };
    psql(&format!("ALTER DATABASE {name} ALLOW_CONNECTIONS false"));
    psql(&format!("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE datname = '{name}'"));
    std::thread::sleep(time);
    psql(&format!("ALTER DATABASE {name} ALLOW_CONNECTIONS true"));
}

#[test]
#[allow(clippy::disallowed_methods, reason = "stands for an analysis, which runs where it may block")]
fn an_outage_longer_than_a_lease_costs_no_job_its_worker() {
    within_runtime(async {
        let url = database();
        let stores = [(); 2].map(|()| open_for(BRIEF, &url, limits()));
        let (runs, over) = (Arc::new(AtomicUsize::new(0)), Arc::new(AtomicBool::new(false)));
        let counters = (runs.clone(), over.clone());
        let analyse = move |_: &bytes::Bytes, budget: &Budget| {
            counters.0.fetch_add(1, Ordering::SeqCst);
            while !counters.1.load(Ordering::SeqCst) {
                if budget.step(0.0, 1).is_break() {
                    return Err(Failure::Analysis(budget.stopped().to_string()));
                }
                std::thread::sleep(Duration::from_millis(1));
            }
            Ok(answer())
        };
        let _workers = stores.each_ref().map(|store| Workers::start(store.clone(), work(1), analyse.clone(), |_| {}));
        let id = submitted(&stores[0], QUICK).await;
        until(&stores[0], id, running).await;
        tokio::task::block_in_place(|| shut_out(&url, 3 * BRIEF));
        let clock = Instant::now();
        while stores[0].job(id).await.is_err() {
            assert!(clock.elapsed() < PATIENCE, "the database is back");
        }
        // Time enough for whoever would hold the worker for lost.
        sleep(4 * BRIEF).await;
        over.store(true, Ordering::SeqCst);
        assert_eq!(until(&stores[1], id, ended).await.status(), Status::Successful);
        assert_eq!(runs.load(Ordering::SeqCst), 1, "nobody else had to begin again");
    });
}

#[test]
fn without_its_database_a_store_says_so_and_comes_back() {
    within_runtime(async {
        let url = database();
        let store = open(&url, limits());
        let id = submitted(&store, QUICK).await;
        let hang_up = "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE datname = current_database()
            AND pid <> pg_backend_pid()";
        for _ in 0..3 {
            let done = tokio::task::block_in_place(|| {
                std::process::Command::new("psql")
                    .args(["-q", "-o", "/dev/null", "-c", hang_up, &url])
                    .status()
                    .unwrap()
            });
            assert!(done.success());
            sleep(Duration::from_millis(50)).await;
        }
        // A connection that was cut may fail once.
        let _ = store.job(id).await;
        let _workers = workers(&store, 1);
        assert_eq!(until(&store, id, ended).await.status(), Status::Successful);
        let nowhere = Postgres::connect("postgres://nobody@127.0.0.1:1/nothing", limits(), LONG).await;
        assert!(nowhere.is_err());
    });
}
