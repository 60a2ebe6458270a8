//! Every kind of problem this service knows.

use axum::http::StatusCode;

/// A kind of problem: the same for every occurrence.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ProblemKind {
    /// Its URI, `type` of the problem.
    pub uri: &'static str,
    /// Status code it comes with.
    pub status: StatusCode,
    /// The kind in words.
    pub title: &'static str,
}

const fn kind(uri: &'static str, status: StatusCode, title: &'static str) -> ProblemKind {
    ProblemKind { uri, status, title }
}

/// The request is JSON, but describes no analysis.
pub const INVALID_REQUEST: ProblemKind =
    kind("urn:voussoir:problem:invalid-request", StatusCode::UNPROCESSABLE_ENTITY, "The request cannot be analysed");
/// The body is not JSON.
pub const NOT_JSON: ProblemKind =
    kind("urn:voussoir:problem:not-json", StatusCode::BAD_REQUEST, "The body is not JSON");
/// A query parameter that cannot be.
pub const BAD_QUERY: ProblemKind =
    kind("urn:voussoir:problem:bad-query", StatusCode::BAD_REQUEST, "The query cannot be read");
/// A header that cannot be.
pub const BAD_HEADER: ProblemKind =
    kind("urn:voussoir:problem:bad-header", StatusCode::BAD_REQUEST, "A header cannot be read");
/// The idempotency key names another request.
pub const KEY_TAKEN: ProblemKind = kind(
    "urn:voussoir:problem:key-taken",
    StatusCode::UNPROCESSABLE_ENTITY,
    "The idempotency key was used for another request",
);
/// There is no job of this name.
pub const NO_SUCH_JOB: ProblemKind = kind(
    "http://www.opengis.net/def/exceptions/ogcapi-processes-1/1.0/no-such-job",
    StatusCode::NOT_FOUND,
    "No such job",
);
/// The job has not ended yet.
pub const RESULT_NOT_READY: ProblemKind = kind(
    "http://www.opengis.net/def/exceptions/ogcapi-processes-1/1.0/result-not-ready",
    StatusCode::NOT_FOUND,
    "The result is not ready",
);
/// The answer has no such part.
pub const NO_SUCH_PART: ProblemKind =
    kind("urn:voussoir:problem:no-such-part", StatusCode::NOT_FOUND, "The answer has no such part");
/// The job was cancelled.
pub const DISMISSED: ProblemKind = kind("urn:voussoir:problem:dismissed", StatusCode::GONE, "The job was dismissed");
/// The mechanics gave no answer.
pub const ANALYSIS_FAILED: ProblemKind =
    kind("urn:voussoir:problem:analysis-failed", StatusCode::UNPROCESSABLE_ENTITY, "The analysis failed");
/// The analysis took longer than a job may.
pub const ANALYSIS_OVERDUE: ProblemKind =
    kind("urn:voussoir:problem:analysis-overdue", StatusCode::UNPROCESSABLE_ENTITY, "The analysis took too long");
/// The analysis panicked.
pub const ANALYSIS_DEFECT: ProblemKind =
    kind("urn:voussoir:problem:analysis-defect", StatusCode::INTERNAL_SERVER_ERROR, "The analysis broke off");
/// One client has as many jobs waiting as it may.
pub const CLIENT_QUEUE_FULL: ProblemKind = kind(
    "urn:voussoir:problem:client-queue-full",
    StatusCode::TOO_MANY_REQUESTS,
    "Too many jobs of one client are waiting",
);
/// As many jobs wait as may.
pub const QUEUE_FULL: ProblemKind =
    kind("urn:voussoir:problem:queue-full", StatusCode::SERVICE_UNAVAILABLE, "The queue is full");
/// The jobs that have not ended fill the memory.
pub const MEMORY_FULL: ProblemKind =
    kind("urn:voussoir:problem:memory-full", StatusCode::SERVICE_UNAVAILABLE, "The memory for jobs is full");
/// The answers on their way fill the memory.
pub const ANSWERS_FULL: ProblemKind =
    kind("urn:voussoir:problem:answers-full", StatusCode::SERVICE_UNAVAILABLE, "Too many answers are on their way");
/// As many event streams are open as may.
pub const STREAMS_FULL: ProblemKind =
    kind("urn:voussoir:problem:streams-full", StatusCode::SERVICE_UNAVAILABLE, "Too many event streams are open");
/// The service is ending.
pub const SHUTTING_DOWN: ProblemKind =
    kind("urn:voussoir:problem:shutting-down", StatusCode::SERVICE_UNAVAILABLE, "The service is shutting down");

/// All of them, as docs/service.md lists them.
pub const KINDS: [ProblemKind; 18] = [
    INVALID_REQUEST,
    NOT_JSON,
    BAD_QUERY,
    BAD_HEADER,
    KEY_TAKEN,
    NO_SUCH_JOB,
    RESULT_NOT_READY,
    NO_SUCH_PART,
    DISMISSED,
    ANALYSIS_FAILED,
    ANALYSIS_OVERDUE,
    ANALYSIS_DEFECT,
    CLIENT_QUEUE_FULL,
    QUEUE_FULL,
    MEMORY_FULL,
    ANSWERS_FULL,
    STREAMS_FULL,
    SHUTTING_DOWN,
];
