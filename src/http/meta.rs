//! Handlers about the service itself.

use super::document;
use super::problem::Problem;
use super::service::AppState;
use axum::Json;
use axum::http::header;
use axum::response::IntoResponse;
use serde::Serialize;
use std::sync::LazyLock;
use utoipa::ToSchema;

static DOCUMENT: LazyLock<String> = LazyLock::new(document::document);

/// A sign of life.
#[derive(Debug, Serialize, ToSchema)]
pub(super) struct Health {
    /// `live` or `ready`.
    #[schema(example = "live")]
    status: &'static str,
    /// Version of the program.
    version: &'static str,
}

impl Health {
    fn of(status: &'static str) -> Json<Self> {
        Json(Health { status, version: env!("CARGO_PKG_VERSION") })
    }
}

/// Is the process alive?
#[utoipa::path(
    get, path = "/health/live", tag = "service", operation_id = "live",
    responses((status = 200, description = "Alive", body = Health))
)]
pub(super) async fn live() -> Json<Health> {
    Health::of("live")
}

/// Are jobs accepted?
#[utoipa::path(
    get, path = "/health/ready", tag = "service", operation_id = "ready",
    responses((status = 200, description = "Ready", body = Health))
)]
pub(super) async fn ready(state: AppState) -> Result<Json<Health>, Problem> {
    // The store may be elsewhere, and out of reach.
    state.store.occupancy().await?;
    if state.store.is_open() { Ok(Health::of("ready")) } else { Err(Problem::shutting_down()) }
}

/// This document.
#[utoipa::path(
    get, path = "/openapi.json", tag = "service", operation_id = "openapi",
    responses((status = 200, description = "The OpenAPI document", body = Object))
)]
pub(super) async fn openapi() -> impl IntoResponse {
    ([(header::CONTENT_TYPE, "application/json")], DOCUMENT.as_str())
}
