//! The answer as a person reads it.

use super::noun::in_its_words;
use super::wording::{self, LimitEnd, word};
use super::{given, joints, moving, plan, safety, sliding};
use crate::api::prose::Digits;
use crate::api::response::AnalysisResult;
use crate::collapse::Outcome;
use comfy_table::{Table, presets};
use std::fmt::Write;
use std::time::Duration;

/// Everything but the rows of numbers per stone and joint.
pub fn summary(result: &AnalysisResult, wall_time: Duration) -> String {
    let name = result.request.name.as_ref().map(|name| format!("{name}\n\n")).unwrap_or_default();
    let headline = wording::wrapped(&wording::headline(result));
    let mut text = format!("{name}{headline}\n\n{}\n", facts(result, wall_time).trim_fmt());
    let structure = result.named();
    if result.outcome == Outcome::StandsInWindow {
        for (name, limit) in ["Lower", "Upper"].into_iter().zip(wording::limits(result)) {
            window_end(&mut text, name, limit, result);
        }
    } else {
        append(&mut text, "Hinges", joints::hinges(&result.hinges, structure));
        append(&mut text, "Sliding joints", joints::slides(&result.slides, structure));
        append(&mut text, "Joints that part altogether", joints::lift_offs(&result.lift_offs, structure));
    }
    let at = if result.outcome == Outcome::StandsInWindow {
        format!("the {}", wording::shown(result))
    } else {
        "the end of the path".to_owned()
    };
    let (name, outer) = joints::outer(result);
    append(&mut text, &format!("{name} at {at}, forces per metre of depth"), outer);
    let of_safety = result.safety.iter().flat_map(|safety| &safety.notes);
    for (name, motion) in [("", &result.motion), (" from the other end", &result.other_motion)] {
        if let Some(motion) = motion {
            paragraph(&mut text, &wording::motion(name, motion, wording::unit(result)));
        }
    }
    for why in result.plan.iter().flat_map(|plan| &plan.why) {
        paragraph(&mut text, &format!("Model: {why}"));
    }
    for note in result.notes.iter().chain(of_safety.filter(|note| !result.notes.contains(note))) {
        paragraph(&mut text, &format!("Note: {note}"));
    }
    paragraph(&mut text, &in_its_words(&result.request, explanation(result)));
    if result.crushing.is_some() {
        paragraph(&mut text, safety::EXPLANATION);
    }
    text
}

fn facts(result: &AnalysisResult, wall_time: Duration) -> Table {
    let mut table = bare();
    let mut fact = |name: &str, value: String| {
        table.add_row([name, &value]);
    };
    let (name, structure) = given::structure(&result.request);
    fact(name, structure);
    if let Some(mesh) = safety::mesh(&result.request.mesh) {
        fact("mesh", mesh);
    }
    for (name, value) in result.plan.iter().flat_map(plan::facts) {
        fact(name, value);
    }
    fact("fixed loads", given::loads(&result.request.loads, false));
    fact("scaled loads", given::loads(&result.request.loads, true));
    if result.request.loads.iter().any(|load| load.scaled) {
        let one = Digits(result.request.load_factor.intensity_per_unit);
        fact("", format!("(at load factor 1, which is intensity {one} {})", wording::unit(result)));
    }
    fact("outcome", word(&result.outcome));
    fact("method", word(&result.method));
    for (name, value) in collapse_facts(result) {
        fact(name, value);
    }
    fact("limit window", wording::window(result));
    if let Some(range) = &result.thrust_range {
        let words = |thrust: f64| Digits(thrust / 1e3).to_string();
        let [lowest, highest] =
            [range.lowest_n_per_m, range.highest_n_per_m].map(|end| end.map_or("any".to_owned(), words));
        fact("thrust range", format!("{lowest} to {highest} kN per metre of depth"));
    }
    for (name, value) in moving::facts(result).into_iter().chain(safety::facts(result)) {
        fact(name, value);
    }
    let cost = &result.cost;
    let counts = (cost.events, cost.factorisations, cost.unknowns);
    fact("cost", format!("{} events, {} factorisations, {} unknowns", counts.0, counts.1, counts.2));
    fact("time", format!("{:.3} ms", wall_time.as_secs_f64() * 1e3));
    table
}

fn collapse_facts(result: &AnalysisResult) -> Vec<(&'static str, String)> {
    let mut lines = Vec::new();
    if let Some(collapse) = &result.collapse {
        // An arch that falls as built has no load to fall at; a window has two.
        if matches!(result.outcome, Outcome::Collapse | Outcome::CannotTell) {
            lines.push(("intensity", wording::intensity(result, collapse)));
            lines.push(("load factor", Digits(collapse.load_factor).to_string()));
            lines.extend(sliding::fact(collapse, wording::unit(result)).map(|range| ("range", range)));
        }
        if result.outcome != Outcome::StandsInWindow {
            lines.push(("mode", word(&collapse.mode)));
        }
        if result.safety.is_none() {
            lines.push(("governed by", word(&collapse.governed_by)));
        }
        if !result.crushed_joints.is_empty() {
            lines.push(("joints that crush", joints::crushed(&result.crushed_joints)));
        }
        lines.push((
            "residual",
            in_its_words(&result.request, &format!("{:.1e} of the arch's weight", collapse.residual)),
        ));
    }
    lines
}

fn explanation(result: &AnalysisResult) -> &'static str {
    match result.thrust_range {
        Some(_) => {
            "Limit window: what rigid-block limit analysis allows. Thrust range: horizontal force with which the left \
             springing pushes the arch to the right under the fixed loads alone; negative means to the left."
        }
        None => "Limit window: what rigid-block limit analysis allows.",
    }
}

fn window_end(text: &mut String, name: &str, limit: Option<LimitEnd<'_>>, result: &AnalysisResult) {
    let Some(limit) = limit else {
        return paragraph(text, &format!("{name} end: none was found."));
    };
    let (collapse, structure) = (limit.collapse, result.named());
    let at = wording::intensity(result, collapse);
    let range = sliding::fact(collapse, wording::unit(result)).map(|range| format!(" ({range})")).unwrap_or_default();
    append(
        text,
        &format!("{name} end: {at}{range}, {}", word(&collapse.mode)),
        joints::hinges(limit.hinges, structure),
    );
    let end = format!("at the {} end", name.to_lowercase());
    append(text, &format!("Sliding joints {end}"), joints::slides(limit.slides, structure));
    append(text, &format!("Joints that part altogether {end}"), joints::lift_offs(limit.lift_offs, structure));
}

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
