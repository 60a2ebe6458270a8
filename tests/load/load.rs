//! Many clients submit, many more look on; every job ends once and right.

use super::clients::{Job, Stopper, insist, poll};
use super::process::{Voussoir, solve};
use super::report::{Report, milliseconds, percentile, spread};
use super::requests::arch;
use std::sync::RwLock;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread::{scope, sleep};
use std::time::{Duration, Instant};

const JOBS: usize = 10_000;
const VARIANTS: usize = 16;
const CLIENTS: usize = 64;
const POLLERS: usize = 200;

/// Longest that 99 of 100 looks at a status may take.
const LOOK: Duration = Duration::from_millis(25);

pub fn run(part: usize, report: &mut Report) {
    let bodies: Vec<String> = (0..VARIANTS).map(arch).collect();
    let alone: Vec<Vec<u8>> = bodies.iter().map(|body| solve(body)).collect();
    let (queue, bytes) = ("1000", "4294967296");
    let of_all = ["--jobs-kept", "20000", "--queue", queue, "--kept-bytes", bytes];
    // All clients here are one to the service.
    let of_one = ["--queue-per-client", queue, "--kept-bytes-per-client", bytes];
    let service = Voussoir::serve(&[of_all.as_slice(), &of_one].concat());
    let jobs = RwLock::new(Vec::new());
    report.promise(
        one_by_one(&service, &bodies, &alone, &jobs),
        "a job on the idle service gives what solve --json gives",
    );
    let mut idle = watched(&service, &jobs, || sleep(Duration::from_secs((10 / part.min(5)) as u64)));
    let clock = Instant::now();
    let mut refused = 0;
    let mut busy = watched(&service, &jobs, || {
        refused = submit(&service, &bodies, &jobs, JOBS / part);
        assert!(service.settles("voussoir_queue_length", 0, Duration::from_secs(600)).is_some());
    });
    let took = clock.elapsed().as_secs_f64();
    let jobs = jobs.into_inner().unwrap();
    report.figure("jobs accepted", jobs.len());
    report.figure("submissions refused with 503 and repeated", refused);
    report.figure("jobs per second", format_args!("{:.0}", JOBS as f64 / part as f64 / took));
    report.figure("a look at a status, idle service", spread(&mut idle));
    report.figure("a look at a status, under load", spread(&mut busy));
    let [quiet, loaded] = [&mut idle, &mut busy].map(|times| percentile(times, 0.99));
    report.figure("p99 under load over p99 idle", format_args!("{:.1}", milliseconds(loaded) / milliseconds(quiet)));
    report.promise(loaded < LOOK, "p99 of a look at a status is under 25 ms");
    report.figure("resident memory, MiB", service.resident() / 1024);
    report.figure("bytes held for jobs, MiB", service.metric("voussoir_held_bytes") >> 20);
    let faulty = compare(&service, &jobs, &alone);
    report.promise(faulty == 0, "every job is successful, stays so, and its results are those computed alone");
    counters(&service, jobs.len() as u64, report);
    report.quiet(&service.troubles());
}

/// Every request once, with nothing else going on.
fn one_by_one(service: &Voussoir, bodies: &[String], alone: &[Vec<u8>], jobs: &RwLock<Vec<Job>>) -> bool {
    let mut client = service.client();
    let mut same = true;
    for (variant, body) in bodies.iter().enumerate() {
        let path = client.submit(body);
        client.ended(&path);
        same &= client.get(&format!("{path}/results")).body == alone[variant];
        jobs.write().unwrap().push(Job { path, variant });
    }
    same
}

/// How long looks at statuses take while something goes on.
fn watched(service: &Voussoir, jobs: &RwLock<Vec<Job>>, work: impl FnOnce()) -> Vec<Duration> {
    let stop = AtomicBool::new(false);
    scope(|scope| {
        let looks = scope.spawn(|| poll(service, POLLERS, jobs, &stop));
        let stopper = Stopper(&stop);
        work();
        drop(stopper);
        looks.join().unwrap()
    })
}

/// Clients submit so many jobs; how often they were refused.
fn submit(service: &Voussoir, bodies: &[String], jobs: &RwLock<Vec<Job>>, count: usize) -> usize {
    let next = AtomicUsize::new(0);
    let work = || {
        let (mut client, mut refusals) = (service.client(), 0);
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= count {
                return refusals;
            }
            let variant = number % bodies.len();
            let (path, refused) = insist(&mut client, &bodies[variant], Duration::from_millis(500));
            jobs.write().unwrap().push(Job { path, variant });
            refusals += refused;
        }
    };
    scope(|scope| {
        let clients: Vec<_> = (0..CLIENTS).map(|_| scope.spawn(work)).collect();
        clients.into_iter().map(|client| client.join().unwrap()).sum()
    })
}

/// How many jobs are not successful, change afterwards, or have other results.
fn compare(service: &Voussoir, jobs: &[Job], alone: &[Vec<u8>]) -> usize {
    let faulty = |job: &Job| {
        let mut client = service.client();
        let status = client.ended(&job.path);
        let same = client.get(&format!("{}/results", job.path)).body == alone[job.variant];
        !same || status["status"] != "successful" || client.get(&job.path).json() != status
    };
    scope(|scope| {
        let shares = jobs.chunks(jobs.len().div_ceil(4));
        let counts: Vec<_> =
            shares.map(|share| scope.spawn(move || share.iter().filter(|job| faulty(job)).count())).collect();
        counts.into_iter().map(|count| count.join().unwrap()).sum()
    })
}

fn counters(service: &Voussoir, accepted: u64, report: &mut Report) {
    let [good, failed, dismissed] = ["successful", "failed", "dismissed"].map(|outcome| service.outcomes(outcome));
    report.figure("outcomes counted: successful, failed, dismissed", format_args!("{good}, {failed}, {dismissed}"));
    report.promise(good + failed + dismissed == accepted, "the outcomes counted are the jobs accepted");
    let left = service.metric("voussoir_jobs_running") + service.metric("voussoir_queue_length");
    report.promise(left == 0 && service.metric("voussoir_jobs_kept") == accepted, "nothing is left over or forgotten");
}
