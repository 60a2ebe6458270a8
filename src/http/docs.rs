//! The API browser, from the program itself.

use super::problem::Problem;
use axum::Router;
use axum::extract::Request;
use axum::http::{HeaderValue, StatusCode, header};
use axum::middleware::{Next, from_fn};
use axum::response::{IntoResponse, Response};
use utoipa_swagger_ui::{Config, SwaggerUi};

/// The browser runs its own script and styles, and asks this service only.
const PAGE_POLICY: HeaderValue = HeaderValue::from_static(
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; \
     connect-src 'self'; frame-ancestors 'none'",
);

/// `/docs` and what its page needs.
pub(super) fn router<S: Clone + Send + Sync + 'static>() -> Router<S> {
    let browser = SwaggerUi::new("/docs").config(Config::from("/openapi.json").validator_url("none"));
    Router::from(browser).layer(from_fn(finish))
}

async fn finish(request: Request, next: Next) -> Response {
    let path = request.uri().path().to_owned();
    let mut response = next.run(request).await;
    if response.status() == StatusCode::NOT_FOUND {
        response = Problem::no_such_path(&path).into_response();
    }
    response.headers_mut().insert(header::CONTENT_SECURITY_POLICY, PAGE_POLICY);
    response
}
