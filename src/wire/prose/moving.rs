//! Moving geometry and moving supports in words.

use super::joints;
use super::noun::in_its_words;
use super::settlement::{movements, movers, open_joints};
use super::summary::{append, soil};
use super::wording::{self, word};
use crate::collapse::{SettlementEnd, UpdatedEnd};
use crate::wire::prose::{Digits, Rounded};
use crate::wire::request::AnalysisRequest;
use crate::wire::response::{AnalysisResult, EndBody, SettlementBody, SettlementPathBody, UpdatedBody};

/// Moving geometry that leaves so much of the first-order load takes nothing off it that matters.
const WORTH_TELLING: f64 = 0.995;

/// One sentence on supports that move.
pub fn headline(request: &AnalysisRequest, settlement: &SettlementBody) -> String {
    let path = settlement.updated_geometry.as_ref().unwrap_or(&settlement.first_order);
    let share = format!("{} %", Rounded(100.0 * path.share_of_movement));
    let (who, several) = movers(request);
    let [have, their, they, moves] =
        if several { ["have", "their", "they", "move"] } else { ["has", "its", "that", "moves"] };
    match (path.end, &settlement.updated_geometry) {
        (SettlementEnd::Follows, Some(_)) => {
            format!("The arch follows {who} through the whole movement{}.", snaps(path))
        }
        (SettlementEnd::Follows, None) => {
            format!("At first order the arch follows {who}; only on updated geometry can {they} bring it down.")
        }
        (SettlementEnd::Collapse, _) => {
            format!("The arch falls when {who} {have} done {share} of {their} movement{}.", snaps(path))
        }
        (SettlementEnd::FallsAsLoaded, _) => {
            format!("On updated geometry the arch falls under its loads before {who} {moves}.")
        }
        (SettlementEnd::CannotTell, _) => {
            let safe = Rounded(100.0 * path.safe_share_of_movement);
            format!("No answer: the movement could not be followed beyond {safe} % of it.")
        }
    }
}

/// Half a sentence on the first snap, where there is one.
fn snaps(path: &SettlementPathBody) -> String {
    let words = |at: f64| {
        format!(", but first snaps into another shape at {} %: rely on no more than that", Rounded(100.0 * at))
    };
    path.snap_share_of_movement.map(words).unwrap_or_default()
}

/// Why there is no answer, after a colon.
fn because(why: Option<&String>) -> String {
    why.map(|why| format!(": {}", why.trim_end_matches('.'))).unwrap_or_default()
}

/// Sentences on moving geometry, where it bears less than the first order does.
pub fn before(result: &AnalysisResult, end: &EndBody) -> String {
    let Some(updated) = &result.updated_geometry else { return String::new() };
    let unit = wording::unit(result);
    let lower =
        |at: f64| at.abs() < end.intensity.abs() && Rounded(at).to_string() != Rounded(end.intensity).to_string();
    let snap = updated.snap_intensity.filter(|at| lower(*at)).map(|at| {
        format!(" Before it falls, on moving geometry it snaps into another shape at {} {unit}.", Rounded(at))
    });
    let falls = match (updated.end, updated.intensity) {
        (UpdatedEnd::FallsAsLoaded, _) => {
            " On moving geometry it falls before the loads at the start of its path are on in full.".to_owned()
        }
        (UpdatedEnd::Collapse, Some(at)) if lower(at) => {
            format!(" On moving geometry it collapses at {} {unit} already.", Rounded(at))
        }
        _ => String::new(),
    };
    let softened = updated.over_first_order.filter(|share| end.without_crushing.is_some() && *share < WORTH_TELLING);
    let apart = softened.map(|share| {
        format!(
            " Moving geometry leaves out crushing, and no figure has both: alone it takes {} % off the load of stone that does not crush.",
            Rounded(100.0 * (1.0 - share))
        )
    });
    falls + &apart.unwrap_or_default() + &snap.unwrap_or_default()
}

/// What the ground carries, and where the structure turns, as its supports move.
pub fn supports(text: &mut String, result: &AnalysisResult) {
    let Some(settlement) = &result.settlement else { return };
    let path = settlement.updated_geometry.as_ref().unwrap_or(&settlement.first_order);
    let which = if settlement.updated_geometry.is_some() { "on moving geometry" } else { "at first order" };
    joints::moving(text, &format!(" at the end of the movement, {which}"), &path.mechanism, result);
    let title = format!("Open joints at the end of the movement, {which}");
    append(text, &title, open_joints(&path.open_joints, result.named().is_some()));
    let history = &path.history;
    let force = |column: Option<&Vec<f64>>, last: bool| {
        let value = column.and_then(|column| if last { column.last() } else { column.first() });
        value.map_or("-".to_owned(), |force| Digits(force / 1e3).to_string())
    };
    let row = |name: &str, x: Option<&Vec<f64>>, y: Option<&Vec<f64>>| {
        [name.to_owned(), force(x, false), force(y, false), force(x, true), force(y, true)]
    };
    let right =
        history.right_reaction_n_per_m.as_ref().and_then(|column| column.iter().copied().collect::<Option<Vec<_>>>());
    let left = history.left_reaction_n_per_m.as_ref();
    let mut rows: Vec<_> =
        left.map(|left| row("left springing", history.thrust_n_per_m.as_ref(), Some(left))).into_iter().collect();
    rows.extend(right.as_ref().map(|right| row("right springing", history.right_thrust_n_per_m.as_ref(), Some(right))));
    let named = history.supports.iter();
    rows.extend(named.map(|of| row(&of.support, Some(&of.rightwards_n_per_m), Some(&of.upwards_n_per_m))));
    let title = format!(
        "Forces of the supports on the arch before the movement and at its end, {which}, kN/m (x to the right, y upwards)"
    );
    append(
        text,
        &in_its_words(&result.request, &title),
        joints::table(["support", "x before", "y before", "x at the end", "y at the end"], rows),
    );
}

/// Name and value of every line about moving geometry and moving supports.
pub fn facts(result: &AnalysisResult) -> Vec<(&'static str, String)> {
    let mut lines = Vec::new();
    if let Some(updated) = &result.updated_geometry {
        lines.push(("moving geometry", on_moving_geometry(result, updated)));
    }
    if let Some(settlement) = &result.settlement {
        lines.extend(movements(&result.request).map(|asked| ("movement", asked)));
        let first_order = [("first order", &settlement.first_order)];
        let moving = settlement.updated_geometry.as_ref().map(|updated| ("moving geometry", updated));
        for (name, followed) in first_order.into_iter().chain(moving) {
            lines.push((name, path(followed)));
            lines.extend(soil(&followed.passive_n_per_m, result).map(|soil| ("soil presses", soil)));
        }
    }
    lines
}

fn on_moving_geometry(result: &AnalysisResult, updated: &UpdatedBody) -> String {
    let at = updated.intensity.map(|at| format!("{} {}", Digits(at), wording::unit(result))).unwrap_or_default();
    let crushes = result.ends.iter().any(|end| end.without_crushing.is_some());
    let uncrushed = if crushes { " of stone that does not crush" } else { "" };
    match updated.end {
        UpdatedEnd::Collapse => {
            let over =
                updated.over_first_order.map(|over| format!(", {} of the first-order load{uncrushed}", Digits(over)));
            let snap =
                updated.snap_intensity.map(|at| format!("; snaps first at {} {}", Digits(at), wording::unit(result)));
            let mode = updated.mechanism.as_ref().map(|of| format!(" ({})", word(&of.mode))).unwrap_or_default();
            format!("collapse at {at}{mode}{}{}", over.unwrap_or_default(), snap.unwrap_or_default())
        }
        UpdatedEnd::FallsAsLoaded => {
            let share =
                updated.share_of_loads.map(|share| format!("{} % of ", Digits(100.0 * share))).unwrap_or_default();
            format!("falls under {share}the loads at the start of the path")
        }
        UpdatedEnd::StandsToCap if at.is_empty() => "stands".into(),
        UpdatedEnd::StandsToCap => format!("stands up to {at}, the cap"),
        UpdatedEnd::BeyondModel => format!("stands up to {at}, where it is strained or moved beyond the model"),
        UpdatedEnd::CannotTell => format!("could not be followed{}", because(updated.why.as_ref())),
    }
}

fn path(path: &SettlementPathBody) -> String {
    let share = Digits(100.0 * path.share_of_movement);
    let thrust = path.thrust_n_per_m.map(|thrust| format!("; thrust then {} kN/m", Digits(thrust / 1e3)));
    let end = match path.end {
        SettlementEnd::Follows => "follows the whole movement".to_owned(),
        SettlementEnd::Collapse => format!("falls at {share} % of the movement"),
        SettlementEnd::FallsAsLoaded => return "falls under its loads before any movement".to_owned(),
        SettlementEnd::CannotTell => format!("lost after {share} % of the movement{}", because(path.why.as_ref())),
    };
    let safe = Digits(100.0 * path.safe_share_of_movement);
    let snap = if path.snap_share_of_movement.is_some() { format!("; snaps first at {safe} %") } else { String::new() };
    format!("{end}{}{snap}", thrust.unwrap_or_default())
}
