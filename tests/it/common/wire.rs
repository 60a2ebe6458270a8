//! Requests of the reference arches, as wire JSON.

use serde_json::{Value, json};

/// Weight per area of every reference arch, N/m3 (so many times the unit weight of the tables).
pub const GAMMA: f64 = 1000.0;
/// Friction angle at which nothing slides, degrees.
pub const ROUGH: f64 = 88.0;

/// A circular arch of mean radius 1.
pub fn circular(half_deg: f64, thickness: f64, count: usize) -> Value {
    json!({
        "profile": {"circular": {"radius_m": 1.0, "opening_angle_deg": 2.0 * half_deg}},
        "thickness": {"constant_m": thickness},
        "voussoirs": count,
    })
}

/// The same with true annular sectors, so many that the joints are continuous.
pub fn continuous(half_deg: f64, thickness: f64) -> Value {
    sectors(half_deg, thickness, 300)
}

/// Annular sectors.
pub fn sectors(half_deg: f64, thickness: f64, count: usize) -> Value {
    let mut arch = circular(half_deg, thickness, count);
    arch["curved_sides"] = json!(true);
    arch
}

/// Half ellipse of half span 1 as axis.
pub fn elliptical(rise: f64, thickness: f64, count: usize) -> Value {
    json!({
        "profile": {"elliptical": {"span_m": 2.0, "rise_m": rise}},
        "thickness": {"constant_m": thickness},
        "voussoirs": count,
    })
}

/// Two arcs of mean radius 1. The reference rows divide each half at equal angles from the springing to the apex of
/// the INTRADOS; between the last of these joints and the crown joint lies a shorter stone.
pub fn pointed(centre: f64, thickness: f64, per_half: usize) -> Value {
    let angle = (centre / (1.0 - thickness / 2.0)).acos();
    let step = angle / per_half as f64;
    let mut half = vec![step; per_half];
    half[per_half - 1] = centre.acos() - angle + step;
    let lengths: Vec<f64> = half.iter().chain(half.iter().rev()).copied().collect();
    json!({
        "profile": {"pointed": {"radius_m": 1.0, "centre_offset_m": centre}},
        "thickness": {"constant_m": thickness},
        "voussoirs": 2 * per_half,
        "relative_lengths": lengths,
    })
}

/// A request about an arch of weight `GAMMA`, joints of friction `mu_deg`, self weight fixed and `scaled` loads.
pub fn ask(arch: Value, friction_deg: f64, scaled: &[Value]) -> Value {
    let mut loads = vec![json!({"load": {"self_weight": {}}})];
    loads.extend(scaled.iter().map(|load| json!({"load": load, "scaled": true})));
    json!({
        "arch": arch,
        "stone": {"density_kg_m3": GAMMA / 9.81, "friction_angle_deg": friction_deg},
        "loads": loads,
    })
}

/// `GAMMA` newtons on the middle of a voussoir's extrados.
pub fn point(voussoir: usize) -> Value {
    json!({"point_load": {"force_n_per_m": GAMMA, "voussoir": voussoir}})
}

/// One g to the right.
pub fn lateral() -> Value {
    json!({"body_acceleration": {"x_g": 1.0}})
}

/// The ring of `buried_arch_jacks.json`: mean radius and thickness a tenth of it, fill and two jacks of 1 kN/m2.
pub fn buried(radius: f64, joints: usize) -> Value {
    let jack = |x: f64| {
        let patch = json!({"patch_load": {"centre_x_m": x, "width_m": 1.5, "force_n_per_m": 1500.0}});
        json!({"load": patch, "scaled": true})
    };
    let fill = json!({"fill_pressure": {"fill_height_m": 4.65, "fill_density_kg_m3": 1600.0, "lateral_ratio": 0.5}});
    json!({
        "arch": {
            "profile": {"circular": {"radius_m": radius, "opening_angle_deg": 180.0}},
            "thickness": {"constant_m": radius / 10.0},
            "voussoirs": joints - 1,
        },
        "loads": [{"load": {"self_weight": {}}}, {"load": fill}, jack(1.5), jack(-1.5)],
        "load_factor": {"unit": "kN/m2", "intensity_per_unit": 1},
    })
}

/// The estimated arch of `paper_case1.json`; load factor = q0 in kN/m.
pub fn paper_case_1(joints: usize) -> Value {
    let (top, foot) = (4.3 + 0.35, 4.3 + 1.01);
    let drop: f64 = (foot * foot - top * top) / (2.0 * top);
    let mut request = buried(1.0, joints);
    request["arch"] = json!({
        "profile": {"circular": {"radius_m": 4.3, "opening_angle_deg": 180.0}},
        "line": "intrados",
        "thickness": {"extrados_circle": {"radius_m": top + drop, "centre_y_m": -drop}},
        "voussoirs": joints - 1,
        "abutments": {"height_m": 1.0},
    });
    for jack in [2, 3] {
        request["loads"][jack]["load"]["patch_load"]["force_n_per_m"] = json!(1675.0);
    }
    request
}

/// The estimated oval of `paper_oval.json`, half of it, under fill up to 8.2 m and further loads.
pub fn oval(loads: &[Value]) -> Value {
    let arcs = [(3.25, 50.0), (7.3, 60.0), (3.5, 15.0)].map(|(r, a)| json!({"radius_m": r, "angle_deg": a}));
    let fill = json!({"fill_pressure": {"fill_height_m": 8.2, "fill_density_kg_m3": 1600.0, "lateral_ratio": 0.5}});
    let mut all = vec![json!({"load": {"self_weight": {}}}), json!({"load": fill})];
    all.extend_from_slice(loads);
    json!({
        "arch": {
            "profile": {"multi_centre": {"arcs": arcs}},
            "thickness": {"linear": {"crown_m": 0.42, "springing_m": 0.7}},
            "voussoirs": 16,
            "half": true,
        },
        "loads": all,
    })
}

/// Embankment of 1 m of the given density.
pub fn embankment(density: f64) -> Value {
    json!({"fill_pressure": {
        "embankment_thickness_m": 1.0, "embankment_density_kg_m3": density, "lateral_ratio": 0.5,
    }})
}
