//! The written contract is the one that is served.

use crate::support::{ERROR, Server, beam, curve, request, trouble};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

#[test]
fn the_document_on_disk_is_the_one_of_the_code() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("openapi/voussoir.json");
    let disk = fs::read_to_string(path).unwrap();
    assert!(disk == voussoir::http::document(), "stale: run `cargo run -- openapi > openapi/voussoir.json`");
}

#[test]
fn every_operation_is_described() {
    let document: Value = serde_json::from_str(&voussoir::http::document()).unwrap();
    let mut operations = 0;
    for (path, methods) in document["paths"].as_object().unwrap() {
        for (method, operation) in methods.as_object().unwrap() {
            assert!(operation["operationId"].is_string() && operation["summary"].is_string(), "{method} {path}");
            operations += 1;
        }
    }
    assert_eq!(operations, 22);
}

#[test]
fn every_reference_leads_somewhere() {
    fn walk(value: &Value, document: &Value) {
        match value {
            Value::Object(object) => {
                if let Some(Value::String(reference)) = object.get("$ref") {
                    let pointer = reference.strip_prefix('#').unwrap();
                    assert!(document.pointer(pointer).is_some(), "{reference}");
                }
                object.values().for_each(|value| walk(value, document));
            }
            Value::Array(list) => list.iter().for_each(|value| walk(value, document)),
            _ => {}
        }
    }
    let document: Value = serde_json::from_str(&voussoir::http::document()).unwrap();
    walk(&document, &document);
}

/// All values of a document that have a member of this name, each with its pointer.
fn with<'a>(value: &'a Value, member: &str, pointer: &str, found: &mut Vec<(String, &'a Value)>) {
    match value {
        Value::Object(object) => {
            found.extend(object.get(member).map(|_| (pointer.to_owned(), value)));
            object.iter().for_each(|(name, value)| with(value, member, &format!("{pointer}/{name}"), found));
        }
        Value::Array(list) => {
            list.iter().enumerate().for_each(|(i, value)| with(value, member, &format!("{pointer}/{i}"), found));
        }
        _ => {}
    }
}

#[test]
fn clients_made_from_the_document_have_names_and_words() {
    let document: Value = serde_json::from_str(&voussoir::http::document()).unwrap();
    assert_eq!(document["servers"][0]["url"], "/");
    let schemas = document["components"]["schemas"].as_object().unwrap();
    let (mut choices, mut objects) = (Vec::new(), Vec::new());
    with(&document["components"], "oneOf", "", &mut choices);
    with(&document["components"], "properties", "", &mut objects);
    let mut titles = BTreeSet::new();
    for (place, choice) in choices {
        for one in choice["oneOf"].as_array().unwrap().iter().filter(|one| one["$ref"].is_null()) {
            let title = one["title"].as_str().unwrap_or_default();
            let is_null = one["type"] == "null";
            assert!(is_null || !title.is_empty() && !schemas.contains_key(title), "{place}: {title:?}");
            assert!(is_null || titles.insert(title), "{place}: {title} stands twice");
        }
    }
    assert!(titles.contains("ProfileCircular") && titles.contains("ReachNever"));
    for (place, object) in objects.iter().filter(|(_, object)| object["properties"].is_object()) {
        for (name, property) in object["properties"].as_object().unwrap() {
            assert!(property["description"].is_string(), "{place}: {name} is not described");
        }
    }
}

#[test]
fn answers_are_what_the_document_says() {
    let document: Value = serde_json::from_str(&voussoir::http::document()).unwrap();
    let holds = |schema: &str, answer: &Value| {
        let reference = format!("#/components/schemas/{schema}");
        let validator = jsonschema::draft202012::new(&json!({"$ref": reference, "components": document["components"]}));
        if let Err(fault) = validator.unwrap().validate(answer) {
            panic!("{schema} {}: {fault}", fault.instance_path());
        }
    };
    let server = Server::start(1, 10);
    let case = |name: &str| -> Value {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name).join("request.json");
        serde_json::from_slice(&fs::read(file).unwrap()).unwrap()
    };
    let cases = ["settlement", "half-arch", "two-span-bridge", "paper/figure-8"].map(case);
    let mut safe = request();
    safe["analysis"] = json!({"safety": {}});
    let mut meshed = request();
    meshed["mesh"] = json!({"subblocks": {"uniform": {"radial": 2, "along": 2}}});
    meshed["report"] = json!({"stress_fields": ["near_collapse"]});
    for asked in [request(), curve(), beam(), safe, meshed, trouble(ERROR)].into_iter().chain(cases) {
        let path = server.submit(&asked);
        let status = server.until(&path, &["successful", "failed"]);
        holds("JobStatus", &status);
        let answer = server.get(&format!("{path}/results")).json();
        holds(if status["status"] == "failed" { "Problem" } else { "JobResult" }, &answer);
        holds("Request", &server.get(&format!("{path}/request")).json());
    }
    holds("JobList", &server.get("/v1/jobs?limit=2").json());
    holds("JobList", &server.get("/v1/jobs").json());
    let mut faulty = request();
    faulty["arch"]["voussoirs"] = json!(1);
    holds("Problem", &server.post(faulty.to_string().as_bytes()).problem(422));
}
