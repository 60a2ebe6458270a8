//! The body of a request: one structure (an arch, a bridge or blocks), its stone, its loads, and what is asked; or a curved
//! beam. Lengths in m, other units in the names.

mod accuracy;
mod arch;
mod backfill;
mod beam;
mod blocks;
mod bridge;
mod factors;
mod loads;
mod mesh;
mod motion;
mod passive;
mod question;
mod stones;
mod survey_tolerance;
mod values;
mod worst_position;

use crate::collapse::{DEFAULT_PENALTY_RATIO, Direction, Geometry, PlaneModel};
use crate::structure::Stone;
pub use accuracy::*;
pub use arch::*;
pub use backfill::*;
pub use beam::*;
pub use blocks::*;
pub use bridge::*;
pub use factors::*;
pub use loads::*;
pub use mesh::*;
pub use motion::*;
pub use passive::*;
pub use question::*;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
pub use stones::*;
pub use survey_tolerance::*;
use utoipa::ToSchema;
pub use values::*;
pub use worst_position::*;

/// A body: a structure (an arch, a bridge or blocks), or a curved beam where it has `curved_beam`.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
#[serde(untagged)]
pub enum Request {
    /// A structure.
    Structure(Box<AnalysisRequest>),
    /// The curved beam of section 3.3 of the paper.
    CurvedBeam(Box<BeamRequest>),
}

impl Request {
    /// What the request calls itself.
    pub fn name(&self) -> Option<&str> {
        match self {
            Request::Structure(request) => request.name.as_deref(),
            Request::CurvedBeam(request) => request.name.as_deref(),
        }
    }
}

/// One question: when does this structure fall, or how safe is it? It has exactly one of `arch`, `bridge` and `blocks`.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct AnalysisRequest {
    /// A name to find it again, up to 200 characters.
    pub name: Option<Text>,
    /// An arch.
    pub arch: Option<ArchRequest>,
    /// A bridge of arch spans, each of one ring or more, on piers and abutments.
    pub bridge: Option<BridgeRequest>,
    /// Blocks given by their corners, such as a wall.
    pub blocks: Option<BlocksRequest>,
    /// Width of the structure, across the plane of the drawing, m. With it the answer gives results over the whole width beside
    /// those per metre of width. Left out: per metre of width only.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub width_m: Option<f64>,
    /// The stone.
    #[serde(default)]
    pub stone: StoneRequest,
    /// Other stones, which parts of an arch, of a bridge and blocks name.
    #[serde(default)]
    #[schema(max_items = 100)]
    pub stones: Vec<NamedStone>,
    /// Fill over an arch or a bridge: a fixed load, and what loads on its surface are dispersed by. Left out: none.
    pub backfill: Option<BackfillRequest>,
    /// Joints that differ from the rest.
    #[serde(default)]
    #[schema(max_items = 8000)]
    pub joint_overrides: Vec<JointOverride>,
    /// How the bodies are cut into subblocks.
    #[serde(default)]
    pub mesh: MeshRequest,
    /// How accurate the answer has to be.
    pub accuracy: Option<AccuracyRequest>,
    /// Loads, fixed and scaled by the load factor. Without a scaled one, only whether the structure stands is asked.
    #[schema(min_items = 1, max_items = 1000)]
    pub loads: Vec<LoadEntry>,
    /// Partial factors on loads and resistances. Left out: none, and the answer has no adequacy factor. Not with fixed steps, nor with
    /// a load factor that decreases.
    pub partial_factors: Option<PartialFactors>,
    /// What is asked.
    #[serde(default)]
    pub analysis: AimRequest,
    /// How the load factor grows, and what it means to an engineer.
    #[serde(default)]
    pub load_factor: LoadFactorRequest,
    /// How the load path is followed.
    #[serde(default)]
    pub method: MethodRequest,
    /// On which geometry equilibrium is written. `first_order`, also where it is left out: on the structure as built. `updated`:
    /// on the structure as its loads move it, too; that answer stands in `updated_geometry` and needs method `event_path`.
    #[serde(default)]
    pub geometry: Geometry,
    /// True: joints crush on the load path. No contact is pressed harder than the compressive strength of the weaker stone, so
    /// that collapse, hinges and thrust line are those of a structure whose joints crush. For a collapse at first order by method
    /// `event_path` with one subblock a stone, without `accuracy` and `motion`. False: crushing is told beside the path of stone
    /// that does not crush.
    #[schema(required = false, default = false)]
    pub crushing_in_path: bool,
    /// What the answer shows.
    #[serde(default)]
    pub report: ReportRequest,
    /// Motion after collapse.
    pub motion: Option<MotionRequest>,
}

impl AnalysisRequest {
    /// The partial factors; all 1 where there are none.
    pub fn factors(&self) -> PartialFactors {
        self.partial_factors.unwrap_or_default()
    }

    /// True where fill weighs on the structure.
    pub fn is_filled(&self) -> bool {
        let fills = |entry: &LoadEntry| matches!(entry.load, LoadRequest::FillPressure(_));
        self.backfill.is_some() || self.loads.iter().any(fills)
    }

    /// True where only the left half of an arch is asked about.
    pub fn half(&self) -> bool {
        self.arch.as_ref().is_some_and(|arch| arch.half)
    }
}

/// The stone and its joints; what is left out is Table 1 of the paper.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(default)]
pub struct StoneRequest {
    /// Density, kg/m3.
    #[schema(exclusive_minimum = 0.0, maximum = 100_000.0)]
    pub density_kg_m3: f64,
    /// Young's modulus, Pa.
    #[schema(minimum = 1e5, exclusive_maximum = 1e13)]
    pub youngs_modulus_pa: f64,
    /// Poisson's ratio, between -1 and 0.5.
    #[schema(exclusive_minimum = -1.0, exclusive_maximum = 0.5)]
    pub poissons_ratio: f64,
    /// Friction angle of the joints, degrees.
    #[schema(minimum = 0.0, exclusive_maximum = 90.0)]
    pub friction_angle_deg: f64,
    /// Cohesion of the joints, Pa.
    #[schema(minimum = 0.0, exclusive_maximum = 1e15)]
    pub cohesion_pa: f64,
    /// Compressive strength, Pa (10 MPa is 1e7), from 1e3 to 1e30.
    #[schema(minimum = 1e3, maximum = 1e30)]
    pub compressive_strength_pa: f64,
    /// `stress`: plane stress, that is no stress across the arch. `strain`: plane strain, that is no strain across the arch.
    pub plane: PlaneModel,
    /// Contact penalty: stiffness of contacts as a multiple of Young's modulus. Left out: 10, and 1 for a bridge and for blocks,
    /// whose joints slide: where they are stiffer than the stones, a load path may end higher, or jam in rings that slide on
    /// each other.
    #[schema(minimum = 0.01, maximum = 100.0)]
    pub penalty_ratio: Option<f64>,
    /// Tangential contact penalty as a multiple of the normal one.
    #[schema(minimum = 0.01, maximum = 100.0)]
    pub shear_penalty_ratio: f64,
}

/// Contact penalty over Young's modulus of bridges and blocks (measured on the walls of Ferris and Tin-Loi: with 1 and less the
/// paths end within half a per cent of the published loads, with 10 up to 1.6 % above).
const BLOCKS_PENALTY_RATIO: f64 = 1.0;

impl StoneRequest {
    /// Contact penalty as a multiple of Young's modulus, of an arch or of another structure.
    pub fn penalty_ratio_of(&self, arch: bool) -> f64 {
        self.penalty_ratio.unwrap_or(if arch { DEFAULT_PENALTY_RATIO } else { BLOCKS_PENALTY_RATIO })
    }

    /// The same with what is left out.
    pub fn filled_in(self, arch: bool) -> Self {
        StoneRequest { penalty_ratio: Some(self.penalty_ratio_of(arch)), ..self }
    }
}

impl Default for StoneRequest {
    fn default() -> Self {
        let stone = Stone::default();
        StoneRequest {
            density_kg_m3: stone.density,
            youngs_modulus_pa: stone.youngs_modulus,
            poissons_ratio: stone.poissons_ratio,
            // Degrees as people write them: 30, not 29.999999999999996.
            friction_angle_deg: (stone.friction_angle.to_degrees() * 1e9).round() / 1e9,
            cohesion_pa: stone.cohesion,
            compressive_strength_pa: stone.compressive_strength,
            plane: PlaneModel::Stress,
            penalty_ratio: None,
            shear_penalty_ratio: 1.0,
        }
    }
}

/// A joint with a law of its own, or of which mortar is lost; what is left out is that of the stone.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct JointOverride {
    /// Which joint, from 0; of an arch from the left springing, else as `structure.joints` of the answer has them.
    #[schema(maximum = 8000)]
    pub joint: usize,
    /// Friction angle, degrees.
    #[schema(minimum = 0.0, exclusive_maximum = 90.0)]
    pub friction_angle_deg: Option<f64>,
    /// Cohesion, Pa.
    #[schema(minimum = 0.0, exclusive_maximum = 1e15)]
    pub cohesion_pa: Option<f64>,
    /// Depth from the intrados (of a bridge or blocks from the first end of the joint) over which it is open, its mortar lost, m. It
    /// carries nothing there, and its cohesion acts on what is left. With `lost_at_extrados_m` at most 0.999 of the joint.
    #[schema(minimum = 0.0, maximum = 1e5)]
    pub lost_at_intrados_m: Option<f64>,
    /// The same from the extrados, or from the second end of the joint, m.
    #[schema(minimum = 0.0, maximum = 1e5)]
    pub lost_at_extrados_m: Option<f64>,
}

/// How the load factor grows, and what it means to an engineer: intensity = load factor * `intensity_per_unit`.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(default)]
pub struct LoadFactorRequest {
    /// Which way the load factor goes from 0, upwards or downwards.
    pub direction: Direction,
    /// Largest absolute load factor to try. Left out: that at which the scaled loads come to 1e6 times the fixed ones.
    #[schema(exclusive_minimum = 0.0, maximum = 1e12)]
    pub cap: Option<f64>,
    /// Unit of the intensity, such as `kN/m` or `m`: a label, nothing is converted.
    pub unit: Text,
    /// Intensity at load factor 1. Required beside `unit`.
    #[schema(exclusive_minimum = 0.0, maximum = 1e12)]
    pub intensity_per_unit: f64,
}

impl Default for LoadFactorRequest {
    fn default() -> Self {
        LoadFactorRequest {
            direction: Direction::Increase,
            cap: None,
            unit: Text("-".to_owned()),
            intensity_per_unit: 1.0,
        }
    }
}

/// How the load path is followed.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum MethodRequest {
    /// Exactly, from one change of contact to the next.
    #[default]
    EventPath,
    /// In equal steps with the hinge criterion of section 4.2 of the paper, for comparison.
    FixedSteps(FixedSteps),
}

/// In equal steps with the hinge criterion of section 4.2 of the paper, for comparison.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct FixedSteps {
    /// Step of the load factor, a pure number.
    #[schema(exclusive_minimum = 0.0, maximum = 1e12)]
    pub step: f64,
    /// Opening beyond which a joint counts as a hinge, m.
    #[schema(required = false, default = 0.01, exclusive_minimum = 0.0, maximum = 1e5)]
    pub opening_m: f64,
    /// How many hinges make a collapse; at most the number of joints.
    #[schema(required = false, default = 3, minimum = 1, maximum = 2002)]
    pub hinges: usize,
}
