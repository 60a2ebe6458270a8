//! The scenes of the chart and what is known about them, from `cases/chart/scenes.json`.

use serde::Deserialize;
use serde_json::Value;

const SCENES: &str = include_str!("../../../cases/chart/scenes.json");

/// All scenes.
#[derive(Debug, Deserialize)]
pub struct Scenes {
    /// Those whose collapse intensity is held against limit analysis.
    pub collapse: Vec<CollapseScene>,
    /// Those whose stresses are held against a reference, point by point.
    pub stress: Vec<StressScene>,
}

/// An arch and its collapse intensity.
#[derive(Debug, Deserialize)]
pub struct CollapseScene {
    /// Its name on the chart.
    pub name: String,
    /// Least and greatest collapse intensity that limit analysis leaves open (`tests/it/chart.rs`); one number where nothing slides.
    pub intensity: [f64; 2],
    /// Whether joints slide in the mechanism.
    pub slides: bool,
    /// Step of the paper's load stepping in the scene's unit, where that makes sense.
    pub step: Option<f64>,
    /// Whether it is one of the series of the same arch in more and more voussoirs.
    #[serde(default)]
    pub of_sizes: bool,
    /// Subblocks each way of the finest mesh that it is run on; left out: all meshes. Where it is not, only the chart of the series
    /// shows the scene.
    pub finest: Option<usize>,
    /// The request without a mesh.
    pub request: Value,
}

/// A curved beam, or an arch at load factor 1.
#[derive(Debug, Deserialize)]
pub struct StressScene {
    /// Its name on the chart.
    pub name: String,
    /// Table of its reference, in `benches/fe/fields`.
    pub field: String,
    /// The request without a mesh.
    pub request: Value,
}

/// The scenes.
///
/// # Errors
/// Only if the file is not what it should be.
pub fn scenes() -> serde_json::Result<Scenes> {
    serde_json::from_str(SCENES)
}

impl Scenes {
    /// The arch in more and more voussoirs: names, and how many there are.
    pub fn sizes(&self) -> impl Iterator<Item = (&str, f64)> {
        let size = |scene: &CollapseScene| scene.request["arch"]["voussoirs"].as_f64();
        self.collapse
            .iter()
            .filter(|scene| scene.of_sizes)
            .filter_map(move |scene| Some((scene.name.as_str(), size(scene)?)))
    }
}

impl CollapseScene {
    /// Largest relative error that this intensity can have.
    pub fn error(&self, intensity: f64) -> f64 {
        let [lowest, highest] = self.intensity;
        (intensity - lowest).abs().max((intensity - highest).abs()) / highest.abs()
    }
}
