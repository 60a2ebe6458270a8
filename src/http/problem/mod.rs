//! Problems, RFC 9457: the only shape in which this service says no.

pub mod kinds;

use crate::jobs::{Failure, Refusal, Unavailable};
use crate::wire::fault::Fault;
use crate::wire::json::NotFinite;
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use kinds::ProblemKind;
use serde::Serialize;
use utoipa::ToSchema;

/// The media type of a problem.
pub const MEDIA_TYPE: &str = "application/problem+json";

/// Seconds after which a client may try again, where nothing is known of it.
const RETRY_AFTER: u64 = 1;

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
    /// Seconds after which to try again, where that may help.
    #[serde(skip)]
    retry_after: Option<u64>,
}

impl Problem {
    /// A problem of a kind of ours.
    pub fn of(kind: ProblemKind, detail: impl Into<String>) -> Self {
        let ProblemKind { uri, status, title } = kind;
        let may_help = matches!(status.as_u16(), 429 | 503) || uri == kinds::RESULT_NOT_READY.uri;
        let retry_after = may_help.then_some(RETRY_AFTER);
        Problem { kind: uri, title, status: status.as_u16(), detail: detail.into(), errors: Vec::new(), retry_after }
    }

    /// The same, to be tried again after so many seconds, if trying again may help.
    pub(super) fn after(self, seconds: u64) -> Self {
        Problem { retry_after: self.retry_after.map(|_| seconds), ..self }
    }

    /// A problem that its status code says all about.
    pub fn plain(status: StatusCode, detail: impl Into<String>) -> Self {
        Problem::of(
            ProblemKind { uri: "about:blank", status, title: status.canonical_reason().unwrap_or("Error") },
            detail,
        )
    }

    /// The request is JSON, but describes no analysis.
    pub fn faults(errors: Vec<Fault>) -> Self {
        let detail = "the faults are listed in errors, each with the place where it sits";
        Problem { errors, ..Problem::of(kinds::INVALID_REQUEST, detail) }
    }

    /// Nothing lives at this path.
    pub fn no_such_path(path: &str) -> Self {
        Problem::plain(StatusCode::NOT_FOUND, format!("nothing is at {path}; /openapi.json lists what is where"))
    }

    /// There is no job of this name.
    pub fn no_such_job(id: &str) -> Self {
        let detail = format!("there is no job {id}; finished jobs are forgotten after a while");
        Problem::of(kinds::NO_SUCH_JOB, detail)
    }

    /// The service takes no more jobs.
    pub fn shutting_down() -> Self {
        Refusal::Closed.into()
    }

    /// An answer with a number that is not finite: a defect of the program.
    pub(super) fn unwritable(reason: NotFinite) -> Self {
        tracing::error!(%reason, "an answer cannot be written");
        Problem::internal()
    }

    /// A defect of the program.
    pub fn internal() -> Self {
        let detail = "a defect of the program, not of the request; the header x-request-id finds it in the log";
        Problem::plain(StatusCode::INTERNAL_SERVER_ERROR, detail)
    }
}

impl From<Refusal> for Problem {
    fn from(refusal: Refusal) -> Self {
        let kind = match refusal {
            Refusal::Unavailable(reason) => return reason.into(),
            Refusal::QueueFull(_) => kinds::QUEUE_FULL,
            Refusal::ClientQueueFull(_) => kinds::CLIENT_QUEUE_FULL,
            Refusal::MemoryFull(_) => kinds::MEMORY_FULL,
            Refusal::ClientMemoryFull(_) => kinds::CLIENT_MEMORY_FULL,
            Refusal::KeyTaken(_) => kinds::KEY_TAKEN,
            Refusal::KeySpent(_) => kinds::KEY_SPENT,
            Refusal::Closed => kinds::SHUTTING_DOWN,
        };
        Problem::of(kind, refusal.to_string())
    }
}

impl From<Unavailable> for Problem {
    fn from(reason: Unavailable) -> Self {
        tracing::error!(%reason);
        // Where the store is, and what it said, is no business of clients.
        Problem::of(kinds::STORE_UNAVAILABLE, "try again; what was asked may have happened or not")
    }
}

impl From<&Failure> for Problem {
    fn from(failure: &Failure) -> Self {
        let kind = match failure {
            Failure::Overdue { .. } => kinds::ANALYSIS_OVERDUE,
            Failure::Outgrown { .. } => kinds::ANALYSIS_OUTGROWN,
            Failure::Analysis(_) => kinds::ANALYSIS_FAILED,
            Failure::Lost { .. } => kinds::ANALYSIS_LOST,
            Failure::Defect => kinds::ANALYSIS_DEFECT,
        };
        Problem::of(kind, failure.to_string())
    }
}

impl IntoResponse for Problem {
    fn into_response(self) -> Response {
        let status = StatusCode::from_u16(self.status).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
        let kind = ProblemKind { uri: self.kind, status, title: self.title };
        let body = serde_json::to_vec(&self).unwrap_or_default();
        let fixed = [(header::CONTENT_TYPE, MEDIA_TYPE), (header::CACHE_CONTROL, "no-store")];
        let mut response = (status, fixed, body).into_response();
        // What is counted is told by its kind.
        response.extensions_mut().insert(kind);
        let headers = response.headers_mut();
        headers.extend(self.retry_after.map(|seconds| (header::RETRY_AFTER, HeaderValue::from(seconds))));
        if status == StatusCode::UNAUTHORIZED {
            headers.insert(header::WWW_AUTHENTICATE, HeaderValue::from_static("Bearer"));
        }
        response
    }
}
