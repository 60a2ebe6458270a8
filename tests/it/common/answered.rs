//! Wire JSON in, the answer on the wire out.

use serde_json::Value;
use std::time::Duration;
use voussoir::budget::Budget;
use voussoir::collapse::answer;
use voussoir::wire::prose::prose;
use voussoir::wire::read::read_question;
use voussoir::wire::response::JobResult;

/// Runs a request that has to be a good one.
pub fn result(request: &Value) -> JobResult {
    let (request, question) = read_question(request.to_string().as_bytes()).unwrap();
    JobResult::new(&request, &answer(&question, &Budget::unlimited()).unwrap()).unwrap()
}

/// Its answer as JSON.
pub fn solved(request: &Value) -> Value {
    serde_json::from_slice(&result(request).to_bytes().unwrap()).unwrap()
}

/// An end of an answer by its name, `lowest` or `highest`; null where it has none.
pub fn end<'a>(answer: &'a Value, which: &str) -> &'a Value {
    let mut ends = answer["ends"].as_array().into_iter().flatten();
    ends.find(|end| end["which"] == which).unwrap_or(&Value::Null)
}

/// How stone that does not crush falls at an end.
pub fn uncrushed(end: &Value) -> &Value {
    end.get("without_crushing").unwrap_or(end)
}

/// Its answer as text on one line: lines are broken anywhere.
pub fn text(request: &Value) -> String {
    prose(&result(request), Duration::ZERO).split_whitespace().collect::<Vec<_>>().join(" ")
}
