//! The contact point: gap, Coulomb law, and the functions whose zeros are its changes of state.

use super::block::V6;

/// What holds two faces together at a contact point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    /// Neither opens nor slides.
    Bonded,
    /// Unilateral, with |T| <= min(friction N + cohesion, steep N).
    Coulomb {
        /// tan(phi).
        friction: f64,
        /// Cohesion force of this point, N/m.
        cohesion: f64,
    },
}

/// Slope of the branch that brings a cohesive point's shear capacity down to zero as its normal force vanishes.
///
/// Coulomb's law with cohesion jumps where N -> 0 with T != 0, and no continuous path passes a jump. Below
/// N = cohesion / (steep - friction) the capacity is `STEEP * N` instead: inside Coulomb's law, so still safe, and
/// continuous. A larger value comes closer to the jump and worsens the conditioning in proportion.
pub const STEEP: f64 = 100.0;

impl Law {
    /// Branches (slope, intercept) of the shear capacity: the capacity is their smallest value at N >= 0.
    pub fn branches(&self) -> [(f64, f64); 2] {
        match *self {
            Law::Bonded => [(f64::INFINITY, f64::INFINITY); 2],
            Law::Coulomb { friction, cohesion: 0.0 } => [(friction, 0.0); 2],
            Law::Coulomb { friction, cohesion } => [(friction, cohesion), (friction + STEEP, 0.0)],
        }
    }

    /// Number of distinct branches.
    pub fn branch_count(&self) -> usize {
        match *self {
            Law::Bonded => 0,
            Law::Coulomb { cohesion: 0.0, .. } => 1,
            Law::Coulomb { .. } => 2,
        }
    }

    /// True where the point can carry no shear at all.
    pub fn frictionless(&self) -> bool {
        matches!(*self, Law::Coulomb { friction: 0.0, cohesion: 0.0 })
    }

    /// Largest |T| under the normal force `n` >= 0.
    pub fn capacity(&self, n: f64) -> f64 {
        self.branches().iter().map(|(slope, intercept)| slope * n + intercept).fold(f64::INFINITY, f64::min)
    }
}

/// State of a contact point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum State {
    /// Apart: N = T = 0.
    Open,
    /// Pressed and held by friction: T from the tangential spring.
    Stick,
    /// Pressed and sliding: T = sign * (slope N + intercept) of the branch.
    Slip {
        /// +1 or -1: the sign of T.
        sign: f64,
        /// Which branch of the capacity.
        branch: usize,
    },
    /// Glued for good.
    Bonded,
}

/// A contact point between the block before and the block after an interface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Rows of the normal gap over the unknowns of the block before and the block after.
    pub normal: [V6; 2],
    /// Rows of the tangential gap over the same.
    pub tangent: [V6; 2],
    /// Normal and tangential penalty stiffness, N/m2 (per metre of depth).
    pub stiffness: [f64; 2],
    /// Its law.
    pub law: Law,
}

/// Force and opening at a contact point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactForce {
    /// Normal force, compression positive, N/m.
    pub normal: f64,
    /// Tangential force on the block after, N/m.
    pub tangential: f64,
    /// Normal gap, open positive, m.
    pub gap: f64,
    /// Tangential gap, m.
    pub slip: f64,
}

impl Contact {
    /// Normal force as the linear function it is while closed (negative when open), N/m.
    pub fn pressure(&self, gap: f64) -> f64 {
        -self.stiffness[0] * gap
    }

    /// Tangential force as if stuck to `anchor`, N/m.
    pub fn trial_shear(&self, slip: f64, anchor: f64) -> f64 {
        -self.stiffness[1] * (slip - anchor)
    }

    /// Force by the law itself, whatever the state: N = max(0, -k_n g_n), T = trial T within the capacity.
    pub fn force(&self, gap: f64, slip: f64, anchor: f64) -> ContactForce {
        let (n, t) = (self.pressure(gap), self.trial_shear(slip, anchor));
        let (normal, tangential) = match self.law {
            Law::Bonded => (n, t),
            _ if n <= 0.0 => (0.0, 0.0),
            law => (n, t.clamp(-law.capacity(n), law.capacity(n))),
        };
        ContactForce { normal, tangential, gap, slip }
    }

    /// State in which a closed point starts.
    pub fn closed_state(&self) -> State {
        match self.law {
            Law::Bonded => State::Bonded,
            law if law.frictionless() => State::Slip { sign: 1.0, branch: 0 },
            _ => State::Stick,
        }
    }

    /// State of a point that closes with the trial shear `shear`: on the boundary N = 0 only slip is continuous.
    pub fn closing_state(&self, shear: f64) -> State {
        State::Slip { sign: if shear < 0.0 { -1.0 } else { 1.0 }, branch: self.law.branch_count().max(1) - 1 }
    }

    /// Calls `see(value, rate, next state)` for every way out of `state`, each a function that is positive inside the
    /// state and vanishes at its border, with (N, trial T, gap) given by value and rate.
    pub fn ways_out(&self, state: State, n: [f64; 2], t: [f64; 2], mut see: impl FnMut(f64, f64, State)) {
        match state {
            State::Bonded => {}
            State::Open => {
                let k = self.stiffness[0];
                see(-n[0] / k, -n[1] / k, self.closing_state(t[0]));
            }
            State::Stick => {
                see(n[0], n[1], State::Open);
                for branch in 0..self.law.branch_count() {
                    let (slope, intercept) = self.law.branches()[branch];
                    for sign in [1.0, -1.0] {
                        let value = slope * n[0] + intercept - sign * t[0];
                        see(value, slope * n[1] - sign * t[1], State::Slip { sign, branch });
                    }
                }
            }
            State::Slip { sign, branch } => {
                see(n[0], n[1], State::Open);
                if self.law.frictionless() {
                    return;
                }
                let branches = self.law.branches();
                let (slope, intercept) = branches[branch];
                see(sign * t[0] - (slope * n[0] + intercept), sign * t[1] - slope * n[1], State::Stick);
                if self.law.branch_count() == 2 {
                    let (other_slope, other_intercept) = branches[1 - branch];
                    let value = (other_slope - slope) * n[0] + other_intercept - intercept;
                    see(value, (other_slope - slope) * n[1], State::Slip { sign, branch: 1 - branch });
                }
            }
        }
    }
}
