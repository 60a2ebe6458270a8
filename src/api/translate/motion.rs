//! Motion after collapse.

use crate::api::fault::Faults;
use crate::api::request::{AimRequest, AnalysisRequest, MAX_MOTION_FRAMES};
use crate::collapse::MotionAsked;

/// Most frames times voussoirs of one motion: about 15 MB of answer.
const MAX_PLACES: usize = 60_000;

/// What is asked of the motion of so many voussoirs, where it is.
pub fn motion(request: &AnalysisRequest, voussoirs: usize, faults: &mut Faults) -> Option<MotionAsked> {
    let asked = request.motion.as_ref()?;
    let detail = "only an analysis of collapse shows a motion: leave it out, or set analysis to `collapse`";
    faults.require(request.analysis == AimRequest::Collapse, "/motion", detail);
    let frames = asked.most_frames;
    if faults.counted("/motion/most_frames", frames, 1..=MAX_MOTION_FRAMES, "frames") {
        let places = frames * voussoirs;
        let detail = format!("frames times voussoirs come to {places}: keep to {MAX_PLACES} by fewer frames");
        faults.require(places <= MAX_PLACES, "/motion/most_frames", detail);
    }
    faults.within("/motion/share_of_span", asked.share_of_span, 0.0, 1.0);
    Some(MotionAsked { most_frames: frames, share_of_span: asked.share_of_span })
}
