//! Passive resistance of backfill.

use crate::structure::load::Passive;
use crate::wire::prose::Digits;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Passive resistance of fill, which the analysis finds by itself: on every side of the extrados that faces fill it presses
/// horizontally, towards the structure, between `least` and `(factor Kp q_v + cohesion_factor 2 c sqrt Kp)` times the side's height,
/// as hard as it can where the stone moves into it and as little as it may where the stone moves away; `Kp = (1 + sin phi) /
/// (1 - sin phi)` after Rankine, and q_v the vertical pressure of the fill's own weight in the middle of the side, where the force
/// acts. Loads on the surface add nothing to it. Fill behind it stands still. There is none on a level side, as at the crown; none
/// towards another span, nor in a dip of the extrados and on what rises behind it, where the fill would move along; and none where the
/// surface falls below the side within the wedge that would resist, `sqrt Kp` times the depth wide.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(default)]
pub struct PassiveRequest {
    /// Friction angle phi of the fill, degrees.
    #[schema(minimum = 0.0, maximum = 60.0)]
    pub friction_angle_deg: f64,
    /// Cohesion c of the fill, Pa.
    #[schema(minimum = 0.0, maximum = 1e9)]
    pub cohesion_pa: f64,
    /// Share of Kp that is mobilised, a pure number.
    #[schema(minimum = 0.0, maximum = 1.0)]
    pub factor: f64,
    /// Share of what cohesion adds that is mobilised, a pure number.
    #[schema(minimum = 0.0, maximum = 1.0)]
    pub cohesion_factor: f64,
    /// What it presses with in any case.
    pub least: LeastPressure,
    /// Movement of a stone into the fill at which all of this is mobilised, over the depth of the side below the surface. Where no
    /// joint slides the collapse load at first order does not depend on it; displacements and the load on updated geometry do.
    #[schema(minimum = 1e-4, maximum = 1.0)]
    pub mobilisation_share_of_depth: f64,
}

/// Least pressure of fill on stones that move away from it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum LeastPressure {
    /// None.
    #[default]
    None,
    /// Rankine's active pressure, the vertical one over Kp; cohesion does not lower it.
    Active,
}

impl Default for PassiveRequest {
    /// Half the resistance of fill of 30 degrees, mobilised at 3 % of the depth.
    fn default() -> Self {
        PassiveRequest {
            friction_angle_deg: 30.0,
            cohesion_pa: 0.0,
            factor: 0.5,
            cohesion_factor: 0.0,
            least: LeastPressure::None,
            mobilisation_share_of_depth: 0.03,
        }
    }
}

impl PassiveRequest {
    /// Rankine's coefficient Kp.
    fn coefficient(&self) -> f64 {
        let sine = self.friction_angle_deg.to_radians().sin();
        (1.0 + sine) / (1.0 - sine)
    }

    /// In SI, with backing that resists with so much, Pa.
    pub(super) fn in_si(&self, backing: Option<f64>) -> Passive {
        let coefficient = self.coefficient();
        Passive {
            most: self.factor * coefficient,
            cohesion: self.cohesion_factor * 2.0 * self.cohesion_pa * coefficient.sqrt(),
            least: if self.least == LeastPressure::Active { 1.0 / coefficient } else { 0.0 },
            backing,
            wedge: coefficient.sqrt(),
            mobilised_at: self.mobilisation_share_of_depth,
        }
    }

    /// Whether what it presses with in any case is no more than it can resist with.
    pub(super) fn is_range(&self) -> bool {
        let Passive { most, least, .. } = self.in_si(None);
        least <= most
    }

    /// With all that is assumed of it.
    pub(super) fn words(&self) -> String {
        let Passive { most, cohesion, least, .. } = self.in_si(None);
        let [most, angle, factor, kp] = [most, self.friction_angle_deg, self.factor, self.coefficient()].map(Digits);
        let added = match cohesion {
            0.0 => "no cohesion".to_owned(),
            pressure => format!(
                "and {} kPa of cohesion ({} of that of {} kPa)",
                Digits(pressure / 1e3),
                Digits(self.cohesion_factor),
                Digits(self.cohesion_pa / 1e3)
            ),
        };
        let always = match least {
            0.0 => "no pressure on stones that move away from it".to_owned(),
            ratio => format!("{} of it (active) on stones that move away", Digits(ratio)),
        };
        format!(
            "it resists stones that move into it with at most {most} of the vertical pressure ({factor} of Kp = {kp} of {angle} \
             deg), {added}; {always}"
        )
    }
}
