//! The tables of fields in docs/reference.md, made from the OpenAPI document.

use serde_json::Value;
use std::collections::BTreeMap;

/// Units as the ends of names tell them, the longer ends first.
const UNITS: [(&str, &str); 14] = [
    ("_kn_per_m", "kN/m"),
    ("_kg_m3", "kg/m3"),
    ("_n_per_m", "N/m"),
    ("_j_per_m", "J/m"),
    ("_per_m", "1/m"),
    ("_m2", "m2"),
    ("_s2", "s2"),
    ("_deg", "degrees"),
    ("_rad", "rad"),
    ("_pa", "Pa"),
    ("_m", "m"),
    ("_kn", "kN"),
    ("_n", "N"),
    ("_g", "g"),
];

/// Sections of docs/reference.md that tell what the words of an answer mean, by the schema that lists the words.
pub const WORDS: [(&str, &str); 12] = [
    ("Outcome", "Outcomes"),
    ("Mode", "Modes"),
    ("SafetyZone", "Zones"),
    ("Governs", "What governs"),
    ("GovernedBy", "What governs"),
    ("ReachBody", "States of a safety factor"),
    ("LimitBody", "States of limit analysis"),
    ("UpdatedEnd", "Ends on moving geometry"),
    ("SettlementEnd", "Ends of a movement"),
    ("MotionEnd", "Ends of a motion"),
    ("LawWord", "Laws of a joint"),
    ("StatusWord", "Status of a job"),
];

/// Which fields are told, and how.
pub struct Tables<'a> {
    schemas: &'a Value,
    /// Schemas that are told already, and the pointer to the first field that has one.
    told: BTreeMap<&'a str, String>,
    /// Whether the fields are those of a request, which have defaults.
    request: bool,
}

/// A property, with what its references lead to.
struct Field<'a> {
    schema: &'a Value,
    /// The name of the schema, where it has one.
    name: Option<&'a str>,
    nullable: bool,
    words: String,
}

impl<'a> Tables<'a> {
    /// Of a request.
    pub fn request(document: &'a Value) -> Self {
        Tables { schemas: &document["components"]["schemas"], told: BTreeMap::new(), request: true }
    }

    /// Of an answer, without the request in it.
    pub fn answer(document: &'a Value) -> Self {
        Tables { request: false, ..Tables::request(document) }
    }

    /// A table of the fields of `schema` that hold no others, then a section for each of those that do.
    pub fn sections(&mut self, kind: &str, schema: &str) -> String {
        let (mut first, mut rest) = (Vec::new(), String::new());
        for (name, property, required) in self.fields(&self.schemas[schema]) {
            let mut rows = Vec::new();
            self.rows(&format!("/{name}"), name, property, Some(required), &mut rows);
            let row = rows.remove(0);
            if rows.is_empty() {
                first.push(row);
            } else {
                let link = format!("[`/{name}`](#{}-{name})", kind.to_lowercase());
                first.push(row.replacen(&format!("`/{name}`"), &link, 1));
                rest += &format!("\n### {kind}: {name}\n\n{}", self.table(&rows));
            }
        }
        self.table(&first) + &rest
    }

    /// A table of all fields of `schema`.
    pub fn one(&mut self, schema: &str) -> String {
        let mut rows = Vec::new();
        self.inside("", &self.schemas[schema], &mut rows);
        self.table(&rows)
    }

    fn table(&self, rows: &[String]) -> String {
        let head = if self.request {
            "| field | value | default | meaning |\n|---|---|---|---|\n"
        } else {
            "| field | value | meaning |\n|---|---|---|\n"
        };
        head.to_owned() + &rows.concat()
    }

    /// The row of one field and those of what it holds. `required` is none of a choice.
    fn rows(&mut self, at: &str, name: &str, property: &'a Value, required: Option<bool>, rows: &mut Vec<String>) {
        let field = self.field(property);
        let value = self.value(name, &field);
        let default = default(property, required);
        let row = |words: &str| match (self.request, required) {
            (true, _) => format!("| `{at}` | {value} | {default} | {words} |\n"),
            (_, Some(false)) if !field.nullable => format!("| `{at}` | {value}, or left out | {words} |\n"),
            _ if field.nullable => format!("| `{at}` | {value}, or null | {words} |\n"),
            _ => format!("| `{at}` | {value} | {words} |\n"),
        };
        let list = field.schema.get("items");
        let (held, inside) = match list {
            Some(items) => (self.field(items), format!("{at}/*")),
            None => (self.field(property), at.to_owned()),
        };
        if held.schema.get("enum").is_some() || held.schema.get("items").is_some() {
            return rows.push(row(&field.words));
        }
        let first = held.name.and_then(|name| self.told.get(name).cloned());
        let elsewhere = !self.request && held.name.is_some_and(|name| name.ends_with("Request"));
        rows.push(row(&match (&first, list) {
            (Some(first), _) => format!("{} Fields as of `{first}`.", own_words(property)),
            _ if elsewhere => own_words(property),
            (_, Some(_)) if held.schema.get("oneOf").is_none() => each(&field.words, &held.words),
            _ => field.words,
        }));
        if first.is_none() && !elsewhere {
            let holds = ["properties", "oneOf", "allOf"].iter().any(|word| held.schema.get(word).is_some());
            self.told.extend(held.name.filter(|_| holds).map(|name| (name, inside.clone())));
            self.inside(&inside, held.schema, rows);
        }
    }

    /// Rows of the fields, or the choices, of a schema.
    fn inside(&mut self, at: &str, schema: &'a Value, rows: &mut Vec<String>) {
        for choice in schema["oneOf"].as_array().into_iter().flatten() {
            for (name, property, _) in self.fields(choice) {
                if name != "state" {
                    self.rows(&format!("{at}/{name}"), name, property, None, rows);
                }
            }
        }
        for (name, property, required) in self.fields(schema) {
            self.rows(&format!("{at}/{name}"), name, property, Some(required), rows);
        }
    }

    /// Name, schema and whether it is required of every property, those that are required first.
    fn fields(&self, schema: &'a Value) -> Vec<(&'a str, &'a Value, bool)> {
        let parts: Vec<&Value> = schema["allOf"].as_array().map_or(vec![schema], |parts| parts.iter().collect());
        let mut all = Vec::new();
        for part in parts.into_iter().map(|part| self.field(part).schema) {
            for (name, property) in part["properties"].as_object().into_iter().flatten() {
                let required = part["required"].as_array().is_some_and(|names| names.iter().any(|one| one == name));
                all.push((name.as_str(), property, required));
            }
        }
        // An answer has all its fields; of a request the required ones come first.
        all.sort_by_key(|(name, _, required)| (self.request && !required, *name));
        all
    }

    /// Follows references, and leaves null aside.
    fn field(&self, property: &'a Value) -> Field<'a> {
        let mut field = Field { schema: property, name: None, nullable: false, words: String::new() };
        loop {
            let words = field.schema["description"].as_str().unwrap_or_default();
            // What a choice or a word means is told with the choices, or in a section of its own.
            if field.words.is_empty() || (field.schema.get("oneOf").is_none() && field.schema.get("enum").is_none()) {
                field.words = both(&field.words, words);
            }
            let rest = field.schema["oneOf"].as_array().map(|all| all.iter().filter(|one| one["type"] != "null"));
            if let Some([one]) = rest.map(Iterator::collect::<Vec<_>>).as_deref() {
                (field.schema, field.nullable) = (one, true);
            } else if let Some(reference) = field.schema["$ref"].as_str() {
                let name = reference.rsplit('/').next().unwrap();
                (field.schema, field.name) = (&self.schemas[name], Some(name));
            } else {
                break;
            }
        }
        let types = field.schema["type"].as_array();
        field.nullable |= types.is_some_and(|types| types.iter().any(|one| one == "null"));
        field
    }

    /// Type, unit and range.
    fn value(&self, name: &str, field: &Field<'a>) -> String {
        let schema = field.schema;
        if let Some((schema, title)) = WORDS.iter().find(|(schema, _)| field.name == Some(schema)) {
            let what = if *schema == "ReachBody" { "object with `state`," } else { "a word" };
            return format!("{what} of [{title}](#{})", super::slug(title));
        }
        if let Some(words) = schema["enum"].as_array() {
            return words.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(" or ");
        }
        if let Some(choices) = schema["oneOf"].as_array() {
            return choices.iter().map(choice).collect::<Vec<_>>().join(", or ");
        }
        let types = schema["type"].as_array().and_then(|types| types.iter().find(|one| *one != "null"));
        match types.or(schema.get("type")).and_then(Value::as_str) {
            Some("number") => unit(name).unwrap_or("number").to_owned() + &range(schema),
            Some("integer") if self.request => "whole number".to_owned() + &range(schema),
            Some("integer") => "whole number".to_owned(),
            Some("boolean") => "true or false".to_owned(),
            Some("string") => match schema["maxLength"].as_u64() {
                Some(most) => format!("text, up to {most} characters"),
                None => "text".to_owned(),
            },
            Some("array") => self.list(name, field),
            _ => "object".to_owned(),
        }
    }

    fn list(&self, name: &str, field: &Field<'a>) -> String {
        let schema = field.schema;
        let items = self.field(&schema["items"]);
        let of = self.value(name, &items) + if items.nullable { " or null" } else { "" };
        let count = match (schema["minItems"].as_u64(), schema["maxItems"].as_u64()) {
            (Some(2), Some(2)) if items.schema["type"] == "number" => return format!("[x, y], {of}"),
            _ if items.schema["type"] == "number" && field.words.contains("[x, y]") => return format!("[x, y], {of}"),
            (Some(2), Some(2)) => return format!("two: {of}"),
            (Some(least), Some(most)) if least > 0 => format!("list of {least} to {most}"),
            (_, Some(most)) => format!("list of up to {most}"),
            _ => "list".to_owned(),
        };
        if of == "object" { count } else { format!("{count}: {of}") }
    }
}

/// One of several: a word with its meaning, or an object by the name of its field.
fn choice(schema: &Value) -> String {
    let words = clean(schema["description"].as_str().unwrap_or_default());
    let meaning = words.trim_end_matches('.');
    match (schema["enum"].get(0), schema["required"].get(0)) {
        (Some(word), _) => format!("`{word}` ({meaning})"),
        (_, Some(name)) => format!("`{{{name}: ...}}`"),
        _ => "object".to_owned(),
    }
}

fn default(property: &Value, required: Option<bool>) -> String {
    match (required, property.get("default")) {
        (Some(true), _) => "required".to_owned(),
        (_, None | Some(Value::Null)) => String::new(),
        (_, Some(Value::Number(value))) => format!("`{}`", number(value.as_f64().unwrap())),
        // What it holds has defaults of its own.
        (_, Some(Value::Object(held))) if held.values().all(|value| !value.is_object()) => String::new(),
        (_, Some(value)) => format!("`{value}`"),
    }
}

fn unit(name: &str) -> Option<&'static str> {
    let alone = |end: &str| name == &end[1..];
    UNITS.iter().find(|(end, _)| name.ends_with(end) || alone(end)).map(|(_, unit)| *unit)
}

fn range(schema: &Value) -> String {
    let number = |key: &str| schema[key].as_f64().map(number);
    let least = number("minimum").map(|least| format!(">= {least}"));
    let least = least.or(number("exclusiveMinimum").map(|least| format!("> {least}")));
    let most = number("maximum").map(|most| format!("<= {most}"));
    let most = most.or(number("exclusiveMaximum").map(|most| format!("< {most}")));
    [least, most].into_iter().flatten().map(|bound| format!(", {bound}")).collect()
}

/// A bound as people write it.
fn number(value: f64) -> String {
    let plain = value.to_string();
    let short = format!("{value:e}");
    if value.abs() >= 1e5 && short.len() < plain.len() { short } else { plain }
}

/// What the field itself is said to be, whatever its schema says.
fn own_words(property: &Value) -> String {
    let inner = property["oneOf"].get(0).and_then(|one| one["description"].as_str());
    clean(property["description"].as_str().or(inner).unwrap_or_default())
}

/// Two descriptions, of which one may repeat the other.
fn both(first: &str, second: &str) -> String {
    let (first, second) = (clean(first), clean(second));
    let stem = |words: &str| words.trim_end_matches('.').to_lowercase();
    if first.is_empty() || stem(&second).starts_with(&stem(&first)) {
        second
    } else if stem(&first).contains(&stem(&second)) {
        first
    } else {
        format!("{first} {second}")
    }
}

/// A description of a list, then that of what it lists.
fn each(list: &str, item: &str) -> String {
    let mut letters = item.chars();
    match letters.next() {
        Some(letter) if !list.is_empty() => format!("{list} Each: {}{}", letter.to_lowercase(), letters.as_str()),
        _ => list.to_owned() + item,
    }
}

fn clean(words: &str) -> String {
    words.split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "\\|")
}
