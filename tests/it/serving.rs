//! The real program with clients that are slow, rude or gone, and told to stop: what `tests/load` does at length.
#![allow(clippy::disallowed_methods, reason = "tests wait for jobs by looking again")]
#![allow(dead_code, reason = "tests/load uses the rest")]

#[path = "../load/client.rs"]
pub(crate) mod client;
#[path = "../load/draining.rs"]
mod draining;
#[path = "../load/hostile.rs"]
mod hostile;
#[path = "../load/process.rs"]
pub(crate) mod process;
#[path = "../load/requests.rs"]
pub(crate) mod requests;

use client::{connect, request, send};
use draining::{Drained, Known, drain};
use hostile::{half_closed, in_sequence, pipelined, refusals, rest, running, slow_body, slow_heads, stream, vanish};
use process::Voussoir;
use requests::{endless, tiny};
use std::collections::BTreeSet;
use std::io::{Read, Write};
use std::thread::scope;
use std::time::{Duration, Instant};

const SECOND: Duration = Duration::from_secs(1);

#[test]
fn slow_clients_are_closed_and_others_answered() {
    let service = Voussoir::serve(&["--request-time", "1"]);
    scope(|scope| {
        let slow = scope.spawn(|| slow_heads(&service, 20, &[b'G'; 200], SECOND / 10, 10 * SECOND));
        let silent = scope.spawn(|| slow_heads(&service, 20, b"", SECOND, 10 * SECOND));
        let undecided = scope.spawn(|| slow_heads(&service, 20, b"PRI * HTTP/2.0\r\n", Duration::ZERO, 10 * SECOND));
        assert!(slow_body(&service).is_problem(408, ""));
        for closed in [slow, silent, undecided] {
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
fn connections_are_counted_and_given_back() {
    let service = Voussoir::serve(&["--connections", "8", "--connections-per-client", "3"]);
    let mut open: Vec<_> = (0..4).map(|_| connect(service.address).unwrap()).collect();
    open.iter().for_each(|stream| stream.set_nonblocking(true).unwrap());
    let clock = Instant::now();
    // Only one is told anything: it is one too many.
    let mut refused = [0; 12];
    while !open.iter_mut().any(|stream| stream.read_exact(&mut refused).is_ok()) {
        assert!(clock.elapsed() < 10 * SECOND);
    }
    assert_eq!(&refused, b"HTTP/1.1 503");
    drop(open);
    let live = request("GET", "/health/live", "connection: close\r\n", b"");
    while !send(service.address, &live, false).is_ok_and(|answer| answer.status == 200) {
        assert!(clock.elapsed() < 10 * SECOND);
    }
}

#[test]
fn a_head_takes_no_more_than_it_needs() {
    let service = Voussoir::serve(&[]);
    let with = |bytes: usize| format!("x-long: {}\r\n", "x".repeat(bytes));
    let ask = |headers: &str| send(service.address, &request("GET", "/health/live", headers, b""), false).unwrap();
    assert_eq!((ask(&with(8 << 10)).status, ask(&with(20 << 10)).status), (200, 431));
}

/// A frame of HTTP/2: its kind, flags, stream and what it carries.
fn frame(kind: u8, flags: u8, stream: u32, payload: &[u8]) -> Vec<u8> {
    let length = u32::try_from(payload.len()).unwrap().to_be_bytes();
    [&length[1..], &[kind, flags], &stream.to_be_bytes(), payload].concat()
}

/// The frame that asks for a path: GET and http by their places in the static table of HPACK, path and host spelt out.
fn asks(stream: u32, path: &str) -> Vec<u8> {
    let spelt = |name: u8, value: &str| [&[name, u8::try_from(value.len()).unwrap()], value.as_bytes()].concat();
    let head = [vec![0x82, 0x86], spelt(0x04, path), spelt(0x01, "localhost")].concat();
    frame(0x1, 0x5, stream, &head)
}

#[test]
fn one_connection_carries_many_streams() {
    let service = Voussoir::serve(&["--workers", "1"]);
    let mut client = service.client();
    let path = running(&mut client, &endless());
    let mut connection = connect(service.address).unwrap();
    let follow = (0..12).flat_map(|i| asks(2 * i + 1, &format!("{path}/events")));
    let asked: Vec<u8> = [b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n".to_vec(), frame(0x4, 0, 0, b"")].concat();
    let asked: Vec<u8> = asked.into_iter().chain(follow).chain(asks(99, "/health/live")).collect();
    connection.write_all(&asked).unwrap();
    let mut answered = BTreeSet::new();
    while answered.len() < 13 {
        let mut head = [0; 9];
        connection.read_exact(&mut head).unwrap();
        let mut payload = vec![0; u32::from_be_bytes([0, head[0], head[1], head[2]]) as usize];
        connection.read_exact(&mut payload).unwrap();
        if head[3] == 0x1 {
            assert_eq!(payload[0], 0x88, "status 200 by its place in the static table");
            answered.insert(u32::from_be_bytes(head[5..9].try_into().unwrap()));
        }
    }
    assert!(answered.contains(&99));
    assert_eq!(client.delete(&path).status, 200);
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

#[test]
fn what_is_owed_survives_the_process() {
    let journal = std::env::temp_dir().join(format!("voussoir-owed-{}", std::process::id()));
    let flags = ["--workers", "1", "--journal", journal.to_str().unwrap()];
    let service = Voussoir::serve(&flags);
    let mut client = service.client();
    let read = client.submit(&tiny());
    client.ended(&read);
    assert_eq!(client.get(&format!("{read}/results")).status, 200);
    let unread = client.submit(&tiny());
    client.ended(&unread);
    let endless = running(&mut client, &endless());
    let waiting = client.submit(&tiny());
    // It is killed.
    drop(service);
    let service = Voussoir::serve(&flags);
    let mut client = service.client();
    assert_eq!(client.get(&read).status, 404, "nothing is owed of it");
    client.ended(&unread);
    assert_eq!(client.delete(&endless).status, 200);
    for path in [unread, waiting] {
        client.ended(&path);
        assert_eq!(client.get(&format!("{path}/results")).status, 200);
    }
    drop(service);
    assert_eq!(Voussoir::serve(&flags).client().get(&endless).status, 404, "what was cancelled is not owed");
    std::fs::remove_file(journal.with_extension("lock")).unwrap();
    std::fs::remove_file(journal).unwrap();
}

#[test]
fn what_is_owed_survives_a_stop_in_order_too() {
    let journal = std::env::temp_dir().join(format!("voussoir-stopped-{}", std::process::id()));
    let flags = ["--workers", "1", "--grace", "1", "--journal", journal.to_str().unwrap()];
    let mut service = Voussoir::serve(&flags);
    let mut client = service.client();
    let long = running(&mut client, &endless());
    let waiting = client.submit(&tiny());
    service.terminate();
    assert_eq!(service.wait(20 * SECOND), Some(0));
    let service = Voussoir::serve(&flags);
    let mut client = service.client();
    assert_eq!(client.delete(&long).status, 200, "it runs again");
    client.ended(&waiting);
    assert_eq!(client.get(&format!("{waiting}/results")).status, 200);
    drop(service);
    std::fs::remove_file(journal.with_extension("lock")).unwrap();
    std::fs::remove_file(journal).unwrap();
}
