//! Ties of a given force: a frame by hand, the two forces that they are, and what a note says of them.

use crate::common::answered::{end, solved, text};
use crate::common::door::refused;
use crate::common::masonry::polygon;
use crate::contract::bodies::with;
use serde_json::{Value, json};

/// Two stones that lean on each other without friction, the right one on rollers, held by a tie at `y` = 1 m.
fn frame(tie: Value) -> Value {
    let half = |name: &str, way: f64| {
        let corners = [[-3.0, 0.0], [-2.0, 0.0], [0.0, 3.0], [0.0, 4.0]].map(|[x, y]| [way * x, y]);
        json!({"name": name, "corners_m": corners})
    };
    let mut request = json!({
        "blocks": {
            "polygons": [half("left", 1.0), half("right", -1.0)],
            "supports": [{"name": "ground", "segments_m": [[[-5, 0], [5, 0]]]}]
        },
        "stone": {"compressive_strength_pa": 1e30},
        "joint_overrides": [{"joint": 1, "friction_angle_deg": 0}, {"joint": 2, "friction_angle_deg": 0}],
        "loads": [{"load": {"self_weight": {}}}],
        "load_factor": {"unit": "kN/m", "intensity_per_unit": 1}
    });
    request["loads"].as_array_mut().unwrap().push(tie);
    request
}

fn tie(force: f64, scaled: bool) -> Value {
    let end = |block: &str, x: f64| json!({"block": block, "at_m": [x, 1]});
    json!({
        "load": {"tie": {"force_n_per_m": force, "from": end("left", -1.6), "to": end("right", 1.6)}}, "scaled": scaled
    })
}

/// No horizontal force but the tie's acts on the frame, so either stone has its weight at its centroid, the ground's force somewhere in its base and the other stone's somewhere in the joint: the
/// moments are T (y - 1) = W (x_g - x), with x from -3 to -2 m and y from 3 to 4 m.
fn pulls() -> [f64; 2] {
    let (area, [x, _]) = polygon(&[[-3.0, 0.0], [-2.0, 0.0], [0.0, 3.0], [0.0, 4.0]]);
    let weight = 2300.0 * 9.81 * area;
    [weight * (x + 2.0) / 3.0, weight * (x + 3.0) / 2.0]
}

#[test]
fn a_frame_with_a_roller_stands_between_two_pulls_of_its_tie() {
    let [least, most] = pulls();
    let answer = solved(&frame(tie(1000.0, true)));
    for (found, expected) in answer["limit_window"].as_array().unwrap().iter().zip([least, most]) {
        let found = 1e3 * found.as_f64().unwrap();
        println!("{found} N/m, by hand {expected}");
        assert!((found / expected - 1.0).abs() < 1e-9);
    }
    assert_eq!(answer["outcome"], "stands_in_window", "{}", answer["notes"]);
    for (share, outcome) in [
        (0.999 * least, "falls_as_built"),
        (1.001 * least, "stands"),
        (0.999 * most, "stands"),
        (1.001 * most, "falls_as_built"),
    ] {
        assert_eq!(solved(&frame(tie(share, false)))["outcome"], outcome, "{share} N/m");
    }
    let said = text(&frame(tie(2e4, false)));
    assert!(said.contains("tie of 20 kN/m from left at (-1.6, 1) m to right at (1.6, 1) m"), "{said}");
}

/// A semicircle with a load at its quarter span, and a tie between two of its stones at about half its height.
fn arch(pull: f64, as_tie: bool) -> Value {
    let at = |way: f64| [way * 8.7, 5.0];
    let loads = if as_tie {
        let end = |block: &str, way: f64| json!({"block": block, "at_m": at(way)});
        let tie = json!({"force_n_per_m": pull, "from": end("voussoir 4", -1.0), "to": end("voussoir 22", 1.0)});
        vec![json!({"load": {"tie": tie}})]
    } else {
        let on = |block: &str, way: f64| json!({"load": {"point_force": {"block": block, "at_m": at(way), "force_n_per_m": [-way * pull, 0]}}});
        vec![on("voussoir 4", -1.0), on("voussoir 22", 1.0)]
    };
    let mut all = vec![
        json!({"load": {"self_weight": {}}}),
        json!({"load": {"point_load": {"force_n_per_m": 1000, "x_m": -5}}, "scaled": true}),
    ];
    all.extend(loads);
    json!({
        "arch": {
            "profile": {"circular": {"radius_m": 10, "opening_angle_deg": 180}}, "thickness": {"constant_m": 1.5}, "voussoirs": 27
        },
        "stone": {"friction_angle_deg": 60, "compressive_strength_pa": 1e30},
        "loads": all,
        "load_factor": {"unit": "kN/m", "intensity_per_unit": 1}
    })
}

#[test]
fn a_tie_is_two_forces_and_its_note_tells_which_way_they_act() {
    let load = |request: &Value| end(&solved(request), "highest")["intensity"].as_f64().unwrap();
    let (mut stretched, mut slack) = (0, 0);
    for pull in [2e4, 8e4, 2.4e5, 5e5] {
        let answer = solved(&arch(pull, true));
        let here = end(&answer, "highest")["intensity"].as_f64().unwrap();
        assert!((here / load(&arch(pull, false)) - 1.0).abs() < 1e-12);
        // More bears more where the tie is stretched in the mechanism, and less where it goes slack: the kinematic theorem.
        let more = load(&arch(1.001 * pull, true)) - here;
        let says =
            |words: &str| answer["notes"].as_array().unwrap().iter().any(|note| note.as_str().unwrap().contains(words));
        println!("{pull} N/m: {here}, with a thousandth more {more:+}");
        assert_eq!(says("The tie of loads[2] is stretched"), more > 0.0, "{}", answer["notes"]);
        assert_eq!(says("The tie of loads[2] goes slack"), more < 0.0, "{}", answer["notes"]);
        stretched += usize::from(more > 0.0);
        slack += usize::from(more < 0.0);
    }
    assert!(stretched > 0 && slack > 0, "{stretched} stretched, {slack} slack");
}

#[test]
fn half_an_arch_says_of_its_ties_what_the_whole_one_says() {
    let said = |half: bool, voussoirs: usize, direction: &str| {
        let mut request = arch(2.4e5, true);
        let last = voussoirs - 5;
        request["arch"]["half"] = json!(half);
        request["arch"]["voussoirs"] = json!(voussoirs);
        request["loads"][1]["load"]["point_load"]["x_m"] = json!(0);
        request["loads"][2]["load"]["tie"]["to"]["block"] = json!(format!("voussoir {last}"));
        request["load_factor"]["direction"] = json!(direction);
        let answer = solved(&request);
        let notes = answer["notes"].as_array().unwrap().iter().filter_map(Value::as_str);
        notes.filter(|note| note.starts_with("The tie of loads[2]")).map(str::to_owned).collect::<Vec<_>>()
    };
    for (direction, words) in [("increase", "is stretched"), ("decrease", "goes slack")] {
        for voussoirs in [27, 28] {
            let [half, whole] = [true, false].map(|half| said(half, voussoirs, direction));
            assert_eq!(half, whole, "{voussoirs} voussoirs, {direction}");
            assert!(whole.len() == 1 && whole[0].contains(words), "{whole:?}");
        }
    }
}

#[test]
fn ties_that_hold_nothing_are_refused() {
    let good = frame(tie(2e4, false));
    let at = |field: &str| format!("/loads/1/load/tie/{field}");
    refused(&with(good.clone(), &at("to/block"), json!("centre")), &at("to/block"), "correct the name");
    refused(
        &with(good.clone(), &at("from/at_m"), json!([-3, 1])),
        &at("from/at_m"),
        "outside its block, which reaches from [",
    );
    refused(
        &with(good.clone(), &at("to/at_m"), json!([3, 1])),
        &at("to/at_m"),
        "outside its block, which reaches from [",
    );
    refused(
        &with(good.clone(), &at("to"), json!({"block": "left", "at_m": [-1.5, 1]})),
        &at("to/at_m"),
        "it does nothing",
    );
    refused(&with(good.clone(), "/loads/1/coefficient", json!(-1)), "/loads/1/coefficient", "a tie pulls");
    refused(&with(good, &at("force_n_per_m"), json!(-1)), &at("force_n_per_m"), "out of range");
}
