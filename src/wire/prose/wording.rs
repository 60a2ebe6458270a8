//! An answer in sentences.

use super::noun::in_its_words;
use super::summary::paragraph;
use super::window::window;
use super::{geometric, moving, safety, survey};
use crate::collapse::{Direction, GovernedBy, Mode, Outcome, SafetyZone, WhichEnd};
use crate::wire::prose::{Digits, Rounded};
use crate::wire::request::AnalysisRequest;
use crate::wire::response::{AnalysisResult, EndBody, MethodWord, MotionBody, RangeBody};
use serde::Serialize;
use std::collections::BTreeSet;
use std::fmt::Display;

/// Longest line of prose, characters.
const LINE_WIDTH: usize = 100;

/// Lower and upper end, each where there is one.
pub fn limits(result: &AnalysisResult) -> [Option<&EndBody>; 2] {
    [WhichEnd::Lowest, WhichEnd::Highest].map(|which| result.ends.iter().find(|end| end.which == which))
}

/// What an end is called.
pub fn name(end: &EndBody) -> &'static str {
    if end.which == WhichEnd::Lowest { "lower end" } else { "upper end" }
}

/// Motion after collapse in two sentences.
pub fn motion(from: &str, motion: &MotionBody, unit: &str) -> String {
    let most = motion.frames.penetration.iter().copied().fold(0.0, f64::max);
    format!(
        "Motion after collapse{from}, in {} steps at intensity {} {unit}, by {} m at most: {} Stones overlap by {most:.0e} of \
         the thickness at most.",
        motion.frames.parameter_s2.len() - 1,
        Digits(motion.intensity),
        Digits(motion.frames.largest_displacement_m.last().copied().unwrap_or(0.0)),
        motion.why
    )
}

/// One sentence, or a few.
pub fn headline(result: &AnalysisResult) -> String {
    let adequacy = result.ends.iter().find_map(|end| end.adequacy_factor);
    let factored = match (&result.request.partial_factors, adequacy) {
        (None, _) => String::new(),
        (Some(_), None) => " That is with partial factors.".to_owned(),
        (Some(_), Some(factor)) => format!(" With partial factors its adequacy factor is {}.", Rounded(factor)),
    };
    in_its_words(&result.request, &format!("{}{factored}", of_an_arch(result)))
}

/// The same, said of an arch.
fn of_an_arch(result: &AnalysisResult) -> String {
    if let Some(safety) = &result.safety {
        return safety::headline(result, safety);
    }
    if let Some(settlement) = result.settlement.as_ref().filter(|_| result.outcome != Outcome::Crushes) {
        return moving::headline(&result.request, settlement);
    }
    if let Some(safety) = &result.geometric_safety {
        return geometric::headline(safety);
    }
    let sentence = match (result.outcome, result.ends.first()) {
        (Outcome::Collapse, Some(end)) if end.load_factor == 0.0 => at_once(result),
        (Outcome::Collapse, Some(end)) => format!("{}{}", collapses(result, end), moving::before(result, end)),
        (Outcome::StandsInWindow, _) => in_window(result),
        (Outcome::FallsAsBuilt, _) => falls(result).to_owned(),
        (Outcome::SlidesAsBuilt, _) => {
            "The arch slides as its loads come on, although limit analysis finds equilibrium: whether it stands depends on \
             how it was built."
                .to_owned()
        }
        (Outcome::Stands, _) => stands(result),
        (Outcome::Crushes, end) => crushes(result, end),
        (Outcome::CannotTell, _) => {
            let remedy = result.remedy.unwrap_or("The notes say why.");
            let window = result.limit_window.map(|_| format!(" In limit analysis it {}.", window(result)));
            format!("No answer: what was found cannot be trusted.{} {remedy}", window.unwrap_or_default())
        }
        (outcome, _) => format!("Outcome: {}.", word(&outcome)),
    };
    let sentence = sentence + without_crushing(result).unwrap_or_default();
    // Where the structure does not stand without its vehicle, no position of that matters.
    let stands = !matches!(result.outcome, Outcome::Crushes | Outcome::FallsAsBuilt | Outcome::SlidesAsBuilt);
    let worst = result.worst_position.as_ref().filter(|_| stands);
    let worst = worst.map(|worst| format!(" The vehicle stands worst at x = {} m.", Rounded(worst.x_m)));
    let survey = result.survey_tolerance.as_ref().map(|of| survey::sentence(of, unit(result)));
    let sentence = sentence + &worst.or(survey).unwrap_or_default();
    match result.method {
        MethodWord::EventPath => sentence,
        MethodWord::FixedSteps => {
            format!("{sentence} (By fixed steps and an opening criterion, for comparison only.)")
        }
    }
}

/// A sentence on loads in which crushing is missing.
fn without_crushing(result: &AnalysisResult) -> Option<&'static str> {
    let told = matches!(result.outcome, Outcome::Collapse | Outcome::StandsInWindow | Outcome::Stands);
    let missing = told && result.crushing.as_ref().is_some_and(|crushing| crushing.plastic_section.is_none());
    missing.then_some(" That is of stone that does not crush: whether its joints crush before could not be computed.")
}

fn collapses(result: &AnalysisResult, end: &EndBody) -> String {
    let (unit, times) = (unit(result), Rounded(end.load_factor.abs()));
    let first = if result.updated_geometry.is_some() { " at first order" } else { "" };
    let reversed = match end.load_factor < 0.0 {
        false => String::new(),
        true => format!(", that is with its scaled loads reversed and {times} times as large"),
    };
    let crush = if end.range.is_some() { "slide and crush" } else { "crush" };
    let why = match (end.governed_by, &end.instability) {
        (GovernedBy::Crushing, Some(other)) => {
            format!(", as its joints {crush}; if its stone did not crush, at {} {unit}", Rounded(other.intensity))
        }
        (GovernedBy::Crushing, None) => format!(", as its joints {crush}"),
        _ => String::new(),
    };
    let range = end.range.as_ref().map(|range| may_stand(end, range, unit)).unwrap_or_default();
    format!("The arch collapses{first} at {} {unit}{reversed}{why}.{range}", Rounded(end.intensity))
}

/// A sentence on what it may bear beyond the least load at which joints slide; nothing where that is the same.
fn may_stand(end: &EndBody, range: &RangeBody, unit: &str) -> String {
    let slide = slide(end);
    if let Some(crushing) = crushes_within(end, range) {
        return format!(" As its {slide}, it may also stand as far as {} {unit}, where they crush.", Rounded(crushing));
    }
    match range.greatest {
        None => format!(" As its {slide}, it may also stand at any load beyond."),
        Some(greatest) if differs(Rounded, range.least, greatest) => {
            format!(" As its {slide}, it may also stand as far as {} {unit}.", Rounded(greatest))
        }
        Some(_) => String::new(),
    }
}

/// What joints do at an end that sliding governs: none may slide but those that part altogether.
fn slide(end: &EndBody) -> &'static str {
    if end.fall.mechanism.slides.is_empty() { "joints part and slip" } else { "joints slide" }
}

/// The intensity within the range at which joints of the stone's strength crush: no more is possible.
fn crushes_within(end: &EndBody, range: &RangeBody) -> Option<f64> {
    let crushing = end.crushing.map(|figure| figure.intensity).filter(|crushing| crushing.abs() > range.least.abs())?;
    range.greatest.is_none_or(|greatest| differs(Rounded, crushing, greatest)).then_some(crushing)
}

/// Both ends of the range of an end in a table of facts; none where they are the same.
pub fn sliding_range(end: &EndBody, unit: &str) -> Option<String> {
    let (range, slide) = (end.range.as_ref()?, slide(end));
    if let Some(crushing) = crushes_within(end, range) {
        return Some(format!("{} to {} {unit}, as {slide}, then crush", Digits(range.least), Digits(crushing)));
    }
    match range.greatest {
        Some(greatest) => differs(Digits, range.least, greatest)
            .then(|| format!("{} to {} {unit}, as {slide}", Digits(range.least), Digits(greatest))),
        None => Some(format!("{} {unit} and beyond, as {slide}", Digits(range.least))),
    }
}

/// Whether two numbers differ as they are shown.
fn differs<D: Display>(shown: fn(f64) -> D, a: f64, b: f64) -> bool {
    shown(a).to_string() != shown(b).to_string()
}

fn in_window(result: &AnalysisResult) -> String {
    let (ends, unit) = (limits(result), unit(result));
    let tried = Rounded(result.cap * result.request.load_factor.intensity_per_unit);
    let between = |low: Option<f64>, high: Option<f64>| match (low.map(Rounded), high.map(Rounded)) {
        (Some(low), Some(high)) => format!("between {low} and {high} {unit}"),
        (Some(low), None) => format!("above {low} {unit} (tried up to {tried})"),
        (None, Some(high)) => format!("below {high} {unit} (tried down to -{tried})"),
        (None, None) => format!("under its scaled loads (tried from -{tried} to {tried} {unit})"),
    };
    let [low, high] = ends.map(|end| end.map(|end| end.intensity));
    let reversed = if high.is_some_and(|high| high < 0.0) { ", that is with its scaled loads reversed" } else { "" };
    let stands = format!("The arch stands only {}{reversed}; without its scaled loads it falls.", between(low, high));
    let crushing = ends.map(|end| end.is_some_and(|end| end.governed_by == GovernedBy::Crushing));
    let at = match crushing {
        [false, false] => return stands,
        [true, false] => "the lower end",
        [false, true] => "the upper end",
        [true, true] => "both ends",
    };
    let [low, high] = ends.map(|end| end.and_then(|end| end.instability).map(|figure| figure.intensity));
    format!("{stands} At {at} its joints crush; if its stone did not crush, it would stand {}.", between(low, high))
}

fn falls(result: &AnalysisResult) -> &'static str {
    match (has(result, true), result.limit_window) {
        (false, _) => "The arch falls as built: it cannot carry its fixed loads.",
        (true, None) => {
            "The arch falls as built: it cannot carry its fixed loads, whatever the size of the scaled ones."
        }
        (true, Some(_)) => "The arch falls under its fixed loads with the scaled ones of any size that was tried.",
    }
}

/// Whether there are scaled loads, or fixed ones.
pub fn has(result: &AnalysisResult, scaled: bool) -> bool {
    result.request.loads.iter().any(|entry| entry.scaled == scaled)
}

/// Of an arch that collapses at load factor 0.
fn at_once(result: &AnalysisResult) -> String {
    let without = if has(result, false) { "without its scaled loads" } else { "as long as there is no load" };
    let act = if reversed(result) { "act reversed" } else { "act" };
    format!("The arch collapses at {} {}: it stands {without}, and falls as soon as they {act}.", 0, unit(result))
}

/// Of an arch whose joints cannot carry the loads that the path starts from.
fn crushes(result: &AnalysisResult, end: Option<&EndBody>) -> String {
    let [low, high] = result.limit_window_load_factor.unwrap_or([None, None]);
    let alone = low.is_none_or(|low| low <= 0.0) && high.is_none_or(|high| high >= 0.0);
    let what =
        if alone { "The fixed loads alone crush the arch" } else { "The arch crushes at any size of its scaled loads" };
    // With vehicles that load is of the position that is worst for joints that crush, which tells nothing here.
    let or = end.filter(|_| alone && result.worst_position.is_none()).map(|end| {
        format!("; if its stone did not crush, it would collapse at {} {}", Rounded(end.intensity), unit(result))
    });
    format!("{what}: joints of its strength cannot carry them{}.", or.unwrap_or_default())
}

fn stands(result: &AnalysisResult) -> String {
    if !has(result, true) {
        return "The arch stands under its fixed loads.".to_owned();
    }
    let factor = &result.request.load_factor;
    let (tried, unit) = (Rounded(result.cap * factor.intensity_per_unit), unit(result));
    let to = match factor.direction {
        Direction::Increase => format!("up to {tried} {unit}"),
        Direction::Decrease => format!("under its scaled loads reversed, down to -{tried} {unit}"),
    };
    format!("The arch stands. It does not collapse {to}, the most that was tried.")
}

fn reversed(result: &AnalysisResult) -> bool {
    result.request.load_factor.direction == Direction::Decrease
}

/// What the modes, and the zones of the paper, that appear in an answer mean.
pub fn explain(
    text: &mut String,
    request: &AnalysisRequest,
    modes: impl Iterator<Item = Mode>,
    zones: impl Iterator<Item = SafetyZone>,
) {
    let of_mode = |mode: Mode| {
        let means = match mode {
            Mode::CrownRises => "the crown goes up",
            Mode::CrownDescends => "the crown goes down",
            Mode::Sway => "the crown moves sideways more than up or down",
            Mode::Sliding => "joints slide more than they open",
            Mode::Overturning => "blocks turn over",
            Mode::Crushing => "joints crush over their whole length, and none opens or slides",
        };
        format!("Mode {}: {means}.", word(&mode))
    };
    let of_zone = |zone: SafetyZone| {
        let means = match zone {
            SafetyZone::CrownRises => "the arch falls, and its crown rises",
            SafetyZone::Crushing => "the stone crushes",
            SafetyZone::CrownDescends => "the arch falls, and its crown descends",
        };
        format!("Zone {}: {means}.", safety::zone(Some(zone)))
    };
    let lines: BTreeSet<String> = modes.map(of_mode).chain(zones.map(of_zone)).collect();
    lines.iter().for_each(|line| paragraph(text, &in_its_words(request, line)));
}

/// The unit of intensities; the bare sign for none means the load factor itself, unless that is scaled.
pub fn unit(result: &AnalysisResult) -> &str {
    match (result.unit.as_str(), result.request.load_factor.intensity_per_unit == 1.0) {
        ("-", true) => "(load factor)",
        ("-", false) => "(no unit)",
        (unit, _) => unit,
    }
}

/// A word of the wire, with spaces.
pub fn word(word: &impl Serialize) -> String {
    let value = serde_json::to_value(word).unwrap_or_default();
    value.as_str().unwrap_or_default().replace('_', " ")
}

/// Prose in lines of readable length.
pub fn wrapped(text: &str) -> String {
    let mut lines = String::new();
    let mut length = 0;
    for word in text.split_whitespace() {
        let more = word.chars().count();
        if length > 0 && length + 1 + more > LINE_WIDTH {
            lines.push('\n');
            length = 0;
        } else if length > 0 {
            lines.push(' ');
            length += 1;
        }
        lines.push_str(word);
        length += more;
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_broken_between_words() {
        let text = "word ".repeat(60);
        let lines = wrapped(&text);
        assert!(lines.lines().all(|line| line.len() <= LINE_WIDTH && line.ends_with("word")));
        assert_eq!(lines.split_whitespace().count(), 60);
        assert_eq!(wrapped("short"), "short");
    }
}
