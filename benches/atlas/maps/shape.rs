//! Maps over the shape of the arch: thickness, number of stones, rise, joints that lean, slivers, meshes.

use super::{Map, ask, axis, decades, frictions, load, semicircle};
use crate::common::dice::Dice;
use crate::common::door;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Friction angle at which nothing slides here, degrees.
const ROUGH: f64 = 75.0;

/// Numbers of stones.
const NUMBERS: [f64; 14] = [3.0, 4.0, 5.0, 7.0, 9.0, 15.0, 27.0, 51.0, 101.0, 201.0, 401.0, 701.0, 1201.0, 2001.0];

/// Least thickness over radius at which a semicircle stands under its weight, by the oracle; a hundredth where any would do.
fn least_thickness(voussoirs: usize) -> f64 {
    let stands = |ratio: f64| {
        let request = ask(semicircle(voussoirs, ratio), ROUGH, None, true);
        door::problem(&door::analysis(&request).expect("an arch")).stands()
    };
    let (mut thin, mut thick) = (0.01, 0.5);
    for _ in 0..36 {
        let middle = 0.5 * (thin + thick);
        *if stands(middle) { &mut thick } else { &mut thin } = middle;
    }
    thick
}

/// Thickness over the least one, and the number of stones.
pub fn thickness() -> Map {
    let over = [0.5, 0.9, 0.99, 0.999, 0.9999, 1.0001, 1.001, 1.01, 1.03, 1.1, 1.3, 2.0];
    let axes = [axis("number of stones", &NUMBERS[..9]), axis("thickness over the least", over)];
    let least: BTreeMap<usize, f64> = NUMBERS[..9].iter().map(|&n| (n as usize, least_thickness(n as usize))).collect();
    let title = "next to the least thickness, friction 75 degrees";
    Map::of("thickness", title, axes, &["haunch", "crown", "lateral", "uplift"], |number, over, variant| {
        let number = number as usize;
        Some(ask(semicircle(number, over * least[&number]), ROUGH, Some(load(variant, number)), true))
    })
}

/// Number of stones and thickness.
pub fn number() -> Map {
    let axes =
        [axis("number of stones", NUMBERS), axis("friction angle, degrees", [0.0, 10.0, 20.0, 30.0, 45.0, 75.0])];
    Map::of("number", "t/R 0.15", axes, &["haunch", "lateral"], |number, friction, variant| {
        Some(ask(semicircle(number as usize, 0.15), friction, Some(load(variant, number as usize)), true))
    })
}

/// Rise over span down to a truly flat arch, 1 m thick over 10 m, joints towards one centre.
pub fn flat() -> Map {
    let rises = [0.0, 1e-3, 3e-3, 0.01, 0.02, 0.03, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5];
    let axes = [axis("rise over span", rises), axis("friction angle, degrees", frictions())];
    let title = "flat arches, 15 stones, thickness 0.1 of the span";
    Map::of("flat", title, axes, &["haunch", "crown", "uplift"], |rise, friction, variant| {
        let arch = if rise == 0.0 { lintel(15, 30f64.to_radians()) } else { segment(15, rise) };
        Some(ask(arch, friction, Some(load(variant, 15)), true))
    })
}

/// A segment of 10 m span, joints normal to its axis.
fn segment(voussoirs: usize, rise: f64) -> Value {
    json!({
        "profile": {"circular": {"span_m": 10.0, "rise_m": 10.0 * rise}},
        "thickness": {"constant_m": 1.0},
        "voussoirs": voussoirs,
    })
}

/// A flat arch of 10 m by 1 m, its joints towards a point below; the outermost lean by `lean` (rad) from the vertical.
fn lintel(voussoirs: usize, lean: f64) -> Value {
    let spread = 1.0 + lean.tan() / 5.0;
    let below = |k: usize| 10.0 * k as f64 / voussoirs as f64 - 5.0;
    let intrados: Vec<[f64; 2]> = (0..=voussoirs).map(|k| [below(k), 0.0]).collect();
    let extrados: Vec<[f64; 2]> = (0..=voussoirs).map(|k| [spread * below(k), 1.0]).collect();
    json!({"profile": {"surveyed": {"intrados_m": intrados, "extrados_m": extrados}}})
}

/// Flat arches with joints next to vertical, the classical scene of a keystone that drops.
pub fn tilt() -> Map {
    let leans = [0.0, 1e-6, 1e-4, 1e-3, 0.01, 0.1, 0.3, 1.0, 3.0, 5.0, 10.0, 20.0, 30.0, 45.0];
    let axes = [axis("lean of the outer joints, degrees", leans), axis("friction angle, degrees", frictions())];
    let title = "truly flat, joints next to vertical, 9 stones";
    Map::of("tilt", title, axes, &["haunch", "crown"], |lean, friction, variant| {
        Some(ask(lintel(9, lean.to_radians()), friction, Some(load(variant, 9)), true))
    })
}

/// Voussoirs of unequal length: every other one, and one in random places, is short.
pub fn slivers() -> Map {
    let axes = [axis("shortest over longest stone", decades(-3, 0, 4)), axis("number of stones", &NUMBERS[2..10])];
    Map::of("slivers", "t/R 0.15, friction 35 degrees", axes, &["every other", "random"], |short, number, variant| {
        let (number, dice) = (number as usize, &mut Dice::new(number as u64));
        let lengths: Vec<f64> = (0..number)
            .map(|k| match variant {
                "every other" => [1.0, short][k % 2],
                _ => dice.decades(short, 1.0 + 1e-9),
            })
            .collect();
        let mut arch = semicircle(number, 0.15);
        arch["relative_lengths"] = json!(lengths);
        Some(ask(arch, 35.0, Some(load("haunch", number)), true))
    })
}

/// Stones of one subblock beside stones of many: mixed stiffness, as far as one Young's modulus allows.
pub fn mesh() -> Map {
    let axes = [
        axis("subblocks each way of every other stone", [1.0, 2.0, 3.0, 4.0, 6.0, 8.0]),
        axis("friction angle, degrees", frictions()),
    ];
    Map::of("mesh", "9 stones, t/R 0.15", axes, &["haunch"], |cut, friction, variant| {
        let stones: Vec<Value> = (0..9)
            .map(|k| {
                if k % 2 == 0 {
                    json!({"radial": 1, "along": 1})
                } else {
                    json!({"radial": cut as usize, "along": cut as usize})
                }
            })
            .collect();
        let mut request = ask(semicircle(9, 0.15), friction, Some(load(variant, 9)), true);
        request["mesh"] = json!({"subblocks": {"per_voussoir": stones}});
        Some(request)
    })
}
