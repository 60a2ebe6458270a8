//! First yield with stress averaged over a length: it converges, and is what statics says where statics says it.

use crate::common::answered::solved;
use serde_json::{Value, json};

/// Length over which stress is averaged, m.
const LENGTH: f64 = 0.6;

/// A semicircle of 1.5 MPa under its weight and a load at the quarter, which becomes a mechanism of four hinges.
fn hinging(mesh: &Value) -> Value {
    json!({
        "arch": {
            "profile": {"circular": {"radius_m": 9, "opening_angle_deg": 180}},
            "thickness": {"constant_m": 1.8},
            "voussoirs": 13,
        },
        "stone": {"compressive_strength_pa": 1.5e6, "friction_angle_deg": 40},
        "mesh": mesh,
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"point_load": {"force_n_per_m": 1000, "x_m": -4.5}}, "scaled": true}
        ],
    })
}

/// First yield as a share of the load of the mechanism: with stress averaged over the length, and over every subblock.
fn shares(each: usize, order: usize) -> [f64; 2] {
    let lines = if order == 2 { "graded" } else { "even" };
    let mesh = json!({"subblocks": {"uniform": {"radial": each, "along": each}}, "order": order, "lines": lines});
    let [mut by_length, mut by_subblock] = [hinging(&mesh), hinging(&mesh)];
    by_length["report"] = json!({"first_yield_length_m": LENGTH});
    by_subblock["analysis"] = json!({"safety": {"crushing": "elastic"}});
    [by_length, by_subblock].map(|request| {
        let answer = solved(&request);
        let fall = answer["ends"][0]["instability"]["load_factor"].as_f64().unwrap();
        answer["crushing"]["elastic"]["load_factor"].as_f64().unwrap() / fall
    })
}

#[test]
fn first_yield_of_a_length_converges_and_that_of_subblocks_falls() {
    let first = [8, 16, 32].map(|each| shares(each, 1));
    let second = [16, 20].map(|each| shares(each, 2));
    println!(
        "first yield over instability, over {LENGTH} m and over a subblock, of 8, 16 and 32 subblocks each way: {first:.3?}"
    );
    println!("and of 16 and 20 of second order, graded: {second:.3?}");
    let length = first.map(|[length, _]| length);
    let steps = [length[1] - length[0], length[2] - length[1]].map(f64::abs);
    assert!(steps[0] < 0.06 * length[2] && steps[1] < 0.5 * steps[0], "{length:?}");
    for [of_second, _] in second {
        assert!((of_second / length[2] - 1.0).abs() < 0.01, "{of_second} {length:?}");
    }
    // With every halving by a tenth or more; the second order, graded, sees higher stresses still.
    assert!(first[2][1] < 0.9 * first[1][1] && first[1][1] < 0.9 * first[0][1], "{first:?}");
    assert!(second[1][1] < 0.96 * second[0][1], "{second:?}");
}

#[test]
fn a_column_yields_under_its_weight_where_a_window_at_its_foot_does() {
    // sigma = rho g (h - y), and without lateral strain nothing else: its mean over the lowest half metre is that at a quarter.
    let [height, strength, weight, length] = [3.0, 1e6, 2300.0 * 9.81, 0.5];
    for (order, lines) in [(1, "even"), (1, "graded"), (2, "graded")] {
        let answer = solved(&json!({
            "blocks": {
                "polygons": [{"name": "column", "corners_m": [[0, 0], [1, 0], [1, height], [0, height]]}],
                "supports": [{"name": "ground", "sides": [{"block": "column", "side": 0}]}]
            },
            "stone": {"poissons_ratio": 0, "compressive_strength_pa": strength},
            "mesh": {"subblocks": {"uniform": {"radial": 24, "along": 8}}, "order": order, "lines": lines},
            "loads": [{"load": {"self_weight": {}}, "scaled": true}],
            "report": {"first_yield_length_m": length},
        }));
        let elastic = &answer["crushing"]["elastic"];
        let found = elastic["load_factor"].as_f64().unwrap();
        let expected = strength / (weight * (height - 0.5 * length));
        println!("order {order}, {lines}: {found}, {expected}");
        // Where a window ends within a subblock, the part of it in the window counts with its mean.
        let tolerance = if lines == "even" { 1e-6 } else { 2e-3 };
        assert!((found / expected - 1.0).abs() < tolerance, "{found} {expected}");
        assert!((elastic["subblock"]["centre_y_m"].as_f64().unwrap() - 0.5 * length).abs() < 1e-9);
    }
}
