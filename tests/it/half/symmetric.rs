//! Random symmetric arches: every profile, even and odd numbers of voussoirs, loads on the crown, on both sides, of
//! fill and of weight.

use crate::common::dice::Dice;
use crate::common::random_profile::profile;
use serde_json::{Value, json};

/// The request of a seed, of the whole arch.
pub fn request(seed: u64) -> Value {
    let dice = &mut Dice::new(0x5a1f + seed);
    let count = dice.decades(5.0, 80.0) as usize;
    let (mut arch, half_span, top) = profile(dice, count, true);
    let n = arch["profile"]["surveyed"]["intrados_m"].as_array().map(|joints| joints.len() - 1);
    let n = n.unwrap_or_else(|| arch["voussoirs"].as_u64().unwrap() as usize);
    if dice.chance(0.1) {
        arch["springing_joints"] = json!("bonded");
    }
    if dice.chance(0.2) {
        arch["abutments"] = json!({"height_m": dice.between(0.3, 2.0)});
    }
    let mut request = json!({
        "arch": arch,
        "stone": {"friction_angle_deg": dice.between(35.0, 60.0), "compressive_strength_pa": dice.decades(1e6, 1e8)},
        "loads": [{"load": {"self_weight": {}}}],
    });
    if dice.chance(0.15) {
        let joint = dice.below(n / 2);
        let friction = dice.between(30.0, 60.0);
        let one = |joint: usize| json!({"joint": joint, "friction_angle_deg": friction});
        if joint > 0 {
            request["joint_overrides"] = json!([one(joint), one(n - joint)]);
        }
    }
    if dice.chance(0.25) && arch_takes_a_mesh(&request) {
        let [radial, along] = [0, 1].map(|_| 1 + dice.below(4));
        request["mesh"] = json!({"subblocks": {"uniform": {"radial": radial, "along": along}}});
    }
    let loads = request["loads"].as_array_mut().unwrap();
    if dice.chance(0.25) {
        loads.push(json!({"load": fill(dice, top)}));
    }
    for load in live(dice, half_span, top, n) {
        loads.push(json!({"load": load, "scaled": true}));
    }
    if dice.chance(0.1) {
        request["load_factor"] = json!({"direction": "decrease"});
    }
    request
}

/// Curved sides of more than one arc cannot be cut.
fn arch_takes_a_mesh(request: &Value) -> bool {
    request["arch"]["curved_sides"].is_null() || request["arch"]["profile"].get("circular").is_some()
}

fn fill(dice: &mut Dice, top: f64) -> Value {
    let height = top * dice.between(1.3, 2.2);
    json!({"fill_pressure": {
        "fill_height_m": height, "embankment_thickness_m": dice.unit(), "lateral_ratio": 0.5,
    }})
}

/// A live load that is symmetric: alone, or as a pair.
fn live(dice: &mut Dice, half: f64, top: f64, n: usize) -> Vec<Value> {
    let force = dice.decades(1e2, 1e6);
    let x = half * dice.between(0.1, 0.7);
    let point = |x: f64| json!({"point_load": {"force_n_per_m": force, "x_m": x}});
    let patch = |x: f64, w: f64| json!({"patch_load": {"centre_x_m": x, "width_m": w, "force_n_per_m": force}});
    match dice.below(7) {
        0 => vec![point(0.0)],
        1 => vec![patch(0.0, half * dice.between(0.02, 0.6))],
        2 => vec![point(-x), point(x)],
        3 => {
            let width = half * dice.between(0.02, 0.2);
            vec![patch(-x, width), patch(x, width)]
        }
        4 => {
            let k = dice.below(n / 2);
            [k, n - 1 - k].map(|k| json!({"point_load": {"force_n_per_m": force, "voussoir": k}})).to_vec()
        }
        5 => vec![fill(dice, top)],
        _ => vec![json!({"body_acceleration": {"y_g": if dice.chance(0.5) { -1.0 } else { 1.0 }}}), point(0.0)],
    }
}
