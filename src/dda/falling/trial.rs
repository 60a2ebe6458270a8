//! One trial of a step: the problem it poses, its solution, and where that takes the bodies.

use super::body::{Position, RigidBody};
use super::configuration::Stuck;
use super::constraint::Constraint;
use super::near::PlacedEntrance;
use super::solver::{Solution, StepProblem};
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
    pub places: Vec<Position>,
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
    pub(super) fn attempt(&self, contacts: &[PlacedEntrance], lagging: bool, budget: &Budget) -> Result<Trial, Stuck> {
        let mut problem = self.problem(contacts);
        // Bounds on friction: coefficient of the normal force, and cohesion.
        let bounds: Vec<[f64; 2]> = problem.contacts.iter().map(|c| [c.slope, c.constant]).collect();
        let solution = match problem.solve(budget) {
            Ok(solution) => solution,
            Err(_) if !lagging => return Err(Stuck),
            Err(_) => with_given_bounds(&mut problem, &bounds, budget)?,
        };
        let beyond = |(force, bound): (&[f64; 2], &[f64; 2])| force[1].abs() - bound[0] * force[0] - bound[1];
        let excess = solution.forces.iter().zip(&bounds).map(beyond).fold(0.0, f64::max);
        let mut moved: f64 = 0.0;
        let mut places = Vec::with_capacity(self.places.len());
        for ((body, place), by) in self.bodies.iter().zip(&self.places).zip(&solution.increments) {
            let by = Vector3::new(by.x * self.thickness, by.y * self.thickness, by.z).component_mul(&body.mask());
            let next = place.moved(&by);
            moved = moved.max(body.moved(place, &next));
            places.push(next);
        }
        if !places.iter().all(|place| (place.centroid.sum() + place.angle).is_finite()) {
            return Err(Stuck);
        }
        Ok(Trial { places, solution, excess, moved })
    }

    /// The step's problem in units of thickness and loads.
    fn problem(&self, contacts: &[PlacedEntrance]) -> StepProblem {
        let of_step = self.mass * self.thickness / (self.loads * self.step);
        let resistance = |body: &RigidBody| {
            let [mass, inertia] = body.inertia.map(|i| i / self.mass);
            // What cannot move does not, whatever it resists.
            if body.movable() {
                Vector3::new(mass, mass, inertia / self.thickness.powi(2)) * of_step
            } else {
                Vector3::repeat(1.0)
            }
        };
        let load = |(body, place): (&RigidBody, &Position)| {
            let load = body.load(place);
            Vector3::new(load.x, load.y, load.z / self.thickness) / self.loads
        };
        StepProblem {
            resistance: self.bodies.iter().map(resistance).collect(),
            load: self.bodies.iter().zip(&self.places).map(load).collect(),
            contacts: self.constraints(contacts),
        }
    }

    fn constraints(&self, contacts: &[PlacedEntrance]) -> Vec<Constraint> {
        let outlines = self.outlines(&self.places);
        let mut sharing = vec![[0usize; 2]; self.interfaces.len()];
        contacts.iter().filter_map(|contact| contact.interface).for_each(|(k, end)| sharing[k][end] += 1);
        let constraint = |placed: &PlacedEntrance| {
            let touching = self.at(placed, &outlines);
            let (slope, constant) = match placed.interface {
                Some((k, end)) => {
                    let cohesion = if self.intact[k][end] { 0.5 * self.interfaces[k].cohesion } else { 0.0 };
                    (self.interfaces[k].friction, cohesion / self.loads / sharing[k][end] as f64)
                }
                None => {
                    (placed.parts.map(|part| self.parts[part].friction).into_iter().fold(f64::INFINITY, f64::min), 0.0)
                }
            };
            let bodies = placed.parts.map(|part| self.parts[part].body);
            let rows = |side: usize| {
                let arm = (touching.at - self.places[bodies[side]].centroid) / self.thickness;
                let sign = if side == 0 { -1.0 } else { 1.0 };
                [touching.normal, perpendicular(touching.normal)].map(|way| {
                    Vector3::new(way.x, way.y, cross(arm, way)).component_mul(&self.bodies[bodies[side]].mask()) * sign
                })
            };
            Constraint {
                bodies: bodies.map(|body| self.bodies[body].movable().then_some(body)),
                rows: [rows(0), rows(1)],
                gap: touching.gap / self.thickness,
                slope,
                constant,
                guess: self.normals.get(&(placed.parts, placed.end)).copied().unwrap_or(0.0),
            }
        };
        contacts.iter().map(constraint).collect()
    }
}

/// The same step with `bounds` on friction that do not depend on it, brought up to date round by round. Each round is a convex
/// programme.
fn with_given_bounds(problem: &mut StepProblem, bounds: &[[f64; 2]], budget: &Budget) -> Result<Solution, Stuck> {
    for (contact, [slope, _]) in problem.contacts.iter_mut().zip(bounds) {
        contact.slope = 0.0;
        contact.constant += slope * contact.guess;
    }
    let mut last = Err(Stuck);
    for _ in 0..ROUNDS {
        let Ok(solution) = problem.solve(budget) else { break };
        let mut change: f64 = 0.0;
        for ((contact, [slope, cohesion]), force) in problem.contacts.iter_mut().zip(bounds).zip(&solution.forces) {
            let bound = cohesion + slope * force[0];
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
