//! Reports as pictures and files. Draws only: nothing here runs an analysis.

mod canvas;
pub mod chart;
#[cfg(test)]
mod checks;
pub mod figure;
pub mod vtu;
