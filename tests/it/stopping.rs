//! An analysis that is asked to stop stops there and then, wherever it is: the budget is asked in every long stretch of every
//! kind of request, and never again once it has said no. Times are measured in `benches/stopping.rs`.

use crate::common::semicircle::{mesh, semicircle};
use serde_json::{Value, json};
use std::cell::RefCell;
use std::ops::{ControlFlow, Range};
use voussoir::budget::{Budget, LoadStep, Stopped};
use voussoir::collapse::{AnalysisError, Answer, Question, answer};
use voussoir::wire::read::read_question;

/// What a request is answered, and what it tells its budget, which is spent at the `stops`-th call and at any after that.
fn watched(question: &Question, stops: usize) -> (Result<Answer, AnalysisError>, Vec<LoadStep>) {
    let told = RefCell::new(Vec::new());
    let see = |step| {
        let mut told = told.borrow_mut();
        told.push(step);
        if told.len() > stops { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let result = answer(question, &Budget::new(&see));
    (result, told.into_inner())
}

/// Runs a request to its end, and stops it at the first call, the last, and at others on the way; returns what was told.
fn stops_anywhere(request: &Value) -> Vec<LoadStep> {
    let (_, question) = read_question(request.to_string().as_bytes()).unwrap();
    let (result, all) = watched(&question, usize::MAX);
    assert!(result.is_ok(), "{result:?}");
    let n = all.len();
    for stops in [0, 1, n / 7, n / 3, n / 2, 2 * n / 3, 6 * n / 7, n - 1] {
        let (result, told) = watched(&question, stops);
        assert_eq!(told.len(), stops + 1, "calls until it ended, stopped at call {stops} of {n}");
        assert_eq!(result, Err(Stopped(told[stops]).into()), "stopped at call {stops} of {n}");
        assert!(told[..] == all[..=stops], "the same calls every time");
    }
    all
}

/// How often the same step was told again.
fn again(told: &[LoadStep]) -> usize {
    told.windows(2).filter(|two| two[0] == two[1]).count()
}

#[test]
fn while_the_limit_windows_are_found() {
    let told = stops_anywhere(&semicircle(301, &json!({"stone": {"compressive_strength_pa": 2e6}})));
    let before = told.iter().take_while(|step| step.events == 0 && step.load_factor == 0.0).count();
    // Every pivot of both windows and of the thrust range.
    assert!(before > 50, "{before}");
}

#[test]
fn while_stones_are_condensed() {
    let told = stops_anywhere(&semicircle(5, &json!({"mesh": mesh(16, 16)})));
    let still = |step: &&LoadStep| step.events == 0 && step.load_factor == 0.0;
    let coarse = stops_anywhere(&semicircle(5, &json!({})));
    let [fine, coarse] = [&told, &coarse].map(|told| told.iter().take_while(still).count());
    // Its one kind of stone: entries, matrix, ordering, factors, columns, loads.
    assert!(fine > coarse + 8, "{fine} and {coarse}");
}

#[test]
fn in_the_curved_beam() {
    let beam = json!({"inner_radius_m": 5.0, "outer_radius_m": 6.0, "end_shear_n_per_m": 1000.0});
    let told = stops_anywhere(&json!({"curved_beam": beam, "mesh": mesh(16, 16)}));
    assert!(told.len() > 8, "{}", told.len());
}

#[test]
fn in_a_path_and_its_stresses() {
    let fields = json!(["near_collapse", {"load_factor": 3.0}]);
    let coarse = semicircle(9, &json!({"report": {"stress_fields": fields}}));
    let mut fine = coarse.clone();
    fine["mesh"] = mesh(20, 20);
    let [coarse, fine] = [coarse, fine].map(|request| stops_anywhere(&request));
    // Between events as well.
    assert!(again(&fine) > again(&coarse) + 20, "{} and {}", again(&fine), again(&coarse));
}

#[test]
fn in_fixed_steps() {
    let method = json!({"fixed_steps": {"step": 0.05}});
    stops_anywhere(&semicircle(31, &json!({"method": method})));
}

#[test]
fn where_an_arch_falls_as_built() {
    let thin = json!({
        "profile": {"circular": {"radius_m": 10.0, "opening_angle_deg": 180.0}},
        "thickness": {"constant_m": 0.9},
        "voussoirs": 61,
    });
    stops_anywhere(&semicircle(61, &json!({"arch": thin, "loads": [{"load": {"self_weight": {}}}]})));
}

#[test]
fn where_attempts_are_begun_anew() {
    // No attempt can follow the path of stones that carry nothing: nothing presses their joints. A load that cancels the other exactly
    // would leave nothing to follow.
    let load = |newtons: f64| json!({"point_load": {"force_n_per_m": newtons, "x_m": -5.0}});
    let loads = json!([{"load": load(1000.0)}, {"load": load(700.0), "scaled": true}]);
    let told = stops_anywhere(&semicircle(9, &json!({"loads": loads})));
    assert!(told.windows(2).any(|two| two[1].load_factor < two[0].load_factor), "the load begins anew");
    assert!(told.windows(2).all(|two| two[1].events >= two[0].events), "events of all attempts add up");
}

#[test]
fn on_moving_geometry() {
    let told = stops_anywhere(&semicircle(15, &json!({"geometry": "updated", "mesh": mesh(6, 3)})));
    assert!(again(&told) > 20, "{}", again(&told));
}

/// Calls from `from` on up to the first event in which springings move.
fn at_rest(told: &[LoadStep], from: usize) -> Range<usize> {
    let moves = told[from..].iter().position(|step| step.load_factor > 0.0);
    from..moves.map_or(told.len(), |moves| from + moves)
}

#[test]
fn while_loads_settle_before_springings_move() {
    let standing = |geometry: &str, analysis: &Value| {
        let mut request = semicircle(31, &json!({"geometry": geometry, "loads": [{"load": {"self_weight": {}}}]}));
        // Thin enough for joints to open as the loads come on.
        request["arch"]["thickness"]["constant_m"] = json!(1.15);
        request["analysis"] = analysis.clone();
        request
    };
    let settles = json!({"settlement": {"left": {"outwards_m": 0.05}}});
    // Whether it stands is found out first, as in an analysis that is after nothing else; the movement on moving geometry
    // comes after that at first order. The last call of all is before the report is looked over.
    let mut before = stops_anywhere(&standing("first_order", &json!("collapse"))).len() - 1;
    for geometry in ["first_order", "updated"] {
        let request = standing(geometry, &settles);
        let (_, question) = read_question(request.to_string().as_bytes()).unwrap();
        let all = stops_anywhere(&request);
        let calls = at_rest(&all, before);
        assert!(calls.len() > 10, "{geometry}: {}", calls.len());
        for stops in calls {
            let (result, told) = watched(&question, stops);
            assert_eq!(result, Err(Stopped(all[stops]).into()), "{geometry}, call {stops}");
            assert_eq!((told.len(), all[stops].load_factor), (stops + 1, 0.0), "{geometry}");
        }
        before = all.len() - 1;
    }
}

#[test]
fn as_an_arch_falls() {
    let motion = json!({"most_frames": 20, "share_of_span": 1.0});
    let told = stops_anywhere(&semicircle(400, &json!({"motion": motion})));
    // The motion comes last, a little beyond the load of collapse: between frames as well.
    let last = told[told.len() - 1].load_factor;
    let falling: Vec<LoadStep> = told.into_iter().filter(|step| step.load_factor == last).collect();
    assert!(again(&falling) > falling.len() / 3, "{} of {}", again(&falling), falling.len());
}

#[test]
fn at_and_between_the_points_of_a_curve() {
    let curve = json!({"abscissae": [0.5, 1.0, 1.5], "unit": "m"});
    let analysis = json!({"safety": {"crushing": "plastic_section", "curve": curve}});
    let mut request = semicircle(61, &json!({"analysis": analysis}));
    request["loads"][1]["per_abscissa"] = json!(true);
    stops_anywhere(&request);
}
