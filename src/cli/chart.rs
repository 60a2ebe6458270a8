//! `voussoir chart`: speed against accuracy, measured on a fixed set of scenes.

mod clock;
mod models;
mod picture;
mod run;
mod scenes;
mod stress;
mod table;

use super::{complain, fail};
use crate::config::Chart;
use run::Chosen;
use std::fs;
use std::process::ExitCode;
use table::{Kind, Row};

/// Runs all models on all scenes and writes a table and two charts.
pub fn chart(options: &Chart) -> ExitCode {
    match measure_and_write(options) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => fail(error),
    }
}

fn measure_and_write(options: &Chart) -> Result<(), String> {
    let scenes = scenes::scenes().map_err(|error| format!("scenes.json: {error}"))?;
    let peers = match &options.peers {
        Some(file) => table::read(file).map_err(|error| format!("cannot read {}: {error}", file.display()))?,
        None => Vec::new(),
    };
    let at = |name: &str| options.out.join(name);
    let cannot = |error: &dyn std::fmt::Display| format!("cannot write into {}: {error}", options.out.display());
    fs::create_dir_all(&options.out).map_err(|error| cannot(&error))?;
    let chosen = Chosen { scenes: &options.scenes, models: &options.models };
    let mut rows = run::run(&scenes, chosen, &mut tell)?;
    rows.extend(peers);
    table::write(&at("chart.csv"), &rows).map_err(|error| cannot(&error))?;
    for (kind, file) in [(Kind::Collapse, "collapse.svg"), (Kind::Stress, "stress.svg")] {
        fs::write(at(file), picture::picture(kind, &scenes, &rows)).map_err(|error| cannot(&error))?;
    }
    Ok(())
}

/// Says on standard error what was measured, since all of it takes minutes.
fn tell(row: &Row) {
    let error = row.error.map_or_else(|| row.note.clone(), |error| format!("error {error:.1e}"));
    complain(format_args!("{}, {}: {:.4} s, {error}", row.scene, row.model, row.seconds));
}
