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
    let rows = (0..history.load_factor.len()).map(|row| columns.map(|column| column[row]));
    table(&names.map(str::to_owned), rows)
}

/// A stress field, a line for every subblock.
///
/// # Errors
/// Never into memory; the writer wants it said.
pub(super) fn field(field: &StressFieldBody) -> csv::Result<Vec<u8>> {
    let all = &field.subblocks;
    let mut names = ["voussoir", "radial", "along", "centre_x_m", "centre_y_m"].map(str::to_owned).to_vec();
    names.extend((0..4).flat_map(|corner| ["x", "y"].map(|axis| format!("corner_{corner}_{axis}_m"))));
    names.extend(["sigma_x_pa", "sigma_y_pa", "tau_xy_pa", "sigma_1_pa", "sigma_2_pa", "tresca_pa"].map(str::to_owned));
    let row = |i: usize| {
        let places = [all.voussoir[i], all.radial[i], all.along[i]].map(|count| count as f64);
        let corners = all.corners_x_m[i].into_iter().zip(all.corners_y_m[i]).flat_map(|(x, y)| [x, y]);
        let stresses = [&all.sigma_x_pa, &all.sigma_y_pa, &all.tau_xy_pa, &all.sigma_1_pa, &all.sigma_2_pa];
        let numbers = places.into_iter().chain([all.centre_x_m[i], all.centre_y_m[i]]).chain(corners);
        numbers.chain(stresses.map(|column| column[i])).chain([all.tresca_pa[i]]).collect::<Vec<f64>>()
    };
    table(&names, (0..all.voussoir.len()).map(row))
}

/// Names and rows as comma-separated values; every number as short as it can be and still be read back the same.
fn table<Row: IntoIterator<Item = f64>>(names: &[String], rows: impl Iterator<Item = Row>) -> csv::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(names)?;
    for row in rows {
        writer.write_record(row.into_iter().map(|number| number.to_string()))?;
    }
    writer.into_inner().map_err(|error| error.into_error().into())
}
