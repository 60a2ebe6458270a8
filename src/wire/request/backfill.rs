//! Fill over a structure: surface, layers, backing, and how it disperses loads.

use super::{Boussinesq, DistributionRequest, PassiveRequest, Point};
use crate::geometry::Vec2;
use crate::structure::load::{Fill, FillBacking, Layer, Passive, SurfaceLine};
use crate::wire::fault::{Faults, Shown};
use crate::wire::prose::Digits;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use utoipa::ToSchema;

/// Fill over an arch or a bridge, from the extrados up to a surface such as a road. It is there whatever the load factor: its
/// weight is a fixed load, vertical, on the plan projection of the extrados, and in every `body_acceleration` the column of fill
/// over every part of the extrados that looks up pushes with its mass at its own centre of mass, carried by the stone below.
/// Where the surface is not above the extrados there is no fill. Layers lie under the surface, and are as thin as what there is
/// over the extrados. A `fill_pressure` beside it may be an embankment only, which stands on the surface.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(default)]
pub struct BackfillRequest {
    /// Height of a level surface above y = 0, m. Either this or `surface_m` is given.
    #[schema(minimum = -1e5, maximum = 1e5)]
    pub surface_height_m: Option<f64>,
    /// The surface through points [x, y], m, from left to right: straight between them, level beyond the first and the last.
    #[schema(min_items = 2, max_items = 200)]
    pub surface_m: Option<Vec<Point>>,
    /// Density below the layers, kg/m3.
    #[schema(minimum = 0.0, exclusive_maximum = 1e5)]
    pub density_kg_m3: f64,
    /// Layers from the surface downwards, such as surfacing. They follow the surface.
    #[schema(max_items = 20)]
    pub layers: Vec<FillLayerRequest>,
    /// Fill of another density up to a level, below the layers. Left out: none. It is soil that weighs and may resist; masonry
    /// that bears on the rings by joints, as blocks do, is `bridge.backing`.
    pub backing: Option<FillBackingRequest>,
    /// Ratio K of horizontal to vertical pressure, a pure number: pressure at rest, on the vertical projection of the extrados.
    #[schema(minimum = 0.0, exclusive_maximum = 1e12)]
    pub lateral_ratio: f64,
    /// How it resists stones that move into it. Left out: it does not. Not with `lateral_ratio`.
    pub passive: Option<PassiveRequest>,
    /// How a load on the surface spreads whose own `dispersal` does not say it.
    pub dispersal: DistributionRequest,
}

/// A layer of fill.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct FillLayerRequest {
    /// Thickness, upright, m.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub thickness_m: f64,
    /// Density, kg/m3.
    #[schema(minimum = 0.0, exclusive_maximum = 1e5)]
    pub density_kg_m3: f64,
}

/// Fill of another density up to a level.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct FillBackingRequest {
    /// Height of its top above y = 0, m.
    #[schema(minimum = -1e5, maximum = 1e5)]
    pub height_m: f64,
    /// Density, kg/m3.
    #[schema(minimum = 0.0, exclusive_maximum = 1e5)]
    pub density_kg_m3: f64,
    /// Largest horizontal pressure with which it resists stones that move into it, in place of that of `passive`, Pa. Left out: as
    /// the fill.
    #[schema(minimum = 0.0, maximum = 1e15)]
    pub resistance_pa: Option<f64>,
}

impl Default for BackfillRequest {
    /// Gravel as in Table 1 of the paper, without horizontal pressure; loads on it spread as in a half space, to 30 degrees.
    fn default() -> Self {
        BackfillRequest {
            surface_height_m: None,
            surface_m: None,
            density_kg_m3: 1600.0,
            layers: Vec::new(),
            backing: None,
            lateral_ratio: 0.0,
            passive: None,
            dispersal: DistributionRequest::Boussinesq(Boussinesq { cut_off_deg: 30.0 }),
        }
    }
}

impl BackfillRequest {
    /// Its surface; none where that has faults.
    pub fn surface(&self) -> Option<SurfaceLine> {
        match (self.surface_height_m, &self.surface_m) {
            (Some(height), None) => Some(SurfaceLine::level(height)),
            (None, Some(points)) => SurfaceLine::through(points.iter().map(|&point| point.into()).collect()),
            _ => None,
        }
    }

    /// The fill in SI; none where its surface has faults.
    pub fn in_si(&self) -> Option<Fill> {
        let mut top = 0.0;
        let below = |layer: &FillLayerRequest| {
            let bottom = top - layer.thickness_m;
            Layer { bottom, top: std::mem::replace(&mut top, bottom), density: layer.density_kg_m3 }
        };
        let mut layers: Vec<Layer> = self.layers.iter().map(below).collect();
        layers.push(Layer { bottom: f64::NEG_INFINITY, top, density: self.density_kg_m3 });
        let backing = self.backing.as_ref();
        let backing = backing.map(|below| FillBacking { height: below.height_m, density: below.density_kg_m3 });
        Some(Fill { line: Some(self.surface()?), layers, backing, lateral_ratio: self.lateral_ratio })
    }

    /// What it resists with in SI, where it does.
    pub fn resists(&self) -> Option<Passive> {
        let backing = self.backing.as_ref().and_then(|backing| backing.resistance_pa);
        self.passive.as_ref().map(|passive| passive.in_si(backing))
    }

    /// Most forces that it puts on one side of a body.
    pub fn forces_per_side(&self) -> usize {
        let always = usize::from(self.passive.is_some());
        1 + self.layers.len() + usize::from(self.backing.is_some()) + always
    }

    /// What it says against itself. `here` points to it.
    pub fn check(&self, here: &str, faults: &mut Faults) {
        let one = self.surface_height_m.is_some() != self.surface_m.is_some();
        faults.require(one, here, "give either surface_height_m or surface_m, not both and not neither");
        let detail = "fill that resists presses between bounds: leave this out, and set passive/least to active for the pressure \
                      that acts always";
        let both = self.passive.is_some() && self.lateral_ratio != 0.0;
        faults.require(!both, format!("{here}/lateral_ratio"), detail);
        let detail =
            "the active pressure is more than this share of the passive one: raise factor, or set least to none";
        let ranged = self.passive.as_ref().is_none_or(PassiveRequest::is_range);
        faults.require(ranged, format!("{here}/passive/factor"), detail);
        let resists = self.backing.as_ref().is_some_and(|backing| backing.resistance_pa.is_some());
        let detail = "backing resists where fill does: give backfill/passive too, or leave this out";
        faults.require(!resists || self.passive.is_some(), format!("{here}/backing/resistance_pa"), detail);
        for (i, pair) in self.surface_m.iter().flat_map(|points| points.windows(2)).enumerate() {
            let [before, after] = [pair[0].0[0], pair[1].0[0]];
            let detail = format!(
                "a surface goes from left to right: this abscissa must be greater than that of the point before it, {}",
                Shown(before)
            );
            faults.require(after > before, format!("{here}/surface_m/{}", i + 1), detail);
        }
    }

    /// With all that is assumed of it.
    pub fn words(&self) -> String {
        let density = |density: f64| format!("{} kg/m3", Digits(density));
        let surface = match (&self.surface_m, self.surface_height_m) {
            (Some(points), _) => {
                let heights = || points.iter().map(|point| Vec2::from(*point).y);
                let [low, high] = [heights().reduce(f64::min), heights().reduce(f64::max)];
                let [low, high] = [low, high].map(|height| Digits(height.unwrap_or(f64::NAN)));
                format!("a surface through {} points, y = {low} to {high} m", points.len())
            }
            (None, height) => format!("y = {} m", Digits(height.unwrap_or(f64::NAN))),
        };
        let layer = |layer: &FillLayerRequest| {
            format!("; {} m of {} under the surface", Digits(layer.thickness_m), density(layer.density_kg_m3))
        };
        let layers: String = self.layers.iter().map(layer).collect();
        let backing = self.backing.as_ref().map_or(String::new(), |backing| {
            format!("; backing of {} up to y = {} m", density(backing.density_kg_m3), Digits(backing.height_m))
        });
        let horizontal = match (&self.passive, self.lateral_ratio) {
            (Some(passive), _) => passive.words(),
            (None, 0.0) => "no horizontal pressure, and no resistance to stones that move into it".to_owned(),
            (None, ratio) => format!(
                "horizontal pressure {} of the vertical, and no resistance to stones that move into it",
                Digits(ratio)
            ),
        };
        let strength = self.backing.as_ref().and_then(|backing| backing.resistance_pa);
        let strength =
            strength.map_or(String::new(), |pressure| format!("; backing with at most {} kPa", Digits(pressure / 1e3)));
        format!("backfill of {} up to {surface}{layers}{backing}; {horizontal}{strength}", density(self.density_kg_m3))
    }
}
