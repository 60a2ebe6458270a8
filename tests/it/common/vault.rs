//! A vault of two rings with a load on its left half.

use serde_json::{Value, json};

/// Of so many stones in either ring, 10 m wide at most, with joints of this friction, in degrees, and 1 kN/m at `x`, m from the crown.
pub fn vault(stones: [usize; 2], friction: f64, x: f64) -> Value {
    let rings = stones.map(|voussoirs| json!({"thickness_m": 0.5, "voussoirs": voussoirs}));
    let span = json!({"profile": {"circular": {"radius_m": 5, "opening_angle_deg": 150}}, "rings": rings});
    json!({
        "bridge": {"spans": [span]}, "stone": {"friction_angle_deg": friction},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"point_load": {"force_n_per_m": 1000, "x_m": x}}, "scaled": true},
        ],
    })
}
