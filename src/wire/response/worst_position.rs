//! The worst position of vehicles.

use super::Scale;
use crate::collapse::{Governs, PositionPoint, PositionReport};
use serde::Serialize;
use utoipa::ToSchema;

/// The position of the vehicles at which limit analysis finds the least load factor. All else in the answer is of that position.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct WorstPositionBody {
    /// Abscissa of the vehicles' reference, m; where no position has an end, one at which most of their force arrives.
    pub x_m: f64,
    /// Whether they stand as a vehicle with `reversed` does.
    pub reversed: bool,
    /// The least intensity; null where none has an end, or nothing is in equilibrium. Joints that slide dilate in it (associated
    /// friction): where the load path slides, `ends` may have a lower one.
    pub intensity: Option<f64>,
    /// `intensity` as a load factor.
    pub load_factor: Option<f64>,
    /// What governs it.
    pub governed_by: Governs,
    /// Every position that was solved, by direction, from left to right.
    pub curve: PositionColumns,
}

/// Positions, a row each.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct PositionColumns {
    /// Abscissa of the vehicles' reference, m.
    pub x_m: Vec<f64>,
    /// Whether they stand as a vehicle with `reversed` does.
    pub reversed: Vec<bool>,
    /// Share of their force that comes down on the structure.
    pub arriving: Vec<f64>,
    /// Intensity at which stone that does not crush falls; null where it never does, where nothing is in equilibrium, and where limit
    /// analysis gave no answer, of which a note tells.
    pub instability: Vec<Option<f64>>,
    /// Intensity at which joints of the stone's strength (plastic sections) give way; null likewise.
    pub crushing: Vec<Option<f64>>,
}

impl WorstPositionBody {
    pub(super) fn new(report: &PositionReport, scale: &Scale) -> Self {
        let PositionReport { worst, governed_by, curve } = report;
        let finite = |load_factor: Option<f64>| load_factor.filter(|load_factor| !load_factor.is_infinite());
        let load_factor = finite(worst.load_factor());
        let intensity = |of: fn(&PositionPoint) -> Option<f64>| {
            curve.iter().map(|point| finite(of(point)).map(|load_factor| scale.intensity(load_factor))).collect()
        };
        WorstPositionBody {
            x_m: worst.x,
            reversed: worst.reversed,
            intensity: load_factor.map(|load_factor| scale.intensity(load_factor)),
            load_factor,
            governed_by: *governed_by,
            curve: PositionColumns {
                x_m: curve.iter().map(|point| point.x).collect(),
                reversed: curve.iter().map(|point| point.reversed).collect(),
                arriving: curve.iter().map(|point| point.arriving).collect(),
                instability: intensity(|point| point.instability),
                crushing: intensity(|point| point.crushing),
            },
        }
    }
}
