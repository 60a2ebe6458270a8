//! Parts of an answer as tables.

use super::response::{HistoryColumns, StressFieldBody};

/// The load path, a line for every point.
///
/// # Errors
/// Never into memory; the writer wants it said.
pub(super) fn history(history: &HistoryColumns) -> csv::Result<Vec<u8>> {
    let names = ["load_factor", "intensity", "crown_x_m", "crown_y_m", "largest_m"];
    let columns =
        [&history.load_factor, &history.intensity, &history.crown_x_m, &history.crown_y_m, &history.largest_m];
    let rows = (0..history.load_factor.len()).map(|row| columns.map(|column| text(column[row])));
    table(&names.map(str::to_owned), rows)
}

/// A stress field, a line for every subblock.
///
/// # Errors
/// Never into memory; the writer wants it said.
pub(super) fn field(field: &StressFieldBody) -> csv::Result<Vec<u8>> {
    let all = &field.subblocks;
    let mut names = ["voussoir", "radial", "along", "centre_x_m", "centre_y_m"].map(str::to_owned).to_vec();
    // There may be more than four; what a subblock has not is left empty.
    let most = all.corners_x_m.iter().map(Vec::len).fold(4, usize::max);
    names.extend((0..most).flat_map(|corner| ["x", "y"].map(|axis| format!("corner_{corner}_{axis}_m"))));
    names.extend(["sigma_x_pa", "sigma_y_pa", "tau_xy_pa", "sigma_1_pa", "sigma_2_pa", "tresca_pa"].map(str::to_owned));
    let row = |i: usize| {
        let places = [all.voussoir[i], all.radial[i], all.along[i]].map(|count| count.to_string());
        let coordinate = |of: &[f64], corner: usize| of.get(corner).copied().map(text).unwrap_or_default();
        let corners = (0..most).flat_map(|k| [&all.corners_x_m, &all.corners_y_m].map(|of| coordinate(&of[i], k)));
        let stresses = [&all.sigma_x_pa, &all.sigma_y_pa, &all.tau_xy_pa, &all.sigma_1_pa, &all.sigma_2_pa];
        let stresses = stresses.map(|column| column[i]).into_iter().chain([all.tresca_pa[i]]).map(text);
        let centre = [all.centre_x_m[i], all.centre_y_m[i]].map(text);
        places.into_iter().chain(centre).chain(corners).chain(stresses).collect::<Vec<_>>()
    };
    table(&names, (0..all.voussoir.len()).map(row))
}

/// A number as short as it can be and still be read back the same.
fn text(number: f64) -> String {
    format!("{number:?}")
}

/// Names and rows as comma-separated values.
fn table<Row: IntoIterator<Item = String>>(names: &[String], rows: impl Iterator<Item = Row>) -> csv::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(names)?;
    for row in rows {
        writer.write_record(row)?;
    }
    writer.into_inner().map_err(|error| error.into_error().into())
}
