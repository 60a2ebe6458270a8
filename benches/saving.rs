//! What an accuracy saves: for every arch of `cases/`, the unknowns of the mesh that is found for an accuracy of the stress beside those
//! of the coarsest uniform mesh of the paper's constant-strain subblocks that is in truth as accurate as asked, which nobody can know.
//!
//! `cargo bench --bench saving -- [accuracy ...] [word ...]`, by default 0.1 and 0.05 in all cases; words choose those whose names
//! have one of them. The field is half-way to collapse. Its errors are those had, not estimated ones: point by point, stress being
//! bilinear between corners, against graded subblocks of second order, 16 across and as many along as make them square. How far those
//! are off, `benches/chart` tells, against finite elements. Uniform meshes are of n x n subblocks in every voussoir; where not even the
//! finest is good enough, more than that many unknowns are needed, and the saving is a lower bound.
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
    Spacing, StatesAsked, StressField, Task, run,
};
use voussoir::wire::read::read_question;

/// Subblocks across of the mesh that stands for the exact stress.
const FINE: usize = 16;
/// Uniform meshes that are tried, subblocks each way.
const UNIFORM: [usize; 5] = [2, 4, 8, 12, 16];
/// Arches with more voussoirs take long to be found exactly.
const MOST_VOUSSOIRS: usize = 33;
/// Most subblocks that a mesh is found with.
const MOST_SUBBLOCKS: usize = 5000;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    let numbers: Vec<f64> = arguments.iter().filter_map(|argument| argument.parse().ok()).collect();
    let words: Vec<&String> = arguments.iter().filter(|argument| argument.parse::<f64>().is_err()).collect();
    let accuracies = if numbers.is_empty() { vec![0.1, 0.05] } else { numbers };
    println!("case, voussoirs | asked, estimated, had | unknowns found | uniform: n x n, had, unknowns | times fewer");
    let mut ratios = vec![Vec::new(); accuracies.len()];
    for folder in folders(&cases()) {
        let case = name(&folder);
        if !(words.is_empty() || words.iter().any(|word| case.contains(word.as_str()))) {
            continue;
        }
        let request: Value = serde_json::from_slice(&std::fs::read(folder.join("request.json")).unwrap()).unwrap();
        let Some(arch) = question(request).and_then(Arch::new) else { continue };
        let uniform = arch.uniform(accuracies.iter().copied().fold(f64::INFINITY, f64::min));
        for (&asked, ratios) in accuracies.iter().zip(&mut ratios) {
            let Some(found) = arch.found(asked) else { continue };
            let enough = uniform.iter().find(|mesh| mesh.error <= asked);
            let (bound, mesh) = (if enough.is_some() { "" } else { ">" }, enough.or(uniform.last()).unwrap());
            let ratio = mesh.unknowns as f64 / found.unknowns as f64;
            let met = if found.estimate <= asked { "" } else { ", not met" };
            print!("{case:<36} {:>3} | {asked:<5} {:.4} {:.4} ", arch.voussoirs(), found.estimate, found.error);
            println!(
                "| {:>6} | {:>2} {:.4} {:>6} | {bound}{ratio:.1}{met}",
                found.unknowns, mesh.each_way, mesh.error, mesh.unknowns
            );
            // What was not reached is no saving.
            if met.is_empty() {
                ratios.push(ratio);
            }
        }
    }
    for (asked, mut ratios) in accuracies.into_iter().zip(ratios) {
        ratios.sort_by(f64::total_cmp);
        let median = ratios.get(ratios.len() / 2).copied().unwrap_or(f64::NAN);
        println!("accuracy {asked}: in the median of {} cases {median:.1} times fewer unknowns", ratios.len());
    }
}

/// What a case asks, without its mesh and what does not go with an accuracy; none where it asks for no collapse of one arch.
fn question(mut request: Value) -> Option<Analysis> {
    let body = request.as_object_mut().unwrap();
    ["mesh", "motion", "geometry", "method", "report", "accuracy"].iter().for_each(|field| drop(body.remove(*field)));
    body.insert("accuracy".into(), json!({"stress": 0.5, "subblocks": 100_000}));
    match read_question(request.to_string().as_bytes()).ok()?.1 {
        Question::One(analysis) if analysis.task.grows() => Some(*analysis),
        _ => None,
    }
}

/// The same question but for its path and its stress fields.
fn asking(analysis: &Analysis, path: Path, fields: Vec<FieldAt>) -> Option<Analysis> {
    let states = StatesAsked { fields, ..StatesAsked::default() };
    let task = match analysis.task.clone() {
        Task::Safety(task) => Task::Safety(SafetyTask { path, states, ..task }),
        Task::Collapse(task) => {
            Task::Collapse(CollapseTask { method: Method::EventPath(path), states, motion: None, ..task })
        }
        Task::Settlement(_) | Task::GeometricSafety(_) => return None,
    };
    Some(Analysis { task, ..analysis.clone() })
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
    error: f64,
}

/// An arch, and its stress half-way to collapse.
struct Arch {
    analysis: Analysis,
    exact: StressField,
}

impl Arch {
    /// None where there is no such stress.
    fn new(analysis: Analysis) -> Option<Self> {
        let voussoirs = analysis.structure.voussoirs().len();
        let joints = &analysis.structure.joints;
        if voussoirs > MOST_VOUSSOIRS || analysis.structure.spans.len() != 1 || joints.len() != voussoirs + 1 {
            return None;
        }
        let rigid = run(&asking(&analysis, Path::FirstOrder, Vec::new())?, &Budget::unlimited()).ok()?;
        let at = 0.5 * (rigid.start + rigid.end.as_ref()?.load_factor);
        let analysis = asking(&analysis, Path::FirstOrder, vec![FieldAt::LoadFactor(at)])?;
        let joints = &analysis.structure.joints;
        let square = |k: usize| {
            let [before, after] = [&joints[k], &joints[k + 1]];
            let along = (after.middle() - before.middle()).norm() / (0.5 * (before.length() + after.length()));
            [FINE, (along * FINE as f64).round().clamp(2.0, 48.0) as usize]
        };
        let fine =
            Mesh { order: Order::Second, spacing: Spacing::Graded, ..Mesh::of((0..voussoirs).map(square).collect()) };
        let exact = on_mesh(&analysis, fine)?.stress_fields.into_iter().next()?;
        Some(Arch { analysis, exact })
    }

    fn voussoirs(&self) -> usize {
        self.analysis.structure.voussoirs().len()
    }

    /// Uniform meshes from the coarsest to the first that is so accurate, or to the finest.
    fn uniform(&self, asked: f64) -> Vec<Uniform> {
        let mut tried: Vec<Uniform> = Vec::new();
        for each_way in UNIFORM {
            let meshed = Mesh::of(vec![[each_way; 2]; self.voussoirs()]);
            let unknowns = unknowns(&meshed.subblocks, meshed.order);
            let report = on_mesh(&self.analysis, meshed);
            let Some(field) = report.and_then(|report| report.stress_fields.into_iter().next()) else { continue };
            tried.push(Uniform { each_way, unknowns, error: pointwise_error(&field, &self.exact) });
            if tried.last().is_some_and(|mesh| mesh.error <= asked) {
                break;
            }
        }
        tried
    }

    /// The mesh found for an accuracy; of a half that was modelled, twice its unknowns.
    fn found(&self, asked: f64) -> Option<Found> {
        let accuracy = Accuracy { collapse_intensity: None, stress: Some(asked), most_subblocks: MOST_SUBBLOCKS };
        let analysis = asking(&self.analysis, Path::Refined(accuracy), self.analysis.task.fields().to_vec())?;
        let report = run(&analysis, &Budget::unlimited()).ok()?;
        let plan = report.plan.as_ref()?;
        let error = pointwise_error(report.stress_fields.first()?, &self.exact);
        Some(Found {
            unknowns: unknowns(&plan.subblocks, plan.order),
            estimate: plan.stress.as_ref()?.estimate?,
            error,
        })
    }
}

fn on_mesh(analysis: &Analysis, mesh: Mesh) -> Option<CollapseReport> {
    run(&Analysis { mesh, ..analysis.clone() }, &Budget::unlimited()).ok()
}

/// Unknowns of a mesh: six of every constant-strain subblock, two of every point of second-order ones, at corners and middles of sides.
fn unknowns(subblocks: &[[usize; 2]], order: Order) -> usize {
    let of = |&[n, m]: &[usize; 2]| match order {
        Order::First => 6 * n * m,
        Order::Second => 2 * ((2 * n + 1) * (2 * m + 1) - n * m),
    };
    subblocks.iter().map(of).sum()
}
