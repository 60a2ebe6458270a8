//! The written contract and the reader are the same thing: what the schema of a body refuses the reader refuses, and the
//! other way round. The oracle is `openapi/voussoir.json` on disk; nothing of the code is asked for a bound.

use crate::common::door::faults;
use crate::common::folders;
use crate::common::places::places;
use bodies::{bodies, with, without};
use schema::{Leaf, document, is, leaves, validator};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use voussoir::wire::fault::Fault;
use voussoir::wire::read::read;

pub mod bodies;
mod schema;

/// True for a fault of a value alone, which the schema has to know.
fn of_range(fault: &Fault) -> bool {
    let words = ["out of range", "too long", "nothing to carry"];
    // What a load becomes along a curve is not the value that was given.
    words.iter().any(|word| fault.detail.contains(word)) && !fault.detail.starts_with("at abscissa")
}

#[test]
fn the_bodies_are_good() {
    let validator = validator();
    for body in bodies() {
        assert_eq!(faults(&body), [], "{body}");
        assert!(validator.is_valid(&body), "{body}");
    }
}

/// The requests of all cases.
fn cases() -> Vec<Value> {
    let read = |folder: std::path::PathBuf| std::fs::read(folder.join("request.json")).unwrap();
    folders::folders(&folders::cases())
        .into_iter()
        .map(|folder| serde_json::from_slice(&read(folder)).unwrap())
        .collect()
}

#[test]
fn the_cases_and_examples_are_good() {
    let validator = validator();
    for request in cases() {
        let errors: Vec<_> = validator.iter_errors(&request).map(|error| error.to_string()).collect();
        assert!(errors.is_empty(), "{request}: {errors:?}");
    }
    let document = document();
    let body = &document["paths"]["/v1/jobs"]["post"]["requestBody"]["content"]["application/json"];
    let examples = body["examples"].as_object().unwrap();
    assert!(examples.len() >= 5);
    for (name, example) in examples {
        assert!(validator.is_valid(&example["value"]) && faults(&example["value"]).is_empty(), "{name}");
        assert!(!example["summary"].as_str().unwrap().is_empty(), "{name}");
    }
}

#[test]
fn a_request_is_written_without_what_it_leaves_out() {
    for body in bodies().into_iter().chain(cases()) {
        let request = read(body.to_string().as_bytes()).unwrap();
        let written = serde_json::to_string(&request).unwrap();
        assert!(!written.contains(":null"), "{written}");
        assert_eq!(read(written.as_bytes()).unwrap(), request);
    }
}

/// Where `path`, with its `*`, first leads to something in `request`.
fn resolve(request: &Value, path: &str, here: &str) -> Option<String> {
    let Some(rest) = path.strip_prefix('/') else { return Some(here.to_owned()) };
    let (step, rest) = rest.find('/').map_or((rest, ""), |at| rest.split_at(at));
    let value = request.pointer(here)?;
    let steps = match value {
        Value::Array(list) if step == "*" => (0..list.len()).map(|i| i.to_string()).collect(),
        _ => vec![step.to_owned()],
    };
    let children = steps.iter().map(|step| format!("{here}/{step}")).filter(|child| request.pointer(child).is_some());
    children.into_iter().find_map(|child| resolve(request, rest, &child))
}

/// A body of the leaf's kind that has a value there, of the leaf's own type where alternatives differ, and where.
fn place(leaf: &Leaf, bodies: &[Value]) -> Option<(Value, String)> {
    let of_kind = |body: &&Value| body.get("curved_beam").is_some() == (leaf.body == "BeamRequest");
    bodies.iter().filter(of_kind).find_map(|body| Some((body.clone(), resolve(body, &leaf.path, "")?)))
}

/// Values that the schema just allows, and values just beyond.
fn edges(leaf: &Leaf, value: &Value) -> (Vec<Value>, Vec<Value>) {
    let schema = &leaf.schema;
    let (mut good, mut bad) = (Vec::new(), Vec::new());
    let number = |word: &str| schema.get(word).and_then(Value::as_f64);
    if is(schema, "integer") {
        let [least, most] = ["minimum", "maximum"].map(|word| schema[word].as_i64().unwrap());
        good.extend([json!(least), json!(most), json!(most as f64)]);
        bad.extend([json!(least - 1), json!(most + 1), json!(least as f64 + 0.5), json!("1")]);
    } else if is(schema, "number") {
        for (word, outwards) in [("minimum", -1.0), ("maximum", 1.0)] {
            let inclusive = number(word);
            let exclusive = number(&format!("exclusive{}{}", word[..1].to_uppercase(), &word[1..]));
            assert!(inclusive.is_some() != exclusive.is_some(), "{}: one {word} of some kind", leaf.path);
            let edge = inclusive.or(exclusive).unwrap();
            let next = |up: bool| if up { edge.next_up() } else { edge.next_down() };
            let (inside, outside) =
                if inclusive.is_some() { (edge, next(outwards > 0.0)) } else { (next(outwards < 0.0), edge) };
            good.push(json!(inside));
            bad.extend([json!(outside), json!(outwards * 1e300)]);
        }
        bad.push(json!("1"));
    } else if is(schema, "array") {
        let [least, most] = [("minItems", 0), ("maxItems", u64::MAX)].map(|(w, d)| schema[w].as_u64().unwrap_or(d));
        assert!(most < u64::MAX, "{}: a list of any length", leaf.path);
        let list = |count: u64| Value::from(vec![value[0].clone(); usize::try_from(count).unwrap()]);
        good.extend([list(least), list(most)]);
        bad.extend([list(most + 1), json!({}), json!(1)]);
        bad.extend(least.checked_sub(1).map(list));
    } else if let Some(words) = schema["enum"].as_array() {
        good.extend(words.iter().cloned());
        bad.extend([json!("unheard_of"), json!(1), json!(true)]);
    } else if is(schema, "string") {
        let most = usize::try_from(schema["maxLength"].as_u64().unwrap()).unwrap();
        good.extend([json!("é".repeat(most)), json!("")]);
        bad.extend([json!("é".repeat(most + 1)), json!(1)]);
    } else if is(schema, "boolean") {
        good.extend([json!(true), json!(false)]);
        bad.extend([json!("true"), json!(1)]);
    } else if is(schema, "object") {
        good.push(json!({}));
        bad.extend([json!([]), json!(1)]);
    }
    (if is(schema, "null") { &mut good } else { &mut bad }).push(Value::Null);
    (good, bad)
}

#[test]
fn every_leaf_is_held_to_its_bounds() {
    // A new field is held to its bounds as soon as a case has it.
    let (bodies, leaves) = ([bodies(), cases()].concat(), leaves());
    let (mut checked, mut paths) = (0, BTreeSet::new());
    for leaf in &leaves {
        // The beam refuses these, whatever they hold.
        if leaf.body == "BeamRequest" && leaf.path.starts_with("/mesh/subblocks/per_voussoir") {
            continue;
        }
        let (body, pointer) =
            place(leaf, &bodies).unwrap_or_else(|| panic!("{} {}: no body has it", leaf.body, leaf.path));
        paths.insert((&leaf.body, &leaf.path));
        let (good, bad) = edges(leaf, body.pointer(&pointer).unwrap());
        for value in &good {
            let request = with(body.clone(), &pointer, value.clone());
            let found: Vec<_> = faults(&request).into_iter().filter(|fault| fault.pointer == pointer).collect();
            assert!(!found.iter().any(of_range), "{pointer} {value}: {found:?}");
            assert!(read(request.to_string().as_bytes()).is_ok(), "{pointer} {value}: {found:?}");
        }
        for value in &bad {
            let found = faults(&with(body.clone(), &pointer, value.clone()));
            // Other alternatives may take what this one does not.
            let other = validator_allows(&body, &pointer, value);
            let told = found.iter().any(|fault| fault.pointer == pointer);
            assert!(other || told, "{pointer} {value}: {found:?}");
            assert!(found.iter().all(|fault| fault.detail.len() < 300), "{found:?}");
        }
        checked += good.len() + bad.len();
    }
    println!("{} leaves, {} places, {checked} values at their bounds or beyond", leaves.len(), paths.len());
    assert!(paths.len() >= 100);
}

fn validator_allows(body: &Value, pointer: &str, value: &Value) -> bool {
    thread_local!(static VALIDATOR: jsonschema::Validator = validator());
    VALIDATOR.with(|validator| validator.is_valid(&with(body.clone(), pointer, value.clone())))
}

#[test]
fn units_of_numbers_are_said() {
    let units =
        [("_kg_m3", "kg/m3"), ("_n_per_m", "N"), ("_pa", "Pa"), ("_deg", "degrees"), ("_g", " g"), ("_m", " m")];
    for leaf in leaves().iter().filter(|leaf| is(&leaf.schema, "number") && !leaf.path.ends_with('*')) {
        let description = leaf.schema["description"].as_str().unwrap_or_default();
        assert!(!description.is_empty(), "{}", leaf.path);
        if let Some((_, unit)) = units.iter().find(|(ending, _)| leaf.path.ends_with(ending)) {
            assert!(description.contains(unit), "{}: {description}", leaf.path);
        }
    }
}

/// The body with one place of it spoilt, in every way that fits.
fn mutations(body: &Value, place: &str) -> Vec<Value> {
    let value = body.pointer(place).unwrap();
    let put = |value: Value| with(body.clone(), place, value);
    let other_kinds =
        [json!(null), json!(true), json!(2), json!(2.5), json!("text"), json!([]), json!([1, 2]), json!({})];
    let mut all: Vec<Value> = other_kinds.into_iter().map(put).collect();
    all.push(put(json!([value])));
    all.push(put(json!({"unheard_of": value})));
    all.extend((!place.is_empty()).then(|| without(body.clone(), place)));
    match value {
        Value::Object(object) => {
            all.push(with(body.clone(), &format!("{place}/unheard_of"), json!(1)));
            // serde would read these as the fields in their order.
            all.push(put(object.values().cloned().collect()));
            for (name, member) in object {
                let misspelt = without(body.clone(), &format!("{place}/{name}"));
                all.push(with(misspelt, &format!("{place}/{name}s"), member.clone()));
            }
        }
        Value::String(word) => {
            all.extend([put(json!({ word: null })), put(json!({ word: {} })), put(json!(word.to_uppercase()))])
        }
        Value::Number(number) => all.extend([-1.0, 1e3, 1e-3].map(|by| put(json!(by * number.as_f64().unwrap())))),
        _ => {}
    }
    all
}

#[test]
fn schema_and_reader_refuse_the_same() {
    let validator = validator();
    let (mut count, mut refused, mut spoilt) = (0, 0, BTreeSet::new());
    for body in bodies() {
        let mut all = Vec::new();
        places(&body, "", &mut all);
        // What another body has just so was spoilt there.
        all.retain(|place| spoilt.insert(format!("{place} {}", body.pointer(place).unwrap())));
        for place in all {
            for request in mutations(&body, &place) {
                let text = request.to_string();
                let found = faults(&request);
                let by_reader = read(text.as_bytes()).is_err() || found.iter().any(of_range);
                let by_schema = !validator.is_valid(&request);
                assert_eq!(by_reader, by_schema, "{place}: {found:?}\n{text}");
                assert!(found.iter().all(|fault| fault.detail.len() < 300), "{found:?}");
                count += 1;
                refused += usize::from(by_schema);
            }
        }
    }
    println!("{count} spoilt bodies, {refused} refused by the schema, as many and the same by the reader");
}
