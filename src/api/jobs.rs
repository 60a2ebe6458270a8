//! Handlers of `/v1/jobs`: look up, call, map.

use super::Service;
use super::problem::Problem;
use super::read;
use super::request::Request;
use super::response::JobResult;
use super::status::{self, JobList, JobStatus};
use crate::collapse::{Answer, Question};
use crate::jobs::{Dismissal, Job, JobId, State};
use axum::Json;
use axum::body::Bytes;
use axum::extract::rejection::{BytesRejection, QueryRejection};
use axum::extract::{FromRequestParts, Path, Query};
use axum::http::request::Parts;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::sync::Arc;
use utoipa::IntoParams;

/// Jobs listed when nothing is asked.
const LISTED: usize = 50;

/// Most jobs listed at once.
const MOST_LISTED: usize = 1000;

type AppState = axum::extract::State<Service>;

/// Submit an analysis.
#[utoipa::path(
    post, path = "/v1/jobs", tag = "jobs", operation_id = "submit_job",
    request_body(content = Request, content_type = "application/json"),
    responses(
        (status = 201, description = "Accepted; poll the status", body = JobStatus,
            headers(("location" = String, description = "Path of the job's status"))),
        (status = 400, description = "Not JSON", body = Problem, content_type = "application/problem+json"),
        (status = 413, description = "Body too long", body = Problem, content_type = "application/problem+json"),
        (status = 415, description = "Not said to be JSON", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "Describes no analysis: every fault is listed", body = Problem,
            content_type = "application/problem+json"),
        (status = 503, description = "Queue full, or shutting down", body = Problem,
            content_type = "application/problem+json",
            headers(("retry-after" = u64, description = "Seconds after which to try again"))),
    )
)]
pub(super) async fn submit(
    state: AppState,
    headers: HeaderMap,
    body: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    if !is_json(&headers) {
        return Err(Problem::unsupported_media_type());
    }
    let body = body.map_err(|rejection| Problem::body(&rejection, state.body_limit))?;
    let (request, question) = read_aside(body).await?;
    let job = state.jobs.submit(question, request)?;
    let location = [(header::LOCATION, status::path(job.id))];
    Ok((StatusCode::CREATED, location, Json(JobStatus::from(&job))).into_response())
}

/// Reads a body on a thread of its own kind: a large one takes a while, which others should not have to wait for.
#[allow(clippy::disallowed_methods, reason = "reading is no analysis: it is short and needs no cancelling")]
async fn read_aside(body: Bytes) -> Result<(Request, Question), Problem> {
    let reading = tokio::task::spawn_blocking(move || {
        check_syntax(&body)?;
        read::read_question(&body).map_err(Problem::faults)
    });
    reading.await.unwrap_or_else(|_| Err(Problem::internal()))
}

/// How much of the list is asked for.
#[derive(Debug, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(super) struct ListQuery {
    /// At most so many jobs.
    #[param(minimum = 1, maximum = 1000, default = 50)]
    limit: Option<usize>,
}

/// List jobs, newest first.
#[utoipa::path(
    get, path = "/v1/jobs", tag = "jobs", operation_id = "list_jobs", params(ListQuery),
    responses(
        (status = 200, description = "Jobs, newest first", body = JobList),
        (status = 400, description = "Bad query", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn list(
    state: AppState,
    query: Result<Query<ListQuery>, QueryRejection>,
) -> Result<Json<JobList>, Problem> {
    let Query(query) = query.map_err(|rejection| Problem::bad_query(rejection.body_text()))?;
    let limit = query.limit.unwrap_or(LISTED);
    if !(1..=MOST_LISTED).contains(&limit) {
        return Err(Problem::bad_query(format!("limit must lie between 1 and {MOST_LISTED}")));
    }
    let jobs = state.jobs.newest(limit).iter().map(JobStatus::from).collect();
    Ok(Json(JobList { jobs }))
}

/// A job's status.
#[utoipa::path(
    get, path = "/v1/jobs/{id}", tag = "jobs", operation_id = "get_job",
    params(("id" = String, Path, format = "uuid", description = "Job id")),
    responses(
        (status = 200, description = "Where the job stands", body = JobStatus),
        (status = 404, description = "No such job", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn show(state: AppState, path: JobPath) -> Result<Json<JobStatus>, Problem> {
    Ok(Json(JobStatus::from(&find(&state, path.0)?)))
}

/// A job's results.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/results", tag = "jobs", operation_id = "get_results",
    params(("id" = String, Path, format = "uuid", description = "Job id")),
    responses(
        (status = 200, description = "The answer to what was asked; the same bytes for the same request",
            body = JobResult),
        (status = 404, description = "No such job, or not ready", body = Problem,
            content_type = "application/problem+json"),
        (status = 410, description = "Dismissed", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "The analysis failed", body = Problem, content_type = "application/problem+json"),
        (status = 500, description = "The analysis broke off", body = Problem,
            content_type = "application/problem+json"),
        (status = 503, description = "The analysis was stopped", body = Problem,
            content_type = "application/problem+json"),
    )
)]
pub(super) async fn results(state: AppState, path: JobPath) -> Result<Response, Problem> {
    let job = find(&state, path.0)?;
    match &job.state {
        State::Accepted | State::Running => Err(Problem::result_not_ready(job.id)),
        State::Dismissed => Err(Problem::dismissed(job.id)),
        State::Failed(failure) => Err(failure.into()),
        State::Successful(answer) => {
            let body = written_aside(Arc::clone(&job.attachment), Arc::clone(answer)).await?;
            Ok(([(header::CONTENT_TYPE, "application/json")], body).into_response())
        }
    }
}

/// Writes an answer on a thread of its own kind: a large one takes a while, which others should not have to wait for.
#[allow(clippy::disallowed_methods, reason = "writing is no analysis: it is short and needs no cancelling")]
async fn written_aside(request: Arc<Request>, answer: Arc<Answer>) -> Result<Vec<u8>, Problem> {
    let writing = tokio::task::spawn_blocking(move || {
        let result = JobResult::new(&request, &answer).ok_or_else(Problem::internal)?;
        result.to_bytes().map_err(|_| Problem::internal())
    });
    writing.await.unwrap_or_else(|_| Err(Problem::internal()))
}

/// Cancel a job that has not ended, forget one that has.
#[utoipa::path(
    delete, path = "/v1/jobs/{id}", tag = "jobs", operation_id = "dismiss_job",
    params(("id" = String, Path, format = "uuid", description = "Job id")),
    responses(
        (status = 200, description = "Had not ended: it is dismissed", body = JobStatus),
        (status = 204, description = "Had ended: it is forgotten"),
        (status = 404, description = "No such job", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn dismiss(state: AppState, path: JobPath) -> Result<Response, Problem> {
    match state.jobs.dismiss(path.0).ok_or_else(|| Problem::no_such_job(&path.0.to_string()))? {
        Dismissal::Cancelled(job) => Ok(Json(JobStatus::from(&job)).into_response()),
        Dismissal::Forgotten => Ok(StatusCode::NO_CONTENT.into_response()),
    }
}

/// The job id of a path.
pub(super) struct JobPath(JobId);

impl<S: Send + Sync> FromRequestParts<S> for JobPath {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        let text = match Path::<String>::from_request_parts(parts, state).await {
            Ok(Path(text)) => text,
            Err(_) => return Err(Problem::no_such_path(parts.uri.path())),
        };
        JobId::try_parse(&text).map(JobPath).map_err(|_| Problem::no_such_job(&text))
    }
}

fn find(state: &Service, id: JobId) -> Result<Job<Request>, Problem> {
    state.jobs.get(id).ok_or_else(|| Problem::no_such_job(&id.to_string()))
}

/// True for `application/json` with or without parameters.
fn is_json(headers: &HeaderMap) -> bool {
    let value = headers.get(header::CONTENT_TYPE).and_then(|value| value.to_str().ok()).unwrap_or_default();
    let essence = value.split(';').next().unwrap_or_default().trim();
    essence.eq_ignore_ascii_case("application/json")
}

/// Tells a body that is not JSON (400) from JSON that says something impossible (422).
fn check_syntax(body: &[u8]) -> Result<(), Problem> {
    let text = std::str::from_utf8(body).map_err(|error| Problem::not_json(error.to_string()))?;
    serde_json::from_str::<IgnoredAny>(text).map(drop).map_err(|error| Problem::not_json(error.to_string()))
}
