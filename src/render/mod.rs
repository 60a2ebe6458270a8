//! Reports as pictures and files. Draws only: nothing here runs an analysis.

pub mod canvas;
pub mod chart;
#[cfg(test)]
mod checks;
pub mod digits;
pub mod figure;
pub mod heading;
mod labels;
#[cfg(feature = "server")]
mod letters;
pub mod motion;
#[cfg(feature = "server")]
pub mod pdf;
#[cfg(feature = "server")]
pub mod png;
pub mod stress;
pub mod vtu;
