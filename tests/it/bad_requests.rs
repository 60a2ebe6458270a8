//! Requests that cannot be: each is refused, and the refusal points at what to mend.

use crate::common::places::places;
use proptest::prelude::*;
use serde_json::{Value, json};
use voussoir::wire::fault::Fault;
use voussoir::wire::read::{read, read_analysis};

/// A request with something of everything, and nothing wrong.
fn good() -> Value {
    json!({
        "name": "all of it",
        "arch": {
            "profile": {"circular": {"radius_m": 4.0, "opening_angle_deg": 150}},
            "line": "axis", "thickness": {"constant_m": 0.6}, "voussoirs": 12, "joints": "normal",
            "relative_lengths": [1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1],
            "abutments": {"height_m": 1.0}, "springing_joints": "dry"
        },
        "stone": {"density_kg_m3": 2000, "plane": "strain"},
        "mesh": {"subblocks": {"uniform": {"radial": 2, "along": 3}}, "seams": "split"},
        "joint_overrides": [{"joint": 6, "friction_angle_deg": 20}],
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"fill_pressure": {"fill_height_m": 5.0, "embankment_thickness_m": 0.5}}},
            {"load": {"point_load": {"force_n_per_m": 1000, "x_m": -1}}, "scaled": true, "coefficient": 2},
            {"load": {"patch_load": {"centre_x_m": 1, "width_m": 1, "force_n_per_m": 1000}}, "scaled": true},
            {"load": {"lateral_pressure": {"bands": [{"from_m": 0, "to_m": 1, "pressure_pa": 100}]}}},
            {"load": {"body_acceleration": {"x_g": 0.1}}}
        ],
        "load_factor": {"direction": "increase", "cap": 1000, "unit": "kN", "intensity_per_unit": 1},
        "method": {"fixed_steps": {"step": 1}},
        "analysis": "collapse",
        "report": {"share_of_collapse": 0.99, "stress_fields": ["unit_load", {"load_factor": 2}]}
    })
}

/// `request` with the value at `pointer` replaced or, where its parent is an object, added.
fn set(request: &mut Value, pointer: &str, value: Value) {
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    match request.pointer_mut(parent).unwrap() {
        Value::Object(object) => {
            object.insert(key.to_owned(), value);
        }
        Value::Array(list) => list[key.parse::<usize>().unwrap()] = value,
        other => panic!("{other}"),
    }
}

fn remove(request: &mut Value, pointer: &str) {
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    request.pointer_mut(parent).unwrap().as_object_mut().unwrap().remove(key).unwrap();
}

fn faults(request: &Value) -> Vec<Fault> {
    read_analysis(request.to_string().as_bytes()).expect_err("was not refused")
}

fn pointers(faults: &[Fault]) -> Vec<&str> {
    faults.iter().map(|fault| fault.pointer.as_str()).collect()
}

#[test]
fn the_good_request_is_good() {
    let refused = read_analysis(good().to_string().as_bytes()).err();
    assert!(refused.is_none(), "{refused:?}");
}

#[test]
fn one_wrong_value_is_pointed_at_and_nothing_else() {
    let circle = "/arch/profile/circular";
    let p = |rest: &str| format!("{circle}/{rest}");
    let load = |i: usize, rest: &str| format!("/loads/{i}/load/{rest}");
    let table: Vec<(String, Value)> = vec![
        ("/name".into(), json!("x".repeat(201))),
        ("/name".into(), json!(7)),
        ("/name".into(), json!("two\nlines")),
        ("/name".into(), json!("\u{1b}]0;title\u{7}")),
        ("/load_factor/unit".into(), json!("kN\u{7f}")),
        (p("radius_m"), json!(0)),
        (p("radius_m"), json!(-4)),
        (p("radius_m"), json!("4 m")),
        (p("radius_m"), json!(1e9)),
        (p("opening_angle_deg"), json!(360)),
        (p("opening_angle_deg"), json!(-150)),
        (p("opening"), json!(150)),
        ("/arch/line".into(), json!("extrados")),
        ("/arch/thickness/constant_m".into(), json!(0)),
        ("/arch/thickness/constant_m".into(), json!(-0.1)),
        ("/arch/thickness/constant_m".into(), json!(8)),
        ("/arch/thickness/constant_m".into(), json!([0.5])),
        ("/arch/voussoirs".into(), json!(1)),
        ("/arch/voussoirs".into(), json!(2002)),
        ("/arch/voussoirs".into(), json!(12.5)),
        ("/arch/voussoirs".into(), json!(-12)),
        ("/arch/voussoirs".into(), json!("many")),
        ("/arch/joints".into(), json!("radial")),
        ("/arch/relative_lengths".into(), json!([1, 1])),
        ("/arch/relative_lengths/4".into(), json!(0)),
        ("/arch/relative_lengths/5".into(), json!(null)),
        ("/arch/curved_sides".into(), json!("yes")),
        ("/arch/abutments/height_m".into(), json!(0)),
        ("/arch/springing_joints".into(), json!("glued")),
        ("/stone/density_kg_m3".into(), json!(0)),
        ("/stone/density_kg_m3".into(), json!(1e6)),
        ("/stone/youngs_modulus_pa".into(), json!(-1e9)),
        ("/stone/poissons_ratio".into(), json!(0.5)),
        ("/stone/poissons_ratio".into(), json!(-1)),
        ("/stone/friction_angle_deg".into(), json!(90)),
        ("/stone/friction_angle_deg".into(), json!(-1)),
        ("/stone/cohesion_pa".into(), json!(-1)),
        ("/stone/compressive_strength_pa".into(), json!(0)),
        ("/stone/penalty_ratio".into(), json!(0)),
        ("/stone/penalty_ratio".into(), json!(0.0099)),
        ("/stone/penalty_ratio".into(), json!(100.1)),
        ("/stone/plane".into(), json!("elastic")),
        ("/stone/density".into(), json!(2300)),
        ("/joint_overrides/0/joint".into(), json!(13)),
        ("/joint_overrides/0/joint".into(), json!(-1)),
        ("/joint_overrides/0/friction_angle_deg".into(), json!(95)),
        ("/joint_overrides/0/cohesion_pa".into(), json!(-5)),
        ("/joint_overrides/0/friction".into(), json!(0.5)),
        ("/loads".into(), json!([])),
        ("/loads".into(), json!({})),
        ("/loads/0/load".into(), json!("self_weight")),
        ("/loads/0/load/self_weight/density".into(), json!(1)),
        ("/loads/2/scaled".into(), json!(1)),
        ("/loads/2/coefficient".into(), json!(0)),
        ("/loads/2/coefficient".into(), json!(1e300)),
        (load(1, "fill_pressure/fill_height_m"), json!(3.0)),
        (load(1, "fill_pressure/fill_density_kg_m3"), json!(-1)),
        (load(1, "fill_pressure/embankment_thickness_m"), json!(-1)),
        (load(1, "fill_pressure/embankment_density_kg_m3"), json!(-1)),
        (load(1, "fill_pressure/lateral_ratio"), json!(-0.5)),
        (load(1, "fill_pressure/fill_friction_angle_deg"), json!(120)),
        (load(1, "fill_pressure/fill_hieght_m"), json!(5)),
        (load(2, "point_load/force_n_per_m"), json!(0)),
        (load(2, "point_load/force_n_per_m"), json!(1e20)),
        (load(2, "point_load/x_m"), json!(9)),
        (load(3, "patch_load/centre_x_m"), json!(4)),
        (load(3, "patch_load/width_m"), json!(0)),
        (load(3, "patch_load/force_n_per_m"), json!(0)),
        (load(4, "lateral_pressure/bands"), json!([])),
        (load(4, "lateral_pressure/bands/0/to_m"), json!(-1)),
        (load(4, "lateral_pressure/bands/0/pressure_pa"), json!(1e20)),
        (load(5, "body_acceleration/x_g"), json!(1e20)),
        (load(5, "body_acceleration/y_g"), json!(true)),
        ("/load_factor/direction".into(), json!("up")),
        ("/load_factor/cap".into(), json!(0)),
        ("/load_factor/cap".into(), json!(-1)),
        ("/load_factor/intensity_per_unit".into(), json!(0)),
        ("/load_factor/unit".into(), json!("u".repeat(300))),
        ("/method".into(), json!("newmark")),
        ("/method/fixed_steps/step".into(), json!(0)),
        ("/method/fixed_steps/opening_m".into(), json!(-0.01)),
        ("/method/fixed_steps/hinges".into(), json!(0)),
        ("/method/fixed_steps/hinges".into(), json!(99)),
        ("/report/share_of_collapse".into(), json!(1)),
        ("/report/share_of_collapse".into(), json!(0)),
        ("/report/first_yield_length_m".into(), json!(0)),
        ("/reports".into(), json!({})),
        ("/a~1b~0c".into(), json!(1)),
    ];
    assert!(table.len() >= 45);
    for (pointer, value) in table {
        let mut request = good();
        let key = pointer.replace("~1", "\u{1}").replace("~0", "~");
        if key.contains('\u{1}') {
            request.as_object_mut().unwrap().insert(key.trim_start_matches('/').replace('\u{1}', "/"), value.clone());
        } else {
            set(&mut request, &pointer, value.clone());
        }
        let faults = faults(&request);
        assert_eq!(pointers(&faults), [pointer.as_str()], "{value}: {faults:?}");
        assert!(faults[0].detail.len() > 20, "{faults:?}");
    }
}

#[test]
fn the_ends_of_the_range_of_penalties_are_in_it() {
    for ratio in [0.01, 100.0] {
        let mut request = good();
        set(&mut request, "/stone/penalty_ratio", json!(ratio));
        assert!(read_analysis(request.to_string().as_bytes()).is_ok(), "{ratio}");
    }
}

#[test]
fn a_missing_field_is_named() {
    for pointer in [
        "/arch",
        "/arch/profile",
        "/arch/thickness",
        "/arch/voussoirs",
        "/loads",
        "/loads/0/load",
        "/loads/2/load/point_load/force_n_per_m",
        "/loads/3/load/patch_load/width_m",
        "/loads/4/load/lateral_pressure/bands",
        "/joint_overrides/0/joint",
        "/method/fixed_steps/step",
    ] {
        let mut request = good();
        remove(&mut request, pointer);
        let faults = faults(&request);
        assert_eq!(pointers(&faults), [pointer]);
        assert!(faults[0].detail.contains("missing"), "{faults:?}");
    }
}

#[test]
fn combinations_that_cannot_be() {
    let circle = json!({"circular": {"radius_m": 4.0, "opening_angle_deg": 150}});
    let too_far = json!([{"radius_m": 4, "angle_deg": 100}, {"radius_m": 4, "angle_deg": 90}]);
    let triple = json!([[-1, 0], [0, 1], [1, 0]]);
    // (what to set, where the fault is seen)
    let table: Vec<(Vec<(&str, Value)>, &str)> = vec![
        (vec![("/arch/profile", json!({"circular": {"radius_m": 4.0}}))], "/arch/profile/circular"),
        (vec![("/arch/profile/circular/span_m", json!(3))], "/arch/profile/circular"),
        (vec![("/arch/profile", json!({"circular": {}, "pointed": {}}))], "/arch/profile"),
        (vec![("/arch/profile", json!({}))], "/arch/profile"),
        (vec![("/arch/profile", json!({"parabolic": {"rise_m": 1}}))], "/arch/profile"),
        (
            vec![("/arch/profile", json!({"pointed": {"radius_m": 4.0, "centre_offset_m": 4.0}}))],
            "/arch/profile/pointed/centre_offset_m",
        ),
        (vec![("/arch/profile", json!({"pointed": {"span_m": 4.0, "rise_m": 1.9}}))], "/arch/profile/pointed/rise_m"),
        (
            vec![("/arch/profile", json!({"elliptical": {"span_m": -1, "rise_m": 1}}))],
            "/arch/profile/elliptical/span_m",
        ),
        (
            vec![("/arch/profile", json!({"elliptical": {"span_m": 9, "rise_m": 0.01}}))],
            "/arch/profile/elliptical/rise_m",
        ),
        (vec![("/arch/profile", json!({"multi_centre": {"arcs": []}}))], "/arch/profile/multi_centre/arcs"),
        (
            vec![("/arch/profile", json!({"multi_centre": {"arcs": [{"radius_m": 4, "angle_deg": 0}]}}))],
            "/arch/profile/multi_centre/arcs/0/angle_deg",
        ),
        (vec![("/arch/profile", json!({"multi_centre": {"arcs": too_far}}))], "/arch/profile/multi_centre/arcs"),
        (
            vec![("/arch/profile", json!({"multi_centre": {"arcs": [{"radius_m": -4, "angle_deg": 75}]}}))],
            "/arch/profile/multi_centre/arcs/0/radius_m",
        ),
        (
            vec![("/arch/thickness", json!({"linear": {"crown_m": 0.5, "springing_m": -1}}))],
            "/arch/thickness/linear/springing_m",
        ),
        (vec![("/arch/thickness", json!({"extrados_circle": {"radius_m": 5, "centre_y_m": -1}}))], "/arch/line"),
        (
            vec![
                ("/arch/thickness", json!({"extrados_circle": {"radius_m": 3.9, "centre_y_m": -1.0}})),
                ("/arch/line", json!("intrados")),
            ],
            "/arch/thickness",
        ),
        (vec![("/arch/joints", json!({"rays": {"centre_m": [0, 30]}}))], "/arch/joints/rays/centre_m"),
        (vec![("/arch/joints", json!({"rays": {"centre_m": [0, 1e7]}}))], "/arch/joints/rays/centre_m/1"),
        (vec![("/arch/joints", json!({"rays": {"centre_m": [0, 1, 2]}}))], "/arch/joints/rays/centre_m"),
        (
            vec![("/arch/curved_sides", json!(true)), ("/arch/joints", json!({"rays": {"centre_m": [0, -1]}}))],
            "/arch/curved_sides",
        ),
        (vec![("/loads/2/load/point_load/voussoir", json!(3))], "/loads/2/load/point_load"),
        (vec![("/loads/2/load", json!({"point_load": {"force_n_per_m": 1}}))], "/loads/2/load/point_load"),
        (
            vec![("/loads/2/load", json!({"point_load": {"force_n_per_m": 1, "voussoir": 12}}))],
            "/loads/2/load/point_load/voussoir",
        ),
        (vec![("/loads/1/load", json!({"fill_pressure": {}}))], "/loads/1/load/fill_pressure"),
        (vec![("/loads/1/load", json!({"fill_pressure": {"fill_height_m": -3}}))], "/loads/1"),
        (vec![("/loads/5/load", json!({"body_acceleration": {}}))], "/loads/5"),
        (
            vec![("/loads/4/load/lateral_pressure/bands/0", json!({"from_m": 50, "to_m": 60, "pressure_pa": 5}))],
            "/loads/4",
        ),
        (vec![("/joint_overrides", json!([{"joint": 6}]))], "/joint_overrides/0"),
        (
            vec![("/joint_overrides", json!([{"joint": 6, "cohesion_pa": 1}, {"joint": 6, "cohesion_pa": 2}]))],
            "/joint_overrides/1/joint",
        ),
        (
            vec![
                ("/arch/springing_joints", json!("bonded")),
                ("/joint_overrides", json!([{"joint": 12, "cohesion_pa": 1}])),
            ],
            "/joint_overrides/0/joint",
        ),
    ];
    for (changes, pointer) in table {
        let mut request = good();
        request["arch"]["profile"] = circle.clone();
        for (at, value) in &changes {
            set(&mut request, at, value.clone());
        }
        let faults = faults(&request);
        assert!(faults.iter().all(|fault| fault.pointer == pointer), "{changes:?} {faults:?}");
    }
    let mut surveyed = good();
    surveyed["arch"]["profile"] =
        json!({"surveyed": {"intrados_m": triple, "extrados_m": [[-2, 0], [0, 2], [2, 0], [3, 0]]}});
    assert_eq!(
        pointers(&faults(&surveyed)),
        [
            "/arch/line",
            "/arch/thickness",
            "/arch/voussoirs",
            "/arch/joints",
            "/arch/relative_lengths",
            "/arch/profile/surveyed/extrados_m"
        ]
    );
}

#[test]
fn stones_that_cannot_be_built_are_refused() {
    let survey = |intrados: Value, extrados: Value| {
        json!({"arch": {"profile": {"surveyed": {"intrados_m": intrados, "extrados_m": extrados}}},
               "loads": [{"load": {"self_weight": {}}}]})
    };
    let right = survey(json!([[-1, 0], [0, 1], [1, 0]]), json!([[-2, 0], [0, 2], [2, 0]]));
    assert!(read_analysis(right.to_string().as_bytes()).is_ok());
    let turned = survey(json!([[1, 0], [0, 1], [-1, 0]]), json!([[2, 0], [0, 2], [-2, 0]]));
    let points = ["/arch/profile/surveyed/intrados_m/0", "/arch/profile/surveyed/intrados_m/1"];
    assert_eq!(pointers(&faults(&turned)), points);
    let crossing = survey(json!([[-1, 0], [0, 1], [1, 0]]), json!([[-2, 0], [-3, -1], [2, 0]]));
    assert_eq!(pointers(&faults(&crossing))[0], points[0]);
    let swapped = survey(json!([[-2, 0], [0, 1], [1, 0]]), json!([[-1, 0], [0, 2], [2, 0]]));
    assert_eq!(pointers(&faults(&swapped)), [points[0]]);
    let short = survey(json!([[-1, 0], [1, 0]]), json!([[-2, 0], [2, 0]]));
    assert_eq!(pointers(&faults(&short)), ["/arch/profile/surveyed/extrados_m", "/arch/profile/surveyed/intrados_m"]);
    let far = survey(json!([[-1, 0], [0, 1e9], [1, 0]]), json!([[-2, 0], [0, 2], [2, 0]]));
    assert_eq!(pointers(&faults(&far)), ["/arch/profile/surveyed/intrados_m/1/1"]);
    let closed = survey(
        json!([[-0.1, -1], [-1, 0], [0, 1], [1, 0], [0.1, -1]]),
        json!([[0.3, -2], [-2, 0], [0, 2], [2, 0], [-0.3, -2]]),
    );
    assert_eq!(pointers(&faults(&closed)), ["/arch/profile/surveyed"]);
    // The ring thickens faster than its radius grows: normals cross before they reach the intrados.
    let mut low = good();
    let arcs = json!([{"radius_m": 0.3, "angle_deg": 60}, {"radius_m": 6, "angle_deg": 30}]);
    low["arch"]["profile"] = json!({"multi_centre": {"arcs": arcs}});
    low["arch"]["thickness"] = json!({"linear": {"crown_m": 2.0, "springing_m": 0.5}});
    low["arch"]["voussoirs"] = json!(400);
    low["arch"].as_object_mut().unwrap().remove("relative_lengths");
    assert!(pointers(&faults(&low)).iter().all(|pointer| *pointer == "/arch"));
}

#[test]
fn half_an_arch_has_to_be_half_of_something_symmetric() {
    let mut request = good();
    request["arch"]["half"] = json!(true);
    assert_eq!(pointers(&faults(&request)), ["/loads/2", "/loads/3", "/loads/5"]);
    request["loads"] = json!([{"load": {"self_weight": {}}}]);
    assert!(read_analysis(request.to_string().as_bytes()).is_ok());
    request["joint_overrides"][0]["joint"] = json!(5);
    assert_eq!(pointers(&faults(&request)), ["/arch/half"]);
    request["joint_overrides"] = json!([]);
    request["arch"]["voussoirs"] = json!(11);
    request["arch"].as_object_mut().unwrap().remove("relative_lengths");
    assert!(read_analysis(request.to_string().as_bytes()).is_ok());
}

#[test]
fn all_faults_are_reported_together() {
    let mut request = good();
    set(&mut request, "/arch/colour", json!("red"));
    set(&mut request, "/arch/profile/circular/diameter_m", json!(8));
    set(&mut request, "/stone/poissons_ratio", json!(2));
    set(&mut request, "/report/share_of_collapse", json!(3));
    set(&mut request, "/loads/2/load/point_load/x_m", json!(1e9));
    let found = faults(&request);
    for pointer in [
        "/arch/colour",
        "/arch/profile/circular/diameter_m",
        "/stone/poissons_ratio",
        "/report/share_of_collapse",
        "/loads/2/load/point_load/x_m",
    ] {
        assert!(pointers(&found).contains(&pointer), "{pointer}: {found:?}");
    }
    let mut request = good();
    set(&mut request, "/arch/voussoirs", json!("many"));
    set(&mut request, "/arch/thickness", json!({"constant": 3}));
    set(&mut request, "/stone/density_kg_m3", json!([]));
    set(&mut request, "/loads/0/load", json!({"weight": {}}));
    remove(&mut request, "/loads/3/load/patch_load/width_m");
    set(&mut request, "/method", json!(3));
    set(&mut request, "/report/share", json!(3));
    let found = faults(&request);
    for pointer in [
        "/arch/voussoirs",
        "/arch/thickness",
        "/stone/density_kg_m3",
        "/loads/0/load",
        "/loads/3/load/patch_load/width_m",
        "/method",
        "/report/share",
    ] {
        assert!(pointers(&found).contains(&pointer), "{pointer}: {found:?}");
    }
    assert_eq!(found.len(), 7, "{found:?}");
}

#[test]
fn text_that_is_no_json_is_refused_with_line_and_column() {
    for text in ["", "{", "{\"arch\": NaN}", "{\"arch\": 1e999}", "[1,]", "{} {}", "\u{feff}{}", "{\"a\": \"\\ud800\"}"]
    {
        let faults = read(text.as_bytes()).unwrap_err();
        assert_eq!(pointers(&faults), [""], "{text}");
        assert!(faults[0].detail.contains("line 1 column"), "{faults:?}");
    }
    assert_eq!(pointers(&read(&[0xff, 0xfe]).unwrap_err()), [""]);
    assert_eq!(pointers(&read("[".repeat(100_000).as_bytes()).unwrap_err()), [""]);
    for text in ["null", "3", "[]", "\"arch\""] {
        assert_eq!(pointers(&read(text.as_bytes()).unwrap_err()), [""], "{text}");
    }
    assert_eq!(pointers(&read(b"{}").unwrap_err()), ["/loads"]);
}

#[test]
fn a_list_is_no_object_and_an_object_no_word() {
    let a_list = [
        ("/stone", json!([])),
        ("/stone", json!([2000, 1e9])),
        ("/arch", json!([1])),
        ("/mesh/subblocks/uniform", json!([2, 3])),
        ("/loads/0/load/self_weight", json!([])),
        ("/loads/0", json!([{"self_weight": {}}])),
        ("/joint_overrides/0", json!([6, 20])),
        ("/arch/abutments", json!([1])),
    ];
    for (pointer, value) in a_list {
        let mut request = good();
        set(&mut request, pointer, value);
        let found = faults(&request);
        assert_eq!(pointers(&found), [pointer], "{found:?}");
        assert!(found[0].detail.starts_with("a list where an object belongs"), "{found:?}");
    }
    for (pointer, value) in [("/method", json!({"event_path": null})), ("/arch/line", json!({"axis": null}))] {
        let mut request = good();
        set(&mut request, pointer, value);
        let found = faults(&request);
        assert_eq!(pointers(&found), [pointer], "{found:?}");
        assert!(found[0].detail.starts_with("an object where text belongs: write"), "{found:?}");
    }
}

#[test]
fn a_fault_says_how_the_field_is_written() {
    for (pointer, value, words) in [
        ("/arch/thickness", json!(0.8), r#"a number where an object belongs: give one of {"constant_m": ...}, {"#),
        ("/loads/0/load/self_weight", json!(true), "true or false where an object belongs: write {}"),
        ("/backfill", json!(true), r#"true or false where an object belongs: write {} for its defaults, or give"#),
        ("/loads/1/load/fill_pressure", json!(5), r#"write {} for its defaults, or give its fields by name: {""#),
        (
            "/stone",
            json!(2000),
            r#"a number where an object belongs: write {} for its defaults, or give its fields by name: {""#,
        ),
        ("/loads/2/point_load", json!({"x_m": 1}), "no field of this name here: put it inside `load`, or remove it"),
        ("/half", json!(true), "no field of this name here: put it inside `arch`, or remove it"),
        ("/loads/2/load/point_load/where", json!(1), "remove it or correct its spelling, of `"),
    ] {
        let mut request = good();
        set(&mut request, pointer, value);
        let found = faults(&request);
        let here = found.iter().find(|fault| fault.pointer == pointer);
        assert!(here.is_some_and(|fault| fault.detail.contains(words)), "{pointer}: {found:?}");
    }
}

#[test]
fn one_cause_is_one_fault() {
    let settlement = json!({
        "arch": good()["arch"], "loads": [{"load": {"self_weight": {}}}],
        "analysis": {"settlement": {"left": {"outward_m": 0.1}}}
    });
    assert_eq!(pointers(&faults(&settlement)), ["/analysis/settlement/left/outward_m"]);
    let mut request = good();
    set(&mut request, "/loads/1/load", json!({"fill_pressure": {"fill_hieght_m": 5}}));
    assert_eq!(pointers(&faults(&request)), ["/loads/1/load/fill_pressure/fill_hieght_m"]);
    let mut request = good();
    set(&mut request, "/analysis", json!({"safety": {}}));
    set(&mut request, "/geometry", json!("updated"));
    assert_eq!(pointers(&faults(&request)), ["/method"]);
    let mut request = good();
    set(&mut request, "/curved_beam", json!({"inner_radius_m": 1, "outer_radius_m": 2, "end_shear_n_per_m": 1}));
    let found = faults(&request);
    let of_an_arch = ["/analysis", "/arch", "/joint_overrides", "/load_factor", "/loads", "/method", "/report"];
    assert_eq!(pointers(&found), of_an_arch);
    assert!(found.iter().all(|fault| fault.detail.contains("goes with an arch")), "{found:?}");
}

#[test]
fn what_does_not_go_with_crushing_in_the_path_is_refused() {
    let mut request = good();
    set(&mut request, "/crushing_in_path", json!(true));
    set(&mut request, "/method", json!("event_path"));
    set(&mut request, "/mesh", json!({}));
    assert!(read_analysis(request.to_string().as_bytes()).is_ok());
    for (pointer, value) in [
        ("/analysis", json!({"safety": {}})),
        ("/analysis", json!({"settlement": {"left": {"outwards_m": 0.1}}})),
        ("/geometry", json!("updated")),
        ("/method", json!({"fixed_steps": {"step": 1}})),
        ("/mesh", json!({"subblocks": {"uniform": {"radial": 2, "along": 2}}})),
        ("/accuracy", json!({"collapse_intensity": 0.1})),
        ("/motion", json!({})),
        ("/report/first_yield_length_m", json!(0.2)),
    ] {
        let mut request = request.clone();
        set(&mut request, pointer, value);
        let found = faults(&request);
        assert!(
            found.iter().any(|fault| fault.detail.contains("crushing_in_path") && fault.pointer.starts_with(pointer)),
            "{found:?}"
        );
    }
}

#[test]
fn what_a_settlement_makes_no_use_of_is_refused() {
    let mut request = good();
    for pointer in ["/method", "/load_factor/unit", "/report/stress_fields"] {
        remove(&mut request, pointer);
    }
    set(&mut request, "/analysis", json!({"settlement": {"left": {"outwards_m": 0.01}}}));
    set(&mut request, "/load_factor/direction", json!("decrease"));
    set(&mut request, "/loads/2/scaled", json!(false));
    set(&mut request, "/loads/3/scaled", json!(false));
    let unused = ["/load_factor/direction", "/load_factor/cap", "/report/share_of_collapse"];
    assert_eq!(pointers(&faults(&request)), unused);
    let settles = request["analysis"].clone();
    set(&mut request, "/analysis", json!({"geometric_safety": {}}));
    assert_eq!(pointers(&faults(&request)), unused);
    for (pointer, value) in [
        ("/geometry", json!("updated")),
        ("/loads/2/scaled", json!(true)),
        ("/accuracy", json!({"collapse_intensity": 1e-6})),
        ("/crushing_in_path", json!(true)),
        ("/motion", json!({})),
        ("/report/first_yield_length_m", json!(0.2)),
    ] {
        let mut request = request.clone();
        set(&mut request, pointer, value);
        let found = faults(&request);
        assert!(found.iter().any(|fault| fault.pointer == pointer || pointer == "/crushing_in_path"), "{found:?}");
    }
    set(&mut request, "/analysis", settles);
    // An answer repeats its request with all defaults, and what it repeats can be sent again.
    set(&mut request, "/load_factor", json!({"direction": "increase"}));
    set(&mut request, "/report", json!({"share_of_collapse": 0.999}));
    assert!(read_analysis(request.to_string().as_bytes()).is_ok());
}

#[test]
fn faults_are_short_whatever_the_numbers_are() {
    for pointer in ["/arch/thickness/constant_m", "/arch/voussoirs", "/stone/poissons_ratio", "/loads/2/coefficient"] {
        let mut request = good();
        set(&mut request, pointer, json!(1e300));
        let found = faults(&request);
        assert_eq!(pointers(&found), [pointer]);
        assert!(found[0].detail.len() < 200, "{found:?}");
    }
    let mut request = good();
    set(&mut request, "/arch/line", json!("x".repeat(5000)));
    assert!(faults(&request)[0].detail.len() < 200);
}

#[test]
fn a_name_that_stands_twice_is_refused() {
    let text = good().to_string().replacen("\"voussoirs\":12", "\"voussoirs\":12,\"voussoirs\":13", 1);
    let found = read_analysis(text.as_bytes()).unwrap_err();
    assert!(pointers(&found).contains(&"/arch/voussoirs"), "{found:?}");
}

fn any_json() -> impl Strategy<Value = Value> {
    let words = ["arch", "loads", "profile", "circular", "radius_m", "load", "self_weight", "x_m", "rays", "surveyed"];
    let leaf = prop_oneof![
        Just(Value::Null),
        any::<bool>().prop_map(Value::from),
        any::<i64>().prop_map(Value::from),
        any::<f64>().prop_map(Value::from),
        (-3.0..3.0).prop_map(Value::from),
        prop::sample::select(words.to_vec()).prop_map(Value::from),
    ];
    leaf.prop_recursive(5, 40, 6, move |inner| {
        let name = prop_oneof![prop::sample::select(words.to_vec()).prop_map(str::to_owned), ".{0,4}"];
        prop_oneof![
            prop::collection::vec(inner.clone(), 0..6).prop_map(Value::from),
            prop::collection::btree_map(name, inner, 0..6)
                .prop_map(|members| Value::Object(members.into_iter().collect())),
        ]
    })
}

proptest! {
    #[test]
    fn reading_any_bytes_never_panics(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = read_analysis(&bytes);
    }

    #[test]
    fn reading_any_json_never_panics(tree in any_json()) {
        prop_assert!(read_analysis(tree.to_string().as_bytes()).is_err());
    }

    #[test]
    fn reading_a_spoilt_request_never_panics(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any_json()), 1..4),
    ) {
        let mut request = good();
        for (index, value) in changes {
            let mut all = Vec::new();
            places(&request, "", &mut all);
            let place = index.get(&all).clone();
            if let Some(target) = request.pointer_mut(&place) {
                *target = value;
            }
        }
        if let Err(faults) = read_analysis(request.to_string().as_bytes()) {
            prop_assert!(!faults.is_empty());
        }
    }

    #[test]
    fn numbers_of_any_size_never_panic(
        places_and_values in prop::collection::vec((0..30usize, prop_oneof![-10.0..10.0f64, any::<f64>()]), 1..5),
    ) {
        let mut request = good();
        let mut all = Vec::new();
        places(&request, "", &mut all);
        all.retain(|place| request.pointer(place).is_some_and(Value::is_number));
        for (i, value) in places_and_values {
            let place = all[i % all.len()].clone();
            if let Some(target) = request.pointer_mut(&place) {
                *target = json!(value);
            }
        }
        if let Ok((_, analysis)) = read_analysis(request.to_string().as_bytes()) {
            prop_assert!(analysis.fixed.iter().chain(&analysis.scaled).all(|force| force.force.norm().is_finite()));
        }
    }
}
