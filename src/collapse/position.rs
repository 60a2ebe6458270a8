//! The question for the worst position of vehicles, and what is told of it.

use super::{Analysis, Governs};
use crate::structure::load::Vehicle;

/// The position of vehicles at which the load factor of collapse is least.
#[derive(Debug, Clone, PartialEq)]
pub struct PositionQuestion {
    /// What is asked at that position, under the loads that stand still.
    pub analysis: Analysis,
    /// What moves, all by one reference.
    pub vehicles: Vec<MovingVehicle>,
    /// Into how many pieces the surfaces of every body are cut.
    pub pieces: Vec<usize>,
    /// Where it is looked for.
    pub sweeps: Vec<Sweep>,
    /// How much lower than the one found the least load factor may be by what mechanisms say of positions between, as a share of it.
    pub tolerance: f64,
}

/// A vehicle that moves.
#[derive(Debug, Clone, PartialEq)]
pub struct MovingVehicle {
    /// The vehicle, somewhere.
    pub vehicle: Vehicle,
    /// Multiplies its forces.
    pub coefficient: f64,
    /// Whether the load factor multiplies them too.
    pub scaled: bool,
}

/// Positions in one direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sweep {
    /// First abscissa of the vehicles' reference, m.
    pub from: f64,
    /// Last one, m.
    pub to: f64,
    /// Largest distance of two positions, m.
    pub step: f64,
    /// Whether the vehicles stand the other way round.
    pub reversed: bool,
}

impl Sweep {
    /// Into how many equal parts its positions divide it.
    pub fn parts(&self) -> usize {
        // Three tenths are three parts.
        (((self.to - self.from) / self.step - 1e-9).ceil() as usize).max(1)
    }

    /// Its positions.
    pub fn positions(&self) -> impl Iterator<Item = f64> {
        let (parts, from, length) = (self.parts(), self.from, self.to - self.from);
        (0..=parts).map(move |i| from + length * (i as f64 / parts as f64))
    }
}

/// What limit analysis says of one position. Load factors are infinite where there is no end, minus infinite where nothing is in
/// equilibrium, none where rounding kept the programme from an answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PositionPoint {
    /// Abscissa of the vehicles' reference, m.
    pub x: f64,
    /// Whether they stand the other way round.
    pub reversed: bool,
    /// Share of their force that comes down on the structure.
    pub arriving: f64,
    /// Load factor at which stone that does not crush falls.
    pub instability: Option<f64>,
    /// Load factor at which joints of the stone's strength (plastic sections) give way.
    pub crushing: Option<f64>,
}

impl PositionPoint {
    /// The lower of the two.
    pub fn load_factor(&self) -> Option<f64> {
        [self.instability, self.crushing].into_iter().flatten().reduce(f64::min)
    }
}

/// The worst position.
#[derive(Debug, Clone, PartialEq)]
pub struct PositionReport {
    /// The position of the least load factor; where none has an end, one at which most of the vehicles' force arrives.
    pub worst: PositionPoint,
    /// What governs there.
    pub governed_by: Governs,
    /// Every position that was solved: by direction, from left to right.
    pub curve: Vec<PositionPoint>,
}
