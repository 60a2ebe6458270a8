//! Profiles of random arches.

use super::dice::Dice;
use serde_json::{Value, json};

/// The arch without its springings; half span and height of the extrados, roughly.
pub fn profile(dice: &mut Dice, mut count: usize, symmetric: bool) -> (Value, f64, f64) {
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
