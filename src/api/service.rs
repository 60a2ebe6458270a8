//! What every handler can reach.

use super::body::Aside;
use super::layers::Tokens;
use super::limits::ApiLimits;
use super::metrics::Metrics;
use super::outgoing::Outgoing;
use super::request::Request;
use super::response::{JobResult, weight};
use super::translate;
use crate::budget::Budget;
use crate::collapse::{AnalysisError, Answer, Question};
use crate::jobs::{self, Failure, JobStore, Product};
use axum::http::HeaderValue;
use std::io;
use std::sync::Arc;
use tokio::sync::Semaphore;
use tokio_util::sync::CancellationToken;

/// The mechanics, or what stands in for them in a test.
pub type Solver = fn(&Question, &Budget) -> Result<Answer, AnalysisError>;

/// How the interface behaves.
#[derive(Debug, Clone)]
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
    /// All jobs, each with its request.
    pub jobs: Arc<JobStore<Request>>,
    /// Cancelled when the service is to stop: ends event streams.
    pub stopping: CancellationToken,
    pub(super) limits: ApiLimits,
    pub(super) tokens: Tokens,
    pub(super) origins: Vec<HeaderValue>,
    pub(super) metrics: Metrics,
    pub(super) streams: Arc<Semaphore>,
    pub(super) aside: Aside,
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
        let work = move |request: &Request, budget: &Budget| perform(request, budget, analyse);
        let jobs = JobStore::start(jobs, work, move |job| counted.ended(job))?;
        let Settings { limits, tokens, origins } = settings;
        let streams = Arc::new(Semaphore::new(limits.streams));
        let (jobs, stopping) = (Arc::new(jobs), CancellationToken::new());
        let (aside, outgoing) = (Aside::default(), Outgoing::new(limits.outgoing));
        Ok(Service { jobs, stopping, limits, tokens, origins, metrics, streams, aside, outgoing })
    }
}

/// What a worker does with a request. An answer counts as done only if it can be written down, every number finite.
fn perform(request: &Request, budget: &Budget, analyse: Solver) -> Result<Product, Failure> {
    // It was translated when it was accepted, so it can be again; meanwhile only the request had to be kept.
    let question = translate::translate(request).map_err(|_| Failure::Defect)?;
    let answer = analyse(&question, budget)?;
    let result = JobResult::new(request, &answer).ok_or(Failure::Defect)?;
    let bytes = weight(&result).map_err(|_| Failure::Defect)?;
    Ok(Product { answer, bytes })
}
