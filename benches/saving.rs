//! What an accuracy saves: for every structure of `cases/`, the unknowns of the mesh that is found for an accuracy of the stress beside those
//! of the coarsest uniform mesh of the paper's constant-strain subblocks that is in truth as accurate as asked, which nobody can know.
//!
//! `cargo bench --bench saving -- [accuracy ...] [word ...]`, by default 0.1 and 0.05 in all cases; words choose those whose names
//! have one of them. The field is half-way to collapse. Its errors are those had, not estimated ones: point by point but for what is near
//! forces on points, against graded subblocks of second order, 16 across, or 24 in bodies with such a force, and as many along as make
//! them square. How far those are off, `benches/chart` tells, against finite elements. Uniform meshes are of n x n
//! subblocks in every body, and their stress is read in two ways: constant in every subblock, as the paper has it, and bilinear between
//! corners to which it was recovered. Where not even the finest is good enough, more than that many unknowns are needed, and the saving
//! is a lower bound.
#![allow(clippy::print_stdout, clippy::disallowed_methods, clippy::unwrap_used, missing_docs)]

#[path = "../tests/it/common/mod.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod common;

use common::field::pointwise_error;
use common::folders::{cases, folders, name};
use serde_json::{Value, json};
use voussoir::budget::Budget;
use voussoir::collapse::{
    Accuracy, Analysis, CollapseReport, CollapseTask, FieldAt, Mesh, Method, Order, Path, Question, SafetyTask,
    Spacing, StatesAsked, StressField, Task, can_bend, run, subblocks_of,
};
use voussoir::structure::{ActsOn, Body};
use voussoir::wire::read::read_question;

/// Subblocks across of the mesh that stands for the exact stress, and in bodies with a force on a point.
const FINE: usize = 16;
const LOADED: usize = 24;
/// Uniform meshes that are tried, subblocks each way.
const UNIFORM: [usize; 7] = [2, 4, 8, 12, 16, 24, 32];
/// Structures with more bodies, or so many subblocks in the fine mesh, take long to be found exactly.
const MOST_BODIES: usize = 33;
const MOST_FINE: usize = 10_000;
/// Most subblocks that a mesh is found with.
const MOST_SUBBLOCKS: usize = 5000;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    let numbers: Vec<f64> = arguments.iter().filter_map(|argument| argument.parse().ok()).collect();
    let words: Vec<&String> = arguments.iter().filter(|argument| argument.parse::<f64>().is_err()).collect();
    let accuracies = if numbers.is_empty() { vec![0.1, 0.05] } else { numbers };
    println!(
        "case, bodies | asked, estimated, had | unknowns | uniform, constant in subblocks, then recovered: n x n, had, times"
    );
    let mut ratios = vec![[Vec::new(), Vec::new()]; accuracies.len()];
    for folder in folders(&cases()) {
        let case = name(&folder);
        if !(words.is_empty() || words.iter().any(|word| case.contains(word.as_str()))) {
            continue;
        }
        let request: Value = serde_json::from_slice(&std::fs::read(folder.join("request.json")).unwrap()).unwrap();
        let scene = match question(request).and_then(Scene::new) {
            Ok(scene) => scene,
            Err(why) => {
                println!("{case:<36} left out: {why}");
                continue;
            }
        };
        let uniform = scene.uniform(accuracies.iter().copied().fold(f64::INFINITY, f64::min));
        for (&asked, ratios) in accuracies.iter().zip(&mut ratios) {
            let found = match scene.found(asked) {
                Ok(found) => found,
                Err(why) => {
                    println!("{case:<36} {asked} left out: {why}");
                    continue;
                }
            };
            let met = if found.estimate <= asked { "" } else { ", not met" };
            print!("{case:<36} {:>3} | {asked:<5} {:.4} {:.4} ", scene.bodies(), found.estimate, found.error);
            print!("| {:>6}", found.unknowns);
            for (reading, ratios) in ratios.iter_mut().enumerate() {
                let enough = uniform.iter().find(|mesh| mesh.errors[reading] <= asked);
                let (bound, mesh) = (if enough.is_some() { "" } else { ">" }, enough.or(uniform.last()).unwrap());
                let ratio = mesh.unknowns as f64 / found.unknowns as f64;
                print!(" | {:>2} {:.4} {bound}{ratio:.1}", mesh.each_way, mesh.errors[reading]);
                // What was not reached is no saving.
                if met.is_empty() {
                    ratios.push(ratio);
                }
            }
            println!("{met}");
        }
    }
    for (asked, ratios) in accuracies.into_iter().zip(ratios) {
        let medians = ratios.each_ref().map(|ratios| median(ratios.clone()));
        println!(
            "accuracy {asked}: in the median of {} cases {:.1} times fewer unknowns, {:.1} with recovered stress",
            ratios[0].len(),
            medians[0],
            medians[1]
        );
    }
}

fn median(mut of: Vec<f64>) -> f64 {
    of.sort_by(f64::total_cmp);
    of.get(of.len() / 2).copied().unwrap_or(f64::NAN)
}

/// What a case asks, without its mesh and what does not go with an accuracy; or why not.
fn question(mut request: Value) -> Result<Analysis, String> {
    let body = request.as_object_mut().unwrap();
    ["mesh", "motion", "geometry", "method", "report", "accuracy"].iter().for_each(|field| drop(body.remove(*field)));
    body.insert("accuracy".into(), json!({"stress": 0.5, "subblocks": 100_000}));
    match read_question(request.to_string().as_bytes()) {
        Ok((_, Question::One(analysis))) => Ok(*analysis),
        Ok(_) => Err("it has several answers".into()),
        Err(faults) => Err(format!("{faults:?}")),
    }
}

/// The same question but for its path and its stress fields.
fn asking(analysis: &Analysis, path: Path, fields: Vec<FieldAt>) -> Result<Analysis, String> {
    let states = StatesAsked { fields, ..StatesAsked::default() };
    let task = match analysis.task.clone() {
        Task::Safety(task) => Task::Safety(SafetyTask { path, states, ..task }),
        Task::Collapse(task) => {
            Task::Collapse(CollapseTask { method: Method::EventPath(path), states, motion: None, ..task })
        }
        Task::Settlement(_) | Task::GeometricSafety(_) => return Err("no load grows".into()),
    };
    Ok(Analysis { task, ..analysis.clone() })
}

/// A mesh that was found.
struct Found {
    unknowns: usize,
    estimate: f64,
    error: f64,
}

/// A uniform mesh.
struct Uniform {
    each_way: usize,
    unknowns: usize,
    /// Of stress that is constant in subblocks, and bilinear between their corners.
    errors: [f64; 2],
}

/// A structure, and its stress half-way to collapse.
struct Scene {
    analysis: Analysis,
    exact: StressField,
}

impl Scene {
    /// Or why there is no such stress.
    fn new(analysis: Analysis) -> Result<Self, String> {
        let bodies = analysis.structure.voussoirs();
        let loaded = |body: usize| {
            let mut forces = analysis.fixed.iter().chain(&analysis.scaled);
            forces.any(|force| force.body == body && force.acts_on == ActsOn::Point)
        };
        let fine = |(k, body): (usize, &Body)| square(body, if loaded(k) { LOADED } else { FINE });
        let fine = bodies.iter().enumerate().map(fine).collect::<Result<Vec<_>, _>>()?;
        let count: usize = fine.iter().map(|[radial, along]| radial * along).sum();
        if bodies.len() > MOST_BODIES || count > MOST_FINE {
            return Err(format!("{} bodies, of {count} subblocks in the fine mesh", bodies.len()));
        }
        let rigid = solved(&asking(&analysis, Path::FirstOrder, Vec::new())?)?;
        let end = rigid.end.as_ref().ok_or(format!("{:?}", rigid.outcome))?;
        let at = 0.5 * (rigid.start + end.load_factor);
        let half_way = asking(&analysis, Path::FirstOrder, vec![FieldAt::LoadFactor(at)])?;
        let mesh = Mesh { order: Order::Second, spacing: Spacing::Graded, ..Mesh::of(fine) };
        let exact = on_mesh(&half_way, mesh)?;
        Ok(Scene { analysis: half_way, exact })
    }

    fn bodies(&self) -> usize {
        self.analysis.structure.voussoirs().len()
    }

    /// Uniform meshes from the coarsest to the first that is so accurate, or to the finest.
    fn uniform(&self, asked: f64) -> Vec<Uniform> {
        let mut tried: Vec<Uniform> = Vec::new();
        for each_way in UNIFORM {
            let bodies = self.analysis.structure.voussoirs().iter();
            let subblocks: Option<Vec<_>> =
                bodies.map(|body| subblocks_of(body, [each_way; 2], Order::First)).collect();
            let Some(meshed) = subblocks.map(Mesh::of) else { continue };
            let unknowns = unknowns(&meshed.subblocks, meshed.order);
            let Ok(field) = on_mesh(&self.analysis, meshed) else { continue };
            let errors = [constant(&field), field].map(|field| pointwise_error(&self.analysis, &field, &self.exact));
            tried.push(Uniform { each_way, unknowns, errors });
            if errors.iter().all(|&error| error <= asked) {
                break;
            }
        }
        tried
    }

    /// The mesh found for an accuracy; of a half that was modelled, twice its unknowns.
    fn found(&self, asked: f64) -> Result<Found, String> {
        let accuracy = Accuracy { collapse_intensity: None, stress: Some(asked), most_subblocks: MOST_SUBBLOCKS };
        let analysis = asking(&self.analysis, Path::Refined(accuracy), self.analysis.task.fields().to_vec())?;
        let report = solved(&analysis)?;
        let plan = report.plan.as_ref().ok_or("no plan")?;
        let estimate = plan.stress.and_then(|stress| stress.estimate);
        let field = report.stress_fields.first().ok_or(format!("{:?}, no field", report.outcome))?;
        Ok(Found {
            unknowns: unknowns(&plan.subblocks, plan.order),
            estimate: estimate.ok_or(format!("no estimate: {:?}", plan.why))?,
            error: pointwise_error(&self.analysis, field, &self.exact),
        })
    }
}

/// The fine mesh of a body: square subblocks in one of four sides.
fn square(body: &Body, across: usize) -> Result<[usize; 2], String> {
    let apart = |a: usize, b: usize| (body.corners[b] - body.corners[a]).norm();
    let along = match body.corners.len() {
        4 => (apart(0, 1) + apart(2, 3)) / (apart(0, 3) + apart(1, 2)),
        _ => 1.0,
    };
    // An even number: a line goes through a force in the middle of a side, too.
    let wanted = [across, 2 * (0.5 * along * across as f64).round().clamp(1.0, 24.0) as usize];
    let subblocks = subblocks_of(body, wanted, Order::Second).filter(|_| can_bend(body));
    subblocks.ok_or("a body cannot be of second order".into())
}

fn solved(analysis: &Analysis) -> Result<CollapseReport, String> {
    run(analysis, &Budget::unlimited()).map_err(|error| error.to_string())
}

fn on_mesh(analysis: &Analysis, mesh: Mesh) -> Result<StressField, String> {
    let report = solved(&Analysis { mesh, ..analysis.clone() })?;
    let field = report.stress_fields.into_iter().next();
    field.ok_or(format!("{:?}, the path passes no half-way", report.outcome))
}

/// The same field, constant in every subblock.
fn constant(field: &StressField) -> StressField {
    let mut field = field.clone();
    for subblock in &mut field.subblocks {
        subblock.corner_stress = vec![subblock.stress; subblock.corners.len()];
    }
    field
}

/// Unknowns of a mesh: six of every constant-strain subblock, two of every point of second-order ones, at corners and middles of sides.
fn unknowns(subblocks: &[[usize; 2]], order: Order) -> usize {
    let of = |&[n, m]: &[usize; 2]| match order {
        Order::First => 6 * n * m,
        Order::Second => 2 * ((2 * n + 1) * (2 * m + 1) - n * m),
    };
    subblocks.iter().map(of).sum()
}
