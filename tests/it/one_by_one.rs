//! States on a refined mesh, solved for one by one, against those on the path that is followed on the same mesh.

use crate::common::largest::larger;
use crate::common::{door, random_arch};
use serde_json::json;
use voussoir::budget::Budget;
use voussoir::collapse::{
    Analysis, CollapseReport, CollapseTask, Mesh, Method, PlanReason, Snapshot, StatesAsked, Task, run,
};
use voussoir::structure::Joint;

/// How many random arches, and how many of them at least have to ask a question.
const ARCHES: u64 = 600;
const ASKED: usize = 60;
/// Largest difference of a contact's force, over the largest; so near collapse a state follows its load a thousandfold.
const EQUAL: [f64; 2] = [1e-9, 1e-6];

/// Largest difference of a contact's force over the largest, and of a stone's displacement over the largest.
fn apart(a: &Snapshot, b: &Snapshot) -> f64 {
    assert_eq!((a.contacts.len(), a.blocks.len()), (b.contacts.len(), b.blocks.len()));
    let most = b.contacts.iter().map(|contact| contact.normal).fold(0.0, f64::max);
    let far = b.blocks.iter().map(|block| block.displacement.norm()).fold(0.0, f64::max);
    let forces = a.contacts.iter().zip(&b.contacts);
    let forces = forces.map(|(a, b)| (a.normal - b.normal).hypot(a.tangential - b.tangential) / most);
    let blocks = a.blocks.iter().zip(&b.blocks).map(|(a, b)| (a.displacement - b.displacement).norm() / far);
    forces.chain(blocks).fold(0.0, larger)
}

/// The same question, with the path followed on the mesh that was chosen.
fn on_path(analysis: &Analysis, chosen: &CollapseReport) -> CollapseReport {
    let mut analysis = analysis.clone();
    let plan = chosen.plan.as_ref().unwrap();
    analysis.mesh = Mesh { order: plan.order, spacing: plan.spacing, ..Mesh::of(plan.subblocks.clone()) };
    let Task::Collapse(task) = &analysis.task else { unreachable!() };
    let states = StatesAsked { fields: task.states.fields.clone(), ..task.states };
    analysis.task = Task::Collapse(CollapseTask { method: Method::default(), states, ..*task });
    run(&analysis, &Budget::unlimited()).unwrap()
}

#[test]
fn they_are_the_states_on_the_path() {
    let (mut asked, mut followed, mut worst) = (0, 0, [0f64; 3]);
    for seed in 0..ARCHES {
        let mut request = random_arch::request(seed);
        request["accuracy"] = json!({"stress": 0.3, "subblocks": 600});
        let Some(analysis) = door::analysis(&request).ok().filter(|analysis| analysis.structure.bodies.len() <= 40)
        else {
            continue;
        };
        let report = run(&analysis, &Budget::unlimited()).unwrap();
        let plan = report.plan.as_ref().unwrap();
        let cohesive = |joint: &Joint| joint.law.coulomb().is_some_and(|[_, cohesion]| cohesion > 0.0);
        if analysis.structure.ring().iter().any(cohesive) {
            // Such joints slide otherwise on another mesh, so whole stones have another load.
            assert!(!plan.why.contains(&PlanReason::StatesOneByOne), "seed {seed}");
        }
        if !plan.why.contains(&PlanReason::StatesOneByOne) {
            followed += usize::from(plan.subblocks.iter().any(|&subblocks| subblocks != [1, 1]));
            continue;
        }
        assert!(report.history.is_empty() && report.crushing.elastic.is_none());
        // What was modelled as a half has other contacts in its plane of symmetry.
        if plan.half {
            continue;
        }
        let path = on_path(&analysis, &report);
        assert_eq!(report.outcome, path.outcome, "seed {seed}");
        let states = |report: &CollapseReport| {
            [&report.at_start, &report.at_unit_load, &report.near_collapse]
                .map(|state: &Option<Snapshot>| state.clone())
        };
        for (k, (a, b)) in states(&report).iter().zip(&states(&path)).enumerate() {
            let (Some(a), Some(b)) = (a, b) else {
                assert_eq!(a.is_some(), b.is_some(), "seed {seed}: state {k}");
                continue;
            };
            let apart = apart(a, b);
            worst[k] = larger(worst[k], apart);
            assert!(apart < EQUAL[usize::from(k == 2)], "seed {seed}, state {k}: {apart}");
        }
        asked += 1;
    }
    println!(
        "{asked} arches, {followed} more whose path was followed on the mesh; at the start, at load factor 1, near collapse {worst:?}"
    );
    assert!(asked >= ASKED, "{asked} arches");
}
