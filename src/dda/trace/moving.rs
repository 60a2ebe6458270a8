//! The path on moving geometry.
//!
//! Between changes of state the path is a smooth curve now. A step goes along its tangent, to the next change of state or as far as
//! the curve is nearly straight, and is then corrected to equilibrium while one quantity is held: the border of the change of state;
//! the displacement that grows fastest, so that limit points are passed; or the parameter, at the end.

use super::correct::{EQUILIBRIUM, FAILED, Hold};
use super::lost::Lost;
use super::point::PathState;
use super::{End, Tracer};
use crate::dda::factor::Factor;
use crate::dda::moving::{Placed, quarter};
use crate::dda::trace::Drive;
use std::ops::ControlFlow;

/// Longest step between two linearisations, as a share of the size: joints of slender stones then turn by a degree at most.
const LONGEST_STEP: f64 = 2e-3;
/// Limit points are not looked for in steps shorter than this share of the size.
const SHORTEST_LOOK: f64 = 2e-5;
/// Steps shorter than this share of the size are rounding.
const SHORTEST_STEP: f64 = 1e-10;
/// A path has at most so many events, and so many more per contact; real ones have about two per contact.
const MOST_MOVING_EVENTS: [usize; 2] = [200, 6];
/// So many halvings of a step in a row mean that the path is lost.
const HALVINGS: usize = 40;
/// A path has at most so many steps that end at no change of state; real ones have up to two hundred.
const MOST_STEPS: usize = 4000;
/// A path that is lost after it has fallen by this share and moved a little, or moved by this share of its size, has ended.
const SURE: [f64; 2] = [0.1, 0.01];
/// So has one that is lost after it has fallen by this share, however little it has moved.
const DEEP: f64 = 0.5;
/// A snap is worth telling where the parameter falls by this share of what it rose.
const SNAP: f64 = 0.01;
/// A peak above the start by less than this share of what counts as a rise may be that of a snap, which runs back past the start before
/// it goes on, such as that of a keystone that tips over: how far it falls does not count then, only how far the assembly moves.
pub const LOW: f64 = 0.1;
/// Displacements beyond this share of the size are no arch of this shape any more.
const FARTHEST: f64 = 0.3;
/// A path that comes back to its start with less movement since its peak than so many times what it had moved by there, or than this
/// share of the little that has to be seen, has come the way it went: that is no fall, but a wrong turn.
const THERE_AND_BACK: [f64; 2] = [3.0, 0.25];
/// Strain beyond which stone is no longer elastic by any measure.
const STRAINED: f64 = 0.02;

/// How long a path may lie below its peak until that counts as its end. A shorter dip is a snap: stones that find another
/// seat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patience {
    /// Fall of the parameter, as a share of what it rose, that counts together with a small movement.
    pub fall: f64,
    /// Rises smaller than this count as this.
    pub rise: f64,
    /// Movements of the assembly, as shares of its size: the small one, and the one that counts alone.
    pub movement: [f64; 2],
    /// An assembly that moves by the larger of the two while its parameter rises by less than this share of what it rose has ended as
    /// well; nought where rises count however small.
    pub creep: f64,
    /// Whether the parameter is one of loads, not of springings: a path that is lost deep below its peak has ended there too, and
    /// one that comes back the way it went has not.
    pub loads: bool,
}

/// A path to follow.
#[derive(Debug, Clone, Copy)]
struct Way {
    target: f64,
    patience: Patience,
    /// From its start the parameter rises (+1) or falls (-1).
    sign: f64,
    /// Whether through the dip below a low peak.
    through: bool,
}

impl Tracer<'_> {
    /// Takes a path that stands at first order over to the moving geometry, with `drive` at `parameter`: the forces that
    /// are out of balance there are let go step by step.
    pub fn move_on(&mut self, drive: Drive, parameter: f64, see: &mut dyn FnMut(&Tracer) -> ControlFlow<()>) -> End {
        let end = self.let_go(drive, parameter, see);
        self.unless_stopped(end)
    }

    fn let_go(&mut self, drive: Drive, parameter: f64, see: &mut dyn FnMut(&Tracer) -> ControlFlow<()>) -> End {
        (self.drive, self.moving) = (drive.clone(), Some(Placed::new(self.assembly, self.budget)));
        let Some(tree) = self.assembly.plain_tree(self.budget) else { return End::Stopped };
        self.factor = Factor::new(tree).after(self.factor.eliminated());
        self.set_parameter(parameter);
        // Gaps on moving geometry differ from those at first order, and so may states.
        self.find_residual();
        self.states_by_law();
        if self.find_residual() < EQUILIBRIUM {
            return End::Reached;
        }
        let held = self.residual.clone();
        let held_turned: Vec<f64> = quarter(&held).map(|x| -x).collect();
        let at = |base: &[f64], rate: &[f64], held: &[f64]| -> Vec<f64> {
            (0..held.len()).map(|i| base[i] + parameter * rate[i] - held[i]).collect()
        };
        debug_assert!(parameter == 0.0 || drive.ground.iter().all(|g| g.is_still()), "the ground starts at rest");
        self.drive = Drive {
            base: at(&drive.base, &drive.rate, &held),
            turned: [at(&drive.turned[0], &drive.turned[1], &held_turned), held_turned],
            rate: held,
            ..Drive::default()
        };
        self.set_parameter(0.0);
        let patience = Patience { fall: f64::INFINITY, rise: 1.0, movement: [0.0, SURE[1]], creep: 0.0, loads: true };
        let end = self.trace_moving(1.0, patience, see);
        (self.drive, self.peak) = (drive, None);
        self.set_parameter(parameter);
        end
    }

    /// Traces on moving geometry until the parameter reaches `target` or the path ends: [`End::Mechanism`] where the
    /// parameter has passed its peak for good, [`End::Rising`] where the assembly has moved too far for its displacements to
    /// mean anything.
    pub fn trace_moving(
        &mut self,
        target: f64,
        patience: Patience,
        see: &mut dyn FnMut(&Tracer) -> ControlFlow<()>,
    ) -> End {
        let (start, at, states, residual) = (self.parameter, self.point(), self.states.clone(), self.worst_residual);
        let up = Way { target, patience, sign: 1.0, through: false };
        let end = self.trace_one_way(up, see);
        if end != End::Mechanism || self.parameter >= start || self.fell_past_start(start, patience) {
            return end;
        }
        // From a point on the middle branch of an S the path up ends where the parameter was to come from; the way down
        // passes a fold and goes up then.
        let low = self.peak.as_ref().is_some_and(|peak| is_low(peak.parameter - start, patience));
        let first = (self.parameter, self.peak.take(), self.dip, self.worst_residual, self.retraced);
        self.go_to(&at);
        (self.states, self.worst_residual) = (states.clone(), residual);
        let end = self.trace_one_way(Way { sign: -1.0, ..up }, see);
        let fails = end == End::Lost || (end == End::Mechanism && self.parameter < start);
        if low && fails {
            self.go_to(&at);
            (self.states, self.worst_residual) = (states, residual);
            return self.trace_one_way(Way { through: true, ..up }, see);
        }
        if end == End::Mechanism && self.parameter < start {
            (self.parameter, self.peak, self.dip, self.worst_residual, self.retraced) = first;
        }
        end
    }

    /// Whether a path that came down past its start had fallen by then, and not only taken a wrong turn: it had risen, and moved
    /// on as it came down. Springings that move back take the arch along.
    fn fell_past_start(&self, start: f64, patience: Patience) -> bool {
        let risen = self.peak.as_ref().is_some_and(|peak| !is_low(peak.parameter - start, patience));
        risen && !(self.retraced && patience.loads)
    }

    fn trace_one_way(&mut self, way: Way, see: &mut dyn FnMut(&Tracer) -> ControlFlow<()>) -> End {
        (self.dip, self.peak, self.fallen, self.lost, self.retraced) = (None, None, false, None, false);
        let walked = self.walk(way, see);
        self.lost = walked.err();
        match self.unless_stopped(walked.unwrap_or(End::Lost)) {
            End::Lost if self.fallen => End::Mechanism,
            end => end,
        }
    }

    fn walk(
        &mut self,
        Way { target, patience, sign, through }: Way,
        see: &mut dyn FnMut(&Tracer) -> ControlFlow<()>,
    ) -> Result<End, Lost> {
        let start = self.parameter;
        let mut longest = LONGEST_STEP * self.size;
        let (mut halvings, mut zero_steps, mut steps, mut barred, mut refined) = (0, 0, 0, None, false);
        let most_zero_steps = super::MOST_ZERO_STEPS[0] + super::MOST_ZERO_STEPS[1] * self.states.len();
        let most_events = self.events + MOST_MOVING_EVENTS[0] + MOST_MOVING_EVENTS[1] * self.states.len();
        let residual = self.find_residual();
        if residual > FAILED + self.rounding() || target <= start {
            return Err(Lost::OutOfBalance(residual));
        }
        if let Some(violation) = self.violated() {
            return Err(Lost::AgainstLaw(violation));
        }
        self.linearise();
        self.solve_tangent();
        if self.rate * sign < 0.0 {
            self.turn_round();
        }
        let mut stretch = self.stretch(patience.rise);
        let from = self.point();
        loop {
            if see(self).is_break() {
                return Ok(End::Stopped);
            }
            if let Some(end) = self.is_over(&from, patience, through) {
                return Ok(end);
            }
            if patience.creep > 0.0 && self.creeps(&mut stretch, patience) {
                return Ok(End::Mechanism);
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
            let (before, rate) = (self.point(), self.rate);
            let direction = self.direction.clone();
            let held = self.step(step, hold, target);
            // A limit point short of the next event is a point of the path too.
            let passed = rate > 0.0 && self.parameter < before.parameter && step >= SHORTEST_LOOK * self.size;
            let passed = |hold: &Hold| passed && matches!(hold, Hold::Border(..));
            let Some(hold) = held.filter(|hold| !passed(hold) && self.went_on(&before.displacements, step)) else {
                self.go_to(&before);
                halvings += 1;
                let residual = self.find_residual();
                if halvings > HALVINGS || residual > FAILED + self.rounding() {
                    return Err(self.why_stuck(residual));
                }
                if self.events > most_events {
                    return Err(Lost::Endless(self.events));
                }
                longest = 0.5 * step;
                // Corrections renew the direction as they go, and may have lost their way.
                self.direction = direction;
                self.renew_tangent();
                continue;
            };
            halvings = 0;
            match hold {
                Hold::Parameter => return Ok(End::Reached),
                Hold::Border(event, state) => {
                    zero_steps = if step > 0.0 { 0 } else { zero_steps + 1 };
                    if zero_steps > most_zero_steps {
                        return Err(Lost::Ties(zero_steps));
                    }
                    if self.events > most_events {
                        return Err(Lost::Endless(self.events));
                    }
                    barred = Some((event.contact, state));
                    // Geometric stiffness goes with the forces too, which change without much movement.
                    self.linearise();
                    self.cross(event);
                    refined = false;
                    self.note_peak(self.rate <= 0.0);
                }
                Hold::Fastest(_) => {
                    steps += 1;
                    if steps > MOST_STEPS {
                        return Err(Lost::Endless(steps));
                    }
                    barred = None;
                    self.renew_tangent();
                    refined = rate > 0.0 && self.rate < 0.0 && !refined;
                    if refined && !self.stop_at_limit_point(&before, rate, step) {
                        let residual = self.find_residual();
                        return Err(self.why_stuck(residual));
                    }
                    longest = (2.0 * longest).min(LONGEST_STEP * self.size);
                }
            }
        }
    }

    /// True unless a correction has undone a step from displacements `before`, and more.
    fn went_on(&self, before: &[f64], step: f64) -> bool {
        let moved = self.displacements.iter().zip(before).zip(&self.direction).map(|((d, b), t)| (d - b) * t);
        step < SHORTEST_STEP * self.size || moved.sum::<f64>() >= 0.0
    }

    /// Goes back to `before`, a step ago, where the parameter's rate was `rate`, and stops where the parameter is highest in
    /// between: the rate falls about linearly through zero. False where that point is not found.
    fn stop_at_limit_point(&mut self, before: &PathState, rate: f64, step: f64) -> bool {
        let share = rate / (rate - self.rate);
        self.go_to(before);
        self.find_residual();
        self.renew_tangent();
        self.move_by(share * step, &vec![0.0; self.displacements.len()]);
        let found = self.correct(Hold::Fastest(fastest(&self.direction)));
        self.renew_tangent();
        self.note_peak(true);
        found
    }

    /// How the path has ended, if it has; `through`: below a low peak only by how far it has moved.
    fn is_over(&mut self, from: &PathState, patience: Patience, through: bool) -> Option<End> {
        let start = from.parameter;
        let below = self.peak.as_ref().filter(|peak| self.parameter < peak.parameter);
        let is_below = below.is_some();
        self.fallen = false;
        if let Some(peak) = below {
            let moved = farthest(&self.displacements, &peak.displacements) / self.size;
            if self.parameter >= start {
                let went = farthest(&peak.displacements, &from.displacements) / self.size;
                self.retraced = moved < (THERE_AND_BACK[0] * went).max(THERE_AND_BACK[1] * patience.movement[0]);
            }
            let fall = (peak.parameter - self.parameter) / (peak.parameter - start).max(patience.rise);
            let [little, far] = patience.movement;
            let low = through && is_low(peak.parameter - start, patience);
            let beyond = |most: f64, far: f64| moved > far || (fall > most && moved > little && !low);
            if beyond(patience.fall, far) {
                return Some(End::Mechanism);
            }
            self.fallen = patience.loads && (beyond(SURE[0], SURE[1]) || (fall > DEEP && !low));
            if fall > SNAP && peak.parameter > start {
                self.dip = self.dip.or(Some(peak.parameter));
            }
        }
        let far = self.displacements.iter().fold(0.0, |far: f64, d| far.max(d.abs())) > FARTHEST * self.size;
        let strained = self.moving.as_ref().is_some_and(|moving| moving.largest_strain() > STRAINED);
        (far || strained).then_some(if is_below { End::Mechanism } else { End::Rising })
    }

    /// Linearises where the assembly is and goes on the way it went.
    pub(super) fn renew_tangent(&mut self) {
        self.linearise();
        self.renew_factors();
    }

    /// Renews the stiffness of bodies and interfaces where they are now.
    fn linearise(&mut self) {
        if let Some(moving) = &mut self.moving {
            if moving.linearise(self.assembly, &self.drive, self.budget).is_err() {
                return;
            }
            for i in 0..self.assembly.bodies() {
                self.matrix.get_mut(i).copy_from_slice(moving.bodies.get(i));
                self.factor.invalidate(i);
            }
        }
        self.reassemble_all();
    }
}

/// Whether a peak so far above the start may be that of a snap.
fn is_low(risen: f64, patience: Patience) -> bool {
    risen < LOW * patience.rise
}

/// Largest difference of two displacements.
pub(super) fn farthest(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// The largest entry.
fn fastest(direction: &[f64]) -> usize {
    (0..direction.len()).max_by(|&i, &j| direction[i].abs().total_cmp(&direction[j].abs())).unwrap_or(0)
}
