//! What an analysis takes, against what it was estimated to take before it began.

use crate::common::semicircle::{mesh, semicircle};
use serde_json::{Value, json};
use std::io::Write;
use std::process::{Command, Stdio};
use std::time::Duration;
use voussoir::collapse::cost::{Demand, Share, estimate};
use voussoir::wire::read::read_question;

const MIB: usize = 1 << 20;
/// What the program takes before it has read anything, and a little more.
const PROGRAM: usize = 24 * MIB;

fn demand(request: &Value) -> Demand {
    estimate(&read_question(request.to_string().as_bytes()).unwrap().1)
}

/// Most memory that `voussoir solve` had resident while it answered a request and wrote every form of the answer, bytes.
#[cfg(target_os = "linux")]
#[allow(clippy::disallowed_methods, reason = "a process is looked at now and then until it has ended")]
fn peak(request: &Value) -> usize {
    let mut command = Command::new(env!("CARGO_BIN_EXE_voussoir"));
    command.args(["solve", "-"]).stdin(Stdio::piped()).stdout(Stdio::null());
    let mut child = command.spawn().unwrap();
    child.stdin.take().unwrap().write_all(request.to_string().as_bytes()).unwrap();
    let (file, mut peak) = (format!("/proc/{}/status", child.id()), 0);
    while child.try_wait().unwrap().is_none() {
        // Without the line it has ended.
        let status = std::fs::read_to_string(&file).unwrap_or_default();
        let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        peak = line.map_or(peak, |line| 1024 * line.trim().trim_end_matches(" kB").parse::<usize>().unwrap());
        std::thread::sleep(Duration::from_millis(1));
    }
    assert!(child.wait().unwrap().success());
    peak
}

/// An arch of which no two stones are alike.
fn uneven(voussoirs: usize, more: &Value) -> Value {
    let mut request = semicircle(voussoirs, more);
    request["arch"]["thickness"] = json!({"linear": {"crown_m": 1.5, "springing_m": 2.0}});
    request
}

/// A wall of courses of so many blocks, every second one shifted by half a block.
fn wall(columns: usize, courses: usize, more: &Value) -> Value {
    let mut polygons = Vec::new();
    for course in 0..courses {
        let (y, shift) = (0.5 * course as f64, 0.5 * (course % 2) as f64);
        let edge = |i: usize| (i as f64 - shift).clamp(0.0, columns as f64);
        for i in 0..columns + course % 2 {
            let [left, right] = [edge(i), edge(i + 1)];
            let corners = [[left, y], [right, y], [right, y + 0.5], [left, y + 0.5]];
            polygons.push(json!({"name": format!("{course}.{i}"), "corners_m": corners}));
        }
    }
    let supports = json!([{"name": "ground", "segments_m": [[[-1.0, 0.0], [columns as f64 + 1.0, 0.0]]]}]);
    let push = json!({"load": {"body_acceleration": {"x_g": 0.3}}, "scaled": true});
    let mut request = json!({
        "blocks": {"polygons": polygons, "supports": supports},
        "loads": [{"load": {"self_weight": {}}}, push],
    });
    for (name, value) in more.as_object().unwrap() {
        request[name] = value.clone();
    }
    request
}

/// So many blocks in a row on one slab.
fn slab(blocks: usize, more: &Value) -> Value {
    let n = blocks as f64;
    let mut polygons = vec![json!({"name": "slab", "corners_m": [[0.0, 0.0], [n, 0.0], [n, 1.0], [0.0, 1.0]]})];
    polygons.extend((0..blocks).map(|i| {
        let x = i as f64;
        json!({"name": i.to_string(), "corners_m": [[x, 1.0], [x + 1.0, 1.0], [x + 1.0, 2.0], [x, 2.0]]})
    }));
    let mut request = wall(1, 1, more);
    request["blocks"]["polygons"] = polygons.into();
    request["blocks"]["supports"][0]["segments_m"] = json!([[[-1.0, 0.0], [n + 1.0, 0.0]]]);
    request
}

/// An axle at positions so far apart on fill, of which it loads many stones at a time.
fn driven(voussoirs: usize, step: f64) -> Value {
    let vehicle = json!({"vehicle": {
        "axles": [{"offset_m": 0, "force_n": 1000, "length_m": 0.3}], "effective_width_m": 1, "effective_width_rule": "one metre",
        "dispersal": {"surface_height_m": 15, "distribution": {"uniform": {}}}
    }});
    let loads = json!([{"load": {"self_weight": {}}}, {"load": vehicle, "scaled": true}]);
    semicircle(voussoirs, &json!({"loads": loads, "analysis": {"worst_position": {"step_m": step}}}))
}

#[test]
#[cfg(target_os = "linux")]
fn no_analysis_takes_more_than_its_estimate() {
    let fields = json!(["near_collapse", {"load_factor": 1.0}]);
    let motion = json!({"motion": {"most_frames": 1600, "share_of_span": 1.0}});
    let sticky = json!({"stone": {"cohesion_pa": 1.0}, "report": {"share_of_collapse": 0.001}});
    for (name, request) in [
        ("few stones", semicircle(27, &json!({}))),
        ("many stones, path traced", semicircle(1000, &sticky)),
        ("stones of many subblocks", uneven(11, &json!({"mesh": mesh(16, 16)}))),
        ("wide joints", uneven(9, &json!({"mesh": mesh(40, 1)}))),
        ("long stones, stress", uneven(60, &json!({"mesh": mesh(1, 48), "report": {"stress_fields": fields}}))),
        ("moving geometry", uneven(31, &json!({"mesh": mesh(3, 3), "geometry": "updated"}))),
        ("wall", wall(8, 8, &json!({}))),
        ("slab", slab(100, &json!({}))),
        ("slab of subblocks, no two stones alike", slab(9, &json!({"mesh": mesh(27, 16), "analysis": {"safety": {}}}))),
        ("frames", slab(27, &motion)),
        ("positions", driven(100, 0.05)),
        ("wall of subblocks", wall(4, 6, &json!({"mesh": mesh(6, 6)}))),
    ] {
        let (estimated, taken) = (demand(&request).memory, peak(&request));
        println!("{name}: {} MiB, estimated {}", taken / MIB, estimated / MIB);
        assert!(taken < estimated + PROGRAM, "{name}: {} MiB, estimated {}", taken / MIB, estimated / MIB);
        assert!(estimated < 4 * taken + PROGRAM, "{name}: {} MiB, estimated {}", taken / MIB, estimated / MIB);
    }
}

/// Up to 64 whole stones in a row are not counted.
#[test]
fn a_short_row_is_said_to_take_somewhat_more_than_a_longer_one() {
    for more in [
        json!({}),
        json!({"report": {"stress_fields": ["near_collapse"]}}),
        json!({"report": {"share_of_collapse": 0.001}}),
        json!({"analysis": {"safety": {}}}),
    ] {
        let [short, long] = [64, 65].map(|voussoirs| demand(&uneven(voussoirs, &more)).memory);
        assert!(long <= short && short < long + MIB, "{short} and {long} bytes, {more}");
    }
}

#[test]
fn what_takes_most_is_told() {
    let loads = json!([
        {"load": {"self_weight": {}}},
        {"load": {"point_load": {"force_n_per_m": 1000.0, "x_m": -5.0}}, "scaled": true, "per_abscissa": true},
    ]);
    let abscissae: Vec<f64> = (1..=120).map(|i| 0.1 * f64::from(i)).collect();
    let curve = json!({"loads": loads, "analysis": {"safety": {"curve": {"abscissae": abscissae}}}});
    let fields = json!([{"load_factor": 1.0}, {"load_factor": 2.0}, "near_collapse"]);
    for (request, largest) in [
        (semicircle(500, &json!({})), Share::Stones),
        (uneven(100, &json!({"mesh": mesh(48, 1)})), Share::Mesh),
        (semicircle(1000, &json!({"mesh": mesh(1, 48), "report": {"stress_fields": fields}})), Share::Fields),
        (semicircle(20, &json!({"motion": {"most_frames": 3000, "share_of_span": 1.0}})), Share::Frames),
        (semicircle(2000, &curve), Share::Points),
        (driven(1000, 0.02), Share::Points),
    ] {
        assert_eq!(demand(&request).largest, largest, "{request}");
    }
}

#[test]
fn an_estimate_grows_with_what_is_asked() {
    // 345 bytes that take more than any machine should give.
    let worst = demand(&uneven(2001, &json!({"mesh": mesh(48, 1)})));
    assert!(worst.memory > 5_000_000_000, "{worst:?}");
    let of = |request: &Value| demand(request).memory;
    assert!(of(&uneven(100, &json!({"mesh": mesh(8, 8)}))) > of(&semicircle(100, &json!({"mesh": mesh(8, 8)}))));
    assert!(of(&wall(20, 20, &json!({}))) > of(&wall(10, 10, &json!({}))));
    // Bodies that many others touch.
    let [large, small] = [1000, 400].map(|blocks| of(&slab(blocks, &json!({}))));
    assert!(large > 3 * small, "{large} {small}");
}

#[test]
#[cfg(target_os = "linux")]
fn what_would_run_if_few_joints_crush_is_told_apart() {
    let stone = json!({"compressive_strength_pa": 2e6});
    let more = |name: &str, value: Value| {
        let mut more = json!({"crushing_in_path": true, "stone": stone});
        more[name] = value;
        more
    };
    let arch = semicircle(1000, &more("name", json!("many stones")));
    let Demand { memory, uncrushed, .. } = demand(&arch);
    let taken = peak(&arch);
    assert!(taken < uncrushed + PROGRAM && uncrushed < 4 * taken + PROGRAM && 8 * uncrushed < memory);
    // Nothing stands, so that any joint may crush.
    let wall = wall(6, 6, &more("loads", json!([{"load": {"body_acceleration": {"x_g": 0.3}}, "scaled": true}])));
    let (Demand { memory, .. }, taken) = (demand(&wall), peak(&wall));
    assert!(taken < memory + PROGRAM, "{} MiB, estimated {}", taken / MIB, memory / MIB);
}

#[test]
fn stones_that_differ_in_any_stiffness_are_of_different_kinds() {
    let arch = |of: &dyn Fn(usize) -> Value| {
        let stones: Vec<Value> = (0..40).map(of).collect();
        let stone_of: Vec<Value> = (0..40).map(|k| json!({"from": k, "to": k, "stone": k.to_string()})).collect();
        let mut request = semicircle(40, &json!({"mesh": mesh(12, 12), "stones": stones}));
        request["arch"]["stone_of"] = json!(stone_of);
        demand(&request).memory
    };
    let of = |name: &str, least: f64, step: f64| {
        arch(&|k: usize| json!({"name": k.to_string(), (name): least + step * k as f64}))
    };
    let [modulus, ratio, density] =
        [of("youngs_modulus_pa", 1e9, 1e7), of("poissons_ratio", 0.1, 0.005), of("density_kg_m3", 2000.0, 10.0)];
    assert!(modulus == ratio && density < modulus / 2, "{modulus} {ratio} {density}");
}
