//! `voussoir solve --figure`: the answer as a picture in a file.

use super::wording;
use std::fs;
use std::path::Path;
use voussoir::api::response::AnalysisResult;
use voussoir::arch::Arch;
use voussoir::collapse::{CollapseReport, Outcome};
use voussoir::render::figure::svg;

/// Draws the end of the load path in the asked direction; where it has none, the other one.
///
/// # Errors
/// Why there is no picture.
pub fn write(file: &Path, arch: &Arch, report: &CollapseReport, result: &AnalysisResult) -> Result<(), String> {
    let Some(end) = report.end.as_ref().or(report.other_end.as_ref()) else {
        return Err(format!("no figure: nothing moves (outcome: {})", wording::word(&result.outcome)));
    };
    let name = result.request.name.as_deref().unwrap_or("Arch");
    let mut caption = format!("{name}\n{}", wording::wrapped(&wording::headline(result)));
    if report.outcome == Outcome::StandsInWindow {
        caption.push_str(&format!("\nDrawn: {}.", wording::shown(result)));
    }
    fs::write(file, svg(arch, end, &caption)).map_err(|error| format!("cannot write {}: {error}", file.display()))
}
