//! What the service counts, as Prometheus reads it.

use super::Service;
use super::format::Format;
use super::problem::Problem;
use super::request::Request;
use super::status::word;
use crate::jobs::{Job, Occupancy, Status};
use axum::extract::State;
use axum::http::{HeaderMap, Method, StatusCode, header};
use axum::response::IntoResponse;
use prometheus_client::encoding::EncodeLabelSet;
use prometheus_client::encoding::text::encode;
use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::family::Family;
use prometheus_client::metrics::gauge::Gauge;
use prometheus_client::metrics::histogram::Histogram;
use prometheus_client::registry::{Registry, Unit};
use std::sync::Arc;

/// Upper ends of the histogram of times, s.
const SECONDS: [f64; 13] = [1e-3, 3e-3, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0];

/// Upper ends of the histogram of events.
const EVENTS: [f64; 11] = [1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1e3, 3e3, 1e4, 3e4, 1e5];

#[derive(Debug, Clone, PartialEq, Eq, Hash, EncodeLabelSet)]
struct Answered {
    method: String,
    route: String,
    status: u16,
}

#[derive(Debug, Clone, PartialEq, Eq, Hash, EncodeLabelSet)]
struct OutcomeLabel {
    outcome: &'static str,
}

/// Everything that is counted; copies count together.
#[derive(Debug, Clone)]
pub struct Metrics {
    registry: Arc<Registry>,
    requests: Family<Answered, Counter>,
    jobs: Family<OutcomeLabel, Counter>,
    seconds: Histogram,
    events: Histogram,
    queue: Gauge,
    running: Gauge,
    finished: Gauge,
    bytes: Gauge,
    streams: Gauge,
}

impl Default for Metrics {
    fn default() -> Self {
        let mut registry = Registry::with_prefix("voussoir");
        let metrics = Metrics {
            registry: Arc::default(),
            requests: Family::default(),
            jobs: Family::default(),
            seconds: Histogram::new(SECONDS),
            events: Histogram::new(EVENTS),
            queue: Gauge::default(),
            running: Gauge::default(),
            finished: Gauge::default(),
            bytes: Gauge::default(),
            streams: Gauge::default(),
        };
        registry.register("http_requests", "Requests answered", metrics.requests.clone());
        for status in [Status::Successful, Status::Failed, Status::Dismissed] {
            drop(metrics.jobs.get_or_create(&OutcomeLabel { outcome: word(status) }));
        }
        registry.register("jobs", "Jobs that have ended", metrics.jobs.clone());
        let (seconds, events) = (metrics.seconds.clone(), metrics.events.clone());
        registry.register_with_unit("analysis", "Time a worker spent on a job", Unit::Seconds, seconds);
        registry.register("analysis_events", "Contact events of a job's load paths", events);
        registry.register("queue_length", "Jobs that wait", metrics.queue.clone());
        registry.register("jobs_running", "Jobs in the hands of workers", metrics.running.clone());
        registry.register("jobs_kept", "Jobs that have ended and are kept", metrics.finished.clone());
        registry.register_with_unit("held", "What all jobs cost", Unit::Bytes, metrics.bytes.clone());
        registry.register("event_streams", "Event streams open", metrics.streams.clone());
        Metrics { registry: Arc::new(registry), ..metrics }
    }
}

impl Metrics {
    /// A request was answered; `route` is none where no route knew it.
    pub(super) fn answered(&self, method: &Method, route: Option<String>, status: StatusCode) {
        let known = [Method::GET, Method::HEAD, Method::POST, Method::DELETE, Method::OPTIONS].contains(method);
        let method = if known { method.to_string() } else { "other".to_owned() };
        let route = route.unwrap_or_else(|| "none".to_owned());
        self.requests.get_or_create(&Answered { method, route, status: status.as_u16() }).inc();
    }

    /// A job has ended.
    pub(super) fn ended(&self, job: &Job<Request>) {
        self.jobs.get_or_create(&OutcomeLabel { outcome: word(job.status()) }).inc();
        if let Some(time) = job.wall_time().filter(|_| job.status() != Status::Dismissed) {
            self.seconds.observe(time.as_secs_f64());
            self.events.observe(job.progress.step().map_or(0.0, |step| step.events as f64));
        }
    }

    /// Everything, with the load as it is now.
    fn text(&self, load: Occupancy, streams: usize) -> Result<String, std::fmt::Error> {
        let gauge = |count: usize| i64::try_from(count).unwrap_or(i64::MAX);
        self.queue.set(gauge(load.waiting));
        self.running.set(gauge(load.running));
        self.finished.set(gauge(load.finished));
        self.bytes.set(gauge(load.bytes));
        self.streams.set(gauge(streams));
        let mut text = String::new();
        encode(&mut text, &self.registry)?;
        Ok(text)
    }
}

/// What the service counts.
#[utoipa::path(
    get, path = "/metrics", tag = "service", operation_id = "metrics",
    responses((status = 200, description = "Counters, gauges and histograms in the text format of OpenMetrics",
        content((String = "application/openmetrics-text"), (String = "text/plain"))))
)]
pub(super) async fn metrics(state: State<Service>, headers: HeaderMap) -> Result<impl IntoResponse, Problem> {
    // Prometheus reads the same lines under its older media type, too.
    let format = Format::choose(None, &headers, &[Format::OpenMetrics, Format::Text]).unwrap_or(Format::OpenMetrics);
    let streams = state.limits.streams.saturating_sub(state.streams.available_permits());
    let text = state.metrics.text(state.jobs.load(), streams).map_err(|_| Problem::internal())?;
    Ok(([(header::CONTENT_TYPE, format.content_type())], text))
}
