//! Reports as pictures and files. Draws only: nothing here runs an analysis.

pub mod canvas;
#[cfg(test)]
mod checks;
pub mod figure;
pub mod vtu;
