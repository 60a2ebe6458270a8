//! When it makes sense to ask again.

use super::problem::Problem;
use super::service::Service;
use crate::jobs::{Job, Occupancy, Refusal, Status};
use std::time::Duration;

/// Longest time after which anybody is asked to come back, s.
const LONGEST: f64 = 60.0;

/// Longest time between two looks at a job, s: half of the grace, and the least while it runs, so that nobody who waits as told
/// comes for an answer when the service has ended.
fn longest_wait(grace: Duration, stopping: bool) -> u64 {
    if stopping { 1 } else { (grace.as_secs() / 2).max(1) }
}

impl Service {
    /// Seconds in which the jobs that `ahead` counts are worked off, as long as jobs take of late: whole ones, at least one.
    async fn time_of(&self, ahead: impl Fn(&Occupancy) -> usize) -> u64 {
        let occupancy = self.store.occupancy().await.unwrap_or_default();
        // Other processes may have workers, too: all who are there are at work when somebody waits.
        let workers = self.work.workers.max(occupancy.running).max(1);
        let time = ahead(&occupancy) as f64 * occupancy.seconds / workers as f64;
        time.clamp(1.0, LONGEST).ceil() as u64
    }

    /// Seconds after which a job may have ended; none where it has.
    pub(super) async fn look_again(&self, job: &Job) -> Option<u64> {
        let time = match job.status() {
            Status::Accepted => self.time_of(|_| job.position.unwrap_or(1)).await,
            Status::Running => self.time_of(|_| 1).await,
            _ => return None,
        };
        Some(time.min(longest_wait(self.settings.grace, self.stopping.is_cancelled())))
    }

    /// A refused submission, and when there may be room for it.
    pub(super) async fn refused(&self, refusal: Refusal) -> Problem {
        if matches!(refusal, Refusal::Unavailable(_)) {
            return Problem::from(refusal).after(1);
        }
        let seconds = self.time_of(|occupancy| occupancy.waiting).await;
        Problem::from(refusal).after(seconds)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_waits_as_told_comes_again_before_the_service_has_ended() {
        let wait = |grace, stopping| longest_wait(Duration::from_secs(grace), stopping);
        assert_eq!([wait(10, false), wait(120, false), wait(0, false), wait(120, true)], [5, 60, 1, 1]);
    }
}
