//! Stress, crushing, safety and the curved beam on the wire, from reports made up here.

use serde_json::{Value, json};
use std::time::Duration;
use voussoir::collapse::{
    Answer, BeamReport, CollapseReport, Cost, CrushedJoint, Crushing, Direction, ElasticCrushing, Face, FallingMotion,
    Governs, Hinge, HistoryPoint, LiftOff, LimitWindow, LoadRange, MeanStress, Mechanism, Mode, MotionContact,
    MotionEnd, MotionFrame, Note, OpenHinge, Outcome, PathEnd, PlasticCrushing, Reach, SafetyFactors, SafetyPoint,
    SafetyZone, SettlementEnd, SettlementPath, SettlementPoint, SettlementReport, Slid, Slide, StatesFrom, StressField,
    SubblockStress, TaskReport, Thrust,
};
use voussoir::geometry::Vec2;
use voussoir::wire::json::NotFinite;
use voussoir::wire::read::read_question;
use voussoir::wire::rendering::renderings;
use voussoir::wire::request::Request;
use voussoir::wire::response::JobResult;

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
    let stress = [-5.0, 1.0, 4.0];
    let corner_stress = vec![stress; corners.len()];
    SubblockStress { voussoir: 4, place: [1, 2], centre: Vec2::new(0.5, 1.0), corners, stress, corner_stress }
}

fn field(load_factor: f64) -> StressField {
    StressField { load_factor, subblocks: vec![subblock(); 2], roughness: Vec::new() }
}

fn factors() -> SafetyFactors {
    SafetyFactors {
        updated: Some(Reach::At(2.25)),
        instability: Reach::At(2.5),
        elastic: Some(Reach::Never),
        plastic_section: Reach::DoesNotStand,
        governing: Reach::Unknown,
        governed_by: Governs::Instability,
        mode: Some(Mode::CrownRises),
        zone: Some(SafetyZone::CrownRises),
    }
}

fn report() -> CollapseReport {
    let window = LimitWindow { lowest: f64::NEG_INFINITY, highest: 3.0 };
    let SubblockStress { voussoir, place, centre, stress, .. } = subblock();
    let largest = MeanStress { voussoir, place, centre, sizes: [2.0, 1.0], stress };
    let elastic =
        ElasticCrushing { load_factor: Some(1.5), at_start: false, length: None, where_largest: Some(largest) };
    let plastic = PlasticCrushing { window: Some(window), joints: [vec![], vec![2, 5]], ends: [None, None] };
    CollapseReport {
        outcome: Outcome::Crushes,
        direction: Direction::Increase,
        proof: None,
        limit_window: Some(window),
        thrust_range: None,
        thrust_range_lines: [None, None],
        end: None,
        other_end: None,
        start: 1.0,
        cap: 100.0,
        share: 0.999,
        near_collapse: None,
        at_unit_load: None,
        at_start: None,
        stress_fields: vec![field(1.0)],
        crushing: Crushing {
            strength: 1e7,
            elastic: Some(elastic),
            plastic_section: Some(plastic),
            on_path: [None, None],
        },
        updated: None,
        task: TaskReport::Safety(factors()),
        states_from: StatesFrom::LoadPath,
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
    let all = |number: f64| vec![[number; 4]; 2];
    let columns = json!({
        "voussoir": [4, 4], "radial": [1, 1], "along": [2, 2], "centre_x_m": [0.5, 0.5], "centre_y_m": [1.0, 1.0],
        "corners_x_m": [[0.0, 1.0, 1.0, 0.0], [0.0, 1.0, 1.0, 0.0]],
        "corners_y_m": [[0.0, 0.0, 2.0, 2.0], [0.0, 0.0, 2.0, 2.0]],
        "sigma_x_pa": [-5.0, -5.0], "sigma_y_pa": [1.0, 1.0], "tau_xy_pa": [4.0, 4.0],
        "sigma_1_pa": [3.0, 3.0], "sigma_2_pa": [-7.0, -7.0], "tresca_pa": [10.0, 10.0],
        "corner_sigma_x_pa": all(-5.0), "corner_sigma_y_pa": all(1.0), "corner_tau_xy_pa": all(4.0),
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
    let note = elastic["note"].take();
    let said = ["2 x 3 subblocks", "averaged over every subblock, this one of 2 m x 1 m"];
    assert!(said.iter().all(|words| note.as_str().unwrap().contains(words)), "{note}");
    let subblock = json!({"voussoir": 4, "radial": 1, "along": 2, "centre_x_m": 0.5, "centre_y_m": 1.0,
                          "size_across_m": 2.0, "size_along_m": 1.0, "tresca_pa": 10.0});
    let expected = json!({"load_factor": 1.5, "intensity": 15.0, "at_start": false, "length_m": null,
                          "subblock": subblock, "note": null});
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
    let crushing = Crushing { strength: 1e7, elastic: None, plastic_section: None, on_path: [None, None] };
    let little = CollapseReport { crushing, ..report() };
    let answer = served(&request(json!("collapse")), &Answer::One(Box::new(little)));
    assert_eq!(answer["crushing"], json!({"strength_pa": 1e7, "elastic": null, "plastic_section": null}));
}

#[test]
fn first_yield_of_a_length_says_so() {
    let mut report = report();
    report.crushing.elastic.as_mut().unwrap().length = Some(0.25);
    let answer = served(&request(json!({"safety": {}})), &Answer::One(Box::new(report)));
    let elastic = &answer["crushing"]["elastic"];
    assert_eq!(elastic["length_m"], 0.25);
    assert!(elastic["note"].as_str().unwrap().contains("averaged over 0.25 m both ways"), "{elastic}");
}

#[test]
fn a_curve_is_served_point_by_point() {
    let curve = json!({"abscissae": [0.5, 2], "unit": "m"});
    let request = request(json!({"safety": {"crushing": "elastic", "curve": curve}}));
    let too_late = Note::YieldTooLate { length: None };
    let point = |abscissa, factors| SafetyPoint { abscissa, factors, notes: vec![too_late.clone()] };
    let second = SafetyFactors { mode: None, zone: None, ..factors() };
    let answer = served(&request, &Answer::Curve(vec![point(0.5, factors()), point(2.0, second)]));
    assert_eq!((&answer["unit"], &answer["crushing"]), (&json!("m"), &json!("elastic")));
    let mut first = safety();
    first["abscissa"] = json!(0.5);
    first["notes"] = json!([too_late.to_string()]);
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

/// A collapse with a motion and a movement of supports, so that there is a number of every kind.
fn full() -> CollapseReport {
    let at = Vec2::new(1.0, 2.0);
    let hinge = Hinge {
        joint: 2,
        face: Face::Intrados,
        at,
        angle_from_springing: Some(0.5),
        angle_from_crown: None,
        rotation: 1.0,
    };
    let mechanism = Mechanism {
        mode: Mode::Sway,
        hinges: vec![hinge],
        slides: vec![Slide { joint: 1, at, rate: 0.5 }],
        lift_offs: vec![LiftOff { joint: 3, at, intrados: 1.0, extrados: 2.0, along: 3.0 }],
        velocities: vec![[1.0; 3]; 9],
    };
    let thrust_line = vec![Thrust { joint: 0, normal: 1.0, shear: 2.0, eccentricity: 3.0, at }];
    let range = LoadRange { least: 1.0, greatest: f64::INFINITY, path: 2.0, mechanisms_tried: 3 };
    let end = PathEnd {
        load_factor: 2.0,
        range: Some(range),
        residual: 1e-12,
        mechanism: mechanism.clone(),
        thrust_line: thrust_line.clone(),
        soil: Vec::new(),
        crushed: vec![CrushedJoint { joint: 4, face: Face::Extrados, at, length: 0.1 }],
    };
    let contact = MotionContact {
        bodies: [Some(0), None],
        joint: None,
        at,
        direction: Vec2::x(),
        normal: 1.0,
        tangential: 2.0,
        gap: 3.0,
    };
    let frame = MotionFrame {
        parameter: 0.5,
        centroids: vec![at; 9],
        rotations: vec![0.25; 9],
        contacts: vec![contact],
        hinges: vec![OpenHinge { joint: 0, face: Face::Intrados, opening: 0.125 }],
        slides: vec![Slid { joint: 0, by: 0.0625 }],
        displacement: 1.0,
        penetration: 2.0,
        residual: 3.0,
        excess: 4.0,
        work: 5.0,
    };
    let motion = FallingMotion {
        end: MotionEnd::Moved,
        load_factor: 2.0,
        overload: 0.1,
        span: 4.0,
        thickness: 0.4,
        frames: vec![frame],
    };
    let settlement = SettlementPath {
        end: SettlementEnd::Follows,
        why: None,
        share: 1.0,
        safe: 1.0,
        points: vec![SettlementPoint { share: 0.5, forces: vec![at; 2] }],
        mechanism,
        thrust_line,
        open_joints: Vec::new(),
        soil: Vec::new(),
        displacements: vec![[1.0; 3]; 9],
        snap: Some(0.5),
        residual: 1e-12,
    };
    let settlement = SettlementReport { first_order: settlement.clone(), updated: Some(settlement) };
    CollapseReport {
        outcome: Outcome::Collapse,
        end: Some(end),
        motion: Some(motion),
        task: TaskReport::Settlement(Some(Box::new(settlement))),
        history: vec![HistoryPoint { load_factor: 0.5, crown: at, largest: 1.0 }],
        ..report()
    }
}

type Forgery = fn(&mut CollapseReport, f64);

/// Where a number of a forged report is refused.
const FORGED: [(&str, Forgery); 12] = [
    ("/ends/0/motion/frames/residual", |report, none| report.motion.as_mut().unwrap().frames[0].residual = none),
    ("/ends/0/motion/contacts/gap_m", |report, none| report.motion.as_mut().unwrap().frames[0].contacts[0].gap = none),
    ("/ends/0/motion/hinges/", |report, none| report.motion.as_mut().unwrap().frames[0].hinges[0].opening = none),
    ("/settlement/first_order/residual", |report, none| settled(report).first_order.residual = none),
    ("/settlement/updated_geometry/residual", |report, none| settled(report).updated.as_mut().unwrap().residual = none),
    ("/ends/0/hinges/0/rotation", |report, none| report.end.as_mut().unwrap().mechanism.hinges[0].rotation = none),
    ("/ends/0/residual", |report, none| report.end.as_mut().unwrap().residual = none),
    ("/ends/0/thrust_line/", |report, none| report.end.as_mut().unwrap().thrust_line[0].at.y = none),
    ("/history/", |report, none| report.history[0].largest = none),
    ("/stress_fields/0/subblocks/", |report, none| report.stress_fields[0].subblocks[1].stress[2] = none),
    ("/crushing/elastic/", |report, none| report.crushing.elastic.as_mut().unwrap().load_factor = Some(none)),
    ("/cap", |report, none| report.cap = none),
];

fn settled(report: &mut CollapseReport) -> &mut SettlementReport {
    let TaskReport::Settlement(Some(settlement)) = &mut report.task else { unreachable!("as made above") };
    settlement
}

#[test]
fn a_number_that_is_none_is_refused_by_its_name() {
    let request = request(json!("collapse"));
    let one = |report| JobResult::new(&request, &Answer::One(Box::new(report))).unwrap().to_bytes();
    assert!(one(full()).is_ok());
    for (place, forge) in FORGED {
        for none in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut report = full();
            forge(&mut report, none);
            let NotFinite(refused) = one(report).unwrap_err();
            assert!(refused.starts_with(place), "{refused} instead of {place}");
        }
    }
    // Unbounded is null; unknown is neither a number nor unbounded.
    let mut spoilt = full();
    spoilt.limit_window.as_mut().unwrap().highest = f64::NAN;
    assert_eq!(one(spoilt), Err(NotFinite("/limit_window/1".to_owned())));
    let spoilt = BeamReport { error: f64::NAN, ..beam() };
    let spoilt = JobResult::new(&beam_request(), &Answer::CurvedBeam(spoilt)).unwrap();
    assert_eq!(spoilt.to_bytes(), Err(NotFinite("/error_percent".to_owned())));
    let wrong = JobResult::new(&beam_request(), &Answer::One(Box::new(report())));
    assert!(wrong.is_none(), "not the beam's answer");
}

#[test]
fn no_form_of_a_refused_answer_is_written() {
    let body = serde_json::to_vec(&request(json!("collapse"))).unwrap();
    let (request, question) = read_question(&body).unwrap();
    let write = |report| renderings(&request, &question, &Answer::One(Box::new(report)), Duration::ZERO);
    let fine = write(full()).unwrap();
    for rendering in fine.iter() {
        let bytes = rendering.part.body.as_ref().unwrap();
        let text = String::from_utf8(bytes.to_vec()).unwrap();
        assert!(!text.contains("NaN") && !text.contains("inf,") && !text.contains("inf "), "{:?}", rendering.names);
    }
    let formats: Vec<_> = fine.iter().map(|rendering| (rendering.names[0].as_str(), rendering.format)).collect();
    let fields = ["json", "csv", "vtu"].map(|format| ("fields/unit_load", format));
    let whole = [("results", "json"), ("results", "text"), ("history", "json"), ("history", "csv")];
    let drawn = ["figure", "figures/stress_unit_load", "figures/motion"].map(|name| (name, "svg"));
    assert_eq!(formats, [&whole[..], &fields, &drawn, &[("report", "html")]].concat());
    for (place, forge) in FORGED {
        let mut report = full();
        forge(&mut report, f64::NAN);
        let failure = write(report).unwrap_err();
        assert!(failure.to_string().contains(place), "{failure}");
    }
}
