//! What is wrapped around every route: fallbacks, limits, ids, one log line per request.

mod auth;
mod host;
mod links;
mod tokens;

pub use host::Hosts;
pub use links::LinkKey;
pub use tokens::{NO_TOKEN, Tokens, is_token};

pub(super) use auth::Client;

use super::problem::Problem;
use super::{Service, Settings};
use axum::Router;
use axum::body::Body;
use axum::extract::{MatchedPath, State};
use axum::http::{HeaderName, HeaderValue, Method, Request, StatusCode, Uri, header};
use axum::middleware::{Next, from_fn_with_state};
use axum::response::{IntoResponse, Response};
use std::any::Any;
use std::sync::Arc;
use std::time::{Duration, Instant};
use tower::util::option_layer;
use tower_http::catch_panic::CatchPanicLayer;
use tower_http::compression::CompressionLayer;
use tower_http::cors::{AllowHeaders, CorsLayer};
use tower_http::request_id::{MakeRequestUuid, PropagateRequestIdLayer, RequestId, SetRequestIdLayer};
use tower_http::set_header::SetResponseHeaderLayer;
use tower_http::trace::TraceLayer;
use tracing::Span;
use tracing::field::Empty;

/// A page from here loads nothing, and nothing may frame it; the API browser brings a policy of its own.
const POLICY: HeaderValue = HeaderValue::from_static("default-src 'none'; frame-ancestors 'none'");

/// Longest path and request id in the log, characters.
const LONGEST_LOGGED: usize = 200;

/// How long a browser may remember what pages of another origin may ask: the longest that browsers allow is a day.
const REMEMBERED: Duration = Duration::from_secs(86_400);

/// Unless an answer says otherwise, whoever keeps it has to ask whether it still holds.
const ASK_AGAIN: HeaderValue = HeaderValue::from_static("no-cache");

/// Shuts `router` to those without a token or a link.
pub(super) fn guard(router: Router<Arc<Service>>, settings: Arc<Settings>) -> Router<Arc<Service>> {
    router.route_layer(from_fn_with_state(settings, auth::admit))
}

/// Wraps `router`; of the layers the last one sees a request first.
pub(super) fn wrap(router: Router, service: &Arc<Service>) -> Router {
    let trace = TraceLayer::new_for_http().make_span_with(span).on_request(()).on_response(log).on_failure(());
    let origins = &service.settings.origins;
    let no_sniffing = HeaderValue::from_static("nosniff");
    router
        .fallback(no_such_path)
        .method_not_allowed_fallback(method_not_allowed)
        .layer(CatchPanicLayer::custom(panicked))
        .layer(CompressionLayer::new())
        .layer(option_layer((!origins.is_empty()).then(|| cors(origins))))
        .layer(from_fn_with_state(service.settings.hosts.clone(), host::check))
        .layer(from_fn_with_state(service.clone(), count))
        .layer(SetResponseHeaderLayer::if_not_present(header::CONTENT_SECURITY_POLICY, POLICY))
        .layer(SetResponseHeaderLayer::if_not_present(header::CACHE_CONTROL, ASK_AGAIN))
        .layer(SetResponseHeaderLayer::overriding(header::X_CONTENT_TYPE_OPTIONS, no_sniffing))
        .layer(trace)
        .layer(PropagateRequestIdLayer::x_request_id())
        .layer(SetRequestIdLayer::x_request_id(MakeRequestUuid))
}

/// Lets pages of these origins ask.
fn cors(origins: &[HeaderValue]) -> CorsLayer {
    let name = HeaderName::from_static;
    CorsLayer::new()
        .allow_origin(origins.to_vec())
        .allow_methods([Method::GET, Method::POST, Method::DELETE])
        .allow_headers(AllowHeaders::mirror_request())
        .max_age(REMEMBERED)
        .expose_headers([
            header::ETAG,
            header::LOCATION,
            header::RETRY_AFTER,
            name("preference-applied"),
            name("x-request-id"),
        ])
}

/// Counts the answer by its route: the pattern, not the path, so that there are only so many.
async fn count(State(service): State<Arc<Service>>, request: Request<Body>, next: Next) -> Response {
    let method = request.method().clone();
    let route = request.extensions().get::<MatchedPath>().map(|path| path.as_str().to_owned());
    let clock = Instant::now();
    let response = next.run(request).await;
    service.metrics.answered(&method, route, &response, clock.elapsed());
    response
}

async fn no_such_path(uri: Uri) -> Problem {
    Problem::no_such_path(cut(uri.path()))
}

async fn method_not_allowed() -> Problem {
    Problem::plain(StatusCode::METHOD_NOT_ALLOWED, "the header allow lists the methods of this path")
}

/// The panic itself goes to the log through the panic hook, not to the client.
fn panicked(_: Box<dyn Any + Send + 'static>) -> Response {
    Problem::internal().into_response()
}

fn span(request: &Request<Body>) -> Span {
    let id = request.extensions().get::<RequestId>().and_then(|id| id.header_value().to_str().ok()).map(cut);
    let (method, path) = (request.method(), cut(request.uri().path()));
    tracing::info_span!("request", %method, path, request.id = id, job.id = Empty)
}

fn log(response: &Response, latency: Duration, _: &Span) {
    let (status, ms) = (response.status().as_u16(), latency.as_secs_f64() * 1e3);
    match response.status().is_server_error() {
        true => tracing::warn!(status, ms, "answered"),
        false => tracing::info!(status, ms, "answered"),
    }
}

/// The beginning of what a client sent, short enough for a line.
fn cut(text: &str) -> &str {
    let end = text.char_indices().nth(LONGEST_LOGGED).map_or(text.len(), |(end, _)| end);
    &text[..end]
}
