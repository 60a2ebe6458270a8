//! Rigid motions of stones, and what loads do in them.

use super::{Analysis, Mechanism};
use crate::geometry::{Vec2, perpendicular};

/// A plane rigid velocity field: v(x) = velocity + spin * perpendicular(x).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Motion {
    pub velocity: Vec2,
    pub spin: f64,
}

impl Motion {
    pub(super) const STILL: Motion = Motion { velocity: Vec2::new(0.0, 0.0), spin: 0.0 };

    /// Rotation with the given spin about `centre`.
    pub(super) fn about(centre: Vec2, spin: f64) -> Self {
        Motion { velocity: -perpendicular(centre) * spin, spin }
    }

    /// This motion and `rate` times the other.
    pub(super) fn plus(self, other: Motion, rate: f64) -> Self {
        Motion { velocity: self.velocity + other.velocity * rate, spin: self.spin + other.spin * rate }
    }

    /// Velocity of the point `x`.
    pub(super) fn at(&self, x: Vec2) -> Vec2 {
        self.velocity + perpendicular(x) * self.spin
    }
}

/// Velocity field of a block from the velocity and spin at its centroid.
pub(super) fn motion_at(centroid: Vec2, velocity: Vec2, spin: f64) -> Motion {
    Motion { velocity: velocity - perpendicular(centroid) * spin, spin }
}

/// Power of all loads at a load factor in a mechanism, as a share of the sum of |force| |velocity|.
pub(super) fn power(analysis: &Analysis, mechanism: &Mechanism, load_factor: f64) -> f64 {
    let loads = analysis.fixed.iter().map(|f| (f, 1.0)).chain(analysis.scaled.iter().map(|f| (f, load_factor)));
    let (mut done, mut possible) = (0.0, f64::MIN_POSITIVE);
    let fastest = mechanism.velocities.iter().map(|[u, v, _]| u.hypot(*v)).fold(0.0, f64::max);
    for (force, factor) in loads {
        let [u, v, spin] = mechanism.velocities[force.body];
        let centroid = analysis.structure.bodies[force.body].region.centroid;
        let velocity = motion_at(centroid, Vec2::new(u, v), spin).at(force.at);
        done += factor * force.force.dot(&velocity);
        possible += (factor * force.force.norm() * fastest).abs();
    }
    done / possible
}
