//! Walls in running bond that an earthquake shakes.

use serde_json::{Value, json};

/// A shaken wall in running bond: so many stones of this length and height in each of its courses, joints of this friction angle, and
/// stone of so many Pa.
pub fn shaken_wall(
    [length, height]: [f64; 2],
    [stones, courses]: [usize; 2],
    friction_deg: f64,
    strength: f64,
) -> Value {
    let course = |j: usize| {
        let half = if j.is_multiple_of(2) { 0.0 } else { 0.5 };
        let ends = (0..=stones).map(|k| k as f64 - half).chain([stones as f64]);
        let mut ends: Vec<f64> = ends.map(|end| end.clamp(0.0, stones as f64)).collect();
        ends.dedup();
        let [low, high] = [j, j + 1].map(|j| j as f64 * height);
        let stone = |ends: &[f64]| {
            let [left, right] = [ends[0], ends[1]].map(|end| end * length);
            json!({"corners_m": [[left, low], [right, low], [right, high], [left, high]]})
        };
        ends.windows(2).map(stone).collect::<Vec<_>>()
    };
    let mut polygons: Vec<Value> = (0..courses).flat_map(course).collect();
    polygons.iter_mut().enumerate().for_each(|(k, stone)| stone["name"] = json!(format!("b{k}")));
    json!({
        "blocks": {
            "polygons": polygons,
            "supports": [{"name": "ground", "segments_m": [[[-1.0, 0.0], [length * stones as f64 + 1.0, 0.0]]]}],
        },
        "stone": {"friction_angle_deg": friction_deg, "compressive_strength_pa": strength},
        "loads": [{"load": {"self_weight": {}}}, {"load": {"body_acceleration": {"x_g": 1.0}}, "scaled": true}],
    })
}
