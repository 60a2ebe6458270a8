//! Whether the fixed loads hold a structure back as it falls, where partial factors multiply them.

use super::StructureBody;
use crate::collapse::CollapseReport;
use crate::wire::prose::Digits;
use crate::wire::request::AnalysisRequest;

/// Less work than this share of that of all its parts is none.
const NONE: f64 = 1e-6;

/// A note where the partial factors on weight let the structure bear more than without them, at the end that governs.
pub(super) fn note(request: &AnalysisRequest, structure: &StructureBody, report: &CollapseReport) -> Option<String> {
    let factors = request.partial_factors?;
    let ends = report.ends();
    let works = structure.bodies.iter().zip(&ends.first()?.state.mechanism.velocities);
    let works = works.flat_map(|(body, [u, v, spin])| {
        let load = body.fixed_load;
        [load.x_n_per_m * u, load.y_n_per_m * v, load.moment_n * spin]
    });
    let (work, all) = works.fold((0.0, 0.0), |(work, all), part| (work + part, all + part.abs()));
    let [dead, fill] = [factors.dead, factors.fill];
    let (does, change) = match work {
        _ if work < -NONE * all && dead.max(fill) > 1.0 => ("hold it back", "above 1"),
        _ if work > NONE * all && dead.min(fill) < 1.0 => ("bring it down", "below 1"),
        _ => return None,
    };
    Some(format!(
        "As the arch falls its fixed loads as a whole {does}: partial factors {change} on weight (dead {}, fill {}) let it bear more. \
         Repeat the request with factors of 1 on both, and rely on the lower answer.",
        Digits(dead),
        Digits(fill)
    ))
}
