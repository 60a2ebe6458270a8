//! Safety analyses, crushing and stress fields, asked as a user asks.

use crate::common::answered::text;
use serde_json::{Value, json};
use voussoir::budget::Budget;
use voussoir::collapse::{Answer, CollapseReport, Governs, Note, Outcome, Question, Reach, answer, run};
use voussoir::wire::read::read_question;

/// The oval under 2 m of embankment.
fn figure_11() -> Value {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/paper/figure-11/request.json");
    serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap()
}

/// The same, changed.
fn oval(change: impl Fn(&mut Value)) -> CollapseReport {
    let mut request = figure_11();
    change(&mut request);
    let (_, question) = read_question(request.to_string().as_bytes()).unwrap();
    let Answer::One(report) = answer(&question, &Budget::unlimited()).unwrap() else { unreachable!("one analysis") };
    *report
}

/// Length over which stress is averaged, m.
const LENGTH: f64 = 0.5;

/// Lets first yield of subblocks count, as in the paper.
fn by_first_yield(request: &mut Value) {
    request["analysis"] = json!({"safety": {"crushing": "elastic"}});
}

#[test]
fn fields_on_both_legs_of_a_window_are_found_and_come_as_asked() {
    let factors = [0.3, 5.0, 1.0, 0.5];
    let report = oval(|request| {
        request["analysis"] = json!("collapse");
        request["report"]["stress_fields"] = factors.iter().map(|f| json!({"load_factor": f})).collect();
    });
    assert_eq!(report.outcome, Outcome::StandsInWindow);
    let found: Vec<f64> = report.stress_fields.iter().map(|field| field.load_factor).collect();
    assert_eq!(found, factors);
    assert!(report.notes.iter().all(|note| !matches!(note, Note::NoStressField { .. })), "{:?}", report.notes);
}

#[test]
fn a_field_off_the_path_is_said_to_be_missing() {
    let report = oval(|request| request["report"]["stress_fields"] = json!([{"load_factor": 0.5}, "near_collapse"]));
    assert!(report.stress_fields.is_empty());
    assert!(report.notes.iter().any(|note| note.to_string().contains("load factor 0.5")), "{:?}", report.notes);
    assert!(report.notes.iter().any(|note| note.to_string().contains("near collapse")), "{:?}", report.notes);
}

#[test]
fn nothing_is_said_of_what_lies_beyond_the_cap() {
    let report = oval(|request| {
        by_first_yield(request);
        request["load_factor"] = json!({"cap": 2});
        request["report"] = json!({});
    });
    let safety = *report.safety().unwrap();
    assert_eq!(
        (safety.instability, safety.elastic, safety.plastic_section),
        (Reach::Never, Some(Reach::Never), Reach::Never)
    );
    assert_eq!((safety.governed_by, report.outcome), (Governs::Nothing, Outcome::Stands));
    assert!(report.notes.is_empty(), "{:?}", report.notes);
}

#[test]
fn first_yield_does_not_count_in_place_of_plastic_sections_beyond_the_cap() {
    // First yield at 5.25, plastic sections at 5.66.
    let capped = |crushing: &str| {
        oval(|request| {
            request["analysis"] = json!({"safety": {"crushing": crushing}});
            request["load_factor"] = json!({"cap": 5.5});
            request["report"] = json!({});
        })
    };
    let yields = *capped("elastic").safety().unwrap();
    assert!(matches!(yields.elastic, Some(Reach::At(factor)) if factor < 5.3), "{:?}", yields.elastic);
    assert_eq!((Some(yields.governing), yields.governed_by), (yields.elastic, Governs::Crushing));
    let report = capped("plastic_section");
    let safety = *report.safety().unwrap();
    assert_eq!((safety.elastic, safety.plastic_section), (None, Reach::Never));
    assert_eq!(safety.governed_by, Governs::Nothing);
    assert!(report.notes.is_empty(), "{:?}", report.notes);
}

#[test]
fn stone_too_weak_for_what_the_arch_starts_with_crushes() {
    let weak = |request: &mut Value, strength: f64| {
        request["analysis"] = json!("collapse");
        request["report"] = json!({"first_yield_length_m": 1});
        request["stone"] = json!({"compressive_strength_pa": strength});
    };
    let report = oval(|request| weak(request, 1e4));
    assert_eq!(report.outcome, Outcome::Crushes);
    assert!(report.crushing.elastic.unwrap().at_start);
    assert!(report.notes.iter().any(|note| note.to_string().contains("10000 Pa")), "{:?}", report.notes);
    // A stone that cannot crush changes nothing.
    let (hard, soft) = (oval(|request| weak(request, 1e30)), oval(|request| weak(request, 1e7)));
    assert_eq!((hard.outcome, hard.end), (soft.outcome, soft.end));
    let window = hard.crushing.plastic_section.unwrap().window;
    assert_eq!(window, hard.limit_window);
}

/// Pressure that has to be reversed: the arch stands only under some of it, seen from which load factor 1 and all above 0 lie outside.
#[test]
fn a_factor_below_nought_is_none() {
    let request = json!({
        "arch": {
            "profile": {"elliptical": {"span_m": 10.399501342810378, "rise_m": 1.7094493888141038}},
            "thickness": {"constant_m": 1.0909612390111096},
            "voussoirs": 44,
        },
        "stone": {"density_kg_m3": 1675.7004920858353, "friction_angle_deg": 30, "compressive_strength_pa": 771005.5479630372},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"patch_load": {"centre_x_m": -2.298733827893909, "width_m": 2.8136071151849467, "force_n_per_m": 23601.185176403786}}},
            {
                "load": {"lateral_pressure": {"side": "both", "bands": [
                    {"from_m": 0.5784099045289178, "to_m": 2.145141405233399, "pressure_pa": 1580.9688210291652},
                ]}},
                "scaled": true,
                "coefficient": -0.631437244161257,
            },
        ],
        "analysis": {"safety": {}},
    });
    let (_, question) = read_question(request.to_string().as_bytes()).unwrap();
    let Answer::One(report) = answer(&question, &Budget::unlimited()).unwrap() else { unreachable!("one analysis") };
    let safety = *report.safety().unwrap();
    assert!(report.limit_window.unwrap().highest < 0.0);
    assert_eq!([safety.plastic_section, safety.governing], [Reach::DoesNotStand; 2]);
}

#[test]
fn first_yield_is_where_the_field_says() {
    let report = oval(by_first_yield);
    let yielding = report.crushing.elastic.unwrap();
    let factor = yielding.load_factor.unwrap();
    let largest = |at: f64| {
        let report = oval(|request| request["report"]["stress_fields"] = json!([{"load_factor": at}]));
        report.stress_fields[0].subblocks.iter().map(|s| s.tresca()).fold(0.0, f64::max)
    };
    assert!((largest(factor) / 1e7 - 1.0).abs() < 1e-9);
    assert!(largest(0.999 * factor) < 1e7);
    assert!((yielding.where_largest.unwrap().tresca() / 1e7 - 1.0).abs() < 1e-9);
}

#[test]
fn first_yield_of_a_length_is_said_with_it_and_left_out_where_nobody_asks() {
    let asked = |length: Option<f64>, radial: usize| {
        let mut request = figure_11();
        request["mesh"] = json!({"subblocks": {"uniform": {"radial": radial, "along": 2 * radial}}});
        request["report"] = json!({});
        if let Some(length) = length {
            request["report"]["first_yield_length_m"] = json!(length);
        }
        text(&request)
    };
    let plain = asked(None, 5);
    assert!(!plain.to_lowercase().contains("first yield"), "{plain}");
    let told = asked(Some(LENGTH), 5);
    for part in ["over 0.5 m x 0.5 m about x = ", "; first yield: ", "stress averaged over 0.5 m"] {
        assert!(told.replace("\n", " ").contains(part), "{part}: {told}");
    }
    // Of whole stones no length is known: the note says what takes.
    let coarse = asked(Some(LENGTH), 1);
    assert!(coarse.contains("first yield: unknown") && coarse.contains("First yield is not given"), "{coarse}");
    assert!(coarse.contains("tells of no length"), "{coarse}");
}

#[test]
fn with_an_accuracy_first_yield_is_that_on_the_mesh_found() {
    let first_yield = |accuracy: bool, length: f64| {
        let report = oval(|request| {
            request["report"] = json!({"first_yield_length_m": length});
            request["mesh"] = json!({"subblocks": {"uniform": {"radial": 16, "along": 24}}});
            if accuracy {
                request.as_object_mut().unwrap().remove("mesh");
                request["accuracy"] = json!({"stress": 0.1, "subblocks": 20_000});
            }
        });
        assert!(!report.notes.iter().any(|note| matches!(note, Note::TooCoarseToYield { .. })), "{:?}", report.notes);
        (report.crushing.elastic.unwrap(), report.plan)
    };
    let (found, plan) = first_yield(true, 0.8);
    let (fine, _) = first_yield(false, 0.8);
    println!("{:?} {:?} {plan:?}", found.load_factor, fine.load_factor);
    assert!(plan.unwrap().half && found.length == Some(0.8));
    assert!((found.load_factor.unwrap() / fine.load_factor.unwrap() - 1.0).abs() < 0.01);
    // This length takes a finer mesh than the accuracy does.
    assert_eq!(first_yield(true, 0.3).0.length, Some(0.3));
}

#[test]
fn a_mesh_too_coarse_for_first_yield_is_told_of() {
    // One subblock a stone knows mean stresses only: they reach the strength long after plastic sections have failed.
    let report = oval(|request| {
        request["mesh"] = json!({"subblocks": {"uniform": {"radial": 1, "along": 1}}});
        request["analysis"] = json!({"safety": {"crushing": "elastic"}});
    });
    let safety = *report.safety().unwrap();
    assert_eq!(safety.governing, safety.plastic_section);
    assert!(report.notes.contains(&Note::YieldTooLate { length: None }), "{:?}", report.notes);
}

#[test]
fn a_length_that_hides_the_peaks_of_stress_is_told_of() {
    let report = oval(|request| {
        by_first_yield(request);
        request["mesh"] = json!({"subblocks": {"uniform": {"radial": 5, "along": 10}}});
        request["report"] = json!({"first_yield_length_m": LENGTH});
    });
    let safety = *report.safety().unwrap();
    assert_eq!(safety.governing, safety.plastic_section);
    assert!(report.notes.contains(&Note::YieldTooLate { length: Some(LENGTH) }), "{:?}", report.notes);
}

#[test]
fn half_an_arch_has_the_safety_of_the_whole() {
    let half = oval(|request| {
        by_first_yield(request);
        request["arch"]["half"] = json!(true);
    });
    let whole = oval(by_first_yield);
    let (half, whole) = (half.safety().unwrap(), whole.safety().unwrap());
    for (a, b) in [(half.plastic_section, whole.plastic_section), (half.elastic.unwrap(), whole.elastic.unwrap())] {
        let (Reach::At(a), Reach::At(b)) = (a, b) else { panic!("{a:?} {b:?}") };
        assert!((a / b - 1.0).abs() < 1e-3, "{a} {b}");
    }
}

#[test]
fn a_curve_is_its_points_one_by_one() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/paper/figure-13/request.json");
    let (_, question) = read_question(&std::fs::read(file).unwrap()).unwrap();
    let Answer::Curve(points) = answer(&question, &Budget::unlimited()).unwrap() else { unreachable!("a curve") };
    let Question::Curve(asked) = question else { unreachable!("a curve") };
    assert_eq!(points.len(), asked.len());
    for (point, asked) in points.iter().zip(&asked) {
        let alone = run(&asked.analysis, &Budget::unlimited()).unwrap();
        let alone = alone.safety().unwrap();
        assert_eq!((point.abscissa, point.factors.governing), (asked.abscissa, alone.governing));
    }
}
