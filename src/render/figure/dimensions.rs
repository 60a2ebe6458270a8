//! Measures of a structure: span, rise and thickness; of blocks width and height.

use super::{Canvas, Drawing, Structure, box_of, on_sheet};
use crate::geometry::Vec2;
use crate::render::digits::Rounded;
use crate::render::labels::extent;
use crate::structure::{Joint, Span};

/// What the measures below a structure need, pixels.
pub const DEPTH: f64 = 34.0;
/// Lengths that differ by less than this share are the same.
const SAME: f64 = 1e-6;
/// Most spans that have their thickness told.
const THICKNESSES: usize = 3;

/// Draws them; spans and widths above this height on the sheet.
pub fn draw(canvas: &mut Canvas, drawing: &Drawing<'_>, bottom: f64) {
    let structure = drawing.structure;
    let hinges = drawing.state.mechanism().map_or(&[][..], |mechanism| &mechanism.hinges);
    let rings = lowest_rings(structure);
    let y = bottom - 0.5 * DEPTH;
    for (i, span) in rings.iter().enumerate() {
        let joints = &structure.joints[span.joints.clone()];
        let (Some(first), Some(last)) = (joints.first(), joints.last()) else { continue };
        let half = joints.iter().any(Joint::is_symmetry);
        let word = if half { "half span" } else { "span" };
        let ends = [first.intrados, last.intrados].map(|end| canvas.place(end));
        level(canvas, ends, y, &format!("{word} {} m", Rounded(last.intrados.x - first.intrados.x)));
        rise(canvas, joints, half);
        if i < THICKNESSES {
            let hinged = |k: usize| hinges.iter().any(|hinge| hinge.joint.abs_diff(span.joints.start + k) <= 1);
            thickness(canvas, joints, hinged);
        }
    }
    if rings.is_empty() {
        let (low, high) = box_of(structure);
        let ends = [low, Vec2::new(high.x, low.y)].map(|end| canvas.place(end));
        level(canvas, ends, y, &format!("width {} m", Rounded(high.x - low.x)));
        let x = ends[0].x - 20.0;
        let (a, b) = (Vec2::new(x, canvas.place(high).y), Vec2::new(x, ends[0].y));
        // Above the arrow: to its left there is no room, to its right stand the blocks.
        let above = (a + Vec2::new(0.0, -4.0), Vec2::new(0.0, -1.0));
        upright(canvas, [a, b], above, &format!("height {} m", Rounded(high.y - low.y)));
    }
}

/// The rings that lie on no other.
fn lowest_rings(structure: &Structure) -> Vec<&Span> {
    let first = |span: &Span| &structure.joints[span.joints.start];
    let lies_on = |span: &Span, other: &Span| {
        let (own, below) = (first(span), first(other));
        (own.intrados - below.extrados).norm() < 0.1 * below.length()
    };
    structure.spans.iter().filter(|span| !structure.spans.iter().any(|other| lies_on(span, other))).collect()
}

/// A level measure between two places, drawn at this height with lines down to it.
fn level(canvas: &mut Canvas, [a, b]: [Vec2; 2], y: f64, words: &str) {
    for end in [a, b] {
        canvas.line("measure", Vec2::new(end.x, end.y.min(y - 12.0).max(y - 40.0)), Vec2::new(end.x, y + 5.0));
    }
    let size = extent(words, 13.0);
    let middle = Vec2::new(0.5 * (a.x + b.x), y);
    let (from, to) = (Vec2::new(a.x, y), Vec2::new(b.x, y));
    let inside = (b.x - a.x).abs() > size.x + 40.0;
    for (end, towards) in [(from, -1.0), (to, 1.0)] {
        let near = if inside { middle + Vec2::new(towards * (0.5 * size.x + 6.0), 0.0) } else { middle };
        canvas.arrow("measure", near, end);
    }
    let drop = if inside { 4.5 } else { 17.0 };
    canvas.text("centred", middle + Vec2::new(0.0, drop), words);
    canvas.keep_free(&[from, to], 9.0);
}

/// An upright measure, its words at a place and in a direction from there.
fn upright(canvas: &mut Canvas, [a, b]: [Vec2; 2], (at, direction): (Vec2, Vec2), words: &str) {
    let middle = 0.5 * (a + b);
    canvas.arrow("measure", middle, a);
    canvas.arrow("measure", middle, b);
    canvas.keep_free(&[a, b], 5.0);
    canvas.label(at, direction, words);
}

/// From the middle between the springings up to the highest joint of the intrados.
fn rise(canvas: &mut Canvas, joints: &[Joint], half: bool) {
    let (first, last) = (&joints[0], &joints[joints.len() - 1]);
    let springing = if half { first.intrados.y } else { 0.5 * (first.intrados.y + last.intrados.y) };
    let Some(top) = joints.iter().map(|joint| joint.intrados).max_by(|a, b| a.y.total_cmp(&b.y)) else { return };
    let beside = Vec2::new(if half { -16.0 } else { 0.0 }, 0.0);
    let (a, b) = (canvas.place(top), canvas.place(Vec2::new(top.x, springing)));
    if b.y - a.y > 24.0 {
        let ends = [a + beside, b + beside];
        let right = (0.5 * (ends[0] + ends[1]) + Vec2::new(4.0, 0.0), Vec2::new(1.0, 0.0));
        upright(canvas, ends, right, &format!("rise {} m", Rounded(top.y - springing)));
    }
}

/// The length of the joints, at one between springing and crown that is not `hinged`.
fn thickness(canvas: &mut Canvas, joints: &[Joint], hinged: impl Fn(usize) -> bool) {
    let lengths = || joints.iter().map(Joint::length);
    let (least, most) = (lengths().fold(f64::INFINITY, f64::min), lengths().fold(0.0, f64::max));
    let words = match most - least < SAME * most {
        true => format!("thickness {} m", Rounded(most)),
        false => format!("joints {} to {} m", Rounded(least), Rounded(most)),
    };
    let (from, most) = (joints.len() / 5, joints.len() / 2);
    let joint = &joints[(from..most).find(|&k| !hinged(k)).unwrap_or(from)];
    let [a, b] = [joint.extrados, joint.intrados].map(|end| canvas.place(end));
    for (end, way) in [(a, 1.0), (b, -1.0)] {
        let out = way * on_sheet(joint.tangent());
        canvas.arrow("measure", end + 16.0 * out, end);
        canvas.keep_free(&[end, end + 16.0 * out], 3.0);
    }
    canvas.label(b - 16.0 * on_sheet(joint.tangent()), -on_sheet(joint.tangent()), &words);
}
