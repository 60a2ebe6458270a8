//! What limit analysis allows, in words.

use super::wording::{has, unit};
use crate::collapse::Direction;
use crate::wire::prose::Digits;
use crate::wire::request::{LoadEntry, LoadRequest};
use crate::wire::response::AnalysisResult;

/// A window of intensities: its lower and its upper end, each none where unbounded.
type Window = [Option<f64>; 2];

/// What limit analysis allows, where it has an answer.
pub fn window(result: &AnalysisResult) -> String {
    match (&result.proof, has(result, true), result.limit_window) {
        (None, ..) => "not known: limit analysis gave no answer".to_owned(),
        (_, true, ends) => range(result, ends),
        (_, false, Some(_)) => "stands; no load is scaled, so nothing grows".to_owned(),
        (_, false, None) => "finds no equilibrium".to_owned(),
    }
}

/// From where to where an arch stands; of vehicles from 0.
pub fn range(result: &AnalysisResult, ends: Option<Window>) -> String {
    let unit = unit(result);
    let told = ends.map(|[low, high]| if pulls_up(result, [low, high]) { [Some(0.0), high] } else { [low, high] });
    match told.map(|ends| ends.map(|end| end.map(Digits))) {
        None => "finds no equilibrium at any intensity".to_owned(),
        Some([Some(low), Some(high)]) => format!("stands from {low} to {high} {unit}"),
        Some([Some(low), None]) => format!("stands from {low} {unit} upwards without end"),
        Some([None, Some(high)]) => format!("stands up to {high} {unit}, and downwards without end"),
        Some([None, None]) => "stands at any intensity".to_owned(),
    }
}

/// Whether vehicles would have to pull up at the lower end of a window although they are asked to press down.
pub fn pulls_up(result: &AnalysisResult, [low, high]: Window) -> bool {
    let vehicle =
        |entry: &LoadEntry| entry.scaled && entry.coefficient > 0.0 && matches!(entry.load, LoadRequest::Vehicle(_));
    let pressing = result.request.load_factor.direction == Direction::Increase;
    let below = low.is_none_or(|low| low < 0.0) && high.is_none_or(|high| high >= 0.0);
    pressing && below && result.request.loads.iter().any(vehicle)
}

/// What a limit window is, and what its end below 0 means.
pub fn explanation(result: &AnalysisResult) -> String {
    let ends = result.limit_window.filter(|_| has(result, true));
    let below = match ends {
        Some(ends) if pulls_up(result, ends) => "; it is told from 0, since no vehicle pulls up",
        Some([low, _]) if low.is_none_or(|low| low < 0.0) => "; below 0 its scaled loads are reversed",
        _ => "",
    };
    format!("Limit window: what rigid-block limit analysis allows{below}.")
}
