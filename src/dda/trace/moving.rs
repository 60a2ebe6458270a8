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
const EQUILIBRIUM: f64 = 1e-10;
const FAILED: f64 = 1e-8;
/// Corrections to try before a step is taken as too long.
const CORRECTIONS: usize = 8;
/// A force beyond its limit by this share of the load scale means that a change of state was missed.
const MISSED: f64 = 1e-7;
/// So many halvings of a step in a row mean that the path is lost.
const HALVINGS: usize = 40;
/// Collapse is the highest point from which the parameter falls by this share of what it rose: smaller dips are stones that
/// find their seat.
const FALLEN: f64 = 0.01;
/// Displacements beyond this share of the size are no arch of this shape any more.
const FAR: f64 = 0.3;
/// Strain beyond which stone is no longer elastic by any measure.
const STRAINED: f64 = 0.02;

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
        let held_turned: Vec<f64> = held.chunks_exact(2).flat_map(|pair| Turn::by(-std::f64::consts::FRAC_PI_2).pair([pair[0], pair[1]])).collect();
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
        let end = self.trace_moving(1.0, see);
        (self.drive, self.parameter, self.peak) = (drive, parameter, None);
        end
    }

    /// Traces on moving geometry until the parameter reaches `target` or the path ends: [`End::Mechanism`] where the
    /// parameter has passed its peak for good, [`End::Rising`] where the chain has moved too far for its displacements to
    /// mean anything.
    pub fn trace_moving(&mut self, target: f64, see: &mut dyn FnMut(&Tracer) -> ControlFlow<()>) -> End {
        let start = self.parameter;
        let mut longest = LONGEST * self.size;
        let (mut halvings, mut zero_steps, mut barred, mut refined) = (0, 0, None, false);
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
            if let Some(end) = self.is_over(start) {
                return end;
            }
            let event = self.nearest_event(barred);
            let to_target = if self.rate > 0.0 { (target - self.parameter) / self.rate } else { f64::INFINITY };
            let to_event = event.map_or(f64::INFINITY, |event| event.step);
            let step = longest.min(to_event).min(to_target);
            let hold = match event {
                _ if step == to_target => Hold::Parameter,
                Some(event) if step == to_event => Hold::Border(event, self.states[event.contact]),
                _ => Hold::Fastest(fastest(&self.direction)),
            };
            let before = (self.displacements.clone(), self.parameter, self.rate);
            let violated = self.violated();
            self.advance(step);
            if let Hold::Parameter = hold {
                self.parameter = target;
            }
            if !self.correct(hold) || self.missed(&violated, hold) {
                (self.displacements, self.parameter) = (before.0, before.1);
                halvings += 1;
                if std::env::var("DBG").is_ok() { eprintln!("fail step={step:e} {hold:?} par={} rate={} res={:e} ratio={:e}", self.parameter, self.rate, self.worst_residual, self.factor.pivot_ratio()); }
                if halvings > HALVINGS || self.events > most_events || !(self.find_residual() < FAILED) {
                    return End::Lost;
                }
                longest = 0.5 * step;
                self.renew_tangent();
                continue;
            }
            halvings = 0;
            if std::env::var("DBG").is_ok() { eprintln!("ok step={step:e} {hold:?} par={} rate={} res={:e}", self.parameter, self.rate, self.worst_residual); }
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

    fn is_over(&self, start: f64) -> Option<End> {
        let fallen = |peak: &super::Peak| self.parameter < peak.parameter - FALLEN * (peak.parameter - start).abs();
        if self.peak.as_ref().is_some_and(fallen) {
            return Some(End::Mechanism);
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
        let moved = self.displacements.iter().zip(&self.linearised_at).map(|(a, b)| (a - b).abs());
        moved.fold(0.0, f64::max)
    }

    /// Brings the chain back to equilibrium while something is held; false where that does not converge.
    fn correct(&mut self, hold: Hold) -> bool {
        let mut correction = vec![0.0; self.displacements.len()];
        let mut last = f64::INFINITY;
        for _ in 0..CORRECTIONS {
            let worst = self.find_residual();
            let off = if let Hold::Border(event, state) = hold { self.border(event, state, None)[0] } else { 0.0 };
            let off_share = match hold {
                Hold::Border(event, state) => self.as_force(event.contact, state, event.next, off).abs() / self.load_scale,
                _ => 0.0,
            };
            if worst < EQUILIBRIUM && off_share < EQUILIBRIUM {
                self.worst_residual = self.worst_residual.max(worst);
                return true;
            }
            if !(worst + off_share < 10.0 * last) {
                return false;
            }
            last = worst + off_share;
            self.factor.solve(&self.matrix, &self.residual, &mut correction);
            let along = match hold {
                Hold::Parameter => 0.0,
                Hold::Fastest(c) => -correction[c] / self.direction[c],
                Hold::Border(event, state) => {
                    let [_, of_correction] = self.border(event, state, Some(&correction));
                    let [_, of_direction] = self.border(event, state, None);
                    -(off + of_correction) / of_direction
                }
            };
            for ((d, c), t) in self.displacements.iter_mut().zip(&correction).zip(&self.direction) {
                *d += c + along * t;
            }
            self.parameter += along * self.rate;
        }
        let worst = self.find_residual();
        if worst < FAILED {
            self.worst_residual = self.worst_residual.max(worst);
        }
        worst < FAILED
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

    /// Which contacts are beyond a border of their state.
    fn violated(&self) -> Vec<bool> {
        let beyond = |p: usize| {
            let (state, mut beyond) = (self.states[p], false);
            self.ways_out(p, state, |[value, _], next| {
                beyond |= self.as_force(p, state, next, value) < -MISSED * self.load_scale;
            });
            beyond
        };
        (0..self.states.len()).map(beyond).collect()
    }

    /// True where a step went beyond a border that it was not meant to reach.
    fn missed(&self, before: &[bool], hold: Hold) -> bool {
        let meant = |p: usize| matches!(hold, Hold::Border(event, _) if event.contact == p);
        self.violated().iter().zip(before).enumerate().any(|(p, (now, before))| *now && !before && !meant(p))
    }
}

/// The largest entry.
fn fastest(direction: &[f64]) -> usize {
    (0..direction.len()).max_by(|&i, &j| direction[i].abs().total_cmp(&direction[j].abs())).unwrap_or(0)
}
