//! Polite clients among others that flood, read slowly, and send what is slow to refuse, until the service is told to stop: nobody
//! polite loses an answer.

use super::client::{Answer, Client, connect, request};
use super::clients::Stopper;
use super::process::{Voussoir, solve};
use super::report::{Report, percentile, spread};
use super::requests::{arch, case, tiny};
use serde_json::{Value, json};
use std::io::{self, Read, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{scope, sleep};
use std::time::{Duration, Instant};

const TIME: Duration = Duration::from_secs(60);
const POLITE: usize = 150;
const FLOODING: usize = 8;
const READING: usize = 4;
const REFUSED: usize = 64;
/// What a slow reader takes at once, and the time between.
const SIP: usize = 1 << 16;
const BETWEEN_SIPS: Duration = Duration::from_millis(50);
/// Resident memory stays below, KiB; and looks are answered within, at the 99th percentile.
const MOST_MEMORY: u64 = 2 << 20;
const MOST_TIME: Duration = Duration::from_millis(100);
/// Time between two looks, and that a client waits that is not told how long.
const PAUSE: Duration = Duration::from_millis(10);
const WAIT: Duration = Duration::from_secs(1);

/// What polite clients came to see.
#[derive(Debug, Default)]
struct Seen {
    /// From submission to the answer.
    times: Vec<Duration>,
    refused: usize,
    /// Answers that did not come, or were others.
    lost: Vec<String>,
}

pub fn run(part: usize, report: &mut Report) {
    let tokens = ["polite", "flooding", "reading", "refused"].map(|token| ["--token", token]);
    let mut service = Voussoir::serve(&tokens.concat());
    let stop = AtomicBool::new(false);
    let body = arch(0);
    let alone = solve(&body);
    let (mut seen, mut looks, memory, others) = scope(|scope| {
        let polite: Vec<_> = (0..POLITE).map(|_| scope.spawn(|| polite(service.client(), &body, &alone))).collect();
        let flooding: Vec<_> = (0..FLOODING).map(|_| scope.spawn(|| flood(service.client(), &stop))).collect();
        let reading: Vec<_> = (0..READING).map(|_| scope.spawn(|| read(&service, &stop))).collect();
        let refused: Vec<_> = (0..REFUSED).map(|_| scope.spawn(|| be_refused(service.client(), &stop))).collect();
        let looking = scope.spawn(|| look(&service, &stop));
        let stopper = Stopper(&stop);
        sleep(TIME / u32::try_from(part).unwrap());
        drop(stopper);
        let (looks, memory) = looking.join().unwrap();
        let others = [flooding, reading, refused].map(|crowd| crowd.into_iter().map(|one| one.join().unwrap()).sum());
        service.terminate();
        (polite.into_iter().map(|one| one.join().unwrap()).fold(Seen::default(), both), looks, memory, others)
    });
    let [flooded, read, refused]: [usize; 3] = others;
    report
        .figure("jobs of the flood; large answers read; bodies refused", format_args!("{flooded}; {read}; {refused}"));
    report.figure("polite submissions told to wait", seen.refused);
    report.figure("from a polite submission to its answer", spread(&mut seen.times));
    report.figure("looks at a status and at health", spread(&mut looks));
    report.figure("resident memory, MiB", memory >> 10);
    seen.lost.iter().take(3).for_each(|lost| report.figure("   lost", lost));
    report.promise(seen.lost.is_empty() && !seen.times.is_empty(), "every answer that was promised is read");
    report.promise(read > 0 && refused > 0 && flooded > 0, "the others are served, too");
    report.promise(percentile(&mut looks, 0.99) < MOST_TIME, "99 of 100 looks are answered within 100 ms");
    report.promise(memory < MOST_MEMORY, "resident memory stays under 2 GiB");
    report.promise(service.wait(Duration::from_secs(30)) == Some(0), "it ends with exit code 0");
    report.quiet(&service.troubles());
}

fn both(mut seen: Seen, more: Seen) -> Seen {
    seen.times.extend(more.times);
    seen.lost.extend(more.lost);
    Seen { refused: seen.refused + more.refused, ..seen }
}

/// Headers of a client.
fn of(token: &str) -> String {
    format!("authorization: Bearer {token}\r\ncontent-type: application/json\r\n")
}

/// How long an answer says to wait.
fn told(answer: &Answer) -> Duration {
    let seconds = answer.header("retry-after").and_then(|seconds| seconds.parse().ok());
    seconds.map_or(WAIT, Duration::from_secs)
}

/// Submits, waits as it is told, and reads, again and again until nothing more is accepted.
fn polite(mut client: Client, body: &str, alone: &[u8]) -> Seen {
    let (mut seen, headers) = (Seen::default(), of("polite"));
    loop {
        let clock = Instant::now();
        let submitted = ask(&mut client, "POST", "/v1/jobs", &headers, body.as_bytes());
        match submitted.map(Answer::accepted) {
            Ok(Ok(path)) => match answered(&mut client, &path, &headers) {
                Ok(answer) if answer.status == 200 && answer.body == alone => seen.times.push(clock.elapsed()),
                Ok(answer) => seen.lost.push(format!("{path}: {} {}", answer.status, answer.text())),
                Err(error) => seen.lost.push(format!("{path}: {error}")),
            },
            Ok(Err(answer)) if answer.is_problem(503, ":shutting-down") => return seen,
            Ok(Err(answer)) if [429, 503].contains(&answer.status) => {
                seen.refused += 1;
                sleep(told(&answer));
            }
            Ok(Err(answer)) => seen.lost.push(format!("{} {}", answer.status, answer.text())),
            // It has ended.
            Err(_) => return seen,
        }
    }
}

/// Asks; a connection that was silent for too long has been closed, and another is opened.
fn ask(client: &mut Client, method: &str, path: &str, headers: &str, body: &[u8]) -> io::Result<Answer> {
    client.call(method, path, headers, body).or_else(|_| client.call(method, path, headers, body))
}

/// The answer of a job, looked for as often as its status says.
fn answered(client: &mut Client, path: &str, headers: &str) -> io::Result<Answer> {
    loop {
        let status = ask(client, "GET", path, headers, b"")?;
        if status.status != 200 || !["accepted", "running"].contains(&status.json()["status"].as_str().unwrap()) {
            return ask(client, "GET", &format!("{path}/results"), headers, b"");
        }
        sleep(told(&status));
    }
}

/// Submits what takes no time and never reads it; how many jobs.
fn flood(mut client: Client, stop: &AtomicBool) -> usize {
    let (mut accepted, body, headers) = (0, tiny(), of("flooding"));
    while !stop.load(Ordering::Relaxed) {
        match client.call("POST", "/v1/jobs", &headers, body.as_bytes()).unwrap().accepted() {
            Ok(_) => accepted += 1,
            Err(answer) => assert!([429, 503].contains(&answer.status), "{}", answer.text()),
        }
    }
    accepted
}

/// Reads large answers slowly; how many.
fn read(service: &Voussoir, stop: &AtomicBool) -> usize {
    let mut large = case("first-arch");
    large["mesh"] = json!({"subblocks": {"uniform": {"radial": 12, "along": 12}}});
    large["report"] = json!({"stress_fields": ["unit_load", {"load_factor": 100}, "near_collapse"]});
    let (mut client, headers, mut read) = (service.client(), of("reading"), 0);
    while !stop.load(Ordering::Relaxed) {
        match client.call("POST", "/v1/jobs", &headers, large.to_string().as_bytes()).unwrap().accepted() {
            Ok(path) => {
                while client.call("GET", &path, &headers, b"").unwrap().json()["status"] != "successful" {
                    sleep(WAIT);
                }
                read += usize::from(sip(service, &format!("{path}/results"), &headers));
            }
            Err(answer) => sleep(told(&answer)),
        }
    }
    read
}

/// Reads an answer to its end in sips; whether it was given.
fn sip(service: &Voussoir, path: &str, headers: &str) -> bool {
    let mut stream = connect(service.address).unwrap();
    let head = format!("{headers}connection: close\r\n");
    stream.write_all(&request("GET", path, &head, b"")).unwrap();
    let (mut sip, mut all) = (vec![0; SIP], 0);
    while let Ok(bytes @ 1..) = stream.read(&mut sip) {
        all += bytes;
        sleep(BETWEEN_SIPS);
    }
    all > SIP
}

/// Sends what is faulty in many places; how often.
fn be_refused(mut client: Client, stop: &AtomicBool) -> usize {
    let load: Value = (0..25).map(|k| (format!("fault_{k}"), json!(k))).collect();
    let body = json!({"loads": vec![load; 1000]}).to_string();
    let (mut refused, headers) = (0, of("refused"));
    while !stop.load(Ordering::Relaxed) {
        // A service that refuses hangs up before all is sent.
        let Ok(answer) = client.call("POST", "/v1/validate", &headers, body.as_bytes()) else { continue };
        assert!([422, 429, 503].contains(&answer.status), "{}", answer.text());
        refused += usize::from(answer.status == 422);
    }
    refused
}

/// Looks at health and at the list of what runs until told to stop: how long each look took, and the most memory meanwhile, KiB.
fn look(service: &Voussoir, stop: &AtomicBool) -> (Vec<Duration>, u64) {
    let (mut client, headers, mut times, mut memory) = (service.client(), of("polite"), vec![], 0);
    while !stop.load(Ordering::Relaxed) {
        for path in ["/health/live", "/v1/jobs?status=running"] {
            let clock = Instant::now();
            let answer = client.call("GET", path, &headers, b"").unwrap();
            times.push(clock.elapsed());
            assert_eq!(answer.status, 200, "{path}");
        }
        memory = memory.max(service.resident());
        sleep(PAUSE);
    }
    (times, memory)
}
