//! The schema of a body, as `openapi/voussoir.json` has it.

use jsonschema::Validator;
use serde_json::{Value, json};
use std::path::Path;

/// What stands at the end of a path through the schema: a value, or a list as such.
pub struct Leaf {
    /// `AnalysisRequest` or `BeamRequest`.
    pub body: String,
    /// JSON pointer with `*` for any item of a list.
    pub path: String,
    pub schema: Value,
}

pub fn document() -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("openapi/voussoir.json");
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// Says whether a body is one by the schema.
pub fn validator() -> Validator {
    let components = document()["components"].take();
    jsonschema::draft202012::new(&json!({"$ref": "#/components/schemas/Request", "components": components})).unwrap()
}

/// All leaves of all bodies.
pub fn leaves() -> Vec<Leaf> {
    let document = document();
    let schemas = &document["components"]["schemas"];
    let mut leaves = Vec::new();
    for body in schemas["Request"]["oneOf"].as_array().unwrap() {
        let name = name_of(body);
        walk(&schemas[name], schemas, name, "", &mut leaves);
    }
    leaves
}

fn name_of(reference: &Value) -> &str {
    reference["$ref"].as_str().unwrap().rsplit('/').next().unwrap()
}

/// Whether a schema is of a type, perhaps among others.
pub fn is(schema: &Value, kind: &str) -> bool {
    schema["type"] == kind || schema["type"].as_array().is_some_and(|kinds| kinds.iter().any(|word| word == kind))
}

fn walk(schema: &Value, schemas: &Value, body: &str, path: &str, leaves: &mut Vec<Leaf>) {
    let mut leaf = |schema: Value| leaves.push(Leaf { body: body.to_owned(), path: path.to_owned(), schema });
    if schema.get("$ref").is_some() {
        return walk(&schemas[name_of(schema)], schemas, body, path, leaves);
    }
    if let Some(choices) = schema["oneOf"].as_array() {
        return choices.iter().for_each(|choice| walk(choice, schemas, body, path, leaves));
    }
    assert!(schema.get("type").is_some(), "{path}: a schema of no type would let anything through: {schema}");
    if is(schema, "object") {
        assert_eq!(schema["additionalProperties"], json!(false), "{path}: unknown fields are refused");
        let Some(properties) = schema["properties"].as_object() else { return leaf(schema.clone()) };
        for (name, property) in properties {
            walk(property, schemas, body, &format!("{path}/{name}"), leaves);
        }
    } else if is(schema, "array") {
        leaf(schema.clone());
        walk(&schema["items"], schemas, body, &format!("{path}/*"), leaves);
    } else {
        leaf(schema.clone());
    }
}
