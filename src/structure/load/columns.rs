//! Mass of fill: what stands on the surfaces is shaken with the structure.
//!
//! Over every point of a surface that looks up stands a column of fill, to the top of the fill, and of embankment above it.
//! In an acceleration it pushes with its mass times the acceleration, at half the height of its fill and of its
//! embankment, and the body below carries that. Surfaces that overhang carry no column.

use super::super::{PointForce, Structure};
use super::{Fill, GAUSS_2, LoadFault, LoadedSide, clip, cut, pieces_of};
use crate::geometry::{Vec2, perpendicular};

impl Fill {
    /// The forces of fill and embankment on the bodies below them in an `acceleration`, m/s2, N/m; the surfaces of body `k` are
    /// cut into `pieces[k]` equal pieces each.
    ///
    /// Force and moment on every body are those of its columns. They reach it through its side: the force where each
    /// column stands, and the moment of the horizontal part, whose arm is half the column's height, as a pressure normal
    /// to the side, linear along it and without resultant.
    ///
    /// # Errors
    /// When the fill does not fit the structure.
    pub fn inertia(
        &self,
        structure: &Structure,
        pieces: &[usize],
        acceleration: Vec2,
    ) -> Result<Vec<PointForce>, LoadFault> {
        self.fits(structure)?;
        let mut forces = Vec::new();
        for surface in &structure.surfaces {
            let Some(foot) = self.foot(surface.into()) else { continue };
            let moment = -acceleration.x * self.along(foot, |depth| self.first_moment(depth));
            let stretches = cut(surface.into(), pieces_of(pieces, surface.body)).filter_map(|piece| self.foot(piece));
            forces.extend(stretches.flat_map(|piece| self.carried(piece, foot, acceleration, moment)));
        }
        forces.retain(|force| force.force != Vec2::zeros());
        Ok(forces)
    }

    /// The part of a side on which columns stand.
    fn foot(&self, (k, a, b): LoadedSide) -> Option<LoadedSide> {
        if b.x <= a.x {
            return None;
        }
        match self.height {
            None => Some((k, a, b)),
            Some(level) => clip(a, b, f64::NEG_INFINITY, level).map(|(a, b)| (k, a, b)).filter(|(_, a, b)| b.x > a.x),
        }
    }

    /// What a piece of a foot carries: its columns' force, and its share of the pressure that carries the foot's `moment`.
    fn carried(&self, piece: LoadedSide, foot: LoadedSide, acceleration: Vec2, moment: f64) -> [PointForce; 2] {
        let ((body, a, b), (_, from, to)) = (piece, foot);
        let (length, middle) = ((to - from).norm(), 0.5 * (from + to));
        let (along, slope) = ((to - from) / length, 12.0 * moment / length.powi(3));
        GAUSS_2.map(|share| {
            let at = a + share * (b - a);
            let mass = 0.5 * (b.x - a.x) * self.mass(self.depth(at));
            let pressed = 0.5 * (b - a).norm() * slope * along.dot(&(at - middle)) * perpendicular(along);
            PointForce { body, at, force: mass * acceleration + pressed, spread: false }
        })
    }

    /// Integral over the plan width of a foot of what the depth of fill over it gives; exact to its third power.
    fn along(&self, (_, a, b): LoadedSide, of: impl Fn(f64) -> f64) -> f64 {
        GAUSS_2.iter().map(|&share| 0.5 * (b.x - a.x) * of(self.depth(a + share * (b - a)))).sum()
    }

    /// Depth of fill over a point, m.
    fn depth(&self, at: Vec2) -> f64 {
        self.height.map_or(0.0, |level| level - at.y)
    }

    /// Mass of a column with so much fill in it, kg/m2 of plan.
    fn mass(&self, depth: f64) -> f64 {
        self.density * depth + self.embankment_density * self.embankment
    }

    /// First moment of its mass about its foot, kg/m.
    fn first_moment(&self, depth: f64) -> f64 {
        let embankment = self.embankment_density * self.embankment * (depth + 0.5 * self.embankment);
        0.5 * self.density * depth * depth + embankment
    }
}

#[cfg(test)]
mod tests;
