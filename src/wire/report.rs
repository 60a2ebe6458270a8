//! The report: all of an answer that an assessment's file needs, as one page to be printed. It is well-formed as XML, too, which is how
//! it is read again to be laid out on paper.

use super::figures::Figure;
use super::json::{NotFinite, pretty};
use super::prose::assumptions::{DEFAULTS, assumptions};
use super::prose::{self, Digits, curve, joints, moving, summary};
use super::request::{AnalysisRequest, Request};
use super::response::{AnalysisResult, EndBody, JobResult, SafetyCurveResult};
use crate::collapse::{Outcome, WhichEnd};
use crate::render::canvas::escaped;
use comfy_table::{Row, Table};

/// The version of this program.
const VERSION: &str = env!("CARGO_PKG_VERSION");

const STYLE: &str = include_str!("report/style.css");

/// A part of the report: its title and what it holds, as HTML.
type Section = (&'static str, String);

/// The page.
///
/// # Errors
/// Why there is none.
pub fn report(result: &JobResult, figures: &[Figure]) -> Result<String, String> {
    let (name, verdict, sections) = match result {
        JobResult::Analysis(result) => (&result.request.name, prose::headline(result), of_analysis(result, figures)),
        JobResult::SafetyCurve(result) => (&result.request.name, curve::headline(result), of_curve(result, figures)),
        JobResult::CurvedBeam(_) => return Err("no report: a curved beam is a test of the method".to_owned()),
    };
    let sections = sections.map_err(|NotFinite(what)| format!("no report: {what} is not finite"))?;
    let title = escaped(name.as_deref().unwrap_or("Masonry structure"));
    let sections: String = sections
        .into_iter()
        .filter(|(_, body)| !body.is_empty())
        .map(|(title, body)| format!("<section>\n<h2>{title}</h2>\n{body}</section>\n"))
        .collect();
    let verdict = escaped(&verdict);
    Ok(format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<meta name=\"viewport\" \
         content=\"width=device-width\"/>\n<title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<header>\n\
         <p>Voussoir {VERSION}: report of an analysis</p>\n<h1>{title}</h1>\n<p class=\"verdict\">{verdict}</p>\n</header>\n\
         {sections}</body>\n</html>\n"
    ))
}

/// What people write on it.
const FILE: &str = "<table class=\"file\">\n\
    <tr><th>Computed by</th><td></td><th>Date</th><td></td></tr>\n\
    <tr><th>Checked by</th><td></td><th>Date</th><td></td></tr>\n</table>\n";

fn of_analysis(result: &AnalysisResult, figures: &[Figure]) -> Result<Vec<Section>, NotFinite> {
    let mut found = table(&summary::facts(result, None));
    let named = result.named();
    for mechanism in result.ends.iter().map(|end| &end.fall.mechanism) {
        for (title, rows) in joints::tables("", mechanism, named) {
            found += &format!("<h3>{}</h3>\n{}", escaped(&title), table(&rows));
        }
    }
    let mut ground = String::new();
    if let Some(end) = result.ends.first() {
        joints::ground(&mut ground, end, result);
    }
    moving::supports(&mut ground, result);
    if !ground.is_empty() {
        found += &format!("<pre>{}</pre>\n", lines(ground.trim()));
    }
    Ok(vec![
        ("Drawings", drawn(figures)),
        ("What was given and found", found),
        ("Assumptions", assumed(&result.request)),
        ("Notes", list(result.notes.iter().cloned())),
        ("Checks", checks(result)),
        ("For the file", FILE.to_owned()),
        ("The request", request(&result.request)?),
    ])
}

fn of_curve(result: &SafetyCurveResult, figures: &[Figure]) -> Result<Vec<Section>, NotFinite> {
    let points = curve::points(result).map_or(String::new(), |points| table(&points));
    let notes = curve::notes(&result.points);
    Ok(vec![
        ("Drawings", drawn(figures)),
        ("What was given", table(&curve::facts(result, None))),
        ("What was found", points),
        ("Assumptions", assumed(&result.request)),
        ("Notes", list(notes.iter().map(|(note, at)| format!("Abscissa {at}: {note}")))),
        ("For the file", FILE.to_owned()),
        ("The request", request(&result.request)?),
    ])
}

/// What somebody has to answer for who relies on the answer.
fn assumed(request: &AnalysisRequest) -> String {
    format!("<p>{DEFAULTS}</p>\n{}", list(assumptions(request).into_iter()))
}

/// How the answer was checked against itself, and how it can be checked anew.
fn checks(result: &AnalysisResult) -> String {
    let mut all = Vec::new();
    let [lowest, highest] = result.limit_window_load_factor.unwrap_or([None, None]);
    for end in &result.ends {
        let limit = if end.which == WhichEnd::Lowest { lowest } else { highest };
        // Nothing is in equilibrium where it falls as its first loads come on.
        if matches!(result.outcome, Outcome::FallsAsBuilt | Outcome::SlidesAsBuilt) {
            continue;
        }
        all.extend(limit.and_then(|limit| against(limit, end)));
        all.push(format!("Equilibrium holds to {:.0e} at the {}.", end.residual, prose::name_of_end(end)));
    }
    if result.proof.is_some() {
        let proved = match result.limit_window {
            Some(_) => {
                "The limit window is proved by forces in equilibrium and by motions that no joint hinders: both are"
            }
            None => "That no load factor is borne is proved by a motion that no joint hinders: it is",
        };
        all.push(format!("{proved} in the answer as JSON, under proof, to be checked with structure alone."));
    }
    all.push(prose::in_its_words(&result.request, &summary::explanation(result)));
    list(all.into_iter())
}

/// The end of a load path of stone that does not crush against the `limit` of limit analysis.
fn against(limit: f64, end: &EndBody) -> Option<String> {
    let fall = &end.without_crushing.as_ref().unwrap_or(&end.fall).mechanism;
    let slips = !fall.slides.is_empty() || !fall.lift_offs.is_empty();
    // Where crushing governs, the range is that of joints that crush.
    let range = end.range.as_ref().filter(|_| end.without_crushing.is_none());
    let path = match range {
        Some(range) => range.path_load_factor,
        None => end.instability?.load_factor,
    };
    let (found, window) = (Digits(path), Digits(limit));
    // Where joints slide and crushing governs, the least load is told, and not where the path ended.
    if slips && range.is_none() {
        return Some(format!(
            "Of stone that does not crush, the least load factor found at which joints slide or part is {found}; limit analysis, found \
             independently, in which sliding joints dilate, allows {window}."
        ));
    }
    let apart = (path - limit).abs() / limit.abs().max(path.abs()).max(f64::MIN_POSITIVE);
    Some(format!(
        "Of stone that does not crush, the load path ends at load factor {found} and the window of limit analysis, found \
         independently, at {window}: {apart:.0e} apart."
    ))
}

fn request(request: &AnalysisRequest) -> Result<String, NotFinite> {
    let text = pretty(&Request::Structure(Box::new(request.clone())))?;
    Ok(format!(
        "<p>With it Voussoir {VERSION} gives the same answer again.</p>\n<pre class=\"request\">{}</pre>\n",
        lines(&text)
    ))
}

fn drawn(figures: &[Figure]) -> String {
    figures.iter().map(|figure| format!("<figure>\n{}</figure>\n", figure.svg)).collect()
}

/// Lines of text; the line breaks stay.
fn lines(text: &str) -> String {
    text.lines().map(|line| escaped(line) + "\n").collect()
}

fn list(items: impl Iterator<Item = String>) -> String {
    let items: String = items.map(|item| format!("<li>{}</li>\n", escaped(&item))).collect();
    if items.is_empty() { items } else { format!("<ul>\n{items}</ul>\n") }
}

fn table(table: &Table) -> String {
    let row = |row: &Row, cell: &str| {
        let cells = row
            .cell_iter()
            .map(|of| format!("<{cell}>{}</{cell}>", lines(&of.content()).trim().replace('\n', "<br/>")));
        format!("<tr>{}</tr>\n", cells.collect::<String>())
    };
    let head = table.header().map_or(String::new(), |header| row(header, "th"));
    let rows: String = table.row_iter().map(|of| row(of, "td")).collect();
    format!("<table>\n{head}{rows}</table>\n")
}
