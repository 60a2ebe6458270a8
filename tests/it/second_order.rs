//! Subblocks of second order: what passes through joints between them, and that collapse loads do not depend on them.

use crate::common::largest::largest;
use crate::common::{door, random_arch};
use crate::contract::bodies::with;
use serde_json::{Value, json};
use voussoir::budget::Budget;
use voussoir::collapse::{CollapseReport, Outcome, StressField, run};

/// A collapse load without sliding is that of the limit window to this share.
const EQUAL: f64 = 1e-9;
/// What rounding leaves of a uniform stress.
const EXACT: f64 = 1e-9;
/// Seeds of the random arches; and how many of them have to hinge for the set to ask real questions.
const SEEDS: u64 = 60;
const HINGE: usize = 8;
/// More stones than this would make the test slow without asking anything else.
const MOST_VOUSSOIRS: usize = 30;

fn second_order(radial: usize, along: usize, lines: &str) -> Value {
    json!({"subblocks": {"uniform": {"radial": radial, "along": along}}, "order": 2, "lines": lines})
}

fn end(report: &CollapseReport) -> f64 {
    report.end.as_ref().unwrap().load_factor
}

#[test]
fn a_collapse_load_without_sliding_is_that_of_the_limit_window() {
    let mut hinge = 0;
    for seed in 0..SEEDS {
        let request = random_arch::request(seed);
        let whole = door::analysis(&request).unwrap();
        if whole.structure.voussoirs().len() > MOST_VOUSSOIRS {
            continue;
        }
        let plain = run(&whole, &Budget::unlimited()).unwrap();
        if plain.outcome != Outcome::Collapse || plain.end.as_ref().is_none_or(|end| end.mechanism.slips()) {
            continue;
        }
        hinge += 1;
        for (radial, along, lines) in [(1, 1, "even"), (3, 2, "graded")] {
            let report = door::solve(&with(request.clone(), "/mesh", second_order(radial, along, lines)));
            assert_eq!(report.outcome, Outcome::Collapse, "seed {seed}, {radial} x {along}: {:?}", report.notes);
            let window = report.limit_window.unwrap();
            let limit = if end(&report) < window.lowest + window.highest - end(&report) {
                window.lowest
            } else {
                window.highest
            };
            let apart = (end(&report) - limit).abs() / limit.abs();
            assert!(apart < EQUAL, "seed {seed}, {radial} x {along}: {} and {limit}", end(&report));
        }
    }
    assert!(hinge >= HINGE, "only {hinge} arches hinge");
}

/// A column of unit squares on the ground under a cap that presses evenly, each with its own mesh.
fn column(meshes: &[[usize; 2]], lines: &str) -> Value {
    let square = |k: usize| {
        let (low, high) = (k as f64, k as f64 + 1.0);
        json!({"name": format!("{k}"), "corners_m": [[0, low], [1, low], [1, high], [0, high]]})
    };
    let each: Vec<Value> = meshes.iter().map(|[radial, along]| json!({"radial": radial, "along": along})).collect();
    json!({
        "blocks": {
            "polygons": (0..meshes.len()).map(square).collect::<Vec<_>>(),
            "supports": [{"name": "ground", "segments_m": [[[-20, 0], [20, 0]]]}],
        },
        "stone": {"friction_angle_deg": 75, "poissons_ratio": 0, "compressive_strength_pa": 1e30},
        "loads": [{"load": {"self_weight": {}}}],
        "mesh": {"subblocks": {"per_voussoir": each}, "order": 2, "lines": lines},
        "report": {"stress_fields": ["unit_load"]},
    })
}

/// Largest miss of a uniform pressure in all but the last body.
fn miss(field: &StressField, last: usize, pressure: f64) -> f64 {
    let below = field.subblocks.iter().filter(|subblock| subblock.voussoir < last);
    let off = |s: [f64; 3]| largest([s[0].abs(), (s[1] + pressure).abs(), s[2].abs()]) / pressure;
    largest(below.map(|subblock| off(subblock.stress)))
}

#[test]
fn a_uniform_pressure_passes_joints_between_like_and_unlike_sides() {
    for meshes in
        [[[1, 1], [1, 1], [1, 1]], [[2, 2], [2, 2], [2, 2]], [[2, 3], [3, 2], [4, 4]], [[1, 4], [3, 3], [2, 1]]]
    {
        for lines in ["even", "graded"] {
            let mut analysis = door::analysis(&column(&meshes, lines)).unwrap();
            let last = meshes.len() - 1;
            analysis.fixed.retain(|force| force.body == last);
            let weight: f64 = analysis.fixed.iter().map(|force| -force.force.y).sum();
            let report = run(&analysis, &Budget::unlimited()).unwrap();
            let off = miss(&report.stress_fields[0], last, weight);
            assert!(off < EXACT, "{meshes:?}, {lines}: {off:e}");
        }
    }
}

/// Their own weight: sigma_y = -density g (height above), linear, which second order has exactly.
#[test]
fn a_column_has_the_weight_above_on_every_subblock() {
    let request = column(&[[2, 2], [3, 1]], "even");
    let report = door::solve(&request);
    for subblock in &report.stress_fields[0].subblocks {
        let exact = -2300.0 * 9.81 * (2.0 - subblock.centre.y);
        let [x, y, tau] = subblock.stress;
        let off = largest([x.abs(), (y - exact).abs(), tau.abs()]) / 2300.0;
        assert!(off < 1e-6, "{:?} at {}", subblock.stress, subblock.centre);
    }
}

#[test]
fn what_does_not_go_with_second_order_is_told() {
    let arch = || with(random_arch::request(1), "/mesh", second_order(2, 2, "even"));
    let fault = |request: &Value| door::analysis(request).unwrap_err().to_string();
    assert!(fault(&with(arch(), "/mesh/seams", json!("corners"))).contains("/mesh/seams"));
    assert!(fault(&with(arch(), "/mesh/order", json!(3))).contains("/mesh/order"));
    assert!(fault(&with(arch(), "/crushing_in_path", json!(true))).contains("/mesh/order"));
    let asked =
        with(with(arch(), "/mesh", json!({"order": 2, "lines": "graded"})), "/accuracy", json!({"stress": 0.1}));
    assert!(fault(&asked).contains("/mesh/order") && fault(&asked).contains("/mesh/lines"));
    let ell = json!([[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]);
    let wall = with(column(&[[1, 1]], "even"), "/mesh/subblocks", json!({"uniform": {"radial": 1, "along": 1}}));
    assert!(fault(&with(wall, "/blocks/polygons/0/corners_m", ell)).contains("/mesh/order"));
}
