//! Axle groups of standards: each value as it was read, with where.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Weight of a tonne, N.
const TONNE: f64 = 9810.0;

/// Axle groups of CS 454 Revision 0 (Assessment of highway bridges and structures), in tonnes of 9.81 kN: tables 7.3.1a (normal
/// traffic) and 7.3.1b (axle lift-off). Of a row for a range of spacings, the closest one. The triple bogies of the table, of 7 t
/// and 8 t an axle, are not among them: it leaves open between which axles their spacing is measured, and gives none for 7 t.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub enum AxleGroup {
    /// One axle of 11.5 t.
    #[serde(rename = "cs454_single")]
    Single,
    /// Two axles of 8 t, 1.00 m apart (the row from 1.00 m to less than 1.30 m).
    #[serde(rename = "cs454_bogie_8t")]
    Bogie8,
    /// Two axles of 9.5 t, 1.30 m apart (the row from 1.30 m to less than 1.80 m).
    #[serde(rename = "cs454_bogie_9_5t")]
    Bogie9,
    /// Two axles of 10 t, 1.80 m apart (the row from 1.80 m).
    #[serde(rename = "cs454_bogie_10t")]
    Bogie10,
    /// `cs454_bogie_8t` with axle lift-off: 1.5 times the force on the first axle, 0.5 times on the other.
    #[serde(rename = "cs454_bogie_8t_lift_off")]
    LiftOff8,
    /// `cs454_bogie_9_5t` with axle lift-off: 1.5 times the force on the first axle, 0.5 times on the other.
    #[serde(rename = "cs454_bogie_9_5t_lift_off")]
    LiftOff9,
    /// `cs454_bogie_10t` with axle lift-off: 1.5 times the force on the first axle, 0.5 times on the other.
    #[serde(rename = "cs454_bogie_10t_lift_off")]
    LiftOff10,
}

impl AxleGroup {
    /// Offset, m, and force, N, of every axle.
    pub fn axles(self) -> Vec<[f64; 2]> {
        let bogie = |tonnes: f64, spacing: f64, factors: [f64; 2]| {
            [0.0, spacing].into_iter().zip(factors).map(|(offset, factor)| [offset, factor * tonnes * TONNE]).collect()
        };
        const BOTH: [f64; 2] = [1.0, 1.0];
        const LIFTED: [f64; 2] = [1.5, 0.5];
        match self {
            AxleGroup::Single => vec![[0.0, 11.5 * TONNE]],
            AxleGroup::Bogie8 => bogie(8.0, 1.0, BOTH),
            AxleGroup::Bogie9 => bogie(9.5, 1.3, BOTH),
            AxleGroup::Bogie10 => bogie(10.0, 1.8, BOTH),
            AxleGroup::LiftOff8 => bogie(8.0, 1.0, LIFTED),
            AxleGroup::LiftOff9 => bogie(9.5, 1.3, LIFTED),
            AxleGroup::LiftOff10 => bogie(10.0, 1.8, LIFTED),
        }
    }
}
