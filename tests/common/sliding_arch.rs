//! Random arches of few stones and little friction, whose joints like to slide; and the ways to ask the same question again.

use super::dice::Dice;
use super::random_profile::profile;
use serde_json::{Value, json};
use voussoir::collapse::Analysis;
use voussoir::structure::{Joint, JointLaw, PointForce};

/// The request of a seed: 3 to 30 stones, dry joints without cohesion, self weight and one live load. Half of the arches are as
/// stout as arches of few stones often are; some of them are refused, because their joints cross.
pub fn request(seed: u64) -> Value {
    let dice = &mut Dice::new(seed ^ 0x51_1D1E);
    let count = dice.decades(3.0, 31.0) as usize;
    let (arch, half_span) = if dice.chance(0.5) { stout(dice, count) } else { usual(dice, count) };
    let count = arch["voussoirs"].as_u64().map_or(count, |n| n as usize);
    let force = dice.decades(1e2, 1e5);
    let load = match dice.below(4) {
        0 | 1 => json!({"point_load": {"force_n_per_m": force, "voussoir": dice.below(count)}}),
        2 => json!({"patch_load": {"force_n_per_m": force, "centre_x_m": half_span * dice.between(-0.5, 0.5),
            "width_m": half_span * dice.between(0.05, 0.4)}}),
        _ => json!({"body_acceleration": {"x_g": dice.sign()}}),
    };
    let direction = if dice.chance(0.15) { "decrease" } else { "increase" };
    json!({
        "arch": arch,
        "stone": {"friction_angle_deg": dice.between(12.0, 42.0), "compressive_strength_pa": 1e30},
        "loads": [{"load": {"self_weight": {}}}, {"load": load, "scaled": true}],
        "load_factor": {"direction": direction},
    })
}

fn stout(dice: &mut Dice, count: usize) -> (Value, f64) {
    let span = 10.0;
    let profile = match dice.below(3) {
        0 => json!({"pointed": {"span_m": span, "rise_m": span * dice.between(0.55, 1.3)}}),
        1 => json!({"elliptical": {"span_m": span, "rise_m": span * dice.between(0.2, 0.8)}}),
        _ => json!({"circular": {"span_m": span, "rise_m": span * dice.between(0.1, 0.5)}}),
    };
    let thickness = span * dice.between(0.1, 0.35);
    (json!({"profile": profile, "thickness": {"constant_m": thickness}, "voussoirs": count}), span / 2.0)
}

fn usual(dice: &mut Dice, count: usize) -> (Value, f64) {
    let (arch, half_span, _) = profile(dice, count, false);
    (arch, half_span)
}

/// The same rigid arch under the same loads, with other stiffness of its joints, other meshes, other scatter, and built in
/// another order: under `before` times its scaled loads, which are then no part of the load factor.
pub struct Variant {
    pub analysis: Analysis,
    pub before: f64,
}

/// All variants of a question whose load is expected to be near `load_factor`.
pub fn variants(analysis: &Analysis, load_factor: f64) -> Vec<Variant> {
    let mut all = Vec::new();
    let mut add = |change: &dyn Fn(&mut Analysis)| {
        let mut analysis = analysis.clone();
        change(&mut analysis);
        all.push(Variant { analysis, before: 0.0 });
    };
    for ratio in [0.1, 1.0, 100.0] {
        add(&|analysis| analysis.penalty_ratio = ratio);
    }
    for ratio in [0.1, 0.3, 3.0, 10.0] {
        add(&|analysis| analysis.shear_penalty_ratio = ratio);
    }
    // Cohesion is shared out to the points of a joint, and those that open lose theirs: there the mesh is part of the law.
    let dry = |joint: &Joint| !matches!(joint.law, JointLaw::Dry { cohesion, .. } if cohesion > 0.0);
    if analysis.structure.ring().iter().all(dry) {
        for subblocks in [[2, 1], [3, 2]] {
            add(&|analysis| analysis.mesh.subblocks.fill(subblocks));
        }
        // Points added in one stone shift the numbers that scatter the stiffness of all joints after it.
        for stone in 0..5.min(analysis.structure.voussoirs().len()) {
            add(&|analysis| analysis.mesh.subblocks[stone] = [2, 1]);
        }
    }
    for share in [0.3, 0.6, 0.9] {
        let (mut analysis, before) = (analysis.clone(), share * load_factor);
        let part = |f: &PointForce| PointForce { force: f.force * before, ..*f };
        analysis.fixed.extend(analysis.scaled.iter().map(part));
        all.push(Variant { analysis, before });
    }
    all
}
