//! The program itself, as it is served: started, asked, measured from outside, told to stop.

use super::client::Client;
use serde_json::Value;
use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Write};
use std::net::SocketAddr;
use std::process::{Child, ChildStderr, Command, Stdio};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle, sleep};
use std::time::{Duration, Instant};

/// Most different log messages remembered.
const MESSAGES: usize = 1000;

/// A served program; it is killed when this is dropped.
pub struct Voussoir {
    child: Child,
    pub address: SocketAddr,
    log: Arc<Mutex<Log>>,
    reader: Option<JoinHandle<()>>,
}

/// What the program has logged.
#[derive(Debug, Default)]
struct Log {
    /// How often each message came, but for answers.
    messages: BTreeMap<String, usize>,
    /// Errors, panics and whatever else is no line of the log.
    troubles: Vec<String>,
}

impl Log {
    fn take(&mut self, line: &str) {
        let Ok(entry) = serde_json::from_str::<Value>(line) else {
            self.troubles.push(line.to_owned());
            return;
        };
        if entry["level"] == "ERROR" {
            self.troubles.push(line.to_owned());
        }
        let message = entry["message"].as_str().unwrap_or_default();
        if message != "answered" && self.messages.len() < MESSAGES {
            *self.messages.entry(message.to_owned()).or_default() += 1;
        }
    }
}

impl Voussoir {
    /// Serves at a free port with these flags.
    pub fn serve(flags: &[&str]) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_voussoir"));
        command.args(["serve", "--bind", "127.0.0.1:0", "--log-format", "json"]).args(flags);
        let mut child = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        let mut lines = BufReader::new(child.stderr.take().unwrap());
        let mut log = Log::default();
        let address = loop {
            let mut line = String::new();
            assert!(lines.read_line(&mut line).unwrap() > 0, "it ended: {:?}", log.troubles);
            let entry = serde_json::from_str::<Value>(&line).unwrap_or_default();
            if entry["message"] == "listening" {
                break entry["address"].as_str().unwrap().parse().unwrap();
            }
            log.take(&line);
        };
        let log = Arc::new(Mutex::new(log));
        let shared = log.clone();
        let reader = Some(thread::spawn(move || drain(lines, &shared)));
        Voussoir { child, address, log, reader }
    }

    pub fn client(&self) -> Client {
        Client::new(self.address)
    }

    /// What `/metrics` says of one counter or gauge, labels included in its name; 0 before it is first counted.
    pub fn metric(&self, name: &str) -> u64 {
        let text = self.client().get("/metrics").text();
        let value = text.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(' '));
        value.map_or(0, |value| value.parse().unwrap())
    }

    /// Jobs that have ended so.
    pub fn outcomes(&self, outcome: &str) -> u64 {
        self.metric(&format!("voussoir_jobs_total{{outcome=\"{outcome}\"}}"))
    }

    /// Waits until a gauge shows a value; how long that took, none where it took longer than `patience`.
    pub fn settles(&self, name: &str, value: u64, patience: Duration) -> Option<Duration> {
        let clock = Instant::now();
        while self.metric(name) != value {
            if clock.elapsed() > patience {
                return None;
            }
            sleep(Duration::from_millis(5));
        }
        Some(clock.elapsed())
    }

    /// Resident memory, KiB.
    pub fn resident(&self) -> u64 {
        let text = std::fs::read_to_string(format!("/proc/{}/status", self.child.id())).unwrap();
        let line = text.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap();
        line.trim().trim_end_matches(" kB").parse().unwrap()
    }

    /// Files and connections the program holds open.
    pub fn open_files(&self) -> usize {
        std::fs::read_dir(format!("/proc/{}/fd", self.child.id())).unwrap().count()
    }

    /// Sends SIGTERM.
    pub fn terminate(&self) {
        let told = Command::new("kill").args(["-TERM", &self.child.id().to_string()]).status().unwrap();
        assert!(told.success());
    }

    /// Waits for the end; the exit code, none where it took longer than `patience` or a signal ended it.
    pub fn wait(&mut self, patience: Duration) -> Option<i32> {
        let clock = Instant::now();
        loop {
            if let Some(status) = self.child.try_wait().unwrap() {
                self.reader.take().unwrap().join().unwrap();
                return status.code();
            }
            if clock.elapsed() > patience {
                return None;
            }
            sleep(Duration::from_millis(2));
        }
    }

    /// How often a message was logged.
    pub fn said(&self, message: &str) -> usize {
        self.log.lock().unwrap().messages.get(message).copied().unwrap_or(0)
    }

    /// Errors and panics logged so far.
    pub fn troubles(&self) -> Vec<String> {
        self.log.lock().unwrap().troubles.clone()
    }
}

fn drain(lines: BufReader<ChildStderr>, log: &Mutex<Log>) {
    for line in lines.lines().map_while(Result::ok) {
        log.lock().unwrap().take(&line);
    }
}

impl Drop for Voussoir {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// What `solve --json` prints for a request.
pub fn solve(body: &str) -> Vec<u8> {
    let mut command = Command::new(env!("CARGO_BIN_EXE_voussoir"));
    command.args(["solve", "--json", "-"]).stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.spawn().unwrap();
    child.stdin.take().unwrap().write_all(body.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "solve --json: {body}");
    output.stdout
}
