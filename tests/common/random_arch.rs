//! Random requests from a seed: every profile, joint and load the wire knows, in sizes a mason would meet.

use serde_json::{Value, json};

/// SplitMix64 (Steele, Lea & Flood 2014): one word of state, the same numbers everywhere.
pub struct Dice(u64);

impl Dice {
    pub fn new(seed: u64) -> Dice {
        let mut dice = Dice(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5851_f42d_4c95_7f2d);
        dice.word();
        dice
    }

    fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.word() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Every decade alike.
    pub fn decades(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    pub fn chance(&mut self, share: f64) -> bool {
        self.unit() < share
    }

    pub fn below(&mut self, end: usize) -> usize {
        (self.unit() * end as f64) as usize
    }

    fn sign(&mut self) -> f64 {
        if self.chance(0.5) { 1.0 } else { -1.0 }
    }
}

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
    let mut count = dice.decades(5.0, 202.0) as usize;
    let symmetric = dice.chance(0.12);
    let half = symmetric && dice.chance(0.7);
    if half {
        count += count % 2;
    }
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

/// The arch without its springings; half span and height of the extrados, roughly.
fn profile(dice: &mut Dice, mut count: usize, symmetric: bool) -> (Value, f64, f64) {
    let radius = dice.decades(1.0, 15.0);
    // Thin semicircles do not stand; segments may be thin.
    let share = dice.between(0.1076, 0.25);
    let (profile, half_span, rise) = match dice.below(8) {
        0 | 1 => (json!({"circular": {"radius_m": radius, "opening_angle_deg": 180.0}}), radius, radius),
        2 | 3 => segment(dice, radius),
        4 => {
            let (most, pointed) = pointed(dice, radius, share);
            count = if count > most { most - (most - count % 2) % 2 } else { count };
            pointed
        }
        5 => {
            let rise = radius * dice.between(0.45, 1.6);
            (json!({"elliptical": {"span_m": 2.0 * radius, "rise_m": rise}}), radius, rise)
        }
        6 => multi_centre(dice, radius),
        _ => return surveyed(dice, count, radius, share, symmetric),
    };
    let mut thickness = share * radius;
    let circular = profile.get("circular").is_some();
    let mut arch = json!({"profile": profile, "voussoirs": count});
    if circular && dice.chance(0.12) {
        arch["curved_sides"] = json!(true);
        arch["thickness"] = json!({"constant_m": thickness});
    } else if dice.chance(0.25) {
        let springing = thickness * dice.between(1.0, 1.6);
        arch["thickness"] = json!({"linear": {"crown_m": thickness, "springing_m": springing}});
        thickness = springing;
    } else {
        arch["thickness"] = json!({"constant_m": thickness});
    }
    if dice.chance(0.1) {
        arch["line"] = json!("intrados");
    }
    if dice.chance(0.12) {
        let mut lengths: Vec<f64> = (0..count).map(|_| dice.between(0.7, 1.3)).collect();
        if symmetric {
            (0..count / 2).for_each(|k| lengths[count - 1 - k] = lengths[k]);
        }
        arch["relative_lengths"] = json!(lengths);
    }
    (arch, half_span, rise + thickness)
}

fn segment(dice: &mut Dice, radius: f64) -> (Value, f64, f64) {
    let half = dice.between(30f64.to_radians(), 88f64.to_radians());
    let (span, rise) = (2.0 * radius * half.sin(), radius * (1.0 - half.cos()));
    let by_radius = json!({"radius_m": radius, "opening_angle_deg": 2.0 * half.to_degrees()});
    let by_span = json!({"span_m": span, "rise_m": rise});
    (json!({"circular": if dice.chance(0.5) { by_radius } else { by_span }}), span / 2.0, rise)
}

/// And the most voussoirs: the joints beside the apex lean over it, and would cross where stones are short.
fn pointed(dice: &mut Dice, radius: f64, thickness: f64) -> (usize, (Value, f64, f64)) {
    let offset = dice.between(0.05, 0.5);
    let lean = offset / (1.0 - offset * offset).sqrt();
    let most = (1.2 * offset.acos() / (thickness * lean)) as usize;
    let centre = radius * offset;
    let (half, rise) = (radius - centre, (radius * radius - centre * centre).sqrt());
    let by_radius = json!({"radius_m": radius, "centre_offset_m": centre});
    let by_span = json!({"span_m": 2.0 * half, "rise_m": rise});
    (most, (json!({"pointed": if dice.chance(0.5) { by_radius } else { by_span }}), half, rise))
}

/// A basket handle (90 degrees a side) or an oval that leans outwards at its feet; largest radius `radius`.
fn multi_centre(dice: &mut Dice, radius: f64) -> (Value, f64, f64) {
    let arcs = if dice.chance(0.5) {
        let foot = dice.between(35.0, 60.0);
        vec![(radius * dice.between(0.4, 0.8), foot), (radius, 90.0 - foot)]
    } else {
        let middle = radius * dice.between(1.2, 2.0);
        vec![(0.6 * radius, dice.between(25.0, 45.0)), (middle, 50.0), (radius * dice.between(0.7, 1.0), 15.0)]
    };
    let (mut at, mut lean) = ([0.0f64; 2], 0.0f64);
    let mut widest = 0.0f64;
    for &(r, angle) in arcs.iter().rev() {
        let next = lean + f64::to_radians(angle);
        at = [at[0] + r * (next.sin() - lean.sin()), at[1] + r * (lean.cos() - next.cos())];
        lean = next;
        widest = widest.max(at[0]);
    }
    let arcs: Vec<Value> = arcs.iter().map(|&(r, a)| json!({"radius_m": r, "angle_deg": a})).collect();
    (json!({"multi_centre": {"arcs": arcs}}), widest, at[1])
}

/// A measured arch: roughly half an ellipse or a segment, unequal stones, corners a little off.
fn surveyed(dice: &mut Dice, count: usize, radius: f64, share: f64, symmetric: bool) -> (Value, f64, f64) {
    let half = if dice.chance(0.5) { 90f64 } else { dice.between(40.0, 85.0) }.to_radians();
    let flat = dice.between(0.7, 1.2);
    let thickness = share * radius;
    let mut shares: Vec<f64> = (0..count).map(|_| dice.between(0.75, 1.25)).collect();
    if symmetric {
        (0..count / 2).for_each(|k| shares[count - 1 - k] = shares[k]);
    }
    let total: f64 = shares.iter().sum();
    let off = 0.08 * thickness.min(radius * half / count as f64);
    let (mut inner, mut outer, mut before) = (Vec::new(), Vec::new(), 0.0);
    for k in 0..=count {
        let (sin, cos) = (half * (2.0 * before / total - 1.0)).sin_cos();
        for (points, r) in [(&mut inner, radius - thickness / 2.0), (&mut outer, radius + thickness / 2.0)] {
            let wobble = if symmetric { [0.0; 2] } else { [dice.between(-off, off), dice.between(-off, off)] };
            points.push([r * sin + wobble[0], flat * r * (cos - half.cos()) + wobble[1]]);
        }
        before += shares.get(k).copied().unwrap_or(0.0);
    }
    if symmetric {
        for points in [&mut inner, &mut outer] {
            for k in 0..=count / 2 {
                let [x, y] = points[k];
                points[count - k] = [if 2 * k == count { 0.0 } else { -x }, y];
                points[k] = [if 2 * k == count { 0.0 } else { x }, y];
            }
        }
    }
    let top = outer.iter().map(|p| p[1]).fold(0.0, f64::max);
    (json!({"profile": {"surveyed": {"intrados_m": inner, "extrados_m": outer}}}), radius * half.sin(), top)
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
    loads
}

fn fill(dice: &mut Dice, shape: &Shape) -> Value {
    let embankment = dice.chance(0.4);
    let height = shape.top * if embankment { dice.between(1.3, 2.2) } else { dice.between(0.6, 1.6) };
    let mut fill = json!({"fill_height_m": height, "fill_density_kg_m3": dice.between(1400.0, 2000.0)});
    if embankment {
        fill["embankment_thickness_m"] = json!(dice.between(0.2, 3.0));
    }
    if dice.chance(0.4) {
        fill["lateral_ratio"] = json!(dice.between(0.2, 1.0));
    }
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
        // Half an arch wants every load symmetric by itself, so no pairs there.
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
        16 => json!({"fill_pressure": {"embankment_thickness_m": 1.0}}),
        17 => {
            let from = shape.top * dice.between(0.3, 0.5);
            let band = json!({"from_m": from, "to_m": from + shape.top * dice.between(0.2, 0.4), "pressure_pa": force});
            json!({"lateral_pressure": {"bands": [band]}})
        }
        _ => middle(dice.below(shape.count), -force),
    };
    vec![one]
}
