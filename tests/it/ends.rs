//! Ends of an answer: the lower of two figures governs, and forces, hinges and motion belong to it. That forces and motion prove
//! the load of an end that crushes from both sides, `tests/proof/run.py` holds over random structures.

use crate::common::answered::{solved, text};
use crate::common::{folders, random_arch};
use serde_json::{Value, json};

/// The semicircle of `cases/crushing`, which crushes in limit analysis only, of this strength, Pa, with its load at `x`, m.
fn semicircle(strength: f64, x: f64) -> Value {
    let text = std::fs::read(folders::cases().join("crushing/request.json")).unwrap();
    let mut request: Value = serde_json::from_slice(&text).unwrap();
    request.as_object_mut().unwrap().remove("crushing_in_path");
    request["stone"]["compressive_strength_pa"] = json!(strength);
    request["loads"][1]["load"]["point_load"]["x_m"] = json!(x);
    request
}

fn number(value: &Value, pointer: &str) -> f64 {
    value.pointer(pointer).and_then(Value::as_f64).unwrap_or(f64::NAN)
}

fn list<'a>(value: &'a Value, name: &str) -> &'a [Value] {
    value[name].as_array().unwrap()
}

fn close(a: f64, b: f64, share: f64) -> bool {
    (a - b).abs() <= share * a.abs().max(b.abs())
}

/// A block 1 m wide at its foot and 5 m at its top, with a load `off` its middle.
fn block(strength: f64, off: f64) -> Value {
    json!({
        "blocks": {
            "polygons": [{"name": "b", "corners_m": [[-0.5, 0], [0.5, 0], [2.5, 2], [-2.5, 2]]}],
            "joints": "found",
            "supports": [{"name": "ground", "segments_m": [[[-1, 0], [1, 0]]]}]
        },
        "stone": {"density_kg_m3": 2000, "compressive_strength_pa": strength},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"point_force": {"block": "b", "at_m": [off, 2], "force_n_per_m": [0, -1000]}}, "scaled": true}
        ]
    })
}

/// With weight W in the middle and P at e off it the joint of length t carries N = W + P at P e / N off its middle, on a block of
/// t - 2 P e / N = N / f: P^2 + (2 W + f (2 e - t)) P + W^2 - f t W = 0.
#[test]
fn a_block_under_an_eccentric_load_crushes_where_its_force_fills_what_is_left_of_its_joint() {
    let weight = 2000.0 * 9.81 * 6.0;
    for (strength, off) in [(1e6, 0.1), (4e5, 0.7), (1e6, 2.0), (3e5, -1.2), (2e5, 0.0)] {
        let answer = solved(&block(strength, off));
        let (end, e) = (&answer["ends"][0], f64::abs(off));
        let half = weight + 0.5 * strength * (2.0 * e - 1.0);
        let load = (half * half - weight * (weight - strength)).sqrt() - half;
        let found = 1e3 * number(end, "/load_factor");
        assert!(close(found, load, 1e-6), "{strength} {off}: {found} N/m, expected {load}");
        assert_eq!((&answer["outcome"], &end["governed_by"]), (&json!("collapse"), &json!("crushing")));
        // Rigid, it turns about the end of its joint where the load lies beyond that.
        let turns = weight * 0.5 / (e - 0.5);
        let figure = 1e3 * number(end, "/instability/load_factor");
        assert!(if e > 0.5 { close(figure, turns, 1e-9) } else { figure.is_nan() }, "{off}: {figure}");
        let crushed = &list(end, "crushed_joints")[0];
        let length = (weight + load) / strength;
        assert!(close(number(crushed, "/length_m"), length, 1e-6), "{crushed}");
        if off == 0.0 {
            assert_eq!((&end["mode"], list(end, "hinges").len()), (&json!("crushing"), 0));
            continue;
        }
        let hinge = &list(end, "hinges")[0];
        let inner = (0.5 - length) * off.signum();
        assert!((number(hinge, "/at_m/0") - inner).abs() < 1e-5, "{hinge}, expected {inner}");
    }
}

/// The load factor is that of separate limit analysis with plastic sections (`cases/crushing`); the path on which joints crush comes
/// to the same hinges and blocks.
#[test]
fn an_arch_crushes_at_the_hinges_of_the_path_on_which_its_joints_crush() {
    let request = semicircle(2e6, -5.0);
    let mut on_path = request.clone();
    on_path["crushing_in_path"] = json!(true);
    let [ours, path] = [&request, &on_path].map(|request| solved(request)["ends"][0].clone());
    assert!((number(&ours, "/intensity") - 137.7223).abs() < 1e-3, "{}", ours["intensity"]);
    assert!(close(number(&ours, "/instability/intensity"), 243.125, 1e-6) && path["instability"].is_null());
    let turning = |end: &Value| -> Vec<_> {
        list(end, "hinges").iter().map(|hinge| (hinge["joint"].clone(), hinge["face"].clone())).collect()
    };
    assert_eq!(turning(&ours), turning(&path));
    for (a, b) in list(&ours, "hinges").iter().zip(list(&path, "hinges")) {
        let apart = (number(a, "/at_m/0") - number(b, "/at_m/0")).hypot(number(a, "/at_m/1") - number(b, "/at_m/1"));
        assert!(apart < 0.01 && (number(a, "/rotation") - number(b, "/rotation")).abs() < 1e-3, "{a} {b}");
    }
    for (a, b) in list(&ours, "crushed_joints").iter().zip(list(&path, "crushed_joints")) {
        assert_eq!((&a["joint"], &a["face"]), (&b["joint"], &b["face"]));
        assert!(close(number(a, "/length_m"), number(b, "/length_m"), 1e-3), "{a} {b}");
    }
    assert!(
        list(&ours["without_crushing"], "hinges").len() == 4 && turning(&ours["without_crushing"]) != turning(&ours)
    );
    let text = text(&request);
    for words in
        ["collapses at 137.7 kN/m, as its joints crush; if its stone did not crush, at 243.1 kN/m.", "Mode sway:"]
    {
        assert!(text.contains(words), "{text}");
    }
}

#[test]
fn a_mirrored_arch_crushes_as_the_mirror_image() {
    let [left, right] = [-5.0, 5.0].map(|x| solved(&semicircle(2e6, x))["ends"][0].clone());
    assert!(close(number(&left, "/intensity"), number(&right, "/intensity"), 1e-9));
    let mirrored: Vec<&Value> = list(&right, "hinges").iter().rev().collect();
    assert_eq!(mirrored.len(), list(&left, "hinges").len());
    for (a, b) in list(&left, "hinges").iter().zip(mirrored) {
        assert_eq!((27 - b["joint"].as_u64().unwrap(), &b["face"]), (a["joint"].as_u64().unwrap(), &a["face"]));
        let apart = (number(a, "/at_m/0") + number(b, "/at_m/0")).hypot(number(a, "/at_m/1") - number(b, "/at_m/1"));
        assert!(apart < 1e-6, "{a} {b}");
    }
    // Under symmetric loads it crushes symmetrically.
    let middle = solved(&semicircle(1e6, 0.0))["ends"][0].clone();
    let places: Vec<f64> = list(&middle, "hinges").iter().map(|hinge| number(hinge, "/at_m/0")).collect();
    assert!(middle["governed_by"] == "crushing" && places.len() >= 3);
    assert!(places.iter().zip(places.iter().rev()).all(|(a, b)| (a + b).abs() < 1e-6), "{places:?}");
}

#[test]
fn a_strength_that_changes_nothing_does_not_govern() {
    let plain = solved(&semicircle(1e30, -5.0))["ends"][0].clone();
    for strength in [1e16, 1e14] {
        let end = solved(&semicircle(strength, -5.0))["ends"][0].clone();
        for name in ["load_factor", "governed_by", "hinges", "thrust_line", "velocities", "crushed_joints"] {
            assert_eq!(end[name], plain[name], "{strength} {name}");
        }
        assert!(end["governed_by"] == "instability" && end.get("without_crushing").is_none());
    }
}

#[test]
fn fixed_loads_that_crush_the_stone_alone_are_told_however_coarse_the_mesh() {
    let request = semicircle(6e5, -5.0);
    let answer = solved(&request);
    assert_eq!((&answer["outcome"], &answer["crushing"]["elastic"]), (&json!("crushes"), &Value::Null));
    assert!(close(number(&answer, "/ends/0/instability/intensity"), 243.125, 1e-6));
    let text = text(&request);
    assert!(text.contains("The fixed loads alone crush the arch"), "{text}");
    assert!(text.contains("if its stone did not crush, it would collapse at 243.1 kN/m"), "{text}");
}

#[test]
fn an_arch_that_never_falls_collapses_where_its_stone_crushes() {
    let text = std::fs::read(folders::cases().join("hard/flat/request.json")).unwrap();
    let mut request: Value = serde_json::from_slice(&text).unwrap();
    assert_eq!(solved(&request)["outcome"], "stands");
    request["stone"]["compressive_strength_pa"] = json!(5e6);
    let answer = solved(&request);
    let end = &answer["ends"][0];
    assert_eq!((&answer["outcome"], &end["governed_by"]), (&json!("collapse"), &json!("crushing")));
    assert!(end["instability"].is_null() && end.get("without_crushing").is_none(), "{end}");
    assert!(!list(end, "crushed_joints").is_empty());
}

/// |M| <= N (t / 2 - N / 2 f) in every joint, with equality and a block of N / f where it is said to crush, and hinges at its edge.
#[test]
fn joints_bear_no_more_than_their_strength_and_turn_about_the_edge_of_what_crushes() {
    let (mut crushing, mut hinges) = (0, 0);
    for seed in 0..60 {
        let mut request = random_arch::request(seed);
        request["stone"]["compressive_strength_pa"] = json!(10f64.powf(5.0 + (seed % 7) as f64 / 3.0));
        let answer = solved(&request);
        // What the path says of joints that slide and crush is good to the strips that they crush in.
        let exact = |end: &&Value| end["governed_by"] == "crushing" && end["range"].is_null();
        for end in list(&answer, "ends").iter().filter(exact) {
            crushing += 1;
            let [normal, off] = ["normal_n_per_m", "eccentricity_m"].map(|name| &end["thrust_line"][name]);
            let most =
                list(&end["thrust_line"], "normal_n_per_m").iter().fold(0.0, |m: f64, n| m.max(n.as_f64().unwrap()));
            let said = |k: usize| list(end, "crushed_joints").iter().find(|of| of["joint"] == k);
            for (k, joint) in list(&answer["structure"], "joints").iter().enumerate() {
                let [x, y] =
                    [0, 1].map(|i| number(joint, &format!("/ends_m/1/{i}")) - number(joint, &format!("/ends_m/0/{i}")));
                let (length, strength) = (x.hypot(y), number(joint, "/compressive_strength_pa"));
                let (Some(n), Some(off)) = (normal[k].as_f64(), off[k].as_f64()) else { continue };
                let left = n * (0.5 * length - 0.5 * n / strength - off.abs());
                assert!(joint["law"] != "dry" || left > -1e-7 * most * length, "{seed} {k}: {left}");
                let Some(said) = said(k) else { continue };
                assert!(
                    left < 1e-6 * most * length && close(number(said, "/length_m"), n / strength, 1e-9),
                    "{seed} {k}"
                );
                let Some(hinge) = list(end, "hinges").iter().find(|hinge| hinge["joint"] == k) else { continue };
                let [at, face] = [&hinge["at_m"], &said["at_m"]].map(|p| [0, 1].map(|i| p[i].as_f64().unwrap()));
                let block = (at[0] - face[0]).hypot(at[1] - face[1]);
                assert!(
                    close(block, n / strength, 1e-3),
                    "{seed} {k}: turns {block} from the face, block {}",
                    n / strength
                );
                hinges += 1;
            }
        }
    }
    assert!(crushing >= 20 && hinges >= 50, "{crushing} ends crush, {hinges} hinges");
}

#[test]
fn angles_of_hinges_do_not_depend_on_how_the_shape_was_typed() {
    let (radius, half) = (6.0f64, 50f64.to_radians());
    let shapes = [
        json!({"circular": {"radius_m": radius, "opening_angle_deg": 100}}),
        json!({"circular": {"span_m": 2.0 * radius * half.sin(), "rise_m": radius * (1.0 - half.cos())}}),
        json!({"multi_centre": {"arcs": [{"radius_m": radius, "angle_deg": 50}]}}),
    ];
    let request = |arch: Value| {
        let load = json!({"load": {"point_load": {"force_n_per_m": 1000, "x_m": -2.0}}, "scaled": true});
        json!({"arch": arch, "loads": [{"load": {"self_weight": {}}}, load]})
    };
    let typed = shapes.map(|profile| {
        solved(&request(json!({"profile": profile, "thickness": {"constant_m": 0.5}, "voussoirs": 21})))
    });
    let faces = [0, 1].map(|end| -> Vec<Value> {
        list(&typed[0]["structure"], "joints").iter().map(|joint| joint["ends_m"][end].clone()).collect()
    });
    let surveyed = solved(&request(json!({"profile": {"surveyed": {"intrados_m": faces[0], "extrados_m": faces[1]}}})));
    let expected = list(&typed[0]["ends"][0], "hinges");
    assert!(expected.len() == 4 && number(&expected[0], "/angle_from_springing_deg").is_finite());
    for answer in [&typed[1], &typed[2], &surveyed] {
        let found = list(&answer["ends"][0], "hinges");
        assert_eq!(found.len(), expected.len());
        for (a, b) in found.iter().zip(expected) {
            assert_eq!((&a["joint"], &a["face"]), (&b["joint"], &b["face"]));
            for name in ["/angle_from_springing_deg", "/angle_from_crown_deg"] {
                assert!((number(a, name) - number(b, name)).abs() < 1e-9, "{a} {b}");
            }
        }
    }
}

#[test]
fn forces_over_the_width_are_those_per_metre_times_the_width() {
    let mut request = semicircle(1e30, -5.0);
    assert!(solved(&request)["ends"][0]["scaled_load"]["y_kn"].is_null());
    request["width_m"] = json!(4);
    let whole = solved(&request);
    let end = &whole["ends"][0];
    let [x, y] = ["x_kn_per_m", "y_kn_per_m"].map(|name| number(&end["scaled_load"], &format!("/{name}")));
    // One load of 1 kN/m, downwards.
    assert!(x == 0.0 && close(y, -number(end, "/load_factor"), 1e-12), "{end}");
    assert!(close(number(end, "/scaled_load/y_kn"), 4.0 * y, 1e-12), "{end}");
    let thrust = &whole["thrust_range"];
    for (per_metre, over_all) in [("/lowest_kn_per_m", "/lowest_kn"), ("/highest_kn_per_m", "/highest_kn")] {
        assert!(close(4.0 * number(thrust, per_metre), number(thrust, over_all), 1e-12), "{thrust}");
    }
    assert!(text(&request).contains("scaled loads at collapse (0, -"), "{}", text(&request));
    // A vehicle has a width of its own.
    let mut driven = request.clone();
    let vehicle = json!({
        "standard": "cs454_single", "length_m": 0.25, "effective_width_m": 2, "effective_width_rule": "one lane", "x_m": 0, "dispersal": {}
    });
    driven["loads"][1]["load"] = json!({ "vehicle": vehicle });
    driven["backfill"] = json!({"surface_height_m": 11});
    let load = &solved(&driven)["ends"][0]["scaled_load"];
    assert!(load["y_kn"].is_null() && load["x_kn"].is_null() && number(load, "/y_kn_per_m") < 0.0, "{load}");
    // What falls as built has no load at which it falls.
    let mut thin = request.clone();
    thin["arch"]["thickness"]["constant_m"] = json!(0.9);
    let thin = text(&thin);
    assert!(
        thin.contains("falls as built") && thin.contains("over the width") && !thin.contains("at collapse ("),
        "{thin}"
    );
    // Half an arch stands for the whole.
    request["loads"][1]["load"]["point_load"]["x_m"] = json!(0);
    let whole = solved(&request);
    request["arch"]["half"] = json!(true);
    let half = solved(&request);
    let loads = [&whole, &half].map(|result| number(result, "/ends/0/scaled_load/y_kn"));
    assert!(close(loads[0], loads[1], 1e-6), "{loads:?}");
}
