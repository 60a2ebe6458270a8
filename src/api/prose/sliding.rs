//! From where to where the load of an arch whose joints slide may lie.

use crate::api::prose::Digits;
use crate::api::response::Collapse;

/// What it may bear beyond the least, in a sentence; nothing where that is the same.
pub fn sentence(collapse: &Collapse, unit: &str) -> String {
    match open(collapse) {
        None => String::new(),
        Some((_, None)) => " As its joints slide, it may also stand at any load beyond.".to_owned(),
        Some((_, Some(greatest))) => {
            format!(" As its joints slide, it may also stand as far as {} {unit}.", Digits(greatest))
        }
    }
}

/// Both ends in a table of facts; none where they are the same.
pub fn fact(collapse: &Collapse, unit: &str) -> Option<String> {
    let (least, greatest) = open(collapse)?;
    Some(match greatest {
        Some(greatest) => format!("{} to {} {unit}, as joints slide", Digits(least), Digits(greatest)),
        None => format!("{} {unit} and beyond, as joints slide", Digits(least)),
    })
}

/// Least and greatest intensity, where these differ visibly.
fn open(collapse: &Collapse) -> Option<(f64, Option<f64>)> {
    let range = collapse.range.as_ref()?;
    let same = range.greatest.is_some_and(|greatest| Digits(greatest).to_string() == Digits(range.least).to_string());
    (!same).then_some((range.least, range.greatest))
}
