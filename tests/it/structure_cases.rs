//! The expected numbers of `cases/wall` and `cases/two-span-bridge`, computed by the oracle of any structure. Nothing of the library
//! sets out the structures here: the wall's corners stand in its request, the bridge's are plain trigonometry.

use crate::common::folders;
use crate::common::rigid_blocks::contacts::found;
use crate::common::rigid_blocks::scene::{Load, Scene, Support, rectangle};
use crate::common::rigid_blocks::wall::{FRICTION, PUBLISHED};
use crate::common::rigid_blocks::{Aim, Push, interior_point};
use serde_json::Value;

/// Digits of the expected numbers.
const SAME: f64 = 2e-6;

fn read(case: &str, file: &str) -> Value {
    serde_json::from_slice(&std::fs::read(folders::cases().join(case).join(file)).unwrap()).unwrap()
}

fn highest(scene: &Scene) -> f64 {
    interior_point::solve(&scene.problem(), Aim::Highest).factor(Aim::Highest).unwrap()
}

fn close(found: f64, expected: &Value) {
    let expected = expected.as_f64().unwrap();
    assert!((found / expected - 1.0).abs() < SAME, "{found}, {expected} written down");
}

#[test]
fn the_wall_is_the_published_one() {
    let request = read("wall", "request.json");
    let blocks: Vec<Vec<[f64; 2]>> = { request["blocks"]["polygons"].as_array().unwrap().iter() }
        .map(|polygon| serde_json::from_value(polygon["corners_m"].clone()).unwrap())
        .collect();
    let published = PUBLISHED[0].scene();
    assert_eq!(blocks.len(), published.blocks.len());
    for (corner, other) in blocks.iter().flatten().flatten().zip(published.blocks.iter().flatten().flatten()) {
        assert!((corner - other).abs() < 1e-9, "{corner} {other}");
    }
    let angle = request["stone"]["friction_angle_deg"].as_f64().unwrap();
    assert!((angle.to_radians().tan() - FRICTION).abs() < 1e-12);
    let window = &read("wall", "expected.json")["quantities"]["limit_window"];
    let factor = highest(&published);
    println!("wall: {factor}");
    close(factor, &window[1]);
    close(-factor, &window[0]);
}

/// Span, rise, thickness, voussoirs, width and height of the pier, its courses, abscissa of the load.
const SPAN: f64 = 6.0;
const RISE: f64 = 1.5;
const THICKNESS: f64 = 0.4;
const VOUSSOIRS: usize = 21;
const PIER: [f64; 2] = [1.0, 3.0];
const COURSES: usize = 4;
const LOAD_X: f64 = -5.0;

/// The bridge under 1 kN at `LOAD_X`.
fn bridge(friction_angle_deg: f64) -> Scene {
    let radius = (0.25 * SPAN * SPAN + RISE * RISE) / (2.0 * RISE);
    let half = (0.5 * SPAN / radius).asin();
    let [width, height] = PIER;
    let mut blocks = Vec::new();
    let mut load = None;
    for centre in [-0.5 * (width + SPAN), 0.5 * (width + SPAN)] {
        let at = |r: f64, k: usize| {
            let angle = half * (2.0 * k as f64 / VOUSSOIRS as f64 - 1.0);
            [centre + r * angle.sin(), RISE - radius + r * angle.cos()]
        };
        for k in 0..VOUSSOIRS {
            let [a, b] = [at(radius + THICKNESS, k), at(radius + THICKNESS, k + 1)];
            if (a[0]..b[0]).contains(&LOAD_X) {
                let y = a[1] + (b[1] - a[1]) * (LOAD_X - a[0]) / (b[0] - a[0]);
                load = Some(Push { block: blocks.len(), at: [LOAD_X, y], force: [0.0, -1000.0] });
            }
            blocks.push(vec![at(radius, k), at(radius, k + 1), b, a]);
        }
    }
    let course = height / COURSES as f64;
    for k in 0..COURSES - 1 {
        blocks.push(rectangle(-0.5 * width, k as f64 * course - height, width, course));
    }
    // The uppermost course reaches up along both springings.
    let (x, out, up) = (0.5 * width, THICKNESS * half.sin(), THICKNESS * half.cos());
    blocks.push(vec![[-x, -course], [x, -course], [x, 0.0], [x - out, up], [out - x, up], [-x, 0.0]]);
    // Its first side is its base; the left side of a voussoir is its last, the right one its second.
    let sides = vec![(0, 3), (2 * VOUSSOIRS - 1, 1), (2 * VOUSSOIRS, 0)];
    let supports = vec![Support { name: "ground".into(), sides }];
    let scaled = vec![Load::Point(load.unwrap())];
    Scene { blocks, supports, scaled, density: 2300.0, friction_angle_deg }
}

#[test]
fn the_bridge_of_the_case() {
    let request = read("two-span-bridge", "request.json");
    let (stone, bridge_of_case) = (&request["stone"], &request["bridge"]);
    let angle = stone["friction_angle_deg"].as_f64().unwrap();
    let circular = serde_json::json!({"span_m": SPAN as u64, "rise_m": RISE});
    for span in bridge_of_case["spans"].as_array().unwrap() {
        assert_eq!(span["profile"]["circular"], circular);
        assert_eq!(span["rings"], serde_json::json!([{"thickness_m": THICKNESS, "voussoirs": VOUSSOIRS}]));
    }
    let scene = bridge(angle);
    let ground: Vec<_> = scene.supports[0].sides.clone();
    // Every ring has a joint more than stones, every course one below it.
    assert_eq!(found(&scene.blocks, &ground, 1.0).len(), 2 * (VOUSSOIRS + 1) + COURSES);
    let expected = read("two-span-bridge", "expected.json");
    let factor = highest(&scene);
    let lowest = interior_point::solve(&scene.problem(), Aim::Lowest).factor(Aim::Lowest).unwrap();
    println!("bridge: {lowest} to {factor}; without sliding {}", highest(&bridge(80.0)));
    // Nothing slides: more friction does not help.
    assert!((highest(&bridge(80.0)) / factor - 1.0).abs() < 1e-6);
    close(factor, &expected["quantities"]["intensity"]);
    close(lowest, &expected["quantities"]["limit_window"][0]);
}
