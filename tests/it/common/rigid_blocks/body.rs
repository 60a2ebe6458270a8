//! A scene as a request on the wire. The words of supports and loads are in one function each.

use super::scene::{Load, Scene, Support};
use serde_json::{Value, json};

/// The name of a block.
pub fn name(block: usize) -> String {
    format!("b{block}")
}

/// The whole request; joints are left to be found.
pub fn request(scene: &Scene) -> Value {
    let polygon = |(k, corners)| json!({"name": name(k), "corners_m": corners});
    let loads = scene.scaled.iter().map(load).map(|load| json!({"load": load, "scaled": true}));
    json!({
        "blocks": {
            "polygons": scene.blocks.iter().enumerate().map(polygon).collect::<Vec<_>>(),
            "joints": "found",
            "supports": scene.supports.iter().map(support).collect::<Vec<_>>(),
            "tolerance_m": 1e-6,
        },
        "stone": {
            "density_kg_m3": scene.density,
            "friction_angle_deg": scene.friction_angle_deg,
            "compressive_strength_pa": 1e30,
        },
        "loads": std::iter::once(json!({"load": {"self_weight": {}}})).chain(loads).collect::<Vec<_>>(),
    })
}

fn support(support: &Support) -> Value {
    let sides = support.sides.iter().map(|&(block, side)| json!({"block": name(block), "side": side}));
    json!({"name": support.name, "sides": sides.collect::<Vec<_>>()})
}

fn load(load: &Load) -> Value {
    match load {
        Load::Acceleration([x, y]) => json!({"body_acceleration": {"x_g": x, "y_g": y}}),
        Load::Point(push) => {
            json!({"point_force": {"block": name(push.block), "at_m": push.at, "force_n_per_m": push.force}})
        }
    }
}
