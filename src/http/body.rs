//! A body of JSON on its way in.

use super::Service;
use super::problem::{Problem, kinds};
use axum::body::Bytes;
use axum::extract::{FromRequest, Request};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::IntoResponse;
use headers::{ContentLength, HeaderMapExt};
use serde::de::IgnoredAny;

/// A body that is JSON, arrived in time and is not too long.
pub(super) struct JsonBody(pub(super) Bytes);

impl FromRequest<Service> for JsonBody {
    type Rejection = Problem;

    async fn from_request(request: Request, service: &Service) -> Result<Self, Problem> {
        let unsupported = |detail| Err(Problem::plain(StatusCode::UNSUPPORTED_MEDIA_TYPE, detail));
        if !is_json(request.headers()) {
            return unsupported("send the request with the header content-type: application/json");
        }
        if request.headers().contains_key(header::CONTENT_ENCODING) {
            return unsupported("send the body as it is, without content-encoding");
        }
        let (most, time) = (service.settings.limits.body, service.settings.limits.request_time);
        let too_long =
            || Problem::plain(StatusCode::PAYLOAD_TOO_LARGE, format!("the body may have at most {most} bytes"));
        // Told before the body is sent, to clients that ask whether they may.
        if request.headers().typed_get::<ContentLength>().is_some_and(|length| length.0 > most as u64) {
            return Err(too_long());
        }
        let body = tokio::time::timeout(time, Bytes::from_request(request, service)).await.map_err(|_| {
            let detail = format!("the body did not arrive within {} s", time.as_secs_f64());
            Problem::plain(StatusCode::REQUEST_TIMEOUT, detail)
        })?;
        body.map(JsonBody).map_err(|rejection| match rejection.into_response().status() {
            StatusCode::PAYLOAD_TOO_LARGE => too_long(),
            _ => Problem::plain(StatusCode::BAD_REQUEST, "the body could not be read to its end"),
        })
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
