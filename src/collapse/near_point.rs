//! Where stress has no bound: next to forces on points.
//!
//! The nearer to a force on a point, the larger the stress: as one over the distance (Flamant). The mean of its square has no bound
//! either, so the error of a field that takes it in is no number. What the stress is there depends on how the force is borne in
//! truth; a little farther away it does not (Saint-Venant).

use super::Analysis;
use crate::geometry::Vec2;
use crate::structure::{ActsOn, Joint, Side, Structure};

/// What is near, as a share of the least width of the body, and at most as one of its longest joint.
const OF_WIDTH: f64 = 0.25;
const OF_JOINT: f64 = 0.1;

/// What is near a force on a point: the error of a stress field leaves it out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct NearPoint {
    pub centre: Vec2,
    pub radius: f64,
}

impl NearPoint {
    pub(super) fn has(&self, point: Vec2) -> bool {
        (point - self.centre).norm() < self.radius
    }
}

/// The forces on points, those of soil that resists among them: on which body, and where.
pub(super) fn pressed_points(analysis: &Analysis) -> Vec<(usize, Vec2)> {
    let loads = analysis.fixed.iter().chain(&analysis.scaled).filter(|force| force.acts_on == ActsOn::Point);
    let soil = analysis.structure.passive.iter().map(|element| (element.body, element.at));
    loads.map(|force| (force.body, force.at)).chain(soil).collect()
}

/// What is near the forces on points of every body.
pub(super) fn near_points(analysis: &Analysis) -> Vec<Vec<NearPoint>> {
    let structure = &analysis.structure;
    let mut near = vec![Vec::new(); structure.bodies.len()];
    for (body, centre) in pressed_points(analysis) {
        near[body].push(NearPoint { centre, radius: radius(structure, body) });
    }
    near
}

fn radius(structure: &Structure, body: usize) -> f64 {
    let of_body = structure.joints.iter().filter(|joint| joint.between.contains(&Side::Body(body)));
    let longest = of_body.map(Joint::length).fold(0.0, f64::max);
    let corners = &structure.bodies[body].corners;
    let apart = |a: &Vec2| corners.iter().map(|b| (a - b).norm()).fold(0.0, f64::max);
    // The width of a rectangle as large and as long, about.
    let width = structure.bodies[body].region.area / corners.iter().map(apart).fold(0.0, f64::max);
    (OF_WIDTH * width).min(OF_JOINT * longest)
}
