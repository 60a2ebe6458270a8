//! A load on a strip, and how fill disperses it.

use super::kn_per_m;
use crate::structure::load::{Dispersal, Distribution, Patch};
use crate::wire::prose::Digits;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// A vertical force spread evenly over a plan width. Without `dispersal` it stands on the extrados itself: every voussoir takes the
/// share that lies over it, in the middle of that share on its extrados side.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PatchLoad {
    /// Abscissa of the middle, m.
    #[schema(minimum = -1e5, maximum = 1e5)]
    pub centre_x_m: f64,
    /// Plan width, m; with `dispersal` that at the surface, such as a tyre's contact length.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub width_m: f64,
    /// Total force per metre of width, N/m, downwards positive; not 0.
    #[schema(minimum = -1e15, maximum = 1e15)]
    pub force_n_per_m: f64,
    /// How fill spreads it between its surface and the extrados. Left out: the load stands on the extrados.
    pub dispersal: Option<DispersalRequest>,
}

/// Dispersal of a load through fill, along the span. The strip at the surface gives a vertical stress on everything below that looks
/// up and that it sees: nothing under an overhang, of surfaces over each other the topmost only, nothing behind another part of
/// the structure. That stress presses down on the plan width of the surface. The extrados is continued by level lines
/// beyond both ends; one factor makes the whole force arrive on both together, and what lands on the lines goes to the
/// ground and not to the structure. So the load may stand partly or wholly beyond the ends. Forces keep their
/// place in plan. Fill itself, its weight and pressure, is a `fill_pressure`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct DispersalRequest {
    /// Height of the surface above y = 0 where the load stands, m; not below the extrados under the load.
    #[schema(minimum = -1e5, maximum = 1e5)]
    pub surface_height_m: f64,
    /// How the stress spreads.
    pub distribution: DistributionRequest,
}

/// How the stress below a strip spreads.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum DistributionRequest {
    /// The stress of Boussinesq, cut off at an angle.
    Boussinesq(Boussinesq),
    /// The same stress everywhere at one depth.
    Uniform(Uniform),
}

/// Vertical stress in an elastic half space under a strip, after Boussinesq, and none beyond planes that start at the edges of the
/// strip: at the depth z, with angles b1 and b2 from the vertical to the left and the right edge,
/// `P / (pi B) (b1 - b2 + sin b1 cos b1 - sin b2 cos b2)`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Boussinesq {
    /// Angle of the planes to the vertical, degrees.
    #[schema(required = false, default = 30.0, minimum = 0.0, maximum = 89.0)]
    pub cut_off_deg: f64,
}

/// The same stress over the strip's width and what it spreads to either side: at the depth z `P / (B + 2 spread z)`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Uniform {
    /// How far it spreads to either side, horizontal over vertical: 0.5 is 1 to 2.
    #[schema(required = false, default = 0.5, minimum = 0.0, maximum = 50.0)]
    pub spread: f64,
}

impl PatchLoad {
    pub(super) fn in_si(&self) -> Patch {
        Patch {
            force: self.force_n_per_m,
            centre: self.centre_x_m,
            width: self.width_m,
            dispersal: self.dispersal.as_ref().map(DispersalRequest::in_si),
        }
    }

    pub(super) fn words(&self) -> String {
        let [width, centre] = [self.width_m, self.centre_x_m].map(Digits);
        let force = kn_per_m(self.force_n_per_m);
        let down = self.dispersal.as_ref().map_or(String::new(), DispersalRequest::words);
        format!("{force}, spread over {width} m about x = {centre} m{down}")
    }
}

impl DispersalRequest {
    pub(super) fn in_si(&self) -> Dispersal {
        let distribution = match self.distribution {
            DistributionRequest::Boussinesq(Boussinesq { cut_off_deg }) => {
                Distribution::Boussinesq { cut_off: cut_off_deg.to_radians() }
            }
            DistributionRequest::Uniform(Uniform { spread }) => Distribution::Uniform { spread },
        };
        Dispersal { surface: self.surface_height_m, distribution }
    }

    /// With all that is assumed of it.
    pub(super) fn words(&self) -> String {
        let how = match self.distribution {
            DistributionRequest::Boussinesq(Boussinesq { cut_off_deg }) => {
                format!("as Boussinesq has it up to {} deg from the vertical", Digits(cut_off_deg))
            }
            DistributionRequest::Uniform(Uniform { spread }) => {
                format!("uniformly, {} m to either side for each metre of depth", Digits(spread))
            }
        };
        format!(" on the surface at y = {} m, dispersed by the fill {how}", Digits(self.surface_height_m))
    }
}
