//! Surveyed points and their tolerances in words.

use super::joints::table;
use super::wording::{self, word};
use crate::wire::prose::{Digits, Rounded};
use crate::wire::response::{AnalysisResult, LimitBody, MovedPointBody, MovedPointColumns, SurveyToleranceBody};
use crate::wire::translate::Smoothing;
use comfy_table::Table;
use std::fmt::Display;

/// Most points that are listed.
const POINTS_LISTED: usize = 8;

/// What smoothing has moved.
pub fn smoothed(smoothing: &Smoothing) -> String {
    let Smoothing { length, largest, at: (face, joint), mean } = smoothing;
    let [length, largest, mean] = [length, largest, mean].map(|length| Digits(*length));
    format!(
        "Surveyed points are smoothed over {length} m. Smoothing moves them by {mean} m on average and by {largest} m at most, at \
         point {joint} of the {face}, along the normal."
    )
}

/// What was solved, and what of it is not proven.
pub fn moved(solved: usize, settled: bool) -> String {
    let lowest = match settled {
        true => "no single point moved from there lowers it",
        false => "the search was left before no single point moved lowers it",
    };
    format!(
        "Limit analysis, in which sliding joints dilate, was asked of {solved} surveys, each with stones and loads of its own. All \
         points at their worst are those of one survey within the tolerances: {lowest}, but that no other is lower is not proven."
    )
}

/// What is not known of some points.
pub fn unknown(count: usize) -> String {
    format!(
        "Of {count} surveys with one point moved there is no answer: the arch cannot be set out, or rounding kept limit analysis from \
         it. Lowest and highest are those of the others."
    )
}

/// A sentence behind the headline.
pub fn sentence(survey: &SurveyToleranceBody, unit: &str) -> String {
    let (Some(lowest), Some(highest)) = (&survey.lowest, &survey.highest) else { return String::new() };
    let at = |limit: LimitBody| shown(limit, unit, Rounded);
    let range = match (lowest.limit, highest.limit) {
        (LimitBody::At { intensity: a, .. }, LimitBody::At { intensity: b, .. }) => {
            format!("{} to {} {unit}", Rounded(a), Rounded(b))
        }
        (lowest, highest) => format!("{} to {}", at(lowest), at(highest)),
    };
    let worst = at(survey.all_at_worst);
    format!(" With one point moved within its tolerance limit analysis gives {range}, with all at their worst {worst}.")
}

/// Name and value of every line about tolerances.
pub fn facts(result: &AnalysisResult) -> Vec<(&'static str, String)> {
    let Some(survey) = &result.survey_tolerance else { return Vec::new() };
    let unit = wording::unit(result);
    let moved = |of: &MovedPointBody| {
        let way = if of.outwards_m > 0.0 { "outwards" } else { "inwards" };
        let by = Digits(of.outwards_m.abs());
        format!("{} with point {} of the {} {by} m {way}", shown(of.limit, unit, Digits), of.joint, word(&of.face))
    };
    let unknown = || "not known".to_owned();
    let first_order = survey.first_order_load_factor.map(|at| {
        let at = at * result.request.load_factor.intensity_per_unit;
        format!("; at first order {} {unit}", Digits(at))
    });
    vec![
        ("as surveyed", format!("{} by limit analysis", shown(survey.as_surveyed, unit, Digits))),
        ("one point moved", survey.lowest.as_ref().map_or_else(unknown, |of| format!("lowest {}", moved(of)))),
        ("", survey.highest.as_ref().map_or_else(unknown, |of| format!("highest {}", moved(of)))),
        (
            "all at their worst",
            format!("{}{}", shown(survey.all_at_worst, unit, Digits), first_order.unwrap_or_default()),
        ),
    ]
}

/// The points on which the load depends most.
pub fn points(survey: &SurveyToleranceBody) -> Option<Table> {
    let points = &survey.points;
    let range = |k: &usize| match (points.outwards[*k], points.inwards[*k]) {
        (LimitBody::At { intensity: a, .. }, LimitBody::At { intensity: b, .. }) => (a - b).abs(),
        _ => f64::INFINITY,
    };
    let mut order: Vec<usize> = (0..points.joint.len()).collect();
    order.sort_by(|a, b| range(b).total_cmp(&range(a)));
    order.truncate(POINTS_LISTED);
    table(
        ["joint", "face", "tolerance, m", "outwards", "inwards", "at worst, m"],
        order.into_iter().map(|k| row(points, k)).collect(),
    )
}

fn row(points: &MovedPointColumns, k: usize) -> [String; 6] {
    let intensity = |limit: LimitBody| match limit {
        LimitBody::At { intensity, .. } => Digits(intensity).to_string(),
        LimitBody::NoEnd => "any".to_owned(),
        LimitBody::NoEquilibrium => "falls at any".to_owned(),
        LimitBody::Unknown => "not known".to_owned(),
    };
    [
        points.joint[k].to_string(),
        word(&points.face[k]),
        Digits(points.tolerance_m[k]).to_string(),
        intensity(points.outwards[k]),
        intensity(points.inwards[k]),
        Digits(points.at_worst_m[k]).to_string(),
    ]
}

fn shown<D: Display>(limit: LimitBody, unit: &str, digits: fn(f64) -> D) -> String {
    match limit {
        LimitBody::At { intensity, .. } => format!("{} {unit}", digits(intensity)),
        LimitBody::NoEnd => "any load".into(),
        LimitBody::NoEquilibrium => "no equilibrium at any load".into(),
        LimitBody::Unknown => "not known".into(),
    }
}
