//! The curved beam as a person reads it.

use super::plan::error as error_of;
use super::summary::bare;
use super::wording;
use crate::collapse::{Order, Seams};
use crate::wire::prose::Digits;
use crate::wire::request::CurvedBeamRequest;
use crate::wire::response::{BeamResult, mesh_in_words};
use std::time::Duration;

/// Error and energy.
pub fn summary(result: &BeamResult, wall_time: Duration) -> String {
    let request = &result.request;
    let name = request.name.as_ref().map(|name| format!("{name}\n\n")).unwrap_or_default();
    let error = Digits(result.error_percent);
    let headline = format!("The stress in the curved beam is off by {error} % of the theory of elasticity.");
    let CurvedBeamRequest { inner_radius_m: inner, outer_radius_m: outer, end_shear_n_per_m: shear, .. } =
        request.curved_beam;
    let sides = if request.curved_beam.curved_sides { "true sectors" } else { "straight sides" };
    let seams = match (request.mesh.order(), request.mesh.seams) {
        (Order::Second, _) => "",
        (Order::First, Seams::Split) => ", split springs",
        (Order::First, Seams::Corners) => ", corner springs",
    };
    let off = 100.0 * (result.energy_j_per_m / result.exact_energy_j_per_m - 1.0);
    let energy = [result.energy_j_per_m, result.exact_energy_j_per_m].map(Digits);
    let mesh = match &result.plan {
        Some(plan) => format!("{} x {} subblocks (radial x along), found", plan.radial, plan.along),
        None => mesh_in_words(&request.mesh),
    };
    let mut table = bare();
    table.add_rows([
        ["beam", &format!("a quarter ring from {} to {} m, {sides}", Digits(inner), Digits(outer))],
        ["end shear", &format!("{} N/m", Digits(shear))],
        ["mesh", &format!("{mesh}{seams}")],
        ["error", &format!("{error} % (e_N of eq. (5) of the paper)")],
        ["energy", &format!("{} J/m; exact: {} J/m, so it is off by {off:.3} %", energy[0], energy[1])],
        ["cost", &format!("{} unknowns", result.unknowns)],
        ["time", &format!("{:.3} ms", wall_time.as_secs_f64() * 1e3)],
    ]);
    if let Some(plan) = &result.plan {
        table
            .add_row(["estimated", &format!("{} (from two meshes, not from the exact stress)", error_of(plan.stress))]);
    }
    format!("{name}{}\n\n{}\n", wording::wrapped(&headline), table.trim_fmt())
}
