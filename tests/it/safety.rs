//! Safety analyses, crushing and stress fields, asked as a user asks.

use serde_json::{Value, json};
use voussoir::budget::Budget;
use voussoir::collapse::{Answer, CollapseReport, Governs, Note, Outcome, Question, Reach, answer, run};
use voussoir::wire::read::read_question;

/// The oval under 2 m of embankment of `cases/paper/figure-11`, changed.
fn oval(change: impl Fn(&mut Value)) -> CollapseReport {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/paper/figure-11/request.json");
    let mut request: Value = serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap();
    change(&mut request);
    let (_, question) = read_question(request.to_string().as_bytes()).unwrap();
    let Answer::One(report) = answer(&question, &Budget::unlimited()).unwrap() else { unreachable!("one analysis") };
    *report
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
        request["load_factor"] = json!({"cap": 2});
        request["report"] = json!({});
    });
    let safety = *report.safety().unwrap();
    assert_eq!(
        (safety.instability, safety.elastic, safety.plastic_section),
        (Reach::Never, Reach::Never, Reach::Never)
    );
    assert_eq!((safety.governed_by, report.outcome), (Governs::Nothing, Outcome::Stands));
    assert!(report.notes.is_empty(), "{:?}", report.notes);
}

#[test]
fn first_yield_does_not_count_in_place_of_plastic_sections_beyond_the_cap() {
    // First yield at 5.25, plastic sections at 5.66.
    let report = oval(|request| {
        request["load_factor"] = json!({"cap": 5.5});
        request["report"] = json!({});
    });
    let safety = *report.safety().unwrap();
    assert!(matches!(safety.elastic, Reach::At(factor) if factor < 5.3), "{:?}", safety.elastic);
    assert_eq!((safety.plastic_section, safety.governed_by), (Reach::Never, Governs::Nothing));
    assert!(report.notes.is_empty(), "{:?}", report.notes);
}

#[test]
fn stone_too_weak_for_what_the_arch_starts_with_crushes() {
    let weak = |request: &mut Value, strength: f64| {
        request["analysis"] = json!("collapse");
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

#[test]
fn first_yield_is_where_the_field_says() {
    let report = oval(|_| {});
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
fn a_mesh_too_coarse_for_first_yield_is_told_of() {
    // One subblock a stone knows mean stresses only: they reach the strength long after plastic sections have failed.
    let report = oval(|request| {
        request["mesh"] = json!({"subblocks": {"uniform": {"radial": 1, "along": 1}}});
        request["analysis"] = json!({"safety": {"crushing": "elastic"}});
    });
    let safety = *report.safety().unwrap();
    assert_eq!(safety.governing, safety.plastic_section);
    assert!(report.notes.contains(&Note::YieldTooLate), "{:?}", report.notes);
}

#[test]
fn half_an_arch_has_the_safety_of_the_whole() {
    let (half, whole) = (oval(|request| request["arch"]["half"] = json!(true)), oval(|_| {}));
    let (half, whole) = (half.safety().unwrap(), whole.safety().unwrap());
    for (a, b) in [(half.plastic_section, whole.plastic_section), (half.elastic, whole.elastic)] {
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
