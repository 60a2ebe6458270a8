//! Positions of the vehicles, with their loads and what is known of them.

use super::super::{PositionPoint, PositionQuestion, Sweep};
use super::Mechanism;
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
    /// Their forces that stay, and that are scaled.
    pub fixed: Vec<PointForce>,
    pub scaled: Vec<PointForce>,
    /// Share of their force that comes down on the structure.
    pub arriving: f64,
    /// Load factors of collapse of stone that does not crush and of stone that does, where they were looked for and found.
    pub found: Option<[Option<f64>; 2]>,
    /// In which it collapses at these.
    pub mechanisms: Vec<Mechanism>,
}

/// All positions of the grid; fewer when stopped.
pub(super) fn places(question: &PositionQuestion, budget: &Budget) -> Vec<Place> {
    let of_sweep = |sweep: &Sweep| {
        sweep.positions().filter_map(|x| Place::new(question, x, sweep.reversed, budget)).collect::<Vec<_>>()
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
        Some(Place { x, reversed, fixed, scaled, arriving: arriving / whole, found: None, mechanisms: Vec::new() })
    }

    /// How many forces its vehicles have.
    pub fn forces(&self) -> usize {
        self.fixed.len() + self.scaled.len()
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
