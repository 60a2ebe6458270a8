//! Partial factors on loads and resistances.

use super::{LoadEntry, LoadRequest};
use crate::wire::prose::Digits;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Partial factors of a code of practice, by which loads are multiplied and resistances divided once, before anything is analysed.
/// All forces, stresses and thrusts in the answer are those of the factored loads. Load factors and intensities are of the scaled
/// loads as they are given: at load factor 1 the structure bears `live` times them. So the load factor at an end is the
/// `adequacy_factor`. Not multiplied are masses in a `body_acceleration`, and fixed loads other than weight; not divided are
/// friction and cohesion of joints. No value is taken from a code: what is left out is 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(default)]
pub struct PartialFactors {
    /// On the weight of the stones: `self_weight` that is fixed.
    #[schema(minimum = 0.01, maximum = 100.0)]
    pub dead: f64,
    /// On the weight of fill, and on the pressures that it makes by itself: `backfill`, and `fill_pressure` that is fixed.
    #[schema(minimum = 0.01, maximum = 100.0)]
    pub fill: f64,
    /// On all loads that the load factor multiplies.
    #[schema(minimum = 0.01, maximum = 100.0)]
    pub live: f64,
    /// Divides the compressive strength of all stones.
    #[schema(minimum = 0.01, maximum = 100.0)]
    pub stone_strength: f64,
    /// Divides the most that `backfill.passive` and backing resist with, which is that of fill of its unfactored weight.
    #[schema(minimum = 0.01, maximum = 100.0)]
    pub soil_resistance: f64,
}

impl Default for PartialFactors {
    fn default() -> Self {
        PartialFactors { dead: 1.0, fill: 1.0, live: 1.0, stone_strength: 1.0, soil_resistance: 1.0 }
    }
}

impl PartialFactors {
    /// That of a load.
    pub fn of(&self, entry: &LoadEntry) -> f64 {
        match (&entry.load, entry.scaled) {
            (_, true) => self.live,
            (LoadRequest::SelfWeight(_), false) => self.dead,
            (LoadRequest::FillPressure(_), false) => self.fill,
            _ => 1.0,
        }
    }

    /// All of them, in a few words.
    pub fn words(&self) -> String {
        let [dead, fill, live] = [self.dead, self.fill, self.live].map(Digits);
        let [stone, soil] = [self.stone_strength, self.soil_resistance].map(Digits);
        format!("dead {dead}, fill {fill}, live {live}; stone strength over {stone}, soil resistance over {soil}")
    }
}
