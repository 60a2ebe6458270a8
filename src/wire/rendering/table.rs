//! Parts of an answer as comma-separated values: a line of names, then a line for every row of numbers.

use crate::wire::response::{HistoryColumns, PositionColumns, StressFieldBody};
use std::fmt::Write;

/// The load path, a line for every point.
pub fn history(history: &HistoryColumns) -> String {
    let names = ["load_factor", "intensity", "crown_x_m", "crown_y_m", "largest_m"];
    let columns =
        [&history.load_factor, &history.intensity, &history.crown_x_m, &history.crown_y_m, &history.largest_m];
    table(&names.map(str::to_owned), history.load_factor.len(), |row, line| {
        columns.iter().for_each(|column| add(line, column[row]));
    })
}

/// Every position of vehicles, a line each; empty where there is no intensity.
pub fn positions(curve: &PositionColumns) -> String {
    let names = ["x_m", "reversed", "arriving", "instability", "crushing"];
    table(&names.map(str::to_owned), curve.x_m.len(), |row, line| {
        add(line, curve.x_m[row]);
        add(line, curve.reversed[row]);
        add(line, curve.arriving[row]);
        for column in [&curve.instability, &curve.crushing] {
            match column[row] {
                Some(intensity) => add(line, intensity),
                None => line.push(','),
            }
        }
    })
}

/// A stress field, a line for every subblock.
pub fn field(field: &StressFieldBody) -> String {
    let all = &field.subblocks;
    let mut names = ["voussoir", "radial", "along", "centre_x_m", "centre_y_m"].map(str::to_owned).to_vec();
    // There may be more than four; what a subblock has not is left empty.
    let most = all.corners_x_m.iter().map(Vec::len).fold(4, usize::max);
    names.extend((0..most).flat_map(|corner| ["x", "y"].map(|axis| format!("corner_{corner}_{axis}_m"))));
    names.extend(["sigma_x_pa", "sigma_y_pa", "tau_xy_pa", "sigma_1_pa", "sigma_2_pa", "tresca_pa"].map(str::to_owned));
    let stresses = [&all.sigma_x_pa, &all.sigma_y_pa, &all.tau_xy_pa, &all.sigma_1_pa, &all.sigma_2_pa, &all.tresca_pa];
    table(&names, all.voussoir.len(), |i, line| {
        [&all.voussoir, &all.radial, &all.along].iter().for_each(|column| add(line, column[i]));
        [&all.centre_x_m, &all.centre_y_m].iter().for_each(|column| add(line, column[i]));
        for corner in 0..most {
            for axis in [&all.corners_x_m, &all.corners_y_m] {
                match axis[i].get(corner) {
                    Some(place) => add(line, *place),
                    None => line.push(','),
                }
            }
        }
        stresses.iter().for_each(|column| add(line, column[i]));
    })
}

/// Adds a number, as short as it can be and still be read back the same, and a comma.
fn add(line: &mut String, number: impl std::fmt::Debug) {
    // Writing to a string cannot fail.
    let _ = write!(line, "{number:?},");
}

/// Names and rows; `write` ends every value of a row with a comma.
fn table(names: &[String], rows: usize, write: impl Fn(usize, &mut String)) -> String {
    let mut text = names.join(",") + "\n";
    for row in 0..rows {
        write(row, &mut text);
        text.pop();
        text.push('\n');
    }
    text
}
