//! The models that every scene is given to.

use serde_json::{Value, json};

/// Uniform meshes, subblocks each way.
const UNIFORM: [usize; 5] = [1, 2, 4, 8, 16];
/// Meshes on moving geometry.
const UPDATED: [usize; 2] = [1, 4];

/// Error of the collapse intensity that the program is asked to keep.
const INTENSITY: f64 = 1e-6;
/// Errors of the stress that it is asked to keep.
const STRESS: [f64; 7] = [0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001];

/// Name of the model in whose time all others are measured.
pub const BASE: &str = "1 x 1";

/// A way to answer a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// Its family: one kind of mark on the chart.
    pub family: &'static str,
    /// Its name, of its own among all models.
    pub name: String,
    /// How the answer is found.
    pub way: Way,
}

/// How an answer is found.
#[derive(Debug, Clone, PartialEq)]
pub enum Way {
    /// By the limit window alone.
    LimitWindow,
    /// By an analysis of the scene's request with these fields.
    Analysis(Value),
    /// By the same, read on moving geometry.
    Updated(Value),
}

/// Models of a scene whose collapse intensity is sought; the base comes first.
pub fn collapse(step: Option<f64>) -> Vec<Model> {
    let mut models = meshes();
    models.push(Model { family: "limit window", name: "limit window".to_owned(), way: Way::LimitWindow });
    models.extend(UPDATED.map(|n| {
        let mut fields = mesh(n, "split");
        fields["geometry"] = json!("updated");
        Model { family: "moving geometry", name: format!("{n} x {n}, moving geometry"), way: Way::Updated(fields) }
    }));
    models.push(accuracy("collapse_intensity", INTENSITY));
    models.extend(step.map(|step| {
        let fields = json!({"method": {"fixed_steps": {"step": step}}});
        Model { family: "load steps", name: format!("steps of {step} kN"), way: Way::Analysis(fields) }
    }));
    models
}

/// Models of a scene whose stresses are sought; the base comes first.
pub fn stress() -> Vec<Model> {
    meshes().into_iter().chain(STRESS.map(|error| accuracy("stress", error))).collect()
}

/// A mesh of the program's own choice that keeps an error of what is sought.
fn accuracy(of: &str, error: f64) -> Model {
    let way = Way::Analysis(json!({"accuracy": {of: error}}));
    Model { family: "adaptive", name: format!("asked {error}"), way }
}

/// Fields of a request that cut every voussoir into `n` by `n`.
pub fn mesh(n: usize, seams: &str) -> Value {
    json!({"mesh": {"subblocks": {"uniform": {"radial": n, "along": n}}, "seams": seams}})
}

/// Uniform meshes with either kind of seams; one subblock has none.
fn meshes() -> Vec<Model> {
    let split = |n| Model { family: "split seams", name: format!("{n} x {n}"), way: Way::Analysis(mesh(n, "split")) };
    let corners = |n| Model {
        family: "corner seams",
        name: format!("{n} x {n}, corner seams"),
        way: Way::Analysis(mesh(n, "corners")),
    };
    UNIFORM.map(split).into_iter().chain(UNIFORM[1..].iter().copied().map(corners)).collect()
}
