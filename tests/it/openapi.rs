//! The written contract is the one that is served.

use serde_json::Value;
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
    assert_eq!(operations, 16);
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
