//! Vehicles: axles on one effective width.

use super::super::{BackfillRequest, Text};
use super::DispersalRequest;
use super::axle_groups::AxleGroup;
use crate::structure::load::{Axle, Vehicle};
use crate::wire::fault::Faults;
use crate::wire::prose::Digits;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use utoipa::ToSchema;

/// Axles at fixed distances on an effective width, given one by one or as a group of CS 454; on and beyond the structure. Every axle
/// is a strip as of a `patch_load`; what of it lies beyond the springings goes to the ground. Its force over the effective width is its
/// force per metre of width.
/// Where some axles grow with the load factor and others do not, they are two entries of `loads`.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct VehicleLoad {
    /// Its axles. Either these or `standard`.
    #[schema(min_items = 1, max_items = 50)]
    pub axles: Option<Vec<AxleRequest>>,
    /// Axles of a standard, and `length_m` beside. Either this or `axles`.
    pub standard: Option<AxleGroup>,
    /// Contact length along the span of the axles of `standard`, m.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub length_m: Option<f64>,
    /// Abscissa of the reference, from which offsets count, m. Left out where `analysis` asks for the worst position.
    #[schema(minimum = -1e5, maximum = 1e5)]
    pub x_m: Option<f64>,
    /// False: axles stand at `x_m` plus their offset. True: at `x_m` minus their offset, the vehicle drives the other way.
    #[schema(required = false, default = false)]
    pub reversed: bool,
    /// Width of the structure that carries it, m.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub effective_width_m: f64,
    /// By which rule that width was found, in your words: it is printed beside it. None is computed here.
    pub effective_width_rule: Text,
    /// How fill spreads the axles' forces between its surface and the extrados. Left out: the axles stand on the extrados.
    pub dispersal: Option<DispersalRequest>,
}

/// An axle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct AxleRequest {
    /// Distance from the reference, m; not the same for two axles.
    #[schema(minimum = -1e5, maximum = 1e5)]
    pub offset_m: f64,
    /// Force of the whole axle, N, downwards.
    #[schema(exclusive_minimum = 0.0, maximum = 1e15)]
    pub force_n: f64,
    /// Contact length along the span, m.
    #[schema(exclusive_minimum = 0.0, maximum = 1e5)]
    pub length_m: f64,
    /// Multiplies the force, such as that of axle lift-off or a partial factor of this axle; `partial_factors.live` multiplies it
    /// besides.
    #[schema(required = false, default = 1.0, exclusive_minimum = 0.0, maximum = 1e6)]
    pub factor: f64,
}

impl VehicleLoad {
    /// In SI; none where it stands on a surface that has faults.
    pub fn in_si(&self, backfill: Option<&BackfillRequest>) -> Option<Vehicle> {
        let dispersal = match &self.dispersal {
            Some(dispersal) => Some(dispersal.in_si(backfill)?),
            None => None,
        };
        Some(Vehicle { axles: self.axles(), x: self.x_m.unwrap_or(0.0), reversed: self.reversed, dispersal })
    }

    /// Its axles, given or of a standard.
    fn axles(&self) -> Vec<Axle> {
        let per_metre = |force: f64| force / self.effective_width_m;
        let given = self.axles.iter().flatten().map(|axle| Axle {
            offset: axle.offset_m,
            force: per_metre(axle.force_n * axle.factor),
            length: axle.length_m,
        });
        let standard = self.standard.map_or(Vec::new(), AxleGroup::axles);
        let length = self.length_m.unwrap_or(0.0);
        let standard = standard.iter().map(|&[offset, force]| Axle { offset, force: per_metre(force), length });
        given.chain(standard).collect()
    }

    /// Its force, N/m, downwards.
    pub(super) fn force(&self) -> f64 {
        self.axles().iter().map(|axle| axle.force).sum()
    }

    /// How many axles it has.
    pub(super) fn count(&self) -> usize {
        self.axles.as_ref().map_or(0, Vec::len) + self.standard.map_or(0, |group| group.axles().len())
    }

    /// What it says against itself; where it stands is checked with what is asked.
    pub(super) fn check(&self, here: &str, backfill: Option<&BackfillRequest>, faults: &mut Faults) {
        let one = self.axles.is_some() != self.standard.is_some();
        faults.require(one, here, "give either axles or standard, not both and not neither");
        let (detail, fits) = match self.standard {
            Some(_) => {
                ("the contact length is missing: the standard's table gives none, so add it", self.length_m.is_some())
            }
            None => ("axles have their own length_m: leave this out", self.length_m.is_none()),
        };
        faults.require(fits, format!("{here}/length_m"), detail);
        for (i, axle) in self.axles.iter().flatten().enumerate() {
            let earlier = self.axles.iter().flatten().take(i).any(|other| other.offset_m == axle.offset_m);
            let detail = "another axle has this offset: correct it, or join the two";
            faults.require(!earlier, format!("{here}/axles/{i}/offset_m"), detail);
        }
        if let Some(dispersal) = &self.dispersal {
            dispersal.check(&format!("{here}/dispersal"), backfill, faults);
        }
    }

    pub(super) fn words(&self, backfill: Option<&BackfillRequest>) -> String {
        let axle = |axle: &Axle| {
            let force = Digits(axle.force * self.effective_width_m / 1e3);
            format!("{force} kN at {} m ({} m long)", Digits(axle.offset), Digits(axle.length))
        };
        let axles = self.axles().iter().map(axle).collect::<Vec<_>>().join(", ");
        let place = match (self.x_m, self.reversed) {
            (None, _) => String::new(),
            (Some(x), false) => format!(", offsets to the right from x = {} m", Digits(x)),
            (Some(x), true) => format!(", offsets to the left from x = {} m", Digits(x)),
        };
        let (width, rule) = (Digits(self.effective_width_m), &self.effective_width_rule);
        let dispersal = self.dispersal.as_ref();
        let directly = || " directly on the extrados".to_owned();
        let down = dispersal.map_or_else(directly, |dispersal| dispersal.words(backfill, self.x_m));
        format!("vehicle, axles of {axles}{place}{down}; effective width {width} m ({rule})")
    }
}
