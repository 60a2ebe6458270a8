//! Several processes of the real program that share a store in PostgreSQL: what `tests/load` does at length.

#[path = "../load/fleet.rs"]
#[allow(dead_code, reason = "tests/load uses the rest")]
#[allow(clippy::disallowed_methods, reason = "processes are killed by the clock")]
mod processes;

use crate::common::{database, dice};
use crate::serving::{client, process, requests};
use processes::{Fleet, killed};
use requests::{arch, endless, tiny};
use serde_json::Value;
use std::time::Duration;

#[test]
fn no_job_is_lost_with_its_worker() {
    let mut fleet = Fleet::start(2);
    let bodies: Vec<_> = (0..5).map(arch).collect();
    let outcome = killed(&mut fleet, &bodies, 100, Duration::from_millis(500));
    assert!(outcome.kills > 0 && outcome.lost == 0 && outcome.different == 0, "{outcome:?}");
    assert!(fleet.front.troubles().is_empty(), "{:?}", fleet.front.troubles());
}

#[test]
fn each_process_does_its_part() {
    let mut fleet = Fleet::start(1);
    let mut client = fleet.front.client();
    let mut worker = fleet.workers[0].client();
    let path = client.submit(&tiny());
    assert_eq!(client.ended(&path)["status"], "successful");
    let counter = "voussoir_jobs_total{outcome=\"successful\"}";
    assert!(fleet.workers[0].settles(counter, 1, Duration::from_secs(20)).is_some());
    assert_eq!(fleet.front.outcomes("successful"), 0, "who ended it counts it");
    assert_eq!(
        (worker.get("/health/ready").status, worker.get(&path).status, worker.post(&tiny()).status),
        (200, 404, 404)
    );
    // A wish to cancel, and one to stop, reach the worker.
    let cancelled = client.submit(&endless());
    client.until(&cancelled, &["running"]);
    assert_eq!(client.delete(&cancelled).json()["status"], "dismissed");
    let back = client.submit(&endless());
    client.until(&back, &["running"]);
    fleet.workers[0].terminate();
    let ended = fleet.workers[0].wait(Duration::from_secs(20));
    assert_eq!(
        (ended, &client.get(&back).json()["status"]),
        (Some(0), &Value::from("accepted")),
        "another will take it"
    );
    fleet.front.terminate();
    assert_eq!(fleet.front.wait(Duration::from_secs(20)), Some(0));
}
