//! An answer in every form in which it is given out, written once.

mod table;

use super::format::Format;
use super::json::line;
use super::prose;
use super::request::{AnalysisRequest, Request, StressFieldRequest};
use super::response::JobResult;
use crate::collapse::{Answer, CollapseReport, Question};
use crate::jobs::{Failure, Product, Rendering};
use crate::render::vtu::vtu;
use bytes::Bytes;
use std::time::Duration;

/// The whole answer, in JSON and text.
pub const WHOLE: &str = "results";
/// The load path, in JSON and CSV.
pub const HISTORY: &str = "history";
/// The drawing, in SVG, or why there is none.
pub const FIGURE: &str = "figure";

/// Writes an answer in all its parts and formats; `wall_time` is what finding it took. The first is the whole of it as JSON:
/// what is not finite is refused there, before any other shows it.
///
/// # Errors
/// Where a number is not finite; a defect where this is no answer to the request.
pub fn renderings(
    request: &Request,
    question: &Question,
    answer: &Answer,
    wall_time: Duration,
) -> Result<Product, Failure> {
    let result = JobResult::new(request, answer).ok_or(Failure::Defect)?;
    let named = |name: &str| vec![name.to_owned()];
    let mut all = vec![
        rendering(named(WHOLE), Format::Json, line(&result)?),
        rendering(named(WHOLE), Format::Text, prose::prose(&result, wall_time)),
    ];
    if let (Request::Structure(request), Answer::One(report), JobResult::Analysis(result)) = (request, answer, &result)
    {
        all.push(rendering(named(HISTORY), Format::Json, line(&result.history)?));
        all.push(rendering(named(HISTORY), Format::Csv, table::history(&result.history)));
        for (field, body) in report.stress_fields.iter().zip(&result.stress_fields) {
            let names = || names_of_field(field.load_factor, request, report);
            all.push(rendering(names(), Format::Json, line(body)?));
            all.push(rendering(names(), Format::Csv, table::field(body)));
            all.push(rendering(names(), Format::Vtu, vtu(field)));
        }
    }
    let figure = prose::figure(question, answer, &result).map(Bytes::from);
    all.push(Rendering { names: named(FIGURE), format: Format::Svg.name(), body: figure });
    Ok(all.into())
}

fn rendering(names: Vec<String>, format: Format, body: impl Into<Vec<u8>>) -> Rendering {
    // As it is kept, without the room it grew in.
    let body = body.into().into_boxed_slice();
    Rendering { names, format: format.name(), body: Ok(body.into()) }
}

/// A stress field goes by its load factor, and by the word it was asked for with.
fn names_of_field(load_factor: f64, request: &AnalysisRequest, report: &CollapseReport) -> Vec<String> {
    let near = report.near_collapse.as_ref().filter(|near| near.load_factor == load_factor);
    let asked = request.report.stress_fields.contains(&StressFieldRequest::NearCollapse);
    let words = [("unit_load", load_factor == 1.0), ("near_collapse", asked && near.is_some())];
    let words = words.into_iter().filter(|(_, holds)| *holds).map(|(word, _)| field(word));
    words.chain([field(&load_factor.to_string())]).collect()
}

/// The name of a stress field that a client calls by a word or a number, however it writes that.
pub fn field(load: &str) -> String {
    // Zero has no sign here.
    let number = load.parse::<f64>().map(|number| (number + 0.0).to_string());
    format!("fields/{}", number.unwrap_or_else(|_| load.to_owned()))
}

/// The format in which a part that is given out in `format` is kept: a drawing is kept once, and goes by two media types.
pub fn kept_as(format: Format) -> &'static str {
    if format == Format::Xml { Format::Svg.name() } else { format.name() }
}
