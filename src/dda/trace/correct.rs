//! One step on moving geometry: along the tangent, then back to equilibrium with one quantity held.

use super::Tracer;
use super::event::{Event, is_gap};
use crate::dda::contact::State;
use crate::dda::moving::Velocity;

/// Equilibrium residual, as a share of the load scale, to which a point is corrected, and above which a step is too long.
pub(super) const EQUILIBRIUM: f64 = 1e-12;
pub(super) const FAILED: f64 = 1e-9;
/// Corrections to try before a step is taken as too long.
const CORRECTIONS: usize = 12;
/// A force beyond its limit by this share of the load scale means that a change of state was missed: ties are told
/// apart by disturbances of 1e-9.
const MISSED: f64 = 1e-11;
/// So many changes of state may lie so close together that the tangent mistakes their order.
const CLOSE: usize = 4;

/// What is held while a step is corrected to equilibrium.
#[derive(Debug, Clone, Copy)]
pub(super) enum Hold {
    /// The parameter.
    Parameter,
    /// The displacement that grows fastest.
    Fastest(usize),
    /// The border that a contact is on.
    Border(Event, State),
}

impl Tracer<'_> {
    /// Makes a step and corrects it, holding what is to be held; none where it is too long. Two changes of state may lie
    /// so close together that the tangent mistakes their order: what was held in the end is the first of them.
    pub(super) fn step(&mut self, step: f64, hold: Hold, target: f64) -> Option<Hold> {
        let (displacements, parameter, violated) = (self.displacements.clone(), self.parameter, self.violated());
        let (direction, rate) = (self.direction.clone(), self.rate);
        let mut hold = hold;
        for _ in 0..CLOSE {
            self.advance(step);
            if let Hold::Parameter = hold {
                self.parameter = target;
            }
            if !self.correct(hold) {
                return None;
            }
            let Some(event) = self.missed(&violated, hold) else { return Some(hold) };
            hold = Hold::Border(event, self.states[event.contact]);
            self.displacements.clone_from(&displacements);
            self.direction.clone_from(&direction);
            (self.parameter, self.rate) = (parameter, rate);
            self.find_residual();
            self.find_rates();
        }
        None
    }

    /// Brings the chain back to equilibrium while something is held; false where that does not converge.
    pub(super) fn correct(&mut self, hold: Hold) -> bool {
        let mut correction = vec![0.0; self.displacements.len()];
        let mut last = f64::INFINITY;
        for _ in 0..CORRECTIONS {
            let worst = self.find_residual();
            let off = self.off_border(hold);
            let error = worst + off[1];
            let slow = error > 0.1 * last;
            if error < EQUILIBRIUM || (slow && error < FAILED + self.rounding()) {
                self.worst_residual = self.worst_residual.max(worst);
                return true;
            }
            if slow {
                self.renew_tangent();
            }
            last = error;
            if self.factor.solve(&self.matrix, &self.residual, &mut correction, self.heart).is_err() {
                return false;
            }
            let along = match hold {
                Hold::Parameter => 0.0,
                Hold::Fastest(c) => -correction[c] / self.direction[c],
                Hold::Border(event, state) => {
                    let [_, of_correction] = self.border(event, state, Some(&correction));
                    let [_, of_direction] = self.border(event, state, None);
                    -(off[0] + of_correction) / of_direction
                }
            };
            for ((d, c), t) in self.displacements.iter_mut().zip(&correction).zip(&self.direction) {
                *d += c + along * t;
            }
            self.parameter += along * self.rate;
        }
        false
    }

    /// How far off the border that is held, where one is, and what that is as a share of the load scale.
    fn off_border(&self, hold: Hold) -> [f64; 2] {
        let Hold::Border(event, state) = hold else { return [0.0; 2] };
        let [off, _] = self.border(event, state, None);
        [off, self.as_force(event.contact, state, event.next, off).abs() / self.load_scale]
    }

    /// What rounding of the displacements may leave of the residual, as a share of the load scale.
    pub(super) fn rounding(&self) -> f64 {
        // A correction that runs away is no rounding.
        let moved = self.displacements.iter().fold(0.0, |most: f64, d| most.max(d.abs())).min(self.size);
        8.0 * f64::EPSILON * self.stiffest * moved / self.load_scale
    }

    /// How far a contact is from a border, and how fast it goes there along the direction, or along other velocities of
    /// the nodes with the parameter held.
    fn border(&self, event: Event, state: State, along: Option<&[f64]>) -> [f64; 2] {
        let (p, gap) = (event.contact, self.gaps[event.contact]);
        let rate = match (along, &self.moving) {
            (Some(direction), Some(moving)) => {
                let along = Velocity { nodes: direction, parameter: self.parameter, rate: 0.0 };
                moving.gap_rate(self.chain, &self.drive, p, along, gap)
            }
            _ => self.rates[p],
        };
        let mut found = [0.0; 2];
        self.chain.contacts()[p].ways_out(state, [gap[0], rate[0]], [gap[1], rate[1]], |value, next| {
            if next == event.next || state == State::Open {
                found = value;
            }
        });
        found
    }

    /// What a border function is worth as a force, N/m.
    fn as_force(&self, p: usize, from: State, to: State, value: f64) -> f64 {
        if is_gap(from, to) { value * self.chain.contacts()[p].stiffness[0] } else { value }
    }

    /// How far contact `p` is beyond a border of its state, as a share of the load scale, and beyond which.
    pub(super) fn beyond(&self, p: usize) -> Option<(f64, State)> {
        let (state, mut worst) = (self.states[p], None);
        self.ways_out(p, state, |[value, _], next| {
            let beyond = -self.as_force(p, state, next, value) / self.load_scale;
            if beyond > MISSED && worst.is_none_or(|(most, _)| beyond > most) {
                worst = Some((beyond, next));
            }
        });
        worst
    }

    /// Which contacts are beyond a border of their state.
    fn violated(&self) -> Vec<bool> {
        (0..self.states.len()).map(|p| self.beyond(p).is_some()).collect()
    }

    /// The border that a step went beyond farthest, which it was not meant to reach.
    fn missed(&self, before: &[bool], hold: Hold) -> Option<Event> {
        let meant = |p: usize| matches!(hold, Hold::Border(event, _) if event.contact == p);
        let new = (0..self.states.len()).filter(|&p| !before[p] && !meant(p));
        let missed = new.filter_map(|p| self.beyond(p).map(|(beyond, next)| (beyond, p, next)));
        let worst = missed.max_by(|a, b| a.0.total_cmp(&b.0));
        worst.map(|(_, contact, next)| Event { step: 0.0, contact, next })
    }
}
