//! Requests that cannot be, each broken in one place.

use serde_json::{Value, json};

/// Where a request is changed, what is put there (null: taken away), and where the fault is to be found.
type Row = (&'static str, Value, &'static str);

/// The rows. The request they change is [`super::request`].
fn rows() -> Vec<Row> {
    let arch = "/arch";
    vec![
        ("", json!([]), ""),
        ("", json!("an arch"), ""),
        ("/unheard_of", json!(1), "/unheard_of"),
        ("/arch", Value::Null, "/arch"),
        ("/arch", json!(7), "/arch"),
        ("/arch/unheard_of", json!(1), "/arch/unheard_of"),
        ("/arch/profile", Value::Null, "/arch/profile"),
        ("/arch/profile", json!({"square": {}}), "/arch/profile"),
        ("/arch/profile", json!({"circular": {"radius_m": 5.0}}), "/arch/profile/circular"),
        ("/arch/profile/circular/radius_m", json!(-5.0), "/arch/profile/circular/radius_m"),
        ("/arch/profile/circular/radius_m", json!("5 m"), "/arch/profile/circular/radius_m"),
        ("/arch/profile/circular/opening_angle_deg", json!(400.0), "/arch/profile/circular/opening_angle_deg"),
        ("/arch/profile", json!({"elliptical": {"span_m": 4.0, "rise_m": 0.0}}), "/arch/profile/elliptical/rise_m"),
        ("/arch/profile", json!({"multi_centre": {"arcs": []}}), "/arch/profile/multi_centre"),
        ("/arch/thickness", Value::Null, "/arch/thickness"),
        ("/arch/thickness/constant_m", json!(0.0), "/arch/thickness"),
        ("/arch/thickness/constant_m", json!(-1.0), "/arch/thickness"),
        ("/arch/thickness/constant_m", json!(10.5), "/arch"),
        ("/arch/thickness", json!({"linear": {"crown_m": 0.5}}), "/arch/thickness"),
        ("/arch/voussoirs", Value::Null, "/arch/voussoirs"),
        ("/arch/voussoirs", json!(0), "/arch/voussoirs"),
        ("/arch/voussoirs", json!(1), "/arch/voussoirs"),
        ("/arch/voussoirs", json!(2002), "/arch/voussoirs"),
        ("/arch/voussoirs", json!(-3), "/arch/voussoirs"),
        ("/arch/voussoirs", json!(8.5), "/arch/voussoirs"),
        ("/arch/relative_lengths", json!([1.0, 2.0]), "/arch/relative_lengths"),
        ("/arch/joints", json!({"rays": {}}), "/arch/joints"),
        ("/arch/abutments", json!({"height_m": 0.0}), "/arch/abutments/height_m"),
        ("/arch/springing_joints", json!("welded"), "/arch/springing_joints"),
        ("/arch/half", json!("yes"), "/arch/half"),
        ("/stone/density_kg_m3", json!(0.0), "/stone/density_kg_m3"),
        ("/stone/youngs_modulus_pa", json!(-1e9), "/stone/youngs_modulus_pa"),
        ("/stone/poissons_ratio", json!(0.5), "/stone/poissons_ratio"),
        ("/stone/friction_angle_deg", json!(90.0), "/stone/friction_angle_deg"),
        ("/stone/friction_angle_deg", json!(-1.0), "/stone/friction_angle_deg"),
        ("/stone/cohesion_pa", json!(-1.0), "/stone/cohesion_pa"),
        ("/stone/compressive_strength_pa", json!(0.0), "/stone/compressive_strength_pa"),
        ("/stone/plane", json!("flat"), "/stone/plane"),
        ("/stone/penalty_ratio", json!(0.0), "/stone/penalty_ratio"),
        ("/stone/colour", json!("red"), "/stone/colour"),
        ("/joint_overrides", json!([{"joint": 18, "friction_angle_deg": 30.0}]), "/joint_overrides/0/joint"),
        ("/joint_overrides", json!([{"joint": 3}]), "/joint_overrides/0"),
        ("/loads", Value::Null, "/loads"),
        ("/loads", json!([]), "/loads"),
        ("/loads/0", json!({"load": {"snow": {}}}), "/loads/0"),
        ("/loads/0", json!({"load": {"fill_pressure": {}}}), "/loads/0"),
        ("/loads/0/coefficient", json!(0.0), "/loads/0"),
        ("/loads/1/scaled", json!(3), "/loads/1/scaled"),
        ("/loads/1/load/point_load/voussoir", json!(17), "/loads/1/load/point_load"),
        ("/loads/1/load/point_load/voussoir", Value::Null, "/loads/1/load/point_load"),
        ("/loads/1/load/point_load/x_m", json!(1.0), "/loads/1/load/point_load"),
        ("/loads/1/load/point_load/force_n_per_m", json!(0.0), "/loads/1"),
        ("/load_factor/direction", json!("sideways"), "/load_factor/direction"),
        ("/load_factor/cap", json!(-1.0), "/load_factor/cap"),
        ("/load_factor/intensity_per_unit", json!(0.0), "/load_factor/intensity_per_unit"),
        ("/load_factor/unit", json!("x".repeat(201)), "/load_factor/unit"),
        ("/method", json!("by_eye"), "/method"),
        ("/method", json!({"fixed_steps": {"step": 0.0}}), "/method/fixed_steps/step"),
        ("/report", json!({"share_of_collapse": 1.0}), "/report/share_of_collapse"),
        ("/report", json!({"stress_fields": ["everywhere"]}), "/report/stress_fields"),
        ("/report", json!({"stress_fields": [{"load_factor": 1e13}]}), "/report/stress_fields/0/load_factor"),
        ("/stone/compressive_strength_pa", json!(10.0), "/stone/compressive_strength_pa"),
        ("/mesh", json!({"subblocks": {"uniform": {"radial": 0, "along": 1}}}), "/mesh/subblocks/uniform/radial"),
        ("/mesh", json!({"subblocks": {"uniform": {"radial": 1, "along": 49}}}), "/mesh/subblocks/uniform/along"),
        ("/mesh", json!({"subblocks": {"per_voussoir": []}}), "/mesh/subblocks/per_voussoir"),
        ("/mesh", json!({"seams": "glue"}), "/mesh/seams"),
        ("/analysis", json!("safety"), "/analysis"),
        ("/analysis", json!({"safety": {"curve": {"abscissae": [2, 1]}}}), "/analysis/safety/curve/abscissae/1"),
        ("/analysis", json!({"safety": {"curve": {"abscissae": [1, 2]}}}), "/analysis/safety/curve"),
        ("/loads/1/per_abscissa", json!(true), "/loads/1/per_abscissa"),
        ("/curved_beam", json!({}), "/curved_beam/inner_radius_m"),
        (arch, json!({"profile": {"surveyed": {"intrados_m": [[0, 0]], "extrados_m": [[0, 1]]}}}), "/arch/profile"),
    ]
}

/// Every broken request with the place of its fault.
pub fn requests() -> Vec<(String, &'static str)> {
    rows().into_iter().map(|(at, value, fault)| (changed(at, value).to_string(), fault)).collect()
}

fn changed(at: &str, value: Value) -> Value {
    let mut request = super::request();
    let Some((parent, key)) = at.rsplit_once('/') else { return value };
    match request.pointer_mut(parent).unwrap_or_else(|| panic!("{parent} is in the request")) {
        Value::Object(object) if value.is_null() => drop(object.remove(key)),
        Value::Object(object) => drop(object.insert(key.to_owned(), value)),
        Value::Array(list) => list[key.parse::<usize>().unwrap()] = value,
        other => panic!("{other} has no members"),
    }
    request
}
