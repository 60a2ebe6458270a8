//! What is wrong with a value, in words, with the remedy.

use crate::wire::fault::Shown;
use serde_json::Value;
use utoipa::Number;
use utoipa::openapi::schema::{Object, Type};

/// Longest part of a request that a fault quotes, characters.
const LONGEST_QUOTE: usize = 60;

/// Longest words of a field that a fault repeats, bytes.
const LONGEST_WORDS: usize = 120;

/// Most names of fields in an object that a fault shows how to write.
const NAMES_LISTED: usize = 4;

/// Most fields of an object that are all named where one of another name stands in it.
const FIELDS_LISTED: usize = 8;

/// The words that a text may be; none where it is free.
pub(super) fn words_of(object: &Object) -> Vec<&str> {
    object.enum_values.iter().flatten().filter_map(Value::as_str).collect()
}

/// Bounds of a number: least and most, each with whether it is in the range itself.
fn bounds(object: &Object) -> [Option<(f64, bool)>; 2] {
    let value = |number: &Number| match *number {
        Number::Int(value) => value as f64,
        Number::UInt(value) => value as f64,
        Number::Float(value) => value,
    };
    let bound = |inside: &Option<Number>, outside: &Option<Number>| {
        let inside = inside.as_ref().map(|number| (value(number), true));
        inside.or(outside.as_ref().map(|number| (value(number), false)))
    };
    [bound(&object.minimum, &object.exclusive_minimum), bound(&object.maximum, &object.exclusive_maximum)]
}

/// Whether a number is between its bounds.
pub(super) fn in_range(object: &Object, value: f64) -> bool {
    let [least, most] = bounds(object);
    let above = least.is_none_or(|(least, inside)| value > least || (inside && value == least));
    let below = most.is_none_or(|(most, inside)| value < most || (inside && value == most));
    above && below
}

/// The words for a number out of range, where `what` belongs.
pub(super) fn out_of_range(object: &Object, value: f64, what: &str) -> String {
    let rule = match bounds(object) {
        [Some((least, true)), Some((most, true))] => format!("from {} to {}", Shown(least), Shown(most)),
        [Some((least, true)), Some((most, false))] => {
            format!("at least {} and less than {}", Shown(least), Shown(most))
        }
        [Some((least, false)), Some((most, true))] => {
            format!("greater than {} and at most {}", Shown(least), Shown(most))
        }
        [Some((least, false)), Some((most, false))] => {
            format!("between {} and {}, both excluded", Shown(least), Shown(most))
        }
        // Every number of a request has both bounds: tests/it/contract.rs sees to it.
        _ => "another".to_owned(),
    };
    let words = object.description.as_deref().unwrap_or_default().split(". ").next().unwrap_or_default();
    let words = if words.len() <= LONGEST_WORDS { words.trim_end_matches('.') } else { "" };
    let words = if words.is_empty() { String::new() } else { format!(" ({words})") };
    format!("{} is out of range: it must be {what} {rule}{words}", Shown(value))
}

/// What belongs where a value of this kind does, with the remedy.
pub(super) fn belonging(kind: &Type, words: &[&str]) -> (&'static str, String) {
    match kind {
        Type::Array => ("a list", "write its items in [ ]".to_owned()),
        Type::String if words.is_empty() => ("text", "write it in quotes".to_owned()),
        Type::String => ("text", format!("write {}", one_of(words))),
        Type::Boolean => ("true or false", "write one of them, without quotes".to_owned()),
        Type::Integer => ("a whole number", "write one, without quotes".to_owned()),
        _ => ("a number", "write one, without quotes".to_owned()),
    }
}

/// How an object is written.
pub(super) fn by_name(object: &Object) -> String {
    let listed = |names: Vec<&String>| {
        let more = if names.len() > NAMES_LISTED { ", ..." } else { "" };
        let names: Vec<_> = names.into_iter().take(NAMES_LISTED).map(|name| format!("\"{name}\": ...")).collect();
        format!("{{{}{more}}}", names.join(", "))
    };
    match (object.properties.is_empty(), object.required.is_empty()) {
        (true, _) => "write {}".to_owned(),
        (_, true) => {
            let all = listed(object.properties.keys().collect());
            format!("write {{}} for its defaults, or give its fields by name: {all}")
        }
        (_, false) => format!("give its fields by name: {}", listed(object.required.iter().collect())),
    }
}

/// The fields that an object has, where they are few.
pub(super) fn among(object: &Object) -> String {
    let names: Vec<_> = object.properties.keys().map(|name| format!("`{name}`")).collect();
    let few = (1..=FIELDS_LISTED).contains(&names.len());
    if few { format!(", of {}", names.join(", ")) } else { String::new() }
}

/// The words for a value of another kind than belongs there: what does, and the remedy.
pub(super) fn wrong_kind(value: &Value, (belonging, remedy): (&str, String)) -> String {
    let given = match value {
        Value::Null => return format!("null where {belonging} belongs: give it, or leave the field out"),
        Value::Bool(_) => "true or false",
        Value::Number(_) => "a number",
        Value::String(_) => "text",
        Value::Array(_) => "a list",
        Value::Object(_) => "an object",
    };
    format!("{given} where {belonging} belongs: {remedy}")
}

/// Words to choose from.
pub(super) fn one_of(words: &[&str]) -> String {
    let words: Vec<_> = words.iter().map(|word| format!("\"{word}\"")).collect();
    words.join(" or ")
}

/// The beginning of what a request says.
pub(super) fn quoted(text: &str) -> String {
    match text.char_indices().nth(LONGEST_QUOTE) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}
