//! Where the thrust passes, and where it nearly touches a face.

use super::signs::is_across;
use super::{Canvas, Drawing, State, Structure, is_arch, on_sheet};
use crate::collapse::{ContactPoint, Thrust};
use crate::geometry::Vec2;
use crate::structure::Face;
use std::ops::Range;

/// A resultant further from the joint's middle than this many joint lengths is not drawn.
const FARTHEST: f64 = 1.0;
/// A thrust line nearly touches a face where it is nearer than this share of the joint.
pub const NEAR: f64 = 0.02;
/// Where it is near at more joints, one by one tell nothing.
const MANY: usize = 24;
/// Radius of the sign where it does, pixels.
pub const SIGN: f64 = 4.0;
/// Radius of that of a joint's force, pixels.
pub const RESULTANT: f64 = 2.6;

/// Thrust lines by the class in which they are drawn.
pub fn lines<'d>(drawing: &'d Drawing<'_>) -> Vec<(&'static str, &'d [Thrust])> {
    match &drawing.state {
        State::Falls(end) => vec![("thrust", &end.thrust_line)],
        State::Settles(path) => vec![("thrust", &path.thrust_line)],
        State::Presses(thrusts) => vec![("thrust", thrusts)],
        State::Stands(lines) => {
            let both = ["least", "thrust"].into_iter().zip(lines);
            both.filter_map(|(class, line)| line.map(|(_, line)| (class, line))).collect()
        }
        State::Unknown => Vec::new(),
    }
}

/// Draws them: one for every ring, and where the force of every joint elsewhere crosses it.
pub fn draw(canvas: &mut Canvas, drawing: &Drawing<'_>) {
    let structure = drawing.structure;
    for (class, line) in lines(drawing) {
        if is_arch(structure) {
            canvas.polyline(class, &crossings(structure, line, 0..structure.ring().len()));
            continue;
        }
        for span in &structure.spans {
            canvas.polyline(class, &crossings(structure, line, span.joints.clone()));
        }
        for at in beside_rings(structure, line) {
            canvas.dot("resultant", canvas.place(at), RESULTANT);
        }
    }
    let mut told = Vec::new();
    for (joint, at, out) in touched(drawing) {
        if told.contains(&(joint, at)) {
            continue;
        }
        told.push((joint, at));
        let at = canvas.place(at);
        canvas.dot("near", at, SIGN);
        canvas.keep_free(&[at], SIGN);
        canvas.label(at, on_sheet(out), &joint.to_string());
    }
}

/// Whether there are joints outside of rings whose forces are drawn one by one.
pub fn has_dots(drawing: &Drawing<'_>) -> bool {
    !is_arch(drawing.structure)
        && lines(drawing).iter().any(|(_, line)| !beside_rings(drawing.structure, line).is_empty())
}

/// Where the forces of joints outside of rings cross them.
fn beside_rings(structure: &Structure, line: &[Thrust]) -> Vec<Vec2> {
    let others = (0..structure.joints.len()).filter(|&k| structure.span_of(k).is_none() && is_across(structure, k));
    others.flat_map(|k| crossings(structure, line, k..k + 1)).collect()
}

/// What every joint carries, of the forces at its contact points; joints that carry nothing are left out.
pub fn resultants(structure: &Structure, contacts: &[ContactPoint]) -> Vec<Thrust> {
    let mut sums = vec![[0.0; 3]; structure.joints.len()];
    for contact in contacts {
        let sum = &mut sums[contact.joint];
        let parts = [contact.normal, contact.tangential, contact.normal * contact.position];
        *sum = std::array::from_fn(|i| sum[i] + parts[i]);
    }
    let pressed = sums.into_iter().enumerate().filter(|(_, [normal, ..])| *normal > 0.0);
    let thrust = |(joint, [normal, shear, moment]): (usize, [f64; 3])| {
        let of = &structure.joints[joint];
        let eccentricity = (moment / normal - 0.5) * of.length();
        Thrust { joint, normal, shear, eccentricity, at: of.middle() + eccentricity * of.tangent() }
    };
    pressed.map(thrust).collect()
}

/// Where the thrust crosses each of these joints; joints without thrust, or with it far outside, are left out.
fn crossings(structure: &Structure, line: &[Thrust], joints: Range<usize>) -> Vec<Vec2> {
    let near = |t: &&Thrust| {
        joints.contains(&t.joint)
            && t.normal > 0.0
            && t.eccentricity.abs() <= FARTHEST * structure.joints[t.joint].length()
    };
    line.iter().filter(near).map(|thrust| thrust.at).collect()
}

/// Joints at which the least or the greatest thrust nearly touches a face, the place on it, m, and the way out of the face; of
/// several in a row the one where it is nearest.
pub fn touched(drawing: &Drawing<'_>) -> Vec<(usize, Vec2, Vec2)> {
    let State::Stands(_) = &drawing.state else { return Vec::new() };
    let structure = drawing.structure;
    let mut all = Vec::new();
    for (_, line) in lines(drawing) {
        let left = |t: &Thrust| 0.5 - t.eccentricity.abs() / structure.joints[t.joint].length();
        let face = |t: &Thrust| if t.eccentricity > 0.0 { Face::Extrados } else { Face::Intrados };
        let is_near = |t: &&Thrust| t.normal > 0.0 && left(t) < NEAR && structure.span_of(t.joint).is_some();
        let mut last: Option<&Thrust> = None;
        let mut nearest: Vec<&Thrust> = Vec::new();
        for thrust in line.iter().filter(is_near) {
            let follows = last.is_some_and(|last| last.joint + 1 == thrust.joint && face(last) == face(thrust));
            match nearest.last_mut().filter(|_| follows) {
                Some(kept) if left(thrust) < left(kept) => *kept = thrust,
                Some(_) => {}
                None => nearest.push(thrust),
            }
            last = Some(thrust);
        }
        for thrust in nearest {
            let (joint, face) = (&structure.joints[thrust.joint], face(thrust));
            let (at, other) = (joint.end(face), joint.end(face.other()));
            all.push((thrust.joint, at, (at - other).normalize()));
        }
    }
    if all.len() > MANY {
        all.clear();
    }
    all
}

#[cfg(test)]
mod tests;
