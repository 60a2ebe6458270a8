//! An answer in every form in which it is given out, written once.

mod packed;
mod table;

pub use packed::{Unpacking, plain};

use super::figures::{Figure, STRESS, analysed, figures};
use super::format::Format;
use super::json::{line, line_in};
use super::prose;
use super::report::report;
use super::request::{AnalysisRequest, Request, StressFieldRequest};
use super::response::JobResult;
use crate::collapse::{Answer, CollapseReport, Question, Snapshot};
use crate::jobs::{Failure, Part, Product, Rendering};
use crate::render::pdf::pdf;
use crate::render::png::png;
use crate::render::vtu::vtu;
use bytes::Bytes;
use std::time::Duration;

/// The whole answer, in JSON and text.
pub const WHOLE: &str = "results";
/// The load path, in JSON and CSV.
pub const HISTORY: &str = "history";
/// The main drawing, in SVG, or why there is none.
pub const FIGURE: &str = "figure";
/// Every position of vehicles that was solved, in JSON and CSV.
pub const POSITIONS: &str = "positions";
/// The report, in HTML and PDF, or why there is none.
pub const REPORT: &str = "report";

/// Room in which an answer is written, bytes: some fifty stones take no more.
const ROOM: usize = 128 << 10;

/// The whole answer as JSON.
///
/// # Errors
/// As [`renderings`].
pub fn json(request: &Request, answer: &Answer) -> Result<Vec<u8>, Failure> {
    written(&JobResult::new(request, answer).ok_or(Failure::Defect)?)
}

/// Writes an answer as a whole, in JSON, and no other form of it: the first of its [`renderings`].
///
/// # Errors
/// As theirs.
pub fn whole(request: &Request, answer: &Answer) -> Result<Product, Failure> {
    Ok([whole_in(json(request, answer)?)].into())
}

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
    let whole = whole_in(written(&result)?);
    let mut all = vec![whole, rendering(named(WHOLE), Format::Text, prose::prose(&result, wall_time))];
    if let (Request::Structure(request), Answer::One(report), JobResult::Analysis(result), Some(analysis)) =
        (request, answer, &result, analysed(question))
    {
        let structure = &analysis.structure;
        all.push(rendering(named(HISTORY), Format::Json, line(&result.history)?));
        all.push(rendering(named(HISTORY), Format::Csv, table::history(&result.history)));
        if let Some(worst) = &result.worst_position {
            all.push(rendering(named(POSITIONS), Format::Json, line(&worst.curve)?));
            all.push(rendering(named(POSITIONS), Format::Csv, table::positions(&worst.curve)));
        }
        for (field, body) in report.stress_fields.iter().zip(&result.stress_fields) {
            let names =
                || words_of_field(field.load_factor, request, report).iter().map(|word| self::field(word)).collect();
            all.push(rendering(names(), Format::Json, line(body)?));
            all.push(rendering(names(), Format::Csv, table::field(body)));
            all.push(rendering(names(), Format::Vtu, vtu(field, state_at(field.load_factor, report), structure)));
        }
    }
    all.extend(drawings(request, question, answer, &result));
    Ok(all.into())
}

fn written(result: &JobResult) -> Result<Vec<u8>, Failure> {
    Ok(line_in(result, Vec::with_capacity(ROOM))?)
}

fn whole_in(json: Vec<u8>) -> Rendering {
    rendering(vec![WHOLE.to_owned()], Format::Json, json)
}

/// Every drawing and the report, or why there is none.
fn drawings(request: &Request, question: &Question, answer: &Answer, result: &JobResult) -> Vec<Rendering> {
    let missing = |name: &str, format: Format, reason: String| Rendering {
        names: vec![name.to_owned()],
        format: format.name(),
        part: Part { body: Err(reason), packed_from: None },
    };
    let all = match figures(question, answer, result) {
        Ok(all) => all,
        Err(reason) => {
            let reasons = [(FIGURE, Format::Svg), (REPORT, Format::Html)];
            return reasons.into_iter().map(|(name, format)| missing(name, format, reason.clone())).collect();
        }
    };
    let report = match report(result, &all) {
        Ok(page) => rendering(vec![REPORT.to_owned()], Format::Html, page),
        Err(reason) => missing(REPORT, Format::Html, reason),
    };
    let names = |(i, drawn): (usize, &Figure)| {
        let main = (i == 0).then(|| FIGURE.to_owned());
        let names = match (request, answer, drawn.stress_at) {
            (Request::Structure(request), Answer::One(report), Some(load_factor)) => {
                let words = words_of_field(load_factor, request, report);
                words.iter().map(|word| figure(&format!("{STRESS}{word}"))).collect()
            }
            _ => vec![figure(&drawn.name)],
        };
        main.into_iter().chain(names).collect()
    };
    let names: Vec<Vec<String>> = all.iter().enumerate().map(names).collect();
    let drawn = names.into_iter().zip(all).map(|(names, drawn)| rendering(names, Format::Svg, drawn.svg));
    drawn.chain([report]).collect()
}

/// The state of a load factor, where it is reported.
fn state_at(load_factor: f64, report: &CollapseReport) -> Option<&Snapshot> {
    let states = [&report.near_collapse, &report.at_unit_load, &report.at_start];
    states.into_iter().flatten().find(|state| state.load_factor == load_factor)
}

fn rendering(names: Vec<String>, format: Format, body: impl Into<Vec<u8>>) -> Rendering {
    Rendering { names, format: format.name(), part: packed::packed(body.into()) }
}

/// A stress field goes by its load factor, and by the word it was asked for with.
fn words_of_field(load_factor: f64, request: &AnalysisRequest, report: &CollapseReport) -> Vec<String> {
    let near = report.near_collapse.as_ref().filter(|near| near.load_factor == load_factor);
    let asked = request.report.stress_fields.contains(&StressFieldRequest::NearCollapse);
    let words = [("unit_load", load_factor == 1.0), ("near_collapse", asked && near.is_some())];
    let words = words.into_iter().filter(|(_, holds)| *holds).map(|(word, _)| word.to_owned());
    words.chain([load_factor.to_string()]).collect()
}

/// The name of a stress field that a client calls by a word or a number, however it writes that.
pub fn field(load: &str) -> String {
    // Zero has no sign here.
    let number = load.parse::<f64>().map(|number| (number + 0.0).to_string());
    format!("fields/{}", number.unwrap_or_else(|_| load.to_owned()))
}

/// The name of a drawing that a client calls so.
pub fn figure(name: &str) -> String {
    let word = name.strip_prefix(STRESS).map(field);
    let name = word.map_or(name.to_owned(), |field| field.replacen("fields/", STRESS, 1));
    format!("figures/{name}")
}

/// The format in which a part that is given out in `format` is kept: a drawing is kept once, and goes by two media types.
pub fn kept_as(format: Format) -> Format {
    match format {
        Format::Xml | Format::Png => Format::Svg,
        Format::Pdf => Format::Html,
        _ => format,
    }
}

/// Whether a format is not kept, but [`painted`] when it is asked for.
pub fn is_painted(format: Format) -> bool {
    matches!(format, Format::Png | Format::Pdf)
}

/// A drawing that is kept as SVG, in pixels; a report that is kept as HTML, on paper.
///
/// # Errors
/// Why there is none.
pub fn painted(kept: &Part, format: Format) -> Result<Bytes, String> {
    let kept = plain(kept)?;
    let kept = std::str::from_utf8(&kept).map_err(|error| error.to_string())?;
    let painted = if format == Format::Pdf { pdf(kept) } else { png(kept) };
    painted.map(Bytes::from)
}
