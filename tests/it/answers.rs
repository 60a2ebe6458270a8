//! Stress, crushing, safety and the curved beam on the wire, from reports made up here.

use serde_json::{Value, json};
use voussoir::api::read::read_question;
use voussoir::api::request::Request;
use voussoir::api::response::JobResult;
use voussoir::collapse::{
    Answer, BeamReport, CollapseReport, Cost, Crushing, Direction, ElasticCrushing, Governs, LimitWindow, Mode, Note,
    Outcome, PlasticCrushing, Reach, SafetyFactors, SafetyPoint, SafetyZone, StressField, SubblockStress, TaskReport,
};
use voussoir::geometry::Vec2;

fn request(analysis: Value) -> Request {
    let flagged = analysis.pointer("/safety/curve").is_some();
    let request = json!({
        "arch": {"profile": {"circular": {"span_m": 4, "rise_m": 1}}, "thickness": {"constant_m": 0.4}, "voussoirs": 9},
        "mesh": {"subblocks": {"uniform": {"radial": 2, "along": 3}}},
        "loads": [{"load": {"self_weight": {}}, "scaled": true, "per_abscissa": flagged}],
        "load_factor": {"intensity_per_unit": 10, "unit": "kN"},
        "analysis": analysis
    });
    read_question(request.to_string().as_bytes()).unwrap().0
}

fn beam_request() -> Request {
    let beam = json!({"inner_radius_m": 0.5, "outer_radius_m": 0.7, "end_shear_n_per_m": 2500});
    read_question(json!({"curved_beam": beam}).to_string().as_bytes()).unwrap().0
}

fn subblock() -> SubblockStress {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [0.0, 2.0]].map(Vec2::from).to_vec();
    SubblockStress { voussoir: 4, place: [1, 2], centre: Vec2::new(0.5, 1.0), corners, stress: [-5.0, 1.0, 4.0] }
}

fn field(load_factor: f64) -> StressField {
    StressField { load_factor, subblocks: vec![subblock(); 2] }
}

fn factors() -> SafetyFactors {
    SafetyFactors {
        updated: Some(Reach::At(2.25)),
        instability: Reach::At(2.5),
        elastic: Reach::Never,
        plastic_section: Reach::DoesNotStand,
        governing: Reach::Unknown,
        governed_by: Governs::Instability,
        mode: Some(Mode::CrownRises),
        zone: Some(SafetyZone::CrownRises),
    }
}

fn report() -> CollapseReport {
    let window = LimitWindow { lowest: f64::NEG_INFINITY, highest: 3.0 };
    let elastic = ElasticCrushing { load_factor: Some(1.5), at_start: false, where_largest: Some(subblock()) };
    let plastic = PlasticCrushing { window: Some(window), joints: [vec![], vec![2, 5]], ends: [None, None] };
    CollapseReport {
        outcome: Outcome::Crushes,
        direction: Direction::Increase,
        proof: None,
        limit_window: Some(window),
        thrust_range: None,
        end: None,
        other_end: None,
        start: 1.0,
        cap: 100.0,
        share: 0.999,
        near_collapse: None,
        at_unit_load: None,
        at_start: None,
        stress_fields: vec![field(1.0)],
        crushing: Crushing { strength: 1e7, elastic: Some(elastic), plastic_section: Some(plastic) },
        updated: None,
        task: TaskReport::Safety(factors()),
        history: vec![],
        motion: None,
        other_motion: None,
        plan: None,
        cost: Cost::default(),
        notes: vec![],
    }
}

fn beam() -> BeamReport {
    BeamReport {
        field: field(1.0),
        exact: vec![9.0, 8.0],
        error: 0.0125,
        energy: [2.0, 2.5],
        unknowns: 294,
        plan: None,
    }
}

/// What `/results` serves.
fn served(request: &Request, answer: &Answer) -> Value {
    serde_json::from_slice(&JobResult::new(request, answer).unwrap().to_bytes().unwrap()).unwrap()
}

#[test]
fn a_stress_field_is_served_in_columns() {
    let answer = served(&request(json!("collapse")), &Answer::One(Box::new(report())));
    let field = &answer["stress_fields"][0];
    assert_eq!((&field["load_factor"], &field["intensity"]), (&json!(1.0), &json!(10.0)));
    let columns = json!({
        "voussoir": [4, 4], "radial": [1, 1], "along": [2, 2], "centre_x_m": [0.5, 0.5], "centre_y_m": [1.0, 1.0],
        "corners_x_m": [[0.0, 1.0, 1.0, 0.0], [0.0, 1.0, 1.0, 0.0]],
        "corners_y_m": [[0.0, 0.0, 2.0, 2.0], [0.0, 0.0, 2.0, 2.0]],
        "sigma_x_pa": [-5.0, -5.0], "sigma_y_pa": [1.0, 1.0], "tau_xy_pa": [4.0, 4.0],
        "sigma_1_pa": [3.0, 3.0], "sigma_2_pa": [-7.0, -7.0], "tresca_pa": [10.0, 10.0],
    });
    assert_eq!(field["subblocks"], columns);
}

#[test]
fn crushing_and_safety_are_served() {
    let answer = served(&request(json!({"safety": {}})), &Answer::One(Box::new(report())));
    assert_eq!(answer["outcome"], "crushes");
    let crushing = &answer["crushing"];
    assert_eq!(crushing["strength_pa"], 1e7);
    let mut elastic = crushing["elastic"].clone();
    assert!(elastic["note"].take().as_str().unwrap().contains("2 x 3 subblocks"));
    let subblock = json!({"voussoir": 4, "radial": 1, "along": 2, "centre_x_m": 0.5, "centre_y_m": 1.0,
                          "tresca_pa": 10.0});
    let expected =
        json!({"load_factor": 1.5, "intensity": 15.0, "at_start": false, "subblock": subblock, "note": null});
    assert_eq!(elastic, expected);
    let plastic = json!({"window": [null, 30.0], "window_load_factor": [null, 3.0], "joints_at_lowest": [],
                         "joints_at_highest": [2, 5]});
    assert_eq!(crushing["plastic_section"], plastic);
    assert_eq!(answer["safety"], safety());
}

fn safety() -> Value {
    json!({
        "instability": {"state": "at", "load_factor": 2.5},
        "updated_geometry": {"state": "at", "load_factor": 2.25}, "elastic": {"state": "never"},
        "plastic_section": {"state": "does_not_stand"}, "governing": {"state": "unknown"},
        "governed_by": "instability", "mode": "crown_rises", "zone": "crown_rises", "notes": []
    })
}

#[test]
fn what_was_not_found_is_null() {
    let nothing = CollapseReport { stress_fields: vec![], task: TaskReport::Collapse, ..report() };
    let answer = served(&request(json!("collapse")), &Answer::One(Box::new(nothing)));
    assert_eq!(answer["stress_fields"], json!([]));
    assert!(answer["safety"].is_null());
    let crushing = Crushing { strength: 1e7, elastic: None, plastic_section: None };
    let little = CollapseReport { crushing, ..report() };
    let answer = served(&request(json!("collapse")), &Answer::One(Box::new(little)));
    assert_eq!(answer["crushing"], json!({"strength_pa": 1e7, "elastic": null, "plastic_section": null}));
}

#[test]
fn a_curve_is_served_point_by_point() {
    let curve = json!({"abscissae": [0.5, 2], "unit": "m"});
    let request = request(json!({"safety": {"crushing": "elastic", "curve": curve}}));
    let point = |abscissa, factors| SafetyPoint { abscissa, factors, notes: vec![Note::YieldTooLate] };
    let second = SafetyFactors { mode: None, zone: None, ..factors() };
    let answer = served(&request, &Answer::Curve(vec![point(0.5, factors()), point(2.0, second)]));
    assert_eq!((&answer["unit"], &answer["crushing"]), (&json!("m"), &json!("elastic")));
    let mut first = safety();
    first["abscissa"] = json!(0.5);
    first["notes"] = json!([Note::YieldTooLate.to_string()]);
    assert_eq!(answer["points"][0], first);
    assert_eq!(answer["points"][1]["abscissa"], 2.0);
    assert!(answer["points"][1]["mode"].is_null() && answer["points"][1]["zone"].is_null());
    assert_eq!(answer["request"]["analysis"]["safety"]["curve"]["abscissae"], json!([0.5, 2.0]));
}

#[test]
fn a_beam_is_served() {
    let answer = served(&beam_request(), &Answer::CurvedBeam(beam()));
    assert_eq!((&answer["error_percent"], &answer["unknowns"]), (&json!(1.25), &json!(294)));
    assert_eq!((&answer["energy_j_per_m"], &answer["exact_energy_j_per_m"]), (&json!(2.0), &json!(2.5)));
    assert_eq!(answer["exact_tresca_pa"], json!([9.0, 8.0]));
    assert_eq!(answer["subblocks"]["tresca_pa"], json!([10.0, 10.0]));
    assert_eq!(answer["request"]["mesh"]["subblocks"]["uniform"], json!({"radial": 7, "along": 7}));
}

#[test]
fn a_number_that_is_none_is_never_served() {
    let one = |report| JobResult::new(&request(json!({"safety": {}})), &Answer::One(Box::new(report)));
    assert!(one(report()).is_some());
    let mut stressed = report();
    stressed.stress_fields[0].subblocks[1].stress[2] = f64::NAN;
    assert!(one(stressed).is_none());
    let mut reaching = report();
    reaching.task = TaskReport::Safety(SafetyFactors { elastic: Reach::At(f64::INFINITY), ..factors() });
    assert!(one(reaching).is_none());
    let spoilt = BeamReport { error: f64::NAN, ..beam() };
    assert!(JobResult::new(&beam_request(), &Answer::CurvedBeam(spoilt)).is_none());
    assert!(JobResult::new(&beam_request(), &Answer::One(Box::new(report()))).is_none(), "not the beam's answer");
}
