//! What acts on a structure, as arrows with their values.

use super::{Canvas, Drawing, State, box_of, on_sheet};
use crate::geometry::Vec2;
use crate::render::digits::Rounded;
use crate::structure::load::Flanks;

/// White space above what a load stands on for its arrows and their words, pixels.
const ABOVE: f64 = 72.0;
/// Length of an arrow, pixels.
const ARROW: f64 = 44.0;
/// Greatest distance of the arrows of one strip, pixels.
const APART: f64 = 13.0;
/// Loads further than this share of the structure's width beside it are not drawn.
const BESIDE: f64 = 0.12;
/// Forces of soil smaller than this share of the largest are not drawn.
const NOTHING: f64 = 0.01;

/// A load.
#[derive(Debug, Clone, PartialEq)]
pub struct Acting {
    /// Where and how it acts.
    pub mark: Mark,
    /// Its value and unit.
    pub words: String,
    /// Whether it acts in the state that is drawn.
    pub acts: bool,
}

/// Where and how a load acts; lengths in m.
#[derive(Debug, Clone, PartialEq)]
pub enum Mark {
    /// A force at a point, in this direction.
    Force {
        /// The point.
        at: Vec2,
        /// Unit vector.
        along: Vec2,
    },
    /// An upright force on a level strip.
    Strip {
        /// Its left and its right end.
        ends: [Vec2; 2],
        /// Whether it pulls upwards.
        upwards: bool,
    },
    /// A horizontal pressure on flanks.
    Pressure {
        /// From and to which height.
        heights: [f64; 2],
        /// Which flanks.
        flanks: Flanks,
        /// Whether it sucks.
        outwards: bool,
    },
    /// A force on all masses in this direction.
    Inertia(Vec2),
}

/// Whether something presses from beside.
pub fn from_beside(drawing: &Drawing<'_>) -> bool {
    let pressed = drawing.loads.iter().any(|load| matches!(load.mark, Mark::Pressure { .. }));
    pressed || matches!(drawing.state, State::Falls(end) if end.soil.iter().any(|force| *force > 0.0))
}

/// Where loads stand, m: those near the structure.
pub fn places(drawing: &Drawing<'_>) -> impl Iterator<Item = Vec2> {
    drawing.loads.iter().filter(|load| is_near(drawing, load)).flat_map(|load| match &load.mark {
        Mark::Force { at, .. } => vec![*at],
        Mark::Strip { ends, .. } => ends.to_vec(),
        Mark::Pressure { .. } | Mark::Inertia(_) => Vec::new(),
    })
}

fn is_near(drawing: &Drawing<'_>, load: &Acting) -> bool {
    let (low, high) = box_of(drawing.structure);
    let most = BESIDE * (high.x - low.x);
    let near = |p: &Vec2| p.x >= low.x - most && p.x <= high.x + most;
    match &load.mark {
        Mark::Force { at, .. } => near(at),
        Mark::Strip { ends, .. } => ends.iter().all(near),
        Mark::Pressure { .. } | Mark::Inertia(_) => true,
    }
}

/// How many loads stand too far off to be drawn.
pub fn left_out(drawing: &Drawing<'_>) -> usize {
    drawing.loads.iter().filter(|load| !is_near(drawing, load)).count()
}

/// How much more white space arrows need above a structure than this sheet has, pixels; `head` is where the drawing begins.
pub fn needed_above(drawing: &Drawing<'_>, canvas: &Canvas, head: f64) -> f64 {
    let inertia = drawing.loads.iter().any(|load| matches!(load.mark, Mark::Inertia(_)));
    let highest = places(drawing).map(|at| canvas.place(at).y).fold(f64::INFINITY, f64::min);
    let of_arrows = (ABOVE - (highest - head)).max(0.0);
    if inertia { of_arrows.max(ABOVE) } else { of_arrows }
}

/// Draws them, and what soil presses with; `top` is where words above the drawing end.
pub fn draw(canvas: &mut Canvas, drawing: &Drawing<'_>, top: f64) {
    draw_soil(canvas, drawing);
    for load in drawing.loads.iter().filter(|load| is_near(drawing, load)) {
        let class = if load.acts { "load" } else { "idle" };
        let (at, direction) = match &load.mark {
            Mark::Force { at, along } => draw_force(canvas, class, canvas.place(*at), on_sheet(*along)),
            Mark::Strip { ends, upwards } => draw_strip(canvas, class, ends.map(|end| canvas.place(end)), *upwards),
            Mark::Pressure { heights, flanks, outwards } => {
                draw_pressure(canvas, class, drawing, (*heights, *flanks), *outwards)
            }
            Mark::Inertia(along) => draw_inertia(canvas, class, on_sheet(*along), top),
        };
        canvas.label(at, direction, &load.words);
    }
}

fn draw_force(canvas: &mut Canvas, class: &str, tip: Vec2, along: Vec2) -> (Vec2, Vec2) {
    let tail = tip - ARROW * along;
    canvas.arrow(class, tail, tip);
    canvas.keep_free(&[tail, tip], 4.0);
    (tail, -along)
}

/// Arrows side by side under a bar.
fn draw_strip(canvas: &mut Canvas, class: &str, [left, right]: [Vec2; 2], upwards: bool) -> (Vec2, Vec2) {
    let gaps = ((right.x - left.x) / APART).floor();
    let up = Vec2::new(0.0, -ARROW);
    let middle = 0.5 * (left + right);
    let feet: Vec<Vec2> = match gaps >= 1.0 {
        true => (0..=gaps as usize).map(|i| left + (right - left) * (i as f64 / gaps)).collect(),
        false => vec![middle],
    };
    for foot in feet {
        let (from, to) = if upwards { (foot, foot + up) } else { (foot + up, foot) };
        canvas.arrow(class, from, to);
    }
    canvas.line(class, left + up, right + up);
    canvas.keep_free(&[left, right + up], 4.0);
    (middle + up, Vec2::new(0.0, -1.0))
}

fn draw_pressure(
    canvas: &mut Canvas,
    class: &str,
    drawing: &Drawing<'_>,
    ([from, to], flanks): ([f64; 2], Flanks),
    outwards: bool,
) -> (Vec2, Vec2) {
    let (low, high) = box_of(drawing.structure);
    let [from, to] = [from, to].map(|height| height.clamp(low.y, high.y));
    let mut words = (Vec2::zeros(), Vec2::zeros());
    for (x, side, other) in [(low.x, -1.0, Flanks::Right), (high.x, 1.0, Flanks::Left)] {
        if flanks == other {
            continue;
        }
        let out = Vec2::new(side, 0.0);
        let ends = [from, to].map(|y| canvas.place(Vec2::new(x, y)) + 12.0 * out);
        let gaps = ((ends[0].y - ends[1].y) / (2.0 * APART)).floor().max(1.0);
        for i in 0..=gaps as usize {
            let near = ends[0] + (ends[1] - ends[0]) * (i as f64 / gaps);
            let far = near + 0.6 * ARROW * out;
            let (tail, tip) = if outwards { (near, far) } else { (far, near) };
            canvas.arrow(class, tail, tip);
        }
        let far = ends.map(|end| end + 0.6 * ARROW * out);
        canvas.line(class, far[0], far[1]);
        canvas.keep_free(&[ends[0], far[1]], 4.0);
        words = (0.5 * (far[0] + far[1]), out);
    }
    words
}

/// One arrow above the structure.
fn draw_inertia(canvas: &mut Canvas, class: &str, along: Vec2, top: f64) -> (Vec2, Vec2) {
    let middle = Vec2::new(140.0, top + 0.6 * ABOVE);
    let (tail, tip) = (middle - 0.6 * ARROW * along, middle + 0.6 * ARROW * along);
    canvas.arrow(class, tail, tip);
    canvas.keep_free(&[tail, tip], 4.0);
    (tip, Vec2::new(1.0, 0.0))
}

/// What soil presses with: arrows as long as their share of the largest, and the sum of all that press one way.
fn draw_soil(canvas: &mut Canvas, drawing: &Drawing<'_>) {
    let State::Falls(end) = &drawing.state else { return };
    let pressing = || drawing.structure.passive.iter().zip(&end.soil);
    let most = pressing().map(|(_, force)| *force).fold(0.0, f64::max);
    let total = pressing().map(|(_, force)| force).sum::<f64>();
    for way in [1.0, -1.0] {
        let one_way = || pressing().filter(|(element, _)| element.way == way);
        let sum = one_way().map(|(_, force)| force).sum::<f64>();
        if sum <= NOTHING * total {
            continue;
        }
        let drawn = one_way().filter(|(_, force)| **force > NOTHING * most);
        let all: Vec<(Vec2, f64)> = drawn.map(|(element, force)| (canvas.place(element.at), *force)).collect();
        let tail = |(tip, force): &(Vec2, f64)| tip - Vec2::new(way * (10.0 + ARROW * force / most), 0.0);
        for element in &all {
            canvas.arrow("soil", tail(element), element.0);
        }
        if let Some(largest) = all.iter().max_by(|a, b| a.1.total_cmp(&b.1)) {
            let places: Vec<Vec2> = all.iter().flat_map(|element| [tail(element), element.0]).collect();
            canvas.keep_free(&places, 3.0);
            canvas.label(tail(largest), Vec2::new(-way, 0.0), &format!("soil {} kN/m", Rounded(sum / 1e3)));
        }
    }
}

#[cfg(test)]
mod tests;
