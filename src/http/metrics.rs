//! What the service counts, as Prometheus reads it.

use super::accept;
use super::problem::Problem;
use super::service::AppState;
use crate::jobs::{Job, Status};
use crate::wire::format::Format;
use axum::http::{HeaderMap, Method, StatusCode, header};
use axum::response::IntoResponse;
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

/// What there is just now.
const GAUGES: [(&str, &str); 5] = [
    ("queue_length", "Jobs that wait"),
    ("jobs_running", "Jobs in the hands of workers"),
    ("jobs_kept", "Jobs that have ended and are kept"),
    ("held_bytes", "What requests and answers of all jobs take"),
    ("event_streams", "Event streams open"),
];

/// Method, route and status of an answer.
type Answered = [(&'static str, String); 3];

/// How a job has ended.
type Outcome = [(&'static str, &'static str); 1];

/// Everything that is counted; copies count together.
#[derive(Debug, Clone)]
pub struct Metrics {
    registry: Arc<Registry>,
    requests: Family<Answered, Counter>,
    jobs: Family<Outcome, Counter>,
    seconds: Histogram,
    events: Histogram,
    gauges: [Gauge; 5],
}

impl Default for Metrics {
    fn default() -> Self {
        let mut registry = Registry::with_prefix("voussoir");
        let (requests, jobs, gauges) = (Family::default(), Family::default(), <[Gauge; 5]>::default());
        let (seconds, events) = (Histogram::new(SECONDS), Histogram::new(EVENTS));
        registry.register("http_requests", "Requests answered", Family::clone(&requests));
        for status in [Status::Successful, Status::Failed, Status::Dismissed] {
            drop(Family::<Outcome, Counter>::get_or_create(&jobs, &[("outcome", status.word())]));
        }
        registry.register("jobs", "Jobs that have ended", jobs.clone());
        registry.register_with_unit("analysis", "Time a worker spent on a job", Unit::Seconds, seconds.clone());
        registry.register("analysis_events", "Contact events of a job's load paths", events.clone());
        for ((name, help), gauge) in GAUGES.into_iter().zip(&gauges) {
            registry.register(name, help, gauge.clone());
        }
        Metrics { registry: Arc::new(registry), requests, jobs, seconds, events, gauges }
    }
}

impl Metrics {
    /// A request was answered; `route` is none where no route knew it.
    pub(super) fn answered(&self, method: &Method, route: Option<String>, status: StatusCode) {
        let known = [Method::GET, Method::HEAD, Method::POST, Method::DELETE, Method::OPTIONS].contains(method);
        let method = if known { method.as_str() } else { "other" };
        let route = route.unwrap_or_else(|| "none".to_owned());
        let labels = [("method", method.to_owned()), ("route", route), ("status", status.as_u16().to_string())];
        self.requests.get_or_create(&labels).inc();
    }

    /// A job has ended.
    pub(super) fn ended(&self, job: &Job) {
        self.jobs.get_or_create(&[("outcome", job.status().word())]).inc();
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
    let (load, streams) = (
        state.store.occupancy().await?,
        state.settings.limits.streams.saturating_sub(state.streams.available_permits()),
    );
    let counts = [load.waiting, load.running, load.finished, load.bytes, streams];
    for (gauge, count) in state.metrics.gauges.iter().zip(counts) {
        gauge.set(i64::try_from(count).unwrap_or(i64::MAX));
    }
    let mut text = String::new();
    encode(&mut text, &state.metrics.registry).map_err(|_| Problem::internal())?;
    Ok(([(header::CONTENT_TYPE, format.content_type())], text))
}
