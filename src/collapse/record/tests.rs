use super::*;
use crate::arch::{assemble, straight_voussoirs};
use crate::budget::Budget;
use crate::collapse::discretise::Discretisation;
use crate::collapse::path::Attempt;
use crate::collapse::{CollapseTask, StatesAsked, Task};
use crate::geometry::Vec2;
use crate::structure::{ActsOn, JointLaw, PointForce, Stone};

/// A semicircle of so many stones with a load on one, of which the state at this share of the way to collapse is asked for.
fn arch(stones: usize, share: f64) -> Analysis {
    let ends: Vec<[Vec2; 2]> = (0..=stones)
        .map(|k| (std::f64::consts::PI * (1.0 - k as f64 / stones as f64)).sin_cos())
        .map(|(sin, cos)| [9.0, 11.0].map(|radius| radius * Vec2::new(cos, sin)))
        .collect();
    let law = JointLaw::Dry { friction: 0.6, cohesion: 0.0 };
    let structure = assemble(&ends, straight_voussoirs(&ends).unwrap(), Stone::default(), law);
    let at = structure.bodies[1].region.centroid;
    let scaled = vec![PointForce { body: 1, at, force: Vec2::new(0.0, -1e3), acts_on: ActsOn::Body }];
    let states = StatesAsked { share, ..StatesAsked::default() };
    let task = Task::Collapse(CollapseTask { states, ..CollapseTask::default() });
    Analysis { task, ..Analysis::new(structure, Vec::new(), scaled) }
}

#[test]
fn a_path_of_many_events_keeps_few_points_and_finds_the_state_asked_for() {
    let (analysis, budget) = (arch(5, 0.25), Budget::unlimited());
    let mut built = Discretisation::new(&budget);
    let model = built.model(&analysis, Attempt::number(0)).unwrap();
    let most = most_kept(0.25, model.assembly.contacts().len());
    let mut recorder = Recorder::new(model, &analysis, None, [0.0, 1.0]);
    // On the way every node moves in proportion to the load.
    let displacements = |load_factor: f64| vec![1e-6 * load_factor; model.assembly.node_unknowns()];
    let events = 100 * most;
    for event in 0..=events {
        let load_factor = event as f64;
        recorder.see(load_factor, &displacements(load_factor), 1e-6 * load_factor);
        assert!(recorder.recent.len() <= most, "event {event}: {} points", recorder.recent.len());
    }
    // What was given up is used again.
    assert!(recorder.recent.len() + recorder.spare.len() <= most + 2);
    let (load_factor, found) = recorder.near(events as f64).unwrap();
    assert_eq!(load_factor, 0.25 * events as f64);
    let off = found.iter().zip(displacements(load_factor)).map(|(found, there)| (found - there).abs());
    assert!(off.fold(0.0, f64::max) < 1e-12 * load_factor);
}
