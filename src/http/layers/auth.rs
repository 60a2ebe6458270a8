//! Who may ask, and who asks.

use super::links::{Link, LinkKey};
use super::tokens::{Holder, Role};
use crate::http::problem::Problem;
use crate::http::quota::address_name;
use crate::http::service::Settings;
use crate::jobs::Job;
use axum::extract::{ConnectInfo, Request, State};
use axum::http::uri::{PathAndQuery, Uri};
use axum::http::{Method, StatusCode};
use axum::middleware::Next;
use axum::response::Response;
use headers::authorization::Bearer;
use headers::{Authorization, HeaderMapExt};
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::{Duration, SystemTime};

/// Where it is asked for links, by those who may read.
const LINKS: &str = "/v1/links";

/// What links are signed for where there are no tokens.
const NO_DIGEST: [u8; 32] = [0; 32];

/// Who asks: the holder of a token, or an address where there are none.
#[derive(Debug, Clone)]
pub(in crate::http) struct Client {
    /// Names the client.
    pub(in crate::http) name: Arc<str>,
    /// What it may do; none where the service is open, and all see all.
    roles: Option<Arc<[Role]>>,
    /// Digest of its token.
    digest: [u8; 32],
}

impl Client {
    /// The address that opens `target` for so long with the rights of this client, and when that ends.
    pub(in crate::http) fn link(&self, key: &LinkKey, target: &PathAndQuery, life: Duration) -> (String, SystemTime) {
        key.link(&self.digest, target, life)
    }

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
pub(super) async fn admit(
    State(settings): State<Arc<Settings>>,
    mut request: Request,
    next: Next,
) -> Result<Response, Problem> {
    let link = Link::read(request.uri()).filter(|_| reads(request.method()));
    let client = match &link {
        Some(link) => holder_of(link, &settings)?.map(Client::from),
        None if settings.tokens.is_open() => None,
        None => {
            let given = request.headers().typed_get::<Authorization<Bearer>>();
            let holder = given.and_then(|given| settings.tokens.holder(given.token()));
            let detail = "send a token of this service in the header authorization: Bearer <token>";
            Some(holder.ok_or_else(|| Problem::plain(StatusCode::UNAUTHORIZED, detail))?.into())
        }
    };
    let client = client.unwrap_or_else(|| {
        let address = request.extensions().get::<ConnectInfo<SocketAddr>>();
        let name = address.map(|address| address_name(address.ip())).unwrap_or_default();
        Client { name: name.into(), roles: None, digest: NO_DIGEST }
    });
    if let Some(link) = link {
        *request.uri_mut() = only(request.uri(), link.target)?;
    }
    let needed: &[Role] = match (request.method(), request.uri().path()) {
        (_, "/metrics") => &[Role::Metrics],
        (method, path) if reads(method) || path == LINKS => &[Role::Read, Role::ReadAll],
        _ => &[Role::Submit],
    };
    if !client.has(needed) {
        let words = needed.iter().map(|role| role.word()).collect::<Vec<_>>().join(" or ");
        return Err(Problem::plain(StatusCode::FORBIDDEN, format!("this takes a token with the role {words}")));
    }
    request.extensions_mut().insert(client);
    Ok(next.run(request).await)
}

impl From<Holder> for Client {
    fn from(Holder { name, roles, digest }: Holder) -> Self {
        Client { name, roles: Some(roles), digest }
    }
}

/// Whose link this is; none where the service is open.
fn holder_of(link: &Link, Settings { links, tokens, .. }: &Settings) -> Result<Option<Holder>, Problem> {
    let refused = |detail| Err(Problem::plain(StatusCode::UNAUTHORIZED, detail));
    let holder = tokens.holder_where(|digest| links.has_signed(digest, link));
    if holder.is_none() && !(tokens.is_open() && links.has_signed(&NO_DIGEST, link)) {
        return refused("this link was not signed here, or its token holds no more: ask for another at /v1/links");
    }
    if link.is_over() {
        return refused("this link has expired: ask for another at /v1/links");
    }
    Ok(holder)
}

/// The address without what makes it a link.
fn only(uri: &Uri, target: PathAndQuery) -> Result<Uri, Problem> {
    let mut parts = uri.clone().into_parts();
    parts.path_and_query = Some(target);
    Uri::from_parts(parts).map_err(|_| Problem::internal())
}
