//! Meshes, stress fields, safety factors and the curved beam: what requests mean, and which of them cannot be.

use crate::common::places::places;
use crate::docs::examples;
use proptest::prelude::*;
use serde_json::{Value, json};
use voussoir::collapse::{Analysis, CollapseTask, CrushingKind, CurvePoint, FieldAt, Question, Seams, Task};
use voussoir::wire::fault::Fault;
use voussoir::wire::read::{read, read_analysis, read_question};

/// A safety curve over a mesh: nothing wrong.
fn curve() -> Value {
    json!({
        "name": "embankments",
        "arch": {
            "profile": {"circular": {"radius_m": 4.0, "opening_angle_deg": 150}},
            "thickness": {"constant_m": 0.6}, "voussoirs": 12
        },
        "stone": {"compressive_strength_pa": 2e6},
        "mesh": {"subblocks": {"uniform": {"radial": 3, "along": 2}}},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"fill_pressure": {"embankment_thickness_m": 1}}, "scaled": true, "per_abscissa": true},
            {"load": {"point_load": {"force_n_per_m": 1000, "x_m": -1}}, "scaled": true, "coefficient": 2}
        ],
        "analysis": {"safety": {"crushing": "elastic", "curve": {"abscissae": [0.5, 1, 4], "unit": "m"}}}
    })
}

/// One safety factor with stress fields: nothing wrong.
fn safety() -> Value {
    let mut request = curve();
    request["analysis"] = json!({"safety": {}});
    request["loads"][1]["per_abscissa"] = json!(false);
    request["report"] = json!({"stress_fields": ["unit_load", "near_collapse", {"load_factor": 2.5}]});
    request
}

fn beam() -> Value {
    json!({
        "curved_beam": {"inner_radius_m": 0.5, "outer_radius_m": 0.7, "end_shear_n_per_m": 2500},
        "stone": {"youngs_modulus_pa": 1e9, "poissons_ratio": 0.2, "plane": "strain"},
        "mesh": {"subblocks": {"uniform": {"radial": 10, "along": 12}}, "seams": "corners"}
    })
}

/// `request` with the value at `pointer` replaced or added.
fn with(mut request: Value, pointer: &str, value: Value) -> Value {
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    match request.pointer_mut(parent).unwrap() {
        Value::Object(object) => drop(object.insert(key.to_owned(), value)),
        Value::Array(list) => list[key.parse::<usize>().unwrap()] = value,
        other => panic!("{other}"),
    }
    request
}

fn question(request: &Value) -> Question {
    read_question(request.to_string().as_bytes()).unwrap_or_else(|faults| panic!("{faults:?} {request}")).1
}

/// Which kind of crushing counts, in a safety analysis.
fn crushing(analysis: &Analysis) -> Option<CrushingKind> {
    if let Task::Safety(task) = &analysis.task { Some(task.crushing) } else { None }
}

fn one(request: &Value) -> Analysis {
    read_analysis(request.to_string().as_bytes()).unwrap().1
}

fn points(request: &Value) -> Vec<CurvePoint> {
    let Question::Curve(points) = question(request) else { panic!("{request}") };
    points
}

fn faults(request: &Value) -> Vec<Fault> {
    read_question(request.to_string().as_bytes()).expect_err("was not refused")
}

fn pointers(faults: &[Fault]) -> Vec<&str> {
    faults.iter().map(|fault| fault.pointer.as_str()).collect()
}

/// Every row: a change, where its only fault is, and a word of the remedy.
fn check(request: &Value, table: &[(&str, Value, &str, &str)]) {
    for (at, value, pointer, words) in table {
        let found = faults(&with(request.clone(), at, value.clone()));
        assert_eq!(pointers(&found), [*pointer], "{at} {value}: {found:?}");
        assert!(found[0].detail.contains(words), "{words} in {found:?}");
    }
}

#[test]
fn requests_read_back_as_themselves() {
    for request in [curve(), safety(), beam()] {
        let first = read(request.to_string().as_bytes()).unwrap();
        let echo = serde_json::to_vec(&first).unwrap();
        assert_eq!(read(&echo).unwrap(), first);
        assert_eq!(question(&serde_json::from_slice(&echo).unwrap()), question(&request));
    }
}

#[test]
fn defaults_ask_what_was_always_asked() {
    let mut request = safety();
    for key in ["mesh", "analysis", "report"] {
        request.as_object_mut().unwrap().remove(key);
    }
    let analysis = one(&request);
    assert_eq!((&analysis.task, analysis.mesh.seams), (&Task::Collapse(CollapseTask::default()), Seams::Split));
    assert_eq!(analysis.mesh.subblocks, [[1, 1]; 12]);
    let echo = serde_json::to_value(read(request.to_string().as_bytes()).unwrap()).unwrap();
    let whole = json!({"uniform": {"radial": 1, "along": 1}});
    assert_eq!(echo["mesh"], json!({"subblocks": whole, "seams": "split", "order": 1, "lines": "even"}));
    assert_eq!((&echo["analysis"], &echo["report"]["stress_fields"]), (&json!("collapse"), &json!([])));
    let beam = with(beam(), "/mesh", json!({}));
    let Question::CurvedBeam(beam) = question(&beam) else { panic!("a beam") };
    assert_eq!((beam.subblocks, beam.seams), ([1, 1], Seams::Split));
}

#[test]
fn a_safety_analysis_says_which_crushing_counts() {
    let analysis = one(&safety());
    assert_eq!(crushing(&analysis), Some(CrushingKind::PlasticSection));
    assert_eq!(analysis.task.fields(), [FieldAt::LoadFactor(1.0), FieldAt::NearCollapse, FieldAt::LoadFactor(2.5)]);
    assert_eq!(analysis.mesh.subblocks, [[3, 2]; 12]);
    assert_eq!(analysis.structure.stones[0].compressive_strength, 2e6);
    let elastic = with(safety(), "/analysis/safety/crushing", json!("elastic"));
    assert_eq!(crushing(&one(&elastic)), Some(CrushingKind::Elastic));
}

#[test]
fn every_voussoir_may_have_its_own_mesh_and_half_an_arch_takes_the_left_ones() {
    let list: Vec<Value> = (1..=12).map(|k| json!({"radial": k, "along": 13 - k})).collect();
    let mut request = with(safety(), "/mesh", json!({"subblocks": {"per_voussoir": list}, "seams": "corners"}));
    let mesh = one(&request).mesh;
    assert_eq!(mesh.subblocks, (1..=12).map(|k| [k, 13 - k]).collect::<Vec<_>>());
    assert_eq!(mesh.seams, Seams::Corners);
    request["arch"]["half"] = json!(true);
    request["loads"].as_array_mut().unwrap().truncate(2);
    assert_eq!(one(&request).mesh.subblocks, (1..=6).map(|k| [k, 13 - k]).collect::<Vec<_>>());
}

#[test]
fn a_curve_multiplies_flagged_loads_by_the_abscissa() {
    let points = points(&curve());
    assert_eq!(points.iter().map(|point| point.abscissa).collect::<Vec<_>>(), [0.5, 1.0, 4.0]);
    let [half, one, four] = [&points[0].analysis, &points[1].analysis, &points[2].analysis];
    assert_eq!(crushing(half), Some(CrushingKind::Elastic));
    for (i, force) in one.scaled.iter().enumerate() {
        // The last force is that of the point load.
        let flagged = i + 1 < one.scaled.len();
        let [low, high] = if flagged { [0.5, 4.0] } else { [1.0, 1.0] };
        assert!((half.scaled[i].force - low * force.force).norm() < 1e-9);
        assert!((four.scaled[i].force - high * force.force).norm() < 1e-9);
    }
    assert_eq!((&half.fixed, &half.structure), (&four.fixed, &four.structure));
    let only = with(curve(), "/analysis/safety/curve/abscissae", json!([1]));
    let Question::Curve(single) = question(&only) else { panic!("a curve") };
    assert_eq!(single[0], points[1]);
    assert!(read_analysis(curve().to_string().as_bytes()).is_err());
}

#[test]
fn a_beam_is_read() {
    let Question::CurvedBeam(found) = question(&beam()) else { panic!("a beam") };
    assert_eq!((found.inner_radius, found.outer_radius, found.shear), (0.5, 0.7, 2500.0));
    assert_eq!((found.subblocks, found.seams, found.curved_sides), ([10, 12], Seams::Corners, true));
    let mut plain = beam();
    plain.as_object_mut().unwrap().remove("mesh");
    let Question::CurvedBeam(found) = question(&plain) else { panic!("a beam") };
    assert_eq!(found.subblocks, [7, 7]);
}

#[test]
fn meshes_that_cannot_be() {
    let uniform = "/mesh/subblocks/uniform";
    let (radial, along) = ("/mesh/subblocks/uniform/radial", "/mesh/subblocks/uniform/along");
    let each = "/mesh/subblocks/per_voussoir";
    let list = |n: usize, odd: Value| {
        let mut list = vec![json!({"radial": 2, "along": 2}); n];
        list[n - 1] = odd;
        json!({"per_voussoir": list})
    };
    let good = json!({"radial": 2, "along": 2});
    let subblocks = "/mesh/subblocks";
    check(
        &safety(),
        &[
            (radial, json!(0), radial, "1 to 48"),
            (radial, json!(49), radial, "1 to 48"),
            (along, json!(0), along, "1 to 48"),
            (along, json!(4_000_000_000_u64), along, "1 to 48"),
            (along, json!(-1), along, "whole number"),
            (along, json!(2.5), along, "whole number"),
            (along, json!("two"), along, "whole number"),
            (uniform, json!({"radial": 2}), along, "missing"),
            (uniform, json!(2), uniform, "object"),
            ("/mesh/subblocks/uniform/across", json!(2), "/mesh/subblocks/uniform/across", "no field"),
            (subblocks, json!({"triangles": {}}), subblocks, ""),
            (subblocks, list(11, good.clone()), each, "give one each"),
            (subblocks, list(13, good), each, "give one each"),
            (
                subblocks,
                list(12, json!({"radial": 0, "along": 2})),
                "/mesh/subblocks/per_voussoir/11/radial",
                "1 to 48",
            ),
            (subblocks, list(12, json!({"along": 2})), "/mesh/subblocks/per_voussoir/11/radial", "missing"),
            ("/mesh/seams", json!("glue"), "/mesh/seams", ""),
            ("/mesh/size_m", json!(0.1), "/mesh/size_m", "no field"),
        ],
    );
    let mut large = safety();
    large["arch"]["voussoirs"] = json!(50);
    large["report"] = json!({});
    large["mesh"]["subblocks"]["uniform"] = json!({"radial": 48, "along": 42});
    let found = faults(&large);
    assert_eq!(pointers(&found), [subblocks]);
    assert!(found[0].detail.contains("100800") && found[0].detail.contains("keep to 100000"), "{found:?}");
    large["arch"]["voussoirs"] = json!(49);
    assert_eq!(one(&large).mesh.subblocks.len(), 49);
}

#[test]
fn voussoirs_of_several_arcs_are_not_cut() {
    let arcs = json!([{"radius_m": 2.0, "angle_deg": 50}, {"radius_m": 5.0, "angle_deg": 40}]);
    let mut request = with(safety(), "/arch/profile", json!({"multi_centre": {"arcs": arcs}}));
    request["arch"]["curved_sides"] = json!(true);
    let compound = |request: &Value| {
        let mut plain = request.clone();
        plain["mesh"] = json!({});
        let sides = one(&plain).structure.bodies.into_iter().map(|voussoir| voussoir.sides);
        sides.filter(|sides| *sides == voussoir::structure::Sides::Compound).count()
    };
    // Where the setting out knows no compound sides, there is nothing to refuse.
    if compound(&request) > 0 {
        let found = faults(&request);
        assert_eq!(pointers(&found), ["/mesh/subblocks/uniform"]);
        assert!(found[0].detail.contains("place joints where the arcs meet"), "{found:?}");
    }
    request["arch"]["curved_sides"] = json!(false);
    one(&request);
}

#[test]
fn safety_factors_that_cannot_be() {
    let cap = "/load_factor/cap";
    check(
        &with(safety(), "/load_factor", json!({})),
        &[
            ("/analysis", json!("safety"), "/analysis", "needs an object"),
            ("/analysis", json!("strength"), "/analysis", ""),
            ("/analysis/safety/crushing", json!("brittle"), "/analysis/safety/crushing", ""),
            ("/analysis/safety/factor", json!(2), "/analysis/safety/factor", "no field"),
            ("/load_factor/direction", json!("decrease"), "/load_factor/direction", "increase"),
            (cap, json!(1), cap, "leave it out"),
            ("/method", json!({"fixed_steps": {"step": 0.1}}), "/method", "event_path"),
            ("/loads/1/per_abscissa", json!(true), "/loads/1/per_abscissa", "curve"),
            ("/loads/1/per_abscissa", json!("yes"), "/loads/1/per_abscissa", ""),
            ("/loads", json!([{"load": {"self_weight": {}}}]), "/analysis/safety", "set scaled to true"),
        ],
    );
    let strength = "/stone/compressive_strength_pa";
    check(
        &safety(),
        &[
            (strength, json!(10), strength, "10 MPa is 1e7"),
            (strength, json!(999), strength, "1e3 to 1e30"),
            (strength, json!(-1e7), strength, "1e3 to 1e30"),
            (strength, json!(1e31), strength, "1e3 to 1e30"),
        ],
    );
    for strength in [1e3, 1e30] {
        let request = with(safety(), "/stone/compressive_strength_pa", json!(strength));
        assert_eq!(one(&request).structure.stones[0].compressive_strength, strength);
    }
}

#[test]
fn curves_that_cannot_be() {
    let (asked, list, unit) =
        ("/analysis/safety/curve", "/analysis/safety/curve/abscissae", "/analysis/safety/curve/unit");
    let second = "/analysis/safety/curve/abscissae/1";
    check(
        &curve(),
        &[
            (asked, json!({}), list, "missing"),
            (list, json!([]), list, "1 to 500"),
            (list, json!((1..=501).collect::<Vec<_>>()), list, "1 to 500"),
            (list, json!([1, "two"]), second, "number"),
            (list, json!([-1, 2]), "/analysis/safety/curve/abscissae/0", "greater than 0"),
            (list, json!([0, 2]), "/analysis/safety/curve/abscissae/0", "greater than 0"),
            (list, json!([2, 1]), second, "lowest to highest"),
            (list, json!([2, 2]), second, "each once"),
            (list, json!([2, 1e13]), second, "at most"),
            (unit, json!("m".repeat(201)), unit, "200"),
            ("/analysis/safety/curve/from", json!(0), "/analysis/safety/curve/from", "no field"),
            ("/loads/1/per_abscissa", json!(false), asked, "per_abscissa"),
            ("/report", json!({"stress_fields": ["unit_load"]}), "/report/stress_fields", "without a curve"),
            ("/report", json!({"history": true}), "/report/history", "without a curve"),
        ],
    );
    // 500 abscissae, 12 voussoirs of 169 subblocks.
    let mut long = with(curve(), list, json!((1..=500).collect::<Vec<_>>()));
    assert_eq!(points(&long).len(), 500);
    long["mesh"]["subblocks"]["uniform"] = json!({"radial": 13, "along": 13});
    let found = faults(&long);
    assert_eq!(pointers(&found), [list]);
    assert!(found[0].detail.contains("1014000") && found[0].detail.contains("1000000"), "{found:?}");
    long["mesh"] = json!({});
    long["arch"]["voussoirs"] = json!(400);
    assert_eq!(pointers(&faults(&long)), [list], "more forces than a job may keep");
}

#[test]
fn a_fault_of_one_abscissa_is_said_once() {
    let list = "/analysis/safety/curve/abscissae";
    let mut request = with(curve(), list, json!([1, 1e6, 1e7, 1e8]));
    request["loads"][1]["coefficient"] = json!(1e6);
    let found = faults(&request);
    assert_eq!(pointers(&found), ["/loads/1/coefficient"]);
    assert!(found[0].detail.starts_with("at abscissa 1e7: 1e13 is out of range"), "{found:?}");
    // A load that never fits, and one that has nothing to do with the abscissa.
    let mut request = curve();
    request["loads"][1]["load"]["fill_pressure"]["fill_height_m"] = json!(1);
    request["loads"][2]["load"]["point_load"]["x_m"] = json!(90);
    let found = faults(&request);
    assert_eq!(pointers(&found), ["/loads/1/load/fill_pressure/fill_height_m", "/loads/2/load/point_load/x_m"]);
    assert!(found[0].detail.starts_with("at abscissa 0.5") && !found[1].detail.contains("abscissa"), "{found:?}");
    // Symmetric at one abscissa only.
    let mut request = curve();
    request["arch"]["half"] = json!(true);
    request["loads"][1] = json!({"load": {"point_load": {"force_n_per_m": 2000, "x_m": 1}}, "scaled": true,
                                 "per_abscissa": true});
    assert_eq!(pointers(&faults(&request)), ["/loads/1", "/loads/2"]);
    assert_eq!(points(&with(request, list, json!([1]))).len(), 1);
}

#[test]
fn stress_fields_that_cannot_be() {
    let fields = "/report/stress_fields";
    check(
        &safety(),
        &[
            (fields, json!("unit_load"), fields, "list"),
            (fields, json!(["unit_load", "at_collapse"]), "/report/stress_fields/1", ""),
            (fields, json!(["unit_load", {"load_factor": 1e13}]), "/report/stress_fields/1/load_factor", "range"),
            (fields, json!(["unit_load", {"load_factor": "1"}]), "/report/stress_fields/1/load_factor", "number"),
            (fields, json!(vec!["unit_load"; 17]), fields, "at most 16"),
        ],
    );
    let mut large = with(safety(), fields, json!(vec!["unit_load"; 16]));
    large["mesh"]["subblocks"]["uniform"] = json!({"radial": 48, "along": 48});
    let found = faults(&large);
    assert_eq!(pointers(&found), [fields]);
    assert!(found[0].detail.contains("442368") && found[0].detail.contains("400000"), "{found:?}");
}

#[test]
fn beams_that_cannot_be() {
    let [inner, outer, shear] = ["inner_radius_m", "outer_radius_m", "end_shear_n_per_m"];
    let [inner, outer, shear] = [inner, outer, shear].map(|name| format!("/curved_beam/{name}"));
    let (inner, outer, shear) = (inner.as_str(), outer.as_str(), shear.as_str());
    let (uniform, each) = ("/mesh/subblocks/uniform/radial", "/mesh/subblocks/per_voussoir");
    check(
        &beam(),
        &[
            ("/curved_beam", json!(1), "/curved_beam", "object"),
            (inner, json!(0), inner, "greater than 0"),
            (outer, json!(0.5), outer, "greater than"),
            (outer, json!(501), outer, "at most 500"),
            (outer, json!("0.7 m"), outer, "number"),
            (shear, json!(0), shear, "not 0"),
            (shear, json!(1e20), shear, "range"),
            ("/curved_beam/curved_sides", json!(1), "/curved_beam/curved_sides", ""),
            ("/curved_beam/width_m", json!(1), "/curved_beam/width_m", "no field"),
            ("/stone/poissons_ratio", json!(0.5), "/stone/poissons_ratio", "between"),
            ("/stone/compressive_strength_pa", json!(10), "/stone/compressive_strength_pa", "10 MPa is 1e7"),
            (uniform, json!(0), uniform, "1 to 48"),
            (uniform, json!(49), uniform, "1 to 48"),
            (
                "/mesh/subblocks",
                json!({"per_voussoir": [{"radial": 1, "along": 1}, {"radial": 1, "along": 1}]}),
                each,
                "uniform",
            ),
            ("/name", json!("x".repeat(201)), "/name", "200"),
            ("/arch", json!({}), "/arch", "goes with an arch"),
            ("/loads", json!([]), "/loads", "goes with an arch"),
        ],
    );
    let mut bare = beam();
    bare["curved_beam"] = json!({});
    bare["mesh"]["subblocks"] = json!({"uniform": {"radial": "x", "along": 99}});
    let found = faults(&bare);
    for pointer in [inner, outer, shear, uniform] {
        assert!(pointers(&found).contains(&pointer), "{pointer}: {found:?}");
    }
}

/// The bodies that the guide shows can be read.
#[test]
fn the_bodies_in_the_guide_are_good() {
    let examples = examples("docs/guide.md");
    assert!(examples.len() > 15, "{}", examples.len());
    for example in examples {
        question(&example.request);
    }
}

proptest! {
    #[test]
    fn reading_a_spoilt_question_never_panics(
        which in 0..3usize,
        changes in prop::collection::vec((any::<prop::sample::Index>(), prop_oneof![
            any::<f64>().prop_map(Value::from),
            any::<u64>().prop_map(Value::from),
            (0..60u64).prop_map(Value::from),
            (-3.0..3.0).prop_map(Value::from),
            prop::sample::select(vec![json!([]), json!({}), json!("unit_load"), json!(true), Value::Null]),
        ]), 1..4),
    ) {
        let mut request = [curve(), safety(), beam()][which].clone();
        for (index, value) in changes {
            let mut all = Vec::new();
            places(&request, "", &mut all);
            if let Some(target) = request.pointer_mut(&index.get(&all).clone()) {
                *target = value;
            }
        }
        match read_question(request.to_string().as_bytes()) {
            Ok((first, _)) => {
                let echo = serde_json::to_vec(&first).unwrap();
                prop_assert_eq!(read(&echo).unwrap(), first);
            }
            Err(faults) => prop_assert!(!faults.is_empty()),
        }
    }
}
