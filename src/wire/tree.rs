//! JSON text to a tree, noticing names that stand twice in one object.

use super::fault::child;
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value};
use std::cell::RefCell;

/// Longest list: more than any list of a request may hold.
const LONGEST_LIST: usize = 10_000;
/// Longest member name, bytes.
const LONGEST_NAME: usize = 200;
/// Below, every whole number is one that a float holds exactly.
const MOST_EXACT: f64 = 9e15;
/// Most names that stand twice and are told of.
const MOST_REPEATED: usize = 100;

/// Reads JSON text; beside the tree, pointers to the names that stand twice (the later value is kept), the first
/// hundred of them.
///
/// # Errors
/// When the text is not one JSON value, or has longer lists or names than any request.
pub fn parse(text: &[u8]) -> Result<(Value, Vec<String>), serde_json::Error> {
    let repeated = RefCell::new(Vec::new());
    let mut reader = serde_json::Deserializer::from_slice(text);
    let value = JsonNode { place: Place::Root, repeated: &repeated }.deserialize(&mut reader)?;
    reader.end()?;
    Ok((value, repeated.into_inner()))
}

/// Where a value stands. Written out only where something is to be said of it: most requests have nothing to say.
#[derive(Clone, Copy)]
enum Place<'a> {
    Root,
    Item(&'a Place<'a>, usize),
    Member(&'a Place<'a>, &'a str),
}

impl Place<'_> {
    fn pointer(self) -> String {
        match self {
            Place::Root => String::new(),
            Place::Item(list, index) => child(&list.pointer(), &index.to_string()),
            Place::Member(object, name) => child(&object.pointer(), name),
        }
    }
}

struct JsonNode<'a> {
    place: Place<'a>,
    repeated: &'a RefCell<Vec<String>>,
}

impl<'de> DeserializeSeed<'de> for JsonNode<'_> {
    type Value = Value;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Value, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for JsonNode<'_> {
    type Value = Value;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_u64<E>(self, value: u64) -> Result<Value, E> {
        Ok(value.into())
    }

    /// In JSON 12.0 is as whole a number as 12.
    fn visit_f64<E>(self, value: f64) -> Result<Value, E> {
        let whole = value.fract() == 0.0 && (0.0..MOST_EXACT).contains(&value);
        Ok(if whole { Value::from(value as u64) } else { value.into() })
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Value, A::Error> {
        let mut list = Vec::new();
        let repeated = self.repeated;
        while let Some(item) =
            items.next_element_seed(JsonNode { place: Place::Item(&self.place, list.len()), repeated })?
        {
            list.push(item);
            if list.len() > LONGEST_LIST {
                return Err(A::Error::custom(format!(
                    "a list of more than {LONGEST_LIST} items, longer than any here"
                )));
            }
        }
        Ok(Value::Array(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut members: A) -> Result<Value, A::Error> {
        let mut object = Map::new();
        while let Some(name) = members.next_key::<String>()? {
            if name.len() > LONGEST_NAME {
                return Err(A::Error::custom(format!(
                    "a name of more than {LONGEST_NAME} bytes, longer than any here"
                )));
            }
            let place = Place::Member(&self.place, &name);
            let value = members.next_value_seed(JsonNode { place, repeated: self.repeated })?;
            if object.contains_key(&name) && self.repeated.borrow().len() < MOST_REPEATED {
                self.repeated.borrow_mut().push(place.pointer());
            }
            object.insert(name, value);
        }
        Ok(Value::Object(object))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tree_is_that_of_serde_json() {
        let text = br#"{"a": [1, -2, 2.5, -3.0, "x", null, true, {"b/c": []}], "d": 1e300}"#;
        let (tree, repeated) = parse(text).unwrap();
        assert_eq!(tree, serde_json::from_slice::<Value>(text).unwrap());
        assert!(repeated.is_empty());
    }

    #[test]
    fn whole_numbers_are_whole_however_they_are_written() {
        assert_eq!(parse(b"[12.0, 1.2e1, 0.0, -0.0]").unwrap().0, serde_json::json!([12, 12, 0, 0]));
    }

    #[test]
    fn repeated_names_are_found_at_any_depth() {
        let (_, repeated) = parse(br#"{"a": [{"x": 1, "x": 2}], "a/": {"y": 1}, "a/": 3}"#).unwrap();
        assert_eq!(repeated, ["/a/0/x", "/a~1"]);
    }

    #[test]
    fn what_is_longer_than_any_request_is_refused_early() {
        let list = format!("{{\"loads\": [{}1]}}", "1,".repeat(LONGEST_LIST));
        assert!(parse(list.as_bytes()).is_err());
        let name = format!("{{\"{}\": 1}}", "a".repeat(LONGEST_NAME + 1));
        assert!(parse(name.as_bytes()).is_err());
        let twice = format!("{{{}\"a\": 1}}", "\"a\": 1,".repeat(5000));
        assert_eq!(parse(twice.as_bytes()).unwrap().1.len(), MOST_REPEATED);
    }

    #[test]
    fn more_than_one_value_is_refused() {
        assert!(parse(b"{} {}").is_err());
    }
}
