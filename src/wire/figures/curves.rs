//! Curves of an answer: load and displacement, the worst position, safety factors, and a settlement.

use crate::collapse::{Outcome, SafetyZone};
use crate::render::chart::{Chart, Curve, Place, Zone};
use crate::render::digits::Rounded;
use crate::wire::prose;
use crate::wire::request::AimRequest;
use crate::wire::response::{AnalysisResult, ReachBody, SafetyBody, SafetyCurveResult};

/// Up to here lengths are told in millimetres, m.
const MILLIMETRES: f64 = 1.0;

/// Intensity over displacement, where a load path was followed.
pub fn load_displacement(result: &AnalysisResult, title: &str) -> Option<Chart> {
    let history = &result.history;
    if history.intensity.len() < 2 {
        return None;
    }
    let largest = history.largest_m.iter().copied().fold(0.0, f64::max);
    let (per_metre, unit) = if largest < MILLIMETRES { (1e3, "mm") } else { (1.0, "m") };
    let curve = |name: &str, displacement: &dyn Fn(usize) -> f64| Curve {
        name: name.to_owned(),
        points: (0..history.intensity.len())
            .map(|i| (per_metre * displacement(i), Some(history.intensity[i])))
            .collect(),
        dotted: false,
    };
    let unit_of_load = prose::unit(result);
    let governs = governing(result);
    let words = governs.as_ref().map_or(String::new(), |(_, words)| {
        format!(
            " A horizontal line marks the load that governs: {words}. What of the curves lies beyond it is not borne."
        )
    });
    let stone = if result.request.crushing_in_path { "whose joints crush" } else { "that does not crush" };
    Some(Chart {
        title: title.to_owned(),
        caption: format!(
            "Load, and displacement from the structure without any load, on the load path of stone {stone}."
        ),
        abscissa: format!("displacement, {unit}"),
        ordinate: format!("intensity, {unit_of_load}"),
        curves: vec![
            curve("crown, downwards", &|i| -history.crown_y_m[i]),
            curve("largest of any stone", &|i| history.largest_m[i]),
        ],
        levels: governs.into_iter().collect(),
        description: format!(
            "Intensity from {} to {} {unit_of_load}; the largest displacement of a stone grows to {} {unit}.{words}",
            Rounded(history.intensity[0]),
            Rounded(history.intensity[history.intensity.len() - 1]),
            Rounded(per_metre * largest)
        ),
        ..Chart::default()
    })
}

/// The intensity that governs, and in words which it is, where there is one to hold the load path against.
fn governing(result: &AnalysisResult) -> Option<(f64, String)> {
    let end = result.ends.first()?;
    let first = if result.updated_geometry.is_some() { " governs at first order" } else { " governs" };
    let (at, governs) = match (&result.safety, result.outcome) {
        // A safety factor counts moving geometry, where that is asked for.
        (Some(SafetyBody { governing: ReachBody::At { load_factor }, governed_by, .. }), _) => {
            (load_factor * result.request.load_factor.intensity_per_unit, prose::word(governed_by) + " governs")
        }
        (None, Outcome::Collapse | Outcome::StandsInWindow) => (end.intensity, prose::word(&end.governed_by) + first),
        _ => return None,
    };
    Some((at, format!("{governs} at {} {}", Rounded(at), prose::unit(result))))
}

/// Intensities beyond so many times the least are not drawn: vehicles that are hardly on the structure may be of any weight.
const CEILING: f64 = 4.0;

/// The curve up to a height: where it leaves it is interrupted.
fn below(points: Vec<(f64, Option<f64>)>, ceiling: f64) -> Vec<(f64, Option<f64>)> {
    let inside = |point: &(f64, Option<f64>)| point.1.is_some_and(|y| y <= ceiling);
    let mut kept: Vec<(f64, Option<f64>)> = Vec::new();
    for (i, point) in points.iter().enumerate() {
        if let Some(before) = i.checked_sub(1).map(|before| points[before]).filter(|b| inside(b) != inside(point))
            && let (Some(y0), Some(y1)) = (before.1, point.1)
        {
            kept.push((before.0 + (point.0 - before.0) * ((ceiling - y0) / (y1 - y0)), Some(ceiling)));
        }
        kept.push(if inside(point) { *point } else { (point.0, None) });
    }
    kept
}

/// Intensity over the position of the vehicles.
pub fn worst_position(result: &AnalysisResult, title: &str) -> Option<Chart> {
    let worst = result.worst_position.as_ref()?;
    let (curve, unit) = (&worst.curve, prose::unit(result));
    let of = |name: &str, values: &[Option<f64>], reversed: bool| {
        let rows = (0..curve.x_m.len()).filter(|i| curve.reversed[*i] == reversed);
        let points = rows.map(|i| (curve.x_m[i], values[i])).collect();
        let ceiling = worst.intensity.map_or(f64::INFINITY, |least| CEILING * least);
        Curve { name: name.to_owned(), points: below(points, ceiling), dotted: false }
    };
    let all = [
        of("instability", &curve.instability, false),
        of("joints crush", &curve.crushing, false),
        of("instability, reversed", &curve.instability, true),
        of("joints crush, reversed", &curve.crushing, true),
    ];
    let told = |curve: &Curve| curve.points.iter().any(|point| point.1.is_some());
    let marks = worst.intensity.map(|intensity| Place {
        at: (worst.x_m, intensity),
        words: format!("{} {unit} at {} m", Rounded(intensity), Rounded(worst.x_m)),
    });
    Some(Chart {
        title: title.to_owned(),
        caption: "Intensity at which limit analysis has it fall, over the position of the vehicles, up to \
                  four times the least."
            .to_owned(),
        abscissa: "abscissa of the vehicles' reference, m".to_owned(),
        ordinate: format!("intensity, {unit}"),
        description: marks.iter().map(|mark| format!("The least is {}.", mark.words)).collect(),
        curves: all.into_iter().filter(told).collect(),
        marks: marks.into_iter().collect(),
        ..Chart::default()
    })
}

/// Safety factors over the abscissa that is asked for.
pub fn safety(result: &SafetyCurveResult) -> Chart {
    let of = |name: &str, dotted: bool, reach: &dyn Fn(&SafetyBody) -> Option<ReachBody>| {
        let factor = |safety: &SafetyBody| match reach(safety) {
            Some(ReachBody::At { load_factor }) => Some(load_factor),
            _ => None,
        };
        let points = result.points.iter().map(|point| (point.abscissa, factor(&point.safety))).collect();
        Curve { name: name.to_owned(), points, dotted }
    };
    let all = [
        of("instability", true, &|safety| Some(safety.instability)),
        of("joints crush (plastic sections)", true, &|safety| Some(safety.plastic_section)),
        of("first yield", true, &|safety| safety.elastic),
        of("instability on moving geometry", true, &|safety| safety.updated_geometry),
    ];
    let told = |curve: &Curve| curve.points.iter().any(|point| point.1.is_some());
    let curves: Vec<Curve> = all.into_iter().filter(told).collect();
    let name = result.request.name.as_deref().unwrap_or("Safety curve");
    let scaled = matches!(&result.request.analysis, AimRequest::Safety(_));
    Chart {
        title: name.to_owned(),
        caption: "Safety factors; a curve is interrupted where it does not happen or cannot be told.".to_owned(),
        abscissa: format!("abscissa, {}", result.unit),
        ordinate: "safety factor".to_owned(),
        description: format!("Safety factors at {} abscissae.", result.points.len()),
        curves,
        zones: zones(result),
        levels: scaled.then(|| (1.0, "full loads".to_owned())).into_iter().collect(),
        marks: Vec::new(),
    }
}

/// Bands between points of different zones; the border is taken half way.
fn zones(result: &SafetyCurveResult) -> Vec<Zone> {
    let mut points: Vec<(f64, Option<SafetyZone>)> =
        result.points.iter().map(|point| (point.abscissa, point.safety.zone)).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut all: Vec<(Option<SafetyZone>, [f64; 2])> = Vec::new();
    for (i, (x, zone)) in points.iter().enumerate() {
        let right = points.get(i + 1).map_or(*x, |next| 0.5 * (x + next.0));
        match all.last_mut() {
            Some((last, ends)) if last == zone => ends[1] = right,
            _ => {
                let left = i.checked_sub(1).map_or(*x, |before| 0.5 * (x + points[before].0));
                all.push((*zone, [left, right]));
            }
        }
    }
    let name = |zone: SafetyZone| match zone {
        SafetyZone::CrownRises => "I: crown rises",
        SafetyZone::Crushing => "II: crushing",
        SafetyZone::CrownDescends => "III: crown descends",
    };
    all.into_iter().filter_map(|(zone, ends)| Some(Zone { ends, name: name(zone?).to_owned() })).collect()
}

/// Forces of the ground over the share of the movement.
pub fn settlement(result: &AnalysisResult, title: &str) -> Option<Chart> {
    let history = &result.settlement.as_ref()?.first_order.history;
    let of = |name: &str, forces: &[f64]| Curve {
        name: name.to_owned(),
        points: history
            .share_of_movement
            .iter()
            .zip(forces)
            .map(|(share, force)| (*share, Some(force / 1e3)))
            .collect(),
        dotted: false,
    };
    let thrust = history.thrust_n_per_m.as_deref().map(|forces| of("thrust", forces));
    let left = history.left_reaction_n_per_m.as_deref().map(|forces| of("vertical reaction at the left", forces));
    let curves: Vec<Curve> = thrust.into_iter().chain(left).collect();
    (!curves.is_empty() && history.share_of_movement.len() > 1).then(|| Chart {
        title: title.to_owned(),
        caption: "Thrust and reaction of the left springing as the supports move, at first order.".to_owned(),
        abscissa: "share of the movement".to_owned(),
        ordinate: "force, kN/m".to_owned(),
        description: "Forces of the ground over the share of the movement.".to_owned(),
        curves,
        ..Chart::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_leaves_the_drawing_where_it_crosses_the_ceiling() {
        let points = vec![
            (0.0, Some(30.0)),
            (1.0, Some(10.0)),
            (2.0, Some(2.0)),
            (3.0, None),
            (4.0, Some(6.0)),
            (5.0, Some(9.0)),
        ];
        let kept = below(points, 8.0);
        let expected = [
            (0.0, None),
            (1.0, None),
            (1.25, Some(8.0)),
            (2.0, Some(2.0)),
            (3.0, None),
            (4.0, Some(6.0)),
            (4.0 + 2.0 / 3.0, Some(8.0)),
            (5.0, None),
        ];
        assert_eq!(kept.len(), expected.len());
        for (a, b) in kept.iter().zip(expected) {
            assert!((a.0 - b.0).abs() < 1e-12 && a.1.is_some() == b.1.is_some(), "{a:?} {b:?}");
            assert!(a.1.zip(b.1).is_none_or(|(a, b)| (a - b).abs() < 1e-12), "{a:?} {b:?}");
        }
    }
}
