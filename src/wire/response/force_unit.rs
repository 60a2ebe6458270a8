//! Whether intensities in a unit of force are of the size of the scaled loads.

use crate::wire::prose::Digits;
use crate::wire::request::{AnalysisRequest, LoadEntry, LoadRequest};

/// Labels of forces, N.
const FORCES: [(&str, f64); 6] = [("N", 1.0), ("N/m", 1.0), ("kN", 1e3), ("kN/m", 1e3), ("MN", 1e6), ("MN/m", 1e6)];

/// Intensities that are so many times the loads, or so many times less, are taken for a slip: one of many loads, a load on a metre
/// of the span, or on the whole width, may be meant.
const SLIP: f64 = 30.0;

/// Note on intensities in a unit of force that the scaled loads are far from.
pub(super) fn note(request: &AnalysisRequest) -> Option<String> {
    let label: &str = &request.load_factor.unit;
    let (_, unit) = FORCES.into_iter().find(|(force, _)| *force == label)?;
    let scaled: Vec<&LoadEntry> = request.loads.iter().filter(|entry| entry.scaled).collect();
    let forces: Vec<f64> = scaled.iter().map(|entry| force(entry)).collect::<Option<_>>()?;
    let (one, width) = (request.load_factor.intensity_per_unit, request.width_m.unwrap_or(1.0));
    let (said, sum) = (one.abs() * unit, forces.iter().sum::<f64>());
    let spread = scaled.iter().zip(&forces).map(|(entry, force)| force / strip(entry).max(1.0));
    let least = spread.reduce(f64::min)? * width.min(1.0);
    let slip = said * SLIP <= least || said >= SLIP * sum * width.max(1.0);
    slip.then(|| {
        format!(
            "Is the unit right? At load factor 1 the intensity is {} {label}, but the scaled loads are {} kN per metre of width. \
             load_factor.intensity_per_unit is the intensity at load factor 1.",
            Digits(one),
            Digits(sum / 1e3)
        )
    })
}

/// The size of a load that is one force at load factor 1, N/m; none of others, whose intensity may be anything.
fn force(entry: &LoadEntry) -> Option<f64> {
    let force = match &entry.load {
        LoadRequest::PointLoad(point) => point.force_n_per_m.abs(),
        LoadRequest::PatchLoad(patch) => patch.force_n_per_m.abs(),
        LoadRequest::PointForce(point) => point.force_n_per_m.0[0].hypot(point.force_n_per_m.0[1]),
        _ => return None,
    };
    (!entry.per_abscissa).then_some(entry.coefficient.abs() * force)
}

/// Length of the span that a load is spread over, m.
fn strip(entry: &LoadEntry) -> f64 {
    if let LoadRequest::PatchLoad(patch) = &entry.load { patch.width_m } else { 0.0 }
}
