//! The status body of a job, after the statusInfo of OGC API - Processes, in snake_case.

use super::problem::Problem;
use crate::budget::LoadStep;
use crate::jobs::{Job, JobId, JobState, Status};
use humantime::format_rfc3339_millis;
use serde::Serialize;
use std::time::SystemTime;
use utoipa::ToSchema;

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
    pub(super) job_id: String,
    /// What the request calls itself.
    name: Option<String>,
    /// Always `process`.
    #[serde(rename = "type")]
    #[schema(example = "process")]
    kind: &'static str,
    /// Where it stands, in one word.
    status: Status,
    /// When it was accepted, UTC.
    #[schema(format = "date-time")]
    created: String,
    /// When a worker took it, UTC.
    #[schema(format = "date-time")]
    started: Option<String>,
    /// When it ended, UTC.
    #[schema(format = "date-time")]
    finished: Option<String>,
    /// Seconds that a worker has been at it so far or, once it has ended, in all; null before, and where it was dismissed.
    pub(super) wall_time_s: Option<f64>,
    /// Place in the queue, 1 for the next; null unless it waits.
    #[schema(minimum = 1)]
    queue_position: Option<usize>,
    /// How far the analysis has come; null before its first step.
    progress: Option<LoadStep>,
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

/// The path of a job's status.
pub fn path(id: JobId) -> String {
    format!("/v1/jobs/{id}")
}

impl From<&Job> for JobStatus {
    fn from(job: &Job) -> Self {
        let time = |moment: SystemTime| format_rfc3339_millis(moment).to_string();
        let runs = job.started.filter(|_| job.status() == Status::Running);
        // Of another machine whose clock is ahead it has only begun.
        let so_far = || runs.map(|started| started.elapsed().unwrap_or_default());
        let status = path(job.id);
        let [request, events, results] = ["request", "events", "results"].map(|part| format!("{status}/{part}"));
        JobStatus {
            job_id: job.id.to_string(),
            name: job.name.as_deref().map(str::to_owned),
            kind: "process",
            status: job.status(),
            created: time(job.created),
            started: job.started.map(time),
            finished: job.finished.map(time),
            wall_time_s: job.wall_time.or_else(so_far).map(|time| time.as_secs_f64()),
            queue_position: job.position,
            progress: job.progress,
            problem: if let JobState::Failed(failure) = &job.state { Some(failure.into()) } else { None },
            links: Links { status, request, events, results },
        }
    }
}
