//! What is drawn of a structure that is not one arch: every body by its corners.

use super::{MOVEMENT, draw_ground, thrust_line};
use crate::collapse::PathEnd;
use crate::geometry::{Vec2, perpendicular};
use crate::render::canvas::Canvas;
use crate::structure::{Side, Structure};

/// A body whose corners are slower than this share of the fastest is at rest.
const AT_REST: f64 = 1e-3;

/// Added to the style of an arch.
pub(super) const BODY_STYLE: &str = ".resultant{fill:#c8392b}\n";

/// Outlines of the bodies that move, moved.
pub(super) fn moved(structure: &Structure, end: &PathEnd) -> Vec<Vec<Vec2>> {
    let bodies = || structure.bodies.iter().zip(&end.mechanism.velocities);
    let velocities = bodies().map(|(body, &[u, v, w])| {
        let at = |p: &Vec2| Vec2::new(u, v) + w * perpendicular(p - body.region.centroid);
        body.corners.iter().map(at).collect::<Vec<_>>()
    });
    let velocities: Vec<Vec<Vec2>> = velocities.collect();
    let speed = |body: &[Vec2]| body.iter().map(Vec2::norm).fold(0.0, f64::max);
    let fastest = velocities.iter().map(|body| speed(body)).fold(0.0, f64::max);
    if !(fastest > 0.0 && fastest.is_finite()) {
        return Vec::new();
    }
    let scale = MOVEMENT * size(structure) / fastest;
    let moving = structure.bodies.iter().zip(&velocities).filter(|(_, rates)| speed(rates) > AT_REST * fastest);
    moving.map(|(body, rates)| body.corners.iter().zip(rates).map(|(p, v)| p + scale * v).collect()).collect()
}

/// The longer side of the box round all corners, m.
fn size(structure: &Structure) -> f64 {
    let none = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
    let corners = structure.bodies.iter().flat_map(|body| &body.corners);
    let (low, high) = corners.fold(none, |(low, high), p| (low.inf(p), high.sup(p)));
    (high - low).max()
}

/// The ground under every joint on a support, and all bodies.
pub(super) fn draw(canvas: &mut Canvas, structure: &Structure) {
    for joint in &structure.joints {
        for (side, sign) in joint.between.into_iter().zip([-1.0, 1.0]) {
            if matches!(side, Side::Support(_)) {
                draw_ground(canvas, joint, sign);
            }
        }
    }
    for body in &structure.bodies {
        canvas.polygon("stone", &body.corners);
    }
}

/// The thrust line of every ring, and where the force of every joint crosses it.
pub(super) fn draw_thrust(canvas: &mut Canvas, structure: &Structure, end: &PathEnd) {
    for span in &structure.spans {
        canvas.polyline("thrust", &thrust_line(structure, end, span.joints.clone()));
    }
    for at in thrust_line(structure, end, 0..structure.joints.len()) {
        let at = canvas.place(at);
        canvas.dot("resultant", at, 2.6);
    }
}
