//! A vertical force on a strip: evenly on the surfaces below it, or dispersed by the fill between.

use super::super::{PointForce, Structure};
use super::dispersal::Dispersal;
use super::{LoadFault, LoadedSide, down, plan};
use crate::geometry::Vec2;

/// A vertical force spread evenly over a strip.
#[derive(Debug, Clone, PartialEq)]
pub struct Patch {
    /// Total force, N/m, downwards.
    pub force: f64,
    /// Middle, m.
    pub centre: f64,
    /// Plan width, m.
    pub width: f64,
    /// How it comes down from the surface; `None`: it stands on the extrados itself.
    pub dispersal: Option<Dispersal>,
}

impl Patch {
    pub(super) fn on(&self, structure: &Structure, sides: &[LoadedSide]) -> Result<Vec<PointForce>, LoadFault> {
        let plan = plan(structure);
        match &self.dispersal {
            None => self.directly_on(plan, sides),
            Some(dispersal) => Ok(dispersal
                .shares(self, plan, sides)?
                .into_iter()
                .map(|(body, at, share)| PointForce { body, at, force: down(share * self.force), spread: false })
                .collect()),
        }
    }

    /// Every side takes what lies over it, in the middle of its share.
    fn directly_on(&self, (from, to): (f64, f64), sides: &[LoadedSide]) -> Result<Vec<PointForce>, LoadFault> {
        let [left, right] = self.edges();
        let mut forces = Vec::new();
        let mut covered = 0.0;
        for &(body, a, b) in sides.iter().filter(|(_, a, b)| b.x > a.x) {
            let (from, to) = (left.max(a.x), right.min(b.x));
            if to > from {
                covered += to - from;
                let x = 0.5 * (from + to);
                let at = Vec2::new(x, a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x)));
                let force = down(self.force * (to - from) / self.width);
                forces.push(PointForce { body, at, force, spread: false });
            }
        }
        if (covered - self.width).abs() > 1e-9 * self.width.max(right.abs()) {
            return Err(LoadFault::OffTheArch { from, to });
        }
        Ok(forces)
    }

    fn edges(&self) -> [f64; 2] {
        [self.centre - 0.5 * self.width, self.centre + 0.5 * self.width]
    }
}
