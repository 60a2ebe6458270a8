//! The HTTP interface: routes, the layers around them, problems, event streams. Nothing is read or written here but by
//! [`wire`](crate::wire), and nothing is computed.

mod accept;
mod answering;
mod backlog;
mod body;
mod docs;
mod document;
mod etag;
mod events;
mod jobs;
mod layers;
mod limits;
mod links;
mod meta;
mod metrics;
mod outgoing;
mod painter;
pub mod problem;
pub mod quota;
mod readers;
mod results;
mod service;
pub mod status;
mod submit;
mod surveys;

pub use document::document;
pub use layers::{Hosts, LinkKey, NO_TOKEN, Tokens, is_token};
pub use limits::ApiLimits;
pub use service::{Service, Settings, Solver};

use crate::page;
use axum::Router;
use std::sync::Arc;
use utoipa::OpenApi;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

#[derive(OpenApi)]
#[openapi(
    info(title = "Voussoir", description = "Tells when a masonry arch falls, how, and how sure we are."),
    tags(
        (name = "jobs", description = "Analyses, from submission to their end; words of OGC API - Processes"),
        (name = "results", description = "What came out, as a whole and in parts"),
        (name = "service", description = "The service itself"),
    )
)]
struct Document;

/// What needs a token, where there are tokens.
fn guarded() -> OpenApiRouter<Arc<Service>> {
    OpenApiRouter::with_openapi(Document::openapi())
        .routes(routes!(submit::submit, jobs::list))
        .routes(routes!(jobs::show, jobs::dismiss))
        .routes(routes!(jobs::request))
        .routes(routes!(events::events))
        .routes(routes!(events::events_of_many))
        .routes(routes!(results::results, jobs::forget))
        .routes(routes!(results::history))
        .routes(routes!(results::field))
        .routes(routes!(results::positions))
        .routes(routes!(results::figure))
        .routes(routes!(results::figure_of_name))
        .routes(routes!(results::report))
        .routes(routes!(submit::validate))
        .routes(routes!(surveys::make))
        .routes(routes!(links::create))
        .routes(routes!(metrics::metrics))
}

/// What is open to all.
fn open() -> OpenApiRouter<Arc<Service>> {
    OpenApiRouter::new().routes(routes!(meta::live)).routes(routes!(meta::ready)).routes(routes!(meta::openapi))
}

/// The service, ready to be served.
pub fn router(service: Arc<Service>) -> Router {
    let (guarded, _) = guarded().split_for_parts();
    let (open, _) = open().split_for_parts();
    let router =
        layers::guard(guarded, service.settings.clone()).merge(open).merge(docs::router()).merge(page::router());
    layers::wrap(router.with_state(service.clone()), &service)
}

/// What a process answers that only works: whether it lives, and what it counts.
pub fn worker_router(service: Arc<Service>) -> Router {
    let (guarded, _) = OpenApiRouter::new().routes(routes!(metrics::metrics)).split_for_parts();
    let (open, _) = open().split_for_parts();
    let router = layers::guard(guarded, service.settings.clone()).merge(open);
    layers::wrap(router.with_state(service.clone()), &service)
}
