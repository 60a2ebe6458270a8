//! The HTTP interface: a request becomes a [`Question`](crate::collapse::Question), its answer becomes JSON. Nothing is
//! computed here.

mod contract;
pub mod fault;
mod jobs;
mod kinds;
mod layers;
mod meta;
pub mod problem;
pub mod read;
pub mod request;
pub mod response;
pub mod status;
mod timestamp;
pub mod translate;
mod tree;
mod wording;

use crate::jobs::JobStore;
use axum::Router;
use request::Request;
use std::sync::Arc;
use utoipa::OpenApi;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

/// What every handler can reach.
#[derive(Clone)]
pub struct Service {
    /// All jobs, each with the request it came from.
    pub jobs: Arc<JobStore<Request>>,
    /// Longest body taken, bytes.
    pub body_limit: usize,
}

#[derive(OpenApi)]
#[openapi(
    info(title = "Voussoir", description = "Tells when a masonry arch falls, how, and how sure we are."),
    tags(
        (name = "jobs", description = "Analyses, from submission to results; words of OGC API - Processes"),
        (name = "service", description = "The service itself"),
    )
)]
struct Document;

/// Where everything is.
fn routes() -> OpenApiRouter<Service> {
    OpenApiRouter::with_openapi(Document::openapi())
        .routes(routes!(jobs::submit, jobs::list))
        .routes(routes!(jobs::show, jobs::dismiss))
        .routes(routes!(jobs::results))
        .routes(routes!(meta::live))
        .routes(routes!(meta::openapi))
}

/// The service, ready to be served.
pub fn router(service: Service) -> Router {
    let body_limit = service.body_limit;
    let (router, _) = routes().with_state(service).split_for_parts();
    layers::wrap(router, body_limit)
}

/// The OpenAPI document, as it is served and as `openapi/voussoir.json` holds it.
pub fn document() -> String {
    // Serialising a document of strings and numbers cannot fail; an empty one would fail its test.
    let mut text = contract::complete(routes().into_openapi()).to_pretty_json().unwrap_or_default();
    text.push('\n');
    text
}
