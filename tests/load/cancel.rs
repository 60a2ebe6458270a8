//! Long jobs dismissed at random moments: every worker comes back, and soon.

use super::client::Client;
use super::dice::Dice;
use super::process::Voussoir;
use super::report::{Report, milliseconds, spread};
use super::requests::{curve, fine, moving};
use serde_json::Value;
use std::thread::sleep;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

const JOBS: usize = 1000;
const WORKERS: u64 = 2;

/// Jobs that wait while others are dismissed.
const WAITING: u64 = 4;

const DAY: f64 = 86_400.0;

/// Longest wait for a worker to come back.
const PATIENCE: Duration = Duration::from_secs(120);

/// Dismisses jobs one after the other, and keeps count.
struct Driver<'a> {
    service: &'a Voussoir,
    client: Client,
    dice: Dice,
    kinds: [String; 4],
    submitted: usize,
    /// From a dismissal to the start of the next job, by whether the dismissed one has the finest mesh.
    freed: [Vec<Duration>; 2],
    dismissed: usize,
    ended: usize,
}

pub fn run(part: usize, report: &mut Report) {
    let service = Voussoir::serve(&["--workers", &WORKERS.to_string(), "--jobs-kept", "5000"]);
    let kinds = [curve(500), moving(8), moving(4), fine(3, 48)];
    let (client, dice) = (service.client(), Dice::new(1));
    let (freed, service) = ([vec![], vec![]], &service);
    let mut driver = Driver { service, client, dice, kinds, submitted: 0, freed, dismissed: 0, ended: 0 };
    while driver.dismissed < JOBS / part {
        driver.fill();
        driver.round();
    }
    let Driver { submitted, mut freed, mut dismissed, ended, .. } = driver;
    report.figure("jobs dismissed; ended before", format_args!("{dismissed}; {ended}"));
    let [coarse, finest] = &mut freed;
    report.figure("from DELETE to the next start, 48 x 48 meshes", spread(finest));
    report.figure("from DELETE to the next start, others", spread(coarse));
    dismissed += dismiss_all(service);
    let clear = service.settles("voussoir_jobs_running", 0, PATIENCE);
    report.promise(clear.is_some(), "none is left running");
    report.figure("time until none ran, ms", format_args!("{:.1}", milliseconds(clear.unwrap_or_default())));
    let (failed, good) = (service.outcomes("failed"), service.outcomes("successful"));
    report.promise(service.outcomes("dismissed") == dismissed as u64, "the dismissals counted are those answered");
    report.promise(failed == 0 && (dismissed + good as usize) == submitted, "every job ended once, none failed");
    intact(service, report);
    report.quiet(&service.troubles());
}

/// As many jobs run at once as there are workers.
fn intact(service: &Voussoir, report: &mut Report) {
    let (mut client, long) = (service.client(), curve(500));
    for _ in 0..2 * WORKERS {
        client.submit(&long);
    }
    let all = service.settles("voussoir_jobs_running", WORKERS, Duration::from_secs(2)).is_some();
    report.promise(all && service.metric("voussoir_queue_length") == WORKERS, "all workers are at work again");
    dismiss_all(service);
    report.promise(service.settles("voussoir_jobs_running", 0, PATIENCE).is_some(), "and free again");
}

/// Dismisses every job that has not ended; how many those were.
fn dismiss_all(service: &Voussoir) -> usize {
    let mut client = service.client();
    // Those that wait first, so that none of them starts.
    let paths = ["accepted", "running"].map(|status| listed(&mut client, status)).concat();
    paths.iter().filter(|path| client.delete(path).status == 200).count()
}

/// Paths of all jobs of a status, newest first.
fn listed(client: &mut Client, status: &str) -> Vec<String> {
    let jobs = client.get(&format!("/v1/jobs?limit=1000&status={status}")).json();
    let path = |job: &Value| job["links"]["self"].as_str().unwrap().to_owned();
    jobs["jobs"].as_array().unwrap().iter().map(path).collect()
}

impl Driver<'_> {
    /// Lets enough jobs wait.
    fn fill(&mut self) {
        while self.service.metric("voussoir_queue_length") < WAITING {
            let kind = self.dice.below(self.kinds.len());
            self.client.submit(&self.kinds[kind]);
            self.submitted += 1;
        }
    }

    /// Dismisses a job after a random time, one in ten while it waits.
    fn round(&mut self) {
        sleep(Duration::from_secs_f64(self.dice.decades(0.001, 1.0)));
        // In this order, so that no job is in both lists.
        let running = listed(&mut self.client, "running");
        let waiting = listed(&mut self.client, "accepted");
        if self.dice.chance(0.1) {
            let victim = self.dice.below(waiting.len());
            self.dismiss(&waiting[victim]);
            return;
        }
        let (Some(next), false) = (waiting.last(), running.is_empty()) else { return };
        let victim = &running[self.dice.below(running.len())];
        let fine = self.client.get(&format!("{victim}/request")).json()["mesh"]["subblocks"]["uniform"]["radial"] == 48;
        let before = SystemTime::now().duration_since(UNIX_EPOCH).unwrap().as_secs_f64() % DAY;
        if self.dismiss(victim) {
            let status = self.client.until(next, &["running", "successful"]);
            let time = seconds(status["started"].as_str().unwrap()) - before;
            // Starts are told to the millisecond. It may have started on another worker before the dismissal.
            if time > -1e-3 {
                self.freed[usize::from(fine)].push(Duration::from_secs_f64(time.max(0.0)));
            }
        }
    }

    /// True when the job had not ended.
    fn dismiss(&mut self, path: &str) -> bool {
        let status = self.client.delete(path).status;
        assert!(matches!(status, 200 | 204), "{status}");
        self.dismissed += usize::from(status == 200);
        self.ended += usize::from(status == 204);
        status == 200
    }
}

/// Seconds since midnight of a time in RFC 3339.
fn seconds(time: &str) -> f64 {
    let clock = time.trim_end_matches('Z').split('T').nth(1).unwrap();
    clock.split(':').fold(0.0, |sum, part| 60.0 * sum + part.parse::<f64>().unwrap())
}
