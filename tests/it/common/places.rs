//! Every place in a JSON tree.

use serde_json::Value;

/// Pointers to all values of a tree.
pub fn places(tree: &Value, here: &str, all: &mut Vec<String>) {
    all.push(here.to_owned());
    match tree {
        Value::Object(object) => object.iter().for_each(|(key, value)| places(value, &format!("{here}/{key}"), all)),
        Value::Array(list) => list.iter().enumerate().for_each(|(i, value)| places(value, &format!("{here}/{i}"), all)),
        _ => {}
    }
}
