//! A load on a strip, and how fill disperses it.

use super::kn_per_m;
use crate::structure::load::{Dispersal, Distribution, Patch, SurfaceLine};
use crate::wire::fault::Faults;
use crate::wire::prose::Digits;
use crate::wire::request::BackfillRequest;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use utoipa::ToSchema;

/// A vertical force spread over a width in plan: of the extrados or, with `dispersal`, of the surface of fill. On the extrados itself
/// every voussoir takes the share that lies over it, in the middle of that share on its extrados side.
#[skip_serializing_none]
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
/// place in plan. Fill itself, its weight and pressure, is the `backfill` or a `fill_pressure`. A strip is level: of a surface
/// that is not, it stands at the height under its middle, and what of the surface is higher or lower elsewhere does not matter.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct DispersalRequest {
    /// Height of the surface above y = 0 where the load stands, m; not below the extrados under the load. Left out: that of the
    /// `backfill` under the middle of the load. Required without one.
    #[schema(minimum = -1e5, maximum = 1e5)]
    pub surface_height_m: Option<f64>,
    /// How the stress spreads. Left out: as `backfill` says. Required without one.
    pub distribution: Option<DistributionRequest>,
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
    /// In SI; none where it stands on a surface that has faults.
    pub(super) fn in_si(&self, backfill: Option<&BackfillRequest>) -> Option<Patch> {
        let dispersal = match &self.dispersal {
            Some(dispersal) => Some(dispersal.in_si(backfill)?),
            None => None,
        };
        Some(Patch { force: self.force_n_per_m, centre: self.centre_x_m, width: self.width_m, dispersal })
    }

    pub(super) fn check(&self, here: &str, backfill: Option<&BackfillRequest>, faults: &mut Faults) {
        faults.not_zero(&format!("{here}/force_n_per_m"), self.force_n_per_m);
        if let Some(dispersal) = &self.dispersal {
            dispersal.check(&format!("{here}/dispersal"), backfill, faults);
        }
    }

    pub(super) fn words(&self, backfill: Option<&BackfillRequest>) -> String {
        let [width, centre] = [self.width_m, self.centre_x_m].map(Digits);
        let force = kn_per_m(self.force_n_per_m);
        let dispersal = self.dispersal.as_ref();
        let down = dispersal.map_or(String::new(), |dispersal| dispersal.words(backfill, Some(self.centre_x_m)));
        format!("{force}, spread over {width} m about x = {centre} m{down}")
    }
}

impl DispersalRequest {
    /// In SI, by a backfill where there is one; none where that has faults or something is missing.
    pub(super) fn in_si(&self, backfill: Option<&BackfillRequest>) -> Option<Dispersal> {
        let surface = self.surface_height_m.map(SurfaceLine::level).or_else(|| backfill?.surface())?;
        let distribution = match self.distribution(backfill)? {
            DistributionRequest::Boussinesq(Boussinesq { cut_off_deg }) => {
                Distribution::Boussinesq { cut_off: cut_off_deg.to_radians() }
            }
            DistributionRequest::Uniform(Uniform { spread }) => Distribution::Uniform { spread: *spread },
        };
        Some(Dispersal { surface, distribution })
    }

    fn distribution<'a>(&'a self, backfill: Option<&'a BackfillRequest>) -> Option<&'a DistributionRequest> {
        self.distribution.as_ref().or(backfill.map(|backfill| &backfill.dispersal))
    }

    /// What is missing. `here` points to it.
    pub(super) fn check(&self, here: &str, backfill: Option<&BackfillRequest>, faults: &mut Faults) {
        let known = backfill.is_some();
        let missing = |what: &str| format!("{what} is missing: add it, or give the `backfill` that the load stands on");
        let (height, distribution) = (missing("the height of the surface"), missing("how the stress spreads"));
        faults.require(known || self.surface_height_m.is_some(), format!("{here}/surface_height_m"), height);
        faults.require(known || self.distribution.is_some(), format!("{here}/distribution"), distribution);
    }

    /// The field, from that of the load on, which says how high the surface is.
    pub(super) fn field_of_surface(&self) -> &'static str {
        if self.surface_height_m.is_some() { "dispersal/surface_height_m" } else { "dispersal" }
    }

    /// With all that is assumed of it, of a load at an abscissa where it has one.
    pub(super) fn words(&self, backfill: Option<&BackfillRequest>, x: Option<f64>) -> String {
        let surface = || Some(backfill?.surface()?.height(x?));
        let height =
            self.surface_height_m.or_else(surface).map_or(String::new(), |y| format!(" at y = {} m", Digits(y)));
        format!(" on the surface{height}, dispersed by the fill {}", self.how(backfill))
    }

    /// How the stress spreads.
    pub fn how(&self, backfill: Option<&BackfillRequest>) -> String {
        self.distribution(backfill).map_or(String::new(), DistributionRequest::words)
    }
}

impl DistributionRequest {
    fn words(&self) -> String {
        match self {
            DistributionRequest::Boussinesq(Boussinesq { cut_off_deg }) => {
                format!("as Boussinesq has it up to {} deg from the vertical", Digits(*cut_off_deg))
            }
            DistributionRequest::Uniform(Uniform { spread }) => {
                format!("uniformly, {} m to either side for each metre of depth", Digits(*spread))
            }
        }
    }
}
