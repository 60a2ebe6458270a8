//! The table of a request's fields, held against a body.
//!
//! A row of the table is a field of a struct in `request`: its name and kind, its range, unit and default, and its words. utoipa
//! makes a schema of the rows. The OpenAPI document shows that schema, and this reader checks bodies against it.

use super::words::{among, belonging, by_name, in_range, one_of, out_of_range, quoted, words_of, wrong_kind};
use crate::wire::fault::{Faults, child};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use utoipa::ToSchema;
use utoipa::openapi::schema::{Array, ArrayItems, Object, OneOf, SchemaType, Type};
use utoipa::openapi::{RefOr, Schema};

/// Least likeness of a misspelt name to the one that is suggested.
const LIKE: f64 = 0.85;

/// All schemas of a body, by name.
pub struct Table {
    body: RefOr<Schema>,
    schemas: BTreeMap<String, RefOr<Schema>>,
    /// What to do about a field that does not belong.
    stray: fn(&str) -> Option<&'static str>,
}

/// Units that names of fields end with.
const UNITS: [&str; 7] = ["m", "m3", "deg", "n", "pa", "g", "kn"];

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
            (Type::Object, value) => faults.add(here, wrong_kind(value, ("an object", by_name(object)))),
            (kind, value) => faults.add(here, wrong_kind(value, belonging(&kind, &words_of(object)))),
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
                    let words = (self.stray)(&place).map_or_else(|| self.stray_name(name, object), str::to_owned);
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
            return faults.add(here, wrong_kind(value, belonging(&Type::Array, &[])));
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
            value if all.members.is_empty() => Some(wrong_kind(value, belonging(&Type::String, &all.words))),
            value => Some(wrong_kind(value, ("an object", all.remedy()))),
        };
        if let Some(detail) = wrong {
            faults.add(here, detail);
        }
    }

    /// What to do about a field of no such name.
    fn stray_name(&self, name: &str, object: &Object) -> String {
        let none = "there is no field of this name here";
        let likeness = |known: &&String| strsim::jaro_winkler(name, known);
        let nearest = object.properties.keys().max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
        if let Some(known) = nearest.filter(|known| likeness(known) >= LIKE) {
            let unit = if is_in_another_unit(name, known) {
                ", with its value in the unit that its name ends with"
            } else {
                ""
            };
            return format!("{none}: write `{known}`{unit} if that is meant, or remove it");
        }
        let within = object.properties.iter().filter(|(_, schema)| self.has_member(schema, name));
        let within: Vec<_> = within.map(|(known, _)| format!("`{known}`")).collect();
        match within.is_empty() {
            true => format!("{none}: remove it or correct its spelling{}", among(object)),
            false => format!("{none}: put it inside {}, or remove it", within.join(" or ")),
        }
    }

    /// Whether an object that fits has, or may have, a member of this name.
    fn has_member(&self, schema: &RefOr<Schema>, name: &str) -> bool {
        match self.resolved(schema) {
            Some(Schema::Object(object)) => object.properties.contains_key(name),
            Some(Schema::OneOf(choice)) => choice.items.iter().any(|item| self.has_member(item, name)),
            _ => false,
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

/// Whether a name differs from one that ends with a unit in nothing but that.
fn is_in_another_unit(name: &str, known: &str) -> bool {
    let parts = name.rsplit_once('_').zip(known.rsplit_once('_'));
    parts.is_some_and(|((stem, _), (known, unit))| stem == known && UNITS.contains(&unit))
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
