//! Fill: it presses sideways where that is asked for, it has mass in every acceleration, and the answer says what was taken.

use crate::common::answered::{solved, text};
use crate::common::dice::Dice;
use crate::common::masonry::Ring;
use crate::common::oracle::{Problem, Push};
use serde_json::{Value, json};
use voussoir::collapse::{Analysis, CurvePoint, Question};
use voussoir::geometry::{Vec2, cross};
use voussoir::structure::PointForce;
use voussoir::wire::read::{read, read_analysis, read_question};

/// A semicircle of mean radius 10 m and thickness 1.5 m, its weight, and these loads.
fn arch(loads: Value) -> Value {
    let mut all = vec![json!({"load": {"self_weight": {}}})];
    all.extend_from_slice(loads.as_array().unwrap());
    json!({
        "arch": {
            "profile": {"circular": {"radius_m": 10.0, "opening_angle_deg": 180.0}},
            "thickness": {"constant_m": 1.5}, "voussoirs": 27
        },
        "stone": {"friction_angle_deg": 45},
        "loads": all
    })
}

/// Fill up to the crown.
fn fill() -> Value {
    json!({"load": {"fill_pressure": {"fill_height_m": 11.5}}})
}

fn shaken(x_g: f64, y_g: f64) -> Value {
    json!({"load": {"body_acceleration": {"x_g": x_g, "y_g": y_g}}})
}

/// `value` with these members set.
fn with(mut value: Value, members: Value) -> Value {
    for (name, member) in members.as_object().unwrap() {
        value[name] = member.clone();
    }
    value
}

fn scaled(load: Value) -> Value {
    with(load, json!({"scaled": true}))
}

/// Fill with one more field.
fn fill_with(name: &str, value: f64) -> Value {
    let mut load = fill();
    load["load"]["fill_pressure"][name] = json!(value);
    load
}

fn analysis(request: &Value) -> Analysis {
    read_analysis(request.to_string().as_bytes()).unwrap().1
}

fn faults(request: &Value) -> Vec<(String, String)> {
    let faults = read_question(request.to_string().as_bytes()).unwrap_err();
    faults.into_iter().map(|fault| (fault.pointer, fault.detail)).collect()
}

fn intensity(request: &Value) -> f64 {
    solved(request)["ends"][0]["instability"]["intensity"].as_f64().unwrap()
}

/// Force and moment about the origin of all forces.
fn wrench(forces: &[PointForce]) -> [f64; 3] {
    forces.iter().fold([0.0; 3], |w, f| [w[0] + f.force.x, w[1] + f.force.y, w[2] + cross(f.at, f.force)])
}

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} is not {expected}");
}

#[test]
fn fill_shakes_with_its_mass() {
    // The multipliers of g are from a rigid-block linear programme with the columns' inertia, by another program.
    let under = |fill: Value| intensity(&arch(json!([fill, scaled(shaken(1.0, 0.0))])));
    close(under(fill()), 0.156843, 1e-6);
    close(under(fill_with("lateral_ratio", 0.5)), 0.221627, 1e-6);
    close(intensity(&arch(json!([scaled(shaken(1.0, 0.0))]))), 0.14534, 1e-5);
}

/// Columns of fill of this density up to `level` in vertical slices: masses at half their height, in an acceleration in g.
fn columns(ring: &Ring, level: f64, density: f64, acceleration: [f64; 2]) -> Vec<Push> {
    const SLICES: usize = 400;
    let slice = |block: usize, i: usize| {
        let (a, b) = (ring.joints[block].1, ring.joints[block + 1].1);
        let [x, y] = [0, 1].map(|c| a[c] + (b[c] - a[c]) * (i as f64 + 0.5) / SLICES as f64);
        let mass = density * (level - y) * (b[0] - a[0]) / SLICES as f64;
        Push { block, at: [x, 0.5 * (y + level)], force: acceleration.map(|a| 9.81 * mass * a) }
    };
    (0..ring.stones.len()).flat_map(|block| (0..SLICES).map(move |i| slice(block, i))).collect()
}

/// Both windows of an arch under fill that is shaken: the program's, and that of the oracle with its own geometry.
fn windows(dice: &mut Dice) -> [[f64; 2]; 2] {
    let (half, share, radius) = (dice.between(55.0, 90.0), dice.between(0.12, 0.25), dice.decades(1.0, 20.0));
    let (count, ratio, density) = (6 + dice.below(30), dice.between(0.0, 0.6), dice.between(1200.0, 2000.0));
    let level = radius * (1.0 + 0.5 * share + dice.between(0.0, 0.5));
    let acceleration = [dice.sign(), dice.between(-0.5, 0.5)];
    let springing = radius * half.to_radians().cos();
    let request = json!({
        "arch": {
            "profile": {"circular": {"radius_m": radius, "opening_angle_deg": 2.0 * half}},
            "thickness": {"constant_m": share * radius}, "voussoirs": count
        },
        "stone": {"friction_angle_deg": 60},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"fill_pressure": {
                "fill_height_m": level - springing, "fill_density_kg_m3": density, "lateral_ratio": ratio
            }}},
            scaled(shaken(acceleration[0], acceleration[1]))
        ]
    });
    let found = solved(&request)["limit_window"].clone();
    let ring = Ring::circular(half, share, count).times(radius);
    let weight = 2300.0 * 9.81;
    let fixed = [ring.weight(weight), ring.fill(level, density * 9.81, ratio)].concat();
    let scaled = [ring.body(weight, acceleration), columns(&ring, level, density, acceleration)].concat();
    let friction = 60f64.to_radians().tan();
    let (low, high) = Problem { fixed, scaled, ..ring.problem(friction) }.window().expect("stands");
    [[0, 1].map(|end| found[end].as_f64().unwrap()), [low, high]]
}

#[test]
fn shaken_fill_has_the_window_of_an_oracle_with_columns_of_its_own() {
    let mut worst = 0f64;
    for seed in 0..30 {
        let [ours, theirs] = windows(&mut Dice::new(seed));
        for (a, b) in ours.iter().zip(theirs) {
            worst = worst.max((a / b - 1.0).abs());
            assert!((a / b - 1.0).abs() < 1e-6, "seed {seed}: {ours:?}, oracle {theirs:?}");
        }
    }
    println!("worst {worst:.1e}");
}

#[test]
fn a_mesh_does_not_change_how_fill_shakes() {
    let mut request = arch(json!([fill(), scaled(shaken(1.0, 0.0))]));
    request["mesh"] = json!({"subblocks": {"uniform": {"radial": 2, "along": 3}}});
    close(intensity(&request), 0.156843, 1e-6);
}

#[test]
fn the_mass_of_fill_goes_with_its_coefficient_and_with_that_of_the_acceleration() {
    let inertia = |loads: Value| {
        let bare: Vec<Value> = loads.as_array().unwrap()[1..].to_vec();
        let whole = wrench(&analysis(&arch(loads.clone())).fixed);
        let pressed = wrench(&analysis(&arch(json!([loads[0]]))).fixed);
        let shaken = wrench(&analysis(&arch(json!(bare))).fixed);
        let weight = wrench(&analysis(&arch(json!([]))).fixed);
        [0, 1, 2].map(|i| whole[i] - pressed[i] - shaken[i] + weight[i])
    };
    let one = inertia(json!([fill(), shaken(0.1, 0.05)]));
    // 1,600 kg/m3 over the 27 chords of the extrados: near the closed form of the circle.
    let mass = 1600.0 * (2.0 * 11.5 * 10.75 - 0.5 * std::f64::consts::PI * 10.75f64.powi(2));
    close(one[0] / (0.1 * 9.81 * mass), 1.0, 0.01 + 0.01);
    close(one[1] / one[0], 0.5, 1e-9);
    let more = inertia(json!([
        with(fill(), json!({"coefficient": 3.0})),
        with(shaken(0.1, 0.05), json!({"coefficient": -2.0}))
    ]));
    (0..3).for_each(|i| close(more[i], -6.0 * one[i], 1e-9 * one[2].abs()));
}

#[test]
fn scaled_fill_is_scaled_in_a_fixed_acceleration() {
    let apart = |loads: Value| {
        let analysis = analysis(&arch(loads));
        [wrench(&analysis.fixed), wrench(&analysis.scaled)]
    };
    let [fixed, scaled_too] = apart(json!([scaled(fill()), shaken(0.1, 0.0)]));
    let [stones, _] = apart(json!([shaken(0.1, 0.0)]));
    let [_, pressed] = apart(json!([scaled(fill())]));
    (0..3).for_each(|i| close(fixed[i], stones[i], 1e-6));
    assert!(pressed[0].abs() < 1e-6 && scaled_too[0] > 1e5);
}

#[test]
fn scaled_fill_in_a_scaled_acceleration_is_refused() {
    let found = faults(&arch(json!([scaled(fill()), scaled(shaken(0.1, 0.0))])));
    let [(pointer, detail)] = &found[..] else { panic!("{found:?}") };
    assert_eq!(pointer, "/loads/2/scaled");
    assert!(detail.contains("/loads/1") && detail.contains("set scaled to false"), "{detail}");
}

#[test]
fn along_a_curve_the_mass_follows_the_abscissa() {
    let embankment = json!({
        "load": {"fill_pressure": {"embankment_thickness_m": 1.0}}, "scaled": true, "per_abscissa": true
    });
    let mut request = arch(json!([embankment, with(shaken(0.01, 0.0), json!({"per_abscissa": true}))]));
    request["analysis"] = json!({"safety": {"curve": {"abscissae": [1, 3], "unit": "m"}}});
    let (_, Question::Curve(points)) = read_question(request.to_string().as_bytes()).unwrap() else { panic!() };
    let sideways = |point: &CurvePoint| wrench(&point.analysis.scaled)[0];
    // Three times the mass in three times the acceleration.
    close(sideways(&points[1]) / sideways(&points[0]), 9.0, 1e-9);
    let curve = solved(&request);
    for point in curve["points"].as_array().unwrap() {
        assert!(point["notes"].to_string().contains("Fill has mass"), "{point}");
    }
    let text = text(&request);
    assert!(text.contains("1 m of embankment of 1600 kg/m3 on the extrados; no horizontal pressure"), "{text}");
}

#[test]
fn half_an_arch_carries_half_the_shaken_fill() {
    let mut request = arch(json!([fill(), shaken(0.0, -0.2)]));
    for voussoirs in [26, 27] {
        request["arch"]["voussoirs"] = json!(voussoirs);
        request["arch"]["half"] = json!(false);
        let whole = wrench(&analysis(&request).fixed);
        request["arch"]["half"] = json!(true);
        let half = wrench(&analysis(&request).fixed);
        close(half[1], 0.5 * whole[1], 1e-9 * whole[1].abs());
    }
    request["loads"][2] = shaken(0.1, 0.0);
    assert_eq!(faults(&request)[0].0, "/loads/2");
}

#[test]
fn fill_does_not_press_sideways_unless_asked() {
    let forces = |fill: Value| analysis(&arch(json!([fill]))).fixed;
    let left = |forces: &[PointForce]| {
        let left = forces.iter().filter(|force| force.body < 13);
        left.map(|force| force.force).sum::<Vec2>()
    };
    assert_eq!(forces(fill()), forces(fill_with("lateral_ratio", 0.0)));
    close(left(&forces(fill())).x, 0.0, 1e-9);
    assert!(left(&forces(fill_with("lateral_ratio", 0.5))).x > 1e5);
    // Eq. (7) of the paper: K = 1 - sin phi.
    let angle = 20.0f64;
    let at_rest = fill_with("lateral_ratio", 1.0 - angle.to_radians().sin());
    assert_eq!(forces(fill_with("fill_friction_angle_deg", angle)), forces(at_rest));
}

#[test]
fn a_ratio_that_is_not_that_of_its_angle_is_refused() {
    let mut load = fill_with("lateral_ratio", 0.3);
    load["load"]["fill_pressure"]["fill_friction_angle_deg"] = json!(30);
    let found = faults(&arch(json!([load])));
    let [(pointer, detail)] = &found[..] else { panic!("{found:?}") };
    assert_eq!(pointer, "/loads/1/load/fill_pressure/lateral_ratio");
    assert!(detail.contains("0.3 ") && detail.contains("leave out one of the two"), "{detail}");
    load["load"]["fill_pressure"]["lateral_ratio"] = json!(0.5);
    analysis(&arch(json!([load])));
}

#[test]
fn the_answer_echoes_the_ratio_that_was_used() {
    let echo = |load: Value| {
        let request = read(arch(json!([load])).to_string().as_bytes()).unwrap();
        let echo = serde_json::to_value(&request).unwrap();
        assert_eq!(read(echo.to_string().as_bytes()).unwrap(), request);
        echo["loads"][1]["load"]["fill_pressure"].clone()
    };
    assert_eq!(echo(fill())["lateral_ratio"], json!(0.0));
    assert_eq!(echo(fill_with("lateral_ratio", 0.7))["lateral_ratio"], json!(0.7));
    let asked = echo(fill_with("fill_friction_angle_deg", 30.0));
    close(asked["lateral_ratio"].as_f64().unwrap(), 0.5, 1e-12);
    assert_eq!(asked["fill_friction_angle_deg"], json!(30.0));
}

#[test]
fn the_summary_says_what_is_assumed_of_fill() {
    let words = |load: Value| text(&arch(json!([load])));
    let bare = words(fill());
    assert!(bare.contains("fill of 1600 kg/m3 up to y = 11.5 m; no horizontal pressure"), "{bare}");
    assert!(!bare.contains("Fill has mass"), "{bare}");
    let given = words(fill_with("lateral_ratio", 0.4));
    assert!(given.contains("; horizontal pressure 0.4 of the vertical (as given)"), "{given}");
    let at_rest = words(fill_with("fill_friction_angle_deg", 30.0));
    assert!(at_rest.contains("; horizontal pressure 0.5 of the vertical (at rest, 1 - sin 30 deg)"), "{at_rest}");
    let both = words(fill_with("embankment_thickness_m", 2.0));
    assert!(both.contains("up to y = 11.5 m and 2 m of embankment of 1600 kg/m3; no"), "{both}");
    // Listed last of many, and shaken.
    let points: Vec<Value> =
        (0..9).map(|k| json!({"load": {"point_load": {"force_n_per_m": 1, "voussoir": k}}})).collect();
    let mut all = arch(json!(points));
    all["loads"].as_array_mut().unwrap().extend([fill(), shaken(0.01, 0.0)]);
    let all = text(&all);
    assert!(all.contains("fill of 1600 kg/m3") && all.contains("Note: Fill has mass"), "{all}");
}
