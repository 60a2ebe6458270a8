//! The status body of a job, after the statusInfo of OGC API - Processes, in snake_case.

use super::problem::Problem;
use super::timestamp::rfc3339;
use crate::jobs::{Job, JobId, State, Status};
use serde::Serialize;
use utoipa::ToSchema;

/// Status words of OGC API - Processes.
#[derive(Debug, Clone, Copy, Serialize, ToSchema)]
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

/// Where to go from here.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct Links {
    /// This status.
    #[serde(rename = "self")]
    status: String,
    /// The results.
    results: String,
}

/// Where a job stands.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct JobStatus {
    /// Its name, a UUID of version 7.
    #[schema(format = "uuid")]
    job_id: String,
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
}

/// The path of a job's status.
pub fn path(id: JobId) -> String {
    format!("/v1/jobs/{id}")
}

impl<T> From<&Job<T>> for JobStatus {
    fn from(job: &Job<T>) -> Self {
        let progress = job.progress.step();
        JobStatus {
            job_id: job.id.to_string(),
            kind: "process",
            status: job.status().into(),
            created: rfc3339(job.created.wall),
            started: job.started.map(|moment| rfc3339(moment.wall)),
            finished: job.finished.map(|moment| rfc3339(moment.wall)),
            wall_time_s: job.wall_time().map(|time| time.as_secs_f64()),
            progress: progress.map(|step| ProgressBody { load_factor: step.load_factor, events: step.events }),
            problem: match &job.state {
                State::Failed(failure) => Some(failure.into()),
                _ => None,
            },
            links: Links { status: path(job.id), results: format!("{}/results", path(job.id)) },
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
