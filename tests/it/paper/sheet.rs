//! Cases of the paper, solved, and what their tables share.

use serde_json::{Value, json};
use std::path::Path;
use voussoir::budget::Budget;
use voussoir::collapse;
use voussoir::wire::read::read_question;
use voussoir::wire::response::JobResult;

/// A file of a case of the paper.
fn file(case: &str, name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/paper").join(case).join(name);
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

/// Its request.
pub fn request(case: &str) -> Value {
    file(case, "request.json")
}

/// What another program says of it: the quantities of `expected.json`.
pub fn expected(case: &str) -> Value {
    file(case, "expected.json")["quantities"].clone()
}

/// The answer; none where the request is refused.
pub fn answered(request: &Value) -> Option<Value> {
    let (request, question) = read_question(request.to_string().as_bytes()).ok()?;
    let answer = collapse::answer(&question, &Budget::unlimited()).unwrap();
    Some(serde_json::from_slice(&JobResult::new(&request, &answer).unwrap().to_bytes().unwrap()).unwrap())
}

/// The answer to a good request.
pub fn solve(request: &Value) -> Value {
    answered(request).unwrap()
}

/// The number at a JSON pointer.
pub fn number(value: &Value, pointer: &str) -> f64 {
    value.pointer(pointer).and_then(Value::as_f64).unwrap_or(f64::NAN)
}

/// A safety factor: a number, or the word for its state.
pub fn factor(reach: &Value) -> String {
    match reach["load_factor"].as_f64().or(reach.as_f64()) {
        Some(factor) => format!("{factor:.3}"),
        None => reach["state"].as_str().or(reach.as_str()).unwrap_or("-").replace('_', " "),
    }
}

/// Load factor of collapse on moving geometry, or how its path ends; `-` where the arch does not stand at first order.
pub fn updated_geometry(request: &Value) -> String {
    let mut request = request.clone();
    request["geometry"] = json!("updated");
    let updated = &solve(&request)["updated_geometry"];
    match (updated["end"].as_str(), updated["load_factor"].as_f64()) {
        (Some("collapse"), Some(factor)) => format!("{factor:.3}"),
        (Some(end), Some(factor)) => format!("{} ({factor:.3})", end.replace('_', " ")),
        (Some(end), None) => end.replace('_', " "),
        (None, _) => "-".to_owned(),
    }
}

/// Hinges of the left half and the crown: angle from the springing in degrees, and the face that opens.
pub fn left_hinges(end: &Value) -> Vec<(f64, String)> {
    let left = |h: &&Value| h["angle_from_crown_deg"].as_f64().unwrap() < 1e-6;
    let one = |h: &Value| (h["angle_from_springing_deg"].as_f64().unwrap(), h["opens"].as_str().unwrap().to_owned());
    end["hinges"].as_array().unwrap().iter().filter(left).map(one).collect()
}

/// Angles as the paper prints them.
pub fn degrees(hinges: &[(f64, String)]) -> String {
    hinges.iter().map(|(angle, _)| format!("{angle:.1}")).collect::<Vec<_>>().join(" / ")
}

/// True where neighbouring hinges open at opposite faces.
pub fn alternate(hinges: &[(f64, String)]) -> bool {
    hinges.windows(2).all(|pair| pair[0].1 != pair[1].1)
}

/// Asserts that two numbers agree to an absolute tolerance.
pub fn close(name: &str, found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{name}: {found}, expected {expected} within {tolerance}");
}
