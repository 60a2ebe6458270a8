//! The contact point: gap, Coulomb law with cohesion, and the functions whose zeros are its changes of state.

/// What holds two faces together at a contact point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    /// Neither opens nor slides.
    Bonded,
    /// Unilateral, with 0 <= N <= cap and |T| <= friction N + cohesion.
    Coulomb {
        /// tan(phi).
        friction: f64,
        /// Cohesion force of this point, N/m.
        cohesion: f64,
        /// Largest normal force, N/m; infinite where nothing crushes. What closes further does so at this force, and what opens
        /// again goes back the way it came: N is a function of the gap alone.
        cap: f64,
    },
}

/// Gap over which a cohesive point that opens loses its cohesion, as a multiple of cohesion / k_n.
///
/// Coulomb's law with cohesion jumps where N -> 0 with T != 0, and no continuous path passes a jump. Over this gap,
/// some hundredths of a millimetre, the shear capacity falls linearly to zero instead. A larger reach softens the fall
/// (at 10 it acts like friction of 0.1); the joint's capacity never exceeds Coulomb's with all its cohesion.
pub const ADHESION_REACH: f64 = 10.0;

/// Where on the gap axis a point that can carry shear is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Zone {
    /// Gap < 0: N = -k_n gap, capacity = friction N + cohesion.
    Pressed,
    /// 0 <= gap < reach: N = 0, capacity falls from the cohesion to zero.
    Adhering,
    /// Gap < -cap / k_n: N = cap, capacity = friction cap + cohesion.
    Capped,
}

/// State of a contact point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum State {
    /// Apart: N = T = 0.
    Open,
    /// Held: T from the tangential spring.
    Stick(Zone),
    /// Sliding: T = sign * capacity.
    Slip {
        /// +1 or -1: the sign of T.
        sign: f64,
        /// Where.
        zone: Zone,
    },
    /// Glued for good.
    Bonded,
}

/// Zone of a state that can carry shear.
pub(super) fn zone(state: State) -> Option<Zone> {
    match state {
        State::Stick(zone) | State::Slip { zone, .. } => Some(zone),
        State::Open | State::Bonded => None,
    }
}

/// A contact point between the block before and the block after an interface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Normal and tangential penalty stiffness, N/m2 (per metre of width).
    pub stiffness: [f64; 2],
    /// Its law.
    pub law: Law,
    /// Shear capacity in every zone were the gap zero, N/m.
    capacities: [f64; 3],
    /// Fall of the capacity per unit of gap in every zone, N/m2.
    slopes: [f64; 3],
    /// Gap at which the point has nothing left to carry shear with, m.
    reach: f64,
    /// Largest normal force, N/m, and the gap below which it is carried, m.
    cap: f64,
    floor: f64,
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
}

/// A quantity and its rate along the path.
pub type Moving = [f64; 2];

/// Change of normal and tangential force for changes of gap and slip, by a tangent stiffness, N/m.
pub(super) fn force_change([nn, nt, tn, tt]: [f64; 4], [gap, slip]: [f64; 2]) -> [f64; 2] {
    [-(nn * gap + nt * slip), -(tn * gap + tt * slip)]
}

impl Contact {
    /// A contact point with the given stiffness and law.
    pub fn new(stiffness: [f64; 2], law: Law) -> Self {
        let (friction, cohesion, cap) = match law {
            Law::Bonded => (0.0, 0.0, f64::INFINITY),
            Law::Coulomb { friction, cohesion, cap } => (friction, cohesion, cap),
        };
        let crushed = if cap.is_finite() { friction * cap + cohesion } else { cohesion };
        Contact {
            stiffness,
            law,
            capacities: [cohesion, cohesion, crushed],
            slopes: [friction * stiffness[0], stiffness[0] / ADHESION_REACH, 0.0],
            reach: ADHESION_REACH * cohesion / stiffness[0],
            cap,
            floor: -cap / stiffness[0],
        }
    }

    /// Fall of the shear capacity per unit of gap in a zone, N/m2.
    pub fn slope(&self, zone: Zone) -> f64 {
        self.slopes[zone as usize]
    }

    /// Shear capacity in a zone, N/m.
    pub fn capacity(&self, zone: Zone, gap: f64) -> f64 {
        self.capacities[zone as usize] - self.slope(zone) * gap
    }

    /// Largest normal force, N/m; infinite where nothing crushes.
    pub fn cap(&self) -> f64 {
        self.cap
    }

    /// True where the point can carry no shear at all.
    pub fn frictionless(&self) -> bool {
        matches!(self.law, Law::Coulomb { friction: 0.0, cohesion: 0.0, .. })
    }

    /// Tangential force as if it had stuck from the start, N/m.
    fn trial_shear(&self, slip: f64) -> f64 {
        -self.stiffness[1] * slip
    }

    /// Normal and tangential force in a state, as the linear functions they are within it, N/m.
    pub fn force_in(&self, state: State, gap: f64, slip: f64) -> [f64; 2] {
        let pressure = -self.stiffness[0] * gap;
        let normal = |zone| match zone {
            Zone::Pressed => pressure,
            Zone::Adhering => 0.0,
            Zone::Capped => self.cap,
        };
        match state {
            State::Open => [0.0, 0.0],
            State::Bonded => [pressure, self.trial_shear(slip)],
            State::Stick(zone) => [normal(zone), self.trial_shear(slip)],
            State::Slip { sign, zone } => [normal(zone), sign * self.capacity(zone, gap)],
        }
    }

    /// Change of normal and tangential force in a state per change of gap and slip, N/m.
    pub fn force_rate(&self, state: State, rates: [f64; 2]) -> [f64; 2] {
        force_change(self.tangent_stiffness(state), rates)
    }

    /// Tangent stiffness in a state, N/m2: change of (-N, -T) per change of (gap, slip), row by row.
    pub fn tangent_stiffness(&self, state: State) -> [f64; 4] {
        let [k_n, k_t] = self.stiffness;
        let pressed = |zone| if zone == Zone::Pressed { k_n } else { 0.0 };
        match state {
            State::Open => [0.0; 4],
            State::Bonded => [k_n, 0.0, 0.0, k_t],
            State::Stick(zone) => [pressed(zone), 0.0, 0.0, k_t],
            State::Slip { sign, zone } => [pressed(zone), 0.0, sign * self.slope(zone), 0.0],
        }
    }

    /// Zone of a gap below the reach.
    fn zone_at(&self, gap: f64) -> Zone {
        match gap {
            _ if gap > 0.0 => Zone::Adhering,
            _ if gap < self.floor => Zone::Capped,
            _ => Zone::Pressed,
        }
    }

    /// Force by the law itself, whatever the state: 0 <= N = -k_n gap <= cap, T = trial T within the capacity.
    pub fn force(&self, gap: f64, slip: f64) -> ContactForce {
        let trial = self.trial_shear(slip);
        let [normal, tangential] = match self.law {
            Law::Bonded => self.force_in(State::Bonded, gap, slip),
            _ if gap >= self.reach.max(0.0) => [0.0, 0.0],
            _ => {
                // At the reach rounding may leave less than nothing.
                let capacity = self.capacity(self.zone_at(gap), gap).max(0.0);
                [(-self.stiffness[0] * gap).max(0.0).min(self.cap), trial.clamp(-capacity, capacity)]
            }
        };
        ContactForce { normal, tangential, gap }
    }

    /// The most shear at a gap, N/m.
    pub(super) fn bears(&self, gap: f64) -> f64 {
        if self.law == Law::Bonded {
            return f64::INFINITY;
        }
        if gap > self.reach { 0.0 } else { self.capacity(self.zone_at(gap), gap).max(0.0) }
    }

    /// State of a point at a gap and a slip, by the law itself.
    pub fn state_at(&self, [gap, slip]: [f64; 2]) -> State {
        if self.law == Law::Bonded {
            return State::Bonded;
        }
        if gap > self.reach {
            return State::Open;
        }
        let zone = self.zone_at(gap);
        let (trial, capacity) = (self.trial_shear(slip), self.capacity(zone, gap));
        let sign = if trial < 0.0 { -1.0 } else { 1.0 };
        if trial.abs() < capacity { State::Stick(zone) } else { State::Slip { sign, zone } }
    }

    /// State in which a pressed point starts.
    pub fn pressed_state(&self) -> State {
        match self.law {
            Law::Bonded => State::Bonded,
            _ if self.frictionless() => State::Slip { sign: 1.0, zone: Zone::Pressed },
            _ => State::Stick(Zone::Pressed),
        }
    }

    /// True where a gap and a slip are inside a state for sure, at none of its borders; cheap where that is what most points are.
    pub(super) fn is_inside(&self, state: State, gap: f64, slip: f64) -> bool {
        let pressed = gap < 0.0 && gap > self.floor;
        match state {
            State::Bonded => true,
            State::Open => gap > self.reach,
            State::Stick(Zone::Pressed) => pressed && self.trial_shear(slip).abs() < self.capacity(Zone::Pressed, gap),
            State::Slip { sign, zone: Zone::Pressed } => {
                pressed && sign * self.trial_shear(slip) > self.capacity(Zone::Pressed, gap)
            }
            _ => false,
        }
    }

    /// Calls `see(value, next state)` for every way out of `state`, each a function that is positive inside the state and
    /// vanishes at its border.
    pub fn ways_out(&self, state: State, gap: Moving, slip: Moving, mut see: impl FnMut(Moving, State)) {
        let trial = slip.map(|s| self.trial_shear(s));
        let capacity = |zone| [self.capacity(zone, gap[0]), -self.slope(zone) * gap[1]];
        let negative = |x: Moving| [-x[0], -x[1]];
        let excess = |sign: f64, zone: Zone| [0, 1].map(|i| sign * trial[i] - capacity(zone)[i]);
        let (adhesive, crushes) = (self.capacities[0] > 0.0, self.cap < f64::INFINITY);
        let above_floor = [gap[0] - self.floor, gap[1]];
        match state {
            State::Bonded => {}
            State::Open => {
                let above = [gap[0] - self.reach, gap[1]];
                // The way it slides is decided by the trial shear at the instant of closing; the capacity is zero there.
                let until = if above[1] < 0.0 { (above[0] / -above[1]).max(0.0) } else { 0.0 };
                let sign = if trial[0] + until * trial[1] < 0.0 { -1.0 } else { 1.0 };
                see(above, State::Slip { sign, zone: if adhesive { Zone::Adhering } else { Zone::Pressed } });
            }
            State::Stick(zone) | State::Slip { zone, .. } => {
                let beside = |zone| {
                    if let State::Slip { sign, .. } = state { State::Slip { sign, zone } } else { State::Stick(zone) }
                };
                match zone {
                    Zone::Pressed if adhesive => see(negative(gap), beside(Zone::Adhering)),
                    Zone::Pressed => see(negative(gap), State::Open),
                    Zone::Adhering => see(gap, beside(Zone::Pressed)),
                    Zone::Capped => see(negative(above_floor), beside(Zone::Pressed)),
                }
                if crushes && zone == Zone::Pressed {
                    see(above_floor, beside(Zone::Capped));
                }
                match state {
                    State::Slip { sign, zone } => {
                        if zone == Zone::Adhering {
                            see([self.reach - gap[0], -gap[1]], State::Open);
                        }
                        if !self.frictionless() {
                            see(excess(sign, zone), State::Stick(zone));
                        }
                    }
                    _ => {
                        for sign in [1.0, -1.0] {
                            see(negative(excess(sign, zone)), State::Slip { sign, zone });
                        }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
