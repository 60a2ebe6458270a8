//! Who may ask, and who asks.

use super::tokens::{Role, Tokens};
use crate::http::problem::Problem;
use crate::jobs::Job;
use axum::extract::{ConnectInfo, Request, State};
use axum::http::{Method, StatusCode};
use axum::middleware::Next;
use axum::response::Response;
use headers::authorization::Bearer;
use headers::{Authorization, HeaderMapExt};
use std::net::SocketAddr;
use std::sync::Arc;

/// Who asks: the holder of a token, or an address where there are none.
#[derive(Debug, Clone)]
pub(in crate::http) struct Client {
    /// Names the client.
    pub(in crate::http) name: Arc<str>,
    /// What it may do; none where the service is open, and all see all.
    roles: Option<Arc<[Role]>>,
}

impl Client {
    /// True where the client has one of these roles, or needs none.
    fn has(&self, roles: &[Role]) -> bool {
        self.roles.as_ref().is_none_or(|has| has.iter().any(|role| *role == Role::Admin || roles.contains(role)))
    }

    /// A name the client chose, kept apart from those that others chose. Addresses may change between two tries.
    pub(in crate::http) fn scoped(&self, key: &str) -> String {
        if self.roles.is_some() { format!("{} {key}", self.name) } else { key.to_owned() }
    }

    /// Whose jobs the client sees; none where it sees all.
    pub(in crate::http) fn sees(&self) -> Option<Arc<str>> {
        (!self.has(&[Role::ReadAll])).then(|| self.name.clone())
    }

    /// True where the client may see or, with another `method` than GET, change this job.
    pub(in crate::http) fn may(&self, method: &Method, job: &Job) -> bool {
        job.client == self.name || self.has(if reads(method) { &[Role::ReadAll] } else { &[] })
    }
}

fn reads(method: &Method) -> bool {
    method == Method::GET || method == Method::HEAD
}

/// Lets in who may ask this, and notes who it is.
pub(super) async fn admit(State(tokens): State<Tokens>, mut request: Request, next: Next) -> Result<Response, Problem> {
    let client = if tokens.is_open() {
        let address = request.extensions().get::<ConnectInfo<SocketAddr>>();
        let name = address.map(|address| address.ip().to_string()).unwrap_or_default();
        Client { name: name.into(), roles: None }
    } else {
        let given = request.headers().typed_get::<Authorization<Bearer>>();
        let holder = given.and_then(|given| tokens.holder(given.token())).ok_or_else(|| {
            let detail = "send a token of this service in the header authorization: Bearer <token>";
            Problem::plain(StatusCode::UNAUTHORIZED, detail)
        })?;
        Client { name: holder.name, roles: Some(holder.roles) }
    };
    let needed: &[Role] = match (request.method(), request.uri().path()) {
        (_, "/metrics") => &[Role::Metrics],
        (method, _) if reads(method) => &[Role::Read, Role::ReadAll],
        _ => &[Role::Submit],
    };
    if !client.has(needed) {
        let words = needed.iter().map(|role| role.word()).collect::<Vec<_>>().join(" or ");
        return Err(Problem::plain(StatusCode::FORBIDDEN, format!("this takes a token with the role {words}")));
    }
    request.extensions_mut().insert(client);
    Ok(next.run(request).await)
}
