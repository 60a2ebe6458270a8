//! What the service counts, as Prometheus reads it.

use super::accept;
use super::problem::Problem;
use super::problem::kinds::ProblemKind;
use super::service::{AppState, Settings};
use crate::jobs::{Job, Occupancy, Status, Work, resident};
use crate::wire::format::Format;
use axum::http::{HeaderMap, Method, header};
use axum::response::{IntoResponse, Response};
use prometheus_client::encoding::text::encode;
use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::family::Family;
use prometheus_client::metrics::gauge::{ConstGauge, Gauge};
use prometheus_client::metrics::histogram::Histogram;
use prometheus_client::metrics::info::Info;
use prometheus_client::registry::{Registry, Unit};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

/// Upper ends of the histogram of times, s.
const SECONDS: [f64; 13] = [1e-3, 3e-3, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0];

/// Upper ends of the histogram of events.
const EVENTS: [f64; 11] = [1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1e3, 3e3, 1e4, 3e4, 1e5];

/// What there is just now.
const GAUGES: [(&str, &str); 7] = [
    ("queue_length", "Jobs that wait"),
    ("jobs_running", "Jobs in the hands of workers"),
    ("jobs_kept", "Jobs that have ended and are kept"),
    ("jobs_unread", "Of these, jobs that are promised to be kept, since nobody has read their results"),
    ("held_bytes", "What requests, answers and keys take"),
    ("event_streams", "Event streams open"),
    ("process_resident_memory_bytes", "Memory of the process, where the system tells it"),
];

/// Method, route and status of an answer.
type Answered = [(&'static str, String); 3];

/// One label with its value.
type Label = [(&'static str, &'static str); 1];

/// Everything that is counted; copies count together.
#[derive(Debug, Clone)]
pub struct Metrics {
    registry: Arc<Registry>,
    requests: Family<Answered, Counter>,
    latency: Histogram,
    refusals: Family<Label, Counter>,
    jobs: Family<Label, Counter>,
    waits: Histogram,
    seconds: Histogram,
    events: Histogram,
    evictions: Counter,
    gauges: [Gauge; 7],
}

/// Limits, which do not change.
fn limits(work: Work, settings: &Settings) -> [(&'static str, &'static str, usize); 13] {
    let Settings { limits: api, store, .. } = settings;
    let seconds = usize::try_from(work.time.as_secs()).unwrap_or(usize::MAX);
    [
        ("workers", "Jobs that this process works on at once", work.workers),
        ("queue_length_limit", "Jobs that may wait", store.queue),
        ("client_queue_length_limit", "Jobs of one client that may wait", store.queue_per_client),
        ("jobs_kept_limit", "Jobs that have ended and may be kept", store.kept),
        ("held_limit_bytes", "What requests, answers and keys may take", store.bytes),
        ("client_held_limit_bytes", "What those of one client may take", store.bytes_per_client),
        ("work_memory_limit_bytes", "What analyses may take together, as estimated", store.work_memory),
        (
            "process_memory_limit_bytes",
            "Memory of the process beyond which its largest analysis is stopped",
            work.memory,
        ),
        ("analysis_limit_seconds", "Time that a worker may be at one job", seconds),
        ("event_streams_limit", "Event streams that may be open", api.streams),
        ("body_limit_bytes", "Longest body", api.body),
        ("bodies_limit_bytes", "Bodies that may be on their way at once", api.incoming),
        ("answers_limit_bytes", "Answers that may be on their way at once", api.outgoing),
    ]
}

impl Metrics {
    /// Nothing is counted yet.
    pub(super) fn new(work: Work, settings: &Settings) -> Self {
        let mut registry = Registry::with_prefix("voussoir");
        let (requests, refusals, jobs) = (Family::default(), Family::default(), Family::default());
        let [latency, waits, seconds] = [SECONDS; 3].map(Histogram::new);
        let (events, evictions, gauges) = (Histogram::new(EVENTS), Counter::default(), <[Gauge; 7]>::default());
        let build = Info::new([("version", env!("CARGO_PKG_VERSION"))]);
        registry.register("build", "The program", build);
        registry.register("http_requests", "Requests answered", Family::clone(&requests));
        let told = "Time from a request's head to the head of its answer";
        registry.register_with_unit("http_request", told, Unit::Seconds, latency.clone());
        registry.register("refusals", "Problems answered, by the last word of their type", Family::clone(&refusals));
        registry.register_with_unit("queue_wait", "Time that jobs waited for a worker", Unit::Seconds, waits.clone());
        registry.register("evictions", "Finished jobs that had to make room for others", evictions.clone());
        for status in [Status::Successful, Status::Failed, Status::Dismissed] {
            drop(Family::<Label, Counter>::get_or_create(&jobs, &[("outcome", status.word())]));
        }
        registry.register("jobs", "Jobs that have ended", jobs.clone());
        registry.register_with_unit("analysis", "Time a worker spent on a job", Unit::Seconds, seconds.clone());
        registry.register("analysis_events", "Contact events of a job's load paths", events.clone());
        for ((name, help), gauge) in GAUGES.into_iter().zip(&gauges) {
            registry.register(name, help, gauge.clone());
        }
        for (name, help, limit) in limits(work, settings) {
            registry.register(name, help, ConstGauge::new(i64::try_from(limit).unwrap_or(i64::MAX)));
        }
        let registry = Arc::new(registry);
        Metrics { registry, requests, latency, refusals, jobs, waits, seconds, events, evictions, gauges }
    }

    /// A request was answered; `route` is none where no route knew it.
    pub(super) fn answered(&self, method: &Method, route: Option<String>, response: &Response, latency: Duration) {
        if let Some(ProblemKind { uri, .. }) = response.extensions().get() {
            let named = uri.strip_prefix("about:").map(|_| *uri).or_else(|| uri.rsplit([':', '/']).next());
            let word = named.unwrap_or_default();
            self.refusals.get_or_create(&[("reason", word)]).inc();
        }
        self.latency.observe(latency.as_secs_f64());
        let status = response.status();
        let known = [Method::GET, Method::HEAD, Method::POST, Method::DELETE, Method::OPTIONS].contains(method);
        let method = if known { method.as_str() } else { "other" };
        let route = route.unwrap_or_else(|| "none".to_owned());
        let labels = [("method", method.to_owned()), ("route", route), ("status", status.as_u16().to_string())];
        self.requests.get_or_create(&labels).inc();
    }

    /// A job has ended.
    pub(super) fn ended(&self, job: &Job) {
        self.jobs.get_or_create(&[("outcome", job.status().word())]).inc();
        let wait = job.started.and_then(|started| started.duration_since(job.created).ok());
        self.waits.observe(wait.unwrap_or_default().as_secs_f64());
        if let Some(time) = job.wall_time {
            self.seconds.observe(time.as_secs_f64());
            self.events.observe(job.progress.map_or(0.0, |step| step.events as f64));
        }
    }
}

/// What the service counts.
#[utoipa::path(
    get, path = "/metrics", tag = "service", operation_id = "metrics",
    responses((status = 200, description = "Counters, gauges and histograms in the text format of OpenMetrics",
        content((String = "application/openmetrics-text"), (String = "text/plain"))))
)]
pub(super) async fn metrics(state: AppState, headers: HeaderMap) -> Result<impl IntoResponse, Problem> {
    // Prometheus reads the same lines under its older media type, too.
    let format = accept::choose(None, &headers, &[Format::OpenMetrics, Format::Text]).unwrap_or(Format::OpenMetrics);
    let load = state.store.occupancy().await?;
    let Occupancy { waiting, running, finished, unread, bytes, evicted, .. } = load;
    let memory = resident().unwrap_or_default();
    let counts = [waiting, running, finished, unread, bytes, state.streams.amount(), memory];
    state.metrics.evictions.inner().store(evicted, Ordering::Relaxed);
    for (gauge, count) in state.metrics.gauges.iter().zip(counts) {
        gauge.set(i64::try_from(count).unwrap_or(i64::MAX));
    }
    let mut text = String::new();
    encode(&mut text, &state.metrics.registry).map_err(|_| Problem::internal())?;
    Ok(([(header::CONTENT_TYPE, format.content_type())], text))
}
