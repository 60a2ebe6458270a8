//! Passive resistance of fill: elements on the sides that face it.
//!
//! Fill beside an arch resists a stone that moves into it. An element stands on every side that looks sideways into the fill
//! (one on each stretch along which the vertical pressure is linear). Its force is horizontal, acts in the middle, towards the
//! structure and without friction, and is at most `(m Kp q_v + m_c 2 c sqrt Kp) dy` with Rankine's `Kp = (1 + sin phi) / (1 - sin
//! phi)`, the vertical pressure q_v of the fill's own weight in the middle, and the mobilised shares m and m_c. Fill behind it
//! stands still; towards another span, where it would move along, there is none, nor where the surface falls below the element
//! within the wedge of fill that would resist, of width `sqrt Kp` times the depth.

use super::Fill;
use crate::geometry::Vec2;
use crate::structure::{PassiveElement, PointForce, Structure, Surface};

/// What fill can resist with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passive {
    /// Largest share of the vertical pressure that it resists with: `m Kp`.
    pub most: f64,
    /// What cohesion adds to that, Pa: `m_c 2 c sqrt Kp`.
    pub cohesion: f64,
    /// Share of the vertical pressure that it presses with in any case: none, or Rankine's active `1 / Kp`.
    pub least: f64,
    /// What backing resists with, in place of the first two, Pa.
    pub backing: Option<f64>,
    /// How far the wedge that resists reaches at the surface, over the depth below it: `sqrt Kp`.
    pub wedge: f64,
    /// Movement into the fill that mobilises all of it, over the depth below the surface.
    pub mobilised_at: f64,
}

impl Passive {
    /// The elements of fill on a structure, and the forces, N/m, with which it presses in any case.
    pub fn of(&self, fill: &Fill, structure: &Structure) -> (Vec<PassiveElement>, Vec<PointForce>) {
        let (mut elements, mut always) = (Vec::new(), Vec::new());
        for surface in structure.surfaces.iter().filter(|surface| faces_out(surface, &structure.surfaces)) {
            let [a, b] = surface.ends;
            for [from, to] in fill.stretches(a, b) {
                let (at, height, way) = (0.5 * (from + to), (to.y - from.y).abs(), (to.y - from.y).signum());
                let depth = fill.depth(at);
                // The wedge that resists reaches so far at the surface (Rankine).
                let beside = Vec2::new(at.x - way * self.wedge * depth, at.y);
                if depth <= 0.0 || fill.lowest([at.x, beside.x]) <= at.y {
                    continue;
                }
                let pressure = fill.pressure(at);
                let backing = self.backing.filter(|_| fill.is_backing(at));
                let most = backing.unwrap_or(self.most * pressure + self.cohesion);
                let (least, mobilised_at) = ((self.least * pressure).min(most), self.mobilised_at * depth);
                let most = (most - least) * height;
                let element = PassiveElement { body: surface.body, at, way, most, mobilised_at };
                always.extend((least > 0.0).then(|| element.force(least * height)));
                elements.extend((most > 0.0).then_some(element));
            }
        }
        (elements, always)
    }
}

/// Whether a surface looks away from all others: none beyond it looks towards it, as that of another span would.
fn faces_out(surface: &Surface, all: &[Surface]) -> bool {
    let rise = |of: &Surface| of.ends[1].y - of.ends[0].y;
    let middle = |of: &Surface| 0.5 * (of.ends[0].x + of.ends[1].x);
    let way = rise(surface).signum();
    let towards = |other: &Surface| way * rise(other) < 0.0 && way * (middle(other) - middle(surface)) < 0.0;
    rise(surface) != 0.0 && !all.iter().any(towards)
}

#[cfg(test)]
mod tests;
