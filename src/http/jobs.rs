//! Handlers of `/v1/jobs` beside submission: list, status, request, dismissal.

use super::etag::Version;
use super::layers::Client;
use super::problem::{Problem, kinds};
use super::service::{AppState, Service, ended};
use super::status::{JobList, JobStatus, ListLinks};
use crate::jobs::{Cancelled, Job, JobId, Status, Which};
use crate::wire::json;
use crate::wire::request::Request;
use axum::Extension;
use axum::extract::rejection::QueryRejection;
use axum::extract::{FromRequestParts, Path, Query};
use axum::http::request::Parts;
use axum::http::{HeaderMap, HeaderValue, Method, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use utoipa::IntoParams;

/// Jobs listed when nothing is asked.
const JOBS_LISTED: usize = 50;

/// Most jobs listed at once.
const MOST_JOBS_LISTED: usize = 1000;

/// The header of an answer that is JSON.
pub(super) const JSON: [(header::HeaderName, &str); 1] = [(header::CONTENT_TYPE, "application/json")];

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
    Extension(client): Extension<Client>,
    query: Result<Query<ListQuery>, QueryRejection>,
) -> Result<Response, Problem> {
    let Query(ListQuery { status, limit, cursor }) = query.map_err(|rejection| query_fault(&rejection))?;
    let limit = limit.unwrap_or(JOBS_LISTED);
    if !(1..=MOST_JOBS_LISTED).contains(&limit) {
        return Err(Problem::of(kinds::BAD_QUERY, format!("limit must lie between 1 and {MOST_JOBS_LISTED}")));
    }
    // One more than asked for tells whether there is a next page.
    let mut jobs = state.store.list(Which { client: client.sees(), status, before: cursor, limit: limit + 1 }).await?;
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
pub(super) async fn show(state: AppState, Known(job): Known, headers: HeaderMap) -> Result<Response, Problem> {
    let body = json::line(&JobStatus::from(&job)).map_err(Problem::unwritable)?;
    // Time that passes alone makes no other version of it.
    let step = job.progress.map(|step| (step.load_factor.to_bits(), step.events));
    let version = Version::of((job.id, job.status().word(), job.position, step));
    let mut response = version.known(&headers).unwrap_or_else(|| version.mark((JSON, body)));
    state.told(&job).await?;
    let again = state.look_again(&job).await;
    response.headers_mut().extend(again.map(|seconds| (header::RETRY_AFTER, HeaderValue::from(seconds))));
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
pub(super) async fn request(state: AppState, Known(job): Known) -> Result<Response, Problem> {
    let request = state.store.request(job.id).await?;
    Ok((JSON, request.ok_or_else(|| Problem::no_such_job(&job.id.to_string()))?).into_response())
}

/// Cancel a job. Asked again, it answers the same.
#[utoipa::path(
    delete, path = "/v1/jobs/{id}", tag = "jobs", operation_id = "dismiss_job",
    params(("id" = String, Path, format = "uuid", description = "Job id")),
    responses(
        (status = 200, description = "It is dismissed, now or by an earlier request", body = JobStatus),
    )
)]
pub(super) async fn dismiss(state: AppState, Known(job): Known) -> Result<Response, Problem> {
    let id = job.id;
    match state.store.cancel(id).await?.ok_or_else(|| Problem::no_such_job(&id.to_string()))? {
        Cancelled::Now(job) => {
            ended(&state.metrics, &job);
            answer(&JobStatus::from(&job))
        }
        Cancelled::Before(job) if job.status() == Status::Dismissed => answer(&JobStatus::from(&job)),
        Cancelled::Before(job) => {
            let detail = format!("job {id} is {}; DELETE /v1/jobs/{id}/results forgets it", job.status().word());
            Err(Problem::of(kinds::HAS_ENDED, detail))
        }
    }
}

/// Forget a job that has ended, with its request and its results.
#[utoipa::path(
    delete, path = "/v1/jobs/{id}/results", tag = "results", operation_id = "forget_job",
    params(("id" = String, Path, format = "uuid", description = "Job id")),
    responses((status = 204, description = "It is forgotten"))
)]
pub(super) async fn forget(state: AppState, Known(job): Known) -> Result<Response, Problem> {
    let id = job.id;
    if !job.status().is_final() {
        let detail = format!("job {id} is {}; DELETE /v1/jobs/{id} cancels it", job.status().word());
        return Err(Problem::of(kinds::NOT_ENDED, detail));
    }
    match state.store.forget(id).await? {
        true => Ok(StatusCode::NO_CONTENT.into_response()),
        false => Err(Problem::no_such_job(&id.to_string())),
    }
}

/// The job of a path.
pub(super) struct Known(pub(super) Job);

impl FromRequestParts<Arc<Service>> for Known {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, service: &Arc<Service>) -> Result<Self, Problem> {
        let path = Path::<Vec<(String, String)>>::from_request_parts(parts, service).await;
        let id = path.ok().and_then(|Path(names)| names.into_iter().find(|(name, _)| name == "id"));
        let (_, id) = id.ok_or_else(|| Problem::no_such_path(parts.uri.path()))?;
        let client = parts.extensions.get::<Client>().ok_or_else(Problem::internal)?;
        known(service, client, &parts.method, &id).await.map(Known)
    }
}

/// The job of this id. To those who may not see it, or do this to it, it is as if it were not there.
pub(super) async fn known(service: &Service, client: &Client, method: &Method, id: &str) -> Result<Job, Problem> {
    let unknown = || Problem::no_such_job(id);
    let job = service.store.job(JobId::try_parse(id).map_err(|_| unknown())?).await?;
    job.filter(|job| client.may(method, job)).ok_or_else(unknown)
}

/// What is wrong with a query.
pub(super) fn query_fault(rejection: &QueryRejection) -> Problem {
    let text = rejection.body_text();
    Problem::of(kinds::BAD_QUERY, text.strip_prefix("Failed to deserialize query string: ").unwrap_or(&text))
}
