//! The OpenAPI document: what the handlers say of themselves, and what holds for many of them.

use super::format::{FIELD, FIGURE, Format, HISTORY, RESULTS};
use super::problem::{MEDIA_TYPE, Problem};
use super::{contract, guarded, open};
use utoipa::ToSchema;
use utoipa::openapi::link::{Link, LinkBuilder};
use utoipa::openapi::path::{Operation, Parameter, ParameterBuilder, ParameterIn};
use utoipa::openapi::schema::{ObjectBuilder, Type};
use utoipa::openapi::security::{Http, HttpAuthScheme, SecurityRequirement, SecurityScheme};
use utoipa::openapi::{Content, OpenApi, Ref, RefOr, Required, ResponseBuilder};

/// Name of the security scheme.
const TOKEN: &str = "token";

/// A bearer token has no scopes.
const NO_SCOPES: [&str; 0] = [];

/// Status code, meaning, and the paths it holds for.
type Common = (&'static str, &'static str, fn(&str) -> bool);

/// Problems that many operations share; an operation's own words for a code go before these.
const COMMON: [Common; 8] = [
    ("400", "The query cannot be read", |path| path.contains("/results") || path == "/v1/jobs"),
    ("401", "No token, or another one; only where the service has tokens", is_guarded),
    ("404", "No such job, result not ready, or no such part", |path| path.contains("{id}")),
    ("406", "Not to be had in this format", |path| path.contains("/results")),
    ("410", "The job was dismissed", |path| path.contains("/results")),
    ("422", "The analysis failed", |path| path.contains("/results")),
    ("500", "A defect of the program", |_| true),
    ("503", "Too many answers are on their way", |path| path.contains("/results")),
];

/// Problems of operations with a body.
const OF_BODIES: [(&str, &str); 4] = [
    ("400", "Not JSON, or a header that cannot be read"),
    ("408", "The body did not arrive in time"),
    ("413", "The body is too long"),
    ("415", "The body is not said to be JSON"),
];

/// What a job's id is good for.
const LINKED: [&str; 8] =
    ["get_job", "dismiss_job", "get_request", "get_events", "get_results", "get_history", "get_field", "get_figure"];

/// Ends of paths, and the formats on offer there.
const FORMATS: [(&str, &[Format]); 4] =
    [("/results", &RESULTS), ("/history", &HISTORY), ("/fields/{load}", &FIELD), ("/figure", &FIGURE)];

/// The OpenAPI document, as it is served and as `openapi/voussoir.json` holds it.
pub fn document() -> String {
    let mut document = contract::complete(guarded().merge(open()).into_openapi());
    complete(&mut document);
    // Serialising a document of strings and numbers cannot fail; an empty one would fail its test.
    let mut text = document.to_pretty_json().unwrap_or_default();
    text.push('\n');
    text
}

fn is_guarded(path: &str) -> bool {
    path.starts_with("/v1") || path == "/metrics"
}

fn complete(document: &mut OpenApi) {
    for (path, item) in &mut document.paths.paths {
        let operations = [&mut item.get, &mut item.post, &mut item.delete].into_iter().flatten();
        for operation in operations {
            for (status, meaning, _) in COMMON.iter().filter(|(_, _, holds)| holds(path)) {
                add(operation, status, meaning);
            }
            if operation.request_body.is_some() {
                OF_BODIES.iter().for_each(|(status, meaning)| add(operation, status, meaning));
            }
            if path.contains("/results") {
                let known = ResponseBuilder::new().description("As the client knows it already").build();
                operation.responses.responses.entry("304".to_owned()).or_insert(RefOr::T(known));
            }
            if let Some((_, formats)) = FORMATS.iter().find(|(end, _)| path.ends_with(end)) {
                operation.parameters.get_or_insert_default().push(RefOr::T(format_of(formats)));
            }
            if is_guarded(path) {
                // A token, or none where the service is open to all.
                operation.security =
                    Some(vec![SecurityRequirement::new(TOKEN, NO_SCOPES), SecurityRequirement::default()]);
            }
        }
    }
    let submission = document.paths.paths.get_mut("/v1/jobs").and_then(|item| item.post.as_mut());
    if let Some(RefOr::T(accepted)) = submission.and_then(|submit| submit.responses.responses.get_mut("201")) {
        accepted.links.extend(LINKED.map(|operation| (operation.to_owned(), RefOr::T(link(operation)))));
    }
    let scheme = SecurityScheme::Http(Http::new(HttpAuthScheme::Bearer));
    document.components.get_or_insert_default().add_security_scheme(TOKEN, scheme);
}

/// The query parameter that chooses one of these formats.
fn format_of(formats: &[Format]) -> Parameter {
    let names = ObjectBuilder::new().schema_type(Type::String);
    let names = names.enum_values(Some(formats.iter().map(|format| format.name())));
    ParameterBuilder::new()
        .name("f")
        .parameter_in(ParameterIn::Query)
        .required(Required::False)
        .description(Some("Format; goes before the header `accept`"))
        .schema(Some(names))
        .build()
}

/// Leads from a submission to what can be asked of its job.
fn link(operation: &str) -> Link {
    let link = LinkBuilder::new().operation_id(operation).parameter("id", "$response.body#/job_id");
    match operation {
        "get_field" => link.parameter("load", "near_collapse").build(),
        _ => link.build(),
    }
}

/// Adds a problem to an operation that does not speak of this status itself.
fn add(operation: &mut Operation, status: &str, meaning: &str) {
    let content = Content::new(Some(Ref::from_schema_name(Problem::name())));
    let response = ResponseBuilder::new().description(meaning).content(MEDIA_TYPE, content).build();
    operation.responses.responses.entry(status.to_owned()).or_insert(RefOr::T(response));
}
