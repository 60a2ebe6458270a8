//! Figs. 10 and 13: safety factors of the oval over the embankment and over the load on its crown.

use super::sheet::{close, expected, factor, number, request, solve, updated_geometry};
use serde_json::{Value, json};

/// Largest factor up to which the paper's own sign of collapse is looked for, and how often the search is halved.
const MOST: f64 = 30.0;
const HALVINGS: usize = 10;

/// The single analysis of a curve's request at one abscissa.
fn at(curve: &Value, abscissa: f64) -> Value {
    let mut request = curve.clone();
    request["analysis"]["safety"].as_object_mut().unwrap().remove("curve");
    for load in request["loads"].as_array_mut().unwrap() {
        if load.as_object_mut().unwrap().remove("per_abscissa").is_some() {
            load["coefficient"] = json!(abscissa * load["coefficient"].as_f64().unwrap_or(1.0));
        }
    }
    request
}

/// Whether three joints are open by 0.01 m, the paper's sign of collapse, under `factor` times the scaled loads.
fn is_open(request: &Value, factor: f64) -> bool {
    let mut request = request.clone();
    request["analysis"] = json!("collapse");
    for load in request["loads"].as_array_mut().unwrap().iter_mut().filter(|load| load["scaled"] == true) {
        load["coefficient"] = json!(factor * load["coefficient"].as_f64().unwrap_or(1.0));
    }
    let answer = solve(&request);
    let Some(gaps) = answer["at_unit_load"]["contacts"]["gap_m"].as_array() else { return true };
    let joints = answer["at_unit_load"]["contacts"]["joint"].as_array().unwrap();
    let open = gaps.iter().zip(joints).filter(|(gap, _)| gap.as_f64().unwrap() > 0.01).map(|(_, joint)| joint.as_u64());
    open.collect::<std::collections::BTreeSet<_>>().len() >= 3
}

/// The factor at which they are; it depends on Young's modulus.
fn opened(request: &Value) -> String {
    match (is_open(request, 1.0), is_open(request, MOST)) {
        (true, _) => "< 1".to_owned(),
        (_, false) => format!("> {MOST}"),
        _ => {
            let (mut closed, mut open) = (1.0, MOST);
            for _ in 0..HALVINGS {
                let middle = f64::sqrt(closed * open);
                *if is_open(request, middle) { &mut open } else { &mut closed } = middle;
            }
            format!("{open:.2}")
        }
    }
}

/// Zone by the paper's rule: the first of instability and of first yield, whatever the plastic sections say.
fn zone(point: &Value) -> &'static str {
    let reach = |name: &str| match point[name]["state"].as_str() {
        Some("at") => number(&point[name], "/load_factor"),
        Some("does_not_stand") => 0.0,
        _ => f64::INFINITY,
    };
    match (reach("instability") <= reach("elastic"), point["mode"].as_str()) {
        (false, _) => "II",
        (true, Some("crown_rises")) => "I",
        (true, Some("crown_descends")) => "III",
        _ => "-",
    }
}

/// Prints a curve and holds it against limit analysis and the cone programme.
fn compare(case: &str, printed: impl Fn(f64) -> &'static str) -> Vec<(f64, &'static str)> {
    let (request, expected) = (request(case), expected(case));
    println!(
        "{:>7} {:>22} {:>16} {:>12} {:>22} {:>16} {:>8} {:>5} {:>9}  printed",
        "", "instability, limit an.", "ours", "first yield", "plastic, cone prog.", "ours", "opened", "zone", "updated"
    );
    let answer = solve(&request);
    let mut zones = Vec::new();
    for point in answer["points"].as_array().unwrap() {
        let abscissa = number(point, "/abscissa");
        let other = expected["points"].as_array().unwrap().iter().find(|p| p["abscissa"] == point["abscissa"]);
        let other = other.cloned().unwrap_or_default();
        for name in ["instability", "plastic_section"] {
            if let Some(number_there) = other[name].as_f64() {
                let found = number(&point[name], "/load_factor");
                close(&format!("{case}, {name} at {abscissa}"), found, number_there, 5e-4 * number_there);
            }
        }
        let [a, b, c] = ["instability", "elastic", "plastic_section"].map(|name| factor(&point[name]));
        println!(
            "{abscissa:>7} {:>22} {a:>16} {b:>12} {:>22} {c:>16} {:>8} {:>5} {:>9}  {}",
            factor(&other["instability"]),
            factor(&other["plastic_section"]),
            if other.is_null() { String::new() } else { opened(&at(&request, abscissa)) },
            zone(point),
            updated_geometry(&at(&request, abscissa)),
            printed(abscissa)
        );
        zones.push((abscissa, zone(point)));
    }
    zones
}

#[test]
fn figure_10_safety_over_the_embankment() {
    println!("Fig. 10, safety factor over the embankment's thickness h_e in m; geometry ESTIMATED");
    let printed = |h: f64| match h {
        0.32 => "lower limit measured, factor 1",
        0.5 => "lower limit of the paper's own computation",
        0.9 => "end of zone I",
        1.9 => "best of zone II",
        2.0 => "3.8, crushing (II)",
        11.75 => "11.9: upper limit measured",
        12.0 => "upper limit of the paper's own computation",
        _ => "",
    };
    println!("embankment of 1760 kg/m3");
    let thin = compare("figure-10/thin-embankment", printed);
    println!("embankment of 1600 kg/m3");
    let thick = compare("figure-10/thick-embankment", printed);
    // Where the paper's zone I certainly is, and where its upper limit is passed.
    assert!(thin.iter().filter(|(h, _)| *h <= 0.9).all(|(_, zone)| *zone == "I"));
    assert!(thin.iter().filter(|(h, _)| *h >= 1.4).all(|(_, zone)| *zone == "II"));
    assert_eq!(thick.last().unwrap(), &(12.0, "III"));
}

#[test]
fn figure_13_safety_over_the_crown_load() {
    println!("Fig. 13, safety factor over the load on the crown in kN; geometry ESTIMATED");
    let printed = |q: f64| match q {
        3.0 => "2.5: lower limit of the paper's own computation",
        150.0 => "above, the paper's own computation diverges from the experiment",
        200.0 => "225: upper limit of the paper's own computation",
        _ => "",
    };
    let zones = compare("figure-13", printed);
    assert_eq!(zones.first().unwrap().1, "I");
}
