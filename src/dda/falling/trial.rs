//! One trial of a step: the problem it poses, its solution, and where that takes the blocks.

use super::block::{Block, Place};
use super::frame::Stuck;
use super::neighbours::Placed;
use super::pair::Contact;
use super::solver::{Problem, Solution};
use super::step::Falling;
use crate::budget::Budget;

use crate::geometry::{cross, perpendicular};
use nalgebra::Vector3;

/// Bounds on friction that do not depend on the step are brought up to date so often, starting from the step before.
const ROUNDS: usize = 100;
/// They are up to date when they change by less than this share of the loads.
const RUBBED: f64 = 1e-6;

/// A step that may be made.
pub(super) struct Trial {
    pub places: Vec<Place>,
    pub solution: Solution,
    /// Friction beyond its bound, share of the loads.
    pub excess: f64,
    /// Largest movement of a corner, m.
    pub moved: f64,
}

impl Falling {
    /// The step of the present size, if it can be made.
    ///
    /// # Errors
    /// When it cannot: try a shorter one, or `lagging` bounds on friction; and where the budget is spent.
    pub(super) fn attempt(&self, contacts: &[Placed], lagging: bool, budget: &Budget) -> Result<Trial, Stuck> {
        let mut problem = self.problem(contacts);
        let solution = match problem.solve(budget) {
            Ok(solution) => solution,
            Err(_) if !lagging => return Err(Stuck),
            Err(_) => self.with_given_bounds(&mut problem, contacts, budget)?,
        };
        let excess = contacts.iter().zip(&solution.forces).map(|(&(k, end, _), force)| {
            force[1].abs() - self.friction[k].coefficient * force[0] - self.cohesion(k, end)
        });
        let excess = excess.fold(0.0, f64::max);
        let mut moved: f64 = 0.0;
        let mut places = Vec::with_capacity(self.places.len());
        for ((block, place), by) in self.blocks.iter().zip(&self.places).zip(&solution.increments) {
            let by = Vector3::new(by.x * self.thickness, by.y * self.thickness, by.z);
            let next = if block.fixed { *place } else { place.moved(&by) };
            let (from, to) = (block.corners(place), block.corners(&next));
            moved = from.iter().zip(&to).map(|(from, to)| (to - from).norm()).fold(moved, f64::max);
            places.push(next);
        }
        if !moved.is_finite() {
            return Err(Stuck);
        }
        Ok(Trial { places, solution, excess, moved })
    }

    /// The same step with bounds on friction that do not depend on it, brought up to date round by round. Each round is a
    /// convex programme.
    fn with_given_bounds(
        &self,
        problem: &mut Problem,
        contacts: &[Placed],
        budget: &Budget,
    ) -> Result<Solution, Stuck> {
        let coefficient = |c: usize| self.friction[contacts[c].0].coefficient;
        let cohesion: Vec<f64> = problem.contacts.iter().map(|contact| contact.constant).collect();
        for (c, contact) in problem.contacts.iter_mut().enumerate() {
            contact.slope = 0.0;
            contact.constant += coefficient(c) * contact.guess;
        }
        let mut last = Err(Stuck);
        for _ in 0..ROUNDS {
            let Ok(solution) = problem.solve(budget) else { break };
            let mut change: f64 = 0.0;
            for (c, contact) in problem.contacts.iter_mut().enumerate() {
                let bound = cohesion[c] + coefficient(c) * solution.forces[c][0];
                change = change.max((bound - contact.constant).abs());
                contact.constant = 0.5 * (contact.constant + bound);
            }
            last = Ok(solution);
            if change < RUBBED {
                break;
            }
        }
        last
    }

    /// The step's problem in units of thickness and loads.
    fn problem(&self, contacts: &[Placed]) -> Problem {
        let of_step = self.mass * self.thickness / (self.loads * self.step);
        let resistance = |block: &Block| {
            let [mass, inertia] = block.inertia.map(|i| i / self.mass);
            Vector3::new(mass, mass, inertia / self.thickness.powi(2)) * of_step
        };
        let load = |(block, place): (&Block, &Place)| {
            let load = if block.fixed { Vector3::zeros() } else { block.load(place) };
            Vector3::new(load.x, load.y, load.z / self.thickness) / self.loads
        };
        Problem {
            resistance: self.blocks.iter().map(resistance).collect(),
            load: self.blocks.iter().zip(&self.places).map(load).collect(),
            contacts: contacts.iter().map(|placed| self.contact(placed)).collect(),
        }
    }

    fn contact(&self, &(k, end, touch): &Placed) -> Contact {
        let movable = |block: usize| self.blocks.get(block).is_some_and(|block| !block.fixed).then_some(block);
        let blocks = [k.checked_sub(1).and_then(movable), movable(k)];
        let rows = |side: usize| {
            let Some(block) = blocks[side] else { return [Vector3::zeros(); 2] };
            let arm = (touch.at - self.places[block].centroid) / self.thickness;
            let sign = if side == 0 { -1.0 } else { 1.0 };
            [touch.normal, perpendicular(touch.normal)].map(|way| Vector3::new(way.x, way.y, cross(arm, way)) * sign)
        };
        Contact {
            blocks,
            rows: [rows(0), rows(1)],
            gap: touch.gap / self.thickness,
            slope: self.friction[k].coefficient,
            constant: self.cohesion(k, end),
            guess: self.normals[k][end],
        }
    }

    /// Cohesion at an end of an interface, share of the loads.
    fn cohesion(&self, interface: usize, end: usize) -> f64 {
        let whole = self.intact[interface][end];
        if whole { 0.5 * self.friction[interface].cohesion / self.loads } else { 0.0 }
    }
}
