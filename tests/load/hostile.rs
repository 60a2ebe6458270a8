//! Clients that are slow, silent, rude or gone; each function does one thing to the service and says what came of it.

use super::client::{Answer, Client, connect, read_answer, request, send};
use super::process::Voussoir;
use std::io::{BufReader, ErrorKind, Read, Write};
use std::net::TcpStream;
use std::thread::sleep;
use std::time::{Duration, Instant};

const JSON: &str = "content-type: application/json\r\n";

/// How a crowd of slow connections ended.
pub struct Closed {
    /// Until the last one was closed; none where some were open at the end of the patience.
    pub all: Option<Duration>,
    /// Longest that another client waited for an answer meanwhile.
    pub slowest_answer: Duration,
}

/// So many connections, each sending `head` a byte a `pause`, until the service has closed them all.
pub fn slow_heads(service: &Voussoir, count: usize, head: &[u8], pause: Duration, patience: Duration) -> Closed {
    let mut open: Vec<TcpStream> = (0..count).map(|_| connect(service.address).unwrap()).collect();
    open.iter().for_each(|stream| stream.set_nonblocking(true).unwrap());
    let (mut client, clock, mut sent) = (service.client(), Instant::now(), 0);
    let mut slowest_answer = Duration::ZERO;
    while !open.is_empty() && clock.elapsed() < patience {
        if clock.elapsed() >= pause * sent as u32 {
            // A closed one is found below.
            open.iter_mut().for_each(|stream| drop(stream.write(head.get(sent..=sent).unwrap_or_default())));
            sent += 1;
        }
        let ask = Instant::now();
        assert_eq!(client.get("/health/live").status, 200);
        slowest_answer = slowest_answer.max(ask.elapsed());
        open.retain_mut(is_open);
        sleep(Duration::from_millis(20));
    }
    Closed { all: open.is_empty().then(|| clock.elapsed()), slowest_answer }
}

/// True while the other side has not closed; what it sends is thrown away.
fn is_open(stream: &mut TcpStream) -> bool {
    match stream.read(&mut [0; 1024]) {
        Ok(0) => false,
        Ok(_) => true,
        Err(error) => error.kind() == ErrorKind::WouldBlock,
    }
}

/// A body that stops half-way.
pub fn slow_body(service: &Voussoir) -> Answer {
    let head = format!("POST /v1/jobs HTTP/1.1\r\nhost: localhost\r\n{JSON}content-length: 1000\r\n\r\n{{\"arch\"");
    send(service.address, head.as_bytes(), false).unwrap()
}

/// Asks, shuts the writing side down, and reads what comes.
pub fn half_closed(service: &Voussoir, method: &str, path: &str, headers: &str, body: &str) -> Option<Answer> {
    send(service.address, &request(method, path, &format!("{JSON}{headers}"), body.as_bytes()), true).ok()
}

/// Asks, reads a little of the answer, and is gone.
pub fn vanish(service: &Voussoir, path: &str) -> std::io::Result<()> {
    let mut stream = connect(service.address)?;
    stream.write_all(&request("GET", path, "", b""))?;
    stream.read_exact(&mut [0; 64])
}

/// Asks so often at once that the answers fill every buffer on the way, and reads none of them.
pub fn deaf(service: &Voussoir, path: &str, times: usize) -> TcpStream {
    let mut stream = connect(service.address).unwrap();
    stream.set_write_timeout(Some(Duration::from_millis(50))).unwrap();
    // It may stop listening before all is asked.
    let _ = stream.write_all(&request("GET", path, "", b"").repeat(times));
    stream
}

/// A stream of events, open and its first bytes read.
pub fn stream(service: &Voussoir, path: &str) -> BufReader<TcpStream> {
    let mut stream = connect(service.address).unwrap();
    stream.write_all(&request("GET", &format!("{path}/events"), "connection: close\r\n", b"")).unwrap();
    stream.read_exact(&mut [0; 15]).unwrap();
    BufReader::new(stream)
}

/// The rest of a stream of events, once the service has ended it in order: with the last of its chunks.
pub fn rest(mut stream: BufReader<TcpStream>) -> Option<String> {
    let mut text = String::new();
    stream.read_to_string(&mut text).ok()?;
    text.ends_with("\r\n0\r\n\r\n").then_some(text)
}

/// Connections one after the other, one request each; how many were answered.
pub fn in_sequence(service: &Voussoir, count: usize) -> usize {
    let ask = |_: &usize| {
        let answer = service.client().call("GET", "/health/live", "connection: close\r\n", b"");
        answer.is_ok_and(|answer| answer.status == 200)
    };
    (0..count).filter(ask).count()
}

/// What ought to be refused; each with its status, and true where a problem has to say why.
pub fn refusals(service: &Voussoir, body_limit: usize) -> Vec<(&'static str, u16, bool, Option<Answer>)> {
    let address = service.address;
    let raw = |bytes: &[u8]| send(address, bytes, false).ok();
    let ask = |method: &str, path: &str, headers: &str, body: &[u8]| raw(&request(method, path, headers, body));
    let long = format!("x-long: {}\r\n", "x".repeat(1 << 20));
    let many: String = (0..200).map(|i| format!("x-header-{i}: x\r\n")).collect();
    vec![
        ("a header of 1 MiB", 431, false, ask("GET", "/v1/jobs", &long, b"")),
        ("200 headers", 431, false, ask("GET", "/v1/jobs", &many, b"")),
        ("a path of 100 kB", 431, false, ask("GET", &format!("/{}", "x".repeat(100_000)), "", b"")),
        ("garbage", 400, false, raw(b"\x16\x03\x01\x02\x00garbage \xff\xfe\r\n\r\n")),
        ("a body that is too long", 413, true, ask("POST", "/v1/jobs", JSON, &vec![b' '; body_limit + 1])),
        ("a body that is no JSON", 400, true, ask("POST", "/v1/jobs", JSON, b"{")),
        ("a body of another type", 415, true, ask("POST", "/v1/jobs", "content-type: text/plain\r\n", b"{}")),
        ("another method", 405, true, ask("PUT", "/v1/jobs", "", b"")),
        ("another path", 404, true, ask("GET", "/nowhere", "", b"")),
        ("no such job", 404, true, ask("GET", "/v1/jobs/01890000-0000-7000-8000-000000000000", "", b"")),
    ]
}

/// Two requests at once on one connection; both statuses.
pub fn pipelined(service: &Voussoir) -> Option<[u16; 2]> {
    let mut stream = connect(service.address).ok()?;
    let both = [request("GET", "/health/live", "", b""), request("GET", "/nowhere", "", b"")].concat();
    stream.write_all(&both).ok()?;
    let mut stream = BufReader::new(stream);
    Some([read_answer(&mut stream).ok()?.status, read_answer(&mut stream).ok()?.status])
}

/// A job that runs until it is dismissed, once it runs.
pub fn running(client: &mut Client, long: &str) -> String {
    let path = client.submit(long);
    client.until(&path, &["running"]);
    path
}
