//! Good requests that together have something of everything.

use serde_json::{Value, json};

/// `request` with the value at `pointer` replaced or, where its parent is an object, added.
pub fn with(mut request: Value, pointer: &str, value: Value) -> Value {
    let Some((parent, key)) = pointer.rsplit_once('/') else { return value };
    match request.pointer_mut(parent).unwrap_or_else(|| panic!("no {parent}")) {
        Value::Object(object) => drop(object.insert(key.to_owned(), value)),
        Value::Array(list) => list[key.parse::<usize>().unwrap()] = value,
        other => panic!("{other} has no members"),
    }
    request
}

/// `request` without the value at `pointer`.
pub fn without(mut request: Value, pointer: &str) -> Value {
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    match request.pointer_mut(parent).unwrap() {
        Value::Object(object) => drop(object.remove(key)),
        Value::Array(list) => drop(list.remove(key.parse().unwrap())),
        other => panic!("{other} has no members"),
    }
    request
}

fn arch() -> Value {
    json!({
        "name": "all of it", "width_m": 5,
        "arch": {
            "profile": {"circular": {"radius_m": 4.0, "opening_angle_deg": 150}},
            "line": "axis", "thickness": {"constant_m": 0.6}, "voussoirs": 12, "joints": "normal",
            "relative_lengths": [1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1], "curved_sides": false,
            "abutments": {"height_m": 1.0}, "springing_joints": "dry", "half": false,
            "stone_of": [{"from": 0, "to": 3, "stone": "brick"}]
        },
        "stones": [{"name": "brick", "density_kg_m3": 1800}],
        "stone": {
            "density_kg_m3": 2000, "youngs_modulus_pa": 2e9, "poissons_ratio": 0.2, "friction_angle_deg": 35,
            "cohesion_pa": 10, "compressive_strength_pa": 2e7, "plane": "strain", "penalty_ratio": 5,
            "shear_penalty_ratio": 2
        },
        "joint_overrides": [{
            "joint": 6, "friction_angle_deg": 20, "cohesion_pa": 5, "lost_at_intrados_m": 0.02, "lost_at_extrados_m": 0.03
        }],
        "mesh": {"subblocks": {"uniform": {"radial": 2, "along": 3}}, "seams": "split", "order": 1, "lines": "graded"},
        "loads": [
            {"load": {"self_weight": {}}, "scaled": false, "coefficient": 1.5, "per_abscissa": false},
            {"load": {"fill_pressure": {
                "fill_height_m": 8.0, "fill_density_kg_m3": 1500, "embankment_thickness_m": 0.5,
                "embankment_density_kg_m3": 1700, "lateral_ratio": 0.5, "fill_friction_angle_deg": 30
            }}},
            {"load": {"point_load": {"force_n_per_m": 1000, "x_m": -1}}, "scaled": true},
            {"load": {"point_load": {"force_n_per_m": 1000, "voussoir": 5, "inclination_deg": 10}}},
            {"load": {"patch_load": {"centre_x_m": 1, "width_m": 1, "force_n_per_m": 1000}}},
            {"load": {"patch_load": {"centre_x_m": 1, "width_m": 1, "force_n_per_m": 1000, "dispersal": {
                "surface_height_m": 8.5, "distribution": {"boussinesq": {"cut_off_deg": 40}}}}}},
            {"load": {"patch_load": {"centre_x_m": 1, "width_m": 1, "force_n_per_m": 1000, "dispersal": {
                "surface_height_m": 8.5, "distribution": {"uniform": {"spread": 0.4}}}}}},
            {"load": {"vehicle": {
                "axles": [{"offset_m": -1, "force_n": 1000, "length_m": 0.3, "factor": 1.5}], "x_m": 1, "reversed": true,
                "effective_width_m": 2, "effective_width_rule": "a lane",
                "dispersal": {"surface_height_m": 8.5, "distribution": {"boussinesq": {}}}}}},
            {"load": {"lateral_pressure": {"bands": [{"from_m": 0, "to_m": 1, "pressure_pa": 100}], "side": "right"}}},
            {"load": {"body_acceleration": {"x_g": 0.1, "y_g": 0.1}}}
        ],
        "analysis": "collapse",
        "load_factor": {"direction": "increase", "cap": 1000, "unit": "kN", "intensity_per_unit": 1},
        "method": {"fixed_steps": {"step": 1, "opening_m": 0.01, "hinges": 3}},
        "geometry": "first_order",
        "crushing_in_path": false,
        "report": {"share_of_collapse": 0.99, "stress_fields": [{"load_factor": 2}, "unit_load", "near_collapse"], "first_yield_length_m": 5, "history": true},
        "motion": {"most_frames": 10, "share_of_span": 0.1, "ground_level_m": -50}
    })
}

fn safety() -> Value {
    let curve = json!({"abscissae": [1, 2], "unit": "m"});
    let request = with(arch(), "/analysis", json!({"safety": {"crushing": "elastic", "curve": curve}}));
    let request = with(with(request, "/method", json!("event_path")), "/report/stress_fields", json!([]));
    let request = with(request, "/report/history", json!(false));
    without(with(request, "/loads/0/per_abscissa", json!(true)), "/motion")
}

fn accurate() -> Value {
    let accuracy = json!({"collapse_intensity": 1e-3, "stress": 0.5, "subblocks": 1000});
    let request = ["/mesh", "/motion", "/method"].into_iter().fold(arch(), without);
    with(request, "/accuracy", accuracy)
}

fn settlement() -> Value {
    let movement = json!({"outwards_m": 0.01, "downwards_m": 0.01, "rotation_deg": 1});
    let request = with(arch(), "/analysis", json!({"settlement": {"left": movement, "right": movement}}));
    let request = ["/report", "/motion", "/method", "/load_factor"].into_iter().fold(request, without);
    with(request, "/loads/2/scaled", json!(false))
}

fn geometric_safety() -> Value {
    with(settlement(), "/analysis", json!({"geometric_safety": {}}))
}

fn driven() -> Value {
    let asked = json!({"from_m": -2, "to_m": 2, "step_m": 0.5, "tolerance": 1e-3, "directions": "both"});
    let vehicle = json!({"vehicle": {
        "standard": "cs454_bogie_8t", "length_m": 0.3, "effective_width_m": 2, "effective_width_rule": "a lane",
        "dispersal": {"surface_height_m": 8.5, "distribution": {"uniform": {"spread": 0.4}}}
    }});
    let request = with(arch(), "/analysis", json!({"worst_position": asked}));
    with(request, "/loads/2", json!({"load": vehicle, "scaled": true}))
}

fn surveyed() -> Value {
    let intrados = json!([[-1, 0], [0, 1], [1, 0]]);
    let extrados = json!([[-2, 0], [0, 2], [2, 0]]);
    json!({
        "arch": {"profile": {"surveyed": {"intrados_m": intrados, "extrados_m": extrados}}},
        "loads": [{"load": {"self_weight": {}}}]
    })
}

fn surveyed_intrados() -> Value {
    with(without(surveyed(), "/arch/profile/surveyed/extrados_m"), "/arch/profile/surveyed/thickness_m", json!(0.5))
}

fn measured() -> Value {
    let row = |radius: f64| {
        (0..9)
            .map(|k| 0.125 * std::f64::consts::PI * f64::from(8 - k))
            .map(move |a| [radius * a.cos(), radius * a.sin()])
    };
    let [intrados, extrados] = [2.0, 2.5].map(|radius| json!(row(radius).collect::<Vec<_>>()));
    let tolerances = json!([0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01]);
    json!({
        "arch": {"profile": {"surveyed": {"intrados_m": intrados, "extrados_m": extrados, "smoothing_length_m": 3}}},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"point_load": {"force_n_per_m": 1000, "x_m": 0.5}}, "scaled": true}
        ],
        "analysis": {"survey_tolerance": {"tolerance_m": 0.01, "intrados_m": tolerances, "extrados_m": tolerances}}
    })
}

fn blocks() -> Value {
    let corners = |y: f64| json!([[0, y], [1, y], [1, y + 1.0], [0, y + 1.0]]);
    json!({
        "name": "a wall",
        "blocks": {
            "polygons": [
                {"name": "low", "corners_m": corners(0.0), "stone": "rubble"},
                {"name": "high", "corners_m": corners(1.0)}
            ],
            "joints": "found",
            "supports": [{"name": "ground", "sides": [{"block": "low", "side": 0}]}],
            "tolerance_m": 1e-6
        },
        "stones": [{
            "name": "rubble", "density_kg_m3": 1900, "youngs_modulus_pa": 1e9, "poissons_ratio": 0.2,
            "friction_angle_deg": 25, "cohesion_pa": 10, "compressive_strength_pa": 1e6
        }],
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"point_force": {"block": "high", "at_m": [0, 1.5], "force_n_per_m": [100, -10]}}, "scaled": true},
            {"load": {"tie": {
                "force_n_per_m": 100, "from": {"block": "low", "at_m": [0.5, 0.5]}, "to": {"block": "high", "at_m": [0.5, 1.5]}
            }}}
        ]
    })
}

fn sinking() -> Value {
    let movement = json!({
        "support": "ground", "rightwards_m": 0.01, "downwards_m": 0.01, "rotation_deg": 1, "about_m": [0.5, 0]
    });
    json!({
        "blocks": blocks()["blocks"],
        "stones": blocks()["stones"],
        "loads": [{"load": {"self_weight": {}}}],
        "analysis": {"settlement": {"supports": [movement]}},
    })
}

fn given() -> Value {
    let joints = json!([
        {"between": ["low", "high"], "ends_m": [[0, 1], [1, 1]], "friction_angle_deg": 30, "cohesion_pa": 5, "bonded": false},
        {"between": ["ground", "low"], "ends_m": [[0, 0], [1, 0]], "bonded": true}
    ]);
    let request = with(blocks(), "/blocks/joints", json!({"given": joints}));
    let request = with(request, "/blocks/supports/0/sides", json!([]));
    with(request, "/stones/0/name", json!("rubble"))
}

fn on_a_line() -> Value {
    with(without(blocks(), "/blocks/supports/0/sides"), "/blocks/supports/0/segments_m", json!([[[-1, 0], [2, 0]]]))
}

fn bridge() -> Value {
    let rings = || json!([{"thickness_m": 0.3, "springing_thickness_m": 0.4, "voussoirs": 7, "stone": "rubble"}]);
    let span = |profile: Value| json!({"profile": profile, "rings": rings()});
    let oval = json!({"multi_centre": {"arcs": [{"radius_m": 1, "angle_deg": 40}, {"radius_m": 2, "angle_deg": 50}]}});
    let spans = vec![
        span(json!({"circular": {"radius_m": 2, "opening_angle_deg": 150}})),
        span(json!({"circular": {"span_m": 4, "rise_m": 1.5}})),
        span(json!({"pointed": {"radius_m": 2, "centre_offset_m": 0.2}})),
        span(json!({"pointed": {"span_m": 4, "rise_m": 2.2}})),
        span(json!({"elliptical": {"span_m": 4, "rise_m": 1.5}})),
        span(oval),
    ];
    let pier = json!({"top_width_m": 1.5, "height_m": 3, "courses": 2, "batter": 0.05, "stone": "rubble"});
    let abutment = json!({"height_m": 2, "width_m": 1.5, "stone": "rubble"});
    json!({
        "bridge": {
            "spans": spans, "piers": vec![pier; 5], "abutments": {"left": abutment, "right": abutment},
            "backing": {"level_m": 1, "stone": "rubble"}, "ring_friction_angle_deg": 30
        },
        "stones": [{"name": "rubble"}],
        "backfill": {
            "surface_m": [[-20, 3], [0, 4], [20, 3]], "density_kg_m3": 1800, "lateral_ratio": 0.3,
            "layers": [{"thickness_m": 0.1, "density_kg_m3": 2300}], "backing": {"height_m": 1.5, "density_kg_m3": 2000},
            "dispersal": {"boussinesq": {"cut_off_deg": 40}}
        },
        "partial_factors": {"dead": 1.2, "fill": 1.3, "live": 1.5, "stone_strength": 2, "soil_resistance": 1},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"point_load": {"force_n_per_m": 1000, "x_m": -5}}, "scaled": true}
        ]
    })
}

/// A level road over fill that resists.
fn level() -> Value {
    let resisting = json!({
        "surface_height_m": 4, "backing": {"height_m": 1.5, "density_kg_m3": 2000, "resistance_pa": 5e4},
        "passive": {
            "friction_angle_deg": 35, "cohesion_pa": 2000, "factor": 0.6, "cohesion_factor": 0.4, "least": "active",
            "mobilisation_share_of_depth": 0.02
        },
        "dispersal": {"uniform": {"spread": 0.4}}
    });
    with(bridge(), "/backfill", resisting)
}

fn beam() -> Value {
    json!({
        "name": "a beam",
        "curved_beam": {
            "inner_radius_m": 0.5, "outer_radius_m": 0.7, "end_shear_n_per_m": 2500, "curved_sides": true
        },
        "stone": arch()["stone"].take(),
        "mesh": {"subblocks": {"uniform": {"radial": 3, "along": 4}}, "seams": "corners", "order": 1, "lines": "graded"}
    })
}

fn accurate_beam() -> Value {
    with(without(beam(), "/mesh"), "/accuracy", json!({"stress": 0.1}))
}

/// All of them. The curved beam takes no `per_voussoir`, so that no good request has all the schema allows it.
pub fn bodies() -> Vec<Value> {
    let change = |changes: &[(&str, Value)]| {
        changes.iter().fold(arch(), |request, (pointer, value)| with(request, pointer, value.clone()))
    };
    let oval = json!({"multi_centre": {"arcs": [{"radius_m": 3, "angle_deg": 40}, {"radius_m": 6, "angle_deg": 50}]}});
    let circle = json!({"extrados_circle": {"radius_m": 5, "centre_y_m": -0.1}});
    let each: Vec<_> = (1..=12).map(|k| json!({"radial": k, "along": 1})).collect();
    vec![
        arch(),
        change(&[("/arch/profile", json!({"circular": {"span_m": 8, "rise_m": 3}}))]),
        change(&[("/arch/profile", json!({"pointed": {"radius_m": 5, "centre_offset_m": 1}}))]),
        change(&[("/arch/profile", json!({"pointed": {"span_m": 8, "rise_m": 4.5}}))]),
        change(&[("/arch/profile", json!({"elliptical": {"span_m": 8, "rise_m": 3}}))]),
        change(&[("/arch/profile", oval)]),
        change(&[("/arch/thickness", json!({"linear": {"crown_m": 0.6, "springing_m": 0.8}}))]),
        change(&[("/arch/thickness", circle), ("/arch/line", json!("intrados"))]),
        change(&[("/arch/joints", json!({"rays": {"centre_m": [0, -0.5]}}))]),
        change(&[("/mesh/subblocks", json!({"per_voussoir": each}))]),
        safety(),
        accurate(),
        settlement(),
        geometric_safety(),
        driven(),
        surveyed(),
        surveyed_intrados(),
        measured(),
        blocks(),
        sinking(),
        given(),
        on_a_line(),
        bridge(),
        level(),
        beam(),
        accurate_beam(),
    ]
}
