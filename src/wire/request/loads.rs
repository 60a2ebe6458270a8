//! The loads in a request: their fields, what they are to the mechanics, and their words. Forces per metre of width.
//!
//! A new load has its fields and an arm of every function here, and its forces in `structure::load`.

mod axle_groups;
mod fill;
mod lateral;
mod patch;
mod point;
mod tie;
mod vehicle;

use super::{BackfillRequest, ForceVector, Point, Text};
use crate::geometry::Vec2;
use crate::structure::GRAVITY;
use crate::structure::load::{Load, LoadFault};
use crate::wire::fault::Faults;
use crate::wire::prose::Digits;
pub use fill::FillPressure;
pub use lateral::{LateralPressure, PressureBand};
pub use patch::{Boussinesq, DispersalRequest, DistributionRequest, PatchLoad, Uniform};
pub use point::PointLoad;
use serde::{Deserialize, Serialize};
pub use tie::{TieEnd, TieLoad};
use utoipa::ToSchema;
pub use vehicle::VehicleLoad;

/// A load, and whether the load factor multiplies it. Forces are per metre of width.
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
    /// Weight of the stones, given once; without it they weigh nothing.
    SelfWeight(SelfWeight),
    /// Fill and embankment on the extrados and on top of backing, pressing down (up where the extrados overhangs) and, if asked, sideways on the flanks of the arch;
    /// never on the plumb backs of abutments and backing. A road that is not level, layers and dispersal belong in `backfill`.
    FillPressure(FillPressure),
    /// Horizontal pressure in bands of height, on both flanks or one.
    LateralPressure(LateralPressure),
    /// A force at one point of the extrados, downwards or inclined.
    PointLoad(PointLoad),
    /// A vertical force spread over a width in plan: of the extrados or, with `dispersal`, of the surface of fill.
    PatchLoad(PatchLoad),
    /// Axles at fixed distances on an effective width, given one by one or as a group of CS 454; on and beyond the structure.
    Vehicle(VehicleLoad),
    /// A force in any direction at a point of a block; those of an arch are called `voussoir 3`.
    PointForce(PointForceLoad),
    /// A tie of a given force between two points of blocks.
    Tie(TieLoad),
    /// An inertia force on stones and fill: their mass times an acceleration.
    BodyAcceleration(BodyAcceleration),
}

/// Weight of the stones, given once; without it they weigh nothing. It comes from their density, with g = 9.81 m/s2, and has no fields.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SelfWeight {}

/// A force in any direction at a point of a block; those of an arch are called `voussoir 3`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PointForceLoad {
    /// The block's name: that of `blocks.polygons`, or of a body of the bridge or a voussoir of the arch as `structure.bodies` of an
    /// answer lists them, such as `voussoir 3`.
    pub block: Text,
    /// Where it acts, [x, y], m; inside the block or on its sides, which count as straight.
    pub at_m: Point,
    /// Force per metre of width to the right and upwards, N/m; not both 0.
    pub force_n_per_m: ForceVector,
}

/// An inertia force on stones and fill, as in an earthquake: their mass times an acceleration. The fields are the direction of
/// the force, not of the ground: ground that accelerates to the right makes the force act to the left.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct BodyAcceleration {
    /// The inertia force to the right, as a multiple of the weight: the ground's acceleration to the left over g.
    #[schema(required = false, default = 0.0, minimum = -1e12, maximum = 1e12)]
    pub x_g: f64,
    /// The inertia force upwards, as a multiple of the weight: the ground's acceleration downwards over g.
    #[schema(required = false, default = 0.0, minimum = -1e12, maximum = 1e12)]
    pub y_g: f64,
}

/// What a load can stand on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bearer {
    /// Every body of any structure.
    AllBodies,
    /// The extrados of an arch or a bridge.
    Extrados,
}

impl LoadRequest {
    /// What it is called in a request, and what it can stand on.
    pub fn kind(&self) -> (&'static str, Bearer) {
        match self {
            LoadRequest::SelfWeight(_) => ("self_weight", Bearer::AllBodies),
            LoadRequest::FillPressure(_) => ("fill_pressure", Bearer::Extrados),
            LoadRequest::LateralPressure(_) => ("lateral_pressure", Bearer::Extrados),
            LoadRequest::PointLoad(_) => ("point_load", Bearer::Extrados),
            LoadRequest::PatchLoad(_) => ("patch_load", Bearer::Extrados),
            LoadRequest::Vehicle(_) => ("vehicle", Bearer::Extrados),
            LoadRequest::PointForce(_) => ("point_force", Bearer::AllBodies),
            LoadRequest::Tie(_) => ("tie", Bearer::AllBodies),
            LoadRequest::BodyAcceleration(_) => ("body_acceleration", Bearer::AllBodies),
        }
    }

    /// In SI, on bodies of these names, over a backfill where there is one; of a point load with two places, the abscissa
    /// counts. None of a body that nobody knows, or on a surface that has faults.
    pub fn in_si(&self, names: &[String], backfill: Option<&BackfillRequest>) -> Option<Load> {
        Some(match self {
            LoadRequest::SelfWeight(_) => Load::SelfWeight,
            LoadRequest::FillPressure(fill) => Load::Fill(fill.in_si(backfill)),
            LoadRequest::LateralPressure(lateral) => lateral.in_si(),
            LoadRequest::PointLoad(point) => point.in_si(),
            LoadRequest::PatchLoad(patch) => Load::Patch(patch.in_si(backfill)?),
            LoadRequest::Vehicle(vehicle) => Load::Vehicle(vehicle.in_si(backfill)?),
            LoadRequest::PointForce(force) => Load::Force {
                body: names.iter().position(|name| **name == *force.block)?,
                at: force.at_m.into(),
                force: force.force_n_per_m.0.into(),
            },
            LoadRequest::Tie(tie) => tie.in_si(names)?,
            LoadRequest::BodyAcceleration(body) => Load::BodyAcceleration(body.in_si()),
        })
    }

    /// The field of a block that is none of these.
    pub fn unknown_block(&self, names: &[String]) -> Option<String> {
        let known = |block: &Text| names.iter().any(|name| **name == **block);
        match self {
            LoadRequest::PointForce(force) => (!known(&force.block)).then(|| "block".to_owned()),
            LoadRequest::Tie(tie) => {
                let unknown = tie.ends().into_iter().find(|(_, end)| !known(&end.block));
                unknown.map(|(field, _)| format!("{field}/block"))
            }
            _ => None,
        }
    }

    /// Most forces that it puts on one side of a body.
    pub fn forces_per_side(&self) -> usize {
        match self {
            LoadRequest::LateralPressure(lateral) => lateral.bands.len(),
            LoadRequest::Vehicle(vehicle) => vehicle.count(),
            LoadRequest::SelfWeight(_)
            | LoadRequest::FillPressure(_)
            | LoadRequest::PointLoad(_)
            | LoadRequest::PatchLoad(_)
            | LoadRequest::PointForce(_)
            | LoadRequest::Tie(_)
            | LoadRequest::BodyAcceleration(_) => 1,
        }
    }

    /// Its downward force, N/m, where some or all of it may come down beside the structure.
    pub fn dispersed_force(&self) -> Option<f64> {
        match self {
            LoadRequest::PatchLoad(patch) if patch.dispersal.is_some() => Some(patch.force_n_per_m),
            LoadRequest::Vehicle(vehicle) => Some(vehicle.force()),
            _ => None,
        }
    }

    /// What it says against itself, over a backfill where there is one. `here` points to its fields.
    pub fn check(&self, here: &str, backfill: Option<&BackfillRequest>, faults: &mut Faults) {
        match self {
            LoadRequest::SelfWeight(_) | LoadRequest::Tie(_) | LoadRequest::BodyAcceleration(_) => {}
            LoadRequest::FillPressure(fill) => fill.check(here, backfill, faults),
            LoadRequest::LateralPressure(lateral) => lateral.check(here, faults),
            LoadRequest::PointLoad(point) => point.check(here, faults),
            LoadRequest::PatchLoad(patch) => patch.check(here, backfill, faults),
            LoadRequest::Vehicle(vehicle) => vehicle.check(here, backfill, faults),
            LoadRequest::PointForce(force) => {
                let detail = "0 both ways makes this load vanish: give another force or leave the load out";
                faults.require(force.force_n_per_m.0 != [0.0; 2], format!("{here}/force_n_per_m"), detail);
            }
        }
    }

    /// The field in which it is best mended where it does not fit the structure; none: the load as a whole.
    pub fn field_of(&self, fault: LoadFault) -> Option<&'static str> {
        match (self, fault) {
            (LoadRequest::FillPressure(FillPressure { fill_height_m: None, .. }), _) => Some("embankment_thickness_m"),
            (LoadRequest::FillPressure(_), _) => Some("fill_height_m"),
            (LoadRequest::PointLoad(_), LoadFault::NoSuchVoussoir { .. }) => Some("voussoir"),
            (LoadRequest::PointLoad(_), LoadFault::OnSeveralArcs) => Some("inclination_deg"),
            (LoadRequest::PointLoad(_), _) => Some("x_m"),
            (
                LoadRequest::PatchLoad(PatchLoad { dispersal: Some(dispersal), .. })
                | LoadRequest::Vehicle(VehicleLoad { dispersal: Some(dispersal), .. }),
                LoadFault::SurfaceBelowExtrados { .. },
            ) => Some(dispersal.field_of_surface()),
            (LoadRequest::PatchLoad(_), _) => Some("centre_x_m"),
            (LoadRequest::Vehicle(_), _) => Some("x_m"),
            (LoadRequest::PointForce(_), _) => Some("at_m"),
            (LoadRequest::Tie(_), LoadFault::OffTheBody { end: 0, .. }) => Some("from/at_m"),
            (LoadRequest::Tie(_), _) => Some("to/at_m"),
            (LoadRequest::SelfWeight(_) | LoadRequest::LateralPressure(_) | LoadRequest::BodyAcceleration(_), _) => {
                None
            }
        }
    }

    /// As a person says it, over a backfill where there is one.
    pub fn words(&self, backfill: Option<&BackfillRequest>) -> String {
        match self {
            LoadRequest::SelfWeight(_) => "self weight".to_owned(),
            LoadRequest::FillPressure(fill) => fill.words(backfill),
            LoadRequest::LateralPressure(lateral) => lateral.words(),
            LoadRequest::PointLoad(point) => point.words(),
            LoadRequest::PatchLoad(patch) => patch.words(backfill),
            LoadRequest::Vehicle(vehicle) => vehicle.words(backfill),
            LoadRequest::PointForce(force) => {
                let [fx, fy] = force.force_n_per_m.0.map(|force| Digits(force / 1e3));
                let [x, y] = force.at_m.0.map(Digits);
                format!("({fx}, {fy}) kN/m on {} at ({x}, {y}) m", force.block)
            }
            LoadRequest::Tie(tie) => tie.words(),
            LoadRequest::BodyAcceleration(body) => {
                let [x, y] = [body.x_g, body.y_g].map(Digits);
                format!("inertia force of {x} times the weight to the right, {y} upwards")
            }
        }
    }
}

fn kn_per_m(force: f64) -> String {
    format!("{} kN/m", Digits(force / 1e3))
}

impl BodyAcceleration {
    /// The acceleration that masses feel, m/s2.
    pub fn in_si(&self) -> Vec2 {
        GRAVITY * Vec2::new(self.x_g, self.y_g)
    }
}
