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

macro_rules! kinds {
    ($($(#[$doc:meta])* $name:ident: $status:ident $uri:literal $title:literal)*) => {
        $($(#[$doc])* pub const $name: ProblemKind =
            ProblemKind { uri: $uri, status: StatusCode::$status, title: $title };)*

        /// All of them, as docs/service.md lists them.
        pub const KINDS: &[ProblemKind] = &[$($name),*];
    };
}

kinds! {
    /// The request is JSON, but describes no analysis.
    INVALID_REQUEST: UNPROCESSABLE_ENTITY "urn:voussoir:problem:invalid-request" "The request cannot be analysed"
    /// The body is not JSON.
    NOT_JSON: BAD_REQUEST "urn:voussoir:problem:not-json" "The body is not JSON"
    /// A query parameter that cannot be.
    BAD_QUERY: BAD_REQUEST "urn:voussoir:problem:bad-query" "The query cannot be read"
    /// A header that cannot be.
    BAD_HEADER: BAD_REQUEST "urn:voussoir:problem:bad-header" "A header cannot be read"
    /// The idempotency key names another request.
    KEY_TAKEN: UNPROCESSABLE_ENTITY "urn:voussoir:problem:key-taken" "The idempotency key was used for another request"
    /// The idempotency key names a job that is forgotten.
    KEY_SPENT: GONE "urn:voussoir:problem:key-spent" "The idempotency key was used for a job that is forgotten"
    /// There is no job of this name.
    NO_SUCH_JOB: NOT_FOUND "http://www.opengis.net/def/exceptions/ogcapi-processes-1/1.0/no-such-job" "No such job"
    /// The job has not ended yet.
    RESULT_NOT_READY: NOT_FOUND "http://www.opengis.net/def/exceptions/ogcapi-processes-1/1.0/result-not-ready"
        "The result is not ready"
    /// The answer has no such part.
    NO_SUCH_PART: NOT_FOUND "urn:voussoir:problem:no-such-part" "The answer has no such part"
    /// The job has ended and cannot be cancelled any more.
    HAS_ENDED: CONFLICT "urn:voussoir:problem:has-ended" "The job has ended"
    /// The job has not ended and cannot be forgotten.
    NOT_ENDED: CONFLICT "urn:voussoir:problem:not-ended" "The job has not ended"
    /// The job was cancelled.
    DISMISSED: GONE "urn:voussoir:problem:dismissed" "The job was dismissed"
    /// The mechanics gave no answer.
    ANALYSIS_FAILED: UNPROCESSABLE_ENTITY "urn:voussoir:problem:analysis-failed" "The analysis failed"
    /// The analysis took longer than a job may.
    ANALYSIS_OVERDUE: UNPROCESSABLE_ENTITY "urn:voussoir:problem:analysis-overdue" "The analysis took too long"
    /// The processes that ran the analysis ended before it did.
    ANALYSIS_LOST: INTERNAL_SERVER_ERROR "urn:voussoir:problem:analysis-lost" "The analysis was given up"
    /// The process took more memory than it may, and this was its largest analysis.
    ANALYSIS_OUTGROWN: UNPROCESSABLE_ENTITY "urn:voussoir:problem:analysis-outgrown" "The analysis took too much memory"
    /// The analysis panicked.
    ANALYSIS_DEFECT: INTERNAL_SERVER_ERROR "urn:voussoir:problem:analysis-defect" "The analysis broke off"
    /// One client has as many jobs waiting as it may.
    CLIENT_QUEUE_FULL: TOO_MANY_REQUESTS "urn:voussoir:problem:client-queue-full"
        "Too many jobs of one client are waiting"
    /// What one client has fills its share of the memory.
    CLIENT_MEMORY_FULL: TOO_MANY_REQUESTS "urn:voussoir:problem:client-memory-full"
        "The memory for jobs of one client is full"
    /// As many jobs wait as may.
    QUEUE_FULL: SERVICE_UNAVAILABLE "urn:voussoir:problem:queue-full" "The queue is full"
    /// The jobs that have not ended fill the memory.
    MEMORY_FULL: SERVICE_UNAVAILABLE "urn:voussoir:problem:memory-full" "The memory for jobs is full"
    /// The bodies on their way in fill the memory for them.
    BODIES_FULL: SERVICE_UNAVAILABLE "urn:voussoir:problem:bodies-full" "Too many bodies are on their way"
    /// The bodies of one client fill what it may have of that memory.
    CLIENT_BODIES_FULL: TOO_MANY_REQUESTS "urn:voussoir:problem:client-bodies-full"
        "Too many bodies of one client are on their way"
    /// The answers on their way fill the memory.
    ANSWERS_FULL: SERVICE_UNAVAILABLE "urn:voussoir:problem:answers-full" "Too many answers are on their way"
    /// The answers to one client fill what it may have of that memory.
    CLIENT_ANSWERS_FULL: TOO_MANY_REQUESTS "urn:voussoir:problem:client-answers-full"
        "Too many answers to one client are on their way"
    /// One client has as many event streams open as it may.
    CLIENT_STREAMS_FULL: TOO_MANY_REQUESTS "urn:voussoir:problem:client-streams-full"
        "Too many event streams of one client are open"
    /// As many event streams are open as may.
    STREAMS_FULL: SERVICE_UNAVAILABLE "urn:voussoir:problem:streams-full" "Too many event streams are open"
    /// The store of jobs cannot be reached.
    STORE_UNAVAILABLE: SERVICE_UNAVAILABLE "urn:voussoir:problem:store-unavailable" "The store of jobs cannot be reached"
    /// The service is ending.
    SHUTTING_DOWN: SERVICE_UNAVAILABLE "urn:voussoir:problem:shutting-down" "The service is shutting down"
}
