//! The paper-like reading of the load path, held against the exact one.

use serde_json::{Value, json};
use std::path::Path;
use voussoir::budget::Budget;
use voussoir::collapse::{AnalysisError, CollapseReport, Note, run};
use voussoir::wire::read::read_analysis;

fn case(name: &str, change: impl Fn(&mut Value)) -> Result<CollapseReport, AnalysisError> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name).join("request.json");
    let mut request: Value = serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap();
    change(&mut request);
    let (_, analysis) = read_analysis(&serde_json::to_vec(&request).unwrap()).unwrap();
    run(&analysis, &Budget::unlimited())
}

fn steps(step: f64, opening: f64) -> impl Fn(&mut Value) {
    move |r| r["method"] = json!({"fixed_steps": {"step": step, "opening_m": opening, "hinges": 3}})
}

#[test]
fn without_large_openings_the_load_is_the_first_step_past_the_exact_one() {
    // Case 1 of the paper at its own step of 5 kN/m; an opening of 1 m is never met on the way.
    for (name, load) in [("9", 250.0), ("17", 205.0), ("27", 205.0), ("61", 205.0)] {
        let report = case(&format!("paper/table-2/{name}-joints"), steps(5.0, 1.0)).unwrap();
        assert_eq!(report.end.as_ref().unwrap().load_factor, load, "{name} joints");
        assert!(report.near_collapse.is_some() && report.notes.iter().any(|n| matches!(n, Note::ReadAtSteps { .. })));
    }
}

#[test]
fn openings_stop_the_path_at_the_step_that_shows_them() {
    let exact = case("first-arch", |_| {}).unwrap().end.unwrap().load_factor;
    let early = case("first-arch", steps(5.0, 1e-3)).unwrap();
    let found = early.end.as_ref().unwrap().load_factor;
    assert!(found < exact && found % 5.0 == 0.0, "{found}");
    // One step before, fewer than three joints are open by that much; at the step, three are.
    let open_at = |load: f64| {
        let share = load / exact;
        let report = case("first-arch", |r| r["report"] = json!({"share_of_collapse": share})).unwrap();
        let state = report.near_collapse.unwrap();
        let open: Vec<usize> = state.contacts.iter().filter(|c| c.gap > 1e-3).map(|c| c.joint).collect();
        (0..28).filter(|k| open.contains(k)).count()
    };
    assert!(open_at(found) >= 3 && open_at(found - 5.0) < 3);
    assert!(early.near_collapse.unwrap().load_factor < found);
}

#[test]
fn downwards_steps_are_counted_downwards() {
    let report = case("first-arch", |r| {
        steps(10.0, 1.0)(r);
        r["load_factor"]["direction"] = json!("decrease");
    });
    assert_eq!(report.unwrap().end.unwrap().load_factor, -110.0);
}

#[test]
fn a_step_too_small_to_walk_the_path_in_is_an_error_and_not_a_wait() {
    for step in [1e-3, 1e-300] {
        let error = case("first-arch", steps(step, 0.01)).unwrap_err();
        assert_eq!(error, AnalysisError::TooManySteps { most: 10_000 });
    }
}
