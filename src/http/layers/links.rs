//! Links that open one path to whoever has them, for a short time: for what cannot send a header, such as `EventSource` and images
//! in a browser.

use axum::http::Uri;
use axum::http::uri::PathAndQuery;
use hmac::{Hmac, KeyInit, Mac};
use sha2::Sha256;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

/// Least length of a secret, characters.
const LEAST_SECRET: usize = 32;

/// Signs links, and knows those that it has signed.
#[derive(Clone)]
pub struct LinkKey(Hmac<Sha256>);

/// What a request by a link says.
pub(super) struct Link {
    /// What it opens: a path, with its query.
    pub(super) target: PathAndQuery,
    expires: u64,
    signature: Vec<u8>,
}

impl LinkKey {
    /// Services with the same secret open each other's links.
    ///
    /// # Errors
    /// When the secret is too short to be one. The text does not repeat it.
    pub fn new(secret: &str) -> Result<Self, String> {
        match secret.chars().count() {
            LEAST_SECRET.. => Self::of(secret.as_bytes()),
            _ => Err(format!("a secret has at least {LEAST_SECRET} characters")),
        }
    }

    /// A key that nobody else has.
    ///
    /// # Errors
    /// When the system has no random numbers.
    pub fn random() -> Result<Self, String> {
        let mut secret = [0; LEAST_SECRET];
        getrandom::fill(&mut secret).map_err(|error| error.to_string())?;
        Self::of(&secret)
    }

    fn of(secret: &[u8]) -> Result<Self, String> {
        Hmac::new_from_slice(secret).map(LinkKey).map_err(|error| error.to_string())
    }

    /// Signs for the token of this digest; all that precedes the target is of one length.
    fn signed(&self, token: &[u8; 32], target: &str, expires: u64) -> Hmac<Sha256> {
        self.0.clone().chain_update(token).chain_update(expires.to_be_bytes()).chain_update(target)
    }

    /// The address that opens `target` for so long, and when that ends.
    pub(super) fn link(&self, token: &[u8; 32], target: &PathAndQuery, life: Duration) -> (String, SystemTime) {
        let expires = (now() + life).as_secs();
        let signature = self.signed(token, target.as_str(), expires).finalize().into_bytes();
        let signature: String = signature.iter().map(|byte| format!("{byte:02x}")).collect();
        let joint = if target.query().is_some() { '&' } else { '?' };
        let url = format!("{target}{joint}expires={expires}&signature={signature}");
        (url, UNIX_EPOCH + Duration::from_secs(expires))
    }

    /// True for a link that was signed for the token of this digest.
    pub(super) fn has_signed(&self, token: &[u8; 32], link: &Link) -> bool {
        self.signed(token, link.target.as_str(), link.expires).verify_slice(&link.signature).is_ok()
    }
}

impl Link {
    /// What the address of a request says, where it is a link.
    pub(super) fn read(uri: &Uri) -> Option<Self> {
        let (rest, signature) = uri.path_and_query()?.as_str().rsplit_once("&signature=")?;
        let (target, expires) = rest.rsplit_once("expires=")?;
        let target = target.strip_suffix(['?', '&'])?.parse().ok()?;
        let byte = |k: usize| u8::from_str_radix(signature.get(k..k + 2)?, 16).ok();
        let signature = (0..signature.len()).step_by(2).map(byte).collect::<Option<_>>()?;
        Some(Link { target, expires: expires.parse().ok()?, signature })
    }

    pub(super) fn is_over(&self) -> bool {
        now().as_secs() >= self.expires
    }
}

/// Time since the beginning of 1970.
fn now() -> Duration {
    SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECRET: &str = "0123456789abcdef0123456789abcdef";
    const MINUTE: Duration = Duration::from_secs(60);

    #[test]
    fn a_link_opens_what_was_signed_for_whom_it_was_signed() {
        let key = LinkKey::new(SECRET).unwrap();
        for target in ["/v1/jobs", "/v1/events?job=a&job=b"] {
            let target: PathAndQuery = target.parse().unwrap();
            let (url, _) = key.link(&[1; 32], &target, MINUTE);
            let read = |url: &str| Link::read(&url.parse().unwrap()).unwrap();
            let link = read(&url);
            assert_eq!(link.target, target);
            assert!(key.has_signed(&[1; 32], &link) && !link.is_over());
            assert!(LinkKey::new(SECRET).unwrap().has_signed(&[1; 32], &link), "of the same secret");
            assert!(!key.has_signed(&[2; 32], &link), "of another token");
            assert!(!LinkKey::random().unwrap().has_signed(&[1; 32], &link), "of another key");
            for (from, to) in [("/v1", "/v2"), ("expires=1", "expires=2"), ("signature=", "signature=00")] {
                assert!(!key.has_signed(&[1; 32], &read(&url.replace(from, to))), "{to}");
            }
            assert!(!key.has_signed(&[1; 32], &read(&url[..url.len() - 2])), "cut off");
        }
        let (over, _) = key.link(&[1; 32], &"/v1/jobs".parse().unwrap(), Duration::ZERO);
        assert!(Link::read(&over.parse().unwrap()).unwrap().is_over());
    }

    #[test]
    fn what_is_no_link_is_none() {
        for plain in ["/v1/jobs", "/v1/jobs?expires=1", "/v1/jobs?signature=00", "/v1/jobs?expires=1&signature=0x"] {
            assert!(Link::read(&plain.parse().unwrap()).is_none(), "{plain}");
        }
        assert!(LinkKey::new("s3cret").is_err_and(|fault| !fault.contains("s3cret")));
    }
}
