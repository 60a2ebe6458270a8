//! A force at one point of the extrados.

use super::kn_per_m;
use crate::geometry::Vec2;
use crate::structure::load::{Load, Place};
use crate::wire::fault::Faults;
use crate::wire::prose::Digits;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use utoipa::ToSchema;

/// A force at one point of the extrados, downwards or inclined. The point is at an abscissa, or in the middle of a voussoir.
#[skip_serializing_none]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PointLoad {
    /// Force per metre of width, N/m, downwards positive; not 0.
    #[schema(minimum = -1e15, maximum = 1e15)]
    pub force_n_per_m: f64,
    /// Angle from the vertical, degrees; positive: a downward force also pushes to the right.
    #[schema(required = false, default = 0.0, minimum = -180.0, maximum = 180.0)]
    pub inclination_deg: f64,
    /// Abscissa, m; over a joint, its two voussoirs take half each. Either this or `voussoir` is given.
    #[schema(minimum = -1e5, maximum = 1e5)]
    pub x_m: Option<f64>,
    /// Number of a voussoir, from 0 on the left: the middle of its extrados side.
    #[schema(maximum = 2000)]
    pub voussoir: Option<usize>,
}

impl PointLoad {
    pub(super) fn in_si(&self) -> Load {
        Load::Point(self.force(), self.place())
    }

    pub(super) fn check(&self, here: &str, faults: &mut Faults) {
        faults.not_zero(&format!("{here}/force_n_per_m"), self.force_n_per_m);
        let one = self.x_m.is_some() != self.voussoir.is_some();
        faults.require(one, here, "give either x_m or voussoir, not both and not neither");
    }

    /// The force, N/m.
    fn force(&self) -> Vec2 {
        let (sin, cos) = self.inclination_deg.to_radians().sin_cos();
        self.force_n_per_m * Vec2::new(sin, -cos)
    }

    /// Of two places the abscissa counts.
    fn place(&self) -> Place {
        match (self.x_m, self.voussoir) {
            (None, Some(voussoir)) => Place::Body(voussoir),
            (x, _) => Place::Abscissa(x.unwrap_or(0.0)),
        }
    }

    pub(super) fn words(&self) -> String {
        let place = match self.place() {
            Place::Body(voussoir) => format!("on voussoir {voussoir}"),
            Place::Abscissa(x) => format!("at x = {} m", Digits(x)),
        };
        let inclined = match self.inclination_deg {
            0.0 => String::new(),
            angle => format!(", inclined by {} deg to the right", Digits(angle)),
        };
        format!("{} {place}{inclined}", kn_per_m(self.force_n_per_m))
    }
}
