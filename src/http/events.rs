//! What becomes of a job, or of many, as server-sent events.
//!
//! Nothing is kept for this: an event's id says what its client has been told, so whoever comes back with the last id seen is told
//! the rest.

mod follower;

use super::jobs::{Known, known, query_fault};
use super::layers::Client;
use super::problem::{Problem, kinds};
use super::quota::Full;
use super::service::{AppState, Service};
use crate::wire::json::NotFinite;
use axum::Extension;
use axum::extract::Query;
use axum::extract::rejection::QueryRejection;
use axum::http::{HeaderMap, HeaderName, Method, StatusCode};
use axum::response::sse::{Event, Sse};
use axum::response::{IntoResponse, Response};
use follower::{Seen, Told, follow};
use futures_util::{Stream, StreamExt, stream};
use std::collections::BTreeSet;
use utoipa::ToSchema;

/// Most jobs that one stream follows.
const MOST_FOLLOWED: usize = 100;

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
        (status = 200, description = "Server-sent events, one every two seconds at least: `status` (data: the status), `step` (data: \
            `job_id`, `wall_time_s`, and the `progress` of the status), `end` (data: the final status), after which the stream ends",
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
    let seen = last_event_id(&headers).and_then(Seen::read);
    let ended = seen.filter(|seen| seen.status.is_final());
    if ended.is_some_and(|seen| seen.status == job.status()) {
        return Ok(StatusCode::NO_CONTENT.into_response());
    }
    // An end that has not come is that of another job.
    let told = follow(state.0.clone(), job, seen.filter(|_| ended.is_none()));
    let events = told.map(|told| told.map(|told| event(&told, &told.seen.write())));
    streamed(&state, &client, events)
}

/// What becomes of many jobs, as it happens. It counts as one stream.
#[utoipa::path(
    get, path = "/v1/events", tag = "jobs", operation_id = "get_events_of_many",
    params(
        ("job" = Vec<String>, Query, min_items = 1, max_items = 100, description = "Ids of jobs, a parameter each; one named twice is \
            followed once"),
        ("last-event-id" = Option<String>, Header, description = "Id of the last event seen of the same jobs: how all stand is told \
            but of those whose end was"),
    ),
    responses(
        (status = 200, description = "Server-sent events as of each of these jobs, every one with its `job_id`; after the last `end` \
            the stream ends", body = StreamEvent, content_type = "text/event-stream"),
        (status = 204, description = "The client has seen all ends"),
    )
)]
pub(super) async fn events_of_many(
    state: AppState,
    Extension(client): Extension<Client>,
    query: Result<Query<Vec<(String, String)>>, QueryRejection>,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let Query(mut query) = query.map_err(|rejection| query_fault(&rejection))?;
    let mut named = BTreeSet::new();
    query.retain(|job| named.insert(job.clone()));
    if !(1..=MOST_FOLLOWED).contains(&query.len()) || query.iter().any(|(name, _)| name != "job") {
        let detail = format!("name 1 to {MOST_FOLLOWED} jobs, as in job=ID&job=ID, and nothing else");
        return Err(Problem::of(kinds::BAD_QUERY, detail));
    }
    // Bits of those whose ends were told.
    let mut ended = last_event_id(&headers).and_then(|id| u128::from_str_radix(id, 16).ok()).unwrap_or(0);
    let mut all = Vec::with_capacity(query.len());
    for (place, (_, id)) in query.iter().enumerate().filter(|(place, _)| ended & (1 << place) == 0) {
        let job = known(&state, &client, &Method::GET, id).await?;
        all.push(Box::pin(follow(state.0.clone(), job, None).map(move |told| (place, told))));
    }
    if all.is_empty() {
        return Ok(StatusCode::NO_CONTENT.into_response());
    }
    let events = stream::select_all(all).map(move |(place, told)| {
        let told = told?;
        ended |= u128::from(told.seen.status.is_final()) << place;
        Ok(event(&told, &format!("{ended:x}")))
    });
    streamed(&state, &client, events)
}

fn last_event_id(headers: &HeaderMap) -> Option<&str> {
    headers.get(LAST_EVENT_ID)?.to_str().ok()
}

fn event(told: &Told, id: &str) -> Event {
    Event::default().event(told.name).id(id).data(&told.data)
}

/// The answer that is a stream, which holds its share of all that may be open.
fn streamed(
    service: &Service,
    client: &Client,
    events: impl Stream<Item = Result<Event, NotFinite>> + Send + 'static,
) -> Result<Response, Problem> {
    if service.stopping.is_cancelled() {
        return Err(Problem::shutting_down());
    }
    let share = service.streams.take(&client.name, 1).map_err(full)?;
    let sse = Sse::new(events.map(move |event| {
        let _held = &share;
        event
    }));
    // Proxies are asked to pass events on as they come.
    Ok(([(HeaderName::from_static("x-accel-buffering"), "no")], sse).into_response())
}

fn full(full: Full) -> Problem {
    match full {
        Full::OfAll => Problem::of(kinds::STREAMS_FULL, "as many event streams are open as may"),
        Full::OfClient => {
            Problem::of(kinds::CLIENT_STREAMS_FULL, "as many event streams of this client are open as may")
        }
    }
}

/// One event of the stream.
#[derive(ToSchema)]
#[allow(dead_code, reason = "describes what is written event by event")]
struct StreamEvent {
    /// `status`, `step` or `end`.
    event: String,
    /// What has been told: what `last-event-id` is to say to go on from here.
    id: String,
    /// JSON: the status, or of a step the job, its progress and its time.
    data: String,
}
