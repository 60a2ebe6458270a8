//! The hard scenes: maps of two axes each, every scene a request that is known to break some method.
//!
//! Not modelled, because an analysis has one Young's modulus: stones of different stuff. `mesh` mixes stones of one and of many
//! subblocks instead, and `slivers` stones whose lengths, and so stiffnesses, differ by up to 1,000.

mod friction;
mod loads;
mod moving;
mod shape;

use crate::common::door;
use serde_json::{Value, json};
use voussoir::collapse::Analysis;

/// One question.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Index along both axes of the map.
    pub at: [usize; 2],
    /// What tells scenes in the same place apart.
    pub variant: &'static str,
    /// A body as the service takes it.
    pub request: Value,
    /// Penalty over Young's modulus, also beyond what a request may ask for.
    pub penalty_ratio: f64,
    /// Whether it stands, where that is known closer than the oracle can tell: loads set to so many times their limit.
    pub stands: Option<bool>,
}

impl Scene {
    /// The analysis.
    ///
    /// # Errors
    /// What is wrong with the request: some places of a map are no arches.
    pub fn analysis(&self) -> Result<Analysis, String> {
        let mut analysis = door::analysis(&self.request)?;
        analysis.penalty_ratio = self.penalty_ratio;
        Ok(analysis)
    }
}

/// An axis of a map.
pub struct Axis {
    /// What it is, with its unit.
    pub label: &'static str,
    pub values: Vec<f64>,
}

/// Scenes over two axes.
pub struct Map {
    pub name: &'static str,
    /// What it is a map of, in a line.
    pub title: &'static str,
    pub axes: [Axis; 2],
    pub scenes: Vec<Scene>,
}

/// Builds a map: some look for least thicknesses first, which takes a while.
pub type Build = fn() -> Map;

/// All maps by name.
pub const MAPS: [(&str, Build); 14] = [
    ("penalty", friction::penalty),
    ("thickness", shape::thickness),
    ("number", shape::number),
    ("flat", shape::flat),
    ("tilt", shape::tilt),
    ("slivers", shape::slivers),
    ("mesh", shape::mesh),
    ("window", loads::window),
    ("ties", loads::ties),
    ("never", loads::never),
    ("cohesion", friction::cohesion),
    ("units", loads::units),
    ("settlement", moving::settlement),
    ("motion", moving::motion),
];

impl Map {
    /// Every place of the axes, and in each every variant; places that `request` has nothing for are left out.
    fn of(
        name: &'static str,
        title: &'static str,
        axes: [Axis; 2],
        variants: &[&'static str],
        request: impl Fn(f64, f64, &str) -> Option<Value>,
    ) -> Map {
        let mut scenes = Vec::new();
        for (i, &x) in axes[0].values.iter().enumerate() {
            for (j, &y) in axes[1].values.iter().enumerate() {
                for &variant in variants {
                    let Some(request) = request(x, y, variant) else { continue };
                    scenes.push(Scene { at: [i, j], variant, request, penalty_ratio: 10.0, stands: None });
                }
            }
        }
        Map { name, title, axes, scenes }
    }
}

fn axis(label: &'static str, values: impl Into<Vec<f64>>) -> Axis {
    Axis { label, values: values.into() }
}

/// `10^from` to `10^to` with so many steps a decade.
fn decades(from: i32, to: i32, steps: i32) -> Vec<f64> {
    (from * steps..=to * steps).map(|i| 10f64.powf(f64::from(i) / f64::from(steps))).collect()
}

/// Friction angles, degrees: exactly none, next to none, and up to where nothing slides.
fn frictions() -> Vec<f64> {
    vec![0.0, 1e-3, 1.0, 3.0, 5.0, 8.0, 10.0, 12.0, 15.0, 18.0, 21.0, 25.0, 30.0, 35.0, 40.0, 50.0, 60.0, 70.0, 80.0]
}

/// A semicircle of mean radius 10 m, `ratio` of it thick.
fn semicircle(voussoirs: usize, ratio: f64) -> Value {
    json!({
        "profile": {"circular": {"radius_m": 10.0, "opening_angle_deg": 180.0}},
        "thickness": {"constant_m": 10.0 * ratio},
        "voussoirs": voussoirs,
    })
}

/// A load by its name: on a stone of the left haunch, on the crown, upwards on the crown, or one g to the right.
fn load(name: &str, voussoirs: usize) -> Value {
    let point = |voussoir: usize, force: f64| json!({"point_load": {"voussoir": voussoir, "force_n_per_m": force}});
    match name {
        "haunch" => point(voussoirs / 4, 1e4),
        "crown" => point(voussoirs / 2, 1e4),
        "uplift" => point(voussoirs / 2, -1e4),
        "lateral" => json!({"body_acceleration": {"x_g": 1.0}}),
        other => panic!("no load {other}"),
    }
}

/// An arch under its weight, where it has one, and a scaled load.
fn ask(arch: Value, friction_deg: f64, scaled: Option<Value>, weighty: bool) -> Value {
    let mut loads = Vec::new();
    if weighty {
        loads.push(json!({"load": {"self_weight": {}}}));
    }
    loads.extend(scaled.map(|load| json!({"load": load, "scaled": true})));
    json!({
        "arch": arch,
        // Strong stone: crushing is another question.
        "stone": {"friction_angle_deg": friction_deg, "youngs_modulus_pa": 1e10, "compressive_strength_pa": 1e30},
        "loads": loads,
    })
}
