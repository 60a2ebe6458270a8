//! What an accuracy saves: for every case of `cases/`, the mesh that is found for an accuracy of the stress beside two uniform
//! ones: the coarsest that is in truth as accurate, which nobody can know, and the first of 4 x 4, 8 x 8, ... that is as accurate by an
//! estimate of the same kind, which is what one would choose without looking further.
//!
//! `cargo bench --bench saving -- [accuracy ...] [word ...]`, by default 0.1 and 0.05 in all cases; words choose those whose names
//! have one of them. An arch's field is half-way to collapse, its exact stress
//! that of 24 subblocks across and as many along as make them square; the curved beam's is that of the theory of elasticity.
//! Accuracies are those had, not estimated ones. Uniform meshes are of n x n subblocks in every voussoir of the whole arch.
#![allow(clippy::print_stdout, clippy::disallowed_methods, clippy::unwrap_used, missing_docs)]

#[path = "../tests/it/common/mod.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod common;

use common::field::error;
use common::folders::{cases, folders, name};
use serde_json::{Value, json};
use std::time::Instant;
use voussoir::budget::Budget;
use voussoir::collapse::{
    Accuracy, Analysis, Answer, BeamReport, CollapseReport, CollapseTask, CurvedBeam, FieldAt, Method, Path, Question,
    SafetyTask, StatesAsked, StressField, Task, answer, run,
};
use voussoir::wire::read::read_question;

/// Subblocks across of the mesh that stands for the exact stress.
const FINE: usize = 24;
/// Uniform meshes that are tried.
const UNIFORM: [usize; 11] = [2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16];
/// Arches with more voussoirs take long to be found exactly.
const MOST_VOUSSOIRS: usize = 61;

/// A mesh and what came of it.
#[derive(Clone, Copy)]
struct Tried {
    subblocks: usize,
    error: f64,
    seconds: f64,
}

/// Orders of convergence that an estimate counts on, as in the program.
const ORDERS: [f64; 2] = [0.4, 1.0];

fn main() {
    let numbers = std::env::args().skip(1).filter_map(|argument| argument.parse::<f64>().ok()).collect::<Vec<_>>();
    let arguments = std::env::args().skip(1).filter(|argument| !argument.starts_with("--"));
    let words: Vec<String> = arguments.filter(|argument| argument.parse::<f64>().is_err()).collect();
    let accuracies = if numbers.is_empty() { vec![0.1, 0.05] } else { numbers };
    println!("case, voussoirs | asked, estimated, had | found: subblocks, s | as accurate: subblocks, s | times fewer");
    println!("  | known to be: subblocks, s | times fewer");
    let mut ratios = vec![[Vec::new(), Vec::new()]; accuracies.len()];
    for folder in folders(&cases()) {
        let request: Value = serde_json::from_slice(&std::fs::read(folder.join("request.json")).unwrap()).unwrap();
        let case = name(&folder);
        if !(words.is_empty() || words.iter().any(|word| case.contains(word.as_str()))) {
            continue;
        }
        let scene = match question(request) {
            Some(Question::One(analysis)) => Arch::new(*analysis).map(|arch| Scene::Arch(Box::new(arch))),
            Some(Question::CurvedBeam(beam)) => Some(Scene::Beam(beam)),
            _ => None,
        };
        let Some(scene) = scene else { continue };
        let uniform: Vec<Tried> = UNIFORM.iter().filter_map(|&n| scene.uniform(n)).collect();
        for (&asked, ratios) in accuracies.iter().zip(&mut ratios) {
            let Some((found, estimate)) = scene.found(asked) else { continue };
            let same = uniform.iter().find(|uniform| uniform.error <= found.error);
            let known = scene.known(estimate.max(asked));
            print!("{case:<36} {:>3} | {asked:<5} {estimate:.4} {:.4} ", scene.voussoirs(), found.error);
            print!("| {:>5} {:>8.4} ", found.subblocks, found.seconds);
            for (uniform, ratios) in [same.copied(), known].into_iter().zip(ratios) {
                let ratio = uniform.map_or(f64::INFINITY, |uniform| uniform.subblocks as f64 / found.subblocks as f64);
                match uniform {
                    Some(uniform) => print!("| {:>5} {:>8.4} | {ratio:>5.2} ", uniform.subblocks, uniform.seconds),
                    None => print!("| none         | more "),
                }
                // What was not reached is no saving, and of what no uniform mesh reaches none is known.
                if estimate <= asked && ratio.is_finite() {
                    ratios.push(ratio);
                }
            }
            println!();
        }
    }
    for (asked, kinds) in accuracies.into_iter().zip(ratios) {
        for (mut ratios, than) in kinds.into_iter().zip(["as accurate", "known to be as accurate"]) {
            ratios.sort_by(f64::total_cmp);
            let (median, count) = (ratios.get(ratios.len() / 2).copied().unwrap_or(f64::NAN), ratios.len());
            println!(
                "accuracy {asked}: in the median of {count} cases {median:.2} times fewer subblocks than in one {than}"
            );
        }
    }
}

/// What a case asks, without its mesh and what does not go with an accuracy; none where it asks for no stress that could be had.
fn question(mut request: Value) -> Option<Question> {
    let body = request.as_object_mut().unwrap();
    ["mesh", "motion", "geometry", "method", "report", "accuracy"].iter().for_each(|field| drop(body.remove(*field)));
    if body.get("analysis").is_some_and(|analysis| analysis.get("settlement").is_some()) {
        return None;
    }
    let accuracy = if body.contains_key("curved_beam") {
        json!({"stress": 0.5})
    } else {
        json!({"stress": 0.5, "subblocks": 100_000})
    };
    body.insert("accuracy".into(), accuracy);
    read_question(request.to_string().as_bytes()).ok().map(|(_, question)| question)
}

/// The same question but for its path, its stress fields and, where one is given, its cap.
fn asking(analysis: &Analysis, path: Path, fields: Vec<FieldAt>, cap: Option<f64>) -> Analysis {
    let states = StatesAsked { fields, ..StatesAsked::default() };
    let task = match analysis.task.clone() {
        Task::Safety(task) => Task::Safety(SafetyTask { path, states, cap: cap.or(task.cap), ..task }),
        Task::Collapse(task) => {
            let (cap, method) = (cap.or(task.cap), Method::EventPath(path));
            Task::Collapse(CollapseTask { cap, method, states, ..task })
        }
        task => task,
    };
    Analysis { task, ..analysis.clone() }
}

enum Scene {
    Arch(Box<Arch>),
    Beam(CurvedBeam),
}

impl Scene {
    fn voussoirs(&self) -> usize {
        if let Scene::Arch(arch) = self { arch.analysis.structure.voussoirs().len() } else { 1 }
    }

    fn uniform(&self, n: usize) -> Option<Tried> {
        match self {
            Scene::Arch(arch) => {
                let (report, seconds) = arch.on_mesh(vec![[n, n]; self.voussoirs()]);
                let error = error(report.stress_fields.first()?, &arch.exact);
                Some(Tried { subblocks: n * n * self.voussoirs(), error, seconds })
            }
            Scene::Beam(beam) => {
                let (report, seconds) = solve(&CurvedBeam { subblocks: [n, n], accuracy: None, ..*beam });
                Some(Tried { subblocks: n * n, error: report.error, seconds })
            }
        }
    }

    /// The first uniform mesh of an arch, each halving the subblocks of the one before, that is estimated to be so accurate.
    fn known(&self, asked: f64) -> Option<Tried> {
        let Scene::Arch(arch) = self else { return None };
        let (mut coarse, mut change, mut all) = (None::<StressField>, None::<f64>, 0.0);
        for n in [2, 4, 8, 16] {
            let (report, seconds) = arch.on_mesh(vec![[n, n]; self.voussoirs()]);
            let fine = report.stress_fields.into_iter().next()?;
            all += seconds;
            if let Some(coarse) = &coarse {
                let now = error(coarse, &fine);
                let order = change.map_or(ORDERS[0], |before| (before / now).log2().clamp(ORDERS[0], ORDERS[1]));
                if now / (order.exp2() - 1.0) <= asked {
                    return Some(Tried { subblocks: n * n * self.voussoirs(), error: now, seconds: all });
                }
                change = Some(now);
            }
            coarse = Some(fine);
        }
        None
    }

    /// The mesh found, and the error it is estimated to have.
    fn found(&self, asked: f64) -> Option<(Tried, f64)> {
        match self {
            Scene::Arch(arch) => arch.found(asked),
            Scene::Beam(beam) => {
                let (report, seconds) = solve(&CurvedBeam { accuracy: Some(asked), ..*beam });
                let plan = report.plan?;
                let subblocks = plan.meshes.last()?.subblocks;
                Some((Tried { subblocks, error: report.error, seconds }, plan.stress.estimate?))
            }
        }
    }
}

fn solve(beam: &CurvedBeam) -> (BeamReport, f64) {
    let start = Instant::now();
    match answer(&Question::CurvedBeam(beam.clone()), &Budget::unlimited()) {
        Ok(Answer::CurvedBeam(report)) => (report, start.elapsed().as_secs_f64()),
        other => panic!("{other:?}"),
    }
}

struct Arch {
    analysis: Analysis,
    exact: StressField,
}

impl Arch {
    /// The arch half-way to collapse; none where it has no stress there.
    fn new(analysis: Analysis) -> Option<Self> {
        let voussoirs = analysis.structure.voussoirs().len();
        let mut analysis = asking(&analysis, Path::FirstOrder, Vec::new(), None);
        let rigid = run(&analysis, &Budget::unlimited()).ok()?;
        let collapse = rigid.end.as_ref().map_or(2.0, |end| end.load_factor);
        let at = 0.5 * (rigid.start + collapse);
        if rigid.at_start.is_none() || voussoirs > MOST_VOUSSOIRS {
            return None;
        }
        let here = || vec![FieldAt::LoadFactor(at)];
        analysis = asking(&analysis, Path::FirstOrder, here(), None);
        let square = |k: usize| {
            let [before, after] = [&analysis.structure.joints[k], &analysis.structure.joints[k + 1]];
            let along = (after.middle() - before.middle()).norm() / (0.5 * (before.length() + after.length()));
            [FINE, (along * FINE as f64).round().clamp(1.0, 48.0) as usize]
        };
        let fine: Vec<_> = (0..voussoirs).map(square).collect();
        let cap = 1.0001 * at.abs().max(rigid.start.abs());
        let up_to_there = asking(&analysis, Path::FirstOrder, here(), Some(cap));
        let exact = Arch {
            analysis: up_to_there,
            exact: StressField { load_factor: at, subblocks: Vec::new(), roughness: Vec::new() },
        };
        let exact = exact.on_mesh(fine).0.stress_fields.into_iter().next()?;
        Some(Arch { analysis, exact })
    }

    fn on_mesh(&self, subblocks: Vec<[usize; 2]>) -> (CollapseReport, f64) {
        let mut analysis = self.analysis.clone();
        analysis.mesh.subblocks = subblocks;
        let start = Instant::now();
        (run(&analysis, &Budget::unlimited()).unwrap(), start.elapsed().as_secs_f64())
    }

    fn found(&self, asked: f64) -> Option<(Tried, f64)> {
        let accuracy = Accuracy { collapse_intensity: None, stress: Some(asked), most_subblocks: 5000 };
        let fields = self.analysis.task.fields().to_vec();
        let analysis = asking(&self.analysis, Path::Refined(accuracy), fields, None);
        let start = Instant::now();
        let report = run(&analysis, &Budget::unlimited()).unwrap();
        let (seconds, plan) = (start.elapsed().as_secs_f64(), report.plan?);
        let (subblocks, error) = (plan.meshes.last()?.subblocks, error(report.stress_fields.first()?, &self.exact));
        Some((Tried { subblocks, error, seconds }, plan.stress?.estimate?))
    }
}
