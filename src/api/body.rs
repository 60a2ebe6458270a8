//! A body of JSON on its way in.

use super::Service;
use super::problem::{Problem, kinds};
use axum::body::Bytes;
use axum::extract::{FromRequest, Request};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::IntoResponse;
use headers::{ContentLength, HeaderMapExt};
use serde::de::IgnoredAny;
use std::num::NonZeroUsize;
use std::sync::Arc;
use std::thread::available_parallelism;
use tokio::sync::Semaphore;

/// A body that is JSON, arrived in time and is not too long.
pub(super) struct JsonBody(pub(super) Bytes);

impl FromRequest<Service> for JsonBody {
    type Rejection = Problem;

    async fn from_request(request: Request, service: &Service) -> Result<Self, Problem> {
        if !is_json(request.headers()) {
            return Err(Problem::unsupported_media_type());
        }
        if request.headers().contains_key(header::CONTENT_ENCODING) {
            return Err(Problem::encoded());
        }
        let limits = &service.limits;
        // Told before the body is sent, to clients that ask whether they may.
        let length = request.headers().typed_get::<ContentLength>();
        if length.is_some_and(|length| length.0 > limits.body as u64) {
            return Err(Problem::too_long(limits.body));
        }
        let body = tokio::time::timeout(limits.request_time, Bytes::from_request(request, service)).await;
        let body = body.map_err(|_| Problem::too_slow(limits.request_time))?;
        let body = body.map_err(|rejection| match rejection.into_response().status() {
            StatusCode::PAYLOAD_TOO_LARGE => Problem::too_long(limits.body),
            _ => Problem::plain(StatusCode::BAD_REQUEST, "the body could not be read to its end"),
        })?;
        Ok(JsonBody(body))
    }
}

/// True for `application/json` with or without parameters.
fn is_json(headers: &HeaderMap) -> bool {
    let value = headers.get(header::CONTENT_TYPE).and_then(|value| value.to_str().ok()).unwrap_or_default();
    let essence = value.split(';').next().unwrap_or_default().trim();
    essence.eq_ignore_ascii_case("application/json")
}

/// Tells a body that is not JSON (400) from JSON that says something impossible (422).
pub(super) fn check_syntax(body: &[u8]) -> Result<(), Problem> {
    let not_json = |error: &dyn std::fmt::Display| Problem::of(kinds::NOT_JSON, error.to_string());
    let text = std::str::from_utf8(body).map_err(|error| not_json(&error))?;
    serde_json::from_str::<IgnoredAny>(text).map(drop).map_err(|error| not_json(&error))
}

/// Threads for what takes a while, reading or writing, so that others need not wait for it; only so many at once.
#[derive(Debug, Clone)]
pub(super) struct Aside(Arc<Semaphore>);

impl Default for Aside {
    /// As many as there are cores.
    fn default() -> Self {
        Aside(Arc::new(Semaphore::new(available_parallelism().map_or(1, NonZeroUsize::get))))
    }
}

impl Aside {
    /// Runs `work` when it is its turn.
    #[allow(clippy::disallowed_methods, reason = "reading and writing are no analysis: short, and need no cancelling")]
    pub(super) async fn run<V: Send + 'static>(
        &self,
        work: impl FnOnce() -> Result<V, Problem> + Send + 'static,
    ) -> Result<V, Problem> {
        let permit = self.0.clone().acquire_owned().await.map_err(|_| Problem::internal())?;
        let done = tokio::task::spawn_blocking(move || {
            let value = work();
            drop(permit);
            value
        });
        done.await.unwrap_or_else(|_| Err(Problem::internal()))
    }
}
