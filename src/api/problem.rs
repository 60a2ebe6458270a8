//! Problems, RFC 9457: the only shape in which this service says no.

use super::fault::Fault;
use crate::collapse::AnalysisError;
use crate::jobs::{Failure, JobId, Refusal};
use axum::extract::rejection::BytesRejection;
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use utoipa::ToSchema;

/// The media type of a problem.
pub const MEDIA_TYPE: &str = "application/problem+json";

/// Seconds after which a client may try again when the queue is full.
const RETRY_AFTER: u64 = 5;

/// What went wrong, for whom it may concern.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct Problem {
    /// Which kind of problem: a URI that stays the same for every occurrence.
    #[serde(rename = "type")]
    kind: &'static str,
    /// The kind in words.
    title: &'static str,
    /// HTTP status code.
    status: u16,
    /// This occurrence in words.
    detail: String,
    /// Every fault of the request, each with the place where it sits.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schema(required = false)]
    errors: Vec<Fault>,
    #[serde(skip)]
    retry_after: Option<u64>,
}

impl Problem {
    fn new(status: StatusCode, kind: &'static str, title: &'static str, detail: impl Into<String>) -> Self {
        let detail = detail.into();
        Problem { kind, title, status: status.as_u16(), detail, errors: Vec::new(), retry_after: None }
    }

    /// A problem that its status code says all about.
    fn plain(status: StatusCode, detail: impl Into<String>) -> Self {
        Problem::new(status, "about:blank", status.canonical_reason().unwrap_or("Error"), detail)
    }

    /// The request is JSON, but describes no analysis.
    pub fn faults(errors: Vec<Fault>) -> Self {
        let (kind, title) = ("urn:voussoir:problem:invalid-request", "The request cannot be analysed");
        let detail = "every fault is listed in errors, with the place where it sits";
        Problem { errors, ..Problem::new(StatusCode::UNPROCESSABLE_ENTITY, kind, title, detail) }
    }

    /// The body is not JSON.
    pub fn not_json(detail: impl Into<String>) -> Self {
        Problem::new(StatusCode::BAD_REQUEST, "urn:voussoir:problem:not-json", "The body is not JSON", detail)
    }

    /// A query parameter that cannot be.
    pub fn bad_query(detail: impl Into<String>) -> Self {
        Problem::new(StatusCode::BAD_REQUEST, "urn:voussoir:problem:bad-query", "The query cannot be read", detail)
    }

    /// The body is not said to be JSON.
    pub fn unsupported_media_type() -> Self {
        let detail = "send the request with the header content-type: application/json";
        Problem::plain(StatusCode::UNSUPPORTED_MEDIA_TYPE, detail)
    }

    /// The body did not arrive, or is too long.
    pub fn body(rejection: &BytesRejection, limit: usize) -> Self {
        match rejection.status() {
            StatusCode::PAYLOAD_TOO_LARGE => {
                let detail = format!("the body may have at most {limit} bytes");
                Problem::plain(StatusCode::PAYLOAD_TOO_LARGE, detail)
            }
            _ => Problem::plain(StatusCode::BAD_REQUEST, "the body could not be read to its end"),
        }
    }

    /// Nothing lives at this path.
    pub fn no_such_path(path: &str) -> Self {
        Problem::plain(StatusCode::NOT_FOUND, format!("nothing is at {path}; /openapi.json lists what is where"))
    }

    /// The path knows other methods only.
    pub fn method_not_allowed() -> Self {
        Problem::plain(StatusCode::METHOD_NOT_ALLOWED, "the header allow lists the methods of this path")
    }

    /// There is no job of this name.
    pub fn no_such_job(id: &str) -> Self {
        let kind = "http://www.opengis.net/def/exceptions/ogcapi-processes-1/1.0/no-such-job";
        let detail = format!("there is no job {id}; finished jobs are forgotten after a while");
        Problem::new(StatusCode::NOT_FOUND, kind, "No such job", detail)
    }

    /// The job has not ended yet.
    pub fn result_not_ready(id: JobId) -> Self {
        let kind = "http://www.opengis.net/def/exceptions/ogcapi-processes-1/1.0/result-not-ready";
        let detail = format!("job {id} has not ended yet; its status is at /v1/jobs/{id}");
        Problem::new(StatusCode::NOT_FOUND, kind, "The result is not ready", detail)
    }

    /// The job was cancelled, there will be no result.
    pub fn dismissed(id: JobId) -> Self {
        let detail = format!("job {id} was dismissed and has no result; submit it again");
        Problem::new(StatusCode::GONE, "urn:voussoir:problem:dismissed", "The job was dismissed", detail)
    }

    /// A defect of the program.
    pub fn internal() -> Self {
        let detail = "a defect of the program, not of the request; the header x-request-id finds it in the log";
        Problem::plain(StatusCode::INTERNAL_SERVER_ERROR, detail)
    }
}

impl From<Refusal> for Problem {
    fn from(refusal: Refusal) -> Self {
        let (kind, title) = match refusal {
            Refusal::QueueFull(_) => ("urn:voussoir:problem:queue-full", "The queue is full"),
            Refusal::Closed => ("urn:voussoir:problem:shutting-down", "The service is shutting down"),
        };
        let problem = Problem::new(StatusCode::SERVICE_UNAVAILABLE, kind, title, refusal.to_string());
        Problem { retry_after: Some(RETRY_AFTER), ..problem }
    }
}

impl From<&Failure> for Problem {
    fn from(failure: &Failure) -> Self {
        let (status, kind, title) = match failure {
            Failure::Analysis(AnalysisError::Stopped { .. }) => {
                (StatusCode::SERVICE_UNAVAILABLE, "urn:voussoir:problem:stopped", "The analysis was stopped")
            }
            Failure::Analysis(_) => {
                (StatusCode::UNPROCESSABLE_ENTITY, "urn:voussoir:problem:analysis-failed", "The analysis failed")
            }
            Failure::Panicked => {
                let kind = "urn:voussoir:problem:analysis-panicked";
                (StatusCode::INTERNAL_SERVER_ERROR, kind, "The analysis broke off")
            }
        };
        Problem::new(status, kind, title, failure.to_string())
    }
}

impl IntoResponse for Problem {
    fn into_response(self) -> Response {
        let status = StatusCode::from_u16(self.status).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
        let body = serde_json::to_vec(&self).unwrap_or_default();
        let mut response = (status, [(header::CONTENT_TYPE, MEDIA_TYPE)], body).into_response();
        if let Some(seconds) = self.retry_after {
            response.headers_mut().insert(header::RETRY_AFTER, HeaderValue::from(seconds));
        }
        response
    }
}
