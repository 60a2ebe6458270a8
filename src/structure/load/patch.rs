//! A vertical force on a strip: evenly on the surfaces below it, or dispersed by the fill between.

use super::super::{ActsOn, PointForce, Structure};
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
    /// What does not stand over the surfaces itself, without a dispersal, is an error.
    pub(super) fn on(&self, structure: &Structure, sides: &[LoadedSide]) -> Result<Vec<PointForce>, LoadFault> {
        self.forces(structure, sides, false)
    }

    /// The same where what lies beyond the surfaces goes to the ground.
    pub(super) fn partly_on(&self, structure: &Structure, sides: &[LoadedSide]) -> Result<Vec<PointForce>, LoadFault> {
        self.forces(structure, sides, true)
    }

    fn forces(&self, structure: &Structure, sides: &[LoadedSide], partly: bool) -> Result<Vec<PointForce>, LoadFault> {
        let (from, to) = plan(structure);
        match &self.dispersal {
            None => {
                let (forces, covered) = self.directly_on(sides);
                let beyond = self.width - covered;
                let rounding = 1e-9 * self.width.max(self.edges()[1].abs());
                let fits = beyond.abs() <= rounding || (partly && beyond > 0.0);
                if fits { Ok(forces) } else { Err(LoadFault::OffTheArch { from, to }) }
            }
            Some(dispersal) => Ok(dispersal
                .shares(self, (from, to), sides)?
                .into_iter()
                .map(|(body, at, share)| PointForce {
                    body,
                    at,
                    force: down(share * self.force),
                    acts_on: ActsOn::Side,
                })
                .collect()),
        }
    }

    /// Every side takes what lies over it, in the middle of its share; and how much of the width that is.
    fn directly_on(&self, sides: &[LoadedSide]) -> (Vec<PointForce>, f64) {
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
                forces.push(PointForce { body, at, force, acts_on: ActsOn::Side });
            }
        }
        (forces, covered)
    }

    fn edges(&self) -> [f64; 2] {
        [self.centre - 0.5 * self.width, self.centre + 0.5 * self.width]
    }
}
