//! States on a refined mesh, solved for one by one, against those on the path that is followed on the same mesh.

use crate::common::largest::larger;
use crate::common::rigid_blocks::{portal, scene::Scene};
use crate::common::snapshots::apart;
use crate::common::structures::{self, FAMILIES};
use crate::common::{door, random_arch};
use serde_json::json;
use voussoir::budget::Budget;
use voussoir::collapse::{
    Accuracy, Analysis, CollapseReport, CollapseTask, FieldAt, Mesh, Method, Path, PlanReason, Snapshot, StatesAsked,
    Task, run,
};
use voussoir::structure::Joint;

/// How many random arches, and how many of them at least have to ask a question.
const ARCHES: u64 = 400;
const ASKED: usize = 55;
/// How many random bridges and portals, and how many of them at least have to ask a question; of walls none does.
const STRUCTURES: u64 = 12;
const ASKED_OF_STRUCTURES: usize = 3;
/// Random portals that slide, and whose paths are followed on their meshes.
const PORTALS: [u64; 4] = [3, 9, 12, 13];
/// Largest difference of a contact's force, over the largest, before and near collapse, where a state follows its load a thousandfold.
const EQUAL: [f64; 2] = [1e-9, 1e-6];
const FOLLOWS: f64 = 2e3;

/// The same question, with the path followed on the mesh that was chosen.
fn on_path(analysis: &Analysis, chosen: &CollapseReport) -> CollapseReport {
    let mut analysis = analysis.clone();
    let plan = chosen.plan.as_ref().unwrap();
    analysis.mesh = Mesh { order: plan.order, spacing: plan.spacing, ..Mesh::of(plan.subblocks.clone()) };
    let Task::Collapse(task) = &analysis.task else { unreachable!() };
    let states = StatesAsked { fields: task.states.fields.clone(), history: true, ..task.states };
    analysis.task = Task::Collapse(CollapseTask { method: Method::default(), states, ..*task });
    run(&analysis, &Budget::unlimited()).unwrap()
}

/// States that were held against those on the path.
#[derive(Debug, Default)]
struct Compared {
    /// How many answers have states solved for one by one, and how many were refined along a path.
    asked: usize,
    followed: usize,
    /// The largest difference at the start, at load factor 1 and near collapse.
    worst: [f64; 3],
}

impl Compared {
    /// Holds the states of one answer against those of the path on the mesh that it chose.
    fn compare(&mut self, name: &str, analysis: &Analysis) {
        let report = run(analysis, &Budget::unlimited()).unwrap();
        let plan = report.plan.as_ref().unwrap();
        let cohesive = |joint: &Joint| joint.law.coulomb().is_some_and(|[_, cohesion]| cohesion > 0.0);
        if analysis.structure.ring().iter().any(cohesive) {
            // Such joints slide otherwise on another mesh, so whole stones have another load.
            assert!(!plan.why.contains(&PlanReason::StatesOneByOne), "{name}");
        }
        if !plan.why.contains(&PlanReason::StatesOneByOne) {
            self.followed += usize::from(plan.subblocks.iter().any(|&subblocks| subblocks != [1, 1]));
            return;
        }
        assert!(report.history.is_empty() && report.crushing.elastic.is_none());
        // What was modelled as a half has other contacts in its plane of symmetry.
        if plan.half {
            return;
        }
        let path = on_path(analysis, &report);
        assert_eq!(report.outcome, path.outcome, "{name}");
        let states = |report: &CollapseReport| {
            [&report.at_start, &report.at_unit_load, &report.near_collapse]
                .map(|state: &Option<Snapshot>| state.clone())
        };
        for (k, (a, b)) in states(&report).iter().zip(&states(&path)).enumerate() {
            let (Some(a), Some(b)) = (a, b) else {
                assert_eq!(a.is_some(), b.is_some(), "{name}: state {k}");
                continue;
            };
            let apart = apart(a, b);
            self.worst[k] = larger(self.worst[k], apart);
            let loads_apart = (a.load_factor - b.load_factor).abs() / b.load_factor.abs().max(f64::MIN_POSITIVE);
            let equal = EQUAL[usize::from(k == 2)] + FOLLOWS * loads_apart;
            assert!(apart < equal, "{name}, state {k}: {apart} at loads {loads_apart} apart");
        }
        self.asked += 1;
    }
}

/// A random arch that is asked for stress; none where it cannot be, or has very many stones.
fn arch(seed: u64) -> Option<Analysis> {
    let mut request = random_arch::request(seed);
    request["accuracy"] = json!({"stress": 0.3, "subblocks": 600});
    door::analysis(&request).ok().filter(|analysis| analysis.structure.bodies.len() <= 40)
}

#[test]
fn they_are_the_states_on_the_path() {
    let mut compared = Compared::default();
    for (seed, analysis) in (0..ARCHES).filter_map(|seed| Some((seed, arch(seed)?))) {
        compared.compare(&format!("seed {seed}"), &analysis);
    }
    println!("{compared:?}");
    assert!(compared.asked >= ASKED, "{compared:?}");
}

#[test]
fn where_there_are_others_the_path_tells_which() {
    // Of the first two a whole joint has slid at the start; of the others a stone is free to turn near collapse.
    for seed in [469, 4077, 4767, 12830] {
        let report = run(&arch(seed).unwrap(), &Budget::unlimited()).unwrap();
        let plan = report.plan.unwrap();
        assert!(plan.subblocks.iter().all(|&subblocks| subblocks != [1, 1]), "seed {seed}");
        assert!(!plan.why.contains(&PlanReason::StatesOneByOne), "seed {seed}: {:?}", plan.why);
    }
}

/// A random structure that is asked for stress.
fn structure(scene: &Scene) -> Analysis {
    let mut analysis = structures::analysis(scene);
    let accuracy = Accuracy { collapse_intensity: None, stress: Some(0.3), most_subblocks: 600 };
    let states = StatesAsked { fields: vec![FieldAt::NearCollapse], ..StatesAsked::default() };
    let method = Method::EventPath(Path::Refined(accuracy));
    analysis.task = Task::Collapse(CollapseTask { method, states, ..CollapseTask::default() });
    analysis
}

#[test]
fn so_they_are_in_any_structure() {
    let mut compared = Compared::default();
    for (family, scene) in FAMILIES.into_iter().filter(|(family, _)| *family != "walls") {
        for seed in 0..STRUCTURES {
            compared.compare(&format!("{family} {seed}"), &structure(&scene(seed)));
        }
    }
    println!("{compared:?}");
    assert!(compared.asked >= ASKED_OF_STRUCTURES, "{compared:?}");
}

/// Where joints slide it is that of rigid stones: it is not looked for once more on a mesh, where others may be found.
#[test]
fn the_least_load_is_taken_from_whole_stones() {
    for seed in PORTALS {
        let asked = structure(&portal::random(seed));
        let of_whole_stones = Analysis { task: Task::Collapse(CollapseTask::default()), ..asked.clone() };
        let [on_mesh, whole] = [&asked, &of_whole_stones].map(|analysis| run(analysis, &Budget::unlimited()).unwrap());
        let plan = on_mesh.plan.as_ref().unwrap();
        let on_path = !plan.why.contains(&PlanReason::StatesOneByOne) && !plan.subblocks.contains(&[1, 1]);
        assert!(on_path, "portal {seed}: {:?}", plan.why);
        let [on_mesh, whole] = [on_mesh, whole].map(|report| {
            let end = report.end.unwrap();
            (end.load_factor, end.range.unwrap().mechanisms_tried)
        });
        assert_eq!(on_mesh, whole, "portal {seed}");
    }
}
