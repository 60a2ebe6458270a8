//! Passive elements: what soil that stands still presses on a body that moves into it.
//!
//! Associated plasticity: an element presses as hard as it can where the body moves into it, and not at all where the body moves
//! away. Its force is a function of where the body is: what it has given way by comes back when the body does.

use super::{ActsOn, PointForce};
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
        PointForce { body: self.body, at: self.at, force: Vec2::new(self.way * size, 0.0), acts_on: ActsOn::Point }
    }

    /// Velocity into the soil of a body with this velocity of its centroid and this spin.
    pub fn approach(&self, centroid: Vec2, [u, _, spin]: [f64; 3]) -> f64 {
        -self.way * (u - spin * (self.at.y - centroid.y))
    }
}
