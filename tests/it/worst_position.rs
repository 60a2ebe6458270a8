//! Vehicles and their worst position, through the wire.

mod scan;

use crate::common::answered::{end, solved, text};
use serde_json::{Value, json};
use voussoir::wire::fault::Fault;
use voussoir::wire::read::read_question;

/// A segmental bridge under fill whose surface, like that of the loads, lies at 1.813 m.
fn bridge(loads: &[Value], strength: f64) -> Value {
    let mut all = vec![
        json!({"load": {"self_weight": {}}}),
        json!({"load": {"fill_pressure": {"fill_height_m": 1.813, "fill_density_kg_m3": 2040}}}),
    ];
    all.extend(loads.iter().map(|load| json!({"load": load, "scaled": true})));
    json!({
        "arch": {
            "profile": {"circular": {"span_m": 6.55, "rise_m": 1.428}}, "line": "intrados",
            "thickness": {"constant_m": 0.22}, "voussoirs": 60
        },
        "stone": {"density_kg_m3": 2040, "friction_angle_deg": 40, "compressive_strength_pa": strength},
        "loads": all,
        "load_factor": {"unit": "kN/m", "intensity_per_unit": 1}
    })
}

fn dispersal() -> Value {
    json!({"surface_height_m": 1.813, "distribution": {"boussinesq": {}}})
}

fn vehicle(axles: &Value) -> Value {
    json!({"vehicle": {
        "axles": axles, "effective_width_m": 2.5, "effective_width_rule": "as measured", "dispersal": dispersal()
    }})
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn close(got: f64, expected: f64, tolerance: f64) {
    assert!((got / expected - 1.0).abs() <= tolerance, "{got} is not {expected}");
}

#[test]
fn the_worst_position_of_an_axle_is_that_of_another_program() {
    let axle = vehicle(&json!([{"offset_m": 0, "force_n": 2500, "length_m": 0.3}]));
    let mut request = bridge(&[axle], 4.5e6);
    request["analysis"] = json!({"worst_position": {"step_m": 0.05}});
    let answer = solved(&request);
    let worst = &answer["worst_position"];
    let curve = |name: &str| worst["curve"][name].as_array().unwrap().iter().map(Value::as_f64).collect::<Vec<_>>();
    let (x, instability, crushing) = (curve("x_m"), curve("instability"), curve("crushing"));
    // By a separate linear programme, integrated with tens of points: 31.2074 at -1.782 for stone that does not crush.
    let least = (0..x.len())
        .filter(|&i| instability[i].is_some())
        .min_by(|&a, &b| instability[a].partial_cmp(&instability[b]).unwrap());
    let least = least.unwrap();
    close(instability[least].unwrap(), 31.2074, 5e-4);
    close(x[least].unwrap().abs(), 1.782, 0.03);
    // The answer is that of the strip at the worst position, which governs by crushing here.
    assert_eq!(worst["governed_by"], "crushing");
    let strip = json!({"patch_load": {
        "centre_x_m": worst["x_m"], "width_m": 0.3, "force_n_per_m": 1000, "dispersal": dispersal()
    }});
    let alone = solved(&bridge(&[strip], 4.5e6));
    for (figure, at) in [("instability", &instability), ("crushing", &crushing)] {
        let of = |answer: &Value| number(&end(answer, "highest")[figure]["intensity"]);
        close(of(&answer), of(&alone), 1e-9);
        let here = x.iter().position(|x| *x == worst["x_m"].as_f64()).unwrap();
        close(at[here].unwrap(), of(&alone), 1e-7);
    }
    close(number(&worst["intensity"]), number(&end(&answer, "highest")["intensity"]), 1e-7);
    assert!(crushing.iter().flatten().all(|intensity| *intensity >= number(&worst["intensity"]) * (1.0 - 1e-8)));
    // What was asked is told as it was asked, and the position in words.
    assert!(answer["request"]["loads"][2]["load"]["vehicle"].get("x_m").is_none());
    assert!(text(&request).contains("worst position x = "));
}

/// Rows of another program, which integrated the stress with tens of points: mobilised share of the passive resistance,
/// strength, offsets and shares of 1 kN, worst position of the first axle and load.
#[test]
fn worst_positions_on_fill_that_resists_are_those_of_another_program() {
    let (single, bogie) = ([[0.0, 1.0]], [[0.0, 0.5], [1.3, 0.5]]);
    for (factor, strength, axles, at, load) in [
        (0.5, 1e12, &single[..], -1.905, 43.6721),
        (1.0, 1e12, &single, -1.932, 50.8056),
        (0.5, 4.5e6, &single, -1.905, 37.6598),
        (0.5, 1e12, &bogie, -3.008, 73.450),
        (0.5, 1e12, &[[0.0, 0.25], [1.3, 0.75]], -3.178, 55.262),
        (0.5, 1e12, &[[0.0, 0.75], [1.3, 0.25]], -2.014, 74.192),
    ] {
        let axle =
            |&[offset, share]: &[f64; 2]| json!({"offset_m": offset, "force_n": 2500.0 * share, "length_m": 0.3});
        let mut vehicle = vehicle(&axles.iter().map(axle).collect());
        vehicle["vehicle"]["dispersal"] = json!({});
        let mut request = bridge(&[vehicle], strength);
        request["loads"].as_array_mut().unwrap().remove(1);
        request["backfill"] = json!({
            "surface_height_m": 1.813, "density_kg_m3": 2040, "passive": {"friction_angle_deg": 30, "factor": factor}
        });
        request["analysis"] = json!({"worst_position": {"to_m": 0, "directions": "as_given"}});
        let worst = solved(&request)["worst_position"].take();
        println!("{factor} {strength} {axles:?}: {} at {}, expected {load} at {at}", worst["intensity"], worst["x_m"]);
        close(number(&worst["intensity"]), load, 5e-4);
        assert!((number(&worst["x_m"]) - at).abs() < 0.02, "{} is not {at}", worst["x_m"]);
    }
}

#[test]
fn a_vehicle_is_the_patch_loads_of_its_axles() {
    let mut axles = vehicle(&json!([
        {"offset_m": 0, "force_n": 50000, "length_m": 0.3, "factor": 1.5}, {"offset_m": -1.25, "force_n": 40000, "length_m": 0.2}
    ]));
    for (reversed, second) in [(false, -1.75), (true, 0.75)] {
        axles["vehicle"]["x_m"] = json!(-0.5);
        axles["vehicle"]["reversed"] = json!(reversed);
        let strip = |x: f64, width: f64, force: f64| json!({"patch_load": {"centre_x_m": x, "width_m": width, "force_n_per_m": force, "dispersal": dispersal()}});
        let [one, other] =
            [bridge(&[axles.clone()], 1e7), bridge(&[strip(-0.5, 0.3, 3e4), strip(second, 0.2, 1.6e4)], 1e7)]
                .map(|request| solved(&request));
        close(number(&one["ends"][0]["intensity"]), number(&other["ends"][0]["intensity"]), 1e-9);
    }
}

#[test]
fn a_group_of_a_standard_is_its_axles() {
    for (name, axles) in [
        ("cs454_single", vec![[0.0, 11.5]]),
        ("cs454_bogie_8t", vec![[0.0, 8.0], [1.0, 8.0]]),
        ("cs454_bogie_9_5t", vec![[0.0, 9.5], [1.3, 9.5]]),
        ("cs454_bogie_10t", vec![[0.0, 10.0], [1.8, 10.0]]),
        ("cs454_bogie_8t_lift_off", vec![[0.0, 12.0], [1.0, 4.0]]),
        ("cs454_bogie_9_5t_lift_off", vec![[0.0, 14.25], [1.3, 4.75]]),
        ("cs454_bogie_10t_lift_off", vec![[0.0, 15.0], [1.8, 5.0]]),
    ] {
        let axle =
            |&[offset, tonnes]: &[f64; 2]| json!({"offset_m": offset, "force_n": tonnes * 9810.0, "length_m": 0.25});
        let mut given = vehicle(&axles.iter().map(axle).collect());
        given["vehicle"]["x_m"] = json!(-1.5);
        let mut standard = given.clone();
        standard["vehicle"].as_object_mut().unwrap().remove("axles");
        standard["vehicle"]["standard"] = json!(name);
        standard["vehicle"]["length_m"] = json!(0.25);
        let [given, standard] =
            [given, standard].map(|load| number(&solved(&bridge(&[load], 1e7))["ends"][0]["intensity"]));
        close(standard, given, 1e-9);
    }
}

#[test]
fn what_stands_beyond_the_springings_is_told() {
    let mut axle = vehicle(&json!([{"offset_m": 0, "force_n": 2500, "length_m": 0.3}]));
    axle["vehicle"]["x_m"] = json!(-3.3);
    let words = text(&bridge(&[axle], 1e7));
    assert!(
        words.contains("Of the force of loads[2] 54.7") || words.contains("Of the force of loads[2] 54.8"),
        "{words}"
    );
    assert!(words.contains("effective width 2.5 m (as measured)"), "{words}");
}

#[test]
fn where_joints_slide_the_worst_position_is_said_to_be_that_of_limit_analysis() {
    for (friction, slides) in [(15.0, true), (40.0, false)] {
        let axle = vehicle(&json!([{"offset_m": 0, "force_n": 2500, "length_m": 0.3}]));
        let mut request = bridge(&[axle], 1e30);
        request["arch"]["thickness"]["constant_m"] = json!(0.35);
        request["arch"]["voussoirs"] = json!(20);
        request["stone"]["friction_angle_deg"] = json!(friction);
        request["analysis"] = json!({"worst_position": {"step_m": 0.5, "to_m": 0}});
        let answer = solved(&request);
        let slid = end(&answer, "highest")["slides"].as_array().unwrap();
        assert_eq!(!slid.is_empty(), slides, "{slid:?}");
        assert_eq!(answer["notes"].to_string().contains("may be lower at another"), slides, "{}", answer["notes"]);
    }
}

fn faults(request: &Value) -> Vec<Fault> {
    read_question(request.to_string().as_bytes()).err().unwrap_or_default()
}

#[test]
fn what_cannot_be_is_refused() {
    let axles =
        json!([{"offset_m": 0, "force_n": 1000, "length_m": 0.3}, {"offset_m": 1, "force_n": 1000, "length_m": 0.3}]);
    let mut request = bridge(&[vehicle(&axles)], 1e7);
    request["analysis"] = json!({"worst_position": {}});
    assert_eq!(faults(&request), []);
    let (load, asked) = ("/loads/2/load/vehicle", "/analysis/worst_position");
    for (set, value, pointer) in [
        (format!("{load}/axles/1/offset_m"), json!(0), format!("{load}/axles/1/offset_m")),
        (format!("{load}/axles/1/force_n"), json!(0), format!("{load}/axles/1/force_n")),
        (format!("{load}/axles/1/length_m"), json!(0), format!("{load}/axles/1/length_m")),
        (format!("{load}/axles/1/factor"), json!(0), format!("{load}/axles/1/factor")),
        (format!("{load}/axles"), json!([]), format!("{load}/axles")),
        (format!("{load}/standard"), json!("cs454_single"), load.to_owned()),
        (format!("{load}/standard"), json!("hb45"), format!("{load}/standard")),
        (format!("{load}/length_m"), json!(0.3), format!("{load}/length_m")),
        (format!("{load}/effective_width_m"), json!(0), format!("{load}/effective_width_m")),
        (format!("{load}/x_m"), json!(1), asked.to_owned()),
        (format!("{load}/dispersal/surface_height_m"), json!(1.5), format!("{load}/dispersal/surface_height_m")),
        ("/loads/2/scaled".into(), json!(false), asked.to_owned()),
        ("/loads/2/coefficient".into(), json!(-1), "/loads/2/coefficient".into()),
        ("/load_factor/direction".into(), json!("decrease"), "/load_factor/direction".into()),
        ("/arch/half".into(), json!(true), "/arch/half".into()),
        (format!("{asked}/step_m"), json!(0), format!("{asked}/step_m")),
        (format!("{asked}/step_m"), json!(1e-4), format!("{asked}/step_m")),
        (format!("{asked}/from_m"), json!(40), format!("{asked}/from_m")),
        (format!("{asked}/tolerance"), json!(1), format!("{asked}/tolerance")),
        (format!("{asked}/directions"), json!("left"), format!("{asked}/directions")),
        ("/analysis".into(), json!("collapse"), format!("{load}/x_m")),
    ] {
        let mut request = request.clone();
        let (parent, key) = set.rsplit_once('/').unwrap();
        request.pointer_mut(parent).unwrap()[key] = value.clone();
        let found = faults(&request);
        assert!(found.iter().any(|fault| fault.pointer == pointer), "{set} = {value}: {found:?}");
        assert!(found.iter().all(|fault| fault.detail.len() > 20), "{found:?}");
    }
    // Many positions of many axles are refused at once, not looked at one by one.
    let mut many = request.clone();
    many["arch"]["voussoirs"] = json!(1000);
    many["analysis"]["worst_position"] = json!({"step_m": 0.01, "directions": "as_given"});
    let axle = |k: i32| json!({"offset_m": 0.02 * f64::from(k), "force_n": 1000, "length_m": 0.3});
    many["loads"][2]["load"]["vehicle"]["axles"] = (0..50).map(axle).collect();
    let found = faults(&many);
    assert!(found.len() == 1 && found[0].detail.contains("upper faces come to"), "{found:?}");
    let mut lacks = request.clone();
    lacks["loads"][2]["load"]["vehicle"].as_object_mut().unwrap().remove("effective_width_rule");
    assert_eq!(faults(&lacks)[0].pointer, format!("{load}/effective_width_rule"));
}
