//! One who follows a job: what there is to tell of it, and when.

use crate::budget::LoadStep;
use crate::http::service::Service;
use crate::http::status::JobStatus;
use crate::jobs::{Job, Status};
use crate::wire::json::{NotFinite, compact};
use futures_util::stream::{self, Stream};
use serde::Serialize;
use std::sync::Arc;
use std::time::Duration;
use tokio::time::{Instant, sleep_until};

/// How often a running analysis is looked at: in this process, and where others tell of it, once a second.
const LOOK: Duration = Duration::from_millis(200);
const LOOK_ELSEWHERE: Duration = Duration::from_secs(1);

/// Longest silence: then it is told again how the job stands, and so it is learnt whether the client is still there.
const SILENCE: Duration = Duration::from_secs(2);

/// What is told of a job.
pub(super) struct Told {
    /// `status`, `step` or `end`.
    pub(super) name: &'static str,
    /// How the job stands.
    pub(super) seen: Seen,
    /// The same in JSON.
    pub(super) data: String,
}

/// A running job since the last event: what `step` says.
#[derive(Serialize)]
struct Step<'j> {
    job_id: &'j str,
    #[serde(flatten)]
    progress: LoadStep,
    wall_time_s: Option<f64>,
}

/// How a job stood when a client was last told.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Seen {
    pub(super) status: Status,
    events: Option<usize>,
}

impl Seen {
    fn of(job: &Job) -> Self {
        Seen { status: job.status(), events: job.progress.map(|step| step.events) }
    }

    /// As an event's id has it: `running-153`.
    pub(super) fn write(self) -> String {
        let events = self.events.map(|events| format!("-{events}")).unwrap_or_default();
        format!("{}{events}", self.status.word())
    }

    pub(super) fn read(id: &str) -> Option<Self> {
        let (name, events) = id.split_once('-').map_or((id, None), |(name, events)| (name, events.parse().ok()));
        let status = Status::ALL.into_iter().find(|status| status.word() == name)?;
        Some(Seen { status, events })
    }
}

struct Follower {
    service: Arc<Service>,
    job: Job,
    seen: Option<Seen>,
    told: Instant,
}

/// What becomes of a job after it was `seen`; nothing more after its end, or when the service stops.
pub(super) fn follow(
    service: Arc<Service>,
    job: Job,
    seen: Option<Seen>,
) -> impl Stream<Item = Result<Told, NotFinite>> {
    let follower = Follower { service, job, seen, told: Instant::now() };
    stream::unfold(follower, |mut follower| async { Some((follower.next().await?, follower)) })
}

impl Follower {
    async fn next(&mut self) -> Option<Result<Told, NotFinite>> {
        if self.seen.is_some_and(|seen| seen.status.is_final()) {
            return None;
        }
        loop {
            let (now, silent) = (Seen::of(&self.job), self.told + SILENCE);
            if self.seen != Some(now) || Instant::now() >= silent {
                let told = self.tell(now);
                (self.seen, self.told) = (Some(now), Instant::now());
                return Some(told);
            }
            let (store, id) = (&self.service.store, self.job.id);
            let look = if store.outlives_the_process() { LOOK_ELSEWHERE } else { LOOK };
            let look = if now.status == Status::Running { silent.min(Instant::now() + look) } else { silent };
            let now = tokio::select! {
                () = self.service.stopping.cancelled() => return None,
                changed = store.wait(id, now.status) => changed,
                () = sleep_until(look) => store.job(id).await,
            };
            // One that is forgotten, or that nobody can tell of: the client comes back and asks.
            self.job = now.ok().flatten()?;
        }
    }

    /// A step where the job runs on, else all there is to its status.
    fn tell(&self, seen: Seen) -> Result<Told, NotFinite> {
        let status = JobStatus::from(&self.job);
        let step = self.job.progress.filter(|_| self.seen.is_some_and(|before| before.status == seen.status));
        let (name, data) = match step {
            Some(progress) => {
                ("step", compact(&Step { job_id: &status.job_id, progress, wall_time_s: status.wall_time_s })?)
            }
            None => (if seen.status.is_final() { "end" } else { "status" }, compact(&status)?),
        };
        Ok(Told { name, seen, data })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_id_says_how_the_job_stood() {
        for (status, events) in [(Status::Accepted, None), (Status::Running, Some(0)), (Status::Failed, Some(153))] {
            let seen = Seen { status, events };
            assert_eq!(Seen::read(&seen.write()), Some(seen));
        }
        assert_eq!(Seen::read("something-else"), None);
    }
}
