//! A blocking client that keeps its connection and speaks just enough HTTP/1.1.

use serde_json::Value;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::{Shutdown, SocketAddr, TcpStream};
use std::time::{Duration, Instant};

/// Longest wait for an answer.
const PATIENCE: Duration = Duration::from_secs(60);

/// One client with at most one connection.
pub struct Client {
    address: SocketAddr,
    stream: Option<BufReader<TcpStream>>,
}

/// What came back.
#[derive(Debug)]
pub struct Answer {
    pub status: u16,
    pub headers: Vec<(String, String)>,
    pub body: Vec<u8>,
}

impl Client {
    pub fn new(address: SocketAddr) -> Self {
        Client { address, stream: None }
    }

    /// Asks once; a connection that fails is not used again.
    pub fn call(&mut self, method: &str, path: &str, headers: &str, body: &[u8]) -> io::Result<Answer> {
        let stream = self.stream.take().map_or_else(|| connect(self.address).map(BufReader::new), Ok);
        let mut stream = stream?;
        stream.get_mut().write_all(&request(method, path, headers, body))?;
        let answer = read_answer(&mut stream)?;
        if answer.header("connection") != Some("close") {
            self.stream = Some(stream);
        }
        Ok(answer)
    }

    /// Asks, where an answer is certain.
    fn ask(&mut self, method: &str, path: &str, headers: &str, body: &[u8]) -> Answer {
        self.call(method, path, headers, body).unwrap_or_else(|error| panic!("{method} {path}: {error}"))
    }

    pub fn get(&mut self, path: &str) -> Answer {
        self.ask("GET", path, "", b"")
    }

    pub fn delete(&mut self, path: &str) -> Answer {
        self.ask("DELETE", path, "", b"")
    }

    pub fn post(&mut self, body: &str) -> Answer {
        self.ask("POST", "/v1/jobs", "content-type: application/json\r\n", body.as_bytes())
    }

    /// Submits where there is room, and returns the path of the status.
    pub fn submit(&mut self, body: &str) -> String {
        self.post(body).accepted().unwrap_or_else(|answer| panic!("{}: {}", answer.status, answer.text()))
    }

    /// Looks again and again until the status is one of `words`.
    pub fn until(&mut self, path: &str, words: &[&str]) -> Value {
        let clock = Instant::now();
        loop {
            let status = self.get(path).json();
            if words.iter().any(|&word| status["status"] == word) {
                return status;
            }
            assert!(clock.elapsed() < 10 * PATIENCE, "{path} is never {words:?}: {status}");
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    /// The final status.
    pub fn ended(&mut self, path: &str) -> Value {
        self.until(path, &["successful", "failed", "dismissed"])
    }
}

/// A connection without delay.
pub fn connect(address: SocketAddr) -> io::Result<TcpStream> {
    let stream = TcpStream::connect(address)?;
    stream.set_nodelay(true)?;
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    Ok(stream)
}

/// A request as it goes out.
pub fn request(method: &str, path: &str, headers: &str, body: &[u8]) -> Vec<u8> {
    let length = body.len();
    let head = format!("{method} {path} HTTP/1.1\r\nhost: localhost\r\ncontent-length: {length}\r\n{headers}\r\n");
    [head.as_bytes(), body].concat()
}

/// Sends bytes as they are, shuts the writing side down if asked, and reads one answer.
pub fn send(address: SocketAddr, bytes: &[u8], half_close: bool) -> io::Result<Answer> {
    let mut stream = connect(address)?;
    // A server that refuses may hang up before all is sent.
    let _ = stream.write_all(bytes);
    if half_close {
        stream.shutdown(Shutdown::Write)?;
    }
    read_answer(&mut BufReader::new(stream))
}

/// Reads one answer to its end: by its length, by its chunks, or until the server hangs up.
pub fn read_answer(stream: &mut BufReader<TcpStream>) -> io::Result<Answer> {
    let first = line(stream)?;
    let status = first.split(' ').nth(1).and_then(|word| word.parse().ok());
    let status = status.ok_or_else(|| io::Error::other(format!("no status line: {first:?}")))?;
    let mut headers = Vec::new();
    loop {
        let line = line(stream)?;
        let Some((name, value)) = line.split_once(": ") else { break };
        headers.push((name.to_ascii_lowercase(), value.to_owned()));
    }
    let mut answer = Answer { status, headers, body: Vec::new() };
    if matches!(status, 204 | 304) {
        return Ok(answer);
    }
    if answer.header("transfer-encoding") == Some("chunked") {
        answer.body = chunks(stream)?;
    } else if let Some(length) = answer.header("content-length").and_then(|length| length.parse().ok()) {
        answer.body = vec![0; length];
        stream.read_exact(&mut answer.body)?;
    } else {
        stream.read_to_end(&mut answer.body)?;
    }
    Ok(answer)
}

fn chunks(stream: &mut BufReader<TcpStream>) -> io::Result<Vec<u8>> {
    let mut body = Vec::new();
    loop {
        let length = usize::from_str_radix(line(stream)?.trim(), 16).map_err(io::Error::other)?;
        let start = body.len();
        body.resize(start + length, 0);
        stream.read_exact(&mut body[start..])?;
        line(stream)?;
        if length == 0 {
            return Ok(body);
        }
    }
}

/// One line without its end.
fn line(stream: &mut BufReader<TcpStream>) -> io::Result<String> {
    let mut line = String::new();
    if stream.read_line(&mut line)? == 0 {
        return Err(io::ErrorKind::UnexpectedEof.into());
    }
    Ok(line.trim_end_matches(['\r', '\n']).to_owned())
}

impl Answer {
    pub fn header(&self, name: &str) -> Option<&str> {
        self.headers.iter().find(|(other, _)| other == name).map(|(_, value)| value.as_str())
    }

    pub fn text(&self) -> String {
        String::from_utf8_lossy(&self.body).into_owned()
    }

    pub fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap_or_else(|error| panic!("{error}: {}", self.text()))
    }

    /// The path of the status of a job just accepted, or the answer that says why not.
    pub fn accepted(self) -> Result<String, Answer> {
        match self.header("location") {
            Some(path) if self.status == 201 => Ok(path.to_owned()),
            _ => Err(self),
        }
    }

    /// True for a problem of this status whose type ends so, and where to try again if it is a 503.
    pub fn is_problem(&self, status: u16, kind: &str) -> bool {
        let retry = self.header("retry-after").and_then(|seconds| seconds.parse::<u64>().ok());
        self.status == status
            && self.header("content-type") == Some("application/problem+json")
            && serde_json::from_slice::<Value>(&self.body).is_ok_and(|problem| {
                problem["status"] == status && problem["type"].as_str().is_some_and(|uri| uri.ends_with(kind))
            })
            && (status != 503 || retry.is_some())
    }
}
