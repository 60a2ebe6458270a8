//! What every handler can reach.

use super::layers::Tokens;
use super::limits::ApiLimits;
use super::metrics::Metrics;
use super::outgoing::Outgoing;
use crate::budget::Budget;
use crate::collapse::{AnalysisError, Answer, Question};
use crate::jobs::{self, Failure, JobStore, Product};
use crate::wire::rendering::renderings;
use crate::wire::request::Request;
use crate::wire::translate;
use axum::http::HeaderValue;
use std::io;
use std::num::NonZeroUsize;
use std::sync::Arc;
use std::thread::available_parallelism;
use std::time::Instant;
use tokio::sync::Semaphore;
use tokio_util::sync::CancellationToken;

/// The mechanics, or what stands in for them in a test.
pub type Solver = fn(&Question, &Budget) -> Result<Answer, AnalysisError>;

/// How the interface behaves.
#[derive(Clone)]
pub struct Settings {
    /// How much one request may ask for.
    pub limits: ApiLimits,
    /// Who may ask.
    pub tokens: Tokens,
    /// Pages of which origins may ask.
    pub origins: Vec<HeaderValue>,
}

/// How a handler is given the service.
pub(super) type AppState = axum::extract::State<Service>;

/// What every handler can reach; copies are the same service.
#[derive(Clone)]
pub struct Service {
    /// All jobs. Their requests are kept as bytes, and as they were read until a worker takes them.
    pub jobs: Arc<JobStore<Request>>,
    /// Cancelled when the service is to stop: ends event streams.
    pub stopping: CancellationToken,
    pub(super) settings: Arc<Settings>,
    pub(super) metrics: Metrics,
    pub(super) streams: Arc<Semaphore>,
    /// As many requests are read at once as there are cores.
    pub(super) readers: Arc<Semaphore>,
    pub(super) outgoing: Outgoing,
}

impl Service {
    /// Starts the workers.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn start(jobs: jobs::Limits, settings: Settings, analyse: Solver) -> io::Result<Self> {
        let metrics = Metrics::default();
        let counted = metrics.clone();
        let work = move |request: Request, budget: &Budget| perform(&request, budget, analyse);
        let jobs = JobStore::start(jobs, work, move |job| counted.ended(job))?;
        let cores = available_parallelism().map_or(1, NonZeroUsize::get);
        Ok(Service {
            jobs: Arc::new(jobs),
            stopping: CancellationToken::new(),
            metrics,
            streams: Arc::new(Semaphore::new(settings.limits.streams)),
            readers: Arc::new(Semaphore::new(cores)),
            outgoing: Outgoing::new(settings.limits.outgoing),
            settings: Arc::new(settings),
        })
    }
}

/// What a worker does with a request.
fn perform(request: &Request, budget: &Budget, analyse: Solver) -> Result<Product, Failure> {
    // It was translated when it was accepted, so it can be again. A question may be ten thousand times as large as its request:
    // while the job waited, only the request had to be kept.
    let question = translate::translate(request).map_err(|_| Failure::Defect)?;
    let clock = Instant::now();
    let answer = analyse(&question, budget)?;
    renderings(request, &question, &answer, clock.elapsed())
}
