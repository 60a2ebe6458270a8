//! The load path, traced from one change of contact state to the next.
//!
//! Between changes of state the response is linear, and with slip measured from the unstressed start the law is
//! a continuous piecewise-linear map: its solutions form a path that crosses one border at a time. The tracer follows
//! that path exactly. It never asks for a direction of loading: after each crossing the sign of the new tangent is the
//! one that goes on crossing, so rises and falls of the load factor, and momentary mechanisms, pass by themselves.

mod correct;
mod creep;
mod drift;
mod drive;
mod equilibrium;
mod event;
mod lost;
mod moving;
mod peak;
mod point;
mod seen;
mod start;
mod tangent;

pub use drive::{Drive, Movement, covering};
pub use lost::{Lost, Violation};
pub use moving::{LOW, Patience};
pub use peak::Peak;

use super::assembly::Assembly;
use super::contact::State;
use super::elements::Elements;
use super::factor::Factor;
use super::moving::{Placed, Velocity};
use crate::budget::Budget;
use drift::Drift;
use event::Event;
use std::ops::ControlFlow;
use tangent::Updates;

/// How a trace ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum End {
    /// The parameter reached the value asked for.
    Reached,
    /// The assembly moves on without any further change: a mechanism.
    Mechanism,
    /// The parameter rises, for all that can be told to the value asked for, and the assembly moves so far with it that its
    /// displacements mean nothing.
    Rising,
    /// The caller asked to stop.
    Stopped,
    /// The path could not be followed (ties that do not resolve, or lost equilibrium).
    Lost,
}

/// A pivot ratio below this is a mechanism (measured: regular 1e-2 to 1e-8, singular below 1e-14).
const SINGULAR: f64 = 1e-13;
/// So is a direction in which the assembly has to move by its own size to take on this share of its load (measured:
/// stable assemblies take on 1e4 times their load). Elimination that pivots inside the blocks only may blur a singular
/// pivot to 1e-10; this it does not blur.
const SOFT: f64 = 1e-6;
/// So is one in which the load gains, per movement, less than this share of the stiffest contact's stiffness for every contact:
/// rounding of the stiffness gains as much (measured: rounding up to 5e-16, stable assemblies 1e-12 and more).
const BLURRED: f64 = 16.0 * f64::EPSILON;
/// An assembly that moves by so many sizes while its load gains less than `SOFT` for each goes on for ever; and equilibrium that is
/// lost to rounding so far away is none that it could reach.
const FAR: f64 = 100.0;
/// One that has moved by this share of its size in a soft direction, its load hardly gaining, until equilibrium is lost to rounding
/// has fallen.
const VISIBLE: f64 = 0.01;
/// So many steps of length zero in a row, and as many more per contact, mean that ties do not resolve.
const MOST_ZERO_STEPS: [usize; 2] = [60, 4];
/// A path has at most so many events, and so many more per contact; real ones have about one per contact.
const MOST_EVENTS: [usize; 2] = [200, 20];

/// Follows the load path of an assembly.
#[derive(Clone)]
pub struct Tracer<'a> {
    assembly: &'a Assembly,
    /// Beats in long work between events.
    budget: &'a Budget<'a>,
    drive: Drive,
    /// Extent of the assembly and scale of its loads.
    size: f64,
    load_scale: f64,
    /// Greatest normal stiffness of a contact, N/m2.
    stiffest: f64,
    states: Vec<State>,
    displacements: Vec<f64>,
    parameter: f64,
    /// What rounding has taken off both, on moving geometry.
    rests: Vec<f64>,
    parameter_rest: f64,
    /// Change of the parameter along the current direction.
    rate: f64,
    peak: Option<Peak>,

    /// The moving geometry; none on the reference geometry (first order).
    moving: Option<Placed>,
    /// Highest parameter before the first dip that is worth telling.
    dip: Option<f64>,
    /// Whether the path lies so far below its peak that it has ended for sure.
    fallen: bool,
    /// Whether the path, where it last lay below its peak but above its start, was on the way it had come.
    retraced: bool,
    /// Why the path was lost, where it was.
    lost: Option<Lost>,
    /// The contact beyond its law that kept the last step from being made.
    stuck: Option<Violation>,
    /// Gap and slip that the moving ground gives every contact per unit of the parameter, first order.
    settling: Vec<[f64; 2]>,

    /// Tangent stiffness, load rate and their factors, without the changes that `updates` follows.
    matrix: Elements,
    load_rate: Vec<f64>,
    factor: Factor<'a>,
    updates: Updates,
    /// Largest entry of the drive's load rate.
    load_rate_scale: f64,
    /// Scratch: gaps and gap rates of all contacts, tangent direction.
    gaps: Vec<[f64; 2]>,
    rates: Vec<[f64; 2]>,
    forces: Vec<[f64; 2]>,
    direction: Vec<f64>,
    residual: Vec<f64>,

    events: usize,
    factorisations: usize,
    worst_residual: f64,
    /// The most that any unknown can have changed by along the way, m; on the reference geometry.
    travelled: f64,
}

impl<'a> Tracer<'a> {
    /// Traces until the parameter reaches `target` or the path ends. `see` is called at the start and after every event.
    /// A target that is not ahead of the current parameter is [`End::Lost`].
    pub fn trace(&mut self, target: f64, see: &mut dyn FnMut(&Tracer) -> ControlFlow<()>) -> End {
        let end = self.trace_straight(target, see);
        self.unless_stopped(end)
    }

    /// An end that is none where the budget is spent.
    fn unless_stopped(&self, end: End) -> End {
        if self.budget.check().is_ok() { end } else { End::Stopped }
    }

    /// Traces on the reference geometry, along straight lines.
    fn trace_straight(&mut self, target: f64, see: &mut dyn FnMut(&Tracer) -> ControlFlow<()>) -> End {
        let far = FAR * self.size;
        let most = |[base, each]: [usize; 2]| base + each * self.states.len();
        let (most_zero_steps, most_events) = (most(MOST_ZERO_STEPS), self.events + most(MOST_EVENTS));
        let (mut zero_steps, mut barred, mut drift) = (0, None, Drift::at(self.parameter));
        self.solve_tangent();
        if self.rate < 0.0 {
            self.turn_round();
        }
        if !self.keep_equilibrium() || target <= self.parameter {
            return End::Lost;
        }
        loop {
            self.note_peak(self.rate <= 0.0 || self.is_mechanism());
            if see(self).is_break() {
                return End::Stopped;
            }
            let event = self.nearest_event(barred);
            let drifts = event.is_some_and(|event| self.drifts(drift, event.step));
            let rises = self.rate > 0.0 && !self.is_mechanism() && !drifts;
            let event = event.filter(|_| !drifts);
            let to_target = (target - self.parameter) / self.rate;
            if rises && event.is_none_or(|event| to_target <= event.step) {
                if to_target > far {
                    return End::Rising;
                }
                self.advance(to_target);
                self.parameter = target;
                return if self.keep_equilibrium() { End::Reached } else { End::Lost };
            }
            let Some(event) = event else {
                self.note_peak(true);
                return End::Mechanism;
            };
            zero_steps = if event.step > 0.0 { 0 } else { zero_steps + 1 };
            barred = Some((event.contact, self.states[event.contact]));
            self.advance(event.step);
            drift = self.drifted(drift, event.step);
            self.cross(event);
            if zero_steps > most_zero_steps || self.events > most_events {
                return End::Lost;
            }
            let residual = self.worst_residual;
            if !self.keep_equilibrium() {
                return self.lost_equilibrium(drift, residual);
            }
        }
    }

    /// What it means that equilibrium is lost to rounding: far out on a path that rises, nothing; in a soft direction in which it
    /// has moved visibly, that the assembly has fallen, from a peak in equilibrium; `residual` is the worst before.
    fn lost_equilibrium(&mut self, drift: Drift, residual: f64) -> End {
        let moved = self.displacements.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
        match self.is_mechanism() {
            false if self.rate > 0.0 && moved > FAR * self.size => End::Rising,
            true if drift.moved() > VISIBLE * self.size && self.peaked_since(drift) => {
                self.worst_residual = residual;
                End::Mechanism
            }
            _ => End::Lost,
        }
    }

    fn advance(&mut self, step: f64) {
        for (d, along) in self.displacements.iter_mut().zip(&self.direction) {
            *d += along * step;
        }
        self.parameter += step * self.rate;
        // The direction's largest entry is 1.
        self.travelled += step;
    }

    /// Switches one contact and turns into the new cell so that the event goes on crossing its border.
    fn cross(&mut self, event: Event) {
        let before = self.states[event.contact];
        self.states[event.contact] = event.next;
        self.events += 1;
        self.follow_change(event.contact, before);
        let mut crossing = 0.0;
        self.ways_out(event.contact, before, |value, next| {
            if next == event.next || before == State::Open {
                crossing = value[1];
            }
        });
        if crossing > 0.0 {
            self.turn_round();
        }
    }

    /// Rates of gap and slip along the direction.
    fn find_rates(&mut self) {
        match &self.moving {
            None => {
                self.assembly.gaps(&self.direction, &mut self.rates);
                let drifting = if self.drive.gaps_drift() { self.states.len() } else { 0 };
                for p in 0..drifting {
                    let drift = self.drift(p);
                    (0..2).for_each(|axis| self.rates[p][axis] += drift[axis] * self.rate);
                }
            }
            Some(moving) => {
                let along = Velocity { nodes: &self.direction, parameter: self.parameter, rate: self.rate };
                moving.gap_rates(self.assembly, &self.drive, along, &self.gaps, &mut self.rates);
            }
        }
    }

    fn turn_round(&mut self) {
        self.direction.iter_mut().for_each(|d| *d = -*d);
        self.rates.iter_mut().for_each(|g| *g = g.map(|x| -x));
        self.rate = -self.rate;
    }

    /// True where the present contact state leaves the assembly free to move.
    pub fn is_mechanism(&self) -> bool {
        let gained = self.rate.abs() * self.size * self.load_rate_scale;
        // Moving geometry stiffens an assembly by its loads, however stiff its contacts are.
        let contacts = if self.moving.is_none() { self.states.len() } else { 0 };
        let blurred = BLURRED * contacts as f64 * self.stiffest * self.size;
        self.factor.pivot_ratio() < SINGULAR || gained < blurred.max(SOFT * self.load_scale)
    }
}
