//! The curved beam in a request: a test of the stress inside stones against the theory of elasticity.

use super::{MeshRequest, StoneRequest, Subblocks, SubblocksRequest, Text};
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use utoipa::ToSchema;

/// A quarter ring in bending by end shear, cut into subblocks (section 3.3 of the paper).
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct BeamRequest {
    /// A name to find it again, up to 200 characters.
    pub name: Option<Text>,
    /// The beam.
    pub curved_beam: CurvedBeamRequest,
    /// Its stone, of which Young's modulus, Poisson's ratio and `plane` count.
    #[serde(default)]
    pub stone: StoneRequest,
    /// Its subblocks, `uniform` only. Left out: 7 x 7.
    #[serde(default = "BeamRequest::default_mesh")]
    pub mesh: MeshRequest,
    /// How accurate the stress has to be, instead of a mesh.
    pub accuracy: Option<BeamAccuracy>,
}

impl BeamRequest {
    /// 7 x 7 subblocks.
    pub fn default_mesh() -> MeshRequest {
        let subblocks = SubblocksRequest::Uniform(Subblocks { radial: 7, along: 7 });
        MeshRequest { subblocks, ..MeshRequest::default() }
    }
}

/// The beam: its shape and its load.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct CurvedBeamRequest {
    /// Inner radius, m.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub inner_radius_m: f64,
    /// Outer radius, m; more than 1.001 times the inner one, and at most 1000 times.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub outer_radius_m: f64,
    /// Resultant of the tractions at its ends, N per metre of width; not 0.
    #[schema(minimum = -1e15, maximum = 1e15)]
    pub end_shear_n_per_m: f64,
    /// True: subblocks are true sectors. False: they have straight sides.
    #[schema(required = false, default = true)]
    pub curved_sides: bool,
}

/// How accurate the stress has to be, instead of a mesh: the least mesh that is estimated to reach it is found, and `plan` in the
/// answer says which. The exact stress has no part in that.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct BeamAccuracy {
    /// Largest error, as a share: of the equivalent stress at centroids, e_N of eq. (5) of the paper, and of the stress in all its components,
    /// point by point, which is bilinear between the corners of a subblock.
    #[schema(exclusive_minimum = 0.0, maximum = 1.0)]
    pub stress: f64,
}
