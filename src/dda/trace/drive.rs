//! What is driven along a path: loads, the ground, and the preload of an unstressed start.

use crate::dda::assembly::Assembly;
use crate::dda::contact::Law;
use crate::dda::moving::{Turn, Twofold};
use crate::geometry::{Vec2, perpendicular};

/// A rigid movement of the ground, per unit of the parameter.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Movement {
    /// Velocity of the point it turns about, m.
    pub velocity: Vec2,
    /// Rotation, counter-clockwise positive, rad.
    pub spin: f64,
    /// The point it turns about, in its reference position, m.
    pub about: Vec2,
}

impl Movement {
    /// Displacement of a point of the ground at a parameter, m; exact however far it turns.
    pub(in crate::dda) fn moves(&self, at: Vec2, parameter: Twofold) -> [Twofold; 2] {
        let turned = Turn::by(self.spin * parameter.high).shift((at - self.about).into());
        let along = |velocity: f64, turned: f64| parameter.times(velocity).plus(Twofold { high: turned, low: 0.0 });
        [along(self.velocity.x, turned[0]), along(self.velocity.y, turned[1])]
    }

    /// Its derivative by the parameter, m.
    pub fn velocity_at(&self, at: Vec2, parameter: f64) -> Vec2 {
        let arm = Turn::by(self.spin * parameter).pair((at - self.about).into());
        self.velocity + perpendicular(Vec2::from(arm)) * self.spin
    }

    /// True where nothing moves.
    pub fn is_still(&self) -> bool {
        self.velocity == Vec2::zeros() && self.spin == 0.0
    }
}

/// What is driven along the path: loads `base + parameter * rate`, an offset of the gaps that changes with the parameter,
/// and movements of the ground.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Drive {
    /// Loads on the nodes at parameter 0, N/m.
    pub base: Vec<f64>,
    /// Change of the loads per unit of the parameter.
    pub rate: Vec<f64>,
    /// Both for the same forces turned by -90 degrees; only a path on moving geometry asks for them.
    pub turned: [Vec<f64>; 2],
    /// Gap offset at parameter 0 and its change per unit of the parameter, m (the same for all unbonded contacts); only
    /// on the reference geometry.
    pub offset: [f64; 2],
    /// Movements of the pieces of ground, by their number; those beyond the end of the list stay.
    pub ground: Vec<Movement>,
}

impl Drive {
    /// Whether gaps change with the parameter where the nodes stay.
    pub(super) fn gaps_drift(&self) -> bool {
        self.offset[1] != 0.0 || !self.ground.is_empty()
    }

    /// Movement of the ground beside interface `k`; none where it stays, or no ground is there.
    pub(in crate::dda) fn moving_ground(&self, assembly: &Assembly, k: usize) -> Option<&Movement> {
        self.ground.get(assembly.ground_at(k)?).filter(|movement| !movement.is_still())
    }
}

/// The drive that takes an assembly from an unstressed start, where every contact is pressed by a fictitious pre-load and
/// the exact answer is D = 0, to its true `loads` on the nodes at parameter 1.
///
/// The pre-load is a gap offset that fades with the parameter, balanced by fictitious loads that fade with it.
pub fn covering(assembly: &Assembly, loads: &[f64], preload: f64) -> Drive {
    let mut base = vec![0.0; loads.len()];
    for (p, contact) in assembly.contacts().iter().enumerate() {
        if contact.law != Law::Bonded {
            assembly.push(p, [-contact.stiffness[0] * preload, 0.0], &mut base);
        }
    }
    let rate = loads.iter().zip(&base).map(|(load, start)| load - start).collect();
    Drive { base, rate, offset: [-preload, preload], ..Drive::default() }
}
