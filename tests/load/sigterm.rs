//! Told to stop while everyone is at work.

use super::client::Answer;
use super::draining::{Drained, Known, drain};
use super::hostile::{rest, running, stream};
use super::process::Voussoir;
use super::report::{Report, milliseconds};
use super::requests::{arch, endless, moving};
use std::thread::{JoinHandle, sleep, spawn};
use std::time::Duration;

/// After the grace: for a cancelled analysis to notice, for the last answers, and for the rest.
const AFTER_GRACE: Duration = Duration::from_millis(2000 + 2000 + 500);

pub fn run(part: usize, report: &mut Report) {
    shorter(part, report);
    longer(report);
}

/// Jobs that end within the grace do.
fn shorter(part: usize, report: &mut Report) {
    let queue = (40 / part).max(4);
    let queued = queue.to_string();
    let queues = ["--queue", &queued, "--queue-per-client", &queued];
    // Nobody comes to read the results.
    let ending = ["--grace", "60", "--kept-at-least", "0"];
    let mut service = Voussoir::serve(&[["--workers", "1"].as_slice(), &queues, &ending].concat());
    let known = known(&service, &arch(0));
    let posters: Vec<_> = (0..4).map(|_| posts(&service)).collect();
    sleep(Duration::from_secs(1));
    assert!(service.settles("voussoir_queue_length", queue as u64, Duration::from_secs(30)).is_some());
    let last = service.client().get("/v1/jobs?limit=1").json()["jobs"][0]["links"]["self"].as_str().unwrap().to_owned();
    let streams: Vec<_> = (0..5).map(|_| stream(&service, &last)).collect();
    let drained = drain(&mut service, &Known { active: last, ..known }, Duration::from_secs(90));
    let posted = posters.into_iter().map(|poster| poster.join().unwrap());
    let accepted = 1 + posted
        .map(|(accepted, clear)| {
            report.promise(clear, "a client that goes on submitting is told 503 shutting-down");
            accepted
        })
        .sum::<usize>();
    tell(&service, &drained, report);
    report.figure("jobs accepted; ended, by the log", format_args!("{accepted}; {}", service.said("ended")));
    report.promise(service.said("ended") == accepted, "every accepted job ended with its answer");
    let ends = streams.into_iter().map(rest).collect::<Vec<_>>();
    report.promise(
        ends.iter().all(|text| text.as_ref().is_some_and(|text| !text.contains("event: end"))),
        "event streams end in order, before their jobs",
    );
    report.quiet(&service.troubles());
}

/// A job that would take longer is cancelled after the grace.
fn longer(report: &mut Report) {
    let grace = Duration::from_secs(2);
    let mut service = Voussoir::serve(&["--workers", "2", "--grace", "2"]);
    let known = known(&service, &arch(0));
    let mut client = service.client();
    let path = running(&mut client, &endless());
    (0..5).for_each(|_| drop(client.submit(&endless())));
    let (waits, follows) = (waits(&service), stream(&service, &path));
    sleep(Duration::from_millis(500));
    let drained = drain(&mut service, &Known { active: path, ..known }, Duration::from_secs(30));
    tell(&service, &drained, report);
    report.promise(drained.took > grace && drained.took < grace + AFTER_GRACE, "it ends soon after a grace of 2 s");
    let waited = waits.join().unwrap().map(|answer| answer.json()["status"].clone());
    report.promise(
        waited.is_some_and(|status| status == "dismissed"),
        "who waits for a job is told that it is dismissed",
    );
    report.promise(rest(follows).is_some(), "the event stream ends in order");
    report.promise(service.said("ended") == 8 && service.said("an analysis would not stop") == 0, "the analyses stop");
    report.quiet(&service.troubles());
}

fn tell(service: &Voussoir, drained: &Drained, report: &mut Report) {
    let Drained { code, noticed, deaf, took, rounds, wrong } = drained;
    report.figure("SIGTERM to readiness denied, ms", format_args!("{:.1}", milliseconds(*noticed)));
    report.figure(
        "SIGTERM to the last answer, to the end, s",
        format_args!("{:.2}, {:.2}", deaf.as_secs_f64(), took.as_secs_f64()),
    );
    report.figure("rounds of questions meanwhile", rounds);
    report.promise(*code == Some(0) && service.said("stopped") == 1, "it ends with exit code 0");
    report
        .promise(wrong.is_empty() && *rounds > 0, "not ready, no submissions, statuses and results readable meanwhile");
    wrong.iter().take(3).for_each(|wrong| report.figure("   came instead", wrong));
}

/// A job that has ended.
fn known(service: &Voussoir, body: &str) -> Known {
    let mut client = service.client();
    let done = client.submit(body);
    client.ended(&done);
    let results = client.get(&format!("{done}/results")).body;
    Known { active: done.clone(), done, results, body: body.to_owned() }
}

/// Submits until the service stops; how many were accepted, and whether the last answer said why.
fn posts(service: &Voussoir) -> JoinHandle<(usize, bool)> {
    let (mut client, body) = (service.client(), moving(1));
    spawn(move || {
        let mut accepted = 0;
        loop {
            match client.post(&body).accepted() {
                Ok(_) => accepted += 1,
                Err(answer) if answer.is_problem(503, ":queue-full") => sleep(Duration::from_millis(20)),
                Err(answer) => return (accepted, answer.is_problem(503, ":shutting-down")),
            }
        }
    })
}

/// A client that waits for a job that does not end.
fn waits(service: &Voussoir) -> JoinHandle<Option<Answer>> {
    let (mut client, body) = (service.client(), endless());
    let headers = "content-type: application/json\r\nprefer: wait=20\r\n";
    spawn(move || client.call("POST", "/v1/jobs", headers, body.as_bytes()).ok())
}
