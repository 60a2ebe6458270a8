//! Motion after collapse.

use crate::collapse::MotionAsked;
use crate::structure::Structure;
use crate::wire::fault::{Faults, Shown};
use crate::wire::request::AnalysisRequest;

/// Most frames times stones of one motion: about 15 MB of answer.
const MAX_PLACES: usize = 60_000;
/// The ground may be so much higher than the lowest corner, as a share of its depth below y = 0 or of 1 m: round-off.
const LEVEL_ROUND_OFF: f64 = 1e-9;

/// What is asked of the motion of a structure, where it is.
pub fn motion(request: &AnalysisRequest, structure: Option<&Structure>, faults: &mut Faults) -> Option<MotionAsked> {
    let asked = request.motion.as_ref()?;
    let detail = "only an analysis of collapse shows a motion: leave it out, or set analysis to `collapse`";
    faults.require(request.analysis.is_collapse(), "/motion", detail);
    let resists = request.backfill.as_ref().is_some_and(|backfill| backfill.passive.is_some());
    let detail = "a motion knows no soil that resists: leave it out, or backfill/passive";
    faults.require(!resists, "/motion", detail);
    let frames = asked.most_frames;
    let places = frames * structure.map_or(0, |structure| structure.voussoirs().len());
    let detail = format!("frames times stones come to {places}: keep to {MAX_PLACES} by fewer frames");
    faults.require(places <= MAX_PLACES, "/motion/most_frames", detail);
    if let Some(level) = asked.ground_level_m {
        let corners = structure.iter().flat_map(|structure| &structure.bodies).flat_map(|body| &body.corners);
        let lowest = corners.map(|corner| corner.y).fold(f64::INFINITY, f64::min);
        let above = level > lowest + LEVEL_ROUND_OFF * lowest.abs().max(1.0);
        let detail = format!("the lowest corner is at {} m: keep the ground below it", Shown(lowest));
        faults.require(!above, "/motion/ground_level_m", detail);
    }
    Some(MotionAsked { most_frames: frames, share_of_span: asked.share_of_span, ground_level: asked.ground_level_m })
}
