//! The requests of a document, and what it says is printed of their answers.

use serde_json::Value;

/// A request and lines of the answer for people.
pub struct Example {
    pub request: Value,
    pub printed: Vec<String>,
}

fn case(path: &str) -> Value {
    serde_json::from_str(&super::text(&super::Path::new(super::ROOT).join(path))).unwrap()
}

/// Those of a document, in their order: its blocks of JSON, and the cases that its commands solve. Fields without a structure are put
/// in place of those of the first arch. A block of text belongs to the request before it.
pub fn examples(document: &str) -> Vec<Example> {
    let words = super::text(&super::Path::new(super::ROOT).join(document));
    let mut found = Vec::new();
    for block in words.split("\n```").skip(1).step_by(2) {
        let (language, code) = block.split_once('\n').unwrap();
        let solved =
            code.split_whitespace().find(|word| word.ends_with("/request.json")).filter(|_| !code.contains("--json"));
        match language {
            "json" => found.push(Example { request: whole(serde_json::from_str(code).unwrap()), printed: Vec::new() }),
            "sh" if code.contains(" solve ") => {
                let request = solved.map_or(Value::Null, case);
                found.push(Example { request, printed: Vec::new() });
            }
            "text" => found.last_mut().unwrap().printed.extend(code.lines().map(str::to_owned)),
            _ => {}
        }
    }
    found.retain(|example| !example.request.is_null());
    found
}

fn whole(request: Value) -> Value {
    if ["arch", "bridge", "blocks", "curved_beam"].iter().any(|structure| request.get(structure).is_some()) {
        return request;
    }
    let mut first = case("cases/first-arch/request.json");
    first.as_object_mut().unwrap().extend(request.as_object().unwrap().clone());
    first
}
