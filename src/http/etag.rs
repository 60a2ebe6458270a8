//! Answers that a client may have already.

use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use headers::{CacheControl, ETag, HeaderMapExt, IfNoneMatch};
use std::hash::{DefaultHasher, Hash, Hasher};

/// Names one version of one representation. Weak, since the bytes on the wire may be compressed.
#[derive(Debug, Clone)]
pub(super) struct Version(ETag);

impl Version {
    /// The version whose name is made of `parts`.
    pub(super) fn of(parts: impl Hash) -> Self {
        let mut hasher = DefaultHasher::new();
        parts.hash(&mut hasher);
        let tag = format!("W/\"{:016x}\"", hasher.finish());
        // Hexadecimal digits always make a tag.
        Version(tag.parse().unwrap_or_else(|_| unreachable!("{tag}")))
    }

    /// "Not modified", where the client says that it has this version. Any version at all (`*`) is none in particular: what
    /// is asked for may not be there.
    pub(super) fn known(&self, headers: &HeaderMap) -> Option<Response> {
        let asked = headers.typed_get::<IfNoneMatch>().filter(|asked| *asked != IfNoneMatch::any())?;
        (!asked.precondition_passes(&self.0)).then(|| self.mark(StatusCode::NOT_MODIFIED.into_response()))
    }

    /// The answer with its version; whoever keeps it has to ask whether it still holds.
    pub(super) fn mark(&self, answer: impl IntoResponse) -> Response {
        let mut response = answer.into_response();
        response.headers_mut().typed_insert(self.0.clone());
        response.headers_mut().typed_insert(CacheControl::new().with_no_cache());
        response
    }
}
