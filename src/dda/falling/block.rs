//! A rigid block: four corners that keep their distances, and forces that move with its material.

use crate::dda::moving::Turn;
use crate::geometry::{Region, Vec2, cross};
use nalgebra::Vector3;

/// Corners counter-clockwise: inner end of the face towards the block before, inner and outer end of the face towards the
/// block after, outer end of the face towards the block before.
pub type Corners = [Vec2; 4];

/// Where a block is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Its centroid, m.
    pub centroid: Vec2,
    /// Turned by so much since the start, counter-clockwise, rad.
    pub angle: f64,
}

/// `arm` turned by `angle`.
pub(super) fn turned(arm: Vec2, angle: f64) -> Vec2 {
    Turn::by(angle).pair(arm.into()).into()
}

impl Place {
    /// Where the material point at `arm` from the centroid at the start is now.
    pub fn point(&self, arm: Vec2) -> Vec2 {
        self.centroid + turned(arm, self.angle)
    }

    /// Moved by (u, v, rotation).
    pub(super) fn moved(&self, by: &Vector3<f64>) -> Place {
        Place { centroid: self.centroid + Vec2::new(by.x, by.y), angle: self.angle + by.z }
    }
}

/// A rigid block as it was at the start.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// Its centroid, m.
    pub centroid: Vec2,
    /// Corners from the centroid, m.
    arms: Corners,
    /// Mass, kg/m, and moment of inertia about the centroid, kg m.
    pub(super) inertia: [f64; 2],
    /// Forces, N/m, and where they act, from the centroid, m.
    pushes: Vec<(Vec2, Vec2)>,
    /// True for a block that cannot move.
    pub fixed: bool,
}

impl Block {
    /// A block of the given density, kg/m3, without forces.
    pub fn new(corners: Corners, density: f64) -> Self {
        let region = Region::polygon(&corners);
        let arms = corners.map(|corner| corner - region.centroid);
        let inertia = [density * region.area, density * second_moment(&arms)];
        Block { centroid: region.centroid, arms, inertia, pushes: Vec::new(), fixed: false }
    }

    /// Adds a force of constant direction, N/m, at the material point that is at `at`, m, at the start.
    pub fn push(&mut self, at: Vec2, force: Vec2) {
        self.pushes.push((at - self.centroid, force));
    }

    /// Where it is at the start.
    pub fn start(&self) -> Place {
        Place { centroid: self.centroid, angle: 0.0 }
    }

    /// Its corners in a place, m.
    pub fn corners(&self, place: &Place) -> Corners {
        self.arms.map(|arm| place.point(arm))
    }

    /// Resultant of its forces in a place: force, N/m, and moment about the centroid, N.
    pub(super) fn load(&self, place: &Place) -> Vector3<f64> {
        let part =
            |&(arm, force): &(Vec2, Vec2)| Vector3::new(force.x, force.y, cross(turned(arm, place.angle), force));
        self.pushes.iter().map(part).sum()
    }

    /// Work of its forces between two places, N.
    pub(super) fn work(&self, from: &Place, to: &Place) -> f64 {
        self.pushes.iter().map(|&(arm, force)| force.dot(&(to.point(arm) - from.point(arm)))).sum()
    }

    /// Sum of its forces' sizes, N/m.
    pub(super) fn pushed(&self) -> f64 {
        self.pushes.iter().map(|(_, force)| force.norm()).sum()
    }
}

/// Polar second moment of a polygon about the origin, m4; positive for counter-clockwise corners.
fn second_moment(corners: &[Vec2]) -> f64 {
    let pair = |i: usize| (corners[i], corners[(i + 1) % corners.len()]);
    let part = |(a, b): (Vec2, Vec2)| cross(a, b) * (a.dot(&a) + a.dot(&b) + b.dot(&b)) / 12.0;
    (0..corners.len()).map(|i| part(pair(i))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle() -> Block {
        Block::new([(1.0, 1.0), (5.0, 1.0), (5.0, 3.0), (1.0, 3.0)].map(|(x, y)| Vec2::new(x, y)), 2.0)
    }

    #[test]
    fn a_rectangle_has_its_mass_and_moment_of_inertia() {
        let [mass, inertia] = rectangle().inertia;
        assert_eq!(mass, 16.0);
        assert!((inertia - mass * (16.0 + 4.0) / 12.0).abs() < 1e-12);
    }

    #[test]
    fn a_turned_block_keeps_its_area() {
        let block = rectangle();
        let place = Place { centroid: Vec2::new(-3.0, 7.0), angle: 12.3 };
        let region = Region::polygon(&block.corners(&place));
        assert!((region.area - 8.0).abs() < 1e-12 && (region.centroid - place.centroid).norm() < 1e-12);
    }

    #[test]
    fn a_force_moves_with_its_material_point_and_keeps_its_direction() {
        let mut block = rectangle();
        block.push(Vec2::new(5.0, 2.0), Vec2::new(0.0, -3.0));
        assert_eq!(block.load(&block.start()), Vector3::new(0.0, -3.0, -6.0));
        let upright = Place { angle: std::f64::consts::FRAC_PI_2, ..block.start() };
        assert!((block.load(&upright) - Vector3::new(0.0, -3.0, 0.0)).norm() < 1e-12);
        assert!((block.work(&block.start(), &upright) + 6.0).abs() < 1e-12);
    }
}
