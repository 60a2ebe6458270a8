//! Maps of arches that move: springings that settle until joints lose contact, and stones that fall.

use super::{Map, ask, axis, decades, frictions, load, semicircle};
use serde_json::{Value, json};

/// One springing moves, by up to a tenth of the span.
pub fn settlement() -> Map {
    let axes =
        [axis("movement over span", decades(-6, -1, 2)), axis("friction angle, degrees", frictions().split_off(11))];
    let title = "left springing moves, 21 stones, t/R 0.15";
    let variants = ["outwards", "inwards", "downwards", "upwards", "turned"];
    Map::of("settlement", title, axes, &variants, |share, friction, variant| {
        let by = 20.0 * share;
        let left = match variant {
            "outwards" => json!({"outwards_m": by}),
            "inwards" => json!({"outwards_m": -by}),
            "downwards" => json!({"downwards_m": by}),
            "upwards" => json!({"downwards_m": -by}),
            _ => json!({"rotation_deg": (10.0 * share).to_degrees()}),
        };
        let mut request = ask(semicircle(21, 0.15), friction, None, true);
        request["analysis"] = json!({"settlement": {"left": left}});
        Some(request)
    })
}

/// Stones that turn about one corner, then another, as the arch falls.
pub fn motion() -> Map {
    let thicknesses = [0.08, 0.1, 0.12, 0.15, 0.2, 0.3, 0.4];
    let axes =
        [axis("thickness over radius", thicknesses), axis("number of stones", [3.0, 4.0, 5.0, 7.0, 9.0, 15.0, 27.0])];
    let title = "motion after collapse, friction 35 degrees";
    Map::of("motion", title, axes, &["haunch", "crown", "lateral"], |ratio, number, variant| {
        let mut request: Value =
            ask(semicircle(number as usize, ratio), 35.0, Some(load(variant, number as usize)), true);
        request["motion"] = json!({"share_of_span": 0.3});
        Some(request)
    })
}
