//! Horizontal pressure on the flanks.

use crate::structure::load::{Band, Flanks, Load};
use crate::wire::fault::{Faults, Shown};
use crate::wire::prose::Digits;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Most bands of pressure that are listed.
const BANDS_LISTED: usize = 3;

/// Horizontal pressure in bands of height, on both flanks or one. It acts towards the arch, on the vertical projection of the extrados.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct LateralPressure {
    /// Bands of height; where bands overlap they add up.
    #[schema(min_items = 1, max_items = 1000)]
    pub bands: Vec<PressureBand>,
    /// Where they press. `left` and `right`: only on what of the extrados looks to that side, as earth on one side of an arch does.
    #[schema(required = false, default = "both")]
    pub side: Flanks,
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

impl LateralPressure {
    pub(super) fn in_si(&self) -> Load {
        let band = |band: &PressureBand| Band { from: band.from_m, to: band.to_m, pressure: band.pressure_pa };
        Load::Lateral(self.bands.iter().map(band).collect(), self.side)
    }

    pub(super) fn check(&self, here: &str, faults: &mut Faults) {
        for (i, band) in self.bands.iter().enumerate() {
            let from = Shown(band.from_m);
            let detail = format!("a band goes upwards: to_m must be greater than from_m, {from}");
            faults.require(band.to_m > band.from_m, format!("{here}/bands/{i}/to_m"), detail);
        }
    }

    pub(super) fn words(&self) -> String {
        let flanks = match self.side {
            Flanks::Both => "",
            Flanks::Left => " on the left flank",
            Flanks::Right => " on the right flank",
        };
        format!("lateral pressure{flanks}: {}", bands(&self.bands))
    }
}

/// Bands of pressure in words.
fn bands(bands: &[PressureBand]) -> String {
    let band = |band: &PressureBand| {
        let [pressure, from, to] = [band.pressure_pa / 1e3, band.from_m, band.to_m].map(Digits);
        format!("{pressure} kPa from y = {from} to {to} m")
    };
    let more = bands.len().saturating_sub(BANDS_LISTED);
    let more = if more > 0 { format!(" and {more} more bands") } else { String::new() };
    format!("{}{more}", bands.iter().take(BANDS_LISTED).map(band).collect::<Vec<_>>().join(", "))
}
