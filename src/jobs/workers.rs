//! Workers: each takes a job, has it analysed, writes down how that ended, and takes the next.

use super::job::{Failure, Job, JobState, Product};
use super::progress::Observer;
use super::resident::Running;
use super::store::{Ending, Lease, Store, Unavailable};
use crate::budget::Budget;
use bytes::Bytes;
use std::sync::Arc;
use std::time::{Duration, Instant};
use tokio::sync::Mutex;
use tokio::task::JoinSet;

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

/// The workers of a process. Each is a task that hands its analysis to a thread of the runtime's blocking pool.
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
            tasks.spawn(live(bench.clone()));
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

/// The life of a worker.
async fn live(bench: Arc<Bench>) {
    loop {
        match bench.store.take().await {
            Ok(Some(lease)) => attend(&bench, lease).await,
            Ok(None) => return,
            Err(Unavailable(reason)) => {
                tracing::warn!(reason, "no store to take jobs from");
                tokio::time::sleep(AGAIN).await;
            }
        }
    }
}

/// Sees a job to its end.
async fn attend(bench: &Arc<Bench>, lease: Lease) {
    let clock = Instant::now();
    let (lease, there) = (Arc::new(lease), bench.clone());
    let leased = lease.clone();
    #[allow(clippy::disallowed_methods, reason = "this is where analyses run; the budget stops them")]
    let analysis = tokio::task::spawn_blocking(move || attempt(&there, &leased));
    // A panic ends the thread's task and nothing else: the answer is built from the request alone and is lost with it.
    let result = analysis.await.unwrap_or(Err(Failure::Defect));
    let (state, product) = match result {
        Ok(product) => (JobState::Successful, product),
        Err(failure) => (JobState::Failed(failure), Product::default()),
    };
    let ending = Ending { state, product, wall_time: clock.elapsed() };
    loop {
        match bench.store.end(&lease, ending.clone()).await {
            Ok(ended) => return ended.iter().for_each(|job| (bench.ended)(job)),
            Err(Unavailable(reason)) => tracing::warn!(job.id = %lease.id, reason, "an answer waits for the store"),
        }
        tokio::time::sleep(AGAIN).await;
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
