//! Maps over friction: against the penalty and against cohesion.

use super::{Map, ask, axis, decades, frictions, load, semicircle};
use serde_json::json;

/// Penalty over Young's modulus, far beyond what a request may ask for (0.01 to 100).
pub fn penalty() -> Map {
    let axes = [axis("penalty over Young's modulus", decades(-4, 6, 2)), axis("friction angle, degrees", frictions())];
    let ratios = axes[0].values.clone();
    let title = "27 stones, t/R 0.15";
    let mut map = Map::of("penalty", title, axes, &["haunch", "lateral"], |_, friction, variant| {
        Some(ask(semicircle(27, 0.15), friction, Some(load(variant, 27)), true))
    });
    map.scenes.iter_mut().for_each(|scene| scene.penalty_ratio = ratios[scene.at[0]]);
    map
}

/// Cohesion holds joints that press nowhere, until they open.
pub fn cohesion() -> Map {
    let mut values = decades(0, 7, 2);
    values.insert(0, 0.0);
    let axes = [axis("cohesion, Pa", values), axis("friction angle, degrees", frictions())];
    let title = "15 stones, t/R 0.2";
    Map::of("cohesion", title, axes, &["haunch", "uplift"], |cohesion, friction, variant| {
        let mut request = ask(semicircle(15, 0.2), friction, Some(load(variant, 15)), true);
        request["stone"]["cohesion_pa"] = json!(cohesion);
        Some(request)
    })
}
