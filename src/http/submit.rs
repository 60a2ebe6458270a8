//! Handlers that take a request: submit it, or only look it over.

use super::body::{JsonBody, check_syntax};
use super::jobs::{JSON, answer};
use super::layers::Client;
use super::problem::{Problem, kinds};
use super::results;
use super::service::{AppState, Service};
use super::status::{self, JobStatus};
use crate::jobs::{Job, JobId, Status, Submission};
use crate::wire::format::Format;
use crate::wire::json;
use crate::wire::read::Fields;
use crate::wire::rendering;
use crate::wire::request::Request;
use axum::Extension;
use axum::http::{HeaderMap, HeaderName, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use std::time::Duration;
use tokio::time::{Instant, timeout_at};
use utoipa::ToSchema;

/// Longest wait for the end of a job.
const LONGEST_WAIT: Duration = Duration::from_secs(30);

/// Longest idempotency key, characters.
const LONGEST_KEY: usize = 200;

const PREFER: HeaderName = HeaderName::from_static("prefer");
const PREFERENCE_APPLIED: HeaderName = HeaderName::from_static("preference-applied");
const IDEMPOTENCY_KEY: HeaderName = HeaderName::from_static("idempotency-key");

/// Submit an analysis.
#[utoipa::path(
    post, path = "/v1/jobs", tag = "jobs", operation_id = "submit_job",
    params(
        ("prefer" = Option<String>, Header,
            description = "`wait=N`: answer when the job has ended, or after N seconds, 30 at most. With \
                `return=representation` the answer is then the results, if there are any"),
        ("idempotency-key" = Option<String>, Header, min_length = 1, max_length = 200, pattern = "^[!-~]+$",
            description = "A name for this submission: sent again with the same body, it gives the job it named"),
    ),
    request_body(content = Request, content_type = "application/json"),
    responses(
        (status = 201, description = "Accepted; poll the status. The results instead, where they were asked for and are there in \
            time", body = JobStatus, headers(
            ("location" = String, description = "Path of the job's status"),
            ("content-location" = Option<String>, description = "Path of the results, where the body is those"),
            ("preference-applied" = Option<String>, description = "The preferences that were heeded"),
        )),
    )
)]
pub(super) async fn submit(
    state: AppState,
    headers: HeaderMap,
    Extension(client): Extension<Client>,
    body: JsonBody,
) -> Result<Response, Problem> {
    let key = idempotency_key(&headers)?.map(|key| client.scoped(key));
    let name = client.name.clone();
    let submission = read_within(&state, body, move |work, memory| {
        let request = json::line(&work).map_err(Problem::unwritable)?.into();
        Ok(Submission { request, name: work.name().map(str::to_owned), client: client.name, memory, key })
    });
    let job = match state.store.submit(submission.await?).await {
        Ok(job) => job,
        Err(refusal) => return Err(state.refused(refusal).await),
    };
    tracing::Span::current().record("job.id", tracing::field::display(job.id));
    let preferred = Preferred::read(&headers);
    let job = stand_after(&state, job, preferred.wait.unwrap_or_default()).await?;
    state.told(&job).await?;
    let whole = preferred.results && job.status() == Status::Successful;
    let part = if whole { state.store.part(job.id, rendering::WHOLE, Format::Json.name()).await? } else { None };
    let results = part.and_then(|part| Some((part.body.ok()?, part.packed_from)));
    let heeded = preferred.heeded(results.is_some()).and_then(|heeded| heeded.parse().ok());
    let mut response = match results {
        Some((bytes, packed_from)) => {
            let body = results::body(state.outgoing.hold(&name, bytes)?, packed_from, &headers);
            (results_of(job.id), JSON, body).into_response()
        }
        None => answer(&JobStatus::from(&job))?,
    };
    response.headers_mut().extend(heeded.map(|heeded| (PREFERENCE_APPLIED, heeded)));
    Ok((StatusCode::CREATED, [(header::LOCATION, status::path(job.id))], response).into_response())
}

/// The header that says that a body is the results of a job.
fn results_of(id: JobId) -> [(HeaderName, String); 1] {
    [(header::CONTENT_LOCATION, format!("{}/results", status::path(id)))]
}

/// A job as it stands when it has ended, or so long from now.
async fn stand_after(state: &Service, mut job: Job, wait: Duration) -> Result<Job, Problem> {
    let until = Instant::now() + wait;
    while !job.status().is_final() {
        match timeout_at(until, state.store.wait(job.id, job.status())).await {
            Ok(Ok(Some(changed))) => job = changed,
            // Forgotten between two looks: the last one has to do.
            Ok(Ok(None)) => break,
            Ok(Err(reason)) => return Err(reason.into()),
            Err(_) => return Ok(state.store.job(job.id).await?.unwrap_or(job)),
        }
    }
    Ok(job)
}

/// A request that would be accepted.
#[derive(Debug, Serialize, ToSchema)]
pub(super) struct Verdict {
    /// Always true; a faulty request is answered with a problem.
    valid: bool,
    /// The request as it was understood, defaults filled in.
    request: Request,
}

/// Look a request over: the answer of a submission, but nothing is queued.
#[utoipa::path(
    post, path = "/v1/validate", tag = "jobs", operation_id = "validate",
    request_body(content = Request, content_type = "application/json"),
    responses((status = 200, description = "It would be accepted", body = Verdict))
)]
pub(super) async fn validate(state: AppState, body: JsonBody) -> Result<Response, Problem> {
    read_within(&state, body, |request, _| answer(&Verdict { valid: true, request })).await
}

/// Bodies of no more bytes are read here, and translated, too, where that is soon done: to hand one over to another thread takes as long.
const SHORT: usize = 4 << 10;

/// Reads a body and, if this service takes the request, makes something of it. Where that may take a while, others go on meanwhile,
/// and only so many are read at once.
#[allow(clippy::disallowed_methods, reason = "reading is no analysis: short, and needs no cancelling")]
async fn read_within<V: Send + 'static>(
    state: &Service,
    body: JsonBody,
    then: impl FnOnce(Request, usize) -> Result<V, Problem> + Send + 'static,
) -> Result<V, Problem> {
    let limits = state.settings.limits;
    let finish = move |fields: Fields, body: &JsonBody| {
        let (request, question) =
            fields.question().map_err(|faults| check_syntax(body).err().unwrap_or(Problem::faults(faults)))?;
        let demand = limits.check(&request, &question).map_err(Problem::faults)?;
        then(request, demand.memory)
    };
    let read = (body.len() <= SHORT).then(|| Fields::of(&body));
    let read = match read {
        Some(fields) if fields.are_light() => return finish(fields, &body),
        read => read,
    };
    let turn = state.readers.turn(body.len()).await.ok_or_else(Problem::internal)?;
    let reading = tokio::task::spawn_blocking(move || {
        // Given back when it has been read, also where the client has gone.
        let _turn = turn;
        finish(read.unwrap_or_else(|| Fields::of(&body)), &body)
    });
    reading.await.unwrap_or_else(|_| Err(Problem::internal()))
}

fn idempotency_key(headers: &HeaderMap) -> Result<Option<&str>, Problem> {
    let mut values = headers.get_all(IDEMPOTENCY_KEY).iter();
    let Some(value) = values.next() else { return Ok(None) };
    let key = value.to_str().ok().filter(|_| values.next().is_none()).unwrap_or_default();
    let plain = (1..=LONGEST_KEY).contains(&key.len()) && key.bytes().all(|byte| byte.is_ascii_graphic());
    let detail = format!(
        "idempotency-key has to be given once, as 1 to {LONGEST_KEY} printable ASCII characters without blanks"
    );
    if plain { Ok(Some(key)) } else { Err(Problem::of(kinds::BAD_HEADER, detail)) }
}

/// What a client prefers (RFC 7240); what cannot be read is left aside, as that asks.
#[derive(Debug, PartialEq, Default)]
struct Preferred {
    /// How long to wait for the end, cut to the longest there is.
    wait: Option<Duration>,
    /// That the answer is the results.
    results: bool,
}

impl Preferred {
    fn read(headers: &HeaderMap) -> Self {
        let lines = headers.get_all(PREFER).iter().filter_map(|value| value.to_str().ok());
        let preferences = lines.flat_map(|line| line.split(',')).filter_map(|one| {
            let (name, value) = one.split(';').next()?.split_once('=')?;
            Some((name.trim().to_ascii_lowercase(), value.trim().trim_matches('"')))
        });
        let mut preferred = Preferred::default();
        for (name, value) in preferences {
            match (name.as_str(), value.parse()) {
                // Of two the first holds.
                ("wait", Ok(seconds)) => {
                    _ = preferred.wait.get_or_insert(Duration::from_secs(seconds).min(LONGEST_WAIT))
                }
                ("return", _) => preferred.results |= value.eq_ignore_ascii_case("representation"),
                _ => {}
            }
        }
        preferred
    }

    /// The preferences that were heeded, where there are any.
    fn heeded(&self, results: bool) -> Option<String> {
        let wait = self.wait.map(|wait| format!("wait={}", wait.as_secs()));
        let heeded: Vec<_> = wait.into_iter().chain(results.then(|| "return=representation".to_owned())).collect();
        (!heeded.is_empty()).then(|| heeded.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use axum::http::HeaderValue;

    #[test]
    fn preferences_are_read_as_rfc_7240_writes_them() {
        for (text, seconds, results) in [
            ("wait=5", Some(5), false),
            ("respond-async, wait=10", Some(10), false),
            ("Wait = \"7\"; x=1", Some(7), false),
            ("wait=900", Some(30), false),
            ("wait=0", Some(0), false),
            ("wait", None, false),
            ("wait=-1", None, false),
            ("wait=soon, wait=2, wait=3", Some(2), false),
            ("return=minimal", None, false),
            ("return=representation, wait=3", Some(3), true),
        ] {
            let headers = HeaderMap::from_iter([(PREFER, HeaderValue::from_static(text))]);
            let wait = seconds.map(Duration::from_secs);
            assert_eq!(Preferred::read(&headers), Preferred { wait, results }, "{text}");
        }
    }
}
