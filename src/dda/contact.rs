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
    /// Normal and tangential penalty stiffness, N/m2 (per metre of depth).
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
                let capacity = self.capacity(self.zone_at(gap), gap);
                [(-self.stiffness[0] * gap).max(0.0).min(self.cap), trial.clamp(-capacity, capacity)]
            }
        };
        ContactForce { normal, tangential, gap }
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
mod tests {
    use super::*;

    /// Every combination of cohesion and cap; N reaches the cap at a gap of -2 mm.
    fn contacts() -> impl Iterator<Item = Contact> {
        let laws = [0.0, 3.0].into_iter().flat_map(|cohesion| [f64::INFINITY, 20.0].map(|cap| (cohesion, cap)));
        laws.map(|(cohesion, cap)| Contact::new([1e4, 2e4], Law::Coulomb { friction: 0.5, cohesion, cap }))
    }

    fn contact(cohesion: f64) -> Contact {
        Contact::new([1e4, 2e4], Law::Coulomb { friction: 0.5, cohesion, cap: 20.0 })
    }

    #[test]
    fn the_tangent_stiffness_is_the_derivative_of_the_force() {
        let c = contact(3.0);
        for zone in [Zone::Pressed, Zone::Adhering, Zone::Capped] {
            for state in [State::Stick(zone), State::Slip { sign: -1.0, zone }, State::Bonded, State::Open] {
                let at = |gap: f64, slip: f64| c.force_in(state, gap, slip);
                let (here, [a, b, d, e]) = (at(1e-4, 2e-4), c.tangent_stiffness(state));
                let (opened, slid) = (at(1.1e-4, 2e-4), at(1e-4, 2.1e-4));
                let rates = [opened[0] - here[0], slid[0] - here[0], opened[1] - here[1], slid[1] - here[1]];
                for (rate, stiffness) in rates.iter().zip([a, b, d, e]) {
                    assert!((rate / 1e-5 + stiffness).abs() < 1e-6, "{state:?}");
                }
            }
        }
    }

    #[test]
    fn the_tangent_stiffness_of_the_state_at_a_gap_is_the_derivative_of_the_law() {
        for c in contacts() {
            for (gap, slip) in
                [-3e-3, -2.1e-3, -1e-3, -1e-4, 1e-4, 5e-3].into_iter().flat_map(|g| [-1e-4, 3e-3].map(|s| (g, s)))
            {
                let ([a, b, d, e], h) = (c.tangent_stiffness(c.state_at([gap, slip])), 1e-7);
                let at = |g: f64, s: f64| c.force(gap + g, slip + s);
                let (opens, slides) = ([at(-h, 0.0), at(h, 0.0)], [at(0.0, -h), at(0.0, h)]);
                let rate =
                    |of: fn(&ContactForce) -> f64, ends: &[ContactForce; 2]| (of(&ends[1]) - of(&ends[0])) / (2.0 * h);
                let (n, t) = (|f: &ContactForce| f.normal, |f: &ContactForce| f.tangential);
                for (rate, stiffness) in
                    [rate(n, &opens), rate(n, &slides), rate(t, &opens), rate(t, &slides)].iter().zip([a, b, d, e])
                {
                    assert!((rate + stiffness).abs() < 1e-3, "{c:?} {gap} {slip}");
                }
            }
        }
    }

    #[test]
    fn the_law_is_continuous_and_within_coulomb_and_the_cap() {
        for c in contacts() {
            let Law::Coulomb { cohesion, cap, .. } = c.law else { panic!() };
            let reach = 10.0 * cohesion / 1e4;
            let at = |gap: f64, slip: f64| c.force(gap, slip);
            for i in -200..200 {
                let (gap, slip) = (f64::from(i) * reach.max(2e-3) / 100.0, -1.0);
                let (here, next) = (at(gap, slip), at(gap + 1e-12, slip));
                assert!((here.tangential - next.tangential).abs() < 1e-7 && (here.normal - next.normal).abs() < 1e-7);
                assert!(here.tangential.abs() <= 0.5 * here.normal + cohesion + 1e-12 && here.normal <= cap);
            }
            assert_eq!((at(-1e-3, 0.0).normal, at(reach + 1e-9, -1.0).tangential), (10.0, 0.0));
            assert_eq!(
                (at(-5e-3, 0.0).normal, at(-5e-3, -1.0).tangential),
                (cap.min(50.0), 0.5 * cap.min(50.0) + cohesion)
            );
        }
    }

    #[test]
    fn the_state_at_a_gap_and_a_slip_carries_the_force_of_the_law() {
        for c in contacts() {
            for gap in [-3e-3, -2e-3, -1e-4, 1e-4, 2e-3, 4e-3] {
                for slip in [-1e-2, -1e-4, 0.0, 1e-5, 1e-2] {
                    let (by_law, state) = (c.force(gap, slip), c.state_at([gap, slip]));
                    let [normal, shear] = c.force_in(state, gap, slip);
                    assert!((normal - by_law.normal).abs() + (shear - by_law.tangential).abs() < 1e-12, "{state:?}");
                }
            }
        }
    }

    #[test]
    fn both_states_carry_the_same_force_on_the_border_between_them() {
        let (c, slip) = (contact(3.0), [-1.3e-4, -2.0]);
        let slides = |zone| State::Slip { sign: 1.0, zone };
        for (state, gap, ways) in [
            (State::Stick(Zone::Pressed), [-1e-4, 1.0], 4),
            (State::Stick(Zone::Pressed), [-1e-4, -1.0], 4),
            (slides(Zone::Pressed), [-1e-4, 1.0], 3),
            (slides(Zone::Pressed), [-1e-4, -1.0], 3),
            (slides(Zone::Adhering), [1e-3, 0.3], 3),
            (State::Stick(Zone::Adhering), [1e-3, 0.3], 3),
            (State::Stick(Zone::Capped), [-3e-3, 0.3], 3),
            (slides(Zone::Capped), [-3e-3, 0.3], 2),
            (State::Open, [4e-3, -1.0], 1),
        ] {
            let mut seen = 0;
            c.ways_out(state, gap, slip, |value, next| {
                seen += 1;
                if value[1] == 0.0 {
                    return;
                }
                let step = -value[0] / value[1];
                let (gap, slip) = (gap[0] + step * gap[1], slip[0] + step * slip[1]);
                let (here, there) = (c.force_in(state, gap, slip), c.force_in(next, gap, slip));
                assert!((here[0] - there[0]).abs() + (here[1] - there[1]).abs() < 1e-9, "{state:?} -> {next:?}");
            });
            assert_eq!(seen, ways, "{state:?}");
        }
    }

    #[test]
    fn a_point_sticks_inside_its_capacity_only() {
        let c = contact(0.0);
        let mut out = Vec::new();
        c.ways_out(State::Stick(Zone::Pressed), [-1e-3, 0.0], [0.0, -1.0], |value, next| out.push((value, next)));
        // N = 10, capacity 5, T rising by 2e4 per unit: slips after 2.5e-4.
        let slip = out.iter().find(|(_, next)| *next == State::Slip { sign: 1.0, zone: Zone::Pressed }).unwrap();
        assert!((slip.0[0] / -slip.0[1] - 2.5e-4).abs() < 1e-15);
    }
}
