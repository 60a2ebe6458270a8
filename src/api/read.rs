//! JSON to a request, with everything that is wrong in its structure.

mod defaults;

use super::fault::{Fault, Faults, child, lies_under, listed};
use super::plain_words::in_plain_words;
use super::request::{AnalysisRequest, BeamRequest, Request};
use super::{shape, translate, tree};
use crate::collapse::{Analysis, Question};
use defaults::with_defaults;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// Most structural faults looked for in one body; each costs a few readings.
const MAX_STRUCTURAL_FAULTS: usize = 20;

/// Reads a request and fills in its defaults.
///
/// # Errors
/// All structural faults: syntax, types, missing, unknown and repeated fields.
pub fn read(body: &[u8]) -> Result<Request, Vec<Fault>> {
    match read_structure(body) {
        (Some(request), faults) if faults.is_empty() => Ok(request),
        (_, faults) => Err(listed(faults.into_vec())),
    }
}

/// Reads and translates a request: what was asked, with its defaults, and the same in SI for the mechanics.
///
/// # Errors
/// All structural faults; where the structure can be read, all others too.
pub fn read_question(body: &[u8]) -> Result<(Request, Question), Vec<Fault>> {
    let (request, mut faults) = read_structure(body);
    if request.is_none() && lacks_structure(body) {
        faults.add("/arch", translate::NO_STRUCTURE);
    }
    let mut faults = faults.into_vec();
    if let Some(request) = request {
        match translate::translate(&request) {
            Ok(question) if faults.is_empty() => return Ok((request, question)),
            Ok(_) => {}
            Err(more) => {
                let fresh: Vec<_> = more.into_iter().filter(|fault| !follows(fault, &faults)).collect();
                faults.extend(fresh);
            }
        }
    }
    Err(listed(faults))
}

/// True for an object that is about nothing: what else is wrong with it may keep its translation from saying so.
fn lacks_structure(body: &[u8]) -> bool {
    let lacks = |tree: Value| {
        let words = ["arch", "bridge", "blocks", "curved_beam"];
        tree.is_object() && words.iter().all(|word| tree.get(word).is_none_or(Value::is_null))
    };
    tree::parse(body).is_ok_and(|(tree, _)| lacks(tree))
}

/// True for a fault that may come of a structural one: of what was not read as it was meant, or of an object that
/// lacks something where a misspelt name stands in it.
fn follows(fault: &Fault, structural: &[Fault]) -> bool {
    let around = |place: &str| !fault.pointer.is_empty() && lies_under(place, &fault.pointer);
    structural.iter().any(|first| lies_under(&fault.pointer, &first.pointer) || around(&first.pointer))
}

/// Reads a request for one analysis of a structure, for those who want nothing else.
///
/// # Errors
/// As [`read_question`]; one fault where a curve or a curved beam is asked for.
pub fn read_analysis(body: &[u8]) -> Result<(AnalysisRequest, Analysis), Vec<Fault>> {
    match read_question(body)? {
        (Request::Structure(request), Question::One(analysis)) => Ok((*request, *analysis)),
        _ => {
            let detail =
                "this asks for more or other than one analysis of a structure: leave out curve and curved_beam";
            Err(vec![Fault { pointer: String::new(), detail: detail.to_owned() }])
        }
    }
}

/// The request, unless a stand-in had to be put for one of its values, and what is wrong.
fn read_structure(body: &[u8]) -> (Option<Request>, Faults) {
    let mut faults = Faults::default();
    let (tree, repeated) = match tree::parse(body) {
        Ok(parsed) => parsed,
        Err(error) => {
            // serde_json's message ends with line and column.
            faults.add("", format!("the body cannot be read as JSON: {error}"));
            return (None, faults);
        }
    };
    for pointer in repeated {
        faults.add(pointer, "this name stands more than once in its object: keep one");
    }
    let request = match tree.get("curved_beam") {
        Some(_) => {
            let request = read_tree::<BeamRequest>(tree, beam_misfit, &mut faults);
            let filled_in = |beam: BeamRequest| BeamRequest { stone: beam.stone.filled_in(true), ..beam };
            request.map(|beam| Request::CurvedBeam(Box::new(filled_in(beam))))
        }
        None => {
            let request = read_tree(tree, misfit, &mut faults);
            request.map(|request| Request::Structure(Box::new(with_defaults(request))))
        }
    };
    (request, faults)
}

/// What to do about a field that does not belong.
fn misfit(_pointer: &str) -> &'static str {
    "there is no field of this name here: remove it or correct its spelling"
}

/// What to do about a field that does not belong beside `curved_beam`.
fn beam_misfit(pointer: &str) -> &'static str {
    const OF_A_STRUCTURE: [&str; 13] = [
        "/arch",
        "/bridge",
        "/blocks",
        "/stones",
        "/joint_overrides",
        "/loads",
        "/analysis",
        "/load_factor",
        "/method",
        "/geometry",
        "/crushing_in_path",
        "/report",
        "/motion",
    ];
    match OF_A_STRUCTURE.contains(&pointer) {
        true => {
            "this goes with an arch, a bridge or blocks, not with curved_beam: leave this out, or leave out curved_beam"
        }
        false => misfit(pointer),
    }
}

/// Reads a tree as one kind of body.
fn read_tree<R: DeserializeOwned + Serialize>(
    mut tree: Value,
    misfit: fn(&str) -> &'static str,
    faults: &mut Faults,
) -> Option<R> {
    let mut mended: Vec<String> = Vec::new();
    for _ in 0..MAX_STRUCTURAL_FAULTS {
        match attempt(&tree) {
            Ok((request, unknown)) => {
                let stands_in = |pointer: &String| mended.iter().any(|place| lies_under(pointer, place));
                let read = serde_json::to_value(&request).unwrap_or_default();
                for fault in shape::mistaken(&tree, &read).into_iter().filter(|fault| !stands_in(&fault.pointer)) {
                    faults.add(fault.pointer, fault.detail);
                }
                for pointer in unknown.into_iter().filter(|pointer| !stands_in(pointer)) {
                    let detail = misfit(&pointer);
                    faults.add(pointer, detail);
                }
                return mended.is_empty().then_some(request);
            }
            Err(fault) => {
                let fault = list_around::<R>(&tree, &fault.pointer).unwrap_or(fault);
                let place = mend::<R>(&mut tree, &fault.pointer);
                // What was taken away for its own fault is not missing.
                if !mended.contains(&fault.pointer) {
                    faults.add(fault.pointer, fault.detail);
                }
                mended.push(place?);
            }
        }
    }
    faults.add("", "and perhaps more: mend these first");
    None
}

/// One reading of the tree: the request and pointers to its unknown fields, or the first fault.
fn attempt<R: DeserializeOwned>(tree: &Value) -> Result<(R, BTreeSet<String>), Fault> {
    let mut unknown = BTreeSet::new();
    let mut track = serde_path_to_error::Track::new();
    let mut note = |path: serde_ignored::Path<'_>| {
        unknown.insert(ignored_pointer(&path, tree));
    };
    let reader = serde_path_to_error::Deserializer::new(tree, &mut track);
    match R::deserialize(serde_ignored::Deserializer::new(reader, &mut note)) {
        Ok(request) => Ok((request, unknown)),
        Err(error) => Err(fault_at(&track.path(), &error.to_string(), tree)),
    }
}

/// The fault of a list around a place where an object belongs: serde has read its items as fields.
fn list_around<R: DeserializeOwned>(tree: &Value, pointer: &str) -> Option<Fault> {
    let ends = pointer.match_indices('/').map(|(at, _)| at).chain([pointer.len()]);
    for place in ends.map(|end| &pointer[..end]) {
        if !tree.pointer(place).is_some_and(Value::is_array) {
            continue;
        }
        let mut emptied = tree.clone();
        *emptied.pointer_mut(place)? = json!({});
        let belongs = attempt::<R>(&emptied).err().is_some_and(|fault| {
            fault.pointer == place && !fault.detail.contains("missing") && fault.detail.contains("expected")
        });
        if !belongs {
            return Some(shape::list_for_object(place.to_owned()));
        }
    }
    None
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
fn stand_ins() -> [Value; 12] {
    // Has every required field of every object.
    let mut any_object = json!({
        "profile": {"circular": {}}, "span_m": 1, "rise_m": 1, "arcs": [], "radius_m": 1, "angle_deg": 1,
        "intrados_m": [], "extrados_m": [], "crown_m": 1, "springing_m": 1, "centre_y_m": 1, "centre_m": [1, 1],
        "height_m": 1, "joint": 1, "load": {"self_weight": {}}, "step": 1, "bands": [], "from_m": 1, "to_m": 1,
        "pressure_pa": 1, "force_n_per_m": 1, "centre_x_m": 1, "width_m": 1, "radial": 1, "along": 1, "abscissae": [],
        "inner_radius_m": 1, "outer_radius_m": 1, "end_shear_n_per_m": 1,
    });
    let of_blocks = json!({
        "name": "", "block": "", "side": 1, "polygons": [], "supports": [], "corners_m": [], "between": ["", ""],
        "ends_m": [[1, 1], [1, 1]], "spans": [], "rings": [], "thickness_m": 1, "voussoirs": 1, "top_width_m": 1,
        "level_m": 1,
    });
    if let (Value::Object(fields), Value::Object(more)) = (&mut any_object, of_blocks) {
        fields.extend(more);
    }
    let force = json!({"block": "", "at_m": [1, 1], "force_n_per_m": [1, 1]});
    let alternatives =
        [json!({"circular": {}}), json!({"constant_m": 1}), json!({"self_weight": {}}), json!({"load_factor": 1})];
    let [profile, thickness, load, field] = alternatives;
    let lists = [json!(["", ""]), json!([[1, 1], [1, 1]])];
    let [names, ends] = lists;
    [json!(1), json!([]), json!([1, 1]), any_object, profile, thickness, load, field, json!(""), names, ends, force]
}

/// Puts a neutral value in the place of a fault, or of what contains it, so that the reading gets past it; says
/// where it had to be put.
fn mend<R: DeserializeOwned>(tree: &mut Value, pointer: &str) -> Option<String> {
    let (parent, key) = pointer.rsplit_once('/')?;
    let name = key.replace("~1", "/").replace("~0", "~");
    if let Some(Value::Object(object)) = tree.pointer_mut(parent) {
        // Whatever has a default can be left out, unless that leaves a choice without its alternative.
        object.remove(&name);
        let emptied = attempt::<R>(tree).is_err_and(|fault| lies_under(pointer, &fault.pointer));
        if !emptied && gets_past::<R>(tree, pointer) {
            return Some(pointer.to_owned());
        }
    }
    let mut values = stand_ins().into_iter();
    match values.any(|value| put(tree, parent, &name, value) && gets_past::<R>(tree, pointer)) {
        true => Some(pointer.to_owned()),
        false => mend::<R>(tree, parent),
    }
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

fn gets_past<R: DeserializeOwned>(tree: &Value, pointer: &str) -> bool {
    match attempt::<R>(tree) {
        Ok(_) => true,
        Err(fault) => !lies_under(&fault.pointer, pointer),
    }
}
