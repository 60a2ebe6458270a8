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
use std::path::{Path, PathBuf};
use table::{Kind, Row};

/// Measures speed against accuracy on a fixed set of scenes; takes minutes.
#[derive(Debug, Parser)]
pub struct Options {
    /// Folder for chart.csv, collapse.svg, size.svg and stress.svg
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Rows of other programs on the same scenes, as benches/peers writes them, to be shown as well
    #[arg(long, value_name = "FILE.csv")]
    pub peers: Option<PathBuf>,
    /// Take the rows of this table, and run nothing
    #[arg(long, value_name = "CHART.csv", conflicts_with_all = ["scenes", "models"])]
    pub from: Option<PathBuf>,
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
    let read = |file: &Path| table::read(file).map_err(|error| format!("cannot read {}: {error}", file.display()));
    let peers = options.peers.as_deref().map_or_else(|| Ok(Vec::new()), read)?;
    let mut rows = match &options.from {
        Some(table) => read(table)?,
        None => run::run(&scenes, Chosen { scenes: &options.scenes, models: &options.models }, &mut tell)?,
    };
    // Those of an earlier table give way.
    rows.retain(|row| !peers.iter().any(|peer| peer.run() == row.run()));
    rows.extend(peers);
    table::compare_times(&mut rows, models::BASE);
    let cannot = |error: &dyn std::fmt::Display| format!("cannot write into {}: {error}", options.out.display());
    fs::create_dir_all(&options.out).map_err(|error| cannot(&error))?;
    table::write(&options.out.join("chart.csv"), &rows).map_err(|error| cannot(&error))?;
    let write = |file: &str, svg: String| fs::write(options.out.join(file), svg).map_err(|error| cannot(&error));
    write("collapse.svg", picture::errors(Kind::Collapse, &scenes, &rows))?;
    write("stress.svg", picture::errors(Kind::Stress, &scenes, &rows))?;
    write("size.svg", picture::sizes(&scenes, &rows))
}

/// Says on standard error what was measured, since all of it takes minutes.
fn tell(row: &Row) {
    let error = row.error.map_or_else(|| row.note.clone(), |error| format!("error {error:.1e}"));
    eprintln!("{}, {}: {:.3} ms, {error}", row.scene, row.model, 1e3 * row.seconds);
}
