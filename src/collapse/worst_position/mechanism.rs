//! What a mechanism that was found at one position says of others.

use super::Place;
use crate::geometry::Vec2;
use crate::structure::{Body, PointForce, Structure};

/// A motion of all bodies that no joint hinders. What the joints take in it does not depend on where the vehicles stand.
#[derive(Debug, Clone)]
pub(super) struct Mechanism {
    /// Velocity at abscissa and height 0, m/s, and spin, rad/s, of every body.
    motion: Vec<[f64; 3]>,
    /// Work of all scaled loads where it was found, at the load factor at which it began there: what the fixed loads leave to them.
    taken: f64,
}

impl Mechanism {
    /// Of a `motion` (velocity of every centroid, spin) that begins at this load factor of all `scaled` loads.
    pub fn new(structure: &Structure, load_factor: f64, scaled: &[PointForce], motion: Vec<[f64; 3]>) -> Self {
        let about_origin = |([u, v, spin], body): ([f64; 3], &Body)| {
            let arm: Vec2 = body.region.centroid;
            [u + spin * arm.y, v - spin * arm.x, spin]
        };
        let motion = motion.into_iter().zip(&structure.bodies).map(about_origin).collect();
        let mut mechanism = Mechanism { motion, taken: 1.0 };
        mechanism.taken = load_factor * mechanism.work(scaled);
        mechanism
    }

    /// Work of the vehicles' loads at a place and a load factor, as a share of what is taken.
    pub fn driven(&self, place: &Place, load_factor: f64) -> f64 {
        (self.work(&place.fixed) + load_factor * self.work(&place.scaled)) / self.taken
    }

    fn work(&self, forces: &[PointForce]) -> f64 {
        let of = |force: &PointForce| {
            let [u, v, spin] = self.motion[force.body];
            force.force.x * (u - spin * force.at.y) + force.force.y * (v + spin * force.at.x)
        };
        forces.iter().map(of).sum()
    }
}
