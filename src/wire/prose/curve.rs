//! A safety curve as a person reads it.

use super::given;
use super::noun::in_its_words;
use super::safety::{mesh, reach, zone};
use super::summary::{append, bare, paragraph};
use super::wording::{self, word};
use crate::collapse::Governs;
use crate::wire::prose::{Digits, Rounded};
use crate::wire::response::{CurvePointBody, ReachBody, SafetyCurveResult};
use comfy_table::Table;
use std::time::Duration;

/// Most abscissae named with a note.
const ABSCISSAE_NAMED: usize = 5;

/// The curve as a table.
pub fn summary(result: &SafetyCurveResult, wall_time: Duration) -> String {
    let name = result.request.name.as_ref().map(|name| format!("{name}\n\n")).unwrap_or_default();
    let headline = wording::wrapped(&headline(result));
    let mut text = format!("{name}{headline}\n\n{}\n", facts(result, Some(wall_time)).trim_fmt());
    append(&mut text, "Safety factors", points(result));
    let of = |point: &CurvePointBody| (point.safety.mode, point.safety.zone);
    let (modes, zones): (Vec<_>, Vec<_>) = result.points.iter().map(of).unzip();
    wording::explain(&mut text, &result.request, modes.into_iter().flatten(), zones.into_iter().flatten());
    for (note, abscissae) in notes(&result.points) {
        paragraph(&mut text, &format!("Note (abscissa {abscissae}): {note}"));
    }
    text
}

/// One sentence: where the arch is least safe.
pub fn headline(result: &SafetyCurveResult) -> String {
    let unsafe_at = result.points.iter().find(|point| point.safety.governing == ReachBody::DoesNotStand);
    let factor = |point: &CurvePointBody| match point.safety.governing {
        ReachBody::At { load_factor } => Some((load_factor, point.abscissa, point.safety.governed_by)),
        _ => None,
    };
    let least = result.points.iter().filter_map(factor).min_by(|a, b| a.0.total_cmp(&b.0));
    match (unsafe_at, least) {
        (Some(point), _) => {
            let at = place(result, point.abscissa);
            in_its_words(&result.request, &format!("The arch does not stand at abscissa {at}."))
        }
        (None, Some((factor, abscissa, governs))) => {
            let what = if governs == Governs::Crushing { "crushing" } else { "instability" };
            let (factor, at) = (Rounded(factor), place(result, abscissa));
            format!("The least safety factor is {factor}, at abscissa {at}; {what} governs there.")
        }
        (None, None) => "No abscissa has a safety factor.".to_owned(),
    }
}

fn place(result: &SafetyCurveResult, abscissa: f64) -> String {
    match result.unit.as_str() {
        "-" => Rounded(abscissa).to_string(),
        unit => format!("{} {unit}", Rounded(abscissa)),
    }
}

/// What was given; what finding the curve took, where that is told.
pub fn facts(result: &SafetyCurveResult, wall_time: Option<Duration>) -> Table {
    let (mut table, request) = (bare(), &result.request);
    let mut fact = |name: &str, value: String| {
        table.add_row([name, &value]);
    };
    let (name, structure) = given::structure(request);
    fact(name, structure);
    fact("stone", given::stone(request));
    if let Some(mesh) = mesh(&request.mesh) {
        fact("mesh", mesh);
    }
    fact("fixed loads", given::loads(request, false));
    fact("scaled loads", given::loads(request, true));
    if let Some(factors) = &request.partial_factors {
        fact("partial factors", factors.words());
    }
    fact("strength", given::strengths(request));
    fact("crushing by", word(&result.crushing));
    if let Some(time) = wall_time {
        fact("time", format!("{:.3} ms", time.as_secs_f64() * 1e3));
    }
    table
}

/// Every abscissa with its safety factors.
pub fn points(result: &SafetyCurveResult) -> Option<Table> {
    let mut table = bare();
    let abscissa = if result.unit == "-" { "abscissa".to_owned() } else { format!("abscissa, {}", result.unit) };
    let moving = result.points.iter().any(|point| point.safety.updated_geometry.is_some());
    let moving = moving.then_some("on moving geometry");
    let yields = result.points.iter().any(|point| point.safety.elastic.is_some()).then_some("first yield");
    let crushing = ["plastic section", "safety factor", "governed by", "mode", "zone"];
    table.set_header([abscissa.as_str(), "instability"].into_iter().chain(moving).chain(yields).chain(crushing));
    table.add_rows(result.points.iter().map(|point| {
        let safety = &point.safety;
        let told = |factor: Option<ReachBody>| factor.map_or("-".to_owned(), reach);
        let (moving, yields) = (moving.map(|_| told(safety.updated_geometry)), yields.map(|_| told(safety.elastic)));
        let crushing = [
            reach(safety.plastic_section),
            reach(safety.governing),
            word(&safety.governed_by),
            safety.mode.map_or("-".to_owned(), |mode| word(&mode)),
            zone(safety.zone).to_owned(),
        ];
        let before = [Digits(point.abscissa).to_string(), reach(safety.instability)];
        before.into_iter().chain(moving).chain(yields).chain(crushing).collect::<Vec<_>>()
    }));
    (!result.points.is_empty()).then_some(table)
}

/// Every note once, with the abscissae it belongs to.
pub fn notes(points: &[CurvePointBody]) -> Vec<(&str, String)> {
    let mut notes: Vec<(&str, Vec<f64>)> = Vec::new();
    for point in points {
        for note in &point.safety.notes {
            match notes.iter_mut().find(|(other, _)| other == note) {
                Some((_, abscissae)) => abscissae.push(point.abscissa),
                None => notes.push((note, vec![point.abscissa])),
            }
        }
    }
    notes.into_iter().map(|(note, abscissae)| (note, named(&abscissae))).collect()
}

fn named(abscissae: &[f64]) -> String {
    let named: Vec<_> = abscissae.iter().take(ABSCISSAE_NAMED).map(|&abscissa| Digits(abscissa).to_string()).collect();
    let more = abscissae.len() - named.len();
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!("{}{more}", named.join(", "))
}
