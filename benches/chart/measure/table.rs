//! One row a measurement, and the CSV of them.

use serde::{Deserialize, Serialize};
use std::path::Path;

/// Which of the two errors.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Of the collapse intensity, against exact limit analysis.
    Collapse,
    /// Of the stress, against finite elements or the exact curved beam.
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
    /// Relative error, none where the run failed. Of the stress over the whole structure.
    pub error: Option<f64>,
    /// That of the stress over the worst voussoir.
    pub error_worst_voussoir: Option<f64>,
    /// That of the stress in the worst point, over the largest stress of the reference.
    pub error_peak: Option<f64>,
    /// What the reference says of its own error; none where it is exact.
    pub error_of_reference: Option<f64>,
    /// What the program says of the error, where an accuracy was asked.
    pub estimate: Option<f64>,
    /// Whether it says that this accuracy is met.
    pub met: Option<bool>,
    /// CPU time of one run: the median of the repetitions, s.
    pub seconds: f64,
    /// The least of them, s.
    pub least_seconds: f64,
    /// The greatest, s.
    pub greatest_seconds: f64,
    /// How many.
    pub repetitions: usize,
    /// CPU time of the analysis with one subblock a stone on the same scene, s; none where that was not run.
    pub base_seconds: Option<f64>,
    /// The one over the other.
    pub time_ratio: Option<f64>,
    /// Why the run failed, or what else there is to say.
    pub note: String,
}

impl Row {
    /// Which chart, scene and model it is of.
    pub fn run(&self) -> (Kind, &str, &str) {
        (self.chart, &self.scene, &self.model)
    }
}

/// Sets every time beside that of the model of this name on the same scene.
pub fn compare_times(rows: &mut [Row], base: &str) {
    let of = |row: &Row| ((row.chart, row.scene.clone()), row.seconds);
    let bases: Vec<_> = rows.iter().filter(|row| row.model == base).map(of).collect();
    for row in rows {
        let found = bases.iter().find(|((chart, scene), _)| *chart == row.chart && *scene == row.scene);
        row.base_seconds = found.map(|(_, seconds)| *seconds);
        row.time_ratio = row.base_seconds.map(|base| row.seconds / base);
    }
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
