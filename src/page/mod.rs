//! The page at `/`: plain ES modules that talk to the HTTP interface like any other client. Its files are embedded as they are
//! written; nothing is built, and nothing is loaded from elsewhere.

use axum::Router;
use axum::http::header::{ACCEPT, CACHE_CONTROL, CONTENT_SECURITY_POLICY, CONTENT_TYPE, VARY};
use axum::http::{HeaderMap, HeaderValue, StatusCode};
use axum::response::{IntoResponse, Redirect, Response};
use axum::routing::get;
use headers::{ETag, HeaderMapExt, IfNoneMatch};
use std::hash::{DefaultHasher, Hash, Hasher};

/// Files of this service only, nothing inline, and in no frame.
const POLICY: HeaderValue = HeaderValue::from_static(
    "default-src 'self'; object-src 'none'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'",
);

const ASK_AGAIN: HeaderValue = HeaderValue::from_static("no-cache");

/// The page itself.
const PAGE: (&str, &[u8]) = ("index.html", include_bytes!("index.html"));

macro_rules! files {
    ($($name:literal)*) => { [$(($name, include_bytes!($name))),*] };
}

/// What the page loads, under `/page/`.
const FILES: &[(&str, &[u8])] = &files! {
    "answer.css" "icon.svg" "style.css"
    "answer.js" "api.js" "arrows.js" "certificate.js" "colour.js" "curves.js" "dom.js" "draft.js" "exports.js" "facts.js" "faults.js"
    "fields.js" "form.js" "frames.js" "job.js" "jobs.js" "joints.js" "loads-form.js" "main.js" "memory.js" "number.js" "outline.js"
    "player.js" "plot.js" "pointer.js" "profile.js" "proof.js" "question-form.js" "ring.js" "sketch.js" "spans.js" "stage.js"
    "starters.js" "status.js" "stone-form.js" "stream.js" "stress.js" "structure-form.js" "survey.js" "thrust.js" "token.js"
    "view.js"
};

/// The page, and whatever it loads.
pub fn router<S: Clone + Send + Sync + 'static>() -> Router<S> {
    let root = |headers: HeaderMap| async move {
        let mut response =
            if wants_html(&headers) { served(PAGE, &headers) } else { Redirect::to("/docs/").into_response() };
        response.headers_mut().insert(VARY, HeaderValue::from_static("accept"));
        response
    };
    FILES.iter().fold(Router::new().route("/", get(root)), |router, &file| {
        router.route(&format!("/page/{}", file.0), get(async move |headers: HeaderMap| served(file, &headers)))
    })
}

/// Browsers name HTML; other programs take anything, and are led to the interface.
fn wants_html(headers: &HeaderMap) -> bool {
    let mut lines = headers.get_all(ACCEPT).iter().filter_map(|line| line.to_str().ok());
    lines.any(|line| line.split(',').any(|range| range.trim_start().starts_with("text/html")))
}

/// A file, unless the client has it already.
fn served((name, bytes): (&'static str, &'static [u8]), headers: &HeaderMap) -> Response {
    let version = version(bytes);
    let known = headers.typed_get::<IfNoneMatch>().is_some_and(|known| !known.precondition_passes(&version));
    let mut response = if known {
        StatusCode::NOT_MODIFIED.into_response()
    } else {
        ([(CONTENT_TYPE, kind(name))], bytes).into_response()
    };
    response.headers_mut().typed_insert(version);
    response.headers_mut().insert(CACHE_CONTROL, ASK_AGAIN);
    response.headers_mut().insert(CONTENT_SECURITY_POLICY, POLICY);
    response
}

/// Weak, since the bytes on the wire may be compressed.
fn version(bytes: &[u8]) -> ETag {
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    let tag = format!("W/\"{:016x}\"", hasher.finish());
    // Hexadecimal digits always make a tag.
    tag.parse().unwrap_or_else(|_| unreachable!("{tag}"))
}

fn kind(name: &str) -> &'static str {
    match name.rsplit('.').next() {
        Some("js") => "text/javascript; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("svg") => "image/svg+xml",
        _ => "text/html; charset=utf-8",
    }
}
