//! The answer as a person reads it.

use comfy_table::{Table, presets};
use serde::Serialize;
use std::fmt::{self, Display, Write};
use std::time::Duration;
use voussoir::api::response::{AnalysisResult, Collapse, HingeBody, OutcomeWord, SlideBody};

/// Everything but the rows of numbers per stone and joint.
pub fn summary(result: &AnalysisResult, wall_time: Duration) -> String {
    let mut text = format!("{}\n\n{}\n", headline(result), facts(result, wall_time).trim_fmt());
    append(&mut text, "Hinges", hinges(&result.hinges));
    append(&mut text, "Slides", slides(&result.slides));
    if let Some(other) = &result.other_end {
        let collapse = &other.collapse;
        let end = format!("Other end: {} ({})", intensity(collapse), word(&collapse.mode));
        append(&mut text, &end, hinges(&other.hinges));
        append(&mut text, "Slides at the other end", slides(&other.slides));
    }
    for note in &result.notes {
        // Writing to a string cannot fail.
        let _ = write!(text, "\nNote: {note}\n");
    }
    text
}

/// One sentence.
fn headline(result: &AnalysisResult) -> String {
    let at = result.collapse.as_ref().map(intensity);
    match (result.outcome, at) {
        (OutcomeWord::Collapse, Some(at)) => format!("The arch collapses at {at}."),
        (OutcomeWord::Crushes, Some(at)) => format!("The stone crushes at {at}."),
        (OutcomeWord::StandsInWindow, Some(at)) => {
            format!("The arch does not stand without its load; with it, it stands up to {at}.")
        }
        (OutcomeWord::FallsAsBuilt, _) => "The arch falls as built.".to_owned(),
        (OutcomeWord::NeverCollapses, _) => {
            format!("The arch does not collapse, up to load factor {}.", Digits(result.cap))
        }
        (outcome, _) => format!("Outcome: {}.", word(&outcome)),
    }
}

fn facts(result: &AnalysisResult, wall_time: Duration) -> Table {
    let mut table = bare();
    let mut fact = |name: &str, value: String| {
        table.add_row([name, &value]);
    };
    fact("outcome", word(&result.outcome));
    fact("method", word(&result.method));
    if let Some(collapse) = &result.collapse {
        fact("intensity", intensity(collapse));
        fact("load factor", Digits(collapse.load_factor).to_string());
        fact("mode", word(&collapse.mode));
        fact("governed by", word(&collapse.governed_by));
        fact("residual", format!("{:.1e} of the arch's weight", collapse.residual));
    }
    if let Some([lowest, highest]) = result.limit_window {
        fact("limit window", format!("{} to {} {}", end(lowest), end(highest), result.unit));
    }
    if let Some(range) = &result.thrust_range {
        let (lowest, highest) = (Digits(range.lowest_n_per_m), Digits(range.highest_n_per_m));
        fact("thrust range", format!("{lowest} to {highest} N/m"));
    }
    let cost = &result.cost;
    let counts = (cost.events, cost.factorisations, cost.unknowns);
    fact("cost", format!("{} events, {} factorisations, {} unknowns", counts.0, counts.1, counts.2));
    fact("time", format!("{:.3} ms", wall_time.as_secs_f64() * 1e3));
    table
}

fn hinges(hinges: &[HingeBody]) -> Option<Table> {
    let mut table = bare();
    table.set_header(["joint", "face", "from springing, deg", "from crown, deg", "rotation"]);
    table.add_rows(hinges.iter().map(|hinge| {
        [
            hinge.joint.to_string(),
            word(&hinge.face),
            format!("{:.2}", hinge.angle_from_springing_deg),
            format!("{:.2}", hinge.angle_from_crown_deg),
            format!("{:.4}", hinge.rotation),
        ]
    }));
    (!hinges.is_empty()).then_some(table)
}

fn slides(slides: &[SlideBody]) -> Option<Table> {
    let mut table = bare();
    table.set_header(["joint", "rate"]);
    table.add_rows(slides.iter().map(|slide| [slide.joint.to_string(), format!("{:.4}", slide.rate)]));
    (!slides.is_empty()).then_some(table)
}

fn bare() -> Table {
    let mut table = Table::new();
    table.load_style(presets::NOTHING);
    table
}

fn append(text: &mut String, title: &str, table: Option<Table>) {
    if let Some(table) = table {
        // Writing to a string cannot fail.
        let _ = write!(text, "\n{title}\n{}\n", table.trim_fmt());
    }
}

fn intensity(collapse: &Collapse) -> String {
    format!("{} {}", Digits(collapse.intensity), collapse.unit)
}

fn end(end: Option<f64>) -> String {
    end.map_or_else(|| "unbounded".to_owned(), |end| Digits(end).to_string())
}

/// A word of the wire, with spaces.
fn word(word: &impl Serialize) -> String {
    let value = serde_json::to_value(word).unwrap_or_default();
    value.as_str().unwrap_or_default().replace('_', " ")
}

/// A number with eight digits that count.
struct Digits(f64);

impl Display for Digits {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        if size != 0.0 && !(1e-4..1e8).contains(&size) {
            return write!(out, "{:.7e}", self.0);
        }
        let mut decimals = 7;
        let mut bound = 10.0;
        while size >= bound && decimals > 0 {
            (decimals, bound) = (decimals - 1, bound * 10.0);
        }
        write!(out, "{:.*}", decimals, self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eight_digits() {
        for (value, expected) in [
            (247.1234567891, "247.12346"),
            (0.0, "0.0000000"),
            (-12.0, "-12.000000"),
            (99999999.0, "99999999"),
            (1e9, "1.0000000e9"),
            (3.5e-7, "3.5000000e-7"),
        ] {
            assert_eq!(Digits(value).to_string(), expected);
        }
    }
}
