//! Case 1, the buried arch under two jacks: Table 2 and Fig. 8.

use super::sheet::{alternate, close, degrees, expected, left_hinges, number, request, solve};
use crate::common::answered;
use serde_json::{Value, json};

/// Joints; critical intensity in kN/m of the experiment and of the paper's own computation.
const TABLE_2: [(usize, &str, &str); 5] =
    [(9, "250", "280"), (17, "206", "210"), (27, "206", "205"), (61, "205", "205"), (201, "-", "-")];

/// The paper's stepping: 5 kN/m from zero until joints open by 0.01 m; its E and penalty are the defaults.
fn stepped(request: &Value) -> f64 {
    let mut request = request.clone();
    request["method"] = json!({"fixed_steps": {"step": 5.0, "opening_m": 0.01, "hinges": 3}});
    number(&solve(&request), "/ends/0/instability/intensity")
}

/// Abscissae of the extrados ends of the joints, from left to right, m.
fn abscissae(answer: &Value, joints: usize) -> Vec<f64> {
    let arch = &answer["request"]["arch"];
    let (radius, y) =
        (number(arch, "/thickness/extrados_circle/radius_m"), number(arch, "/thickness/extrados_circle/centre_y_m"));
    let along = |k: usize| {
        let (sin, cos) = (std::f64::consts::PI * (1.0 - k as f64 / (joints - 1) as f64)).sin_cos();
        (sin * y + (sin * sin * y * y - y * y + radius * radius).sqrt()) * cos
    };
    (0..joints).map(along).collect()
}

/// The same arch with every voussoir's share of the jacks in the middle of its extrados, whatever part of it they cover.
fn lumped(request: &Value, ends: &[f64]) -> f64 {
    let mut request = request.clone();
    let loads = request["loads"].as_array_mut().unwrap();
    loads.retain(|load| load["scaled"] != true);
    for (k, side) in ends.windows(2).enumerate() {
        let under = |jack: f64| (side[1].min(jack + 0.75) - side[0].max(jack - 0.75)).max(0.0);
        let force = 1675.0 * (under(-1.5) + under(1.5)) / 1.5;
        if force > 1e-9 {
            loads.push(json!({"load": {"point_load": {"force_n_per_m": force, "voussoir": k}}, "scaled": true}));
        }
    }
    number(&solve(&request), "/ends/0/instability/intensity")
}

#[test]
fn table_2_critical_intensity_against_joints() {
    println!("Table 2, critical intensity q0 in kN/m; geometry ESTIMATED (fitted to the experiment by limit analysis)");
    println!(
        "{:>7} {:>11} {:>10} {:>15} {:>10} {:>12} {:>13}",
        "joints", "experiment", "paper DDA", "limit analysis", "ours", "in 5 kN/m", "jacks lumped"
    );
    for (joints, experiment, dda) in TABLE_2 {
        let case = format!("table-2/{joints}-joints");
        let request = request(&case);
        let answer = solve(&request);
        let limit = number(&expected(&case), "/intensity");
        let (ours, steps) = (number(&answer, "/ends/0/instability/intensity"), stepped(&request));
        let lumped = lumped(&request, &abscissae(&answer, joints));
        println!("{joints:>7} {experiment:>11} {dda:>10} {limit:>15.2} {ours:>10.4} {steps:>12.0} {lumped:>13.2}");
        close(&case, ours, limit, 0.006);
        // The peak comes before any joint opens by 0.01 m.
        assert_eq!(steps, 5.0 * (ours / 5.0).floor() + 5.0, "{case}");
    }
    println!("in 5 kN/m: the paper's stepping. jacks lumped: in the middle of each stone's extrados.");
}

#[test]
fn table_2_hinges_alternate() {
    println!("Case 1, hinges of the left half: angle from the springing in degrees");
    for (joints, ..) in TABLE_2 {
        let hinges = left_hinges(answered::uncrushed(&solve(&request(&format!("table-2/{joints}-joints")))["ends"][0]));
        let faces: Vec<&str> = hinges.iter().map(|(_, face)| face.as_str()).collect();
        println!("{joints:>7} {:>24}   open at the {}", degrees(&hinges), faces.join(", "));
        // Close to the abutments, close to the peak and between, as the text says.
        assert!(hinges.len() == 3 && alternate(&hinges) && hinges[0].0 < 1e-6 && hinges[2].0 > 75.0);
    }
}

#[test]
fn figure_8_the_half_model() {
    let (half, whole) = (solve(&request("figure-8")), solve(&request("table-2/61-joints")));
    let [a, b] = [&half, &whole].map(|answer| number(answer, "/ends/0/instability/intensity"));
    println!("Fig. 8, 61 joints: {a:.6} kN/m of the half against a smooth wall, {b:.6} kN/m of the whole, printed 205");
    close("half and whole", a, b, 1e-6 * b);
    close("limit analysis", a, number(&expected("figure-8"), "/intensity"), 0.006);
    let [half, whole] = [&half, &whole].map(|answer| left_hinges(answered::uncrushed(&answer["ends"][0])));
    assert_eq!(half, whole);
}
