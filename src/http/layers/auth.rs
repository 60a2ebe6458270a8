//! Who may ask, and who asks.

use crate::http::problem::Problem;
use crate::http::quota::address_name;
use axum::extract::{ConnectInfo, Request, State};
use axum::http::StatusCode;
use axum::middleware::Next;
use axum::response::Response;
use headers::authorization::Bearer;
use headers::{Authorization, HeaderMapExt};
use sha2::{Digest, Sha256};
use std::net::SocketAddr;
use std::sync::Arc;
use subtle::ConstantTimeEq;

/// The bearer tokens that open the service; with none of them it is open to all. Kept as digests.
#[derive(Clone, Default)]
pub struct Tokens(Arc<[[u8; 32]]>);

impl Tokens {
    /// Takes digests of the tokens.
    pub fn new<'a>(tokens: impl IntoIterator<Item = &'a str>) -> Self {
        Tokens(tokens.into_iter().map(digest).collect())
    }

    /// Which token this is. Takes the same time for every token, known or not.
    fn find(&self, token: &str) -> Option<usize> {
        let asked = digest(token);
        let matches = |known: &[u8; 32]| bool::from(known.ct_eq(&asked));
        self.0.iter().enumerate().fold(None, |found, (place, known)| if matches(known) { Some(place) } else { found })
    }
}

fn digest(token: &str) -> [u8; 32] {
    Sha256::digest(token).into()
}

/// Who asks: a token, or an address where there are none.
#[derive(Debug, Clone)]
pub(in crate::http) struct Client {
    /// Names the client.
    pub(in crate::http) name: String,
    /// The token's number; none where the service is open.
    token: Option<usize>,
}

impl Client {
    /// A name the client chose, kept apart from those that others chose. Addresses may change between two tries.
    pub(in crate::http) fn scoped(&self, key: &str) -> String {
        self.token.map_or_else(|| key.to_owned(), |token| format!("{token} {key}"))
    }
}

/// Lets in who has a token, and notes who it is.
pub(super) async fn admit(State(tokens): State<Tokens>, mut request: Request, next: Next) -> Result<Response, Problem> {
    let client = if tokens.0.is_empty() {
        let address = request.extensions().get::<ConnectInfo<SocketAddr>>();
        Client { name: address.map(|address| address_name(address.ip())).unwrap_or_default(), token: None }
    } else {
        let given = request.headers().typed_get::<Authorization<Bearer>>();
        let token = given.and_then(|given| tokens.find(given.token())).ok_or_else(|| {
            let detail = "send a token of this service in the header authorization: Bearer <token>";
            Problem::plain(StatusCode::UNAUTHORIZED, detail)
        })?;
        Client { name: format!("token {token}"), token: Some(token) }
    };
    request.extensions_mut().insert(client);
    Ok(next.run(request).await)
}
