//! Positions of the vehicles, with their loads and what is known of them.

use super::super::{PositionPoint, PositionQuestion, Sweep};
use crate::budget::Budget;
use crate::structure::PointForce;
use crate::structure::load::Load;

/// Multiplications of finding what of an axle comes down on a face.
const LOOK: usize = 50;

/// The vehicles at one position.
#[derive(Debug, Clone)]
pub(super) struct Place {
    /// Abscissa of their reference, m.
    pub x: f64,
    pub reversed: bool,
    /// Whether its curve is told of it in any case.
    pub on_grid: bool,
    /// Their forces that stay, and that are scaled.
    pub fixed: Vec<PointForce>,
    pub scaled: Vec<PointForce>,
    /// Share of their force that comes down on the structure.
    pub arriving: f64,
    /// The lowest bound of the load factor, and which that is.
    pub bound: Option<(usize, f64)>,
    /// Load factors of collapse of stone that does not crush and of stone that does, where they were looked for and found.
    pub found: Option<[Option<f64>; 2]>,
}

/// All positions of the grid, with so many between every two of them; fewer when stopped.
pub(super) fn places(question: &PositionQuestion, between: usize, budget: &Budget) -> Vec<Place> {
    let of_sweep = |sweep: &Sweep| {
        let (parts, reversed) = (sweep.parts() * (between + 1), sweep.reversed);
        let place = move |i: usize| {
            let x = sweep.from + (sweep.to - sweep.from) * (i as f64 / parts as f64);
            let place = Place::new(question, x, reversed, budget)?;
            Some(Place { on_grid: i.is_multiple_of(between + 1), ..place })
        };
        (0..=parts).filter_map(place).collect::<Vec<_>>()
    };
    question.sweeps.iter().flat_map(of_sweep).collect()
}

impl Place {
    /// None where a vehicle does not fit the structure, and when stopped.
    pub fn new(question: &PositionQuestion, x: f64, reversed: bool, budget: &Budget) -> Option<Self> {
        let axles: usize = question.vehicles.iter().map(|moving| moving.vehicle.patches().count()).sum();
        budget.work(LOOK * axles * question.analysis.structure.surfaces.len()).ok()?;
        let [mut fixed, mut scaled] = [Vec::new(), Vec::new()];
        let (mut whole, mut arriving) = (0.0, 0.0);
        for moving in &question.vehicles {
            let vehicle = moving.vehicle.at(x, reversed);
            whole += vehicle.force() * moving.coefficient.abs();
            let load = Load::Vehicle(vehicle);
            let forces = load.on_pieces(&question.analysis.structure, &question.pieces, moving.coefficient).ok()?;
            arriving += forces.iter().map(|force| force.force.y.abs()).sum::<f64>();
            if moving.scaled { &mut scaled } else { &mut fixed }.extend(forces);
        }
        Some(Place { x, reversed, on_grid: false, fixed, scaled, arriving: arriving / whole, bound: None, found: None })
    }

    /// Takes a bound where it is lower.
    pub fn lower(&mut self, number: usize, value: f64) {
        if value.is_finite() && self.bound.is_none_or(|(_, lowest)| value < lowest) {
            self.bound = Some((number, value));
        }
    }

    /// The lower of the two load factors that were found.
    pub fn load_factor(&self) -> Option<f64> {
        self.found.and_then(|_| self.point().load_factor())
    }

    pub fn point(&self) -> PositionPoint {
        let [instability, crushing] = self.found.unwrap_or_default();
        PositionPoint { x: self.x, reversed: self.reversed, arriving: self.arriving, instability, crushing }
    }
}
