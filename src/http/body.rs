//! A body on its way in: together they hold only so much memory.

use super::Service;
use super::layers::Client;
use super::problem::{Problem, kinds};
use super::quota::{Full, Share};
use axum::body::Body;
use axum::extract::{FromRequest, Request};
use axum::http::{HeaderMap, StatusCode, header};
use futures_util::StreamExt;
use headers::{ContentLength, HeaderMapExt};
use serde::de::IgnoredAny;
use std::ops::Deref;
use std::sync::Arc;

/// What the shortest body counts, bytes: what is kept beside it, and reading it, cost no less.
pub(super) const LEAST: usize = 16 << 10;

/// A body that is said to be JSON.
pub(super) struct JsonBody(Arrived);

/// A body that is said to be comma-separated values.
pub(super) struct CsvBody(Arrived);

/// A body that arrived in time and is not too long. Its share of the memory is given back when it has been read.
struct Arrived {
    bytes: Vec<u8>,
    share: Share,
}

impl Deref for JsonBody {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        &self.0.bytes
    }
}

impl Deref for CsvBody {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        &self.0.bytes
    }
}

impl FromRequest<Arc<Service>> for JsonBody {
    type Rejection = Problem;

    async fn from_request(request: Request, service: &Arc<Service>) -> Result<Self, Problem> {
        Arrived::as_said(request, service, "application/json").await.map(JsonBody)
    }
}

impl FromRequest<Arc<Service>> for CsvBody {
    type Rejection = Problem;

    async fn from_request(request: Request, service: &Arc<Service>) -> Result<Self, Problem> {
        Arrived::as_said(request, service, "text/csv").await.map(CsvBody)
    }
}

impl Arrived {
    /// The body of a request that has to be of this media type.
    async fn as_said(request: Request, service: &Service, media: &str) -> Result<Self, Problem> {
        let unsupported = |detail: String| Err(Problem::plain(StatusCode::UNSUPPORTED_MEDIA_TYPE, detail));
        if !is_said_to_be(media, request.headers()) {
            return unsupported(format!("send the request with the header content-type: {media}"));
        }
        if request.headers().contains_key(header::CONTENT_ENCODING) {
            return unsupported("send the body as it is, without content-encoding".to_owned());
        }
        let (most, time) = (service.settings.limits.body, service.settings.limits.request_time);
        // Told before the body is sent, to clients that ask whether they may.
        let length = request.headers().typed_get::<ContentLength>().map(|length| length.0);
        if length.is_some_and(|length| length > most as u64) {
            return Err(too_long(most));
        }
        let client = request.extensions().get::<Client>().map(|client| &*client.name).unwrap_or_default();
        let share = service.incoming.take(client, LEAST).map_err(no_room)?;
        let body = Arrived { bytes: Vec::new(), share };
        tokio::time::timeout(time, body.fill(request.into_body(), most)).await.map_err(|_| {
            let detail = format!("the body did not arrive within {} s", time.as_secs_f64());
            Problem::plain(StatusCode::REQUEST_TIMEOUT, detail)
        })?
    }

    /// Takes what arrives, at most `most` bytes, and room for it as it grows.
    async fn fill(mut self, body: Body, most: usize) -> Result<Self, Problem> {
        let broken = |_| Problem::plain(StatusCode::BAD_REQUEST, "the body could not be read to its end");
        let mut stream = body.into_data_stream();
        while let Some(piece) = stream.next().await {
            let piece = piece.map_err(broken)?;
            let needed = self.bytes.len() + piece.len();
            if needed > most {
                return Err(too_long(most));
            }
            let room = self.bytes.capacity();
            if needed > room {
                let wanted = needed.max(2 * room).max(LEAST).min(most);
                self.share.grow(wanted.max(LEAST) - room.max(LEAST)).map_err(no_room)?;
                // Copied, since a piece is part of a larger buffer and would keep all of that.
                self.bytes.reserve_exact(wanted - self.bytes.len());
            }
            self.bytes.extend_from_slice(&piece);
        }
        Ok(self)
    }
}

fn too_long(most: usize) -> Problem {
    Problem::plain(StatusCode::PAYLOAD_TOO_LARGE, format!("the body may have at most {most} bytes"))
}

fn no_room(full: Full) -> Problem {
    match full {
        Full::OfClient => {
            Problem::of(kinds::CLIENT_BODIES_FULL, "as many bodies of this client are on their way as one may send")
        }
        Full::OfAll => Problem::of(kinds::BODIES_FULL, "as many bodies are on their way as there is memory for"),
    }
}

/// True for a media type with or without parameters.
fn is_said_to_be(media: &str, headers: &HeaderMap) -> bool {
    let value = headers.get(header::CONTENT_TYPE).and_then(|value| value.to_str().ok()).unwrap_or_default();
    let essence = value.split(';').next().unwrap_or_default().trim();
    essence.eq_ignore_ascii_case(media)
}

/// Tells a body that is not JSON (400) from JSON that says something impossible (422).
pub(super) fn check_syntax(body: &[u8]) -> Result<(), Problem> {
    let not_json = |error: &dyn std::fmt::Display| Problem::of(kinds::NOT_JSON, error.to_string());
    let text = std::str::from_utf8(body).map_err(|error| not_json(&error))?;
    serde_json::from_str::<IgnoredAny>(text).map(drop).map_err(|error| not_json(&error))
}
