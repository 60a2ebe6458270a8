//! JSON to a request, with everything that is wrong with it.

mod defaults;
mod light;
mod table;
mod words;

use super::fault::{Fault, Faults, lies_under, listed};
use super::request::{AnalysisRequest, BeamRequest, Request};
use super::{translate, tree};
use crate::collapse::{Analysis, Question};
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::sync::LazyLock;
use table::Table;

static STRUCTURE: LazyLock<Table> = LazyLock::new(|| Table::of::<AnalysisRequest>(|_| None));
static CURVED_BEAM: LazyLock<Table> = LazyLock::new(|| Table::of::<BeamRequest>(of_a_structure));

/// Reads a request and fills in its defaults.
///
/// # Errors
/// All faults that the table of fields can tell: syntax, kinds, ranges, missing, unknown and repeated fields.
pub fn read(body: &[u8]) -> Result<Request, Vec<Fault>> {
    let (request, faults) = read_fields(body, |_, _| {});
    request.filter(|_| faults.is_empty()).ok_or_else(|| listed(faults.into_vec()))
}

/// Reads and translates a request: what was asked, with its defaults, and the same in SI for the mechanics.
///
/// # Errors
/// All faults of its fields. Where fields are at most unknown or repeated, all faults of what does not fit together, too.
pub fn read_question(body: &[u8]) -> Result<(Request, Question), Vec<Fault>> {
    Fields::of(body).question()
}

/// A body of which every field has been looked at by itself, in time that grows with its length alone. To translate it may take
/// much longer: a short body can ask for a large structure.
pub struct Fields {
    /// The request, unless a value of it cannot be used.
    request: Option<Request>,
    faults: Faults,
}

impl Fields {
    /// Those of a body.
    pub fn of(body: &[u8]) -> Self {
        let (request, faults) = read_fields(body, check_members);
        Fields { request, faults }
    }

    /// Whether they are [translated](Fields::question) as quickly as they were read.
    pub fn are_light(&self) -> bool {
        self.request.as_ref().is_none_or(Request::is_light)
    }

    /// The second half of [`read_question`].
    ///
    /// # Errors
    /// As there.
    pub fn question(self) -> Result<(Request, Question), Vec<Fault>> {
        let mut faults = self.faults.into_vec();
        if let Some(request) = self.request {
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
}

/// Reads a request once more that was read before and written as JSON with its defaults: nothing is looked for that cannot be
/// wrong any more. Text of another version of this program may lack defaults of this one; none where it does not fit this one at all.
pub fn read_again(written: &[u8]) -> Option<(Request, Question)> {
    let structure = serde_json::from_slice(written).map(Request::Structure);
    let request = structure.or_else(|_| serde_json::from_slice(written).map(Request::CurvedBeam));
    let request = request.ok().or_else(|| read(written).ok())?;
    let question = translate::translate(&request).ok()?;
    Some((request, question))
}

/// True for a fault that may come of a stray field: of an object that lacks something where a misspelt name stands in it.
fn follows(fault: &Fault, strays: &[Fault]) -> bool {
    strays.iter().any(|stray| !fault.pointer.is_empty() && lies_under(&stray.pointer, &fault.pointer))
}

/// Reads a request for one analysis of a structure, for those who want nothing else.
///
/// # Errors
/// As [`read_question`]; one fault where a curve or a curved beam is asked for.
pub fn read_analysis(body: &[u8]) -> Result<(AnalysisRequest, Analysis), Vec<Fault>> {
    match read_question(body)? {
        (Request::Structure(request), Question::One(analysis)) => Ok((*request, *analysis)),
        _ => {
            let detail = "this asks for more or other than one analysis of a structure: leave out curve, worst_position, survey_tolerance and curved_beam";
            Err(vec![Fault { pointer: String::new(), detail: detail.to_owned() }])
        }
    }
}

/// The request, unless a value of it cannot be used, and what is wrong. `rules` are those of a structure beside the table.
fn read_fields(body: &[u8], rules: fn(&Value, &mut Faults)) -> (Option<Request>, Faults) {
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
        faults.stray(pointer, "this name stands more than once in its object: keep one");
    }
    let request = match tree.get("curved_beam") {
        Some(_) => checked(&CURVED_BEAM, tree, &mut faults).map(|beam: Box<BeamRequest>| Request::CurvedBeam(beam)),
        None => {
            if tree.is_object() {
                rules(&tree, &mut faults);
            }
            checked(&STRUCTURE, tree, &mut faults).map(Request::Structure)
        }
    };
    (request.map(Request::with_defaults), faults)
}

/// The body as the table has it.
fn checked<Body: DeserializeOwned>(table: &Table, mut tree: Value, faults: &mut Faults) -> Option<Box<Body>> {
    table.check(&mut tree, faults);
    if !faults.only_strays() {
        return None;
    }
    let read = serde_json::from_value(tree);
    // The table says what serde takes: a test holds them together.
    read.map_err(|error| faults.add("", format!("the body cannot be read: {error}"))).ok()
}

/// Members of a request that need each other, or exclude each other.
fn check_members(body: &Value, faults: &mut Faults) {
    let given = |pointer: &str| body.pointer(pointer).is_some_and(|value| !value.is_null());
    let mut structures = ["arch", "bridge", "blocks"].into_iter().filter(|name| given(&format!("/{name}")));
    match structures.next() {
        None => faults.stray("/arch", "arch, bridge and blocks are all missing: add one of them"),
        Some(first) => structures.for_each(|other| {
            faults.stray(format!("/{other}"), format!("there is {first} too: leave one of them out"));
        }),
    }
    let [unit, factor] = ["/load_factor/unit", "/load_factor/intensity_per_unit"];
    if given(unit) && body.pointer(unit) != Some(&Value::from("-")) && !given(factor) {
        faults.stray(factor, "the intensity at load factor 1 is missing: give it in this `unit`, or leave `unit` out");
    }
}

/// What to do about a field of a structure beside `curved_beam`.
fn of_a_structure(pointer: &str) -> Option<&'static str> {
    let known = STRUCTURE.has(pointer.strip_prefix('/')?);
    known.then_some(
        "this goes with an arch, a bridge or blocks, not with curved_beam: leave this out, or leave out curved_beam",
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wire::json;
    use std::fs;

    #[test]
    fn what_was_written_is_read_again_as_it_was() {
        let cases = fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/cases")).unwrap();
        let requests = cases.filter_map(|case| fs::read(case.unwrap().path().join("request.json")).ok());
        let mut count = 0;
        for body in requests {
            let (request, _) = read_question(&body).unwrap();
            let (again, _) = read_again(&json::line(&request).unwrap()).unwrap();
            assert_eq!(again, request);
            count += 1;
        }
        assert!(count >= 10, "{count} cases");
        assert!(read_again(b"{}").is_none() && read_again(b"{\"curved_beam\": {}}").is_none());
    }
}
