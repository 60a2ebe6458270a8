//! A semicircle in every size, and meshes for it.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use serde_json::{Value, json};

/// A semicircle of so many voussoirs under its weight and a load at the quarter point, with `more`.
pub fn semicircle(voussoirs: usize, more: &Value) -> Value {
    let mut request = json!({
        "arch": {
            "profile": {"circular": {"radius_m": 10.0, "opening_angle_deg": 180.0}},
            "thickness": {"constant_m": 1.5},
            "voussoirs": voussoirs,
        },
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"point_load": {"force_n_per_m": 1000.0, "x_m": -5.0}}, "scaled": true},
        ],
    });
    for (name, value) in more.as_object().unwrap() {
        request[name] = value.clone();
    }
    request
}

/// As many subblocks in every voussoir.
pub fn mesh(radial: usize, along: usize) -> Value {
    json!({"subblocks": {"uniform": {"radial": radial, "along": along}}})
}
