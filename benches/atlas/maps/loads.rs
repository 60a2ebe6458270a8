//! Maps over the loads: at the window's ends, symmetric, next to never collapsing, weightless, in any unit.

use super::{Map, ask, axis, decades, frictions, load, semicircle};
use crate::common::door;
use serde_json::{Value, json};

/// Distances from a limit, as exponents of ten: from the one side, then from the other.
fn nearness() -> Vec<f64> {
    let far: Vec<f64> = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0].to_vec();
    far.iter().map(|k| -k).chain(far.iter().rev().copied()).collect()
}

/// 1 - 10^-1 for -1 up to 1 - 10^-9, and from 1 + 10^-9 for 9 to 1 + 10^-1 for 1.
fn next_to_one(near: f64) -> f64 {
    1.0 + near.signum() * 10f64.powf(-near.abs())
}

/// A fixed load of so many times its greatest value: does the arch stand?
pub fn window() -> Map {
    let places = [-9.5, -8.0, -6.0, -5.0, -3.0, -1.0, 0.0, 2.0, 5.0, 8.0];
    let axes = [axis("k: load = limit (1 -+ 10^-k)", nearness()), axis("place of the load, m", places)];
    let limits: Vec<[f64; 2]> = places.iter().map(|&x| ends(&on(x, 1e4))).collect();
    let title = "fixed loads at the window's ends, 21 stones, t/R 0.15";
    let mut map = Map::of("window", title, axes, &["down", "up"], |near, x, variant| {
        let place = places.iter().position(|place| *place == x)?;
        let limit = limits[place][usize::from(variant == "down")];
        let mut request = on(x, 1e4 * limit * next_to_one(near));
        request["loads"][1]["scaled"] = json!(false);
        limit.is_finite().then_some(request)
    });
    map.scenes.iter_mut().for_each(|scene| scene.stands = Some(map.axes[0].values[scene.at[0]] < 0.0));
    map
}

/// The arch of `window` under its weight and a scaled load at an abscissa.
fn on(x: f64, force: f64) -> Value {
    let load = json!({"point_load": {"force_n_per_m": force, "x_m": x}});
    ask(semicircle(21, 0.15), 75.0, Some(load), true)
}

/// Limit window by the oracle.
fn ends(request: &Value) -> [f64; 2] {
    let (low, high) = door::problem(&door::analysis(request).expect("an arch")).window().expect("stands");
    [low, high]
}

/// Symmetric arches under symmetric loads: everything happens twice.
pub fn ties() -> Map {
    let numbers = [4.0, 5.0, 8.0, 9.0, 16.0, 17.0, 32.0, 33.0, 64.0, 65.0];
    let axes = [axis("number of stones", numbers), axis("friction angle, degrees", frictions())];
    let title = "symmetric loads, t/R 0.15";
    Map::of("ties", title, axes, &["crown", "pair", "fill"], |number, friction, variant| {
        let number = number as usize;
        let point = |x: f64| json!({"point_load": {"force_n_per_m": 1e4, "x_m": x}});
        let first = match variant {
            "crown" => point(0.0),
            "pair" => point(5.0),
            _ => json!({"fill_pressure": {"fill_height_m": 12.0, "lateral_ratio": 0.5}}),
        };
        let mut request = ask(semicircle(number, 0.15), friction, Some(first), true);
        if variant == "pair" {
            let other = json!({"load": point(-5.0), "scaled": true});
            request["loads"].as_array_mut().expect("a list").push(other);
        }
        Some(request)
    })
}

/// Accelerations that lean from the vertical so little that the arch never falls, or hardly ever.
pub fn never() -> Map {
    let thicknesses = [0.12, 0.13, 0.15, 0.18, 0.22, 0.3];
    let axes =
        [axis("k: tangent of the lean = limit (1 -+ 10^-k)", nearness()), axis("thickness over radius", thicknesses)];
    let title = "next to never collapsing: leaning acceleration, 15 stones";
    let lean = |ratio: f64, friction: f64| {
        // An arch whose weight leans by tan a stands as long as tan a is no more than its lateral limit.
        let request = ask(semicircle(15, ratio), friction, Some(json!({"body_acceleration": {"x_g": 1.0}})), true);
        ends(&request)[1]
    };
    Map::of("never", title, axes, &["rough", "mason's"], |near, ratio, variant| {
        let friction = if variant == "rough" { 75.0 } else { 35.0 };
        let x = lean(ratio, friction) * next_to_one(near);
        let load = json!({"body_acceleration": {"x_g": x, "y_g": -1.0}});
        Some(ask(semicircle(15, ratio), friction, Some(load), true))
    })
}

/// Lengths from millimetres to kilometres, and stone from rubber to diamond; with and without weight.
pub fn units() -> Map {
    let lengths = [1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1000.0];
    let axes = [axis("span, m", lengths), axis("Young's modulus, Pa", decades(5, 13, 1))];
    let title = "from 1 mm to 1 km, 15 stones, thickness 0.075 of the span";
    let variants = ["weight", "weightless, haunch", "weightless, lateral", "weight, light load"];
    Map::of("units", title, axes, &variants, |span, modulus, variant| {
        let mut arch = semicircle(15, 0.15);
        // The line of a force alone is straight: a flat arch holds it, a semicircle does not.
        let rise = if variant == "weightless, haunch" { 0.05 } else { 0.5 };
        arch["profile"] = json!({"circular": {"span_m": span, "rise_m": rise * span}});
        arch["thickness"] = json!({"constant_m": 0.075 * span});
        let kind = if variant.ends_with("lateral") { "lateral" } else { "haunch" };
        let mut force = load(kind, 15);
        if variant.ends_with("light load") {
            force["point_load"]["force_n_per_m"] = json!(1e-3);
        }
        let mut request = ask(arch, 35.0, Some(force), !variant.starts_with("weightless"));
        request["stone"]["youngs_modulus_pa"] = json!(modulus);
        Some(request)
    })
}
