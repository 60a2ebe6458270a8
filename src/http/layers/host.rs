//! Which service a request means: the header `host`.

use crate::http::problem::{Problem, kinds};
use axum::extract::{Request, State};
use axum::http::uri::Authority;
use axum::http::{StatusCode, Version, header};
use axum::middleware::Next;
use axum::response::Response;
use std::net::IpAddr;
use std::sync::Arc;

/// The names a service goes by, beside those of its own machine; by default whatever it is called. Without them a page of another
/// origin whose name is made to lead here (DNS rebinding) could read what an open service says.
#[derive(Debug, Clone, Default)]
pub struct Hosts(Option<Arc<[String]>>);

impl Hosts {
    /// These names, without ports, and `localhost` and loopback addresses.
    pub fn only(names: impl IntoIterator<Item = String>) -> Self {
        Hosts(Some(names.into_iter().collect()))
    }

    fn include(&self, host: &str) -> bool {
        let Some(names) = &self.0 else { return true };
        let address = host.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')).unwrap_or(host);
        host.eq_ignore_ascii_case("localhost")
            || address.parse::<IpAddr>().is_ok_and(|address| address.is_loopback())
            || names.iter().any(|name| name.eq_ignore_ascii_case(host))
    }
}

/// Lets in requests that say, once and readably, which host they mean, where that is this service.
pub(super) async fn check(State(hosts): State<Hosts>, request: Request, next: Next) -> Result<Response, Problem> {
    let named = host(&request)?;
    if named.is_none_or(|host| hosts.include(&host)) {
        return Ok(next.run(request).await);
    }
    let detail = "this service does not go by the name in the header host; --host adds names";
    Err(Problem::plain(StatusCode::MISDIRECTED_REQUEST, detail))
}

/// The host that is meant (RFC 9112, section 3.2); none where HTTP/1.0 does not say.
fn host(request: &Request) -> Result<Option<String>, Problem> {
    let fault = |detail| Problem::of(kinds::BAD_HEADER, detail);
    let mut lines = request.headers().get_all(header::HOST).iter();
    let (line, second) = (lines.next(), lines.next());
    if second.is_some() {
        return Err(fault("the header host is given more than once: give it once"));
    }
    let read = |line: &[u8]| Authority::try_from(line).ok().filter(|host| !host.as_str().contains('@'));
    let line = line.map(|line| read(line.as_bytes()).ok_or_else(|| fault("the header host is no host name")));
    // The target of a request may name the host itself: that goes first.
    match (request.uri().authority().cloned(), line.transpose()?) {
        (None, None) if request.version() == Version::HTTP_10 => Ok(None),
        (_, None) if request.version() == Version::HTTP_11 => Err(fault("the header host is missing: add it")),
        (target, line) => Ok(target.or(line).map(|host| host.host().to_owned())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_service_goes_by_its_names_and_those_of_its_machine() {
        let hosts = Hosts::only(["arches.example".to_owned()]);
        for (host, known) in [
            ("localhost", true),
            ("LocalHost", true),
            ("127.0.0.1", true),
            ("127.8.0.1", true),
            ("[::1]", true),
            ("Arches.Example", true),
            ("arches.example.evil.example", false),
            ("localhost.evil.example", false),
            ("192.0.2.1", false),
            ("[2001:db8::1]", false),
            ("", false),
        ] {
            assert_eq!(hosts.include(host), known, "{host}");
            assert!(Hosts::default().include(host));
        }
    }
}
