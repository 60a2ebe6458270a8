//! What an answer says agrees with what it found, and what a request says twice is asked about.

use crate::common::answered::{result, solved, text};
use crate::common::semicircle::semicircle;
use serde_json::{Value, json};
use std::process::Command;
use std::time::Duration;
use voussoir::budget::Budget;
use voussoir::collapse::{Doubt, Note, answer};
use voussoir::wire::prose::{Digits, prose};
use voussoir::wire::read::{read_analysis, read_question};
use voussoir::wire::rendering::{REPORT, renderings};
use voussoir::wire::response::{AnalysisResult, JobResult};

/// A good request's answer, changed, in words on one line.
pub fn told(request: &Value, change: impl Fn(&mut AnalysisResult)) -> String {
    let mut job = result(request);
    let JobResult::Analysis(answer) = &mut job else { panic!("{request}") };
    change(answer);
    prose(&job, Duration::ZERO).split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The report of a request, as HTML.
pub fn report(request: &Value) -> String {
    let (request, question) = read_question(request.to_string().as_bytes()).unwrap();
    let found = answer(&question, &Budget::unlimited()).unwrap();
    let all = renderings(&request, &question, &found, Duration::ZERO).unwrap();
    let report = all.iter().find(|rendering| rendering.names.iter().any(|name| name == REPORT)).unwrap();
    String::from_utf8(report.part.body.as_ref().unwrap().to_vec()).unwrap()
}

fn notes(request: &Value) -> String {
    solved(request)["notes"].to_string()
}

#[test]
fn a_window_that_was_not_found_is_not_told_to_be_empty() {
    let request = semicircle(9, &json!({}));
    let lost = |answer: &mut AnalysisResult| {
        (answer.proof, answer.limit_window, answer.limit_window_load_factor) = (None, None, None);
    };
    let text = told(&request, lost);
    assert!(text.contains("limit window not known: limit analysis gave no answer"), "{text}");
    assert!(!text.contains("finds no equilibrium"), "{text}");
    assert!(Note::Doubt(Doubt::NoCertificate).to_string().starts_with("Limit analysis gave no answer"));
}

#[test]
fn an_answer_without_a_proof_is_not_proved() {
    let mut found = solved(&semicircle(9, &json!({})));
    for part in ["proof", "limit_window", "limit_window_load_factor"] {
        found[part] = Value::Null;
    }
    let file = std::env::temp_dir().join(format!("voussoir-unproved-{}.json", std::process::id()));
    std::fs::write(&file, found.to_string()).unwrap();
    let check = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/check.py");
    let output = Command::new("python3").arg(check).arg(&file).output().unwrap();
    std::fs::remove_file(&file).unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(said.contains("without a proof: limit analysis gave no answer"), "{said}");
    assert_eq!((output.status.code(), output.stderr.is_empty()), (Some(1), true));
}

#[test]
fn a_load_without_its_crushing_is_told_as_one() {
    let request = semicircle(9, &json!({}));
    let lost = |answer: &mut AnalysisResult| answer.crushing.as_mut().unwrap().plastic_section = None;
    let text = told(&request, lost);
    assert!(text.contains("That is of stone that does not crush"), "{text}");
    assert!(text.contains("plastic section not known"), "{text}");
    assert!(!told(&request, |_| ()).contains("stone that does not crush:"));
}

/// Two rings and one, whose plastic sections the interior point method loses; those of the mirror image end at 59.7013.
#[test]
fn a_bridge_crushes_at_the_same_load_as_its_mirror_image() {
    let ring = |thickness: f64, voussoirs: usize| json!({"thickness_m": thickness, "voussoirs": voussoirs});
    let span = |span: f64, rise: f64, rings: Value| json!({"profile": {"circular": {"span_m": span, "rise_m": rise}}, "rings": rings});
    let request = json!({
        "bridge": {
            "spans": [
                span(8.782461486834318, 3.295341762376852, json!([ring(0.7059816126658142, 9), ring(0.5388217430845517, 10)])),
                span(8.435351686286328, 2.418423369249444, json!([ring(0.42499739066444264, 11)])),
            ],
            "piers": [{"top_width_m": 1.7576027665787608, "height_m": 1.9191483452130729, "courses": 2, "batter": 0.05}],
        },
        "stone": {"friction_angle_deg": 35, "compressive_strength_pa": 8e6},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"point_load": {"x_m": -1.0798827355729301, "force_n_per_m": 1e4}}, "scaled": true},
        ],
    });
    let found = solved(&request);
    let at = found["crushing"]["plastic_section"]["window"][1].as_f64().unwrap();
    assert!((at / 59.7013 - 1.0).abs() < 1e-4, "{at}");
}

/// First yield comes too late on this mesh, and counts for nothing.
#[test]
fn the_headline_names_the_crushing_that_governs() {
    let more = json!({"analysis": {"safety": {"crushing": "elastic"}}});
    let mut request = semicircle(27, &more);
    request["loads"][1]["load"]["point_load"]["force_n_per_m"] = json!(1e5);
    let said = text(&request);
    assert!(said.contains("its stone crushes (plastic section)") && said.contains("first yield: never"), "{said}");
    request["loads"][1]["load"]["point_load"]["force_n_per_m"] = json!(1e3);
    request["stone"] = json!({"compressive_strength_pa": 1.6e6});
    request["mesh"] = json!({"subblocks": {"uniform": {"radial": 4, "along": 4}}});
    let said = text(&request);
    assert!(said.contains("(first yield)"), "{said}");
}

#[test]
fn an_arch_that_its_weight_crushes_is_not_told_to_stand() {
    let mut request = semicircle(27, &json!({}));
    request["arch"]["thickness"]["constant_m"] = json!(1.0673);
    request["loads"].as_array_mut().unwrap().pop();
    let said = text(&request);
    assert!(said.contains("The fixed loads alone crush the arch"), "{said}");
    assert!(said.contains("says only whether the arch stands"), "{said}");
    assert!(said.contains("does not stand at load factor 0, nor at any other."), "{said}");
}

#[test]
fn the_report_of_an_arch_that_falls_as_built_checks_no_equilibrium() {
    let mut request = semicircle(27, &json!({}));
    request["arch"]["thickness"]["constant_m"] = json!(0.5);
    let page = report(&request);
    assert!(page.contains("falls as built"), "{page}");
    assert!(!page.contains("Equilibrium holds") && !page.contains("proved by forces"), "{page}");
    assert!(page.contains("That no load factor is borne is proved by a motion"), "{page}");
}

#[test]
fn the_report_tells_where_the_path_ended_and_not_the_least_load() {
    let request: Value = serde_json::from_str(include_str!("../../cases/sliding-range/request.json")).unwrap();
    let found = solved(&request);
    let range = &found["ends"][0]["range"];
    let [least, path] = ["least_load_factor", "path_load_factor"].map(|of| range[of].as_f64().unwrap());
    assert!((path / least - 1.0).abs() > 1e-3, "{range}");
    let page = report(&request);
    let start = page.find("the load path ends at load factor ").unwrap() + "the load path ends at load factor ".len();
    let said: f64 = page[start..].split(' ').next().unwrap().parse().unwrap();
    assert!((said / path - 1.0).abs() < 1e-5, "{said} is not {path}");
}

#[test]
fn the_report_calls_the_least_load_by_its_name_where_crushing_governs() {
    let mut request: Value = serde_json::from_str(include_str!("../../cases/sliding-range/request.json")).unwrap();
    request["stone"]["compressive_strength_pa"] = json!(2e6);
    let found = solved(&request);
    let end = &found["ends"][0];
    assert_eq!((&end["governed_by"], &end["range"]["least"]), (&json!("crushing"), &end["intensity"]));
    assert_ne!(end["without_crushing"]["slides"], json!([]));
    let page = report(&request);
    assert!(!page.contains("the load path ends at"), "{page}");
    let words = "the least load factor found at which joints slide or part is ";
    let said: f64 = page.split_once(words).unwrap().1.split(';').next().unwrap().parse().unwrap();
    assert!((said / end["instability"]["load_factor"].as_f64().unwrap() - 1.0).abs() < 1e-5, "{said}");
}

/// By a billionth of two opposite inertia forces a column falls at half a billion; limit analysis calls that none.
#[test]
fn loads_that_all_but_cancel_are_said_to() {
    let said = |other: f64| {
        let wall = json!([{"name": "column", "corners_m": [[0, 0], [1, 0], [1, 2], [0, 2]]}]);
        let push = |x: f64| json!({"load": {"body_acceleration": {"x_g": x}}, "scaled": true});
        notes(&json!({
            "blocks": {"polygons": wall, "supports": [{"name": "ground", "segments_m": [[[-1, 0], [2, 0]]]}]},
            "loads": [{"load": {"self_weight": {}}}, push(1.0), push(other)],
        }))
    };
    let words = "scaled loads cancel on every stone";
    assert!(said(-1.0 + 1e-9).contains(words) && said(-1.0).contains(words));
    assert!(!said(-1.0 + 1e-7).contains(words));
}

/// An arch of stones of many lengths, held by a tie; a joint near its left springing parts under a pressure from there.
fn parting() -> Value {
    let lengths = [
        1.2131215664933963,
        1.4997469163507422,
        1.1746242042942243,
        1.3233024988376414,
        1.3742196924637078,
        1.0581607077602737,
        0.9348542659711788,
        1.4421405166415033,
        1.0518605630205322,
        1.4110870177472523,
        1.3839296715311733,
        0.9276129850626325,
        1.4386618985728816,
    ];
    let at = |block: &str, x: f64, y: f64| json!({"block": block, "at_m": [x, y]});
    let ends = [
        at("voussoir 2", -2.9588275931259225, 1.8949417545848914),
        at("voussoir 7", 0.7591074852944705, 2.6483323990545116),
    ];
    let band = json!({"from_m": 1.7197809496926832, "to_m": 5.075253386948977, "pressure_pa": 5696.9415843984925});
    json!({
        "arch": {
            "profile": {"circular": {"radius_m": 5, "opening_angle_deg": 103.13910406248019}}, "line": "intrados",
            "thickness": {"constant_m": 1.5775519825096374}, "voussoirs": 13, "relative_lengths": lengths,
        },
        "stone": {"friction_angle_deg": 70, "density_kg_m3": 1713.8349512864907, "compressive_strength_pa": 1e30},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"tie": {"force_n_per_m": 73181.57586862906, "from": ends[0], "to": ends[1]}}},
            {"load": {"lateral_pressure": {"bands": [band], "side": "left"}}, "scaled": true},
        ],
    })
}

#[test]
fn joints_that_part_are_not_told_to_slide() {
    let request = parting();
    let found = solved(&request);
    let end = &found["ends"][0];
    assert_eq!((&end["slides"], &end["governed_by"]), (&json!([]), &json!("sliding")));
    let said = text(&request);
    assert!(said.contains("As its joints part and slip, it may also stand as far as 121"), "{said}");
    assert!(said.contains("Joint 1 parts altogether") && !said.contains("as joints slide"), "{said}");
}

#[test]
fn weight_given_twice_is_refused_unless_one_is_fixed_and_one_scaled() {
    let mut request = semicircle(9, &json!({}));
    request["loads"].as_array_mut().unwrap().push(json!({"load": {"self_weight": {}}}));
    let faults = read_analysis(request.to_string().as_bytes()).unwrap_err();
    assert_eq!(faults.len(), 1);
    assert_eq!(faults[0].pointer, "/loads/2");
    assert!(faults[0].detail.contains("loads[0] again") && faults[0].detail.contains("density_kg_m3"));
    // Parts may be meant.
    request["loads"][2]["coefficient"] = json!(0.1);
    assert!(read_analysis(request.to_string().as_bytes()).is_ok());
    request["loads"][2]["scaled"] = json!(true);
    assert!(notes(&request).contains("Self weight is given twice"));
    let fill = json!({"load": {"fill_pressure": {"fill_height_m": 12}}});
    request["loads"] = json!([{"load": {"self_weight": {}}}, fill, fill]);
    let faults = read_analysis(request.to_string().as_bytes()).unwrap_err();
    assert_eq!((faults.len(), faults[0].pointer.as_str()), (1, "/loads/2"));
    request["loads"][2]["load"]["fill_pressure"]["fill_height_m"] = json!(13);
    assert!(read_analysis(request.to_string().as_bytes()).is_ok());
}

#[test]
fn numbers_that_are_told_to_differ_are_seen_to() {
    let (path, limit) = (-0.2444115888632501, -0.24441155280325144);
    for doubt in [Doubt::Short { path, limit }, Doubt::Above { path, limit }] {
        let said = Note::Doubt(doubt).to_string();
        assert!(said.contains(&path.to_string()) && said.contains(&limit.to_string()), "{said}");
    }
    assert!(Note::Doubt(Doubt::Above { path: 2.0, limit: 1.0 }).to_string().contains("2 against 1"));
}

#[test]
fn intensities_in_a_unit_of_force_are_of_the_size_of_the_loads() {
    let asks = |force: f64, unit: &str, per_unit: f64| {
        let more = json!({"load_factor": {"unit": unit, "intensity_per_unit": per_unit}});
        let mut request = semicircle(9, &more);
        request["loads"][1]["load"]["point_load"]["force_n_per_m"] = json!(force);
        notes(&request).contains("Is the unit right?")
    };
    assert!(asks(1e6, "kN/m", 1.0) && asks(1e3, "N/m", 1.0) && asks(1e3, "kN", 1e3) && asks(1e3, "MN/m", 1.0));
    assert!(!asks(1e3, "kN/m", 1.0) && !asks(1e4, "kN/m", 1.0) && !asks(1e6, "MN/m", 1.0) && !asks(1e6, "kN", 1e3));
    assert!(!asks(1e6, "-", 1.0) && !asks(1e6, "t", 1.0) && !asks(1e6, "kN/m2", 1.0));
}

#[test]
fn what_is_no_single_force_may_have_any_intensity() {
    let more = json!({"load_factor": {"unit": "kN/m", "intensity_per_unit": 1}});
    let mut request = semicircle(9, &more);
    request["loads"][1]["load"] = json!({"body_acceleration": {"x_g": 1}});
    assert!(!notes(&request).contains("Is the unit right?"));
    // 2 kN/m on every metre of 20.
    let patch = json!({"patch_load": {"centre_x_m": 0, "width_m": 20, "force_n_per_m": 40e3}});
    request["loads"][1]["load"] = patch;
    assert!(!notes(&request).contains("Is the unit right?"));
}

#[test]
fn moving_geometry_is_said_to_leave_out_the_crushing_that_governs() {
    let mut request = semicircle(27, &json!({"geometry": "updated"}));
    let soft = text(&request);
    assert!(soft.contains("Moving geometry leaves out crushing, and no figure has both: alone it takes"), "{soft}");
    assert!(soft.contains("of the first-order load of stone that does not crush"), "{soft}");
    // Stone that hardly gives, and stone that does not crush.
    request["stone"] = json!({"youngs_modulus_pa": 1e12});
    assert!(!text(&request).contains("no figure has both"));
    request["stone"] = json!({"compressive_strength_pa": 1e30});
    let strong = text(&request);
    assert!(!strong.contains("no figure has both") && !strong.contains("first-order load of stone"), "{strong}");
}

/// A bridge of one span, with what more it has.
fn bridge(bridge: Value, more: Value) -> Value {
    let mut request = json!({
        "bridge": {"spans": [{
            "profile": {"circular": {"span_m": 8, "rise_m": 2}}, "rings": [{"thickness_m": 0.45, "voussoirs": 15}]
        }]},
        "loads": [{"load": {"self_weight": {}}}, {"load": {"point_load": {"x_m": -2, "force_n_per_m": 1000}}, "scaled": true}]
    });
    for (into, what) in [("/bridge", bridge), ("", more)] {
        request.pointer_mut(into).unwrap().as_object_mut().unwrap().extend(what.as_object().unwrap().clone());
    }
    request
}

#[test]
fn the_ground_behind_backing_is_told_with_what_it_takes() {
    let backing = json!({"level_m": 1.6});
    let answer = solved(&bridge(json!({"backing": backing}), json!({})));
    let notes = answer["notes"].to_string();
    let line = &answer["ends"][0]["thrust_line"];
    for (k, joint) in answer["structure"]["joints"].as_array().unwrap().iter().enumerate() {
        let between = joint["between"].to_string();
        if !(between.contains("backing") && between.contains("ground")) {
            continue;
        }
        let row = line["joint"].as_array().unwrap().iter().position(|joint| *joint == json!(k)).unwrap();
        let [thrust, friction] =
            ["normal_n_per_m", "shear_n_per_m"].map(|force| line[force][row].as_f64().unwrap() / 1e3);
        let ground =
            joint["between"].as_array().unwrap().iter().find(|name| name.to_string().contains("ground")).unwrap();
        let told = format!(
            "{} kN/m of thrust and {} kN/m of friction at {}",
            Digits(thrust),
            Digits(friction.abs()),
            ground.as_str().unwrap()
        );
        assert!(notes.contains(&told), "{told} in {notes}");
    }
    assert!(notes.contains("at ground.left") && notes.contains("at ground.right"), "{notes}");
    let abutment = json!({"height_m": 0.5, "width_m": 2});
    let abutments = json!({"backing": backing, "abutments": {"left": abutment, "right": abutment}});
    let leans = |request: &Value| self::notes(request).contains("leans on the ground");
    assert!(!leans(&bridge(abutments, json!({}))) && !leans(&bridge(json!({}), json!({}))));
}

#[test]
fn abutments_beside_fill_are_told_to_stand_alone() {
    let (fill, abutment) = (json!({"backfill": {"surface_height_m": 2.8}}), json!({"height_m": 0.5, "width_m": 3}));
    let abutments = json!({"abutments": {"left": abutment, "right": abutment}});
    let alone = |request: &Value| notes(request).contains("plumb backs of abutments");
    assert!(alone(&bridge(abutments.clone(), fill.clone())));
    assert!(!alone(&bridge(abutments, json!({}))) && !alone(&bridge(json!({}), fill)));
}

#[test]
fn numbers_in_another_unit_are_asked_about() {
    let fill = |density: f64| json!({"backfill": {"surface_height_m": 2.8, "density_kg_m3": density}});
    let stone = |name: &str, value: f64| json!({"stone": {(name): value}});
    let asks = |more: Value| notes(&bridge(json!({}), more)).matches("Is the unit right?").count();
    for (strange, right) in [
        (fill(19.0), fill(1900.0)),
        (stone("density_kg_m3", 22.0), stone("density_kg_m3", 2200.0)),
        (stone("friction_angle_deg", 0.6), stone("friction_angle_deg", 31.0)),
        (json!({"width_m": 5000}), json!({"width_m": 5})),
    ] {
        assert_eq!([asks(strange.clone()), asks(right)], [1, 0], "{strange}");
    }
    let vehicle = |force: f64| {
        let mut request = bridge(json!({}), json!({}));
        request["loads"][1]["load"] = json!({"vehicle": {
            "axles": [{"offset_m": 0, "force_n": force, "length_m": 0.3}], "x_m": -2,
            "effective_width_m": 2.5, "effective_width_rule": "mine"
        }});
        notes(&request).contains("Is the unit right?")
    };
    assert!(vehicle(250.0) && !vehicle(250e3));
}

#[test]
fn where_the_fixed_loads_crush_a_bridge_no_position_is_told() {
    let mut request = bridge(json!({}), json!({"analysis": {"worst_position": {"step_m": 0.5}}}));
    request["loads"][1]["load"] = json!({"vehicle": {
        "axles": [{"offset_m": 0, "force_n": 1e5, "length_m": 0.3}], "effective_width_m": 2.5, "effective_width_rule": "mine"
    }});
    let crushed = |strength: f64| {
        let mut request = request.clone();
        request["stone"] = json!({"compressive_strength_pa": strength});
        text(&request)
    };
    let [weak, strong] = [crushed(1e5), crushed(1e7)];
    assert!(weak.contains("The fixed loads alone crush the bridge") && !weak.contains("stands worst"), "{weak}");
    assert!(!weak.contains("it would collapse at"), "{weak}");
    assert!(strong.contains("stands worst at x = "), "{strong}");
}

#[test]
fn a_name_in_another_unit_is_put_right_with_its_value() {
    let request = bridge(json!({}), json!({"width_mm": 5000, "nmae": "a", "load_facto": {}}));
    let faults = read_question(request.to_string().as_bytes()).unwrap_err();
    let detail = |pointer: &str| &faults.iter().find(|fault| fault.pointer == pointer).unwrap().detail;
    assert!(detail("/width_mm").contains("write `width_m`, with its value in the unit"), "{faults:?}");
    assert!(detail("/nmae").contains("write `name` if that is meant"), "{faults:?}");
    assert!(detail("/load_facto").contains("write `load_factor` if that is meant"), "{faults:?}");
}
