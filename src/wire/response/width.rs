//! Forces per metre of width, and over the whole width where the request gives it.

use super::ThrustColumns;
use super::structure::StructureBody;
use crate::collapse::{Thrust, ThrustRange};
use crate::wire::request::{AnalysisRequest, LoadEntry, LoadRequest};
use serde::Serialize;
use utoipa::ToSchema;

/// Resultant of the scaled loads, on both halves of half an arch.
#[derive(Debug, Clone, Copy, Serialize, ToSchema)]
pub struct ScaledLoadBody {
    /// To the right, kN per metre of width.
    pub x_kn_per_m: f64,
    /// Upwards, kN per metre of width.
    pub y_kn_per_m: f64,
    /// To the right, kN over the whole width; null where the request gives no `width_m`, and where a vehicle is scaled, which
    /// stands on a width of its own.
    pub x_kn: Option<f64>,
    /// Upwards, kN over the whole width; null as `x_kn` is.
    pub y_kn: Option<f64>,
}

impl ScaledLoadBody {
    /// At load factor 1.
    pub(super) fn new(request: &AnalysisRequest, structure: &StructureBody) -> Self {
        let loads = || structure.bodies.iter().map(|body| body.scaled_load);
        let (x, y) = (loads().map(|load| load.x_n_per_m).sum::<f64>(), loads().map(|load| load.y_n_per_m).sum::<f64>());
        // The other half has the mirror image of the loads.
        let [x, y] = if request.half() { [0.0, 2.0 * y] } else { [x, y] };
        let vehicle = |entry: &LoadEntry| entry.scaled && matches!(entry.load, LoadRequest::Vehicle(_));
        let width = request.width_m.filter(|_| !request.loads.iter().any(vehicle));
        let [x_kn, y_kn] = [x, y].map(|force| width.map(|width| force / 1e3 * width));
        ScaledLoadBody { x_kn_per_m: x / 1e3, y_kn_per_m: y / 1e3, x_kn, y_kn }
    }

    /// At another load factor.
    pub(super) fn times(self, load_factor: f64) -> Self {
        let [x_kn_per_m, y_kn_per_m] = [self.x_kn_per_m, self.y_kn_per_m].map(|force| load_factor * force);
        let [x_kn, y_kn] = [self.x_kn, self.y_kn].map(|force| force.map(|force| load_factor * force));
        ScaledLoadBody { x_kn_per_m, y_kn_per_m, x_kn, y_kn }
    }
}

/// Horizontal thrust under the fixed loads, by the static theorem, with which the left springing pushes to the right; negative:
/// to the left. With `backfill.passive` it counts the soil, which presses as equilibrium needs, up to its limits; of half an arch on
/// both sides alike, which may leave the ends of the whole arch's range out.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct ThrustRangeBody {
    /// Least, kN per metre of width; null: as far the other way as one likes.
    pub lowest_kn_per_m: Option<f64>,
    /// Greatest, kN per metre of width; null: as much as one likes, as in an arch so flat that its stones are wedged.
    pub highest_kn_per_m: Option<f64>,
    /// Least, kN over the whole width; null where it is unbounded or the request gives no `width_m`.
    pub lowest_kn: Option<f64>,
    /// Greatest, kN over the whole width; null where it is unbounded or the request gives no `width_m`.
    pub highest_kn: Option<f64>,
    /// The line of thrust at the least thrust: the resultant of every joint; null where the range has no end there.
    pub lowest_line: Option<ThrustColumns>,
    /// The line of thrust at the greatest thrust; null where the range has no end there.
    pub highest_line: Option<ThrustColumns>,
}

impl ThrustRangeBody {
    pub(super) fn new(range: ThrustRange, lines: &[Option<Vec<Thrust>>; 2], width: Option<f64>) -> Self {
        let ends = [range.lowest, range.highest];
        let [lowest_kn_per_m, highest_kn_per_m] = ends.map(|end| (!end.is_infinite()).then_some(end / 1e3));
        let [lowest_kn, highest_kn] = [lowest_kn_per_m, highest_kn_per_m].map(|end| Some(end? * width?));
        let [lowest_line, highest_line] = [0, 1].map(|end| lines[end].as_deref().map(ThrustColumns::new));
        ThrustRangeBody { lowest_kn_per_m, highest_kn_per_m, lowest_kn, highest_kn, lowest_line, highest_line }
    }
}
