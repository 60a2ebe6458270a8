//! Where stress has no bound: next to forces on points.
//!
//! The nearer to a force on a point, the larger the stress: as one over the distance (Flamant). The mean of its square has no bound
//! either, so the error of a field that takes it in is no number. What the stress is there depends on how the force is borne in
//! truth; a little farther away it does not (Saint-Venant).

use super::Analysis;
use crate::geometry::Vec2;
use crate::structure::{ActsOn, Body};

/// What is near, as a share of the least width of the body.
const NEAR: f64 = 0.25;

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

/// What is near the forces on points of every body, those of soil that resists among them.
pub(super) fn near_points(analysis: &Analysis) -> Vec<Vec<NearPoint>> {
    let structure = &analysis.structure;
    let mut near = vec![Vec::new(); structure.bodies.len()];
    let loads = analysis.fixed.iter().chain(&analysis.scaled).filter(|force| force.acts_on == ActsOn::Point);
    let points = loads.map(|force| (force.body, force.at));
    for (body, centre) in points.chain(structure.passive.iter().map(|element| (element.body, element.at))) {
        let radius = NEAR * least_width(&structure.bodies[body]);
        near[body].push(NearPoint { centre, radius });
    }
    near
}

/// The width of a rectangle as large and as long, about, m.
fn least_width(body: &Body) -> f64 {
    let apart = |a: &Vec2| body.corners.iter().map(|b| (a - b).norm()).fold(0.0, f64::max);
    body.region.area / body.corners.iter().map(apart).fold(0.0, f64::max)
}
