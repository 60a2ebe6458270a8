//! Hinges, slides, joints that part or crush, and cracks.

use super::{Canvas, Drawing, Joint, State, Structure, along, on_sheet};
use crate::collapse::{Hinge, Mechanism, OpenJoint, SettlementPath};
use crate::render::digits::Measured;
use crate::structure::{Face, Side};

/// Radius of the sign of a hinge, pixels.
pub const HINGE: f64 = 5.5;
/// Radius of that of a hinge that hardly turns, or that turns between two rings, pixels.
pub const MINOR: f64 = 2.2;
/// A hinge that turns by less than this share of the one that turns most hardly turns.
const HARDLY: f64 = 0.05;
/// Cracks narrower than this share of the widest are not told.
const NARROW: f64 = 0.02;

/// Draws them, hinges last.
pub fn draw(canvas: &mut Canvas, drawing: &Drawing<'_>) {
    let structure = drawing.structure;
    if let State::Falls(end) = &drawing.state {
        for crushed in &end.crushed {
            let joint = &structure.joints[crushed.joint];
            let inwards = (joint.end(crushed.face.other()) - crushed.at).normalize();
            canvas.line("crushed", canvas.place(crushed.at), canvas.place(crushed.at + crushed.length * inwards));
        }
    }
    let Some(mechanism) = drawing.state.mechanism() else { return };
    for lift_off in &mechanism.lift_offs {
        let joint = &structure.joints[lift_off.joint];
        canvas.line("parting", canvas.place(joint.intrados), canvas.place(joint.extrados));
    }
    draw_slides(canvas, structure, mechanism);
    for hinge in mechanism.hinges.iter().filter(|hinge| !is_main(structure, hinge)) {
        canvas.dot("minor", canvas.place(hinge.at), MINOR);
    }
    for hinge in mechanism.hinges.iter().filter(|hinge| is_main(structure, hinge)) {
        let at = canvas.place(hinge.at);
        canvas.keep_free(&[at], HINGE);
        canvas.dot("hinge", at, HINGE);
    }
    label(canvas, drawing, mechanism);
}

/// Whether a joint is not one along a ring, on which another ring or backing lies.
pub fn is_across(structure: &Structure, joint: usize) -> bool {
    let of_ring =
        |side: &Side| side.body().is_some_and(|body| structure.spans.iter().any(|span| span.bodies.contains(&body)));
    structure.span_of(joint).is_some() || !structure.joints[joint].between.iter().any(of_ring)
}

/// Whether a hinge is drawn with its number.
pub fn is_main(structure: &Structure, hinge: &Hinge) -> bool {
    hinge.rotation >= HARDLY && is_across(structure, hinge.joint)
}

/// Two half arrows along every sliding joint: the stone after it goes with the one, the stone before with the other.
fn draw_slides(canvas: &mut Canvas, structure: &Structure, mechanism: &Mechanism) {
    // Many short joints side by side leave no room for long arrows.
    let room = if mechanism.slides.len() > 12 { 14.0 } else { 40.0 };
    for slide in &mechanism.slides {
        let joint = &structure.joints[slide.joint];
        if !is_across(structure, slide.joint) {
            canvas.polyline("slipping", &[joint.intrados, joint.extrados]);
            continue;
        }
        let (along, normal) = (along(joint), on_sheet(joint.normal()));
        let middle = canvas.place(joint.middle());
        let half = (0.32 * joint.length() * canvas.scale()).clamp(9.0, room);
        for side in [1.0, -1.0] {
            let (reach, at) = (side * slide.rate.signum() * half * along, middle + side * 5.0 * normal);
            canvas.arrow("slide", at - reach, at + reach);
        }
        canvas.keep_free(&[middle - half * along, middle + half * along], 5.0);
    }
}

/// Numbers of joints: of hinges with their angle, or with how far they open where supports have moved.
fn label(canvas: &mut Canvas, drawing: &Drawing<'_>, mechanism: &Mechanism) {
    let joints = &drawing.structure.joints;
    let outwards = |joint: &Joint, face: Face| {
        let [end, other] = [joint.end(face), joint.end(face.other())];
        on_sheet((end - other).normalize())
    };
    for hinge in mechanism.hinges.iter().filter(|hinge| is_main(drawing.structure, hinge)) {
        let words = hinge_words(drawing, hinge);
        canvas.label(canvas.place(hinge.at), outwards(&joints[hinge.joint], hinge.face), &words);
    }
    if let State::Settles(path) = &drawing.state {
        for open in cracks(path) {
            let way = outwards(&joints[open.joint], open.face);
            canvas.label(canvas.place(open.at), way, &format!("{} mm", Measured(1e3 * open.width)));
        }
    }
    let across = |joint: &usize| is_across(drawing.structure, *joint);
    for run in runs(mechanism.lift_offs.iter().map(|lift_off| lift_off.joint).filter(across)) {
        let joint = &joints[run[run.len() / 2]];
        canvas.label(canvas.place(joint.extrados), outwards(joint, Face::Extrados), &run_words(&run));
    }
    let turns = |joint: &usize| mechanism.hinges.iter().any(|hinge| hinge.joint == *joint);
    for run in runs(mechanism.slides.iter().map(|slide| slide.joint).filter(across).filter(|joint| !turns(joint))) {
        let joint = &joints[run[run.len() / 2]];
        let below = canvas.place(joint.middle()) - 0.5 * joint.length() * canvas.scale() * along(joint);
        canvas.label(below, outwards(joint, Face::Intrados), &run_words(&run));
    }
}

fn hinge_words(drawing: &Drawing<'_>, hinge: &Hinge) -> String {
    match (&drawing.state, hinge.angle_from_springing) {
        (State::Falls(_), Some(angle)) => format!("{} at {:.1}°", hinge.joint, angle.to_degrees()),
        _ => hinge.joint.to_string(),
    }
}

/// Numbers in rising order, those that follow each other together.
fn runs(numbers: impl Iterator<Item = usize>) -> Vec<Vec<usize>> {
    let mut numbers: Vec<usize> = numbers.collect();
    numbers.sort_unstable();
    let mut runs: Vec<Vec<usize>> = Vec::new();
    for number in numbers {
        match runs.last_mut() {
            Some(run) if run[run.len() - 1] + 1 >= number => run.push(number),
            _ => runs.push(vec![number]),
        }
    }
    runs
}

fn run_words(run: &[usize]) -> String {
    match (run.first(), run.last()) {
        (Some(first), Some(last)) if first != last => format!("{first} to {last}"),
        (first, _) => first.map_or(String::new(), usize::to_string),
    }
}

/// Joints that are open at the end of a movement, but those that hardly are beside the widest.
fn cracks(path: &SettlementPath) -> impl Iterator<Item = &OpenJoint> {
    let widest = path.open_joints.iter().map(|open| open.width).fold(0.0, f64::max);
    path.open_joints.iter().filter(move |open| open.width > NARROW * widest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_follow_each_other_are_told_together() {
        let words: Vec<String> = runs([7, 3, 4, 5, 9].into_iter()).iter().map(|run| run_words(run)).collect();
        assert_eq!(words, ["3 to 5", "7", "9"]);
    }
}
