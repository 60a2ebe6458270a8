//! Random requests from a seed: every profile, joint and load the wire knows, in sizes a mason would meet.

use super::dice::Dice;
use super::random_profile::profile;
use serde_json::{Value, json};

/// What the loads must know about the arch: half span and height, roughly, number of voussoirs, and whether all of
/// it is to be symmetric.
struct Shape {
    half_span: f64,
    top: f64,
    count: usize,
    symmetric: bool,
    half: bool,
}

/// The request of a seed.
pub fn request(seed: u64) -> Value {
    let dice = &mut Dice::new(seed);
    let count = dice.decades(5.0, 202.0) as usize;
    let symmetric = dice.chance(0.12);
    let half = symmetric && dice.chance(0.7);
    let (mut arch, half_span, top) = profile(dice, count, symmetric);
    // A pointed arch cannot be cut as finely as others, see `pointed`.
    let count = arch["voussoirs"].as_u64().map_or(count, |n| n as usize);
    let shape = Shape { half_span, top, count, symmetric, half };
    arch["half"] = json!(half);
    let bonded = dice.chance(0.08);
    if bonded {
        arch["springing_joints"] = json!("bonded");
    }
    if dice.chance(0.08) {
        arch["abutments"] = json!({"height_m": dice.between(0.3, 2.0)});
    }
    let friction = if dice.chance(0.3) { dice.between(12.0, 25.0) } else { dice.between(25.0, 60.0) };
    let mut stone = json!({"friction_angle_deg": friction, "density_kg_m3": dice.between(1600.0, 2800.0)});
    if dice.chance(0.08) {
        stone["cohesion_pa"] = json!(dice.decades(1e3, 3e5));
    }
    if dice.chance(0.2) {
        stone["youngs_modulus_pa"] = json!(dice.decades(3e8, 5e10));
        stone["plane"] = json!(if dice.chance(0.5) { "stress" } else { "strain" });
        stone["penalty_ratio"] = json!(dice.decades(0.3, 10.0));
    }
    let direction = if dice.chance(0.1) { "decrease" } else { "increase" };
    json!({
        "name": format!("random arch {seed}"),
        "arch": arch,
        "stone": stone,
        "joint_overrides": overrides(dice, &shape, bonded),
        "loads": loads(dice, &shape),
        "load_factor": {"direction": direction},
    })
}

fn overrides(dice: &mut Dice, shape: &Shape, bonded: bool) -> Vec<Value> {
    if shape.symmetric || !dice.chance(0.1) {
        return Vec::new();
    }
    let spare = usize::from(bonded);
    let mut joints: Vec<usize> = (0..3).map(|_| spare + dice.below(shape.count + 1 - 2 * spare)).collect();
    joints.sort_unstable();
    joints.dedup();
    joints.truncate(1 + dice.below(3));
    let mut one = |joint: usize| {
        let mut item = json!({"joint": joint, "friction_angle_deg": dice.between(12.0, 60.0)});
        if dice.chance(0.2) {
            item["cohesion_pa"] = json!(dice.decades(1e3, 1e5));
        }
        item
    };
    joints.drain(..).map(&mut one).collect()
}

fn loads(dice: &mut Dice, shape: &Shape) -> Vec<Value> {
    let mut loads = Vec::new();
    let weighty = dice.chance(0.97);
    if weighty {
        loads.push(json!({"load": {"self_weight": {}}, "scaled": dice.chance(0.03)}));
    }
    if dice.chance(0.18) {
        loads.push(json!({"load": fill(dice, shape)}));
    }
    if dice.chance(0.06) {
        loads.push(json!({"load": {"patch_load": patch(dice, shape, 0.0)}}));
    }
    if weighty && dice.chance(0.03) {
        return loads;
    }
    for _ in 0..if dice.chance(0.12) { 2 } else { 1 } {
        let coefficient = if dice.chance(0.1) { dice.decades(0.1, 10.0) } else { 1.0 };
        for load in live(dice, shape) {
            loads.push(json!({"load": load, "scaled": true, "coefficient": coefficient}));
        }
    }
    // Scaled fill in a scaled acceleration is refused.
    if loads.iter().any(|load| load["scaled"] == true && load["load"]["body_acceleration"].is_object()) {
        for fill in loads.iter_mut().filter(|load| load["load"]["fill_pressure"].is_object()) {
            fill["scaled"] = json!(false);
        }
    }
    loads
}

fn fill(dice: &mut Dice, shape: &Shape) -> Value {
    let embankment = dice.chance(0.4);
    let height = shape.top * if embankment { dice.between(1.3, 2.2) } else { dice.between(0.6, 1.6) };
    let mut fill = json!({"fill_height_m": height, "fill_density_kg_m3": dice.between(1400.0, 2000.0)});
    if embankment {
        fill["embankment_thickness_m"] = json!(dice.between(0.2, 3.0));
    }
    fill["lateral_ratio"] = json!(if dice.chance(0.4) { dice.between(0.2, 1.0) } else { 0.5 });
    json!({"fill_pressure": fill})
}

fn patch(dice: &mut Dice, shape: &Shape, centre: f64) -> Value {
    let width = shape.half_span * dice.between(0.02, 0.45);
    json!({"centre_x_m": centre, "width_m": width, "force_n_per_m": dice.decades(1e2, 1e5)})
}

/// One live load; two of the same where both sides carry it.
fn live(dice: &mut Dice, shape: &Shape) -> Vec<Value> {
    let force = dice.decades(1e2, 1e6);
    let point = |x: f64, force: f64| json!({"point_load": {"force_n_per_m": force, "x_m": x}});
    let middle = |k: usize, force: f64| json!({"point_load": {"force_n_per_m": force, "voussoir": k}});
    let (half, last) = (shape.half_span, shape.count - 1);
    if shape.symmetric {
        // Half an arch gets loads that are symmetric by themselves; pairs are for whole arches here.
        return match dice.below(if shape.half { 3 } else { 5 }) {
            0 => vec![point(0.0, force)],
            1 => vec![json!({"patch_load": patch(dice, shape, 0.0)})],
            2 => vec![fill(dice, shape)],
            3 => {
                let x = half * dice.between(0.1, 0.7);
                vec![point(x, force), point(-x, force)]
            }
            _ => {
                let k = dice.below(shape.count.div_ceil(2));
                if k == last - k { vec![middle(k, force)] } else { vec![middle(k, force), middle(last - k, force)] }
            }
        };
    }
    let one = match dice.below(20) {
        0..=2 => middle(shape.count / 2, force),
        3..=5 => middle(shape.count / 4, force),
        6 | 7 => point(half * dice.between(-0.75, 0.75), force),
        8..=10 => {
            let centre = half * dice.between(-0.5, 0.5);
            json!({"patch_load": patch(dice, shape, centre)})
        }
        11..=13 => json!({"body_acceleration": {"x_g": dice.sign() * dice.between(0.05, 1.0)}}),
        14 => {
            let angle = dice.between(0.0, 2.0 * std::f64::consts::PI);
            json!({"body_acceleration": {"x_g": angle.cos(), "y_g": angle.sin()}})
        }
        15 => fill(dice, shape),
        16 => json!({"fill_pressure": {"embankment_thickness_m": 1.0, "lateral_ratio": 0.5}}),
        17 => {
            let from = shape.top * dice.between(0.3, 0.5);
            let band = json!({"from_m": from, "to_m": from + shape.top * dice.between(0.2, 0.4), "pressure_pa": force});
            json!({"lateral_pressure": {"bands": [band]}})
        }
        _ => middle(dice.below(shape.count), -force),
    };
    vec![one]
}
