//! The real program with clients that are slow, rude or gone, and told to stop: what `tests/load` does at length.
#![allow(clippy::disallowed_methods, reason = "tests wait for jobs by looking again")]
#![allow(dead_code, reason = "tests/load uses the rest")]

#[path = "../load/client.rs"]
mod client;
#[path = "../load/draining.rs"]
mod draining;
#[path = "../load/hostile.rs"]
mod hostile;
#[path = "../load/process.rs"]
mod process;
#[path = "../load/requests.rs"]
mod requests;

use draining::{Drained, Known, drain};
use hostile::{half_closed, in_sequence, pipelined, refusals, rest, running, slow_body, slow_heads, stream, vanish};
use process::Voussoir;
use requests::{endless, tiny};
use std::thread::scope;
use std::time::Duration;

const SECOND: Duration = Duration::from_secs(1);

#[test]
fn slow_clients_are_closed_and_others_answered() {
    let service = Voussoir::serve(&["--request-time", "1"]);
    scope(|scope| {
        let slow = scope.spawn(|| slow_heads(&service, 20, &[b'G'; 200], SECOND / 10, 10 * SECOND));
        let silent = scope.spawn(|| slow_heads(&service, 20, b"", SECOND, 10 * SECOND));
        assert!(slow_body(&service).is_problem(408, ""));
        for closed in [slow, silent] {
            let closed = closed.join().unwrap();
            assert!(closed.all.is_some() && closed.slowest_answer < SECOND);
        }
    });
    assert!(service.troubles().is_empty(), "{:?}", service.troubles());
}

#[test]
fn what_cannot_be_is_refused() {
    let service = Voussoir::serve(&["--body-limit", "2048"]);
    for (what, status, as_problem, answer) in refusals(&service, 2048) {
        let answer = answer.unwrap_or_else(|| panic!("{what}: no answer"));
        assert_eq!(answer.status, status, "{what}");
        assert!(!as_problem || answer.is_problem(status, ""), "{what}: {}", answer.text());
    }
    assert_eq!(pipelined(&service), Some([200, 404]));
    assert_eq!(in_sequence(&service, 100), 100);
}

#[test]
fn who_shuts_the_writing_side_down_still_reads_the_answer() {
    let service = Voussoir::serve(&[]);
    let answer = half_closed(&service, "POST", "/v1/jobs", "prefer: wait=20\r\n", &tiny()).unwrap();
    let path = answer.accepted().unwrap();
    let results = service.client().get(&format!("{path}/results"));
    assert_eq!(results.status, 200);
    assert!(half_closed(&service, "GET", &format!("{path}/results"), "", "").unwrap().body == results.body);
}

#[test]
fn streams_are_given_back_when_their_clients_go() {
    let service = Voussoir::serve(&["--event-streams", "20"]);
    let mut client = service.client();
    let path = running(&mut client, &endless());
    for _ in 0..20 {
        vanish(&service, &format!("{path}/request")).unwrap();
    }
    drop((0..20).map(|_| stream(&service, &path)).collect::<Vec<_>>());
    assert!(service.settles("voussoir_event_streams", 0, 10 * SECOND).is_some());
    let stays = stream(&service, &path);
    assert_eq!(client.delete(&path).status, 200);
    assert!(rest(stays).unwrap().contains("event: end"));
}

/// A job that has ended.
fn known(service: &Voussoir) -> Known {
    let (mut client, body) = (service.client(), tiny());
    let done = client.submit(&body);
    client.ended(&done);
    let results = client.get(&format!("{done}/results")).body;
    Known { active: done.clone(), done, results, body }
}

fn in_order(service: &Voussoir, drained: &Drained) {
    assert!(drained.wrong.is_empty(), "{:?}", drained.wrong);
    assert_eq!((drained.code, service.said("stopped")), (Some(0), 1));
    assert!(service.troubles().is_empty(), "{:?}", service.troubles());
}

#[test]
fn told_to_stop_it_ends_its_jobs() {
    let mut service = Voussoir::serve(&["--workers", "1", "--grace", "3"]);
    let known = known(&service);
    let mut client = service.client();
    let paths: Vec<_> = (0..50).map(|_| client.submit(&tiny())).collect();
    let follows = stream(&service, &paths[49]);
    let drained = drain(&mut service, &known, 20 * SECOND);
    in_order(&service, &drained);
    assert_eq!(service.said("ended"), 51, "every accepted job");
    assert!(rest(follows).is_some(), "the stream ends in order");
}

#[test]
fn told_to_stop_it_lets_results_be_read() {
    let mut service = Voussoir::serve(&["--workers", "1", "--grace", "1000"]);
    let mut client = service.client();
    let paths: Vec<_> = (0..20).map(|_| client.submit(&tiny())).collect();
    service.terminate();
    for path in paths {
        client.ended(&path);
        assert_eq!(client.get(&format!("{path}/results")).status, 200);
    }
    assert_eq!(service.wait(20 * SECOND), Some(0), "nothing is left to wait for");
    assert!(service.troubles().is_empty(), "{:?}", service.troubles());
}

#[test]
fn told_to_stop_it_waits_no_longer_than_it_may() {
    let mut service = Voussoir::serve(&["--workers", "1", "--grace", "1"]);
    let known = known(&service);
    let mut client = service.client();
    let path = running(&mut client, &endless());
    client.submit(&endless());
    let follows = stream(&service, &path);
    let drained = drain(&mut service, &known, 20 * SECOND);
    in_order(&service, &drained);
    assert!(drained.rounds > 0 && drained.took > SECOND, "{drained:?}");
    assert_eq!((service.said("ended"), service.said("an analysis would not stop")), (3, 0), "two of them dismissed");
    assert!(rest(follows).is_some());
}
