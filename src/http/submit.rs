//! Handlers that take a request: submit it, or only look it over.

use super::body::{JsonBody, check_syntax};
use super::jobs::answer;
use super::layers::Client;
use super::problem::{Problem, kinds};
use super::service::{AppState, Service};
use super::status::{self, JobStatus};
use crate::jobs::Submission;
use crate::wire::json;
use crate::wire::read;
use crate::wire::request::Request;
use axum::Extension;
use axum::body::Bytes;
use axum::http::{HeaderMap, HeaderName, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use std::time::Duration;
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
            description = "`wait=N`: answer when the job has ended, or after N seconds, 30 at most"),
        ("idempotency-key" = Option<String>, Header, min_length = 1, max_length = 200, pattern = "^[!-~]+$",
            description = "A name for this submission: sent again with the same body, it gives the job it named"),
    ),
    request_body(content = Request, content_type = "application/json"),
    responses(
        (status = 201, description = "Accepted; poll the status", body = JobStatus, headers(
            ("location" = String, description = "Path of the job's status"),
            ("preference-applied" = Option<String>, description = "The wait that was granted, where one was asked for"),
        )),
    )
)]
pub(super) async fn submit(
    state: AppState,
    headers: HeaderMap,
    Extension(client): Extension<Client>,
    JsonBody(body): JsonBody,
) -> Result<Response, Problem> {
    let key = idempotency_key(&headers)?.map(|key| client.scoped(key));
    let submission = read_within(&state, body, move |work| {
        let (name, request) = (work.name().map(str::to_owned), json::line(&work).map_err(Problem::unwritable)?.into());
        Ok(Submission { work, request, name, client: client.name, key })
    });
    let mut job = state.jobs.submit(submission.await?)?;
    tracing::Span::current().record("job.id", tracing::field::display(job.id));
    let wait = preferred_wait(&headers);
    if let Some(wait) = wait {
        // Timed out or ended, what counts is how the job stands then; the store may have forgotten it already.
        let _ = tokio::time::timeout(wait, job.progress.ended()).await;
        job = state.jobs.get(job.id).unwrap_or_else(|| job.now());
    }
    let location = [(header::LOCATION, status::path(job.id))];
    let mut response = (StatusCode::CREATED, location, answer(&JobStatus::from(&job))?).into_response();
    let granted = wait.and_then(|wait| format!("wait={}", wait.as_secs()).parse().ok());
    response.headers_mut().extend(granted.map(|granted| (PREFERENCE_APPLIED, granted)));
    Ok(response)
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
pub(super) async fn validate(state: AppState, JsonBody(body): JsonBody) -> Result<Response, Problem> {
    read_within(&state, body, |request| answer(&Verdict { valid: true, request })).await
}

/// Reads a body and, if this service takes the request, makes something of it. That may take a while: others go on meanwhile,
/// and only so many are read at once.
#[allow(clippy::disallowed_methods, reason = "reading is no analysis: short, and needs no cancelling")]
async fn read_within<V: Send + 'static>(
    state: &Service,
    body: Bytes,
    then: impl FnOnce(Request) -> Result<V, Problem> + Send + 'static,
) -> Result<V, Problem> {
    let turn = state.readers.clone().acquire_owned().await.map_err(|_| Problem::internal())?;
    let limits = state.settings.limits;
    let reading = tokio::task::spawn_blocking(move || {
        // Given back when it has been read, also where the client has gone.
        let _turn = turn;
        let read = read::read_question(&body);
        let (request, question) =
            read.map_err(|faults| check_syntax(&body).err().unwrap_or(Problem::faults(faults)))?;
        limits.check(&request, &question).map_err(Problem::faults)?;
        then(request)
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

/// The wait a client prefers (RFC 7240), cut to the longest there is; what cannot be read is left aside, as it asks.
fn preferred_wait(headers: &HeaderMap) -> Option<Duration> {
    let lines = headers.get_all(PREFER).iter().filter_map(|value| value.to_str().ok());
    let mut preferences = lines.flat_map(|line| line.split(',')).map(|one| one.split(';').next().unwrap_or_default());
    let seconds = preferences.find_map(|preference| {
        let (_, value) = preference.split_once('=').filter(|(name, _)| name.trim().eq_ignore_ascii_case("wait"))?;
        value.trim().trim_matches('"').parse().ok()
    })?;
    Some(Duration::from_secs(seconds).min(LONGEST_WAIT))
}

#[cfg(test)]
mod tests {
    use super::*;
    use axum::http::HeaderValue;

    #[test]
    fn a_wait_is_read_as_rfc_7240_writes_it() {
        for (text, seconds) in [
            ("wait=5", Some(5)),
            ("respond-async, wait=10", Some(10)),
            ("Wait = \"7\"; x=1", Some(7)),
            ("wait=900", Some(30)),
            ("wait=0", Some(0)),
            ("wait", None),
            ("wait=-1", None),
            ("wait=soon", None),
            ("return=minimal", None),
        ] {
            let headers = HeaderMap::from_iter([(PREFER, HeaderValue::from_static(text))]);
            assert_eq!(preferred_wait(&headers), seconds.map(Duration::from_secs), "{text}");
        }
    }
}
