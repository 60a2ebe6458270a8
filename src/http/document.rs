//! The OpenAPI document: what the handlers say of themselves, and what holds for many of them.

use super::problem::{MEDIA_TYPE, Problem};
use super::{guarded, open};
use crate::wire::contract;
use crate::wire::format::{FIELD, FIGURE, Format, HISTORY, POSITIONS, REPORT, RESULTS};
use serde_json::{Value, from_value, json};
use utoipa::ToSchema;
use utoipa::openapi::OpenApi;
use utoipa::openapi::ServerBuilder;
use utoipa::openapi::link::{Link, LinkBuilder};
use utoipa::openapi::security::{Http, HttpAuthScheme, SecurityRequirement, SecurityScheme};

/// Name of the security scheme.
const TOKEN: &str = "token";

/// A bearer token has no scopes.
const NO_SCOPES: [&str; 0] = [];

/// Status code, meaning, and the operations it holds for, each told by its path and its id.
type Refused = (&'static str, &'static str, fn(&str, &str) -> bool);

/// Problems; of two for the same status code the first one holds.
const PROBLEMS: [Refused; 33] = [
    ("400", "The query cannot be read", |path, id| {
        of_results(path, id) || ["list_jobs", "get_events_of_many", "make_request"].contains(&id)
    }),
    ("400", "Not JSON, or a header that cannot be read", |_, id| has_body(id)),
    ("400", "The header `host` is missing, given twice or no host name", |_, _| true),
    ("401", "No token, or another one; only where the service has tokens", |path, _| is_guarded(path)),
    ("403", "The token may not do this; only where the service has tokens", |path, _| is_guarded(path)),
    ("404", "No such job", |_, id| id == "get_events_of_many"),
    ("404", "No such job, result not ready, or no such part", |path, _| path.contains("{id}")),
    ("406", "Not to be had in this format", of_results),
    ("408", "The body did not arrive in time", |_, id| has_body(id)),
    ("409", "The job has ended with a result or a failure", |_, id| id == "dismiss_job"),
    ("409", "The job has not ended", |_, id| id == "forget_job"),
    ("410", "The idempotency key was used for a job that is forgotten", |_, id| id == "submit_job"),
    ("410", "The job was dismissed", of_results),
    ("413", "The body is too long", |_, id| has_body(id)),
    ("415", "The body is not said to be CSV", |_, id| id == "make_request"),
    ("415", "The body is not said to be JSON", |_, id| has_body(id)),
    ("421", "The service does not go by the name in the header `host`", |_, _| true),
    ("422", "The analysis failed", of_results),
    ("422", FAULTY_OR_TAKEN, |_, id| id == "submit_job"),
    ("422", "Describes no analysis: the faults are listed", |_, id| id == "validate"),
    ("422", "Describes no link: the faults are listed", |_, id| id == "create_link"),
    ("422", "Describes no arch: the faults are listed, with their lines", |_, id| id == "make_request"),
    (
        "429",
        "As many jobs of this client wait, or as many bytes are kept for it or on their way from it, as may",
        |_, id| id == "submit_job",
    ),
    ("429", "As many bodies of this client are on their way as may", |_, id| is_only_read(id)),
    ("429", "As many answers to this client are on their way as may", of_results),
    ("500", "A defect of the program", |_, _| true),
    ("503", "Too many answers are on their way", of_results),
    ("503", "Queue or memory full, or shutting down", |_, id| id == "submit_job"),
    ("503", "As many bodies are on their way as there is memory for", |_, id| is_only_read(id)),
    ("429", "As many event streams of this client are open as may", |_, id| is_stream(id)),
    ("503", "Too many streams are open, or shutting down", |_, id| is_stream(id)),
    ("503", "Shutting down", |_, id| id == "ready"),
    ("304", "As the client knows it already", of_results),
];

const FAULTY_OR_TAKEN: &str =
    "Describes no analysis: the faults are listed; or the idempotency key was used for another request";

/// What a job's id is good for.
const LINKED: [&str; 12] = [
    "get_job",
    "dismiss_job",
    "forget_job",
    "get_request",
    "get_events",
    "get_results",
    "get_history",
    "get_field",
    "get_positions",
    "get_figure",
    "get_figure_of_name",
    "get_report",
];

/// Ends of paths, and the formats on offer there.
const FORMATS: [(&str, &[Format]); 7] = [
    ("/results", &RESULTS),
    ("/history", &HISTORY),
    ("/positions", &POSITIONS),
    ("/fields/{load}", &FIELD),
    ("/figure", &FIGURE),
    ("/figures/{figure}", &FIGURE),
    ("/report", &REPORT),
];

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

/// True for what reads an answer or a part of it.
fn of_results(path: &str, operation: &str) -> bool {
    path.contains("/results") && operation != "forget_job"
}

fn has_body(operation: &str) -> bool {
    operation == "submit_job" || is_only_read(operation)
}

/// True for what queues nothing of its body.
fn is_only_read(operation: &str) -> bool {
    ["validate", "create_link", "make_request"].contains(&operation)
}

fn is_stream(operation: &str) -> bool {
    ["get_events", "get_events_of_many"].contains(&operation)
}

fn complete(document: &mut OpenApi) {
    for (path, item) in &mut document.paths.paths {
        for operation in [&mut item.get, &mut item.post, &mut item.delete].into_iter().flatten() {
            let id = operation.operation_id.as_deref().unwrap_or_default();
            let responses = &mut operation.responses.responses;
            for (status, meaning, _) in PROBLEMS.iter().filter(|(.., holds)| holds(path, id)) {
                if !responses.contains_key(*status) {
                    // What is left out here for want of a word of OpenAPI would fail the document's test.
                    responses
                        .extend(from_value(refused(status, meaning)).map(|refused| ((*status).to_owned(), refused)));
                }
            }
            if let Some((_, formats)) = FORMATS.iter().find(|(end, _)| path.ends_with(end) && of_results(path, id)) {
                let names: Vec<_> = formats.iter().map(|format| format.name()).collect();
                let format = json!({
                    "name": "f", "in": "query", "description": "Format; goes before the header `accept`",
                    "required": false, "schema": {"type": "string", "enum": names},
                });
                operation.parameters.get_or_insert_default().extend(from_value(format));
            }
            // A token, or none where the service is open to all; for the rest never one.
            let token = || vec![SecurityRequirement::new(TOKEN, NO_SCOPES), SecurityRequirement::default()];
            operation.security = Some(if is_guarded(path) { token() } else { Vec::new() });
        }
    }
    let submission = document.paths.paths.get_mut("/v1/jobs").and_then(|item| item.post.as_mut());
    if let Some(utoipa::openapi::RefOr::T(accepted)) =
        submission.and_then(|submit| submit.responses.responses.get_mut("201"))
    {
        accepted.links.extend(LINKED.map(|operation| (operation.to_owned(), link(operation).into())));
    }
    document.servers = Some(vec![ServerBuilder::new().url("/").description(Some("Where this was found")).build()]);
    let scheme = SecurityScheme::Http(Http::new(HttpAuthScheme::Bearer));
    document.components.get_or_insert_default().add_security_scheme(TOKEN, scheme);
}

/// Leads from a submission to what can be asked of its job.
fn link(operation: &str) -> Link {
    let link = LinkBuilder::new().operation_id(operation).parameter("id", "$response.body#/job_id");
    match operation {
        "get_field" => link.parameter("load", "near_collapse").build(),
        _ => link.build(),
    }
}

/// An answer that is a problem, unless it only says that nothing is new; one that may pass says when to try again.
fn refused(status: &str, meaning: &str) -> Value {
    let mut response = json!({"description": meaning});
    if status != "304" {
        let schema = format!("#/components/schemas/{}", Problem::name());
        response["content"] = json!({MEDIA_TYPE: {"schema": {"$ref": schema}}});
    }
    if ["429", "503"].contains(&status) {
        let seconds = json!({"type": "integer", "format": "int64", "minimum": 0});
        response["headers"] =
            json!({"retry-after": {"schema": seconds, "description": "Seconds after which to try again"}});
    }
    response
}
