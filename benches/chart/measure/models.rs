//! The models that every scene is given to.

use super::stress::Reading;
use serde_json::{Value, json};

/// Uniform meshes, subblocks each way.
const UNIFORM: [usize; 5] = [1, 2, 4, 8, 16];

/// Error of the collapse intensity that the program is asked to keep.
const INTENSITY: f64 = 1e-6;
/// Errors of the stress that it is asked to keep.
const STRESS: [f64; 4] = [0.1, 0.05, 0.02, 0.01];

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
    /// How its stress is read.
    pub reading: Reading,
}

/// How an answer is found.
#[derive(Debug, Clone, PartialEq)]
pub enum Way {
    /// By the limit window alone.
    LimitWindow,
    /// By an analysis of the scene's request with these fields.
    Analysis(Value),
}

/// Models of a scene whose collapse intensity is sought, which no seams change; where there is a finest mesh, no finer ones and no
/// others than meshes and the limit window. The base comes first.
pub fn collapse(step: Option<f64>, finest: Option<usize>) -> Vec<Model> {
    let mut models: Vec<Model> =
        meshes(&MESHES[..1]).filter(|(n, _)| finest.is_none_or(|most| *n <= most)).map(|(_, model)| model).collect();
    models.push(Model {
        family: "limit window",
        name: "limit window".to_owned(),
        way: Way::LimitWindow,
        reading: Reading::Constant,
    });
    if finest.is_none() {
        models.push(accuracy("collapse_intensity", INTENSITY));
    }
    models.extend(step.map(|step| {
        let fields = json!({"method": {"fixed_steps": {"step": step}}});
        Model {
            family: "load steps",
            name: format!("steps of {step} kN"),
            way: Way::Analysis(fields),
            reading: Reading::Constant,
        }
    }));
    models
}

/// Models of a scene whose stresses are sought; the base comes first.
pub fn stress() -> Vec<Model> {
    meshes(&MESHES).map(|(_, model)| model).chain(STRESS.map(|error| accuracy("stress", error))).collect()
}

/// A mesh of the program's own choice that keeps an error of what is sought.
fn accuracy(of: &str, error: f64) -> Model {
    let way = Way::Analysis(json!({"accuracy": {of: error}}));
    Model { family: "adaptive", name: format!("asked {error:?}"), way, reading: Reading::Corners }
}

/// A family of uniform meshes.
struct Meshes {
    /// Its name, and what the name of each mesh of it ends in.
    name: &'static str,
    ending: &'static str,
    /// Subblocks each way.
    uniform: &'static [usize],
    /// What the request's `mesh` has besides them.
    fields: fn() -> Value,
    reading: Reading,
}

/// Families of uniform meshes; the first mesh of the first is the base. One subblock has no seams.
const MESHES: [Meshes; 5] = [
    Meshes {
        name: "split seams",
        ending: "",
        uniform: &UNIFORM,
        fields: || json!({"seams": "split"}),
        reading: Reading::Constant,
    },
    Meshes {
        name: "recovered",
        ending: ", recovered",
        uniform: UNIFORM.split_at(1).1,
        fields: || json!({"seams": "split"}),
        reading: Reading::Corners,
    },
    Meshes {
        name: "second order",
        ending: ", second order",
        uniform: &UNIFORM,
        fields: || json!({"order": 2}),
        reading: Reading::Corners,
    },
    Meshes {
        name: "second order, graded",
        ending: ", second order, graded",
        uniform: UNIFORM.split_at(1).1,
        fields: || json!({"order": 2, "lines": "graded"}),
        reading: Reading::Corners,
    },
    Meshes {
        name: "corner seams",
        ending: ", corner seams",
        uniform: UNIFORM.split_at(1).1,
        fields: || json!({"seams": "corners"}),
        reading: Reading::Constant,
    },
];

/// Every mesh of some families, with its subblocks each way.
fn meshes(families: &'static [Meshes]) -> impl Iterator<Item = (usize, Model)> {
    let model = |family: &Meshes, n: usize| {
        let mut mesh = (family.fields)();
        mesh["subblocks"] = json!({"uniform": {"radial": n, "along": n}});
        let way = Way::Analysis(json!({"mesh": mesh}));
        Model { family: family.name, name: format!("{n} x {n}{}", family.ending), way, reading: family.reading }
    };
    families.iter().flat_map(move |family| family.uniform.iter().map(move |&n| (n, model(family, n))))
}
