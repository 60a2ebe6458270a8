//! The status body of a job, after the statusInfo of OGC API - Processes, in snake_case.

use super::problem::Problem;
use super::request::Request;
use super::timestamp::rfc3339;
use crate::budget::LoadStep;
use crate::jobs::{Job, JobId, JobState, Status};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Status words of OGC API - Processes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum StatusWord {
    /// Waits in the queue.
    Accepted,
    /// Under way.
    Running,
    /// There are results.
    Successful,
    /// There are none; `problem` says why.
    Failed,
    /// Cancelled.
    Dismissed,
}

/// How far the analysis has come.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct ProgressBody {
    /// Load factor reached.
    load_factor: f64,
    /// Contact events so far.
    events: usize,
}

impl From<LoadStep> for ProgressBody {
    fn from(step: LoadStep) -> Self {
        let LoadStep { load_factor, events } = step;
        ProgressBody { load_factor, events }
    }
}

/// Where to go from here.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct Links {
    /// This status.
    #[serde(rename = "self")]
    status: String,
    /// The request, defaults filled in.
    request: String,
    /// What becomes of the job, as it happens.
    events: String,
    /// The results.
    results: String,
}

/// Where a job stands.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct JobStatus {
    /// Its name, a UUID of version 7.
    #[schema(format = "uuid")]
    job_id: String,
    /// What the request calls itself.
    name: Option<String>,
    /// Always `process`.
    #[serde(rename = "type")]
    #[schema(example = "process")]
    kind: &'static str,
    /// Where it stands, in one word.
    status: StatusWord,
    /// When it was accepted, UTC.
    #[schema(format = "date-time")]
    created: String,
    /// When a worker took it, UTC.
    #[schema(format = "date-time")]
    started: Option<String>,
    /// When it ended, UTC.
    #[schema(format = "date-time")]
    finished: Option<String>,
    /// Seconds a worker spent on it, once it has ended.
    wall_time_s: Option<f64>,
    /// Place in the queue, 1 for the next; null unless it waits.
    #[schema(minimum = 1)]
    queue_position: Option<usize>,
    /// How far the analysis has come; null before its first step.
    progress: Option<ProgressBody>,
    /// Why there are no results; null unless failed.
    problem: Option<Problem>,
    /// Where to go from here.
    links: Links,
}

/// A list of jobs.
#[derive(Debug, Serialize, ToSchema)]
pub struct JobList {
    /// Newest first.
    pub jobs: Vec<JobStatus>,
    /// Where to go from here.
    pub links: ListLinks,
}

/// Where to go from a list.
#[derive(Debug, Serialize, ToSchema)]
pub struct ListLinks {
    /// The jobs submitted before these; left out where there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub next: Option<String>,
}

/// A status as the wire has it.
pub fn word(status: Status) -> &'static str {
    match status {
        Status::Accepted => "accepted",
        Status::Running => "running",
        Status::Successful => "successful",
        Status::Failed => "failed",
        Status::Dismissed => "dismissed",
    }
}

/// The path of a job's status.
pub fn path(id: JobId) -> String {
    format!("/v1/jobs/{id}")
}

impl Links {
    fn new(id: JobId) -> Self {
        let status = path(id);
        let [request, events, results] = ["request", "events", "results"].map(|part| format!("{status}/{part}"));
        Links { status, request, events, results }
    }
}

impl From<&Job<Request>> for JobStatus {
    fn from(job: &Job<Request>) -> Self {
        JobStatus {
            job_id: job.id.to_string(),
            name: job.request.name().map(str::to_owned),
            kind: "process",
            status: job.status().into(),
            created: rfc3339(job.created.wall),
            started: job.started.map(|moment| rfc3339(moment.wall)),
            finished: job.finished.map(|moment| rfc3339(moment.wall)),
            wall_time_s: job.wall_time().map(|time| time.as_secs_f64()),
            queue_position: job.position,
            progress: job.progress.step().map(Into::into),
            problem: match &job.state {
                JobState::Failed(failure) => Some(failure.into()),
                _ => None,
            },
            links: Links::new(job.id),
        }
    }
}

impl From<Status> for StatusWord {
    fn from(status: Status) -> Self {
        match status {
            Status::Accepted => StatusWord::Accepted,
            Status::Running => StatusWord::Running,
            Status::Successful => StatusWord::Successful,
            Status::Failed => StatusWord::Failed,
            Status::Dismissed => StatusWord::Dismissed,
        }
    }
}

impl From<StatusWord> for Status {
    fn from(word: StatusWord) -> Self {
        match word {
            StatusWord::Accepted => Status::Accepted,
            StatusWord::Running => Status::Running,
            StatusWord::Successful => Status::Successful,
            StatusWord::Failed => Status::Failed,
            StatusWord::Dismissed => Status::Dismissed,
        }
    }
}
