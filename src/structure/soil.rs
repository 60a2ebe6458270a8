//! Passive resistance of soil: horizontal forces between none and a limit on the sides that face it.
//!
//! Soil beside an arch resists a stone that moves into it and follows one that moves away. One element stands on every side
//! that looks sideways into the soil; its force acts horizontally in the middle of that side, towards the structure, without
//! friction, and soil behind it stands still. Associated plasticity: the element presses as hard as it can where the stone
//! moves into it, and as little as it may where the stone moves away. Between spans, where the soil would move along, there is
//! none.

use super::{PointForce, Structure, Surface};
use crate::geometry::Vec2;

/// A horizontal force on a body, between 0 and a limit, that soil takes up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PassiveElement {
    /// Whom it presses on.
    pub body: usize,
    /// Where, m.
    pub at: Vec2,
    /// +1 where it presses to the right, -1 where it presses to the left.
    pub way: f64,
    /// Largest force, N/m; positive.
    pub most: f64,
    /// Movement of the stone into the soil at which the force has grown to that, m. The collapse load does not depend on it.
    pub mobilised_at: f64,
}

impl PassiveElement {
    /// A force of this size of it, N/m.
    pub fn force(&self, size: f64) -> PointForce {
        PointForce { body: self.body, at: self.at, force: Vec2::new(self.way * size, 0.0), spread: false }
    }

    /// Velocity into the soil of a body with this velocity of its centroid and this spin.
    pub fn approach(&self, centroid: Vec2, [u, _, spin]: [f64; 3]) -> f64 {
        -self.way * (u - spin * (self.at.y - centroid.y))
    }
}

/// What soil can resist with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passive {
    /// Share of the vertical pressure that it resists with, a pure number: the mobilised part of Rankine's coefficient
    /// `Kp = (1 + sin phi) / (1 - sin phi)`.
    pub ratio: f64,
    /// What cohesion adds to that, Pa: the mobilised part of `2 c sqrt(Kp)`.
    pub cohesion: f64,
    /// Share of the vertical pressure that it presses with at least: none, or Rankine's active `1 / Kp`.
    pub least: f64,
    /// Movement into the soil that mobilises all of it, over the depth below the surface.
    pub mobilised_at: f64,
}

/// Soil at a point: its depth below the surface, m, and its vertical pressure, Pa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overburden {
    /// Depth below the surface, m; negative above it.
    pub depth: f64,
    /// Pressure of what lies above, Pa.
    pub pressure: f64,
}

impl Passive {
    /// The elements on a structure, and the forces, N/m, that the least pressure puts on it in any case. `soil` is what lies
    /// over a point.
    pub fn on(
        &self,
        structure: &Structure,
        soil: impl Fn(Vec2) -> Overburden,
    ) -> (Vec<PassiveElement>, Vec<PointForce>) {
        let (mut elements, mut least) = (Vec::new(), Vec::new());
        for surface in structure.surfaces.iter().filter(|surface| faces_out(surface, &structure.surfaces)) {
            let [a, b] = surface.ends;
            let at = 0.5 * (a + b);
            let Overburden { depth, pressure } = soil(at);
            if depth <= 0.0 {
                continue;
            }
            let (height, way) = ((b.y - a.y).abs(), (b.y - a.y).signum());
            let always = self.least * pressure * height;
            let most = (self.ratio * pressure + self.cohesion) * height - always;
            let element = PassiveElement { body: surface.body, at, way, most, mobilised_at: self.mobilised_at * depth };
            least.extend((always > 0.0).then(|| element.force(always)));
            elements.extend((most > 0.0).then_some(element));
        }
        (elements, least)
    }
}

/// Whether soil lies beside a surface as far as one sees horizontally.
fn faces_out(surface: &Surface, all: &[Surface]) -> bool {
    let [a, b] = surface.ends;
    if a.y == b.y {
        return false;
    }
    let (middle, way) = (0.5 * (a + b), (b.y - a.y).signum());
    all.iter().all(|other| {
        let [c, d] = other.ends;
        let crosses = c.y.min(d.y) < middle.y && middle.y < c.y.max(d.y) && other.body != surface.body;
        // Where the other surface is at this height.
        let x = c.x + (d.x - c.x) * ((middle.y - c.y) / (d.y - c.y));
        !crosses || way * (x - middle.x) > 0.0
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::load::tests_support::semicircle;
}
