//! The path on moving geometry.
//!
//! Between changes of state the path is a smooth curve now. A step goes along its tangent, to the next change of state or
//! as far as the curve is nearly straight, and is then corrected to equilibrium while one quantity is held: the border
//! of the change of state; the displacement that grows fastest, so that the load may rise or fall and limit points
//! are passed; or the parameter, at the end.

use super::{End, Event, Tracer};
use crate::dda::contact::State;
use crate::dda::moving::{Placed, Turn, Velocity};
use crate::dda::trace::Drive;
use std::ops::ControlFlow;

/// Longest step between two linearisations, as a share of the chain's size: joints of slender stones then turn by a
/// degree at most.
const LONGEST: f64 = 2e-3;
/// An event so close to the place of the last linearisation, as a share of the size, does without a new one.
const NEAR: f64 = 2e-5;
/// Equilibrium residual, as a share of the load scale, to which a point is corrected, and above which a step is too long.
const EQUILIBRIUM: f64 = 1e-12;
const FAILED: f64 = 1e-9;
/// Corrections to try before a step is taken as too long.
const CORRECTIONS: usize = 12;
/// A force beyond its limit by this share of the load scale means that a change of state was missed: ties are told
/// apart by disturbances of 1e-9.
const MISSED: f64 = 1e-11;
/// So many changes of state may lie so close together that the tangent mistakes their order.
const CLOSE: usize = 4;
/// So many halvings of a step in a row mean that the path is lost.
const HALVINGS: usize = 40;
/// A path has at most so many steps that end at no change of state; real ones have some hundreds.
const MOST_STEPS: usize = 1000;
/// A path that is lost after it has fallen by this share of what it rose, or moved by this share of its size, has fallen.
const SURE: Patience = Patience { fall: 0.1, movement: 0.01 };
/// Rises that change the loads on a node by less than this share of the load scale count as if they did by so much.
const LEAST_RISE: f64 = 1e-3;
/// A snap is worth telling where the parameter falls by this share of what it rose.
const SNAP: f64 = 0.01;
/// Displacements beyond this share of the size are no arch of this shape any more.
const FAR: f64 = 0.3;
/// Strain beyond which stone is no longer elastic by any measure.
const STRAINED: f64 = 0.02;

/// How long a path may lie below its peak until that counts as its end. A shorter dip is a snap: stones that find another
/// seat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patience {
    /// Fall of the parameter, as a share of what it rose.
    pub fall: f64,
    /// Movement of the chain, as a share of its size.
    pub movement: f64,
}

/// What is held while a step is corrected to equilibrium.
#[derive(Debug, Clone, Copy)]
enum Hold {
    /// The parameter.
    Parameter,
    /// The displacement that grows fastest.
    Fastest(usize),
    /// The border that a contact is on.
    Border(Event, State),
}

impl Tracer<'_> {
    /// Takes a path that stands at first order over to the moving geometry, with `drive` at `parameter`: the forces that
    /// are out of balance there are let go step by step.
    pub fn move_on(&mut self, drive: Drive, parameter: f64, see: &mut dyn FnMut(&Tracer) -> ControlFlow<()>) -> End {
        (self.drive, self.parameter, self.moving) = (drive.clone(), parameter, Some(Placed::new(self.chain)));
        if self.find_residual() < EQUILIBRIUM {
            return End::Reached;
        }
        let held = self.residual.clone();
        let held_turned: Vec<f64> = held
            .chunks_exact(2)
            .flat_map(|pair| Turn::by(-std::f64::consts::FRAC_PI_2).pair([pair[0], pair[1]]))
            .collect();
        let at = |base: &[f64], rate: &[f64], held: &[f64]| -> Vec<f64> {
            (0..held.len()).map(|i| base[i] + parameter * rate[i] - held[i]).collect()
        };
        let ground = drive.ground;
        self.drive = Drive {
            base: at(&drive.base, &drive.rate, &held),
            turned: [at(&drive.turned[0], &drive.turned[1], &held_turned), held_turned],
            rate: held,
            ..Drive::default()
        };
        debug_assert!(parameter == 0.0 || ground.iter().all(|g| g.is_still()), "the ground starts at rest");
        self.parameter = 0.0;
        let end = self.trace_moving(1.0, Patience { fall: f64::INFINITY, ..SURE }, see);
        (self.drive, self.parameter, self.peak) = (drive, parameter, None);
        end
    }

    /// Traces on moving geometry until the parameter reaches `target` or the path ends: [`End::Mechanism`] where the
    /// parameter has passed its peak for good, [`End::Rising`] where the chain has moved too far for its displacements to
    /// mean anything.
    pub fn trace_moving(
        &mut self,
        target: f64,
        patience: Patience,
        see: &mut dyn FnMut(&Tracer) -> ControlFlow<()>,
    ) -> End {
        (self.dip, self.peak, self.fallen) = (None, None, false);
        match self.walk(target, patience, see) {
            End::Lost if self.fallen => End::Mechanism,
            end => end,
        }
    }

    fn walk(&mut self, target: f64, patience: Patience, see: &mut dyn FnMut(&Tracer) -> ControlFlow<()>) -> End {
        let start = self.parameter;
        let mut longest = LONGEST * self.size;
        let (mut halvings, mut zero_steps, mut steps, mut barred, mut refined) = (0, 0, 0, None, false);
        let most_zero_steps = super::MOST_ZERO_STEPS[0] + super::MOST_ZERO_STEPS[1] * self.states.len();
        let most_events = self.events + super::MOST_EVENTS[0] + super::MOST_EVENTS[1] * self.states.len();
        if self.find_residual() > FAILED || target <= start {
            return End::Lost;
        }
        self.linearise();
        self.solve_tangent();
        if self.rate < 0.0 {
            self.turn_round();
        }
        loop {
            if see(self).is_break() {
                return End::Stopped;
            }
            if let Some(end) = self.is_over(start, patience) {
                return end;
            }
            let event = self.nearest_event(barred);
            let to_target = if self.rate > 0.0 { (target - self.parameter) / self.rate } else { f64::INFINITY };
            let to_event = event.map_or(f64::INFINITY, |event| event.step);
            // Where nothing moves the path is straight.
            let straight = self.direction.iter().all(|&d| d == 0.0);
            let step = if straight { f64::INFINITY } else { longest }.min(to_event).min(to_target);
            let hold = match event {
                _ if step == to_target => Hold::Parameter,
                Some(event) if step == to_event => Hold::Border(event, self.states[event.contact]),
                _ => Hold::Fastest(fastest(&self.direction)),
            };
            let before = (self.displacements.clone(), self.parameter, self.rate);
            let Some(hold) = self.step(step, hold, target) else {
                (self.displacements, self.parameter) = (before.0, before.1);
                halvings += 1;
                if halvings > HALVINGS
                    || self.events > most_events
                    || !(self.find_residual() < FAILED + self.rounding())
                {
                    return End::Lost;
                }
                longest = 0.5 * step;
                self.renew_tangent();
                continue;
            };
            halvings = 0;
            match hold {
                Hold::Parameter => return End::Reached,
                Hold::Border(event, state) => {
                    zero_steps = if step > 0.0 { 0 } else { zero_steps + 1 };
                    if zero_steps > most_zero_steps || self.events > most_events {
                        return End::Lost;
                    }
                    barred = Some((event.contact, state));
                    if self.moved_since_linearisation() > NEAR * self.size {
                        self.linearise();
                    }
                    self.cross(event);
                    refined = false;
                    self.note_peak(self.rate <= 0.0);
                }
                Hold::Fastest(_) => {
                    steps += 1;
                    if steps > MOST_STEPS {
                        return End::Lost;
                    }
                    barred = None;
                    self.renew_tangent();
                    if before.2 > 0.0 && self.rate < 0.0 && !refined {
                        // A limit point lies in between: the rate falls about linearly through zero.
                        let share = before.2 / (before.2 - self.rate);
                        (self.displacements, self.parameter) = (before.0, before.1);
                        self.find_residual();
                        self.renew_tangent();
                        self.advance(share * step);
                        if !self.correct(Hold::Fastest(fastest(&self.direction))) {
                            return End::Lost;
                        }
                        self.renew_tangent();
                        self.note_peak(true);
                        refined = true;
                    } else {
                        refined = false;
                    }
                    longest = (2.0 * longest).min(LONGEST * self.size);
                }
            }
        }
    }

    /// Makes a step and corrects it, holding what is to be held; none where it is too long. Two changes of state may lie
    /// so close together that the tangent mistakes their order: what was held in the end is the first of them.
    fn step(&mut self, step: f64, hold: Hold, target: f64) -> Option<Hold> {
        let (displacements, parameter, violated) = (self.displacements.clone(), self.parameter, self.violated());
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
            self.parameter = parameter;
            self.find_residual();
        }
        None
    }

    fn is_over(&mut self, start: f64, patience: Patience) -> Option<End> {
        if let Some(peak) = &self.peak {
            let moved = farthest(&self.displacements, &peak.displacements);
            let least = LEAST_RISE * self.load_scale / self.load_rate_scale;
            let fall = (peak.parameter - self.parameter) / (peak.parameter - start).max(least);
            let beyond = |p: Patience| fall > p.fall || (fall > 0.0 && moved > p.movement * self.size);
            if beyond(patience) {
                return Some(End::Mechanism);
            }
            self.fallen = beyond(SURE);
            if fall > SNAP {
                self.dip = self.dip.or(Some(peak.parameter));
            }
        }
        let far = self.displacements.iter().fold(0.0, |far: f64, d| far.max(d.abs())) > FAR * self.size;
        let strained = self.moving.as_ref().is_some_and(|moving| moving.largest_strain() > STRAINED);
        (far || strained).then_some(if self.peak.is_some() { End::Mechanism } else { End::Rising })
    }

    /// Linearises where the chain is and goes on the way it went.
    fn renew_tangent(&mut self) {
        let before = self.direction.clone();
        self.linearise();
        self.solve_tangent();
        if self.direction.iter().zip(&before).map(|(a, b)| a * b).sum::<f64>() < 0.0 {
            self.turn_round();
        }
    }

    /// Renews the stiffness of bodies and interfaces where they are now.
    fn linearise(&mut self) {
        if let Some(moving) = &mut self.moving {
            moving.linearise(self.chain, &self.drive);
            for i in 0..self.chain.bodies() {
                self.matrix.upper.get_mut(2 * i).copy_from_slice(moving.bodies.upper.get(2 * i));
                self.matrix.lower.get_mut(2 * i).copy_from_slice(moving.bodies.lower.get(2 * i));
            }
        }
        self.linearised_at.clone_from(&self.displacements);
        self.reassemble_all();
    }

    fn moved_since_linearisation(&self) -> f64 {
        farthest(&self.displacements, &self.linearised_at)
    }

    /// Brings the chain back to equilibrium while something is held; false where that does not converge.
    fn correct(&mut self, hold: Hold) -> bool {
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
            self.factor.solve(&self.matrix, &self.residual, &mut correction);
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
    fn rounding(&self) -> f64 {
        let stiffest = self.chain.contacts().iter().map(|c| c.stiffness[0]).fold(0.0, f64::max);
        let moved = self.displacements.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
        8.0 * f64::EPSILON * stiffest * moved / self.load_scale
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
        if super::is_gap(from, to) { value * self.chain.contacts()[p].stiffness[0] } else { value }
    }

    /// How far contact `p` is beyond a border of its state, as a share of the load scale, and beyond which.
    fn beyond(&self, p: usize) -> Option<(f64, State)> {
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

/// Largest difference of two displacements.
fn farthest(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// The largest entry.
fn fastest(direction: &[f64]) -> usize {
    (0..direction.len()).max_by(|&i, &j| direction[i].abs().total_cmp(&direction[j].abs())).unwrap_or(0)
}
