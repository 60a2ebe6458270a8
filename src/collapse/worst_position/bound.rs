//! What a mechanism that was found at one position says of all others.

use super::super::Analysis;
use super::Place;
use crate::geometry::Vec2;
use crate::structure::{PointForce, Structure};

/// A motion of all bodies that no joint hinders. What the joints take in it does not depend on where the vehicles stand:
/// with P_f and P_s the work of the fixed and of the scaled loads, it is P_f + lambda P_s at the position where the motion was found
/// as that of the collapse. At any other position the structure falls in it at
///
/// ```text
/// lambda' = (P_f + lambda P_s - P_f') / P_s'    where P_s' > 0,
/// ```
///
/// so that no load factor beyond is in equilibrium there.
pub(super) struct Bound {
    /// Velocity at abscissa and height 0, m/s, and spin, rad/s, of every body.
    motion: Vec<[f64; 3]>,
    /// P_f + lambda P_s less the work of the fixed loads that stand still.
    taken: f64,
    /// Work of the scaled loads that stand still.
    standing: f64,
}

impl Bound {
    /// Of a `motion` (velocity of every centroid, spin) that begins at this load factor.
    pub fn new(
        structure: &Structure,
        analysis: &Analysis,
        place: &Place,
        load_factor: f64,
        motion: Vec<[f64; 3]>,
    ) -> Self {
        let about_origin = |([u, v, spin], body): ([f64; 3], &crate::structure::Body)| {
            let arm: Vec2 = body.region.centroid;
            [u + spin * arm.y, v - spin * arm.x, spin]
        };
        let motion = motion.into_iter().zip(&structure.bodies).map(about_origin).collect();
        let mut bound = Bound { motion, taken: 0.0, standing: 0.0 };
        bound.standing = bound.work(&analysis.scaled);
        bound.taken = bound.work(&place.fixed) + load_factor * (bound.standing + bound.work(&place.scaled));
        bound
    }

    /// The load factor at which the structure falls in this motion; infinite where it does not.
    pub fn at(&self, place: &Place) -> f64 {
        let driving = self.standing + self.work(&place.scaled);
        if driving > 0.0 { (self.taken - self.work(&place.fixed)) / driving } else { f64::INFINITY }
    }

    fn work(&self, forces: &[PointForce]) -> f64 {
        let of = |force: &PointForce| {
            let [u, v, spin] = self.motion[force.body];
            force.force.x * (u - spin * force.at.y) + force.force.y * (v + spin * force.at.x)
        };
        forces.iter().map(of).sum()
    }
}
