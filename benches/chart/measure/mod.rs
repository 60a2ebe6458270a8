//! Runs all models on all scenes and writes a table and two charts.

mod clock;
mod models;
mod picture;
mod plot;
mod run;
mod scenes;
mod stress;
mod table;

use clap::Parser;
use run::Chosen;
use std::fs;
use std::path::PathBuf;
use table::{Kind, Row};

/// Measures speed against accuracy on a fixed set of scenes; takes minutes.
#[derive(Debug, Parser)]
pub struct Options {
    /// Folder for chart.csv, collapse.svg and stress.svg
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Rows of other programs on the same scenes, as benches/peers writes them, to be shown as well
    #[arg(long, value_name = "FILE.csv")]
    pub peers: Option<PathBuf>,
    /// Only this scene, as named in chart.csv; may be given several times
    #[arg(long = "scene", value_name = "SCENE")]
    pub scenes: Vec<String>,
    /// Only this model, as named in chart.csv, and that with one subblock a stone; may be given several times
    #[arg(long = "model", value_name = "MODEL")]
    pub models: Vec<String>,
    /// Cargo says so.
    #[arg(long, hide = true)]
    pub bench: bool,
}

/// # Errors
/// What could not be read, run or written.
pub fn measure_and_write(options: &Options) -> Result<(), String> {
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
    eprintln!("{}, {}: {:.4} s, {error}", row.scene, row.model, row.seconds);
}
