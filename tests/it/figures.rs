//! Drawings by what is in them: every case is drawn, and what is printed there is held against the answer's JSON.

mod sheet;

use crate::common::folders::{self, folders};
use serde_json::{Value, json};
use sheet::Sheet;
use std::collections::BTreeMap;
use voussoir::budget::Budget;
use voussoir::collapse;
use voussoir::render::digits::{Measured, Rounded};
use voussoir::wire::figures::figures;
use voussoir::wire::read::read_question;
use voussoir::wire::response::JobResult;

/// An answer, and its drawings by name.
fn drawn(request: &str) -> (Value, BTreeMap<String, Sheet>) {
    let (request, question) = read_question(request.as_bytes()).unwrap();
    let answer = collapse::answer(&question, &Budget::unlimited()).unwrap();
    let result = JobResult::new(&request, &answer).unwrap();
    let json = serde_json::from_slice(&result.to_bytes().unwrap()).unwrap();
    let all = figures(&question, &answer, &result).unwrap();
    (json, all.into_iter().map(|figure| (figure.name, Sheet::read(&figure.svg))).collect())
}

/// A case, with its load path where it can be asked for.
fn case(name: &str) -> (Value, BTreeMap<String, Sheet>) {
    let request = std::fs::read_to_string(folders::cases().join(name).join("request.json")).unwrap();
    let mut with_history: Value = serde_json::from_str(&request).unwrap();
    with_history["report"]["history"] = json!(true);
    let with_history = with_history.to_string();
    drawn(if read_question(with_history.as_bytes()).is_ok() { &with_history } else { &request })
}

fn number(value: &Value, pointer: &str) -> f64 {
    value.pointer(pointer).and_then(Value::as_f64).unwrap_or_else(|| panic!("{pointer}"))
}

fn place(value: &Value) -> [f64; 2] {
    [number(value, "/0"), number(value, "/1")]
}

fn rows<'a>(value: &'a Value, pointer: &str) -> &'a [Value] {
    value.pointer(pointer).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

#[test]
fn no_words_of_any_drawing_of_any_case_overlap_or_leave_the_sheet() {
    let mut count = 0;
    for folder in folders(&folders::cases()) {
        for (name, sheet) in case(&folders::name(&folder)).1 {
            let faults = sheet.overlaps();
            assert!(faults.is_empty(), "{} {name}: {faults:?}", folder.display());
            assert!(sheet.title.len() > 3 && sheet.description.len() > 10, "{} {name}", folder.display());
            count += 1;
        }
    }
    assert!(count > 120, "{count} drawings");
}

/// A bridge of one span, two rings and fill that resists, under a load on the road.
fn two_rings() -> Value {
    let ring = |voussoirs: usize| json!({"thickness_m": 0.215, "voussoirs": voussoirs});
    json!({
        "bridge": {
            "spans": [{"profile": {"circular": {"span_m": 5, "rise_m": 1.25}}, "rings": [ring(40), ring(42)]}],
            "ring_friction_angle_deg": 20
        },
        "stone": {"friction_angle_deg": 35, "compressive_strength_pa": 1e30},
        "backfill": {"surface_height_m": 2.0, "density_kg_m3": 1900, "passive": {}},
        "loads": [
            {"load": {"self_weight": {}}},
            {
                "load": {"patch_load": {"centre_x_m": -1.25, "width_m": 0.3, "force_n_per_m": 1000, "dispersal": {}}},
                "scaled": true
            }
        ]
    })
}

#[test]
fn two_rings_that_slide_on_each_other_are_drawn_without_overlaps() {
    let (answer, all) = drawn(&two_rings().to_string());
    assert!(rows(&answer, "/ends/0/slides").len() > 10, "many joints slide");
    for (name, sheet) in &all {
        assert!(sheet.overlaps().is_empty(), "{name}: {:?}", sheet.overlaps());
    }
    assert!(all["structure"].says("rings or backing slide on each other") && all["structure"].count("hinge") > 2);
}

#[test]
fn hinges_are_drawn_where_the_answer_has_them_with_number_and_angle() {
    for name in ["first-arch", "crushing", "filled-bridge", "lateral-7", "two-span-bridge", "paper/figure-6", "wall"] {
        let (answer, all) = case(name);
        let sheet = &all["structure"];
        let hinges: Vec<&Value> =
            rows(&answer, "/ends/0/hinges").iter().filter(|hinge| number(hinge, "/rotation") >= 0.05).collect();
        // One more in the legend.
        assert_eq!(sheet.count("hinge"), hinges.len() + 1, "{name}");
        let to_sheet = sheet.placed(&answer);
        for (hinge, drawn) in hinges.iter().zip(sheet.dots("hinge")) {
            let at = to_sheet(place(&hinge["at_m"]));
            assert!((at[0] - drawn[0]).hypot(at[1] - drawn[1]) < 0.05, "{name}: {at:?} {drawn:?}");
            let words = match hinge["angle_from_springing_deg"].as_f64() {
                Some(angle) => format!("{} at {angle:.1}°", hinge["joint"]),
                None => hinge["joint"].to_string(),
            };
            assert!(sheet.says(&words), "{name}: {words} in {:?}", sheet.words());
        }
    }
}

#[test]
fn loads_are_drawn_with_what_they_come_to_at_the_end() {
    for name in ["first-arch", "dispersed-load", "filled-bridge", "two-span-bridge", "sliding-arch"] {
        let (answer, all) = case(name);
        let down = -number(&answer, "/ends/0/scaled_load/y_kn_per_m");
        assert!(all["structure"].says(&format!("{} kN/m", Rounded(down))), "{name}: {down}");
        assert!(all["structure"].count("load") > 0 && all["structure"].count("idle") == 0);
        // Under the fixed loads alone it does not act.
        assert!(all["standing"].count("idle") > 0 && all["standing"].count("load") == 0, "{name}");
    }
    let (answer, all) = case("shaken-fill");
    let share = number(&answer, "/ends/0/intensity");
    assert!(all["structure"].says(&format!("{} g on all masses", Rounded(share))));
    let (answer, all) = case("worst-position");
    assert!(all["structure"].says(&format!("{} kN", Rounded(number(&answer, "/ends/0/intensity")))));
}

#[test]
fn measures_are_those_of_the_joints() {
    for name in ["first-arch", "filled-bridge", "pointed"] {
        let (answer, all) = case(name);
        let joints = rows(&answer, "/structure/joints");
        let inner: Vec<[f64; 2]> = joints.iter().map(|joint| place(&joint["ends_m"][0])).collect();
        let (first, last) = (inner[0], inner[inner.len() - 1]);
        let top = inner.iter().map(|end| end[1]).fold(f64::NEG_INFINITY, f64::max);
        let sheet = &all["structure"];
        assert!(sheet.says(&format!("span {} m", Rounded(last[0] - first[0]))), "{name}");
        assert!(sheet.says(&format!("rise {} m", Rounded(top - 0.5 * (first[1] + last[1])))), "{name}");
    }
    assert!(case("first-arch").1["structure"].says("thickness 1.5 m"));
}

#[test]
fn a_standing_arch_has_its_least_and_its_greatest_thrust() {
    for name in ["half-arch", "pointed", "geometric-safety", "hard/ties"] {
        let (answer, all) = case(name);
        assert_eq!(answer["outcome"], "stands", "{name}");
        let sheet = &all["structure"];
        for (word, class, end) in [("least", "least", "lowest"), ("greatest", "thrust", "highest")] {
            let thrust = number(&answer, &format!("/thrust_range/{end}_kn_per_m"));
            assert!(sheet.says(&format!("{word} thrust {} kN/m", Rounded(thrust))), "{name}");
            let line = sheet.lines(class).remove(0);
            let to_sheet = sheet.placed(&answer);
            let of = |axis: &str| rows(&answer, &format!("/thrust_range/{end}_line/{axis}_m"));
            let at = to_sheet([of("x")[0].as_f64().unwrap(), of("y")[0].as_f64().unwrap()]);
            assert!((at[0] - line[0][0]).hypot(at[1] - line[0][1]) < 0.05, "{name} {end}");
        }
        assert!(sheet.count("near") > 2, "{name}: it touches");
    }
}

#[test]
fn soil_is_drawn_with_its_force() {
    let (answer, all) = case("resisting-backfill");
    let forces = rows(&answer, "/ends/0/passive_n_per_m").iter().map(|force| force.as_f64().unwrap());
    let directions = rows(&answer, "/structure/passive_elements").iter().map(|element| number(element, "/direction"));
    let left: f64 = forces.zip(directions).filter(|(_, way)| *way < 0.0).map(|(force, _)| force).sum();
    assert!(all["structure"].says(&format!("soil {} kN/m", Rounded(left / 1e3))));
    let words = "with soil that resists, pressing up to its limits";
    assert!(all["standing"].description.contains(words) && !all["structure"].description.contains(words));
}

#[test]
fn cracks_are_as_wide_as_the_answer_says() {
    let (answer, all) = case("settlement");
    let path = &answer["settlement"]["first_order"];
    let turning: Vec<&Value> = rows(path, "/hinges").iter().map(|hinge| &hinge["joint"]).collect();
    let open = rows(path, "/open_joints");
    assert_eq!(open.iter().map(|joint| &joint["joint"]).collect::<Vec<_>>(), turning);
    for joint in open {
        let width = 1e3 * number(joint, "/width_m");
        assert!(all["structure"].says(&format!("{} mm", Measured(width))), "{joint}");
    }
}

#[test]
fn curves_point_out_what_the_answer_says() {
    let (answer, all) = case("worst-position");
    let (least, x) = (number(&answer, "/worst_position/intensity"), number(&answer, "/worst_position/x_m"));
    let sheet = &all["worst_position"];
    assert!(sheet.says(&format!("{} kN/m at {} m", Rounded(least), Rounded(x))));
    assert_eq!(sheet.count("mark"), 1);
    let (answer, all) = case("first-arch");
    let governs = format!("crushing governs at {} kN/m", Rounded(number(&answer, "/ends/0/intensity")));
    let sheet = &all["load_displacement"];
    assert!(sheet.says(&governs), "{:?}", sheet.words());
    let meaning = format!("the load that governs: {governs}. What of the curves lies beyond it is not borne.");
    assert!(sheet.description.contains(&meaning), "{}", sheet.description);
    // The path of stone that does not crush goes on past it.
    let curve = &sheet.lines("curve1")[0];
    let path = rows(&answer, "/history/intensity").iter().map(|at| at.as_f64().unwrap()).collect::<Vec<_>>();
    let (first, last) = (curve[0][1], curve[curve.len() - 1][1]);
    let share = (number(&answer, "/ends/0/intensity") - path[0]) / (path[path.len() - 1] - path[0]);
    assert!(share < 0.95 && (sheet.heights("level")[0] - first - share * (last - first)).abs() < 0.1, "{share}");
    let curve = all["load_displacement"].lines("curve1");
    assert_eq!(curve[0].len(), rows(&answer, "/history/intensity").len());
    let mut safe: Value = serde_json::from_str(include_str!("../../cases/first-arch/request.json")).unwrap();
    (safe["analysis"], safe["geometry"]) = (json!({"safety": {}}), json!("updated"));
    safe["report"] = json!({"history": true});
    safe["loads"][1]["load"]["point_load"]["force_n_per_m"] = json!(1e5);
    let (answer, all) = drawn(&safe.to_string());
    assert!(all["structure"].says("Drawn: at first order, not on moving geometry."));
    let least = Rounded(number(&answer, "/safety/governing/load_factor"));
    let words = all["load_displacement"].words();
    assert!(words.contains(&format!("crushing governs at {least} kN/m").as_str()), "{words:?}");
    let (_, all) = case("paper/figure-13");
    assert!(all["safety_curve"].says("II: crushing") && all["safety_curve"].says("abscissa, kN"));
}

#[test]
fn stress_is_drawn_with_its_largest_value() {
    let (answer, all) = case("paper/figure-11");
    for (field, name) in rows(&answer, "/stress_fields").iter().zip(["stress_1", "stress_3.8"]) {
        let most = rows(field, "/subblocks/tresca_pa").iter().map(|s| s.as_f64().unwrap()).fold(0.0, f64::max);
        assert!(all[name].says(&format!("{} MPa", Rounded(most / 1e6))), "{name}");
        assert!(all[name].says("equivalent stress (Tresca), MPa"));
    }
}

#[test]
fn two_thousand_stones_make_no_large_drawing() {
    let request = r#"{"arch": {"profile": {"circular": {"radius_m": 10, "opening_angle_deg": 180}}, "thickness": {"constant_m": 1.5},
        "voussoirs": 2000}, "loads": [{"load": {"self_weight": {}}}]}"#;
    for (name, sheet) in drawn(request).1 {
        assert!(sheet.bytes < 300_000, "{name}: {}", sheet.bytes);
    }
}
