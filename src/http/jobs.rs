//! Handlers of `/v1/jobs` beside submission: list, status, request, dismissal.

use super::etag::Version;
use super::problem::{Problem, RETRY_AFTER, kinds};
use super::service::{AppState, Service};
use super::status::{JobList, JobStatus, ListLinks};
use crate::jobs::{Dismissal, Job, JobId, Status};
use crate::wire::json;
use crate::wire::request::Request;
use axum::extract::rejection::QueryRejection;
use axum::extract::{FromRequestParts, Path, Query};
use axum::http::request::Parts;
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use utoipa::IntoParams;

/// Jobs listed when nothing is asked.
const JOBS_LISTED: usize = 50;

/// Most jobs listed at once.
const MOST_JOBS_LISTED: usize = 1000;

/// The header of an answer that is JSON.
const JSON: [(header::HeaderName, &str); 1] = [(header::CONTENT_TYPE, "application/json")];

/// Which part of the list is asked for.
#[derive(Debug, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(super) struct ListQuery {
    /// Jobs of this status only.
    status: Option<Status>,
    /// At most so many jobs.
    #[param(minimum = 1, maximum = 1000, default = 50)]
    limit: Option<usize>,
    /// Jobs submitted before this one only, as `links.next` has it.
    #[param(value_type = Option<String>, format = "uuid")]
    cursor: Option<JobId>,
}

/// An answer in JSON.
pub(super) fn answer(value: &impl Serialize) -> Result<Response, Problem> {
    Ok((JSON, json::line(value).map_err(Problem::unwritable)?).into_response())
}

/// List jobs, newest first.
#[utoipa::path(
    get, path = "/v1/jobs", tag = "jobs", operation_id = "list_jobs", params(ListQuery),
    responses((status = 200, description = "Jobs, newest first", body = JobList))
)]
pub(super) async fn list(
    state: AppState,
    query: Result<Query<ListQuery>, QueryRejection>,
) -> Result<Response, Problem> {
    let Query(ListQuery { status, limit, cursor }) = query.map_err(|rejection| query_fault(&rejection))?;
    let limit = limit.unwrap_or(JOBS_LISTED);
    if !(1..=MOST_JOBS_LISTED).contains(&limit) {
        return Err(Problem::of(kinds::BAD_QUERY, format!("limit must lie between 1 and {MOST_JOBS_LISTED}")));
    }
    // One more than asked for tells whether there is a next page.
    let mut jobs = state.jobs.list(status, cursor, limit + 1);
    let more = jobs.len() > limit;
    jobs.truncate(limit);
    let next = jobs.last().filter(|_| more).map(|last| {
        let status = status.map(|status| format!("status={}&", status.word())).unwrap_or_default();
        format!("/v1/jobs?{status}limit={limit}&cursor={}", last.id)
    });
    answer(&JobList { jobs: jobs.iter().map(JobStatus::from).collect(), links: ListLinks { next } })
}

/// A job's status.
#[utoipa::path(
    get, path = "/v1/jobs/{id}", tag = "jobs", operation_id = "get_job",
    params(
        ("id" = String, Path, format = "uuid", description = "Job id"),
        ("if-none-match" = Option<String>, Header, description = "The `etag` of the status that is known already"),
    ),
    responses(
        (status = 200, description = "Where the job stands", body = JobStatus, headers(
            ("etag" = String, description = "Names this status"),
            ("retry-after" = Option<u64>, description = "Seconds after which to look again, while the job is active"),
        )),
        (status = 304, description = "Still as the client knows it"),
    )
)]
pub(super) async fn show(Known(job): Known, headers: HeaderMap) -> Result<Response, Problem> {
    let body = json::line(&JobStatus::from(&job)).map_err(Problem::unwritable)?;
    let version = Version::of(&body);
    let mut response = version.known(&headers).unwrap_or_else(|| version.mark((JSON, body)));
    if !job.status().is_final() {
        response.headers_mut().insert(header::RETRY_AFTER, HeaderValue::from(RETRY_AFTER));
    }
    Ok(response)
}

/// A job's request, defaults filled in.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/request", tag = "jobs", operation_id = "get_request",
    params(("id" = String, Path, format = "uuid", description = "Job id")),
    responses(
        (status = 200, description = "The request as it was understood; posted again it gives the same results, byte for \
            byte", body = Request),
    )
)]
pub(super) async fn request(Known(job): Known) -> impl IntoResponse {
    (JSON, job.request)
}

/// Cancel a job that has not ended, forget one that has.
#[utoipa::path(
    delete, path = "/v1/jobs/{id}", tag = "jobs", operation_id = "dismiss_job",
    params(("id" = String, Path, format = "uuid", description = "Job id")),
    responses(
        (status = 200, description = "Had not ended: it is dismissed", body = JobStatus),
        (status = 204, description = "Had ended: it is forgotten"),
    )
)]
pub(super) async fn dismiss(state: AppState, Known(job): Known) -> Result<Response, Problem> {
    match state.jobs.dismiss(job.id).ok_or_else(|| Problem::no_such_job(&job.id.to_string()))? {
        Dismissal::Cancelled(job) => answer(&JobStatus::from(&*job)),
        Dismissal::Forgotten => Ok(StatusCode::NO_CONTENT.into_response()),
    }
}

/// The job of a path.
pub(super) struct Known(pub(super) Job);

impl FromRequestParts<Service> for Known {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, service: &Service) -> Result<Self, Problem> {
        let path = Path::<Vec<(String, String)>>::from_request_parts(parts, service).await;
        let id = path.ok().and_then(|Path(names)| names.into_iter().find(|(name, _)| name == "id"));
        let (_, id) = id.ok_or_else(|| Problem::no_such_path(parts.uri.path()))?;
        let job = JobId::try_parse(&id).ok().and_then(|id| service.jobs.get(id));
        job.map(Known).ok_or_else(|| Problem::no_such_job(&id))
    }
}

/// What is wrong with a query.
pub(super) fn query_fault(rejection: &QueryRejection) -> Problem {
    let text = rejection.body_text();
    Problem::of(kinds::BAD_QUERY, text.strip_prefix("Failed to deserialize query string: ").unwrap_or(&text))
}
