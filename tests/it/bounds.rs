//! How much the interface takes in and gives out at once, to whom it answers, and how large answers travel.

use crate::support::{BODY_LIMIT, Server, limits, request, settings, work};
use flate2::read::GzDecoder;
use serde_json::{Value, json};
use std::io::{Read, Write};
use std::net::TcpStream;
use std::thread::yield_now;
use voussoir::http::problem::kinds;
use voussoir::http::{self, Hosts, Settings, Tokens};
use voussoir::wire::read::read;

/// A submission with this token whose body is waited for.
fn unfinished(server: &Server, token: &str) -> TcpStream {
    let mut stream = TcpStream::connect(server.address).unwrap();
    let head = format!(
        "POST /v1/jobs HTTP/1.1\r\nhost: test\r\nauthorization: Bearer {token}\r\ncontent-type: application/json\r\n\
         content-length: 1000\r\nexpect: 100-continue\r\n\r\n"
    );
    stream.write_all(head.as_bytes()).unwrap();
    // It has its share of the memory when it is told to go on.
    let mut told = [0; 25];
    stream.read_exact(&mut told).unwrap();
    assert_eq!(&told, b"HTTP/1.1 100 Continue\r\n\r\n");
    stream
}

#[test]
fn bodies_on_their_way_take_so_much_and_no_more() {
    // Two clients may have four of the shortest bodies each.
    let bounded = http::ApiLimits { incoming: 2 * BODY_LIMIT, ..settings().limits };
    let tokens = Tokens::new(["a", "b", "c"]);
    let server = Server::with(limits(10), work(1), Settings { limits: bounded, tokens, ..settings() });
    let small = request().to_string();
    let post = |token: &str| {
        let headers = format!("authorization: Bearer {token}\r\ncontent-type: application/json\r\n");
        server.call("POST", "/v1/validate", &headers, small.as_bytes())
    };
    let waiting = |token: &str| (0..4).map(|_| unfinished(&server, token)).collect::<Vec<_>>();
    let first = waiting("a");
    let refused = post("a");
    assert_eq!(refused.problem(429)["type"], kinds::CLIENT_BODIES_FULL.uri);
    assert!(refused.header("retry-after").is_some());
    assert_eq!(post("b").status, 200, "the others have their part");
    let second = waiting("b");
    assert_eq!(post("c").problem(503)["type"], kinds::BODIES_FULL.uri);
    drop((first, second));
    for token in ["a", "c"] {
        while post(token).status != 200 {
            yield_now();
        }
    }
}

#[test]
fn what_is_wrong_is_looked_for_until_enough_is_found() {
    let strays = (0..40_000).map(|i| (format!("friction_{i}"), json!(i))).collect::<serde_json::Map<_, _>>();
    let faults = read(Value::from(strays).to_string().as_bytes()).unwrap_err();
    assert_eq!((faults.len(), faults[100].detail.as_str()), (101, "and more: mend these first"));
    let mut many = request();
    many["loads"] = (0..1000).map(|_| json!({"a": 1, "b": 2, "c": 3})).collect();
    assert_eq!(read(many.to_string().as_bytes()).unwrap_err().len(), 101);
}

#[test]
fn a_request_says_once_whom_it_means() {
    let server = Server::start(1, 10);
    let status = |head: &str| server.send(&format!("GET /health/live {head}\r\nconnection: close\r\n\r\n"), b"");
    for head in [
        "HTTP/1.1",
        "HTTP/1.1\r\nhost: a\r\nhost: a",
        "HTTP/1.1\r\nhost:",
        "HTTP/1.1\r\nhost: a b",
        "HTTP/1.1\r\nhost: a/b",
        "HTTP/1.1\r\nhost: user@a",
        "HTTP/1.1\r\nhost: a, b",
        "HTTP/1.0\r\nhost: a\r\nhost: b",
    ] {
        assert_eq!(status(head).problem(400)["type"], kinds::BAD_HEADER.uri, "{head}");
    }
    for head in ["HTTP/1.0", "HTTP/1.1\r\nhost: a", "HTTP/1.1\r\nHost: [::1]:8080", "HTTP/1.0\r\nhost: a:80"] {
        assert_eq!(status(head).status, 200, "{head}");
    }
}

#[test]
fn a_service_with_names_answers_to_these_only() {
    let hosts = Hosts::only(["arches.example".to_owned()]);
    let server = Server::with(limits(10), work(1), Settings { hosts, ..settings() });
    let get =
        |host: &str| server.send(&format!("GET /v1/jobs HTTP/1.1\r\nhost: {host}\r\nconnection: close\r\n\r\n"), b"");
    for host in ["arches.example", "ARCHES.example:8080", "localhost:1", "127.0.0.1", "[::1]:8080"] {
        assert_eq!(get(host).status, 200, "{host}");
    }
    for host in ["rebound.example", "192.0.2.1:8080"] {
        get(host).problem(421);
    }
}

#[test]
fn a_large_answer_is_packed_once_and_read_by_all() {
    let room = http::ApiLimits { outgoing: 1 << 24, ..settings().limits };
    let server = Server::with(limits(10), work(1), Settings { limits: room, ..settings() });
    let mut large = request();
    large["mesh"] = json!({"subblocks": {"uniform": {"radial": 7, "along": 7}}});
    large["report"] = json!({"stress_fields": ["near_collapse", {"load_factor": 2.5}, {"load_factor": 2.0}]});
    let path = server.submit(&large);
    server.until(&path, &["successful"]);
    let path = format!("{path}/results");
    let (plain, packed) = (server.get(&path), server.call("GET", &path, "accept-encoding: gzip\r\n", b""));
    assert!(plain.body.len() > 256 << 10, "{} bytes are not large", plain.body.len());
    let length = |answer: &crate::support::Answer| answer.header("content-length").map(|text| text.parse().unwrap());
    assert_eq!((plain.header("content-encoding"), length(&plain)), (None, Some(plain.body.len())));
    assert_eq!((packed.header("content-encoding"), length(&packed)), (Some("gzip"), Some(packed.body.len())));
    let mut unpacked = Vec::new();
    GzDecoder::new(&packed.body[..]).read_to_end(&mut unpacked).unwrap();
    assert!(unpacked == plain.body && packed.body.len() < plain.body.len() / 2);
    for answer in [&plain, &packed] {
        assert_eq!(answer.header("etag"), plain.header("etag"));
        assert!(answer.header("etag").unwrap().starts_with("W/"), "two encodings, one weak name");
        assert!(answer.header("vary").unwrap().contains("accept-encoding"));
    }
    let known = format!("accept-encoding: gzip\r\nif-none-match: {}\r\n", plain.header("etag").unwrap());
    let same = server.call("GET", &path, &known, b"");
    assert_eq!((same.status, same.body.len()), (304, 0));
    assert!(same.header("vary").unwrap().contains("accept-encoding"));
    for (headers, like) in [("", &plain), ("accept-encoding: gzip\r\n", &packed)] {
        let head = server.call("HEAD", &path, headers, b"");
        assert_eq!((head.status, head.body.len(), length(&head)), (200, 0, length(like)));
    }
}
