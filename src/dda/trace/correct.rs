//! One step on moving geometry: along the tangent, then back to equilibrium with one quantity held.

use super::Tracer;
use super::event::{Event, is_gap};
use super::lost::Violation;
use crate::dda::contact::{State, zone};
use crate::dda::moving::Velocity;

/// Equilibrium residual, as a share of the load scale, to which a point is corrected, and above which a step is too long.
pub(super) const EQUILIBRIUM: f64 = 1e-12;
pub(super) const FAILED: f64 = 1e-9;
/// Corrections to try before a step is taken as too long.
const CORRECTIONS: usize = 20;
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
        let start = self.point();
        let (direction, rate) = (self.direction.clone(), self.rate);
        let mut hold = hold;
        let still = vec![0.0; self.displacements.len()];
        self.stuck = None;
        for _ in 0..CLOSE {
            self.move_by(step, &still);
            if let Hold::Parameter = hold {
                self.set_parameter(target);
            }
            if !self.correct(hold) {
                return None;
            }
            let Some((beyond, event)) = self.missed(hold) else { return Some(hold) };
            self.stuck = Some(Violation { contact: event.contact, beyond });
            hold = Hold::Border(event, self.states[event.contact]);
            self.go_to(&start);
            self.direction.clone_from(&direction);
            self.rate = rate;
            self.find_residual();
            self.find_rates();
        }
        None
    }

    /// Brings the assembly back to equilibrium while something is held; false where that does not converge.
    pub(super) fn correct(&mut self, hold: Hold) -> bool {
        let mut correction = vec![0.0; self.displacements.len()];
        let (mut last, mut renewed) = (f64::INFINITY, false);
        for _ in 0..CORRECTIONS {
            let worst = self.find_residual();
            let off = self.off_border(hold);
            let error = worst + off[1];
            let slow = error > 0.1 * last;
            // What a tangent at this very place does not mend is rounding.
            if error < EQUILIBRIUM || (slow && renewed && error < FAILED + self.rounding()) {
                self.worst_residual = self.worst_residual.max(worst);
                return true;
            }
            if slow {
                self.renew_tangent();
            }
            (last, renewed) = (error, slow);
            if self.factor.solve(&self.residual, &mut correction, self.budget).is_err() {
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
            self.move_by(along, &correction);
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
        0.6 * f64::EPSILON * self.stiffest * moved / self.load_scale
    }

    /// How far a contact is from a border, and how fast it goes there along the direction, or along other velocities of
    /// the nodes with the parameter held.
    fn border(&self, event: Event, state: State, along: Option<&[f64]>) -> [f64; 2] {
        let (p, gap) = (event.contact, self.gaps[event.contact]);
        let rate = match (along, &self.moving) {
            (Some(direction), Some(moving)) => {
                let along = Velocity { nodes: direction, parameter: self.parameter, rate: 0.0 };
                moving.gap_rate(self.assembly, &self.drive, p, along, gap)
            }
            _ => self.rates[p],
        };
        let mut found = [0.0; 2];
        self.assembly.contacts()[p].ways_out(state, [gap[0], rate[0]], [gap[1], rate[1]], |value, next| {
            if next == event.next || state == State::Open {
                found = value;
            }
        });
        found
    }

    /// What a border function is worth as a force, N/m: a gap by the stiffness; shear by its distance from the cone of friction,
    /// where rough joints turn a little normal force into much shear.
    fn as_force(&self, p: usize, from: State, to: State, value: f64) -> f64 {
        let contact = &self.assembly.contacts()[p];
        match (is_gap(from, to), zone(from)) {
            (false, Some(zone)) => value / 1f64.hypot(contact.slope(zone) / contact.stiffness[0]),
            _ => value * contact.stiffness[0],
        }
    }

    /// How far contact `p` is beyond a border of its state, as a share of the load scale, and beyond which; none where that is
    /// less than `least`.
    fn beyond(&self, p: usize, least: f64) -> Option<(f64, State)> {
        let (state, mut worst) = (self.states[p], None);
        self.ways_out(p, state, |[value, _], next| {
            let beyond = -self.as_force(p, state, next, value) / self.load_scale;
            if beyond > least && worst.is_none_or(|(most, _)| beyond > most) {
                worst = Some((beyond, next));
            }
        });
        worst
    }

    /// The contact that is farthest beyond a border of its state: its force is not that of the law. The point is none of the
    /// path then, however the contact came there.
    pub(super) fn violated(&self) -> Option<Violation> {
        self.farthest_beyond(None).map(|(beyond, contact, _)| Violation { contact, beyond })
    }

    /// The border that a step went beyond farthest, but for the one that is held.
    fn missed(&self, hold: Hold) -> Option<(f64, Event)> {
        let held = if let Hold::Border(event, _) = hold { Some(event) } else { None };
        self.farthest_beyond(held).map(|(beyond, contact, next)| (beyond, Event { step: 0.0, contact, next }))
    }

    /// How far the contact is beyond a border that is farthest beyond one, but for the border that is `held`; with its number
    /// and that border.
    fn farthest_beyond(&self, held: Option<Event>) -> Option<(f64, usize, State)> {
        let least = MISSED + self.rounding();
        let of = |p: usize| {
            let (beyond, next) = self.beyond(p, least)?;
            let is_held = held.is_some_and(|event| event.contact == p && event.next == next);
            (!is_held).then_some((beyond, p, next))
        };
        (0..self.states.len()).filter_map(of).max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Gives every contact that is beyond a border the state that the law has for its gap and slip.
    pub(super) fn states_by_law(&mut self) {
        for p in 0..self.states.len() {
            if self.beyond(p, MISSED).is_some() {
                self.states[p] = self.assembly.contacts()[p].state_at(self.gaps[p]);
            }
        }
    }
}
