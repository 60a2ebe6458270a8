//! What every handler can reach.

use super::body;
use super::layers::{Hosts, Tokens};
use super::limits::ApiLimits;
use super::metrics::Metrics;
use super::outgoing::Outgoing;
use super::quota::Quota;
use super::readers::Readers;
use crate::budget::Budget;
use crate::collapse::{AnalysisError, Answer, Question};
use crate::jobs::{self, Failure, JobStore, Product};
use crate::wire::rendering::renderings;
use crate::wire::request::Request;
use crate::wire::translate;
use axum::http::HeaderValue;
use std::io;
use std::sync::Arc;
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
    /// The names it goes by.
    pub hosts: Hosts,
    /// Pages of which origins may ask.
    pub origins: Vec<HeaderValue>,
}

/// What one client may have of what all have.
fn part(all: usize) -> usize {
    all.div_ceil(4)
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
    pub(super) readers: Readers,
    /// Memory for bodies on their way in, bytes.
    pub(super) incoming: Quota,
    pub(super) outgoing: Outgoing,
}

impl Service {
    /// Starts the workers; of the memory for bodies and answers each client may have a part.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn start(jobs: jobs::Limits, settings: Settings, analyse: Solver) -> io::Result<Self> {
        let metrics = Metrics::default();
        let counted = metrics.clone();
        let work = move |request: Request, budget: &Budget| perform(&request, budget, analyse);
        let jobs = JobStore::start(jobs, work, move |job| counted.ended(job))?;
        let (limits, longest) = (settings.limits, settings.limits.body.max(body::LEAST));
        let incoming = limits.incoming.max(longest);
        Ok(Service {
            jobs: Arc::new(jobs),
            stopping: CancellationToken::new(),
            metrics,
            streams: Arc::new(Semaphore::new(limits.streams)),
            readers: Readers::new(),
            incoming: Quota::new(incoming, part(incoming).max(longest)),
            outgoing: Outgoing::new(limits.outgoing, part(limits.outgoing)),
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
