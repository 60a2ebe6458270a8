//! Backfill: layers under a road over an arch or a bridge, their weight and mass, and loads on the road.

use crate::common::answered::text;
use crate::common::door::{self, faults};
use crate::common::folders;
use crate::common::masonry::Ring;
use crate::common::oracle::{Point, Push};
use crate::contract::bodies::with as change;
use crate::dispersal::{STRENGTH, SUMMED, Strip, UNIT_WEIGHT, boussinesq, close, expected, found, landed, ring};
use serde_json::{Value, json};
use voussoir::collapse::Analysis;
use voussoir::geometry::Vec2;
use voussoir::structure::{PointForce, resultants};
use voussoir::wire::prose::Digits;
use voussoir::wire::read::read;

/// Columns to a stone.
const COLUMNS: usize = 1000;
/// Summing over columns costs so much, relative.
const IN_COLUMNS: f64 = 1e-6;

/// What the folder of the case has.
fn case() -> Value {
    serde_json::from_slice(&std::fs::read(folders::cases().join("filled-bridge/request.json")).unwrap()).unwrap()
}

/// The road of the case.
fn road(x: f64) -> f64 {
    match x {
        _ if x < -4.5 => 1.4,
        _ if x < -0.4 => 1.4 + 0.5 * (x + 4.5) / 4.1,
        _ if x < 4.5 => 1.9 - 0.3 * (x + 0.4) / 4.9,
        _ => 1.6,
    }
}

/// What lies over a point in the case: height of the middle and mass of surfacing, fill and backing, m and kg/m2.
fn column([x, y]: Point) -> [[f64; 2]; 3] {
    let boundaries =
        [road(x), road(x) - 0.12, (road(x) - 0.12).min(0.75), f64::NEG_INFINITY].map(|height| height.max(y));
    std::array::from_fn(|i| {
        let [top, bottom] = [boundaries[i], boundaries[i + 1]];
        [0.5 * (top + bottom), [2400.0, 1950.0, 2200.0][i] * (top - bottom)]
    })
}

/// Sums over the columns on every stone's extrados from left to right: `push` makes a force of a column, given its foot, a step along
/// the extrados, and what lies in it.
fn columns(ring: &Ring, push: impl Fn(Point, Point, [[f64; 2]; 3]) -> Vec<(Point, Point)>) -> Vec<Push> {
    let mut pushes = Vec::new();
    for (block, pair) in ring.joints.windows(2).enumerate() {
        let (a, b) = (pair[0].1, pair[1].1);
        for i in 0..COLUMNS {
            let foot = [0, 1].map(|k| a[k] + (b[k] - a[k]) * (i as f64 + 0.5) / COLUMNS as f64);
            let step = [0, 1].map(|k| (b[k] - a[k]) / COLUMNS as f64);
            pushes.extend(push(foot, step, column(foot)).into_iter().map(|(at, force)| Push { block, at, force }));
        }
    }
    pushes
}

/// Weight of the case's fill, with K times as much sideways, kN.
fn weight(ring: &Ring, k: f64) -> Vec<Push> {
    columns(ring, |foot, [dx, dy], parts| {
        let q = 9.81e-3 * parts.iter().map(|part| part[1]).sum::<f64>();
        vec![(foot, [k * q * dy, -q * dx])]
    })
}

/// Its mass in an acceleration in g, kN.
fn inertia(ring: &Ring, acceleration: Point) -> Vec<Push> {
    columns(ring, |foot, [dx, _], parts| {
        parts.map(|[y, mass]| ([foot[0], y], acceleration.map(|a| 9.81e-3 * mass * dx * a))).to_vec()
    })
}

#[test]
fn a_humped_road_bears_what_an_oracle_with_columns_of_its_own_says() {
    let ring = ring();
    let slope = 30f64.to_radians().tan();
    let strip = Strip { x0: -1.6375, surface: road(-1.6375), reach: slope, stress: &boussinesq };
    let by_oracle = expected(&ring, weight(&ring, 0.0), landed(&ring, &strip));
    println!("the case: {by_oracle:?}");
    let got = found(&case());
    close([got[0], by_oracle[0]], SUMMED, "a load at the quarter span");
    close([got[1], by_oracle[1]], SUMMED, "a load at the quarter span, crushing");
    // Straight on the extrados, and pressing at rest.
    let bare =
        change(case(), "/loads/1/load/patch_load", json!({"centre_x_m": 0.9, "width_m": 0.4, "force_n_per_m": 1000}));
    for k in [0.0, 0.3] {
        let by_oracle = expected(&ring, weight(&ring, k), ring.patch(0.7, 1.1, 1.0 / 0.4));
        let got = found(&change(bare.clone(), "/backfill/lateral_ratio", json!(k)));
        close([got[0], by_oracle[0]], IN_COLUMNS, &format!("not dispersed, K = {k}"));
        close([got[1], by_oracle[1]], IN_COLUMNS, &format!("not dispersed, K = {k}, crushing"));
    }
    // Shaken, with the mass of every layer at its own height.
    let acceleration = [-1.0, 0.2];
    let shaken =
        json!({"load": {"body_acceleration": {"x_g": acceleration[0], "y_g": acceleration[1]}}, "scaled": true});
    let request = change(case(), "/loads/1", shaken);
    let scaled = [ring.body(UNIT_WEIGHT / 1e3, acceleration), inertia(&ring, acceleration)].concat();
    let by_oracle = expected(&ring, weight(&ring, 0.0), scaled);
    let got = found(&request);
    close([got[0], by_oracle[0]], IN_COLUMNS, "shaken");
    close([got[1], by_oracle[1]], IN_COLUMNS, "shaken, crushing");
}

#[test]
fn springings_at_different_levels_have_level_lines_of_their_own() {
    // The ring turned by eight degrees, as surveyed.
    let (sin, cos) = 8f64.to_radians().sin_cos();
    let turned = |[x, y]: Point| [cos * x - sin * y, sin * x + cos * y];
    let ring = Ring::straight(ring().joints.iter().map(|&(inner, outer)| (turned(inner), turned(outer))).collect());
    let points = |of: fn(&(Point, Point)) -> Point| ring.joints.iter().map(of).collect::<Vec<_>>();
    let surveyed = json!({"surveyed": {"intrados_m": points(|joint| joint.0), "extrados_m": points(|joint| joint.1)}});
    assert!((ring.joints[0].1[1] - ring.joints[60].1[1]).abs() > 0.9);
    for x0 in [-3.1, -1.4, 3.3] {
        let patch = json!({"centre_x_m": x0, "width_m": 0.3, "force_n_per_m": 1000, "dispersal": {}});
        let request = json!({
            "arch": {"profile": surveyed}, "backfill": {"surface_height_m": 2.2, "density_kg_m3": 1800},
            "stone": {"density_kg_m3": 2040, "friction_angle_deg": 40, "compressive_strength_pa": STRENGTH},
            "loads": [{"load": {"self_weight": {}}}, {"load": {"patch_load": patch}, "scaled": true}],
            "load_factor": {"unit": "kN/m", "intensity_per_unit": 1}
        });
        let slope = 30f64.to_radians().tan();
        let strip = Strip { x0, surface: 2.2, reach: slope, stress: &boussinesq };
        let by_oracle = landed(&ring, &strip);
        let share = -by_oracle.iter().map(|push| push.force[1]).sum::<f64>();
        let scaled = door::analysis(&request).unwrap().scaled;
        let arrives = -scaled.iter().map(|force| force.force.y).sum::<f64>() / 1e3;
        println!("x = {x0}: {arrives} arrives, expected {share}");
        assert!((arrives - share).abs() < SUMMED && (x0.abs() < 2.0) == (share > 1.0 - 1e-9), "{arrives}, {share}");
        let by_oracle = expected(&ring, ring.fill(2.2, 1.8 * 9.81, 0.0), by_oracle);
        let got = found(&request);
        close([got[0], by_oracle[0]], SUMMED, &format!("x = {x0}"));
        close([got[1], by_oracle[1]], SUMMED, &format!("x = {x0}, crushing"));
    }
}

fn analysis(request: &Value) -> Analysis {
    door::analysis(request).unwrap()
}

fn same(found: &[PointForce], expected: &[PointForce], bodies: usize, tolerance: f64) {
    let [found, expected] = [found, expected].map(|forces| resultants(bodies, forces, Vec2::zeros()));
    let size = expected.iter().flatten().fold(0.0, |size: f64, part| size.max(part.abs()));
    for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
        assert!((found - expected).abs() <= tolerance * size, "{found} is not {expected}");
    }
}

fn two_spans() -> Value {
    let span = json!({
        "profile": {"circular": {"span_m": 6, "rise_m": 1.5}},
        "rings": [{"thickness_m": 0.3, "voussoirs": 9}, {"thickness_m": 0.3, "voussoirs": 11}]
    });
    json!({
        "bridge": {"spans": [span, span], "piers": [{"top_width_m": 2, "height_m": 3}]},
        "loads": [{"load": {"self_weight": {}}}, {"load": {"body_acceleration": {"x_g": 0.1, "y_g": 0.05}}}]
    })
}

#[test]
fn a_level_backfill_is_a_fill_pressure_up_to_that_level() {
    let arch =
        change(case(), "/loads/1", json!({"load": {"body_acceleration": {"x_g": 0.1, "y_g": -0.2}}, "scaled": true}));
    let mesh = json!({"subblocks": {"uniform": {"radial": 1, "along": 3}}});
    for bare in [change(arch.clone(), "/mesh", mesh), arch, two_spans()] {
        for level in [2.5, 1.2] {
            let backfill = json!({"surface_height_m": level, "density_kg_m3": 1700, "lateral_ratio": 0.4});
            let mut pressure = bare.clone();
            pressure.as_object_mut().unwrap().remove("backfill");
            let fill = json!({"fill_height_m": level, "fill_density_kg_m3": 1700, "lateral_ratio": 0.4});
            pressure["loads"].as_array_mut().unwrap().push(json!({"load": {"fill_pressure": fill}}));
            let (ours, theirs) = (analysis(&change(bare.clone(), "/backfill", backfill)), analysis(&pressure));
            let bodies = ours.structure.bodies.len();
            same(&ours.fixed, &theirs.fixed, bodies, 1e-13);
            same(&ours.scaled, &theirs.scaled, bodies, 1e-13);
        }
    }
    // Surfacing is an embankment on the fill below it; on a backfill it may be given as one, too.
    let layer = json!({"surface_height_m": 3.0, "layers": [{"thickness_m": 0.5, "density_kg_m3": 2300}]});
    let embankment = json!({"embankment_thickness_m": 0.5, "embankment_density_kg_m3": 2300});
    let with = |backfill: Value, more: Option<Value>| {
        let mut request = change(two_spans(), "/backfill", backfill);
        let more = more.map(|load| json!({"load": {"fill_pressure": load}}));
        request["loads"].as_array_mut().unwrap().extend(more);
        analysis(&request)
    };
    let (ours, theirs) = (with(layer, None), with(json!({"surface_height_m": 2.5}), Some(embankment.clone())));
    same(&ours.fixed, &theirs.fixed, ours.structure.bodies.len(), 1e-13);
    let mut fill = change(two_spans(), "/loads/1", two_spans()["loads"][1].clone());
    let both = json!({"fill_height_m": 2.5, "embankment_thickness_m": 0.5, "embankment_density_kg_m3": 2300});
    fill["loads"].as_array_mut().unwrap().push(json!({"load": {"fill_pressure": both}}));
    same(&ours.fixed, &analysis(&fill).fixed, ours.structure.bodies.len(), 1e-13);
}

#[test]
fn backfill_shakes_with_its_mass() {
    // The multipliers of g are from a rigid-block linear programme with the columns' inertia, by another program.
    let of = |ratio: f64| {
        let request = json!({
            "arch": {
                "profile": {"circular": {"radius_m": 10.0, "opening_angle_deg": 180.0}},
                "thickness": {"constant_m": 1.5}, "voussoirs": 27
            },
            "stone": {"friction_angle_deg": 45},
            "backfill": {"surface_height_m": 11.5, "lateral_ratio": ratio},
            "loads": [{"load": {"self_weight": {}}}, {"load": {"body_acceleration": {"x_g": 1}}, "scaled": true}]
        });
        assert!(text(&request).contains("Note: Fill has mass"));
        found(&request)[0]
    };
    close([of(0.0), 0.156843], 4e-6, "K = 0");
    close([of(0.5), 0.221627], 4e-6, "K = 0.5");
}

#[test]
fn all_of_the_fill_over_a_bridge_weighs_on_it() {
    // Over two spans and the pier between them, from springing to springing of the outer rings: plan area under the road.
    let road = json!({"surface_m": [[-9, 2.5], [1, 3.5], [9, 2.7]], "density_kg_m3": 1500});
    let bridge = analysis(&change(two_spans(), "/backfill", road));
    let bare = analysis(&two_spans());
    let down = |analysis: &Analysis| analysis.fixed.iter().map(|force| -force.force.y).sum::<f64>();
    let surface = |x: f64| if x < 1.0 { 2.5 + 0.1 * (x + 9.0) } else { 3.5 - 0.1 * (x - 1.0) };
    let steps = 20_000;
    let sides = bridge.structure.surfaces.iter();
    let area: f64 = sides
        .map(|side| {
            let [a, b] = side.ends;
            let at = |i: usize| a + (b - a) * ((i as f64 + 0.5) / f64::from(steps));
            (0..steps as usize).map(|i| (surface(at(i).x) - at(i).y) * (b.x - a.x) / f64::from(steps)).sum::<f64>()
        })
        .sum();
    // The body's own upward force of 0.05 g is on fill as well.
    let expected = 0.95 * 1500.0 * 9.81 * area;
    assert!(
        ((down(&bridge) - down(&bare)) / expected - 1.0).abs() < 1e-7,
        "{} is not {expected}",
        down(&bridge) - down(&bare)
    );
}

#[test]
fn half_an_arch_bears_half_of_a_symmetric_road() {
    let mut request = change(case(), "/loads/1", json!({"load": {"body_acceleration": {"y_g": -0.2}}}));
    request["backfill"]["surface_m"] = json!([[-4, 1.5], [0, 1.9], [4, 1.5]]);
    for voussoirs in [24, 25] {
        request["arch"]["voussoirs"] = json!(voussoirs);
        let down = |half: bool| {
            let forces = analysis(&change(request.clone(), "/arch/half", json!(half))).fixed;
            forces.iter().map(|force| force.force.y).sum::<f64>()
        };
        assert!((2.0 * down(true) / down(false) - 1.0).abs() < 1e-12);
    }
    request["arch"]["half"] = json!(true);
    request["backfill"]["surface_m"][2][1] = json!(1.6);
    refused(&request, &[("/backfill/surface_m", "set half to false")]);
}

fn refused(request: &Value, expected: &[(&str, &str)]) {
    let found = faults(request);
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (fault, (pointer, remedy)) in found.iter().zip(expected) {
        assert!(fault.pointer == *pointer && fault.detail.contains(remedy), "{pointer}, {remedy}: {found:?}");
    }
}

#[test]
fn what_is_wrong_with_a_backfill_is_said_where_it_is() {
    let (surface, height) = ("/backfill/surface_m", "/backfill/surface_height_m");
    let one = "give either surface_height_m or surface_m";
    refused(&change(case(), height, json!(2.0)), &[("/backfill", one)]);
    refused(&change(case(), surface, Value::Null), &[("/backfill", one)]);
    refused(&change(case(), surface, json!([[0, 2], [1, 2], [1, 3]])), &[("/backfill/surface_m/2", "must be greater")]);
    let low = json!({"surface_height_m": -2});
    let bare = change(case(), "/loads/1/load/patch_load", json!({"centre_x_m": 0, "width_m": 1, "force_n_per_m": 1}));
    refused(&change(bare.clone(), "/backfill", low), &[("/backfill", "raise its surface")]);
    // The road runs into the arch.
    let shallow = change(case(), "/backfill", json!({"surface_height_m": 1.3}));
    refused(&shallow, &[("/loads/1/load/patch_load/dispersal", "above the surface on which the load stands")]);
    let given = change(shallow, "/loads/1/load/patch_load/dispersal/surface_height_m", json!(1.35));
    refused(&given, &[("/loads/1/load/patch_load/dispersal/surface_height_m", "above the surface")]);
    // Fill twice; an embankment may stand on it, where the arch does not reach through.
    let mut twice = bare;
    twice["loads"].as_array_mut().unwrap().push(json!({"load": {"fill_pressure": {"fill_height_m": 2}}}));
    let place = "/loads/2/load/fill_pressure/fill_height_m";
    refused(&twice, &[(place, "leave out backfill")]);
    twice["loads"][2] = json!({"load": {"fill_pressure": {"embankment_thickness_m": 1}}});
    assert_eq!(faults(&twice), vec![]);
    twice["backfill"] = json!({"surface_height_m": 1.5});
    refused(&twice, &[("/loads/2/load/fill_pressure/embankment_thickness_m", "above the top of the fill")]);
    // Without a backfill a dispersed load needs a surface and a distribution of its own.
    let mut alone = case();
    alone.as_object_mut().unwrap().remove("backfill");
    let here = "/loads/1/load/patch_load/dispersal";
    let fields = ["surface_height_m", "distribution"].map(|field| format!("{here}/{field}"));
    let missing = fields.each_ref().map(|field| (field.as_str(), "is missing: add it"));
    refused(&alone, &missing);
    let wall = json!({
        "blocks": {
            "polygons": [{"name": "low", "corners_m": [[0, 0], [1, 0], [1, 1], [0, 1]]}],
            "supports": [{"name": "ground", "sides": [{"block": "low", "side": 0}]}]
        },
        "backfill": {"surface_height_m": 3}, "loads": [{"load": {"self_weight": {}}}]
    });
    refused(&wall, &[("/backfill", "point_force")]);
}

#[test]
fn the_answer_says_what_is_assumed_of_backfill_and_what_goes_to_the_ground() {
    let mut request = case();
    let words = text(&request);
    for part in [
        "backfill of 1950 kg/m3 up to a surface through 3 points, y = 1.4 to 1.9 m; 0.12 m of 2400 kg/m3 under the surface; \
         backing of 2200 kg/m3 up to y = 0.75 m; no horizontal pressure",
        "on the surface at y = 1.74909 m, dispersed by the fill as Boussinesq has it up to 30 deg from the vertical",
    ] {
        assert!(words.contains(part), "{part}: {words}");
    }
    assert!(!words.contains("to the ground"), "{words}");
    // What is left out is echoed, and read again it is the same.
    request["backfill"] = json!({"surface_height_m": 1.9});
    let echo = serde_json::to_value(read(request.to_string().as_bytes()).unwrap()).unwrap();
    let backfill = json!({
        "surface_height_m": 1.9, "density_kg_m3": 1600.0, "layers": [], "lateral_ratio": 0.0,
        "dispersal": {"boussinesq": {"cut_off_deg": 30.0}}
    });
    assert_eq!(echo["backfill"], backfill);
    // A fixed axle half on the bridge, one beyond it, and an embankment on the road.
    let axle = |x: f64| json!({"load": {"patch_load": {"centre_x_m": x, "width_m": 0.3, "force_n_per_m": 500, "dispersal": {}}}});
    let embankment = json!({"load": {"fill_pressure": {"embankment_thickness_m": 0.2}}});
    request["loads"].as_array_mut().unwrap().extend([axle(3.4), axle(-9.0), embankment]);
    let words = text(&request).split_whitespace().collect::<Vec<_>>().join(" ");
    let down: f64 = {
        let [with, without] = [5, 2].map(|count| {
            let mut request = request.clone();
            request["loads"].as_array_mut().unwrap().truncate(count);
            analysis(&request).fixed.iter().map(|force| -force.force.y).sum::<f64>()
        });
        let mut embankment = request.clone();
        embankment["loads"].as_array_mut().unwrap().drain(2..4);
        let weight = analysis(&embankment).fixed.iter().map(|force| -force.force.y).sum::<f64>() - without;
        with - without - weight
    };
    let share = Digits(down / 5.0);
    for part in [
        &format!("Of the force of loads[2] {share} % comes down on the structure; the rest goes to the ground"),
        "Nothing of loads[3] comes down on the structure: all of it goes to the ground beyond its ends.",
        "0.2 m of embankment of 1600 kg/m3 on the backfill; no horizontal pressure",
        "backfill of 1600 kg/m3 up to y = 1.9 m; no horizontal pressure",
    ] {
        assert!(words.contains(part), "{part}: {words}");
    }
    // None of the scaled loads arrives.
    request["loads"][1]["load"]["patch_load"]["centre_x_m"] = json!(20);
    refused(&request, &[("/loads/1/load", "move one towards it")]);
}
