//! Plumb backs at the ends of a bridge: ground holds those of backing, and soil none of abutments.

use super::{JointBody, StructureBody};
use crate::collapse::{CollapseReport, Thrust};
use crate::wire::prose::Digits;
use crate::wire::request::AnalysisRequest;

/// Note on abutments beside soil.
const NO_SOIL_BEHIND: &str = "No soil presses on the plumb backs of abutments, and none resists behind them: an abutment stands by what it \
     weighs and bears. Where earth holds it, leave the abutment out: a springing on the ground does not give way.";

/// How the names of backing and of the ground at an end of a bridge begin.
const BACKING: &str = "backing";
const GROUND: &str = "ground.";

/// Notes on them.
pub(super) fn notes(request: &AnalysisRequest, structure: &StructureBody, report: &CollapseReport) -> Vec<String> {
    let Some(bridge) = &request.bridge else { return Vec::new() };
    let abutments = bridge.abutments.as_ref().is_some_and(|ends| ends.left.is_some() || ends.right.is_some());
    let alone = (abutments && request.is_filled()).then(|| NO_SOIL_BEHIND.to_owned());
    leaning(structure, report).into_iter().chain(alone).collect()
}

/// A note on backing that leans on the ground, with the forces of those joints at the end that governs.
fn leaning(structure: &StructureBody, report: &CollapseReport) -> Option<String> {
    let leans = |(k, joint): (usize, &JointBody)| {
        let is = |start: &str| joint.between.iter().find(|name| name.starts_with(start));
        is(BACKING).and_then(|_| is(GROUND)).map(|ground| (k, ground.clone()))
    };
    let leaning: Vec<(usize, String)> = structure.joints.iter().enumerate().filter_map(leans).collect();
    let ends = report.ends();
    let lines = ends.first().map_or(&[][..], |end| &end.state.thrust_line);
    let force = |(k, ground): &(usize, String)| {
        let Thrust { normal, shear, .. } = lines.iter().find(|thrust| thrust.joint == *k)?;
        let [thrust, friction] = [*normal, shear.abs()].map(|force| Digits(force / 1e3));
        Some(format!("{thrust} kN/m of thrust and {friction} kN/m of friction at {ground}"))
    };
    let forces: Vec<String> = leaning.iter().filter_map(force).collect();
    let forces = match forces.is_empty() {
        true => String::new(),
        false => format!(" It does so with {} as the arch falls.", forces.join(", ")),
    };
    (!leaning.is_empty()).then(|| {
        format!(
            "Without an abutment below it the backing at an end leans on the ground behind, which gives way to no thrust, and whose \
             friction may hold the backing down.{forces} Where nothing as firm stands there, give an abutment: the arch may bear \
             much less."
        )
    })
}
