//! What becomes of a job, as server-sent events.
//!
//! Nothing is kept for this: an event's id says how the job stood, so whoever comes back with the last id seen is told
//! what has changed since.

use super::jobs::Known;
use super::layers::Client;
use super::problem::{Problem, kinds};
use super::quota::{Full, Share};
use super::service::{AppState, Service};
use super::status::JobStatus;
use crate::jobs::{Job, Status};
use crate::wire::json::{NotFinite, compact};
use axum::Extension;
use axum::http::{HeaderMap, HeaderName, StatusCode};
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use futures_util::stream;
use std::time::Duration;
use utoipa::ToSchema;

/// How often a running analysis is looked at.
const LOOK: Duration = Duration::from_millis(200);

/// How often a quiet stream shows that it is alive, and so learns whether its client is.
const ALIVE: Duration = Duration::from_secs(2);

const LAST_EVENT_ID: HeaderName = HeaderName::from_static("last-event-id");

/// What becomes of a job, as it happens.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/events", tag = "jobs", operation_id = "get_events",
    params(
        ("id" = String, Path, format = "uuid", description = "Job id"),
        ("last-event-id" = Option<String>, Header, description = "Id of the last event seen: only what has changed \
            since is told"),
    ),
    responses(
        (status = 200, description = "Server-sent events: `status` (data: the status), `step` (data: load factor and \
            contact events so far), `end` (data: the final status), after which the stream ends",
            body = StreamEvent, content_type = "text/event-stream"),
        (status = 204, description = "The client has seen the end"),
    )
)]
pub(super) async fn events(
    state: AppState,
    Extension(client): Extension<Client>,
    Known(job): Known,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let service = state.0;
    let seen = headers.get(LAST_EVENT_ID).and_then(|id| Seen::read(id.to_str().ok()?));
    let ended = seen.filter(|seen| seen.status.is_final());
    if ended.is_some_and(|seen| seen.status == job.status()) {
        return Ok(StatusCode::NO_CONTENT.into_response());
    }
    if service.stopping.is_cancelled() {
        return Err(Problem::shutting_down());
    }
    let full = |full| match full {
        Full::OfAll => Problem::of(kinds::STREAMS_FULL, "as many event streams are open as may"),
        Full::OfClient => {
            Problem::of(kinds::CLIENT_STREAMS_FULL, "as many event streams of this client are open as may")
        }
    };
    let follower = Follower {
        _share: service.streams.take(&client.name, 1).map_err(full)?,
        job,
        // An end that has not come is that of another job.
        seen: seen.filter(|_| ended.is_none()),
        service,
    };
    let events = stream::unfold(follower, |mut follower| async { Some((follower.next().await?, follower)) });
    let sse = Sse::new(events).keep_alive(KeepAlive::new().interval(ALIVE));
    // Proxies are asked to pass events on as they come.
    Ok(([(HeaderName::from_static("x-accel-buffering"), "no")], sse).into_response())
}

/// One event of the stream.
#[derive(ToSchema)]
#[allow(dead_code, reason = "describes what is written event by event")]
struct StreamEvent {
    /// `status`, `step` or `end`.
    event: String,
    /// How the job stands: what `last-event-id` is to say to go on from here.
    id: String,
    /// JSON: the status, or of a step load factor and contact events.
    data: String,
}

/// How a job stood when a client was last told.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Seen {
    status: Status,
    events: Option<usize>,
}

impl Seen {
    /// As an event's id has it: `running-153`.
    fn write(self) -> String {
        let events = self.events.map(|events| format!("-{events}")).unwrap_or_default();
        format!("{}{events}", self.status.word())
    }

    fn read(id: &str) -> Option<Self> {
        let (name, events) = id.split_once('-').map_or((id, None), |(name, events)| (name, events.parse().ok()));
        let status = Status::ALL.into_iter().find(|status| status.word() == name)?;
        Some(Seen { status, events })
    }
}

/// One client that follows one job.
struct Follower {
    service: Service,
    job: Job,
    seen: Option<Seen>,
    _share: Share,
}

impl Follower {
    /// The next event; none after the end, or when the service stops.
    async fn next(&mut self) -> Option<Result<Event, NotFinite>> {
        if self.seen.is_some_and(|seen| seen.status.is_final()) {
            return None;
        }
        loop {
            let (status, step) = (self.job.status(), self.job.progress);
            let now = Seen { status, events: step.map(|step| step.events) };
            let (name, data) = match self.seen {
                Some(seen) if seen.status == status => {
                    ("step", step.filter(|_| seen != now).map(|step| compact(&step)))
                }
                _ => (if status.is_final() { "end" } else { "status" }, Some(compact(&JobStatus::from(&self.job)))),
            };
            if let Some(data) = data {
                self.seen = Some(now);
                return Some(data.map(|data| Event::default().event(name).id(now.write()).data(data)));
            }
            let (store, id) = (&self.service.store, self.job.id);
            let now = tokio::select! {
                () = self.service.stopping.cancelled() => return None,
                changed = store.wait(id, status) => changed,
                () = tokio::time::sleep(LOOK), if status == Status::Running => store.job(id).await,
            };
            // One that is forgotten, or that nobody can tell of: the client comes back and asks.
            self.job = now.ok().flatten()?;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_id_says_how_the_job_stood() {
        for (status, events) in [(Status::Accepted, None), (Status::Running, Some(0)), (Status::Failed, Some(153))] {
            let seen = Seen { status, events };
            assert_eq!(Seen::read(&seen.write()), Some(seen));
        }
        assert_eq!(Seen::read("something-else"), None);
    }
}
