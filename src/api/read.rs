//! JSON to a request, with everything that is wrong in its structure.

use super::fault::{Fault, Faults, child, listed};
use super::request::{AnalysisRequest, JointsRequest, LineRequest, ProfileRequest};
use super::{translate, tree};
use crate::collapse::Analysis;
use serde::Deserialize;
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// Most structural faults looked for in one body; each costs a few readings.
const MAX_STRUCTURAL_FAULTS: usize = 20;

/// Reads a request and fills in its defaults.
///
/// # Errors
/// All structural faults: syntax, types, missing, unknown and repeated fields.
pub fn read(body: &[u8]) -> Result<AnalysisRequest, Vec<Fault>> {
    match read_structure(body) {
        (Some(request), faults) if faults.is_empty() => Ok(request),
        (_, faults) => Err(listed(faults.into_vec())),
    }
}

/// Reads and translates a request: what was asked, with its defaults, and the same in SI for the mechanics.
///
/// # Errors
/// All structural faults; where the structure can be read, all others too.
pub fn read_analysis(body: &[u8]) -> Result<(AnalysisRequest, Analysis), Vec<Fault>> {
    let (request, faults) = read_structure(body);
    let mut faults = faults.into_vec();
    if let Some(request) = request {
        match translate::translate(&request) {
            Ok(analysis) if faults.is_empty() => return Ok((request, analysis)),
            Ok(_) => {}
            Err(more) => faults.extend(more),
        }
    }
    Err(listed(faults))
}

/// The request, unless a stand-in had to be put for one of its values, and what is wrong.
fn read_structure(body: &[u8]) -> (Option<AnalysisRequest>, Faults) {
    let mut faults = Faults::default();
    let (mut tree, repeated) = match tree::parse(body) {
        Ok(parsed) => parsed,
        Err(error) => {
            // serde_json's message ends with line and column.
            faults.add("", format!("the body is not valid JSON: {error}"));
            return (None, faults);
        }
    };
    for pointer in repeated {
        faults.add(pointer, "this name stands more than once in its object: keep one");
    }
    let mut mended: Vec<String> = Vec::new();
    for _ in 0..MAX_STRUCTURAL_FAULTS {
        match attempt(&tree) {
            Ok((request, unknown)) => {
                let stands_in = |pointer: &String| mended.iter().any(|place| lies_under(pointer, place));
                for pointer in unknown.into_iter().filter(|pointer| !stands_in(pointer)) {
                    faults.add(pointer, "there is no field of this name here: remove it or correct its spelling");
                }
                return (mended.is_empty().then(|| with_defaults(request)), faults);
            }
            Err(fault) => {
                let place = mend(&mut tree, &fault.pointer);
                // What was taken away for its own fault is not missing.
                if !mended.contains(&fault.pointer) {
                    faults.add(fault.pointer, fault.detail);
                }
                match place {
                    Some(place) => mended.push(place),
                    None => break,
                }
            }
        }
    }
    (None, faults)
}

/// One reading of the tree: the request and pointers to its unknown fields, or the first fault.
fn attempt(tree: &Value) -> Result<(AnalysisRequest, BTreeSet<String>), Fault> {
    let mut unknown = BTreeSet::new();
    let mut track = serde_path_to_error::Track::new();
    let mut note = |path: serde_ignored::Path<'_>| {
        unknown.insert(ignored_pointer(&path, tree));
    };
    let reader = serde_path_to_error::Deserializer::new(tree, &mut track);
    match AnalysisRequest::deserialize(serde_ignored::Deserializer::new(reader, &mut note)) {
        Ok(request) => Ok((request, unknown)),
        Err(error) => Err(fault_at(&track.path(), &error.to_string(), tree)),
    }
}

fn fault_at(path: &serde_path_to_error::Path, message: &str, tree: &Value) -> Fault {
    use serde_path_to_error::Segment;
    let mut pointer = String::new();
    for segment in path {
        match segment {
            Segment::Seq { index } => pointer = child(&pointer, &index.to_string()),
            Segment::Map { key } => pointer = child(&pointer, key),
            Segment::Enum { variant } => pointer = child(&pointer, variant),
            Segment::Unknown => {}
        }
    }
    let missing = message.strip_prefix("missing field `").and_then(|rest| rest.strip_suffix('`'));
    match missing {
        Some(field) => Fault {
            pointer: child(&pointer, field),
            detail: format!("the required field `{field}` is missing: add it"),
        },
        None => Fault { pointer: existing(pointer, tree), detail: in_plain_words(message) },
    }
}

/// The pointer, shortened until it leads to something: an alternative given by its bare name has no member of it.
fn existing(mut pointer: String, tree: &Value) -> String {
    while tree.pointer(&pointer).is_none()
        && let Some((parent, _)) = pointer.rsplit_once('/')
    {
        pointer.truncate(parent.len());
    }
    pointer
}

fn in_plain_words(message: &str) -> String {
    let words = [
        ("invalid type: unit variant, expected newtype variant", "this alternative needs an object: {\"name\": {...}}"),
        ("invalid type: newtype variant, expected unit variant", "this alternative stands alone, as text"),
        ("expected f64", "expected a number"),
        ("expected usize", "expected a whole number, not negative"),
        ("expected an array of length 2", "expected a pair [x, y]"),
        ("invalid value: map, expected map with a single key", "expected an object with exactly one member"),
        ("expected struct ", "expected an object: "),
        ("expected enum", "expected one of the alternatives, as an object with one member"),
        ("expected a sequence", "expected a list"),
    ];
    words.iter().fold(message.to_owned(), |text, (from, to)| text.replace(from, to))
}

/// Pointer to an unknown field. serde_ignored does not name the alternative chosen in an object with one member.
fn ignored_pointer(path: &serde_ignored::Path<'_>, tree: &Value) -> String {
    use serde_ignored::Path;
    match path {
        Path::Root => String::new(),
        Path::Seq { parent, index } => child(&ignored_pointer(parent, tree), &index.to_string()),
        Path::Map { parent, key } => child(&ignored_pointer(parent, tree), key),
        Path::Some { parent } | Path::NewtypeStruct { parent } => ignored_pointer(parent, tree),
        Path::NewtypeVariant { parent } => {
            let pointer = ignored_pointer(parent, tree);
            match tree.pointer(&pointer).and_then(Value::as_object).and_then(|object| object.keys().next()) {
                Some(variant) => child(&pointer, variant),
                None => pointer,
            }
        }
    }
}

/// Values of which one fits in any place of a request.
fn stand_ins() -> [Value; 7] {
    // Has every required field of every object.
    let any_object = json!({
        "profile": {"circular": {}}, "span_m": 1, "rise_m": 1, "arcs": [], "radius_m": 1, "angle_deg": 1,
        "intrados_m": [], "extrados_m": [], "crown_m": 1, "springing_m": 1, "centre_y_m": 1, "centre_m": [1, 1],
        "height_m": 1, "joint": 1, "load": {"self_weight": {}}, "step": 1, "bands": [], "from_m": 1, "to_m": 1,
        "pressure_pa": 1, "force_n_per_m": 1, "centre_x_m": 1, "width_m": 1,
    });
    let alternatives = [json!({"circular": {}}), json!({"constant_m": 1}), json!({"self_weight": {}})];
    let [profile, thickness, load] = alternatives;
    [json!(1), json!([]), json!([1, 1]), any_object, profile, thickness, load]
}

/// Puts a neutral value in the place of a fault, or of what contains it, so that the reading gets past it; says
/// where it had to be put.
fn mend(tree: &mut Value, pointer: &str) -> Option<String> {
    let (parent, key) = pointer.rsplit_once('/')?;
    let name = key.replace("~1", "/").replace("~0", "~");
    if let Some(Value::Object(object)) = tree.pointer_mut(parent) {
        // Whatever has a default can be left out, unless that leaves a choice without its alternative.
        object.remove(&name);
        let emptied = attempt(tree).is_err_and(|fault| lies_under(pointer, &fault.pointer));
        if !emptied && gets_past(tree, pointer) {
            return Some(pointer.to_owned());
        }
    }
    let mut values = stand_ins().into_iter();
    match values.any(|value| put(tree, parent, &name, value) && gets_past(tree, pointer)) {
        true => Some(pointer.to_owned()),
        false => mend(tree, parent),
    }
}

/// True for the same place and for what it contains.
fn lies_under(pointer: &str, place: &str) -> bool {
    pointer.strip_prefix(place).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
}

fn put(tree: &mut Value, parent: &str, name: &str, value: Value) -> bool {
    match tree.pointer_mut(parent) {
        Some(Value::Object(object)) => {
            object.insert(name.to_owned(), value);
            true
        }
        Some(Value::Array(list)) => match name.parse::<usize>().ok().and_then(|index| list.get_mut(index)) {
            Some(item) => {
                *item = value;
                true
            }
            None => false,
        },
        _ => false,
    }
}

fn gets_past(tree: &Value, pointer: &str) -> bool {
    match attempt(tree) {
        Ok(_) => true,
        Err(fault) => !lies_under(&fault.pointer, pointer),
    }
}

fn with_defaults(mut request: AnalysisRequest) -> AnalysisRequest {
    let arch = &mut request.arch;
    if !matches!(arch.profile, ProfileRequest::Surveyed(_)) {
        arch.line.get_or_insert(LineRequest::default());
        arch.joints.get_or_insert(JointsRequest::default());
    }
    request
}
