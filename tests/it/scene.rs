//! Ready requests can be read, and say what they mean.

use crate::common::folders;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use voussoir::collapse::{Analysis, CollapseTask, Direction, Method, Task};
use voussoir::structure::JointLaw;
use voussoir::wire::read::{read, read_analysis, read_question};

fn cases() -> Vec<PathBuf> {
    folders::folders(&folders::cases())
}

fn analysis(name: &str) -> Analysis {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name).join("request.json");
    read_analysis(&std::fs::read(file).unwrap()).unwrap().1
}

fn analyse(request: &Value) -> Analysis {
    read_analysis(request.to_string().as_bytes()).unwrap().1
}

#[test]
fn every_case_can_be_read_and_says_what_to_expect() {
    assert!(cases().len() >= 13);
    for case in cases() {
        let text = std::fs::read(case.join("request.json")).unwrap();
        let faults = read_question(&text).err();
        assert!(faults.is_none(), "{}: {faults:?}", folders::name(&case));
        let expected: Value = serde_json::from_slice(&std::fs::read(case.join("expected.json")).unwrap()).unwrap();
        let kind = expected["kind"].as_str().unwrap();
        assert!(
            ["limit_analysis", "published", "closed_form", "separate_solution"].contains(&kind),
            "{}",
            folders::name(&case)
        );
        assert!(expected["source"].is_string() && expected["tolerance"].is_object() && expected["note"].is_string());
        assert!(expected["quantities"].is_object(), "{}", folders::name(&case));
    }
}

#[test]
fn a_request_with_its_defaults_reads_as_itself() {
    for case in cases() {
        let request = read(&std::fs::read(case.join("request.json")).unwrap()).unwrap();
        let echo = serde_json::to_vec(&request).unwrap();
        assert_eq!(read(&echo).unwrap(), request, "{}", folders::name(&case));
    }
    let first = read(
        br#"{"arch": {"profile": {"circular": {"span_m": 4, "rise_m": 1}}, "thickness": {"constant_m": 0.3},
        "voussoirs": 9}, "loads": [{"load": {"self_weight": {}}}]}"#,
    );
    let echo = serde_json::to_value(first.unwrap()).unwrap();
    assert_eq!(echo["arch"]["line"], "axis");
    assert_eq!(echo["arch"]["joints"], "normal");
    assert_eq!(echo["arch"]["springing_joints"], "dry");
    assert_eq!(echo["stone"]["friction_angle_deg"], 30.0);
    assert_eq!(echo["stone"]["penalty_ratio"], 10.0);
    assert_eq!(echo["loads"][0]["coefficient"], 1.0);
    assert_eq!(echo["method"], "event_path");
    assert_eq!(echo["report"]["share_of_collapse"], 0.999);
}

#[test]
fn the_buried_arch_weighs_and_carries_what_the_reference_says() {
    for (joints, weight, gravel) in
        [(9, 188.0, 100.04), (17, 190.5, 94.82), (27, 191.02, 93.73), (61, 191.28, 93.19), (201, 191.34, 93.08)]
    {
        let analysis = analysis(&format!("paper/table-2/{joints}-joints"));
        assert_eq!(analysis.structure.ring().len(), joints);
        let down: f64 = analysis.fixed.iter().map(|force| -force.force.y / 1000.0).sum();
        assert!((down - weight - 2.0 * gravel).abs() < 0.016, "{joints}: {down}");
        let jacks: f64 = analysis.scaled.iter().map(|force| -force.force.y).sum();
        assert!((jacks - 3350.0).abs() < 1e-9);
        let abutments: f64 = analysis.structure.bodies[joints - 1..].iter().map(|block| block.region.area).sum();
        assert!((abutments * 2300.0 * 9.81 / 1000.0 - 45.58).abs() < 0.0051);
    }
}

fn plain() -> Value {
    json!({
        "arch": {
            "profile": {"circular": {"radius_m": 2.0, "opening_angle_deg": 150}},
            "thickness": {"constant_m": 0.4}, "voussoirs": 8
        },
        "loads": [{"load": {"self_weight": {}}}]
    })
}

#[test]
fn everything_asked_arrives_in_si() {
    let mut request = plain();
    request["arch"]["springing_joints"] = json!("bonded");
    request["stone"] = json!({"friction_angle_deg": 45, "cohesion_pa": 7.0});
    request["joint_overrides"] = json!([{"joint": 3, "friction_angle_deg": 0}, {"joint": 4, "cohesion_pa": 1}]);
    request["load_factor"] = json!({"direction": "decrease", "cap": 40, "unit": "kN", "intensity_per_unit": 2});
    request["method"] = json!({"fixed_steps": {"step": 5}});
    let analysis = analyse(&request);
    assert_eq!(analysis.structure.joints[0].law, JointLaw::Bonded);
    assert_eq!(analysis.structure.joints[8].law, JointLaw::Bonded);
    assert_eq!(analysis.structure.joints[3].law, JointLaw::Dry { friction: 0.0, cohesion: 7.0 });
    let JointLaw::Dry { friction, cohesion } = analysis.structure.joints[4].law else { panic!() };
    assert!((friction - 1.0).abs() < 1e-15 && cohesion == 1.0);
    let method = Method::FixedSteps { step: 5.0, opening: 0.01, hinges: 3 };
    let task = CollapseTask { direction: Direction::Decrease, cap: Some(40.0), method, ..CollapseTask::default() };
    assert_eq!(analysis.task, Task::Collapse(task));
    assert!(analysis.scaled.is_empty() && analysis.fixed.len() == 8);
}

#[test]
fn half_an_arch_carries_half_the_loads() {
    let mut request = plain();
    request["loads"] = json!([
        {"load": {"self_weight": {}}},
        {"load": {"point_load": {"force_n_per_m": 100, "x_m": 0}}, "scaled": true},
        {"load": {"fill_pressure": {"fill_height_m": 2.5, "embankment_thickness_m": 0.5}}}
    ]);
    let whole = analyse(&request);
    request["arch"]["half"] = json!(true);
    let half = analyse(&request);
    assert!(half.structure.is_half() && half.structure.voussoirs().len() == 4 && half.structure.ring().len() == 5);
    let down = |analysis: &Analysis| analysis.fixed.iter().map(|force| force.force.y).sum::<f64>();
    assert!((down(&half) - 0.5 * down(&whole)).abs() < 1e-9);
    assert_eq!(half.scaled.iter().map(|force| force.force.y).sum::<f64>(), -50.0);
    // A keystone is cut in two on the axis: one half of it and of its loads.
    request["arch"]["voussoirs"] = json!(9);
    let half = analyse(&request);
    request["arch"]["half"] = json!(false);
    let whole = analyse(&request);
    assert!(half.structure.voussoirs().len() == 5 && half.structure.ring().len() == 6);
    assert_eq!(half.structure.joints[5].law, JointLaw::Mirror);
    assert!((2.0 * half.structure.bodies[4].region.area / whole.structure.bodies[4].region.area - 1.0).abs() < 1e-12);
    assert!((down(&half) - 0.5 * down(&whole)).abs() < 1e-9);
    assert_eq!(half.scaled.iter().map(|force| force.force.y).sum::<f64>(), -50.0);
}

#[test]
fn a_pair_of_mirrored_loads_is_symmetric() {
    let jack = |x: f64, force: f64| {
        let load = json!({"patch_load": {"centre_x_m": x, "width_m": 0.4, "force_n_per_m": force}});
        json!({"load": load, "scaled": true})
    };
    let mut request = plain();
    request["arch"]["half"] = json!(true);
    request["loads"] = json!([{"load": {"self_weight": {}}}, jack(-0.7, 1000.0), jack(0.7, 1000.0)]);
    let half = analyse(&request);
    assert_eq!(half.structure.voussoirs().len(), 4);
    let down: f64 = half.scaled.iter().map(|force| -force.force.y).sum();
    assert!((down - 1000.0).abs() < 1e-9);
    // One of the two fixed and the other scaled, or of another size, is no pair.
    request["loads"][2]["scaled"] = json!(false);
    let pointers = |request: &Value| -> Vec<String> {
        let faults = read_analysis(request.to_string().as_bytes()).unwrap_err();
        faults.into_iter().map(|fault| fault.pointer).collect()
    };
    assert_eq!(pointers(&request), ["/loads/1", "/loads/2"]);
    request["loads"][2] = jack(0.7, 999.0);
    assert_eq!(pointers(&request), ["/loads/1", "/loads/2"]);
}

#[test]
fn a_surveyed_arch_is_the_one_that_was_surveyed() {
    let drawn = analyse(&plain());
    let points = |face: fn(&voussoir::structure::Joint) -> voussoir::geometry::Vec2| -> Vec<[f64; 2]> {
        drawn.structure.ring().iter().map(|joint| [face(joint).x, face(joint).y]).collect()
    };
    let request = json!({
        "arch": {"profile": {"surveyed": {"intrados_m": points(|j| j.intrados), "extrados_m": points(|j| j.extrados)}}},
        "loads": [{"load": {"self_weight": {}}}]
    });
    let surveyed = analyse(&request);
    assert_eq!(surveyed.structure.ring(), drawn.structure.ring());
    assert_eq!(surveyed.fixed, drawn.fixed);
}
