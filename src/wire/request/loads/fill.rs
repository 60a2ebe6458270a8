//! Fill and embankment.

use crate::structure::load::{Fill, Layer, SurfaceLine};
use crate::wire::fault::{Faults, Shown};
use crate::wire::prose::Digits;
use crate::wire::request::BackfillRequest;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use utoipa::ToSchema;

/// A `lateral_ratio` this close to that of the friction angle given with it is the same.
const SAME_RATIO: f64 = 1e-3;

/// Fill and embankment on the extrados and on top of backing, pressing down (up where the extrados overhangs) and, if asked, sideways on the flanks of the arch;
/// never on the plumb backs of abutments and backing. A road that is not level, layers and dispersal belong in `backfill`. Beside
/// one there is an embankment only, which stands on it. They press, eq. (7) of the paper: `q_v = (H - y) g rho_f + h_e g rho_e` on
/// the plan projection of the extrados and `q_h = K q_v` on its vertical projection. In a `body_acceleration` they push with their
/// mass as well: the column over every part of the extrados that looks up, fill and embankment each at half its own height, carried
/// by the stone below; what lies beside the arch does not push. Scaled fill in a scaled acceleration is refused.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(default)]
pub struct FillPressure {
    /// Height H of the top of the fill above y = 0, m. Left out: an embankment only. Not beside a `backfill`.
    #[schema(minimum = -1e5, maximum = 1e5)]
    pub fill_height_m: Option<f64>,
    /// Density of the fill, kg/m3.
    #[schema(minimum = 0.0, exclusive_maximum = 1e5)]
    pub fill_density_kg_m3: f64,
    /// Thickness of the embankment on top of the fill, m.
    #[schema(minimum = 0.0, exclusive_maximum = 1e5)]
    pub embankment_thickness_m: f64,
    /// Density of the embankment, kg/m3.
    #[schema(minimum = 0.0, exclusive_maximum = 1e5)]
    pub embankment_density_kg_m3: f64,
    /// Ratio K of horizontal to vertical pressure, a pure number. Left out: that of `fill_friction_angle_deg` or, without one
    /// either, 0, no horizontal pressure. Given both, they have to agree to 0.001.
    #[schema(minimum = 0.0, exclusive_maximum = 1e12)]
    pub lateral_ratio: Option<f64>,
    /// Friction angle phi of fill that presses at rest, degrees: K = 1 - sin phi.
    #[schema(minimum = 0.0, exclusive_maximum = 90.0)]
    pub fill_friction_angle_deg: Option<f64>,
}

impl Default for FillPressure {
    /// Gravel as in Table 1 of the paper, without horizontal pressure.
    fn default() -> Self {
        FillPressure {
            fill_height_m: None,
            fill_density_kg_m3: 1600.0,
            embankment_thickness_m: 0.0,
            embankment_density_kg_m3: 1600.0,
            lateral_ratio: None,
            fill_friction_angle_deg: None,
        }
    }
}

impl FillPressure {
    /// Ratio of horizontal to vertical pressure at rest, of fill whose friction angle is given.
    fn at_rest(&self) -> Option<f64> {
        self.fill_friction_angle_deg.map(|angle| 1.0 - angle.to_radians().sin())
    }

    /// Ratio of horizontal to vertical pressure.
    pub fn ratio(&self) -> f64 {
        self.lateral_ratio.or(self.at_rest()).unwrap_or(0.0)
    }

    /// Fill in SI, over a backfill where there is one.
    pub fn in_si(&self, backfill: Option<&BackfillRequest>) -> Fill {
        let line = self.fill_height_m.map(SurfaceLine::level).or_else(|| backfill?.surface());
        let (top, density) = (self.embankment_thickness_m, self.embankment_density_kg_m3);
        let mut layers = vec![Layer { bottom: 0.0, top, density }];
        if self.fill_height_m.is_some() {
            layers.push(Layer { bottom: f64::NEG_INFINITY, top: 0.0, density: self.fill_density_kg_m3 });
        }
        Fill { line, layers, backing: None, lateral_ratio: self.ratio() }
    }

    pub(super) fn check(&self, here: &str, backfill: Option<&BackfillRequest>, faults: &mut Faults) {
        let twice = "there is a `backfill`, which is fill already: leave this out for an embankment on it, or leave out backfill";
        let once = backfill.is_none() || self.fill_height_m.is_none();
        faults.require(once, format!("{here}/fill_height_m"), twice);
        let some = self.fill_height_m.is_some() || self.embankment_thickness_m > 0.0;
        faults.require(some, here, "neither fill nor embankment: give fill_height_m, embankment_thickness_m or both");
        let (Some(ratio), Some(at_rest)) = (self.lateral_ratio, self.at_rest()) else { return };
        let detail = format!(
            "{} is not the ratio at rest of fill_friction_angle_deg, 1 - sin of it, {}: leave out one of the two",
            Shown(ratio),
            Digits(at_rest)
        );
        faults.require((ratio - at_rest).abs() <= SAME_RATIO, format!("{here}/lateral_ratio"), detail);
    }

    /// Fill with all that is assumed of it, over a backfill where there is one.
    pub(super) fn words(&self, backfill: Option<&BackfillRequest>) -> String {
        let density = |density: f64| format!("{} kg/m3", Digits(density));
        let level = self
            .fill_height_m
            .map(|height| format!("fill of {} up to y = {} m", density(self.fill_density_kg_m3), Digits(height)));
        let above = (self.embankment_thickness_m > 0.0).then(|| {
            let bare = match (&level, backfill) {
                (Some(_), _) => "",
                (None, Some(_)) => " on the backfill",
                (None, None) => " on the extrados",
            };
            let (thickness, density) = (Digits(self.embankment_thickness_m), density(self.embankment_density_kg_m3));
            format!("{thickness} m of embankment of {density}{bare}")
        });
        let what = level.into_iter().chain(above).collect::<Vec<_>>().join(" and ");
        let ratio = Digits(self.ratio());
        let horizontal = match self.fill_friction_angle_deg {
            _ if self.ratio() == 0.0 => "no horizontal pressure".to_owned(),
            Some(angle) => {
                format!("horizontal pressure {ratio} of the vertical (at rest, 1 - sin {} deg)", Digits(angle))
            }
            None => format!("horizontal pressure {ratio} of the vertical (as given)"),
        };
        format!("{what}; {horizontal}")
    }
}
