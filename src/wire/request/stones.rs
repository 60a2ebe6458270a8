//! Stones beside the one that most are made of.

use super::Text;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use utoipa::ToSchema;

/// A stone with a name, for voussoirs of an arch, blocks, rings, piers, abutments and backing to be made of. What is left out
/// is as in `stone`.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct NamedStone {
    /// Its name, up to 200 characters.
    pub name: Text,
    /// Density, kg/m3.
    #[schema(exclusive_minimum = 0.0, maximum = 100_000.0)]
    pub density_kg_m3: Option<f64>,
    /// Young's modulus, Pa.
    #[schema(minimum = 1e5, exclusive_maximum = 1e13)]
    pub youngs_modulus_pa: Option<f64>,
    /// Poisson's ratio, between -1 and 0.5.
    #[schema(exclusive_minimum = -1.0, exclusive_maximum = 0.5)]
    pub poissons_ratio: Option<f64>,
    /// Friction angle of the joints, degrees; of two stones the lower counts.
    #[schema(minimum = 0.0, exclusive_maximum = 90.0)]
    pub friction_angle_deg: Option<f64>,
    /// Cohesion of the joints, Pa; of two stones the lower counts.
    #[schema(minimum = 0.0, exclusive_maximum = 1e15)]
    pub cohesion_pa: Option<f64>,
    /// Compressive strength, Pa (10 MPa is 1e7), from 1e3 to 1e30.
    #[schema(minimum = 1e3, maximum = 1e30)]
    pub compressive_strength_pa: Option<f64>,
}
