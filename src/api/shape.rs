//! Kinds of JSON values. serde also takes a list for an object, field by field, and an object for a bare word;
//! a request does not.

use super::fault::{Fault, child};
use serde_json::Value;

/// Where `given` was read as something of another kind, `read` being the same request written out again.
pub fn mistaken(given: &Value, read: &Value) -> Vec<Fault> {
    let mut faults = Vec::new();
    compare(given, read, String::new(), &mut faults);
    faults
}

fn compare(given: &Value, read: &Value, here: String, faults: &mut Vec<Fault>) {
    match (given, read) {
        (Value::Object(members), Value::Object(fields)) => {
            for (name, value) in members {
                // What was left out on writing, and what is unknown, has nothing to be compared with.
                if let Some(field) = fields.get(name) {
                    compare(value, field, child(&here, name), faults);
                }
            }
        }
        (Value::Array(items), Value::Array(entries)) => {
            for (i, (item, entry)) in items.iter().zip(entries).enumerate() {
                compare(item, entry, child(&here, &i.to_string()), faults);
            }
        }
        (Value::Null, _) | (_, Value::Null) => {}
        _ if kind(given) == kind(read) => {}
        (Value::Array(_), Value::Object(_)) => faults.push(list_for_object(here)),
        _ => {
            let example = match read {
                Value::String(word) => format!(": write \"{word}\""),
                _ => String::new(),
            };
            let detail = format!("{} where {} belongs{example}", kind(given), kind(read));
            faults.push(Fault { pointer: here, detail });
        }
    }
}

/// The fault of a list that should be an object.
pub fn list_for_object(pointer: String) -> Fault {
    let detail = "a list where an object belongs: give its fields by name, as in {\"name\": value}".to_owned();
    Fault { pointer, detail }
}

fn kind(value: &Value) -> &'static str {
    match value {
        Value::Null => "null",
        Value::Bool(_) => "true or false",
        Value::Number(_) => "a number",
        Value::String(_) => "text",
        Value::Array(_) => "a list",
        Value::Object(_) => "an object",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn kinds_are_compared_at_any_depth() {
        let read = json!({"a": {"x": 1, "y": [{"z": 2}]}, "method": "event_path", "left_out": null});
        assert_eq!(mistaken(&read, &read), []);
        let given = json!({"a": {"x": 1.0, "y": [[2]]}, "method": {"event_path": null}, "left_out": null, "b": 1});
        let pointers: Vec<_> = mistaken(&given, &read).into_iter().map(|fault| fault.pointer).collect();
        assert_eq!(pointers, ["/a/y/0", "/method"]);
    }
}
