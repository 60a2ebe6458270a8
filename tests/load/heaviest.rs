//! The largest analyses that are accepted, all at once: the process keeps to its memory, and others are answered meanwhile.

use super::clients::Stopper;
use super::dice::Dice;
use super::process::Voussoir;
use super::report::{Report, percentile, spread};
use super::scenes::Scene;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{scope, sleep};
use std::time::{Duration, Instant};
use voussoir::collapse::cost::estimate;
use voussoir::wire::read::read_question;

const JOBS: usize = 100;
/// Random requests that the largest are chosen from.
const DRAWN: usize = 1000;
/// Longest request and most memory that the service takes by default, bytes.
const BODY: usize = 1 << 20;
const WORK_MEMORY: usize = 1152 << 20;
/// Resident memory stays below, KiB; and looks are answered within, at the 99th percentile.
const MOST_MEMORY: u64 = 2 << 20;
const MOST_TIME: Duration = Duration::from_millis(100);
/// Time between two looks.
const PAUSE: Duration = Duration::from_millis(10);

pub fn run(part: usize, report: &mut Report) {
    let bodies = largest((JOBS / part).max(1));
    let service = Voussoir::serve(&["--job-time", "5"]);
    let stop = AtomicBool::new(false);
    let mut paths = vec![];
    let mut ends: BTreeMap<String, usize> = BTreeMap::new();
    let (mut looks, memory) = scope(|scope| {
        let looking = scope.spawn(|| look(&service, &stop));
        let stopper = Stopper(&stop);
        let mut client = service.client();
        paths.extend(bodies.iter().map(|(_, body)| client.submit(body)));
        for path in &paths {
            *ends.entry(end(&service, path)).or_default() += 1;
        }
        drop(stopper);
        looking.join().unwrap()
    });
    let estimates: Vec<usize> = bodies.iter().map(|(memory, _)| memory >> 20).collect();
    report.figure(
        "jobs; estimates, MiB: most, least",
        format_args!("{}; {}, {}", bodies.len(), estimates[0], estimates[bodies.len() - 1]),
    );
    report.figure("how they ended", format_args!("{ends:?}"));
    report.figure("looks at a status and at health", spread(&mut looks));
    let most = memory.iter().max().copied().unwrap_or(u64::MAX);
    report.figure("resident memory, MiB: most, after", format_args!("{}, {}", most >> 10, service.resident() >> 10));
    report.promise(most < MOST_MEMORY, "resident memory stays under 2 GiB");
    report.promise(percentile(&mut looks, 0.99) < MOST_TIME, "99 of 100 looks are answered within 100 ms");
    report.promise(!ends.keys().any(|end| end.contains("defect")), "no analysis breaks off");
    report.quiet(&service.troubles());
}

/// The random requests that take the most memory among those that are accepted, with their estimates in bytes.
fn largest(count: usize) -> Vec<(usize, String)> {
    let mut dice = Dice::new(1);
    let mut found = vec![];
    for _ in 0..DRAWN {
        let body = Scene::any(&mut dice).request().to_string();
        let question = (body.len() <= BODY).then(|| read_question(body.as_bytes()).ok()).flatten();
        let Some((_, question)) = question else { continue };
        let demand = estimate(&question);
        if demand.uncrushed <= WORK_MEMORY {
            found.push((demand.uncrushed, body));
        }
    }
    found.sort_by(|a, b| b.cmp(a));
    found.truncate(count);
    found
}

/// How a job has ended. Its answer is forgotten, or it would take the room of others.
fn end(service: &Voussoir, path: &str) -> String {
    let mut client = service.client();
    loop {
        let job = client.get(path).json();
        match job["status"].as_str().unwrap_or_default() {
            "accepted" | "running" => sleep(10 * PAUSE),
            "failed" => return job["problem"]["type"].to_string(),
            word => {
                client.delete(&format!("{path}/results"));
                return word.to_owned();
            }
        }
    }
}

/// Looks at health and at the list of what runs until told to stop: how long each look took, and the memory meanwhile, KiB.
fn look(service: &Voussoir, stop: &AtomicBool) -> (Vec<Duration>, Vec<u64>) {
    let (mut client, mut times, mut memory) = (service.client(), vec![], vec![]);
    while !stop.load(Ordering::Relaxed) {
        for path in ["/health/live", "/v1/jobs?status=running"] {
            let clock = Instant::now();
            let answer = client.get(path);
            times.push(clock.elapsed());
            assert_eq!(answer.status, 200, "{path}");
        }
        memory.push(service.resident());
        sleep(PAUSE);
    }
    (times, memory)
}
