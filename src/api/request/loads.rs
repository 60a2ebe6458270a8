//! The loads in a request. Forces per metre of depth.

use super::{ForceVector, Point, Text};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// A load, and whether the load factor multiplies it. Forces are per metre of depth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct LoadEntry {
    /// What acts.
    pub load: LoadRequest,
    /// False: it is fixed. True: the load factor multiplies it.
    #[schema(required = false, default = false)]
    pub scaled: bool,
    /// A factor of its own; not 0.
    #[schema(required = false, default = 1.0, minimum = -1e12, maximum = 1e12)]
    pub coefficient: f64,
    /// True: the coefficient is multiplied by the abscissa of the safety curve that `analysis` asks for.
    #[schema(required = false, default = false)]
    pub per_abscissa: bool,
}

/// A load.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum LoadRequest {
    /// Weight of the stones.
    SelfWeight(SelfWeight),
    /// Fill and embankment on the extrados.
    FillPressure(FillPressure),
    /// Horizontal pressure in bands of height.
    LateralPressure(LateralPressure),
    /// A vertical force at one point of the extrados.
    PointLoad(PointLoad),
    /// A force in any direction at a point of a block; of a bridge or blocks.
    PointForce(PointForceLoad),
    /// A vertical force spread over a plan width.
    PatchLoad(PatchLoad),
    /// An inertia force on stones and fill: their mass times an acceleration.
    BodyAcceleration(BodyAcceleration),
}

/// Weight of the stones from their density, with g = 9.81 m/s2. Without this load they weigh nothing. It has no fields.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SelfWeight {}

/// Fill and embankment on the extrados. They press, eq. (7) of the paper: `q_v = (H - y) g rho_f + h_e g rho_e` on the plan
/// projection of the extrados and `q_h = K q_v` on its vertical projection. In a `body_acceleration` they push with their mass as
/// well: the column over every part of the extrados that looks up, fill and embankment each at half its own height, carried by
/// the stone below; what lies beside the arch does not push. Scaled fill in a scaled acceleration is refused.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(default)]
pub struct FillPressure {
    /// Height H of the top of the fill above y = 0, m. Left out: an embankment only.
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
    pub fn at_rest(&self) -> Option<f64> {
        self.fill_friction_angle_deg.map(|angle| 1.0 - angle.to_radians().sin())
    }

    /// Ratio of horizontal to vertical pressure.
    pub fn ratio(&self) -> f64 {
        self.lateral_ratio.or(self.at_rest()).unwrap_or(0.0)
    }
}

/// Horizontal pressure in bands of height, towards the arch, on the vertical projection of the extrados.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct LateralPressure {
    /// Bands of height; where bands overlap they add up.
    #[schema(min_items = 1, max_items = 1000)]
    pub bands: Vec<PressureBand>,
}

/// A horizontal pressure between two heights.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PressureBand {
    /// Lower end, m.
    #[schema(minimum = -1e5, maximum = 1e5)]
    pub from_m: f64,
    /// Upper end, m; above the lower one.
    #[schema(minimum = -1e5, maximum = 1e5)]
    pub to_m: f64,
    /// Pressure, Pa, towards the arch positive.
    #[schema(minimum = -1e15, maximum = 1e15)]
    pub pressure_pa: f64,
}

/// A vertical force at one point of the extrados: at an abscissa, or in the middle of a voussoir.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PointLoad {
    /// Force per metre of depth, N/m, downwards positive; not 0.
    #[schema(minimum = -1e15, maximum = 1e15)]
    pub force_n_per_m: f64,
    /// Abscissa, m; over a joint, its two voussoirs take half each. Either this or `voussoir` is given.
    #[schema(minimum = -1e5, maximum = 1e5)]
    pub x_m: Option<f64>,
    /// Number of a voussoir, from 0 on the left: the middle of its extrados side.
    #[schema(maximum = 2000)]
    pub voussoir: Option<usize>,
}

/// A force in any direction at a point of a block; of a bridge or blocks, which take no load that stands on an extrados.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PointForceLoad {
    /// The block's name: that of `blocks.polygons`, or of a body of the bridge as `structure.bodies` of an answer lists them.
    pub block: Text,
    /// Where it acts, [x, y], m; inside the block or on its sides.
    pub at_m: Point,
    /// Force per metre of depth to the right and upwards, N/m; not both 0.
    pub force_n_per_m: ForceVector,
}

/// A vertical force spread evenly over a plan width: every voussoir takes the share that lies over it, in the
/// middle of that share on its extrados side.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PatchLoad {
    /// Abscissa of the middle, m.
    #[schema(minimum = -1e5, maximum = 1e5)]
    pub centre_x_m: f64,
    /// Plan width, m.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub width_m: f64,
    /// Total force per metre of depth, N/m, downwards positive; not 0.
    #[schema(minimum = -1e15, maximum = 1e15)]
    pub force_n_per_m: f64,
}

/// An inertia force on stones and fill: their mass times an acceleration, in its direction. Ground that accelerates to the right
/// makes it act to the left.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct BodyAcceleration {
    /// The force to the right, as a multiple of the weight: acceleration over g.
    #[schema(required = false, default = 0.0, minimum = -1e12, maximum = 1e12)]
    pub x_g: f64,
    /// The force upwards, as a multiple of the weight: acceleration over g.
    #[schema(required = false, default = 0.0, minimum = -1e12, maximum = 1e12)]
    pub y_g: f64,
}
