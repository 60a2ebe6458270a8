//! A real server on a free port, and a client that speaks just enough HTTP/1.1.
#![allow(clippy::disallowed_methods, reason = "tests wait for jobs by looking again")]

pub mod broken;

use serde_json::{Value, json};
use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::Arc;
use std::thread::sleep;
use std::time::{Duration, Instant};
use tokio::net::TcpListener;
use tokio::runtime::Runtime;
use voussoir::budget::{Budget, LoadStep};
use voussoir::collapse::{self, AnalysisError, Question};
use voussoir::http::{self, Hosts, LinkKey, Service, Settings, Tokens};
use voussoir::jobs::{Limits, Memory, Work};

pub const BODY_LIMIT: usize = 64 << 10;

/// Runs until cancelled.
pub const ENDLESS: f64 = 0.5;
/// Panics.
pub const PANIC: f64 = 0.25;
/// Fails.
pub const ERROR: f64 = 0.125;

/// The mechanics, except for requests that ask for trouble by their `share_of_collapse`.
fn analyse(question: &Question, budget: &Budget) -> Result<collapse::Answer, AnalysisError> {
    let Question::One(analysis) = question else { return collapse::answer(question, budget) };
    if analysis.task.share() == ENDLESS {
        return endless(budget);
    }
    assert!(analysis.task.share() != PANIC, "asked to panic");
    if analysis.task.share() == ERROR {
        return Err(AnalysisError::NotFinite { what: "asked to fail".to_owned() });
    }
    collapse::answer(question, budget)
}

/// Steps on until told to stop.
fn endless(budget: &Budget) -> Result<collapse::Answer, AnalysisError> {
    let mut step = LoadStep::default();
    while budget.step(step.load_factor, step.events).is_continue() {
        step = LoadStep { load_factor: step.load_factor + 0.25, events: step.events + 1, ..step };
        sleep(Duration::from_millis(1));
    }
    Err(budget.stopped().into())
}

/// A semicircular arch with a point load at its quarter.
pub fn request() -> Value {
    json!({
        "arch": {
            "profile": {"circular": {"radius_m": 5.0, "opening_angle_deg": 180.0}},
            "thickness": {"constant_m": 1.0},
            "voussoirs": 17,
        },
        "stone": {"friction_angle_deg": 45.0},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"point_load": {"voussoir": 4, "force_n_per_m": 1000.0}}, "scaled": true},
        ],
        "load_factor": {"unit": "kN/m", "intensity_per_unit": 1.0},
    })
}

/// The same arch: its safety as the load grows.
pub fn curve() -> Value {
    let mut request = request();
    request["loads"][1]["per_abscissa"] = json!(true);
    request["analysis"] = json!({"safety": {"curve": {"abscissae": [1, 10, 100], "unit": "kN/m"}}});
    request
}

/// The curved beam of the paper.
pub fn beam() -> Value {
    json!({"curved_beam": {"inner_radius_m": 0.5, "outer_radius_m": 0.7, "end_shear_n_per_m": 2500.0}})
}

/// The same arch as [`request`], asking for trouble.
pub fn trouble(share: f64) -> Value {
    let mut request = request();
    request["report"] = json!({"share_of_collapse": share});
    request
}

/// Limits of a store with so many places in the queue.
pub fn limits(queue: usize) -> Limits {
    let long = Duration::from_secs(1000);
    Limits {
        queue,
        queue_per_client: queue,
        kept: 1000,
        kept_for: long,
        promised: Duration::ZERO,
        keys_for: long,
        bytes: 1 << 30,
        bytes_per_client: 1 << 30,
        work_memory: 1 << 30,
    }
}

/// So many workers, with all the time they need.
pub fn work(workers: usize) -> Work {
    Work { workers, time: Duration::from_secs(1000), memory: usize::MAX }
}

/// An open service.
pub fn settings() -> Settings {
    let limits = http::ApiLimits {
        body: BODY_LIMIT,
        request_time: Duration::from_secs(30),
        voussoirs: 200,
        job_memory: 1 << 30,
        job_time: Duration::from_secs(600),
        subblocks: 1000,
        streams: 3,
        incoming: 1 << 20,
        outgoing: 1 << 20,
    };
    Settings {
        limits,
        tokens: Tokens::default(),
        links: LinkKey::random().unwrap(),
        hosts: Hosts::default(),
        origins: vec![],
        grace: Duration::from_secs(10),
        store: self::limits(10),
    }
}

pub struct Server {
    pub address: SocketAddr,
    pub service: Arc<Service>,
    runtime: Option<Runtime>,
}

pub struct Answer {
    pub status: u16,
    pub headers: Vec<(String, String)>,
    pub body: Vec<u8>,
}

impl Server {
    pub fn start(workers: usize, queue: usize) -> Self {
        Self::with(limits(queue), work(workers), settings())
    }

    pub fn with(limits: Limits, work: Work, settings: Settings) -> Self {
        let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(1).enable_all().build().unwrap();
        let settings = Settings { store: limits, ..settings };
        let within = runtime.enter();
        let service = Service::start(Arc::new(Memory::new(limits)), work, settings, analyse);
        let router = http::router(service.clone());
        drop(within);
        let listener = runtime.block_on(TcpListener::bind("127.0.0.1:0")).unwrap();
        let address = listener.local_addr().unwrap();
        runtime.spawn(async { axum::serve(listener, router).await });
        Server { address, service, runtime: Some(runtime) }
    }

    /// Sends bytes as they are and reads until the server hangs up.
    pub fn send(&self, head: &str, body: &[u8]) -> Answer {
        let mut stream = TcpStream::connect(self.address).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(30))).unwrap();
        stream.write_all(head.as_bytes()).unwrap();
        // A server that refuses a long body may hang up before it is sent.
        let _ = stream.write_all(body);
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        Answer::parse(&answer)
    }

    pub fn call(&self, method: &str, path: &str, headers: &str, body: &[u8]) -> Answer {
        let length = body.len();
        let head = format!(
            "{method} {path} HTTP/1.1\r\nhost: test\r\nconnection: close\r\ncontent-length: {length}\r\n{headers}\r\n"
        );
        self.send(&head, body)
    }

    pub fn get(&self, path: &str) -> Answer {
        self.call("GET", path, "", b"")
    }

    pub fn delete(&self, path: &str) -> Answer {
        self.call("DELETE", path, "", b"")
    }

    pub fn post(&self, body: &[u8]) -> Answer {
        self.call("POST", "/v1/jobs", "content-type: application/json\r\n", body)
    }

    /// Submits and returns the path of the status.
    pub fn submit(&self, request: &Value) -> String {
        let answer = self.post(request.to_string().as_bytes());
        assert_eq!(answer.status, 201, "{}", answer.text());
        let path = answer.header("location").unwrap().to_owned();
        assert_eq!(answer.json()["links"]["self"], path);
        path
    }

    /// Polls until the status is one of `words`.
    pub fn until(&self, path: &str, words: &[&str]) -> Value {
        let clock = Instant::now();
        loop {
            let status = self.get(path).json();
            if words.iter().any(|&word| status["status"] == word) {
                return status;
            }
            assert!(clock.elapsed() < Duration::from_secs(30), "{status}");
            sleep(Duration::from_millis(2));
        }
    }
}

/// Analyses are told to stop and not waited for.
impl Drop for Server {
    fn drop(&mut self) {
        if let Some(runtime) = self.runtime.take() {
            runtime.block_on(self.service.workers.abandon());
            runtime.shutdown_background();
        }
    }
}

impl Answer {
    fn parse(bytes: &[u8]) -> Self {
        let end = bytes.windows(4).position(|window| window == b"\r\n\r\n").expect("a whole head");
        let head = String::from_utf8(bytes[..end].to_vec()).unwrap();
        let mut lines = head.split("\r\n");
        let status = lines.next().unwrap().split(' ').nth(1).unwrap().parse().unwrap();
        let headers = lines.filter_map(|line| line.split_once(": ")).map(|(n, v)| (n.to_owned(), v.to_owned()));
        Answer { status, headers: headers.collect(), body: bytes[end + 4..].to_vec() }
    }

    pub fn header(&self, name: &str) -> Option<&str> {
        self.headers.iter().find(|(other, _)| other.eq_ignore_ascii_case(name)).map(|(_, value)| value.as_str())
    }

    pub fn bytes(&self) -> &[u8] {
        &self.body
    }

    pub fn text(&self) -> String {
        String::from_utf8_lossy(&self.body).into_owned()
    }

    pub fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap_or_else(|error| panic!("{error}: {}", self.text()))
    }

    /// Checks that this is a problem of that status, and returns it.
    pub fn problem(&self, status: u16) -> Value {
        assert_eq!(self.status, status, "{}", self.text());
        assert_eq!(self.header("content-type"), Some("application/problem+json"));
        assert_eq!(self.header("x-content-type-options"), Some("nosniff"));
        assert!(self.header("x-request-id").is_some());
        let problem = self.json();
        assert_eq!(problem["status"], status);
        assert!(problem["type"].is_string() && problem["title"].is_string() && problem["detail"].is_string());
        problem
    }
}
