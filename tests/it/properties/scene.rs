//! Random scenes that shrink, and what is done to them: mirrored, scaled, loaded otherwise.

use crate::common::door;
use proptest::prelude::*;
use serde_json::{Value, json};
use voussoir::collapse::{Analysis, CollapseReport, Outcome, PathEnd};

/// Friction angles: any, and those at which arches as stout as these hardly ever slide.
pub const ANY: [f64; 2] = [18.0, 60.0];
pub const ROUGH: [f64; 2] = [42.0, 65.0];

/// A request and what is needed to load it elsewhere.
#[derive(Debug, Clone)]
pub struct Scene {
    pub request: Value,
}

/// A request with its answer.
pub struct Solved {
    pub analysis: Analysis,
    pub report: CollapseReport,
}

impl Solved {
    pub fn new(request: &Value) -> Solved {
        let analysis = door::analysis(request).unwrap_or_else(|faults| panic!("{faults}{request}"));
        Solved { analysis, report: door::solve(request) }
    }

    /// Ends of the path with the direction in which each was reached.
    pub fn ends(&self) -> Vec<(&PathEnd, f64)> {
        let sign = if self.analysis.task.direction() == voussoir::collapse::Direction::Increase { 1.0 } else { -1.0 };
        let both = [(self.report.end.as_ref(), sign), (self.report.other_end.as_ref(), -sign)];
        both.into_iter().filter_map(|(end, sign)| Some((end?, sign))).collect()
    }

    pub fn falls(&self) -> bool {
        matches!(self.report.outcome, Outcome::Collapse | Outcome::StandsInWindow) && self.report.end.is_some()
    }

    pub fn slides(&self) -> bool {
        self.ends().iter().any(|(end, _)| end.mechanism.slips())
    }

    /// Load factor at the end of the path; NaN without one.
    pub fn factor(&self) -> f64 {
        self.report.end.as_ref().map_or(f64::NAN, |end| end.load_factor)
    }

    /// Sum of the sizes of all loads at a load factor, N/m: what forces are measured against.
    pub fn weight(&self, factor: f64) -> f64 {
        let total = |forces: &[voussoir::structure::PointForce]| forces.iter().map(|f| f.force.norm()).sum::<f64>();
        total(&self.analysis.fixed) + factor.abs() * total(&self.analysis.scaled)
    }
}

/// Relative difference of two load factors.
pub fn apart(a: f64, b: f64) -> f64 {
    if a == b { 0.0 } else { (a - b).abs() / a.abs().max(b.abs()) }
}

fn profile() -> impl Strategy<Value = Value> {
    prop_oneof![
        (1.0..12.0, 110.0..180.0).prop_map(|(r, a)| json!({"circular": {"radius_m": r, "opening_angle_deg": a}})),
        (2.0..20.0, 0.25..0.6).prop_map(|(s, rise)| json!({"elliptical": {"span_m": s, "rise_m": s * rise}})),
        (1.0..10.0, 0.05..0.2).prop_map(|(r, c)| json!({"pointed": {"radius_m": r, "centre_offset_m": r * c}})),
        (1.0..8.0, 30.0..55.0, 0.4..0.8).prop_map(|(r, foot, share)| {
            json!({"multi_centre": {"arcs": [
                {"radius_m": r * share, "angle_deg": foot}, {"radius_m": r, "angle_deg": 90.0 - foot}]}})
        }),
    ]
}

/// Half span and height of the axis.
fn size(profile: &Value) -> [f64; 2] {
    let probe = json!({
        "arch": {"profile": profile, "voussoirs": 8, "thickness": {"constant_m": 0.01}},
        "loads": [{"load": {"self_weight": {}}}],
    });
    let joints = door::analysis(&probe).unwrap().structure.ring().to_vec();
    [joints[8].middle().x, joints.iter().map(|j| j.middle().y).fold(0.0, f64::max)]
}

/// A scaled load by its kind and two numbers in (-1, 1).
fn live(kind: usize, [a, b]: [f64; 2], count: usize, half_span: f64) -> Value {
    match kind {
        0 => json!({"point_load": {"force_n_per_m": 1000.0, "voussoir": ((a + 1.0) / 2.0 * count as f64) as usize}}),
        1 => json!({"point_load": {"force_n_per_m": 1000.0, "x_m": 0.7 * half_span * a}}),
        2 => {
            let (centre, width) = (0.5 * half_span * a, half_span * (0.25 + 0.2 * b));
            json!({"patch_load": {"centre_x_m": centre, "width_m": width, "force_n_per_m": 1000.0}})
        }
        3 => json!({"body_acceleration": {"x_g": if a < 0.0 { -1.0 } else { 1.0 }}}),
        _ => json!({"body_acceleration": {"x_g": a, "y_g": 0.5 * b}}),
    }
}

/// Fill that presses at rest.
fn fill_up_to(height: f64) -> Value {
    json!({"fill_pressure": {"fill_height_m": height, "lateral_ratio": 0.5}})
}

/// An arch under its weight, sometimes under fill, and one scaled load.
pub fn scene(friction: [f64; 2]) -> impl Strategy<Value = Scene> {
    let arch = (profile(), 5..33usize, 0.12..0.24, prop::option::of(1.0..1.5), friction[0]..friction[1]);
    let loads = (0..5usize, -0.99..0.99, -0.99..0.99, prop::option::weighted(0.25, 1.1..1.6));
    (arch, loads).prop_map(|((profile, count, share, swell, friction), (kind, a, b, fill))| {
        let [half_span, top] = size(&profile);
        let crown = share * half_span.min(top);
        let mut fixed = vec![json!({"load": {"self_weight": {}}})];
        fixed.extend(fill.map(|h| json!({"load": fill_up_to((top + crown) * h)})));
        fixed.push(json!({"load": live(kind, [a, b], count, half_span), "scaled": true}));
        let springing = crown * swell.unwrap_or(1.0);
        Scene {
            request: json!({
                "arch": {
                    "profile": profile, "voussoirs": count,
                    "thickness": {"linear": {"crown_m": crown, "springing_m": springing}},
                },
                "stone": {"friction_angle_deg": friction},
                "loads": fixed,
            }),
        }
    })
}

/// The same with corners up to 4 per cent of the thickness off, so that nothing is symmetric.
pub fn surveyed(friction: [f64; 2]) -> impl Strategy<Value = Scene> {
    (scene(friction), prop::collection::vec(-1.0..1.0, 4 * 33)).prop_map(|(scene, noise)| {
        let joints = door::analysis(&scene.request).unwrap().structure.ring().to_vec();
        let point = |p: voussoir::geometry::Vec2, k: usize, length: f64| {
            let off = 0.04 * length.min(0.5 * (joints[1].middle() - joints[0].middle()).norm());
            [p.x + off * noise[k], p.y + off * noise[k + 1]]
        };
        let ends: Vec<[[f64; 2]; 2]> = joints
            .iter()
            .enumerate()
            .map(|(k, j)| [point(j.intrados, 4 * k, j.length()), point(j.extrados, 4 * k + 2, j.length())])
            .collect();
        scene.with_joints(&ends)
    })
}

/// A symmetric arch under symmetric loads, of an even number of voussoirs.
pub fn symmetric(friction: [f64; 2]) -> impl Strategy<Value = Scene> {
    (scene(friction), 3..16usize, 0..3usize).prop_map(|(mut scene, pairs, kind)| {
        scene.request["arch"]["voussoirs"] = json!(2 * pairs);
        let [half_span, top] = size(&scene.request["arch"]["profile"]);
        let load = match kind {
            0 => json!({"point_load": {"force_n_per_m": 1000.0, "x_m": 0.0}}),
            1 => json!({"patch_load": {"centre_x_m": 0.0, "width_m": 0.3 * half_span, "force_n_per_m": 1000.0}}),
            _ => fill_up_to(1.6 * top),
        };
        *scene.load(true) = json!({"load": load, "scaled": true});
        scene
    })
}

impl Scene {
    /// The first load that is scaled, or is not.
    pub fn load(&mut self, scaled: bool) -> &mut Value {
        let loads = self.request["loads"].as_array_mut().unwrap();
        loads.iter_mut().find(|load| (load["scaled"] == true) == scaled).unwrap()
    }

    pub fn kind(&self) -> String {
        let loads = self.request["loads"].as_array().unwrap();
        loads.last().unwrap()["load"].as_object().unwrap().keys().next().unwrap().clone()
    }

    fn with_joints(&self, ends: &[[[f64; 2]; 2]]) -> Scene {
        let face = |face: usize| ends.iter().map(|joint| joint[face]).collect::<Vec<_>>();
        let mut scene = self.clone();
        scene.request["arch"] = json!({"profile": {"surveyed": {"intrados_m": face(0), "extrados_m": face(1)}}});
        scene
    }

    /// The mirror image about x = 0, as surveyed points, under mirrored loads.
    pub fn mirrored(&self) -> Scene {
        let joints = door::analysis(&self.request).unwrap().structure.ring().to_vec();
        let flip = |p: voussoir::geometry::Vec2| [-p.x, p.y];
        let ends: Vec<_> = joints.iter().rev().map(|j| [flip(j.intrados), flip(j.extrados)]).collect();
        let mut scene = self.with_joints(&ends);
        for entry in scene.request["loads"].as_array_mut().unwrap() {
            for (place, last) in [
                ("/load/point_load/x_m", 0.0),
                ("/load/point_load/voussoir", joints.len() as f64 - 2.0),
                ("/load/patch_load/centre_x_m", 0.0),
                ("/load/body_acceleration/x_g", 0.0),
            ] {
                if let Some(number) = entry.pointer_mut(place) {
                    let there = last - number.as_f64().unwrap();
                    *number = if last > 0.0 { json!(there as usize) } else { json!(there) };
                }
            }
        }
        scene
    }

    /// All lengths `s` times as long.
    pub fn enlarged(&self, s: f64) -> Scene {
        let mut scene = self.clone();
        lengthen(&mut scene.request, s);
        scene
    }
}

/// Multiplies every number whose name ends in `_m`, and all points of a survey.
fn lengthen(value: &mut Value, s: f64) {
    match value {
        Value::Object(object) => {
            for (key, entry) in object {
                match entry {
                    Value::Number(number) if key.ends_with("_m") && !key.contains("_n_per_m") => {
                        *entry = json!(number.as_f64().unwrap() * s);
                    }
                    Value::Array(points) if key.ends_with("_m") => {
                        let all = points.iter_mut().flat_map(|point| point.as_array_mut().unwrap());
                        all.for_each(|x| *x = json!(x.as_f64().unwrap() * s));
                    }
                    other => lengthen(other, s),
                }
            }
        }
        Value::Array(list) => list.iter_mut().for_each(|entry| lengthen(entry, s)),
        _ => {}
    }
}
