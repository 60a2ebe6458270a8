//! More work than the service can do: refusals are clear, nothing accepted is lost, memory stays bounded.

use super::clients::Stopper;
use super::process::Voussoir;
use super::report::{Report, milliseconds, spread};
use super::requests::moving;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{scope, sleep};
use std::time::{Duration, Instant};

const SECONDS: usize = 60;
const QUEUE: u64 = 50;
const CLIENTS: usize = 8;

/// Resident memory stays below, MiB.
const MOST_MEMORY: u64 = 256;

/// What one client saw.
#[derive(Debug, Default)]
struct Seen {
    accepted: Vec<String>,
    refusals: Vec<Duration>,
    unclear: usize,
}

pub fn run(part: usize, report: &mut Report) {
    let body = moving(1);
    let queue = ["--queue", "50", "--queue-per-client", "50"];
    let service = Voussoir::serve(&[["--workers", "1", "--jobs-kept", "20000"].as_slice(), &queue].concat());
    let (seen, memory, full) = overload(&service, &body, Duration::from_secs((SECONDS / part).max(2) as u64));
    let accepted: Vec<String> = seen.iter().flat_map(|seen| seen.accepted.clone()).collect();
    let mut refusals: Vec<Duration> = seen.iter().flat_map(|seen| seen.refusals.clone()).collect();
    report.figure("jobs accepted", accepted.len());
    report.figure("a refusal", spread(&mut refusals));
    report.promise(!refusals.is_empty(), "some were refused");
    report.promise(seen.iter().all(|seen| seen.unclear == 0), "every refusal is a 503 queue-full with retry-after");
    report.figure("samples with the queue full", format_args!("{:.1} %", 100.0 * full));
    drain(&service, &body, report);
    let mut client = service.client();
    let lost = accepted.iter().filter(|path| client.ended(path)["status"] != "successful").count();
    report.promise(lost == 0, "every accepted job is successful");
    let counted = service.outcomes("successful");
    report.promise(counted == accepted.len() as u64 + 1, "the outcomes counted are the jobs accepted");
    let (least, most) = (memory.iter().min().unwrap() / 1024, memory.iter().max().unwrap() / 1024);
    report.figure(
        "resident memory, MiB: least, most, after",
        format_args!("{least}, {most}, {}", service.resident() / 1024),
    );
    report.promise(most < MOST_MEMORY, "resident memory stays under 256 MiB");
    report.quiet(&service.troubles());
}

/// Clients that do not take no for an answer, for so long; also samples of the memory, and the share of samples in which
/// the queue was full.
fn overload(service: &Voussoir, body: &str, time: Duration) -> (Vec<Seen>, Vec<u64>, f64) {
    let stop = AtomicBool::new(false);
    let (mut memory, mut full, clock) = (Vec::new(), 0, Instant::now());
    let seen = scope(|scope| {
        let clients: Vec<_> = (0..CLIENTS).map(|_| scope.spawn(|| insist(service, body, &stop))).collect();
        let stopper = Stopper(&stop);
        sleep(Duration::from_secs(1));
        while clock.elapsed() < time {
            memory.push(service.resident());
            // One place may just have become free.
            full += usize::from(service.metric("voussoir_queue_length") + 1 >= QUEUE);
            sleep(Duration::from_millis(100));
        }
        drop(stopper);
        clients.into_iter().map(|client| client.join().unwrap()).collect()
    });
    let share = full as f64 / memory.len() as f64;
    (seen, memory, share)
}

fn insist(service: &Voussoir, body: &str, stop: &AtomicBool) -> Seen {
    let (mut client, mut seen) = (service.client(), Seen::default());
    while !stop.load(Ordering::Relaxed) {
        let clock = Instant::now();
        match client.post(body).accepted() {
            Ok(path) => seen.accepted.push(path),
            Err(answer) => {
                seen.refusals.push(clock.elapsed());
                seen.unclear += usize::from(!answer.is_problem(503, "urn:voussoir:problem:queue-full"));
                sleep(Duration::from_millis(20));
            }
        }
    }
    seen
}

/// The queue empties by itself, and the next client is let in at once.
fn drain(service: &Voussoir, body: &str, report: &mut Report) {
    let drained = service.settles("voussoir_queue_length", 0, Duration::from_secs(300));
    report.promise(drained.is_some(), "the queue drains when the clients stop");
    report.figure("time to drain it, s", format_args!("{:.1}", drained.unwrap_or_default().as_secs_f64()));
    let mut client = service.client();
    let clock = Instant::now();
    let accepted = client.post(body).accepted();
    report.figure("the next submission, ms", format_args!("{:.2}", milliseconds(clock.elapsed())));
    report.promise(accepted.is_ok_and(|path| client.ended(&path)["status"] == "successful"), "it is accepted at once");
}
