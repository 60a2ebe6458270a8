//! What becomes of ties as a structure falls.

use super::StructureBody;
use super::structure::LawWord;
use crate::collapse::{CollapseReport, Mechanism};
use crate::geometry::{Vec2, perpendicular};
use crate::wire::request::{AnalysisRequest, LoadEntry, LoadRequest, TieEnd, TieLoad};

/// A tie whose length changes by less than this share of the fastest movement keeps it.
const KEPT: f64 = 1e-6;

/// Names of voussoirs are this with their number.
const VOUSSOIR: &str = "voussoir ";

/// A note for every fixed tie on the end that governs.
pub(super) fn notes(request: &AnalysisRequest, structure: &StructureBody, report: &CollapseReport) -> Vec<String> {
    let ends = report.ends();
    let Some(end) = ends.first() else { return Vec::new() };
    let note = |(i, entry): (usize, &LoadEntry)| match &entry.load {
        LoadRequest::Tie(tie) if !entry.scaled => Some(words(i, stretching(structure, &end.state.mechanism, tie)?)),
        _ => None,
    };
    request.loads.iter().enumerate().filter_map(note).collect()
}

/// How fast a tie grows longer, as a share of the fastest body.
fn stretching(structure: &StructureBody, mechanism: &Mechanism, tie: &TieLoad) -> Option<f64> {
    let velocities = &mechanism.velocities;
    let fastest = velocities.iter().map(|[u, v, _]| u.hypot(*v)).fold(0.0, f64::max);
    let listed = |name: &str| structure.bodies.iter().position(|body| body.name == name);
    let of = |body: usize, at: Vec2| {
        let ([u, v, spin], centroid) = (*velocities.get(body)?, Vec2::from(structure.bodies[body].centroid_m));
        Some(Vec2::new(u, v) + perpendicular(at - centroid) * spin)
    };
    let velocity = |end: &TieEnd| match listed(&end.block) {
        Some(body) => of(body, end.at_m.into()),
        None => {
            let (body, at) = mirrored(structure, end)?;
            of(listed(&body)?, at).map(|velocity| Vec2::new(-velocity.x, velocity.y))
        }
    };
    let along = (Vec2::from(tie.to.at_m) - Vec2::from(tie.from.at_m)).normalize();
    let rate = along.dot(&(velocity(&tie.to)? - velocity(&tie.from)?)) / fastest;
    rate.is_finite().then_some(rate)
}

/// The mirror image of an end on the right half of an arch of which the left one is analysed: its voussoir and its point there.
fn mirrored(structure: &StructureBody, end: &TieEnd) -> Option<(String, Vec2)> {
    let middle = structure.joints.iter().find(|joint| matches!(joint.law, LawWord::Wall | LawWord::Mirror))?;
    let half = structure.bodies.iter().filter(|body| body.name.starts_with(VOUSSOIR)).count();
    // A keystone that is cut is its own mirror image.
    let whole = 2 * half - usize::from(matches!(middle.law, LawWord::Mirror));
    let voussoir: usize = end.block.strip_prefix(VOUSSOIR)?.parse().ok()?;
    let ([axis, _], [x, y]) = (middle.ends_m[0], end.at_m.0);
    Some((format!("{VOUSSOIR}{}", whole.checked_sub(voussoir + 1)?), Vec2::new(2.0 * axis - x, y)))
}

fn words(load: usize, rate: f64) -> String {
    if rate > KEPT {
        return format!(
            "The tie of loads[{load}] is stretched as the arch falls: where its force is that at which it yields, it bears that to \
             the end."
        );
    }
    if rate < -KEPT {
        return format!(
            "The tie of loads[{load}] goes slack as the arch falls: its force brings the arch down. A bar that only holds what would \
             part pulls less there; the arch bears no less with it than is said here where no joint slides."
        );
    }
    format!("The tie of loads[{load}] keeps its length as the arch falls: its force does not matter there.")
}
