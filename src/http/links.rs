//! Links for what cannot send a token.

use super::body::{JsonBody, check_syntax};
use super::jobs::answer;
use super::layers::Client;
use super::problem::Problem;
use super::service::AppState;
use crate::wire::fault::Fault;
use axum::Extension;
use axum::http::uri::PathAndQuery;
use axum::response::Response;
use humantime::format_rfc3339_seconds;
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;
use std::time::Duration;
use utoipa::ToSchema;

/// How long a link may hold, s.
const LIFE: RangeInclusive<u64> = 1..=3600;

/// What a link is to open.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct LinkRequest {
    /// A path under `/v1/`, with its query.
    #[schema(pattern = "^/v1/", example = "/v1/jobs/01890000-0000-7000-8000-000000000000/results/figure")]
    path: String,
    /// How long it opens that, s.
    #[serde(default = "LinkRequest::default_life")]
    #[schema(minimum = 1, maximum = 3600, default = 300)]
    life_s: u64,
}

impl LinkRequest {
    /// Some minutes.
    fn default_life() -> u64 {
        300
    }
}

/// A link, and how long it opens what it leads to.
#[derive(Debug, Serialize, ToSchema)]
pub(super) struct SignedLink {
    /// What opens the path, relative to this service.
    url: String,
    /// Until when, UTC. An event stream that was opened before goes on.
    #[schema(format = "date-time")]
    expires: String,
}

/// Make a link that needs no token: GET gives what its path gives to the token that asked for the link, for a short time.
#[utoipa::path(
    post, path = "/v1/links", tag = "service", operation_id = "create_link",
    request_body(content = LinkRequest, content_type = "application/json"),
    responses((status = 200, description = "The link", body = SignedLink))
)]
pub(super) async fn create(
    state: AppState,
    Extension(client): Extension<Client>,
    body: JsonBody,
) -> Result<Response, Problem> {
    check_syntax(&body)?;
    let fault = |pointer: &str, detail: String| Problem::faults(vec![Fault { pointer: pointer.to_owned(), detail }]);
    let LinkRequest { path, life_s } = serde_json::from_slice(&body).map_err(|error| fault("", error.to_string()))?;
    let target = path.parse::<PathAndQuery>().ok().filter(|target| target.as_str() == path && path.starts_with("/v1/"));
    let target =
        target.ok_or_else(|| fault("/path", "this is no path under /v1/: give one, with its query".to_owned()))?;
    if !LIFE.contains(&life_s) {
        let detail = format!("{life_s} is out of range: from {} to {}", LIFE.start(), LIFE.end());
        return Err(fault("/life_s", detail));
    }
    let (url, expires) = client.link(&state.settings.links, &target, Duration::from_secs(life_s));
    answer(&SignedLink { url, expires: format_rfc3339_seconds(expires).to_string() })
}
