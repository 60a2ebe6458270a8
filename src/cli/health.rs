//! `voussoir health`: a sign of life for container health checks, without any HTTP client.

use super::fail;
use crate::config::HealthOptions;
use std::io::{self, Read, Write};
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, TcpStream, ToSocketAddrs};
use std::process::ExitCode;
use std::time::Duration;

/// Longest wait for connection, request and answer each.
const REPLY_WAIT: Duration = Duration::from_secs(2);

/// Succeeds when the service answers `/health/live` with 200.
pub fn health(options: &HealthOptions) -> ExitCode {
    let bind = &options.address.bind;
    match ask(bind) {
        Ok(status) if status.starts_with("HTTP/1.1 200 ") => ExitCode::SUCCESS,
        Ok(status) => fail(format_args!("the service at {bind} answered {status}")),
        Err(error) => fail(format_args!("the service at {bind} does not answer: {error}")),
    }
}

/// The status line of `/health/live`.
fn ask(bind: &str) -> io::Result<String> {
    let address = bind.to_socket_addrs()?.next().ok_or(io::ErrorKind::AddrNotAvailable)?;
    let mut stream = TcpStream::connect_timeout(&reachable(address), REPLY_WAIT)?;
    stream.set_read_timeout(Some(REPLY_WAIT))?;
    stream.set_write_timeout(Some(REPLY_WAIT))?;
    // A name that the service always goes by.
    write!(stream, "GET /health/live HTTP/1.1\r\nhost: localhost\r\nconnection: close\r\n\r\n")?;
    let mut answer = Vec::new();
    stream.take(64 << 10).read_to_end(&mut answer)?;
    let line = answer.split(|&byte| byte == b'\r').next().unwrap_or_default();
    Ok(String::from_utf8_lossy(line).into_owned())
}

/// One listens on "any address" but asks a particular one.
fn reachable(mut address: SocketAddr) -> SocketAddr {
    if address.ip().is_unspecified() {
        address.set_ip(match address.ip() {
            IpAddr::V4(_) => Ipv4Addr::LOCALHOST.into(),
            IpAddr::V6(_) => Ipv6Addr::LOCALHOST.into(),
        });
    }
    address
}
