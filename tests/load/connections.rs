//! Connections as the open internet has them.

use super::hostile::{
    deaf, half_closed, in_sequence, pipelined, refusals, rest, running, slow_body, slow_heads, stream, vanish,
};
use super::process::{Voussoir, solve};
use super::report::{Report, milliseconds};
use super::requests::{arch, endless, fine};
use std::thread::{scope, sleep};
use std::time::{Duration, Instant};

const SECOND: Duration = Duration::from_secs(1);

/// Connections that may just be on their way out.
const SPARE: usize = 2;

const HEAD: &[u8] =
    b"GET /v1/jobs HTTP/1.1\r\nhost: localhost\r\nx-slow: 0123456789012345678901234567890123456789\r\n\r\n";

pub fn run(part: usize, report: &mut Report) {
    let service = Voussoir::serve(&["--workers", "1", "--request-time", "2", "--body-limit", "65536"]);
    // Once it answers it has opened what it needs for itself.
    assert_eq!(in_sequence(&service, 1), 1);
    let before = service.open_files();
    slow(&service, part, report);
    halves(&service, report);
    unread(&service, before, report);
    gone(&service, part, report);
    sequence(&service, 10_000 / part, report);
    for (what, status, as_problem, answer) in refusals(&service, 65_536) {
        let known = answer
            .as_ref()
            .is_some_and(|answer| answer.status == status && (!as_problem || answer.is_problem(status, "")));
        report.promise(known, &format!("{what}: {status}"));
        if let Some(answer) = answer.filter(|_| !known) {
            report.figure("   came instead", answer.status);
        }
    }
    report.promise(pipelined(&service) == Some([200, 404]), "two requests at once are answered in turn");
    sleep(3 * SECOND);
    report.figure("files open before and after", format_args!("{before}, {}", service.open_files()));
    report.promise(service.open_files() <= before + SPARE, "no connection is left open");
    report.quiet(&service.troubles());
}

fn slow(service: &Voussoir, part: usize, report: &mut Report) {
    for (name, head) in [("one byte a second", HEAD), ("silent", b"".as_slice())] {
        let closed = slow_heads(service, 200 / part.min(10), head, SECOND, 20 * SECOND);
        let (all, slowest) = (closed.all.unwrap_or_default(), closed.slowest_answer);
        report.promise(closed.all.is_some_and(|all| all < 6 * SECOND), &format!("{name}: closed within 6 s"));
        report.figure("   all closed after, s", format_args!("{:.2}", all.as_secs_f64()));
        report.figure("   another client waited at most, ms", format_args!("{:.1}", milliseconds(slowest)));
        report.promise(slowest < SECOND, &format!("{name}: others are answered meanwhile"));
    }
    let bodies: Vec<_> = scope(|scope| {
        let clients: Vec<_> = (0..20).map(|_| scope.spawn(|| slow_body(service))).collect();
        clients.into_iter().map(|client| client.join().unwrap()).collect()
    });
    report.promise(bodies.iter().all(|answer| answer.is_problem(408, "")), "slow bodies: 408");
}

/// Clients that have said all they will still get the whole answer.
fn halves(service: &Voussoir, report: &mut Report) {
    let body = arch(0);
    let answer = half_closed(service, "POST", "/v1/jobs", "prefer: wait=20\r\n", &body);
    let path = answer.and_then(|answer| answer.accepted().ok());
    report.promise(path.is_some(), "half-closed: a submission that waits is answered");
    let results = path.and_then(|path| half_closed(service, "GET", &format!("{path}/results"), "", ""));
    report.promise(results.is_some_and(|answer| answer.body == solve(&body)), "half-closed: whole results");
}

/// Clients that ask and never read are hung up on.
fn unread(service: &Voussoir, before: usize, report: &mut Report) {
    let mut client = service.client();
    let path = client.submit(&fine(2, 24));
    client.ended(&path);
    let clients: Vec<_> = (0..20).map(|_| deaf(service, &format!("{path}/results"), 500)).collect();
    let clock = Instant::now();
    sleep(SECOND / 2);
    report.promise(service.open_files() >= before + clients.len(), "clients that never read are borne for a while");
    while service.open_files() > before + SPARE && clock.elapsed() < 20 * SECOND {
        sleep(SECOND / 20);
    }
    report.promise(service.open_files() <= before + SPARE, "and then hung up on");
    report.figure("   after, s", format_args!("{:.2}", clock.elapsed().as_secs_f64()));
}

/// Clients that go in the middle of an answer or of a stream.
fn gone(service: &Voussoir, part: usize, report: &mut Report) {
    let mut client = service.client();
    let long = client.submit(&fine(2, 24));
    client.ended(&long);
    for _ in 0..200 / part {
        vanish(service, &format!("{long}/results")).unwrap();
    }
    let at_work = running(&mut client, &endless());
    let ahead = [0; 3].map(|_| client.submit(&endless()));
    let waits = client.submit(&arch(0));
    for (name, path) in [("running", &at_work), ("waiting", &waits)] {
        drop((0..50).map(|_| stream(service, path)).collect::<Vec<_>>());
        let back = service.settles("voussoir_event_streams", 0, 30 * SECOND);
        report.promise(back.is_some(), &format!("streams of a {name} job are given back when their clients go"));
        report.figure("   after, s", format_args!("{:.2}", back.unwrap_or_default().as_secs_f64()));
    }
    let stays = stream(service, &at_work);
    // The first connection has been silent for too long.
    let mut client = service.client();
    ahead.iter().chain([&at_work]).for_each(|path| drop(client.delete(path)));
    report.promise(rest(stays).is_some_and(|text| text.contains("event: end")), "who stays is told the end");
    report.promise(client.ended(&waits)["status"] == "successful", "and the next job runs");
}

fn sequence(service: &Voussoir, count: usize, report: &mut Report) {
    let clock = Instant::now();
    let answered = in_sequence(service, count);
    let rate = count as f64 / clock.elapsed().as_secs_f64();
    report.figure("connections one after the other, per second", format_args!("{rate:.0}"));
    report.promise(answered == count, &format!("{count} connections in sequence are all answered"));
}
