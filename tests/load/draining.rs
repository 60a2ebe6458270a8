//! A service from SIGTERM to its end, as its clients see it.

use super::client::Client;
use super::process::Voussoir;
use std::io;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// What clients know when the service is told to stop.
pub struct Known {
    /// A job that has ended, and its results.
    pub done: String,
    pub results: Vec<u8>,
    /// A job that may still be at it.
    pub active: String,
    /// A request that would be accepted.
    pub body: String,
}

/// What they saw.
#[derive(Debug)]
pub struct Drained {
    /// None where the service did not end in time, or not by itself.
    pub code: Option<i32>,
    /// From SIGTERM to readiness denied, to the first question without an answer, to the end.
    pub noticed: Duration,
    pub deaf: Duration,
    pub took: Duration,
    /// Times everything was asked, and what was not answered as it should be.
    pub rounds: usize,
    pub wrong: Vec<String>,
}

/// Tells the service to stop and asks it everything again and again until it is gone.
pub fn drain(service: &mut Voussoir, known: &Known, patience: Duration) -> Drained {
    let mut client = service.client();
    service.terminate();
    let clock = Instant::now();
    while client.call("GET", "/health/ready", "", b"").is_ok_and(|answer| answer.status == 200) {
        sleep(Duration::from_millis(1));
    }
    let (noticed, mut rounds, mut wrong) = (clock.elapsed(), 0, Vec::new());
    while round(&mut client, known, &mut wrong).is_ok() {
        rounds += 1;
        sleep(Duration::from_millis(10));
    }
    let deaf = clock.elapsed();
    let code = service.wait(patience.saturating_sub(deaf));
    Drained { code, noticed, deaf, took: clock.elapsed(), rounds, wrong }
}

/// Asks everything once; an error where there is nobody to answer.
fn round(client: &mut Client, known: &Known, wrong: &mut Vec<String>) -> io::Result<()> {
    let json = "content-type: application/json\r\n";
    let results = format!("{}/results", known.done);
    let answers = [
        ("readiness", client.call("GET", "/health/ready", "", b"")?),
        ("submission", client.call("POST", "/v1/jobs", json, known.body.as_bytes())?),
        ("life", client.call("GET", "/health/live", "", b"")?),
        ("status", client.call("GET", &known.active, "", b"")?),
        ("results", client.call("GET", &results, "", b"")?),
    ];
    for (what, answer) in answers {
        let right = match what {
            "readiness" | "submission" => answer.is_problem(503, ":shutting-down"),
            "results" => answer.body == known.results,
            _ => answer.status == 200,
        };
        if !right {
            wrong.push(format!("{what}: {} {}", answer.status, answer.text()));
        }
    }
    Ok(())
}
