//! Workers: each takes a job, has it analysed, writes down how that ended, and takes the next.

use super::job::{Failure, Job, JobState, Product};
use super::progress::Observer;
use super::resident::Running;
use super::store::{Ending, Lease, Store, Unavailable};
use crate::budget::Budget;
use bytes::Bytes;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};
use tokio::runtime::Handle;
use tokio::sync::{Mutex, oneshot};
use tokio::task::JoinSet;
use tokio::time::sleep;

/// What is done with a request, until the [`Budget`] says stop.
pub type Analyse = dyn Fn(&Bytes, &Budget) -> Result<Product, Failure> + Send + Sync;

/// Told of every job that ended here.
pub type Ended = dyn Fn(&Job) + Send + Sync;

/// Time between two tries to reach a store.
const AGAIN: Duration = Duration::from_secs(1);

/// How jobs are worked off.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Work {
    /// Jobs worked on at once.
    pub workers: usize,
    /// How long a worker may be at one job.
    pub time: Duration,
    /// Memory of the process beyond which the largest analysis is stopped, bytes.
    pub memory: usize,
}

/// What all workers share.
struct Bench {
    store: Arc<dyn Store>,
    /// How long one may be at a job.
    time: Duration,
    running: Running,
    analyse: Box<Analyse>,
    ended: Box<Ended>,
}

/// The workers of a process, each on a thread of its own: it need not hand jobs over, and the memory that one analysis gives back
/// is at hand for the next.
pub struct Workers {
    bench: Arc<Bench>,
    tasks: Mutex<JoinSet<()>>,
}

impl Workers {
    /// Starts them, in the runtime of the caller.
    pub fn start(
        store: Arc<dyn Store>,
        work: Work,
        analyse: impl Fn(&Bytes, &Budget) -> Result<Product, Failure> + Send + Sync + 'static,
        ended: impl Fn(&Job) + Send + Sync + 'static,
    ) -> Self {
        let Work { workers, time, memory } = work;
        let running = Running::new(memory);
        let bench = Arc::new(Bench { store, time, running, analyse: Box::new(analyse), ended: Box::new(ended) });
        let mut tasks = JoinSet::new();
        for _ in 0..workers {
            tasks.spawn(employ(bench.clone()));
        }
        Workers { bench, tasks: Mutex::new(tasks) }
    }

    /// Returns when all workers have gone home: the store is closed and nothing waits.
    pub async fn idle(&self) {
        while self.tasks.lock().await.join_next().await.is_some() {}
    }

    /// Stops what has not ended.
    pub async fn abandon(&self) {
        for job in self.bench.store.abandon().await {
            (self.bench.ended)(&job);
        }
    }
}

/// Sees a worker through its life, on a thread of its own. Where the runtime ends before, so does the worker, at its next wait.
async fn employ(bench: Arc<Bench>) {
    let (mut here, gone) = oneshot::channel::<()>();
    let runtime = Handle::current();
    let life = async move {
        tokio::select! {
            biased;
            _ = gone => {}
            () = live(&bench) => {}
        }
    };
    match thread::Builder::new().name("worker".to_owned()).spawn(move || runtime.block_on(life)) {
        Ok(_) => here.closed().await,
        Err(error) => tracing::error!(%error, "a worker has no thread"),
    }
}

/// The life of a worker.
async fn live(bench: &Bench) {
    loop {
        match bench.store.take().await {
            Ok(Some(lease)) => attend(bench, lease).await,
            Ok(None) => return,
            Err(Unavailable(reason)) => {
                tracing::warn!(reason, "no store to take jobs from");
                sleep(AGAIN).await;
            }
        }
    }
}

/// Sees a job to its end.
async fn attend(bench: &Bench, lease: Lease) {
    let clock = Instant::now();
    // The thread waits for nothing else. A panic ends the analysis and no more: the answer is built from the request alone and is
    // lost with it.
    let result = catch_unwind(AssertUnwindSafe(|| attempt(bench, &lease)));
    let (state, product) = match result.unwrap_or(Err(Failure::Defect)) {
        Ok(product) => (JobState::Successful, product),
        Err(failure) => (JobState::Failed(failure), Product::default()),
    };
    let ending = Ending { state, product, wall_time: clock.elapsed() };
    loop {
        match bench.store.end(&lease, ending.clone()).await {
            Ok(ended) => return ended.iter().for_each(|job| (bench.ended)(job)),
            Err(Unavailable(reason)) => tracing::warn!(job.id = %lease.id, reason, "an answer waits for the store"),
        }
        sleep(AGAIN).await;
    }
}

/// Answers one request.
fn attempt(bench: &Bench, lease: &Lease) -> Result<Product, Failure> {
    let place = bench.running.enter(lease.memory, lease.id);
    let observer = Observer::new(&lease.progress, bench.time, place);
    let see = |step| observer.see(step);
    let budget = Budget::new(&see);
    match (bench.analyse)(&lease.request, &budget) {
        Err(Failure::Analysis(said)) => Err(observer.failure(budget.stopped()).unwrap_or(Failure::Analysis(said))),
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jobs::{Limits, Memory, Submission};
    use std::collections::BTreeSet;
    use std::sync::Mutex;

    #[test]
    fn a_worker_analyses_all_its_jobs_on_one_thread() {
        let (many, long) = (1 << 30, Duration::from_secs(1000));
        let names = Arc::new(Mutex::new(BTreeSet::new()));
        let seen = names.clone();
        let analyse = move |_: &Bytes, _: &Budget| {
            let thread = thread::current();
            seen.lock().unwrap().insert(format!("{:?} {:?}", thread.name(), thread.id()));
            Ok(Product::default())
        };
        tokio::runtime::Runtime::new().unwrap().block_on(async {
            let store: Arc<dyn Store> = Arc::new(Memory::new(Limits::ample()));
            let workers = Workers::start(store.clone(), Work { workers: 2, time: long, memory: many }, analyse, |_| {});
            for _ in 0..50 {
                let (request, client) = (Bytes::new(), "me".into());
                store.submit(Submission { request, name: None, client, memory: 1, key: None }).await.unwrap();
            }
            store.close();
            workers.idle().await;
            assert_eq!(store.occupancy().await.unwrap().finished, 50);
        });
        let names = names.lock().unwrap();
        assert!((1..=2).contains(&names.len()) && names.iter().all(|name| name.contains("worker")), "{names:?}");
    }
}
