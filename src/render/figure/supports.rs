//! The ground that a structure stands on.

use super::{Canvas, Joint, Structure, is_arch, on_sheet};
use crate::geometry::cross;
use crate::structure::{JointLaw, Side};

/// What the hatching of the ground needs below a structure, pixels.
pub const DEPTH: f64 = 20.0;

/// Hatched ground beyond every joint with a support (a wall beside a half arch); an axis where a stone is cut on it.
pub fn draw(canvas: &mut Canvas, structure: &Structure) {
    for joint in &structure.joints {
        for (side, sign) in joint.between.into_iter().zip([-1.0, 1.0]) {
            match (side, joint.law) {
                (Side::Support(_), JointLaw::Mirror) => draw_axis(canvas, joint),
                (Side::Support(_), _) => draw_ground(canvas, joint, sign, is_arch(structure)),
                (Side::Body(_), _) => {}
            }
        }
    }
}

fn draw_axis(canvas: &mut Canvas, joint: &Joint) {
    let (a, b) = (canvas.place(joint.intrados), canvas.place(joint.extrados));
    let along = (b - a).normalize();
    canvas.line("axis", a - 16.0 * along, b + 16.0 * along);
}

/// Hatched ground at a joint: before it (sign -1) or after it (sign 1), a little wider than the joint where there is `room`.
fn draw_ground(canvas: &mut Canvas, joint: &Joint, sign: f64, room: bool) {
    let (a, b) = (canvas.place(joint.intrados), canvas.place(joint.extrados));
    let (along, out) = ((b - a).normalize(), sign * on_sheet(joint.normal()));
    let beyond = if room { 8.0 } else { 0.0 };
    let (a, b) = (a - beyond * along, b + beyond * along);
    canvas.line("ground", a, b);
    let strokes = ((b - a).norm() / 9.0).floor().max(1.0);
    let lean = if out.x.abs() > 0.7 { 1.0 } else { sign };
    for i in 0..=strokes as usize {
        let from = a + (b - a) * (i as f64 / strokes);
        canvas.line("hatch", from, from + 8.0 * out + 6.0 * lean * cross(out, along).signum() * along);
    }
    canvas.keep_free(&[a, b, a + 9.0 * out, b + 9.0 * out], 0.0);
}
