//! One picture of a structure in one state: stones, fill, supports and loads, its measures, the thrust, and how it moves.

mod dimensions;
mod fill;
mod legend;
mod loads;
mod moving;
mod signs;
mod style;
mod supports;
mod thrust;

use super::canvas::{Canvas, Space};
use super::heading::Heading;
use crate::collapse::{PathEnd, SettlementPath, Thrust};
use crate::geometry::Vec2;
use crate::structure::load::Fill;
use crate::structure::{Joint, Structure};
pub use loads::{Acting, Mark};
use moving::Moved;
pub use thrust::resultants;

/// White space left and right of a drawing, pixels; with signs or measures beside it.
const SIDE: [f64; 2] = [64.0, 124.0];

/// Joints of more stones are drawn as fine lines.
const MANY: usize = 400;

/// What is drawn.
#[derive(Debug, Clone)]
pub struct Drawing<'a> {
    /// The structure.
    pub structure: &'a Structure,
    /// What lies on it, lowest first.
    pub fills: Vec<Fill>,
    /// What else acts on it.
    pub loads: Vec<Acting>,
    /// Joints that are not as the others.
    pub altered: Vec<usize>,
    /// In which state.
    pub state: State<'a>,
    /// What it is called.
    pub title: String,
    /// What stands below that.
    pub caption: String,
    /// All of it in words.
    pub description: String,
}

/// The state that is drawn.
#[derive(Debug, Clone)]
pub enum State<'a> {
    /// As it begins to fall.
    Falls(&'a PathEnd),
    /// As it stands, with the least and the greatest thrust, N/m, where they are bounded.
    Stands([Option<(f64, &'a [Thrust])>; 2]),
    /// As it stands, with one of many ways in which its joints may press.
    Presses(Vec<Thrust>),
    /// At the end of a movement of its supports, which would have gone so far.
    Settles(&'a SettlementPath),
    /// Nothing is known of it.
    Unknown,
}

/// Draws it as SVG.
pub fn svg(drawing: &Drawing<'_>) -> String {
    let moved = Moved::of(drawing);
    let ground = fill::strata(drawing.structure, &drawing.fills);
    let (low, high) = extent(drawing, &moved, &ground);
    let heading = Heading::new(&drawing.title, &drawing.caption);
    let entries = legend::rows(legend::entries(drawing, &moved, &ground));
    let foot = supports::DEPTH + dimensions::DEPTH + legend::height(&entries);
    let beside = loads::from_beside(drawing) || drawing.structure.spans.is_empty();
    let space = Space { head: heading.height() + 16.0, side: SIDE[usize::from(beside)], foot };
    // Arrows may need more room above the structure than there is.
    let head = space.head + loads::needed_above(drawing, &Canvas::new(low, high, space), space.head);
    let mut canvas = Canvas::new(low, high, Space { head, ..space });
    let bottom = canvas.height() - legend::height(&entries);
    canvas.keep_labels_between(heading.height(), bottom);
    fill::draw(&mut canvas, &ground);
    supports::draw(&mut canvas, drawing.structure);
    draw_stones(&mut canvas, drawing);
    moved.draw(&mut canvas);
    thrust::draw(&mut canvas, drawing);
    loads::draw(&mut canvas, drawing, heading.height());
    signs::draw(&mut canvas, drawing);
    dimensions::draw(&mut canvas, drawing, bottom);
    canvas.heading(&heading);
    legend::draw(&mut canvas, &entries);
    canvas.finish("drawing", &drawing.title, &drawing.description, style::STYLE)
}

/// True for one ring of voussoirs from springing to springing, with or without abutment blocks.
fn is_arch(structure: &Structure) -> bool {
    let [span] = structure.spans.as_slice() else { return false };
    span.bodies == (0..structure.voussoirs().len()) && span.joints == (0..structure.ring().len())
}

fn draw_stones(canvas: &mut Canvas, drawing: &Drawing<'_>) {
    let structure = drawing.structure;
    // What is glued to the ground is part of it to the eye.
    let voussoirs = structure.voussoirs().len();
    let stones = |bodies: std::ops::Range<usize>| structure.bodies[bodies].iter().map(|body| body.corners.as_slice());
    if voussoirs < structure.bodies.len() {
        canvas.polygons("abutment", stones(voussoirs..structure.bodies.len()));
    }
    let class = if voussoirs > MANY { "fine" } else { "stone" };
    canvas.polygons(class, stones(0..voussoirs));
    for joint in drawing.altered.iter().filter_map(|&joint| structure.joints.get(joint)) {
        canvas.polyline("altered", &[joint.intrados, joint.extrados]);
    }
}

/// The box around these points, m.
fn bounds(points: impl Iterator<Item = Vec2>) -> (Vec2, Vec2) {
    let none = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
    points.fold(none, |(low, high), p| (low.inf(&p), high.sup(&p)))
}

/// The box around all bodies, m.
fn box_of(structure: &Structure) -> (Vec2, Vec2) {
    bounds(structure.bodies.iter().flat_map(|body| body.corners.iter().copied()))
}

fn extent(drawing: &Drawing<'_>, moved: &Moved, ground: &[fill::Stratum]) -> (Vec2, Vec2) {
    let bodies = drawing.structure.bodies.iter().flat_map(|body| &body.corners);
    let others = moved.pieces.iter().flatten().chain(ground.iter().flat_map(|stratum| &stratum.outline));
    bounds(bodies.chain(others).copied().chain(loads::places(drawing)))
}

/// A direction of the structure on the sheet, where y goes downwards.
fn on_sheet(direction: Vec2) -> Vec2 {
    Vec2::new(direction.x, -direction.y)
}

/// The direction along a joint from one end to the other on the sheet; across it where they are one.
fn along(joint: &Joint) -> Vec2 {
    on_sheet(joint.tangent())
}

#[cfg(test)]
#[path = "figure_tests.rs"]
mod tests;
