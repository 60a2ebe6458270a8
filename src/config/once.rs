//! Options of the verbs that need no server.

use super::values::file_of;
use clap::Args;
use std::path::PathBuf;

/// What `solve` ends with.
pub(super) const EXIT_CODES: &str = "Exit codes: 0 with an answer, whatever its outcome; 2 for a request that cannot be analysed, or a wrong \
command line; 1 where there is no answer, the file cannot be read or nothing can be written.";

/// Analyse one request and print the answer
#[derive(Debug, Args)]
pub struct Solve {
    /// The request as JSON, just as one would POST it; - reads standard input
    pub file: PathBuf,
    /// Print the whole answer as JSON, byte for byte what /v1/jobs/{id}/results gives
    #[arg(long)]
    pub json: bool,
    /// Also draw the structure in the state that governs, as SVG, or in pixels, as PNG, into this file
    #[arg(long, value_name = "OUT.svg|OUT.png", value_parser = file_of(["svg", "png"]))]
    pub figure: Option<PathBuf>,
    /// Also write every drawing, as SVG, into this folder, each under its name
    #[arg(long, value_name = "FOLDER")]
    pub figures: Option<PathBuf>,
    /// Also write a report for the file, as a page in HTML, or on paper, as PDF, into this file
    #[arg(long, value_name = "OUT.html|OUT.pdf", value_parser = file_of(["html", "pdf"]))]
    pub report: Option<PathBuf>,
}

impl Solve {
    /// Whether nothing else than the answer as JSON is asked for.
    pub fn is_json_alone(&self) -> bool {
        self.json && [&self.figure, &self.figures, &self.report].iter().all(|file| file.is_none())
    }
}

/// What `survey` reads.
pub(super) const COLUMNS: &str = "The table is comma-separated, its first line the names of the columns: side (intrados or extrados; all intrados \
without it), x_m, y_m, and tolerance_m where points are uncertain. Points of a side run from left to right, one for every joint. \
tolerance_m asks for the analysis survey_tolerance, which needs a scaled load: give --into.";

/// Make a request of a table of surveyed points
#[derive(Debug, Args)]
pub struct Survey {
    /// The points as CSV; - reads standard input
    pub file: PathBuf,
    /// Put them into the arch of this request in JSON [default: an arch under its self weight]
    #[arg(long, value_name = "REQUEST.json")]
    pub into: Option<PathBuf>,
    /// Thickness in m, where there are points of the intrados alone
    #[arg(long, value_name = "M")]
    pub thickness: Option<f64>,
    /// Length in m over which the points are smoothed
    #[arg(long, value_name = "M")]
    pub smoothing_length: Option<f64>,
}
