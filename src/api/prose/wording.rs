//! An answer in sentences.

use super::noun::in_its_words;
use super::{moving, safety, sliding};
use crate::api::prose::Digits;
use crate::api::response::{AnalysisResult, Collapse, HingeBody, LiftOffBody, MethodWord, MotionBody, SlideBody};
use crate::collapse::{Direction, Outcome};
use serde::Serialize;

/// Longest line of prose, characters.
const LINE_WIDTH: usize = 100;

/// One end of the range of intensities in which an arch stands.
#[derive(Clone, Copy)]
pub struct LimitEnd<'a> {
    pub collapse: &'a Collapse,
    pub hinges: &'a [HingeBody],
    pub slides: &'a [SlideBody],
    pub lift_offs: &'a [LiftOffBody],
}

/// Lower and upper end of the path, each where there is one. The path runs both ways only in a window.
pub fn limits(result: &AnalysisResult) -> [Option<LimitEnd<'_>>; 2] {
    let main = result.collapse.as_ref().map(|collapse| LimitEnd {
        collapse,
        hinges: &result.hinges,
        slides: &result.slides,
        lift_offs: &result.lift_offs,
    });
    let other = result.other_end.as_ref().map(|end| LimitEnd {
        collapse: &end.collapse,
        hinges: &end.hinges,
        slides: &end.slides,
        lift_offs: &end.lift_offs,
    });
    if reversed(result) { [main, other] } else { [other, main] }
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

/// Crushing that takes less than this share off a collapse load is not worth a word in the first line.
const CRUSHING_SHOWN: f64 = 1e-3;

/// One sentence.
pub fn headline(result: &AnalysisResult) -> String {
    in_its_words(&result.request, &of_an_arch(result))
}

/// The same, said of an arch.
fn of_an_arch(result: &AnalysisResult) -> String {
    if let Some(safety) = &result.safety {
        return safety::headline(result, safety);
    }
    if let Some(settlement) = &result.settlement {
        return moving::headline(settlement);
    }
    let sentence = match (result.outcome, &result.collapse) {
        (Outcome::Collapse, Some(collapse)) if collapse.load_factor == 0.0 => at_once(result),
        (Outcome::Collapse, Some(collapse)) => {
            let first = if result.updated_geometry.is_some() { " at first order" } else { "" };
            let moved = moving::before_the_start(result).unwrap_or_default();
            let more = sliding::sentence(collapse, unit(result));
            format!("The arch collapses{first} {}.{more}{}{moved}", reached(result, collapse), with_strength(result))
        }
        (Outcome::StandsInWindow, _) => in_window(result) + &with_strength(result),
        (Outcome::FallsAsBuilt, _) => falls(result).to_owned(),
        (Outcome::SlidesAsBuilt, _) => {
            "The arch slides as its loads come on, although limit analysis finds equilibrium: whether it stands depends on \
             how it was built."
                .to_owned()
        }
        (Outcome::NeverCollapses, _) => stands(result) + &with_strength(result),
        (Outcome::CannotTell, _) => {
            "No answer: what was found cannot be trusted. The notes say why.".to_owned()
        }
        (Outcome::Crushes, _) => {
            "The stone crushes before the scaled loads begin to act. The notes say how.".to_owned()
        }
        (outcome, _) => format!("Outcome: {}.", word(&outcome)),
    };
    match result.method {
        MethodWord::EventPath => sentence,
        MethodWord::FixedSteps => {
            format!("{sentence} (By fixed steps and an opening criterion, for comparison only.)")
        }
    }
}

fn reached(result: &AnalysisResult, collapse: &Collapse) -> String {
    let at = intensity(result, collapse);
    let times = Digits(collapse.load_factor.abs());
    match collapse.load_factor < 0.0 {
        false => format!("at {at}"),
        true => format!("at {at}, that is with its scaled loads reversed and {times} times as large"),
    }
}

/// What joints of the stone's strength make of an answer, where they change it visibly.
fn with_strength(result: &AnalysisResult) -> String {
    let plastic = result.crushing.as_ref().and_then(|crushing| crushing.plastic_section.as_ref());
    let Some(plastic) = plastic.filter(|_| !result.request.crushing_in_path) else { return String::new() };
    let start = result.start_load_factor * result.request.load_factor.intensity_per_unit;
    let [low, high] = plastic.window.unwrap_or([Some(f64::INFINITY), None]);
    let stands = low.is_none_or(|low| low <= start) && high.is_none_or(|high| high >= start);
    if let (true, Outcome::Collapse, Some(collapse)) = (stands, result.outcome, &result.collapse) {
        let end = if collapse.load_factor < 0.0 { low } else { high };
        let before = end.filter(|end| end.abs() < (1.0 - CRUSHING_SHOWN) * collapse.intensity.abs());
        let words = |end| format!(" Its joints crush before, at {} {} (plastic section).", Digits(end), unit(result));
        return before.map(words).unwrap_or_default();
    }
    let same = |a: Option<f64>, b: Option<f64>| match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() <= CRUSHING_SHOWN * b.abs(),
        (a, b) => a == b,
    };
    let rigid = result.limit_window.unwrap_or([None, None]);
    if stands && same(low, rigid[0]) && same(high, rigid[1]) {
        return String::new();
    }
    format!(" With joints of its strength it {} (plastic section).", range(plastic.window, unit(result)))
}

/// With its unit.
pub fn intensity(result: &AnalysisResult, collapse: &Collapse) -> String {
    format!("{} {}", Digits(collapse.intensity), unit(result))
}

fn in_window(result: &AnalysisResult) -> String {
    let [low, high] = limits(result).map(|end| end.map(|end| Digits(end.collapse.intensity)));
    let unit = unit(result);
    let tried = Digits(result.cap * result.request.load_factor.intensity_per_unit);
    let range = match (low, high) {
        (Some(low), Some(high)) => format!("between {low} and {high} {unit}"),
        (Some(low), None) => format!("above {low} {unit} (tried up to {tried})"),
        (None, Some(high)) => format!("below {high} {unit} (tried down to -{tried})"),
        (None, None) => format!("under its scaled loads (tried from -{tried} to {tried} {unit})"),
    };
    format!("The arch stands only {range}; without its scaled loads it falls.")
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
fn has(result: &AnalysisResult, scaled: bool) -> bool {
    result.request.loads.iter().any(|entry| entry.scaled == scaled)
}

/// Of an arch that collapses at load factor 0.
fn at_once(result: &AnalysisResult) -> String {
    let without = if has(result, false) { "without its scaled loads" } else { "as long as there is no load" };
    let act = if reversed(result) { "act reversed" } else { "act" };
    format!("The arch collapses at {} {}: it stands {without}, and falls as soon as they {act}.", 0, unit(result))
}

fn stands(result: &AnalysisResult) -> String {
    if !result.request.loads.iter().any(|entry| entry.scaled) {
        return "The arch stands under its fixed loads.".to_owned();
    }
    let factor = &result.request.load_factor;
    let (tried, unit) = (Digits(result.cap * factor.intensity_per_unit), unit(result));
    match factor.direction {
        Direction::Increase => {
            format!("The arch does not collapse: it stands up to {tried} {unit}, the most that was tried.")
        }
        Direction::Decrease => format!(
            "The arch does not collapse under its scaled loads reversed: it stands down to -{tried} {unit}, the most that was tried."
        ),
    }
}

/// The end that is drawn and whose forces are shown: that of the asked direction where there is one.
pub fn shown(result: &AnalysisResult) -> &'static str {
    let main_is_low = reversed(result) == result.collapse.is_some();
    if main_is_low { "lower end" } else { "upper end" }
}

fn reversed(result: &AnalysisResult) -> bool {
    result.request.load_factor.direction == Direction::Decrease
}

/// What limit analysis allows.
pub fn window(result: &AnalysisResult) -> String {
    range(result.limit_window, unit(result))
}

/// From where to where an arch stands.
pub fn range(ends: Option<[Option<f64>; 2]>, unit: &str) -> String {
    match ends.map(|ends| ends.map(|end| end.map(Digits))) {
        None => "finds no equilibrium at any intensity".to_owned(),
        Some([Some(low), Some(high)]) => format!("stands from {low} to {high} {unit}"),
        Some([Some(low), None]) => format!("stands from {low} {unit} upwards without end"),
        Some([None, Some(high)]) => format!("stands up to {high} {unit}, and downwards without end"),
        Some([None, None]) => "stands at any intensity".to_owned(),
    }
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
