//! The table of a request's fields, held against a body.
//!
//! A row of the table is a field of a struct in `request`: its name and kind, its range, unit and default, and its words. utoipa
//! makes a schema of the rows. The OpenAPI document shows that schema, and this reader checks bodies against it.

use crate::wire::fault::{Faults, Shown, child};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use utoipa::openapi::schema::{Array, ArrayItems, Object, OneOf, SchemaType, Type};
use utoipa::openapi::{RefOr, Schema};
use utoipa::{Number, ToSchema};

/// Least likeness of a misspelt name to the one that is suggested.
const LIKE: f64 = 0.85;

/// Longest part of a request that a fault quotes, characters.
const LONGEST_QUOTE: usize = 60;

/// Longest words of a field that a fault repeats, bytes.
const LONGEST_WORDS: usize = 120;

/// All schemas of a body, by name.
pub struct Table {
    body: RefOr<Schema>,
    schemas: BTreeMap<String, RefOr<Schema>>,
    /// What to do about a field that does not belong.
    stray: fn(&str) -> Option<&'static str>,
}

/// What a choice can be: a word, or an object with one member.
#[derive(Default)]
struct Alternatives<'a> {
    words: Vec<&'a str>,
    members: BTreeMap<&'a str, &'a RefOr<Schema>>,
}

impl Table {
    /// The table of a body of this type. `stray` has better words for some fields that do not belong.
    pub fn of<Body: ToSchema>(stray: fn(&str) -> Option<&'static str>) -> Self {
        let mut schemas = Vec::new();
        Body::schemas(&mut schemas);
        Table { body: Body::schema(), schemas: schemas.into_iter().collect(), stray }
    }

    /// Whether the body has a field of this name.
    pub fn has(&self, name: &str) -> bool {
        matches!(self.resolved(&self.body), Some(Schema::Object(body)) if body.properties.contains_key(name))
    }

    /// What is wrong with a body by itself: kinds, ranges, missing and unknown fields, as many as are listed. Fills in
    /// defaults.
    pub fn check(&self, body: &mut Value, faults: &mut Faults) {
        self.value(&self.body, body, "", faults);
    }

    fn value(&self, schema: &RefOr<Schema>, value: &mut Value, here: &str, faults: &mut Faults) {
        match self.resolved(schema) {
            Some(Schema::Object(object)) => self.object(object, value, here, faults),
            Some(Schema::Array(list)) => self.list(list, value, here, faults),
            Some(Schema::OneOf(choice)) => self.choice(choice, value, here, faults),
            // A request has no others: tests/it/contract.rs walks through all of them.
            _ => {}
        }
    }

    /// What a schema refers to.
    fn resolved<'a>(&'a self, schema: &'a RefOr<Schema>) -> Option<&'a Schema> {
        match schema {
            RefOr::T(schema) => Some(schema),
            RefOr::Ref(reference) => {
                let name = reference.ref_location.rsplit('/').next()?;
                self.resolved(self.schemas.get(name)?)
            }
        }
    }

    fn object(&self, object: &Object, value: &mut Value, here: &str, faults: &mut Faults) {
        if value.is_null() && nullable(&object.schema_type) {
            return;
        }
        match (kind_of(&object.schema_type), &mut *value) {
            (Type::Object, Value::Object(members)) => self.members(object, members, here, faults),
            (Type::String, Value::String(text)) => check_text(object, text, here, faults),
            (Type::Number, Value::Number(number)) => {
                let value = number.as_f64().unwrap_or(f64::NAN);
                if !in_range(object, value) {
                    faults.add(here, out_of_range(object, value, "a number"));
                }
            }
            (Type::Integer, Value::Number(number)) => {
                let value = number.as_f64().unwrap_or(f64::NAN);
                if !number.is_u64() || !in_range(object, value) {
                    faults.add(here, out_of_range(object, value, "a whole number"));
                }
            }
            (Type::Boolean, Value::Bool(_)) => {}
            (kind, value) => faults.add(here, wrong_kind(value, &kind, &words_of(object))),
        }
    }

    fn members(&self, object: &Object, members: &mut Map<String, Value>, here: &str, faults: &mut Faults) {
        for (name, value) in members.iter_mut() {
            // A body is refused in no more time than it takes to read: the words of a fault take longer than its field.
            if faults.is_full() {
                return;
            }
            match object.properties.get(name) {
                Some(schema) => self.value(schema, value, &child(here, name), faults),
                None => {
                    let place = child(here, name);
                    let words = (self.stray)(&place).map_or_else(|| stray_name(name, object), str::to_owned);
                    faults.stray(place, words);
                }
            }
        }
        for name in object.required.iter().filter(|name| !members.contains_key(*name)) {
            faults.add(child(here, name), format!("the required field `{name}` is missing: add it"));
        }
        for (name, default) in object.properties.iter().filter_map(|(name, schema)| Some((name, default(schema)?))) {
            members.entry(name).or_insert_with(|| default.clone());
        }
    }

    fn list(&self, list: &Array, value: &mut Value, here: &str, faults: &mut Faults) {
        if value.is_null() && nullable(&list.schema_type) {
            return;
        }
        let Value::Array(items) = value else {
            return faults.add(here, wrong_kind(value, &Type::Array, &[]));
        };
        let (count, least, most) = (items.len(), list.min_items.unwrap_or(0), list.max_items.unwrap_or(usize::MAX));
        if !(least..=most).contains(&count) {
            let rule = match (least, most) {
                (least, most) if least == most => format!("it has {least}"),
                (0, most) => format!("list at most {most}"),
                (least, most) => format!("list {least} to {most}"),
            };
            faults.add(here, format!("{count} items, which is out of range: {rule}"));
        } else if let ArrayItems::RefOrSchema(schema) = &list.items {
            for (i, item) in items.iter_mut().enumerate() {
                if faults.is_full() {
                    return;
                }
                self.value(schema, item, &child(here, &i.to_string()), faults);
            }
        }
    }

    fn choice(&self, choice: &OneOf, value: &mut Value, here: &str, faults: &mut Faults) {
        let null = |schema: &RefOr<Schema>| {
            let RefOr::T(Schema::Object(object)) = schema else { return false };
            kind_of(&object.schema_type) == Type::Null
        };
        let mut others = choice.items.iter().filter(|schema| !null(schema));
        if let (Some(only), None) = (others.next(), others.next()) {
            if !value.is_null() {
                self.value(only, value, here, faults);
            }
            return;
        }
        let all = Alternatives::of(choice);
        let wrong = match value {
            Value::Object(members) => match members.iter_mut().next() {
                Some((name, value)) if all.members.contains_key(name.as_str()) => {
                    let (schema, place) = (all.members[name.as_str()], child(here, name));
                    self.value(schema, value, &place, faults);
                    (members.len() > 1).then(|| format!("more than one alternative: {}", all.remedy()))
                }
                Some((name, _)) if all.words.contains(&name.as_str()) => {
                    Some(format!("an object where text belongs: write \"{name}\""))
                }
                Some((name, _)) => Some(format!("`{}` is none of the alternatives: {}", quoted(name), all.remedy())),
                None => Some(format!("no alternative is chosen: {}", all.remedy())),
            },
            Value::String(word) if all.words.contains(&word.as_str()) => None,
            Value::String(word) if all.members.contains_key(word.as_str()) => {
                Some(format!("this alternative needs an object: write {{\"{word}\": {{...}}}}"))
            }
            Value::String(word) => Some(format!("`{}` is none of the alternatives: {}", quoted(word), all.remedy())),
            value if all.members.is_empty() => Some(wrong_kind(value, &Type::String, &all.words)),
            value => Some(wrong_kind(value, &Type::Object, &[])),
        };
        if let Some(detail) = wrong {
            faults.add(here, detail);
        }
    }
}

impl<'a> Alternatives<'a> {
    fn of(choice: &'a OneOf) -> Self {
        let mut all = Alternatives::default();
        for item in &choice.items {
            let RefOr::T(Schema::Object(object)) = item else { continue };
            all.words.extend(words_of(object));
            all.members.extend(object.properties.iter().map(|(name, schema)| (name.as_str(), schema)));
        }
        all
    }

    fn remedy(&self) -> String {
        let words = self.words.iter().map(|word| format!("\"{word}\""));
        let members = self.members.keys().map(|name| format!("{{\"{name}\": ...}}"));
        format!("give one of {}", words.chain(members).collect::<Vec<_>>().join(", "))
    }
}

fn words_of(object: &Object) -> Vec<&str> {
    object.enum_values.iter().flatten().filter_map(Value::as_str).collect()
}

fn check_text(object: &Object, text: &str, here: &str, faults: &mut Faults) {
    let words = words_of(object);
    if !words.is_empty() {
        if !words.contains(&text) {
            faults.add(here, format!("`{}` is no word of this field: write {}", quoted(text), one_of(&words)));
        }
        return;
    }
    let most = object.max_length.unwrap_or(usize::MAX);
    if text.chars().count() > most {
        faults.add(here, format!("this text is too long: shorten it to {most} characters"));
    }
    if object.pattern.is_some() && text.chars().any(|c| c.is_ascii_control()) {
        faults.add(here, "this text has a line break or another control character: leave it out");
    }
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

fn in_range(object: &Object, value: f64) -> bool {
    let [least, most] = bounds(object);
    let above = least.is_none_or(|(least, inside)| value > least || (inside && value == least));
    let below = most.is_none_or(|(most, inside)| value < most || (inside && value == most));
    above && below
}

fn out_of_range(object: &Object, value: f64, what: &str) -> String {
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

fn kind_of(kinds: &SchemaType) -> Type {
    match kinds {
        SchemaType::Type(kind) => kind.clone(),
        SchemaType::Array(kinds) => kinds.iter().find(|kind| **kind != Type::Null).cloned().unwrap_or(Type::Null),
        SchemaType::AnyValue => Type::Object,
    }
}

fn nullable(kinds: &SchemaType) -> bool {
    matches!(kinds, SchemaType::Array(kinds) if kinds.contains(&Type::Null))
}

fn default(schema: &RefOr<Schema>) -> Option<&Value> {
    match schema {
        RefOr::T(Schema::Object(object)) => object.default.as_ref(),
        RefOr::T(Schema::Array(list)) => list.default.as_ref(),
        RefOr::Ref(reference) => reference.default.as_ref(),
        _ => None,
    }
}

/// The words for a value of another kind than belongs there.
fn wrong_kind(value: &Value, kind: &Type, words: &[&str]) -> String {
    let (belonging, remedy) = match kind {
        Type::Object => ("an object", "give its fields by name, as in {\"name\": value}".to_owned()),
        Type::Array => ("a list", "write its items in [ ]".to_owned()),
        Type::String if words.is_empty() => ("text", "write it in quotes".to_owned()),
        Type::String => ("text", format!("write {}", one_of(words))),
        Type::Boolean => ("true or false", "write one of them, without quotes".to_owned()),
        Type::Integer => ("a whole number", "write one, without quotes".to_owned()),
        _ => ("a number", "write one, without quotes".to_owned()),
    };
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

fn one_of(words: &[&str]) -> String {
    let words: Vec<_> = words.iter().map(|word| format!("\"{word}\"")).collect();
    words.join(" or ")
}

/// What to do about a field of no such name.
fn stray_name(name: &str, object: &Object) -> String {
    let likeness = |known: &&String| strsim::jaro_winkler(name, known);
    let nearest = object.properties.keys().max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
    match nearest.filter(|known| likeness(known) >= LIKE) {
        Some(known) => format!("there is no field of this name here: write `{known}` if that is meant, or remove it"),
        None => "there is no field of this name here: remove it or correct its spelling".to_owned(),
    }
}

/// The beginning of what a request says.
fn quoted(text: &str) -> String {
    match text.char_indices().nth(LONGEST_QUOTE) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}
