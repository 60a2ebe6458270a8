//! The answer as a person reads it.

use super::noun::in_its_words;
use super::wording::{self, word};
use super::{geometric, given, joints, moving, plan, safety, shape, survey, window};
use crate::collapse::{Cost, GovernedBy, Outcome, StatesFrom};
use crate::wire::prose::Digits;
use crate::wire::response::{AnalysisResult, EndBody, PassiveElementBody, WorstPositionBody};
use comfy_table::{Table, presets};
use std::fmt::Write;
use std::time::Duration;

/// An element within this share of its largest force is at it; so little is none.
const FULL: f64 = 1e-6;

/// Everything but the rows of numbers per stone and joint.
pub fn summary(result: &AnalysisResult, wall_time: Duration) -> String {
    let name = result.request.name.as_ref().map(|name| format!("{name}\n\n")).unwrap_or_default();
    let headline = wording::wrapped(&wording::headline(result));
    let mut text = format!("{name}{headline}\n\n{}\n", facts(result, Some(wall_time)).trim_fmt());
    let window = result.outcome == Outcome::StandsInWindow;
    for (title, end) in ["Lower end", "Upper end"].into_iter().zip(wording::limits(result)).filter(|_| window) {
        if end.is_none() {
            paragraph(&mut text, &format!("{title}: none was found."));
        }
    }
    for end in &result.ends {
        let at = if window { format!(" at the {}", wording::name(end)) } else { String::new() };
        joints::moving(&mut text, &at, &end.fall.mechanism, result);
    }
    if let Some(end) = result.ends.first() {
        joints::ground(&mut text, end, result);
    }
    moving::supports(&mut text, result);
    if let Some(of) = &result.survey_tolerance {
        let title = format!("Points on which the load depends most, {}", wording::unit(result));
        append(&mut text, &title, survey::points(of));
    }
    let modes = result.ends.iter().map(|end| end.fall.mechanism.mode);
    let modes = modes.chain(result.safety.iter().filter_map(|safety| safety.mode));
    wording::explain(&mut text, &result.request, modes, result.safety.iter().filter_map(|safety| safety.zone));
    let of_safety = result.safety.iter().flat_map(|safety| &safety.notes);
    for (i, end) in result.ends.iter().enumerate() {
        if let Some(motion) = &end.motion {
            let from = if i == 0 { "" } else { " from the other end" };
            paragraph(&mut text, &wording::motion(from, motion, wording::unit(result)));
        }
    }
    for why in result.plan.iter().flat_map(|plan| &plan.why) {
        paragraph(&mut text, &format!("Model: {why}"));
    }
    for note in result.notes.iter().chain(of_safety.filter(|note| !result.notes.contains(note))) {
        paragraph(&mut text, &format!("Note: {note}"));
    }
    paragraph(&mut text, &in_its_words(&result.request, &explanation(result)));
    if result.geometric_safety.is_some() {
        paragraph(&mut text, &in_its_words(&result.request, geometric::EXPLANATION));
    }
    if let Some(explanation) = safety::explanation(result) {
        paragraph(&mut text, &explanation);
    }
    text
}

/// What was given and what was found; what finding it took, where that is told.
pub fn facts(result: &AnalysisResult, wall_time: Option<Duration>) -> Table {
    let mut table = bare();
    let mut fact = |name: &str, value: String| {
        table.add_row([name, &value]);
    };
    let (name, structure) = given::structure(&result.request);
    fact(name, structure);
    if let Some(shape) = shape::shape(result) {
        fact("shape", shape);
    }
    fact("stone", given::stone(&result.request));
    if let Some(altered) = given::altered_joints(&result.request.joint_overrides) {
        fact("joints altered", altered);
    }
    if let Some(mesh) = safety::mesh(&result.request.mesh) {
        fact("mesh", mesh);
    }
    for (name, value) in result.plan.iter().flat_map(plan::facts) {
        fact(name, value);
    }
    fact("fixed loads", given::loads(&result.request, false));
    fact("scaled loads", given::loads(&result.request, true));
    if result.request.loads.iter().any(|load| load.scaled) {
        let one = Digits(result.request.load_factor.intensity_per_unit);
        fact("", format!("(at load factor 1, which is intensity {one} {})", wording::unit(result)));
    }
    if let Some(factors) = &result.request.partial_factors {
        fact("partial factors", factors.words());
    }
    fact("outcome", word(&result.outcome));
    fact("method", word(&result.method));
    if let Some(worst) = &result.worst_position {
        fact("worst position", worst_position(worst));
    }
    for (name, value) in result.ends.iter().flat_map(|end| end_facts(result, end)) {
        fact(name, value);
    }
    fact("limit window", window::window(result));
    if let Some(range) = &result.thrust_range {
        let range = [range.lowest_kn_per_m, range.highest_kn_per_m];
        let soil = if result.structure.soil_resists() { ", with soil that resists" } else { "" };
        fact("thrust range", format!("{} kN/m{soil}", from_to(range)));
    }
    if let Some(width) = result.request.width_m {
        fact("over the width", over_width(result, width));
    }
    let of_survey = survey::facts(result);
    for (name, value) in moving::facts(result).into_iter().chain(safety::facts(result)).chain(of_survey) {
        fact(name, value);
    }
    for (name, value) in result.geometric_safety.iter().flat_map(geometric::facts) {
        fact(name, value);
    }
    if result.states_from == StatesFrom::DirectSolution {
        fact("states", "solved for one by one; the load path is followed from near collapse on".to_owned());
    }
    let Cost { events, factorisations, unknowns, .. } = &result.cost;
    fact("cost", format!("events: {events}, factorisations: {factorisations}, unknowns: {unknowns}"));
    if let Some(time) = wall_time {
        fact("time", format!("{:.3} ms", time.as_secs_f64() * 1e3));
    }
    table
}

fn worst_position(worst: &WorstPositionBody) -> String {
    let way = if worst.reversed { "offsets to the left" } else { "offsets to the right" };
    format!("x = {} m, {way}; of {} positions", Digits(worst.x_m), worst.curve.x_m.len())
}

/// Forces over the whole width.
fn over_width(result: &AnalysisResult, width: f64) -> String {
    // As in `end_facts`: an arch that falls as built has no load to fall at, and one that its fixed loads crush bears none.
    let falls = matches!(result.outcome, Outcome::Collapse | Outcome::StandsInWindow);
    let scaled = |end: &EndBody| {
        let [x, y] = [end.scaled_load.x_kn?, end.scaled_load.y_kn?].map(Digits);
        let at = if result.outcome == Outcome::StandsInWindow { wording::name(end) } else { "collapse" };
        let factored = if result.request.partial_factors.is_some() { "factored " } else { "" };
        Some(format!("; {factored}scaled loads at {at} ({x}, {y}) kN"))
    };
    let thrust = result
        .thrust_range
        .as_ref()
        .map(|range| format!("; thrust {} kN", from_to([range.lowest_kn, range.highest_kn])));
    let loads: String = result.ends.iter().filter(|_| falls).filter_map(scaled).collect();
    format!("{} m{loads}{}", Digits(width), thrust.unwrap_or_default())
}

fn from_to(ends: [Option<f64>; 2]) -> String {
    let [lowest, highest] = ends.map(|end| end.map_or("any".to_owned(), |end| Digits(end).to_string()));
    format!("{lowest} to {highest}")
}

fn end_facts(result: &AnalysisResult, end: &EndBody) -> Vec<(&'static str, String)> {
    let (unit, window) = (wording::unit(result), result.outcome == Outcome::StandsInWindow);
    let factor = |factor: f64| {
        if unit == "(load factor)" { String::new() } else { format!(" (load factor {})", Digits(factor)) }
    };
    let at = |intensity: f64, load_factor: f64| format!("{} {unit}{}", Digits(intensity), factor(load_factor));
    let name = match result.outcome {
        Outcome::StandsInWindow => wording::name(end),
        Outcome::Crushes if result.safety.is_none() => "without crushing",
        _ => "intensity",
    };
    let mut lines = Vec::new();
    // An arch that falls as built has no load to fall at.
    if window || matches!(result.outcome, Outcome::Collapse | Outcome::CannotTell | Outcome::Crushes) {
        lines.push((name, at(end.intensity, end.load_factor)));
        lines.extend(end.adequacy_factor.map(|factor| ("adequacy factor", adequacy(result, end, factor))));
        lines.extend(wording::sliding_range(end, unit).map(|range| ("range", range)));
        let other = end.instability.as_ref().filter(|_| end.governed_by == GovernedBy::Crushing);
        lines.extend(other.map(|other| ("without crushing", at(other.intensity, other.load_factor))));
    }
    lines.push(("mode", word(&end.fall.mechanism.mode)));
    // Where the fixed loads crush the stone, what follows is of stone that does not crush.
    if result.outcome != Outcome::Crushes || result.safety.is_some() {
        lines.push(("governed by", word(&end.governed_by)));
    }
    if !end.crushed_joints.is_empty() {
        lines.push(("joints that crush", joints::crushed(&end.crushed_joints, result.named())));
    }
    lines.extend(soil(&end.fall.passive_n_per_m, result).map(|soil| ("soil presses", soil)));
    lines.push(("residual", in_its_words(&result.request, &format!("{:.1e} of the arch's weight", end.residual))));
    lines
}

/// An adequacy factor, and what is not in it.
fn adequacy(result: &AnalysisResult, end: &EndBody, factor: f64) -> String {
    let less =
        result.updated_geometry.as_ref().and_then(|updated| updated.over_first_order).is_some_and(|over| over < 1.0);
    let not_in_it =
        if less && end.governed_by == GovernedBy::Crushing { ", as built: movement takes off more" } else { "" };
    format!("{} (1 and more is enough{not_in_it})", Digits(factor))
}

/// What passive elements press on either side.
pub fn soil(forces: &[f64], result: &AnalysisResult) -> Option<String> {
    let elements = &result.structure.passive_elements;
    let side = |direction: f64| {
        let pressing = |(element, force): &(&PassiveElementBody, &f64)| {
            element.direction == direction && **force > FULL * element.most_n_per_m
        };
        Digits(elements.iter().zip(forces).filter(pressing).map(|(_, force)| force / 1e3).sum())
    };
    let [right, left] = [1.0, -1.0].map(side);
    let full = elements.iter().zip(forces).filter(|(element, force)| **force >= (1.0 - FULL) * element.most_n_per_m);
    let full = format!("{} of {} elements at their limit", full.count(), elements.len());
    (!forces.is_empty()).then(|| format!("{right} kN/m to the right, {left} kN/m to the left; {full}"))
}

/// What words in the facts mean.
pub fn explanation(result: &AnalysisResult) -> String {
    let thrust = match (&result.thrust_range, result.structure.soil_resists()) {
        (None, _) => String::new(),
        (Some(_), false) => THRUST_RANGE.to_owned(),
        (Some(_), true) => format!("{THRUST_RANGE} {THRUST_WITH_SOIL}"),
    };
    format!("{} {thrust}", window::explanation(result)).trim_end().to_owned()
}

const THRUST_RANGE: &str = "Thrust range: horizontal force with which the left springing pushes the arch to the right under the \
     fixed loads alone; negative means to the left.";
const THRUST_WITH_SOIL: &str = "Soil that resists presses in it as equilibrium needs, up to its limits: without that resistance the \
     range is no wider, and may be empty.";

/// A table without lines.
pub fn bare() -> Table {
    let mut table = Table::new();
    table.load_style(presets::NOTHING);
    table
}

/// Adds a table, where there is one, under its title.
pub fn append(text: &mut String, title: &str, table: Option<Table>) {
    if let Some(table) = table {
        // Writing to a string cannot fail.
        let _ = write!(text, "\n{title}\n{}\n", table.trim_fmt());
    }
}

/// Adds prose.
pub fn paragraph(text: &mut String, words: &str) {
    let _ = write!(text, "\n{}\n", wording::wrapped(words));
}
