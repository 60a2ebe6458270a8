//! What every handler can reach.

use super::answering::perform;
use super::body;
use super::layers::{Hosts, LinkKey, Tokens};
use super::limits::ApiLimits;
use super::metrics::Metrics;
use super::outgoing::Outgoing;
use super::painter::Painter;
use super::quota::Quota;
use super::readers::Readers;
use crate::budget::Budget;
use crate::collapse::{AnalysisError, Answer, Question};
use crate::jobs::{Failure, Job, JobState, Limits, Status, Store, Unavailable, Work, Workers};
use axum::body::Bytes;
use axum::http::HeaderValue;
use std::sync::Arc;
use std::time::Duration;
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
    /// What it signs links with.
    pub links: LinkKey,
    /// The names it goes by.
    pub hosts: Hosts,
    /// Pages of which origins may ask.
    pub origins: Vec<HeaderValue>,
    /// How long jobs may end, and their answers be read, when it is told to stop.
    pub grace: Duration,
    /// What the store takes on, for those who watch it.
    pub store: Limits,
}

/// What one client may have of what all have.
fn part(all: usize) -> usize {
    all.div_ceil(4)
}

/// How a handler is given the service: one for all, which many layers copy for every request.
pub(super) type AppState = axum::extract::State<Arc<Service>>;

/// What every handler can reach.
pub struct Service {
    /// All jobs.
    pub store: Arc<dyn Store>,
    /// Who works them off.
    pub workers: Workers,
    /// Cancelled when the service is to stop: ends event streams.
    pub stopping: CancellationToken,
    pub(super) work: Work,
    pub(super) solve: Solver,
    pub(super) settings: Arc<Settings>,
    pub(super) metrics: Metrics,
    pub(super) streams: Quota,
    pub(super) readers: Readers,
    /// Memory for bodies on their way in, bytes.
    pub(super) incoming: Quota,
    pub(super) outgoing: Outgoing,
    pub(super) painter: Painter,
}

impl Service {
    /// Starts the workers, in the runtime of the caller; of the memory for bodies and answers each client may have a part.
    pub fn start(store: Arc<dyn Store>, work: Work, settings: Settings, solve: Solver) -> Arc<Self> {
        let metrics = Metrics::new(work, &settings);
        let counted = metrics.clone();
        let analyse = move |request: &Bytes, budget: &Budget| perform(request, budget, solve);
        let workers = Workers::start(store.clone(), work, analyse, move |job| ended(&counted, job));
        let (limits, longest) = (settings.limits, settings.limits.body.max(body::LEAST));
        let incoming = limits.incoming.max(longest);
        Arc::new(Service {
            store,
            workers,
            stopping: CancellationToken::new(),
            work,
            solve,
            metrics,
            streams: Quota::new(limits.streams, part(limits.streams)),
            readers: Readers::new(),
            incoming: Quota::new(incoming, part(incoming).max(longest)),
            outgoing: Outgoing::new(limits.outgoing, part(limits.outgoing)),
            painter: Painter::new(),
            settings: Arc::new(settings),
        })
    }

    /// A client is told how a job stands: of one that has failed there is no more to learn.
    pub(super) async fn told(&self, job: &Job) -> Result<(), Unavailable> {
        if job.status() == Status::Failed { self.store.seen(job.id).await } else { Ok(()) }
    }
}

/// Counts and logs the end of a job, wherever it has ended.
pub(super) fn ended(metrics: &Metrics, job: &Job) {
    metrics.ended(job);
    let (id, client, outcome) = (job.id, &*job.client, job.status().word());
    let ms = job.wall_time.map(|time| time.as_secs_f64() * 1e3);
    match &job.state {
        JobState::Failed(Failure::Defect) => tracing::error!(job.id = %id, client, outcome, ms, "ended"),
        JobState::Failed(failure) => tracing::warn!(job.id = %id, client, outcome, ms, %failure, "ended"),
        _ => tracing::info!(job.id = %id, client, outcome, ms, "ended"),
    }
}
