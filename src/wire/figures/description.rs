//! A drawing in words, for those who do not see it.

use crate::collapse::Face;
use crate::render::digits::Rounded;
use crate::render::figure::{Drawing, State};
use crate::wire::prose;
use crate::wire::response::AnalysisResult;

/// Most joints of one kind that are told one by one.
const LISTED: usize = 40;

/// What is to be seen.
pub fn of(drawing: &Drawing<'_>, result: &AnalysisResult) -> String {
    let mut parts = vec![drawing.caption.clone()];
    if let State::Stands(lines) = &drawing.state {
        for (word, line) in ["Least", "Greatest"].into_iter().zip(lines) {
            parts.extend(line.map(|(thrust, _)| format!("{word} thrust {} kN/m.", Rounded(thrust / 1e3))));
        }
    }
    if let Some(mechanism) = drawing.state.mechanism() {
        let hinge = |hinge: &crate::collapse::Hinge| {
            let face = if hinge.face == Face::Intrados { "intrados" } else { "extrados" };
            let face = if result.named().is_some() { "" } else { face };
            let angle =
                hinge.angle_from_springing.map(|angle| format!(" {:.1}° from the springing", angle.to_degrees()));
            format!("{} {face}{}", hinge.joint, angle.unwrap_or_default())
        };
        parts.extend(listed("Hinges at joints", mechanism.hinges.iter().map(hinge)));
        parts.extend(listed("Sliding joints", mechanism.slides.iter().map(|slide| slide.joint.to_string())));
        parts.extend(listed("Parting joints", mechanism.lift_offs.iter().map(|lift_off| lift_off.joint.to_string())));
    }
    if let State::Falls(end) = &drawing.state {
        parts.extend(listed("Crushed joints", end.crushed.iter().map(|crushed| crushed.joint.to_string())));
    }
    let load = |acts: bool| drawing.loads.iter().filter(move |load| load.acts == acts).map(|load| load.words.clone());
    parts.extend(listed("Loads that act", load(true)));
    parts.extend(listed("Loads that do not act here", load(false)));
    prose::in_its_words(&result.request, &parts.join(" "))
}

/// A sentence that lists what there is; none where there is nothing.
fn listed(what: &str, items: impl Iterator<Item = String>) -> Option<String> {
    let items: Vec<String> = items.map(|item| item.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
    let more = items.len().saturating_sub(LISTED);
    let more = if more > 0 { format!(", and {more} more") } else { String::new() };
    let shown = items.iter().take(LISTED).cloned().collect::<Vec<_>>().join(", ");
    (!items.is_empty()).then(|| format!("{what}: {shown}{more}."))
}
