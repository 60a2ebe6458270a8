//! Safety analyses of a request, alone or along a curve.

use super::site::Unloaded;
use super::{loads, mesh};
use crate::collapse::{CurvePoint, Direction};
use crate::wire::fault::{Fault, Faults, Shown, lies_under};
use crate::wire::request::{Abscissa, AnalysisRequest, CurveRequest, LoadEntry};
use std::collections::BTreeSet;

/// Most subblocks at all abscissae of a curve together.
const MAX_CURVE_SUBBLOCKS: usize = 1_000_000;

/// Most forces at all abscissae of a curve together. Each is kept until the job has run.
const MAX_CURVE_FORCES: usize = 500_000;

const CURVE: &str = "/analysis/safety/curve";
const ABSCISSAE: &str = "/analysis/safety/curve/abscissae";

/// Whether a safety factor can be asked for.
pub fn check(request: &AnalysisRequest, faults: &mut Faults) {
    let scaled = request.loads.is_empty() || request.loads.iter().any(|entry| entry.scaled);
    let detail = "a safety factor needs loads that grow: set scaled to true in at least one of loads";
    faults.require(scaled, "/analysis/safety", detail);
    let detail = "in a safety analysis loads grow: set direction to `increase`";
    let increases = request.load_factor.direction == Direction::Increase;
    faults.require(increases, "/load_factor/direction", detail);
    if let Some(cap) = request.load_factor.cap.filter(|&cap| cap > 0.0 && cap <= 1.0) {
        let detail = format!(
            "{} is too low: a safety analysis goes on from load factor 1, so give more or leave it out",
            Shown(cap)
        );
        faults.add("/load_factor/cap", detail);
    }
}

/// Whether the loads that change along a curve and the curve itself are there, each for the other.
pub fn check_flags(request: &AnalysisRequest, curve: Option<&CurveRequest>, faults: &mut Faults) {
    let flagged = || request.loads.iter().enumerate().filter(|(_, entry)| entry.per_abscissa);
    if curve.is_none() {
        for (i, _) in flagged() {
            let detail = "there is no abscissa to multiply this load by: ask for `curve` in a safety analysis, or set \
                          this to false";
            faults.add(format!("/loads/{i}/per_abscissa"), detail);
        }
        return;
    }
    let detail = "no load depends on the abscissa: set per_abscissa to true in at least one of loads";
    faults.require(request.loads.is_empty() || flagged().next().is_some(), CURVE, detail);
    let detail = "a curve shows no stress fields: leave them out, or ask for one safety factor without a curve";
    faults.require(request.report.stress_fields.is_empty(), "/report/stress_fields", detail);
    let detail = "a curve shows no history: leave it out, or ask for one safety factor without a curve";
    faults.require(!request.report.history, "/report/history", detail);
}

/// The analysis at every abscissa; what is wrong with the loads at several of them is said once.
pub fn points(site: &Unloaded<'_>, curve: &CurveRequest, faults: &mut Faults) -> Option<Vec<CurvePoint>> {
    let entries = &site.request.loads;
    if !(check_abscissae(curve, faults) && check_size(site, curve.abscissae.len(), faults)) {
        // The loads as they stand, so that their faults are listed too.
        return site.analysis(entries, faults).and(None);
    }
    let mut seen = BTreeSet::new();
    let mut points = Some(Vec::with_capacity(curve.abscissae.len()));
    for &Abscissa(abscissa) in &curve.abscissae {
        let mut here = Faults::default();
        let analysis = site.analysis(&at(entries, abscissa), &mut here);
        for Fault { pointer, detail } in here.into_vec() {
            if seen.insert(pointer.clone()) {
                let detail = if depends(entries, &pointer) {
                    format!("at abscissa {}: {detail}", Shown(abscissa))
                } else {
                    detail
                };
                faults.add(pointer, detail);
            }
        }
        match (analysis, &mut points) {
            (Some(analysis), Some(points)) if seen.is_empty() => points.push(CurvePoint { abscissa, analysis }),
            _ => points = None,
        }
    }
    points
}

/// The loads at an abscissa.
fn at(entries: &[LoadEntry], abscissa: f64) -> Vec<LoadEntry> {
    let factor = |entry: &LoadEntry| if entry.per_abscissa { abscissa } else { 1.0 };
    let one = |entry: &LoadEntry| LoadEntry { coefficient: entry.coefficient * factor(entry), ..entry.clone() };
    entries.iter().map(one).collect()
}

/// True for a fault of a load that changes along the curve.
fn depends(entries: &[LoadEntry], pointer: &str) -> bool {
    let under = |i: usize| lies_under(pointer, &format!("/loads/{i}"));
    entries.iter().enumerate().any(|(i, entry)| entry.per_abscissa && under(i))
}

fn check_abscissae(curve: &CurveRequest, faults: &mut Faults) -> bool {
    let (before, abscissae) = (faults.len(), &curve.abscissae);
    for (i, pair) in abscissae.windows(2).enumerate() {
        let [earlier, later] = [pair[0].0, pair[1].0];
        let detail = format!(
            "{} follows on {}: list the abscissae from lowest to highest, each once",
            Shown(later),
            Shown(earlier)
        );
        faults.require(later > earlier, format!("{ABSCISSAE}/{}", i + 1), detail);
    }
    faults.len() == before
}

/// Whether the curve keeps within what a job may take.
fn check_size(site: &Unloaded<'_>, abscissae: usize, faults: &mut Faults) -> bool {
    let subblocks = abscissae * mesh::total(site.subblocks().iter());
    let detail = format!(
        "abscissae times subblocks come to {subblocks}: keep to {MAX_CURVE_SUBBLOCKS} by fewer abscissae or a \
         coarser mesh"
    );
    let forces_per_voussoir = loads::forces_per_voussoir_of(&site.request.loads, site.request.backfill.as_ref());
    let forces = abscissae * forces_per_voussoir * site.pieces().iter().sum::<usize>().max(1);
    faults.require(subblocks <= MAX_CURVE_SUBBLOCKS, ABSCISSAE, detail) && {
        let detail = format!(
            "abscissae times loads and bands times subblocks along the arch come to {forces}: keep to \
             {MAX_CURVE_FORCES} by fewer abscissae, by joining loads or by a coarser mesh"
        );
        faults.require(forces <= MAX_CURVE_FORCES, ABSCISSAE, detail)
    }
}
