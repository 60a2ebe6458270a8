//! Partial factors: the answer is that of loads and resistances multiplied and divided by hand.

use crate::common::answered::{end, solved, text};
use crate::common::door;
use crate::common::folders;
use crate::contract::bodies::with;
use crate::dispersal::{close, found};
use serde_json::{Value, json};
use voussoir::collapse::Analysis;
use voussoir::geometry::Vec2;
use voussoir::structure::{PointForce, resultants};
use voussoir::wire::fault::Fault;
use voussoir::wire::read::read_question;

const DEAD: f64 = 1.2;
const FILL: f64 = 1.35;
const LIVE: f64 = 1.9;
const STRENGTH: f64 = 2.1;
const SOIL: f64 = 1.6;
/// Factors multiplied in another order.
const ROUNDING: f64 = 1e-13;

/// The bridge of a case, with an embankment on its road, a block on its extrados, and a strip on the road that grows.
fn bridge() -> Value {
    let file = folders::cases().join("resisting-backfill/request.json");
    let mut request: Value = serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap();
    request["stones"] = json!([{"name": "brick", "compressive_strength_pa": 3e6}]);
    request["arch"]["stone_of"] = json!([{"from": 10, "to": 20, "stone": "brick"}]);
    request["backfill"]["backing"] = json!({"height_m": 0.9, "density_kg_m3": 2200, "resistance_pa": 2e5});
    request["backfill"]["passive"]["cohesion_pa"] = json!(4000);
    request["backfill"]["passive"]["cohesion_factor"] = json!(0.8);
    let strip = json!({"centre_x_m": -1.6375, "width_m": 0.3, "force_n_per_m": 1000, "dispersal": {}});
    request["loads"] = json!([
        {"load": {"self_weight": {}}, "coefficient": 1.1},
        {"load": {"fill_pressure": {"embankment_thickness_m": 0.2, "lateral_ratio": 0.3}}},
        {"load": {"point_load": {"force_n_per_m": 800, "x_m": 1, "inclination_deg": 10}}},
        {"load": {"patch_load": strip}, "scaled": true},
        {"load": {"lateral_pressure": {"bands": [{"from_m": 0.2, "to_m": 0.9, "pressure_pa": 30}]}}, "scaled": true}
    ]);
    request
}

fn factored(request: Value) -> Value {
    let factors =
        json!({"dead": DEAD, "fill": FILL, "live": LIVE, "stone_strength": STRENGTH, "soil_resistance": SOIL});
    with(request, "/partial_factors", factors)
}

/// The same with the numbers multiplied and divided by hand.
fn by_hand(mut request: Value) -> Value {
    let mut times = |pointer: &str, factor: f64| {
        let value = request.pointer_mut(pointer).unwrap_or_else(|| panic!("no {pointer}"));
        *value = json!(factor * value.as_f64().unwrap());
    };
    times("/loads/0/coefficient", DEAD);
    times("/backfill/density_kg_m3", FILL);
    times("/backfill/backing/density_kg_m3", FILL);
    times("/loads/3/load/patch_load/force_n_per_m", LIVE);
    times("/loads/4/load/lateral_pressure/bands/0/pressure_pa", LIVE);
    times("/stone/compressive_strength_pa", 1.0 / STRENGTH);
    times("/stones/0/compressive_strength_pa", 1.0 / STRENGTH);
    // What fill of unfactored weight resists with.
    times("/backfill/passive/factor", 1.0 / (FILL * SOIL));
    times("/backfill/passive/cohesion_factor", 1.0 / SOIL);
    times("/backfill/backing/resistance_pa", 1.0 / SOIL);
    request["loads"][1]["coefficient"] = json!(FILL);
    request
}

/// Resultants on every body are the same but for rounding.
fn same(a: &[PointForce], b: &[PointForce], bodies: usize) {
    let [a, b] = [a, b].map(|forces| resultants(bodies, forces, Vec2::zeros()));
    let size = a.iter().flatten().fold(0.0f64, |most, x| most.max(x.abs()));
    assert!(size > 0.0);
    for (k, (a, b)) in a.iter().zip(&b).enumerate() {
        assert!((0..3).all(|i| (a[i] - b[i]).abs() <= ROUNDING * size), "{k}: {a:?}, {b:?}");
    }
}

#[test]
fn factored_is_multiplied_and_divided_by_hand() {
    let [factors, hand] = [factored(bridge()), by_hand(bridge())];
    let [a, b] = [&factors, &hand].map(|request| door::analysis(request).unwrap());
    let bodies = a.structure.bodies.len();
    same(&a.fixed, &b.fixed, bodies);
    same(&a.scaled, &b.scaled, bodies);
    let [of_a, of_b] = [&a, &b].map(|analysis| analysis.structure.passive.clone());
    assert!(of_a.len() == of_b.len() && of_a.len() > 20);
    for (a, b) in of_a.iter().zip(&of_b) {
        assert!((a.most / b.most - 1.0).abs() < ROUNDING && (a.at, a.body) == (b.at, b.body), "{a:?}, {b:?}");
    }
    assert_eq!(a.structure.strengths().len(), bodies);
    for (a, b) in a.structure.strengths().iter().zip(b.structure.strengths()) {
        assert!((a / b - 1.0).abs() < ROUNDING);
    }
    // Load factors are of the loads as given: of those by hand they are the same, though an intensity there is `LIVE` times as much.
    let [ours, theirs] = [&factors, &hand].map(found);
    close([ours[0], theirs[0]], 1e-10, "instability");
    close([ours[1], theirs[1]], 1e-10, "crushing");
    let plain = found(&bridge());
    println!("without factors {plain:?}");
    assert!(ours[0] < 0.9 * plain[0] && ours[1] < 0.9 * plain[1]);
}

#[test]
fn each_factor_acts_on_its_own_and_once() {
    let only = |name: &str, factor: f64| {
        let request = with(bridge(), "/partial_factors", json!({name: factor}));
        found(&request)
    };
    // Twice the live load is borne half as often; that of all ones is what there was.
    let plain = found(&bridge());
    assert_eq!(only("live", 1.0), plain);
    close([only("live", 2.0)[0], 0.5 * plain[0]], 1e-10, "live");
    close([only("live", 2.0)[1], 0.5 * plain[1]], 1e-10, "live, crushing");
    let strong = only("stone_strength", 3.0);
    assert!(strong[0] == plain[0] && strong[1] < 0.95 * plain[1], "{strong:?}");
    assert!(only("soil_resistance", 2.0)[0] < 0.95 * plain[0]);
}

#[test]
fn least_pressure_of_soil_is_a_load_and_the_most_a_resistance() {
    let with_least = |least: &str, factors: Value| {
        let request = with(with(bridge(), "/backfill/passive/least", json!(least)), "/partial_factors", factors);
        let request = with(request, "/backfill/backing/resistance_pa", json!(1e6));
        door::analysis(&request).unwrap()
    };
    let [none, active] = ["none", "active"].map(|least| with_least(least, json!({})));
    let factored = with_least("active", json!({"fill": 1.2, "soil_resistance": 1.3}));
    let most = |analysis: &Analysis| analysis.structure.passive.iter().map(|element| element.most).collect::<Vec<_>>();
    let [none, active, factored] = [most(&none), most(&active), most(&factored)];
    assert!(none.len() == active.len() && active.len() == factored.len());
    for ((none, active), factored) in none.iter().zip(&active).zip(&factored) {
        let expected = none / 1.3 - 1.2 * (none - active);
        assert!((factored - expected).abs() <= 1e-12 * none, "{factored}, {expected}");
    }
}

#[test]
fn masses_in_an_acceleration_have_no_factor() {
    let shaken = |scaled: bool, fill_scaled: bool, factors: Value| {
        let mut request = with(bridge(), "/partial_factors", factors);
        let loads = request["loads"].as_array_mut().unwrap();
        loads.truncate(3);
        loads[1]["scaled"] = json!(fill_scaled);
        loads.push(json!({"load": {"body_acceleration": {"x_g": 0.3, "y_g": 0.1}}, "scaled": scaled}));
        door::analysis(&request).unwrap()
    };
    let horizontal = |forces: &[PointForce]| forces.iter().map(|force| force.force.x).sum::<f64>();
    // As a scaled load it has that of scaled loads, and fixed none; beside it at rest are 0.3 of the embankment either way.
    for (scaled, fill_scaled) in [(true, false), (false, false), (false, true)] {
        let factors = json!({"dead": DEAD, "live": if scaled || fill_scaled { LIVE } else { 1.0 }});
        let [plain, factored] = [json!({}), factors].map(|factors| shaken(scaled, fill_scaled, factors));
        close([horizontal(&factored.fixed), horizontal(&plain.fixed)], 1e-12, "fixed");
        if scaled || fill_scaled {
            close([horizontal(&factored.scaled), LIVE * horizontal(&plain.scaled)], 1e-12, "scaled");
        }
    }
    let plain = shaken(true, false, json!({}));
    let heavy = shaken(true, false, json!({"dead": DEAD, "fill": FILL}));
    same(&plain.scaled, &heavy.scaled, plain.structure.bodies.len());
}

#[test]
fn half_an_arch_has_the_factors_of_the_whole() {
    let mut whole = factored(bridge());
    whole["arch"]["stone_of"] = json!([{"from": 20, "to": 39, "stone": "brick"}]);
    whole["loads"] = json!([
        {"load": {"self_weight": {}}},
        {"load": {"patch_load": {"centre_x_m": 0, "width_m": 0.3, "force_n_per_m": 1000, "dispersal": {}}}, "scaled": true}
    ]);
    let half = with(whole.clone(), "/arch/half", json!(true));
    let [whole, half] = [&whole, &half].map(found);
    close([half[0], whole[0]], 1e-6, "half");
    close([half[1], whole[1]], 1e-6, "half, crushing");
}

#[test]
fn only_with_factors_an_end_has_an_adequacy_factor() {
    let plain = solved(&bridge());
    assert!(end(&plain, "highest").get("adequacy_factor").is_none());
    assert!(!text(&bridge()).to_lowercase().contains("adequacy"), "{}", text(&bridge()));
    // For people in MN of an axle of 200 kN: the intensity is that of the load as given.
    let mut request = factored(bridge());
    request["loads"][3]["load"]["patch_load"]["force_n_per_m"] = json!(20000);
    request["loads"].as_array_mut().unwrap().pop();
    request["load_factor"] = json!({"unit": "kN", "intensity_per_unit": 200});
    request["width_m"] = json!(10);
    let answer = solved(&request);
    let highest = end(&answer, "highest");
    let factor = highest["load_factor"].as_f64().unwrap();
    assert_eq!(highest["adequacy_factor"], highest["load_factor"]);
    close([highest["intensity"].as_f64().unwrap(), 200.0 * factor], 1e-15, "intensity");
    let arrives = -door::analysis(&request).unwrap().scaled.iter().map(|force| force.force.y).sum::<f64>() / 1e3;
    close([arrives, LIVE * 20.0], 1e-2, "nearly all of it comes down on the arch");
    close([highest["scaled_load"]["y_kn"].as_f64().unwrap(), -factor * arrives * 10.0], 1e-12, "over the width");
    let words = text(&request);
    for part in [
        &format!("With partial factors its adequacy factor is {}.", voussoir::wire::prose::Rounded(factor)),
        "(1 and more is enough)",
        "partial factor 1.2 times: 1.1 times: self weight",
        "partial factor 1.35 times: 0.2 m of embankment",
        "partial factor 1.35 times: backfill of 2040 kg/m3",
        "its resistance is divided by the partial factor 1.6",
        "partial factor 1.9 times: 20 kN/m, spread",
        "4.5 MPa / 2.1; brick: 3 MPa / 2.1",
        "; factored scaled loads at collapse",
        "dead 1.2, fill 1.35, live 1.9; stone strength over 2.1, soil resistance over 1.6",
        "at load factor 1 the arch bears 1.9 times them. Fixed loads that are neither self weight nor fill have no factor.",
    ] {
        assert!(words.contains(part), "{part}: {words}");
    }
}

/// Weight holds an arch back that a load brings down, and brings down one that is shaken less than it bears: the note says which
/// factors are on the unsafe side, and they are.
#[test]
fn factors_on_weight_that_help_are_told() {
    let arch = |scaled: Value, dead: f64| {
        json!({
            "arch": {"profile": {"circular": {"radius_m": 5, "opening_angle_deg": 180}}, "thickness": {"constant_m": 0.8}, "voussoirs": 15},
            "stone": {"friction_angle_deg": 40, "compressive_strength_pa": 1e30},
            "loads": [{"load": {"self_weight": {}}}, {"load": scaled, "scaled": true}],
            "partial_factors": {"dead": dead}
        })
    };
    let load = json!({"point_load": {"force_n_per_m": 1000, "x_m": -2}});
    let told = |answer: &Value| answer["notes"].to_string().contains("fixed loads as a whole hold it back");
    let [plain, more, less] = [1.0, 1.2, 0.9].map(|dead| solved(&arch(load.clone(), dead)));
    let at = |answer: &Value| end(answer, "highest")["load_factor"].as_f64().unwrap();
    close([at(&more), 1.2 * at(&plain)], 1e-9, "weight times 1.2");
    close([at(&less), 0.9 * at(&plain)], 1e-9, "weight times 0.9");
    assert!(told(&more) && !told(&plain) && !told(&less), "{} {}", more["notes"], less["notes"]);
    // Lifted off instead.
    let lift = json!({"point_load": {"force_n_per_m": -1000, "x_m": 0}});
    assert!(told(&solved(&arch(lift, 1.35))));
}

#[test]
fn an_adequacy_factor_is_never_more_than_what_else_was_found() {
    // In a safety analysis it is what governs there.
    let safety = |crushing: &str| {
        let mut request = with(factored(bridge()), "/analysis", json!({"safety": {"crushing": crushing}}));
        request["loads"][3]["load"]["patch_load"]["force_n_per_m"] = json!(3000);
        request["mesh"] = json!({"subblocks": {"uniform": {"radial": 4, "along": 2}}});
        let answer = solved(&request);
        let found = &end(&answer, "highest")["adequacy_factor"];
        assert_eq!(*found, answer["safety"]["governing"]["load_factor"]);
        found.as_f64().unwrap()
    };
    let [plastic, elastic] = ["plastic_section", "elastic"].map(safety);
    println!("{plastic}, {elastic}");
    assert!(elastic < plastic);
    // On moving geometry the lower of the two.
    let mut soft = with(factored(bridge()), "/geometry", json!("updated"));
    soft["stone"]["compressive_strength_pa"] = json!(1e30);
    soft["stones"][0]["compressive_strength_pa"] = json!(1e30);
    let answer = solved(&soft);
    let highest = end(&answer, "highest");
    let moving = answer["updated_geometry"]["load_factor"].as_f64().unwrap();
    assert!(moving < highest["load_factor"].as_f64().unwrap());
    assert_eq!(highest["adequacy_factor"].as_f64().unwrap(), moving);
    // What needs its live load to stand has none.
    let file = folders::cases().join("paper/table-4/request.json");
    let window: Value = serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap();
    let window = with(window, "/partial_factors", json!({"dead": 1.0}));
    let answer = solved(&window);
    assert_eq!((answer["outcome"].as_str(), answer["ends"].as_array().unwrap().len()), (Some("stands_in_window"), 2));
    assert!(answer["ends"].as_array().unwrap().iter().all(|end| end.get("adequacy_factor").is_none()));
    assert!(text(&window).contains("That is with partial factors."));
}

#[test]
fn factors_that_act_on_nothing_are_refused() {
    let refused = |request: &Value, pointer: &str, remedy: &str| {
        let found: Vec<Fault> = read_question(request.to_string().as_bytes()).err().unwrap_or_default();
        assert!(found.len() == 1 && found[0].pointer == pointer, "{pointer}: {found:?}");
        assert!(found[0].detail.contains(remedy), "{pointer}: {found:?}");
    };
    let bare = |name: &str, value: f64| {
        let mut request = with(bridge(), "/partial_factors", json!({name: value}));
        request.as_object_mut().unwrap().remove("backfill");
        request["loads"] = json!([{"load": {"point_load": {"x_m": 0, "force_n_per_m": 1}}}]);
        request
    };
    for name in ["dead", "fill", "live", "soil_resistance"] {
        let here = format!("/partial_factors/{name}");
        refused(&bare(name, 1.3), &here, "for this to act on: leave it out");
        assert!(read_question(bare(name, 1.0).to_string().as_bytes()).is_ok());
        refused(&with(factored(bridge()), &here, json!(0)), &here, "from 0.01 to 100");
    }
    let down = with(factored(bridge()), "/load_factor/direction", json!("decrease"));
    refused(&down, "/load_factor/direction", "set direction to `increase`");
    let steps = with(factored(bridge()), "/method", json!({"fixed_steps": {"step": 1.0}}));
    refused(&steps, "/method", "set method to `event_path`");
}

#[test]
fn the_worst_position_is_that_of_factored_loads() {
    let file = folders::cases().join("worst-position/request.json");
    let request: Value = serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap();
    let [plain, factored] =
        [json!({}), json!({"live": 2.0})].map(|factors| solved(&with(request.clone(), "/partial_factors", factors)));
    let worst = |answer: &Value, field: &str| answer["worst_position"][field].as_f64().unwrap();
    close([worst(&factored, "x_m"), worst(&plain, "x_m")], 1e-9, "where");
    close([2.0 * worst(&factored, "load_factor"), worst(&plain, "load_factor")], 1e-9, "load factor");
    let highest = |answer: &Value, field: &str| end(answer, "highest")[field].as_f64().unwrap();
    close([2.0 * highest(&factored, "adequacy_factor"), highest(&plain, "load_factor")], 1e-9, "adequacy factor");
}
