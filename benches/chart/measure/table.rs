//! One row a measurement, and the CSV of them.

use serde::{Deserialize, Serialize};
use std::path::Path;

/// Which of the two charts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Collapse intensity against exact limit analysis.
    Collapse,
    /// Stress against the exact curved beam and a fine mesh.
    Stress,
}

/// One model on one scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The chart it belongs to.
    pub chart: Kind,
    /// Name of the scene.
    pub scene: String,
    /// Family of the model.
    pub family: String,
    /// Name of the model.
    pub model: String,
    /// Collapse intensity in the scene's unit, where that was sought and found.
    pub intensity: Option<f64>,
    /// Relative error, none where the run failed.
    pub error: Option<f64>,
    /// Time of one run, s.
    pub seconds: f64,
    /// Time of the analysis with one subblock a stone on the same scene in the same run, s.
    pub base_seconds: f64,
    /// The one over the other.
    pub time_ratio: f64,
    /// How the time was taken, or why the run failed.
    pub note: String,
}

/// Reads rows.
///
/// # Errors
/// When the file cannot be read or is no such table.
pub fn read(file: &Path) -> Result<Vec<Row>, csv::Error> {
    csv::Reader::from_path(file)?.deserialize().collect()
}

/// Writes rows.
///
/// # Errors
/// When the file cannot be written.
pub fn write(file: &Path, rows: &[Row]) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_path(file)?;
    rows.iter().try_for_each(|row| table.serialize(row))?;
    Ok(table.flush()?)
}
