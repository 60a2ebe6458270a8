//! What holds at one contact, linearised: force against distance, friction against slip.

use nalgebra::Vector3;

/// Bounds on friction below this are none.
const SMOOTH: f64 = 1e-9;

/// A contact between two bodies; none is what does not move.
#[derive(Debug, Clone, Copy)]
pub(super) struct Constraint {
    /// The bodies.
    pub bodies: [Option<usize>; 2],
    /// What their increments add to the distance along the normal and to the slip along the tangent.
    pub rows: [[Vector3<f64>; 2]; 2],
    /// Distance.
    pub gap: f64,
    /// Friction coefficient.
    pub slope: f64,
    /// Rest of the bound on friction.
    pub constant: f64,
    /// A guess of the normal force.
    pub guess: f64,
}

/// Forces, distances and their changes at one contact: `slip` holds the slip against the negative and the positive tangent
/// direction, each nought unless friction is at its bound there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    pub normal: f64,
    pub distance: f64,
    pub tangential: f64,
    pub slip: [f64; 2],
    /// Distance of the tangential force from its bounds: kept, since a difference of large forces would lose its digits.
    pub room: [f64; 2],
}

/// The linearised contact: changes of (N, T) are `base` less `stiffness` times changes of distance and slip.
pub(super) struct Linear {
    pub base: [f64; 2],
    pub stiffness: [[f64; 2]; 2],
}

/// What the products of force and distance are to become, at the normal and at either bound on friction.
pub(super) type Targets = [f64; 3];

impl Constraint {
    pub(super) fn rubs(&self) -> bool {
        self.slope > SMOOTH || self.constant > SMOOTH
    }

    /// What `increments` add along row `r` (0 normal, 1 tangent).
    pub(super) fn along(&self, r: usize, increments: &[Vector3<f64>]) -> f64 {
        (0..2).filter_map(|side| self.bodies[side].map(|body| self.rows[side][r].dot(&increments[body]))).sum()
    }

    /// Residuals of distance and slip.
    pub(super) fn residuals(&self, pair: &Pair, increments: &[Vector3<f64>]) -> [f64; 2] {
        let normal = self.gap + self.along(0, increments) - pair.distance;
        if !self.rubs() {
            return [normal, 0.0];
        }
        [normal, self.along(1, increments) + pair.slip[0] - pair.slip[1]]
    }

    /// Eliminates everything but the increments.
    pub(super) fn linear(&self, pair: &Pair, residuals: [f64; 2], targets: &Targets) -> Linear {
        let kn = pair.normal / pair.distance;
        let base_n = targets[0] / pair.distance - kn * residuals[0];
        if !self.rubs() {
            return Linear { base: [base_n, 0.0], stiffness: [[kn, 0.0], [0.0, 0.0]] };
        }
        let room = pair.room;
        let yields = [pair.slip[0] / room[0], pair.slip[1] / room[1]];
        let kt = 1.0 / (yields[0] + yields[1]);
        let coupling = self.slope * (yields[0] - yields[1]);
        let base_t = kt * (-residuals[1] - targets[1] / room[0] + targets[2] / room[1] + coupling * base_n);
        Linear { base: [base_n, base_t], stiffness: [[kn, 0.0], [kt * coupling * kn, kt]] }
    }

    /// Changes of everything at the contact for changes of the increments.
    pub(super) fn change(&self, pair: &Pair, residuals: [f64; 2], targets: &Targets, step: &[Vector3<f64>]) -> Pair {
        let linear = self.linear(pair, residuals, targets);
        let moved = [self.along(0, step), self.along(1, step)];
        let [normal, tangential] =
            [0, 1].map(|r| linear.base[r] - linear.stiffness[r][0] * moved[0] - linear.stiffness[r][1] * moved[1]);
        let mut change = Pair { normal, distance: residuals[0] + moved[0], tangential, ..Pair::NOTHING };
        if !self.rubs() {
            change.tangential = 0.0;
            return change;
        }
        let bound = self.slope * normal;
        let room = [bound - tangential, bound + tangential];
        // The side that friction is further from follows its force, the other one the slip: neither cancels.
        let near = if pair.slip[0] * pair.room[1] >= pair.slip[1] * pair.room[0] { 0 } else { 1 };
        let (far, slid) = (1 - near, residuals[1] + moved[1]);
        change.room[far] = room[far];
        change.slip[far] = (targets[far + 1] - pair.slip[far] * room[far]) / pair.room[far];
        change.slip[near] = change.slip[far] + if near == 0 { -slid } else { slid };
        change.room[near] = if pair.slip[near] > pair.room[near] {
            (targets[near + 1] - pair.room[near] * change.slip[near]) / pair.slip[near]
        } else {
            room[near]
        };
        change
    }

    /// All pairs of (value, change) that must stay positive.
    pub(super) fn positives(&self, pair: &Pair, change: &Pair) -> [(f64, f64); 6] {
        if !self.rubs() {
            let idle = (1.0, 0.0);
            return [(pair.normal, change.normal), (pair.distance, change.distance), idle, idle, idle, idle];
        }
        let (room, by) = (pair.room, change.room);
        [
            (pair.normal, change.normal),
            (pair.distance, change.distance),
            (room[0], by[0]),
            (pair.slip[0], change.slip[0]),
            (room[1], by[1]),
            (pair.slip[1], change.slip[1]),
        ]
    }

    pub(super) fn start(&self, [force, distance]: [f64; 2]) -> Pair {
        let normal = self.guess.max(force);
        let bound = self.slope * normal + self.constant;
        Pair { normal, distance: self.gap.max(distance), tangential: 0.0, slip: [distance; 2], room: [bound; 2] }
    }
}

impl Constraint {
    /// Adds what contact forces do to the bodies.
    pub(super) fn spread(&self, to: &mut [Vector3<f64>], forces: [f64; 2]) {
        for (side, body) in self.bodies.iter().enumerate() {
            if let Some(body) = body {
                to[*body] += self.rows[side][0] * forces[0] + self.rows[side][1] * forces[1];
            }
        }
    }
}

impl Pair {
    pub(super) const NOTHING: Pair =
        Pair { normal: 0.0, distance: 0.0, tangential: 0.0, slip: [0.0; 2], room: [0.0; 2] };

    pub(super) fn add(&mut self, change: &Pair, share: f64) {
        self.normal += share * change.normal;
        self.distance += share * change.distance;
        self.tangential += share * change.tangential;
        self.slip = [0, 1].map(|i| self.slip[i] + share * change.slip[i]);
        self.room = [0, 1].map(|i| self.room[i] + share * change.room[i]);
    }
}
