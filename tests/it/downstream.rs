//! What is asked of bridges and blocks beside their collapse: moving geometry, supports that move, meshes and stress, safety.

use crate::common::answered::solved;
use crate::common::door::solve;
use crate::contract::bodies::with;
use serde_json::{Value, json};
use voussoir::collapse::{CollapseReport, Outcome, Reach, SettlementEnd, SettlementPath, UpdatedGeometry};
use voussoir::geometry::Vec2;

/// Weight of the stone, N/m3.
const WEIGHT: f64 = 2300.0 * 9.81;

fn stone(modulus: f64) -> Value {
    json!({
        "friction_angle_deg": 60, "compressive_strength_pa": 1e30, "youngs_modulus_pa": modulus, "penalty_ratio": 1,
    })
}

fn profile() -> Value {
    json!({"circular": {"span_m": 6, "rise_m": 1.5}})
}

/// A request with this structure under its own weight.
fn standing(word: &str, structure: Value, modulus: f64) -> Value {
    json!({word: structure, "stone": stone(modulus), "loads": [{"load": {"self_weight": {}}}]})
}

fn arch() -> Value {
    let arch = json!({"profile": profile(), "line": "intrados", "thickness": {"constant_m": 0.4}, "voussoirs": 21});
    standing("arch", arch, 1e10)
}

/// Spans of one ring as that of [`arch`], on piers of this width and height.
fn bridge(spans: usize, [top_width_m, height_m]: [f64; 2], modulus: f64) -> Value {
    let span = json!({"profile": profile(), "rings": [{"thickness_m": 0.4, "voussoirs": 21}]});
    let pier = json!({"top_width_m": top_width_m, "height_m": height_m});
    standing("bridge", json!({"spans": vec![span; spans], "piers": vec![pier; spans - 1]}), modulus)
}

fn loaded(request: Value, x_m: f64) -> Value {
    let load = json!({"load": {"point_load": {"force_n_per_m": 1000, "x_m": x_m}}, "scaled": true});
    let loads = json!([request["loads"][0], load]);
    with(request, "/loads", loads)
}

fn moved(request: Value, supports: Value) -> CollapseReport {
    solve(&with(request, "/analysis", json!({"settlement": {"supports": supports}})))
}

fn first_order(report: &CollapseReport) -> &SettlementPath {
    &report.settlement().unwrap().first_order
}

fn near(a: f64, b: f64, share: f64) {
    assert!((a / b - 1.0).abs() < share, "{a} is not {b}");
}

#[test]
fn an_arch_given_as_a_bridge_of_one_span_is_the_arch() {
    let whole = |request: Value| {
        let request = with(
            with(loaded(request, -1.5), "/geometry", json!("updated")),
            "/stone/compressive_strength_pa",
            json!(3e5),
        );
        let steps = with(request.clone(), "/geometry", json!("first_order"));
        let steps = with(steps, "/method", json!({"fixed_steps": {"step": 1.0, "opening_m": 1e-5}}));
        let request = with(request, "/mesh", json!({"subblocks": {"uniform": {"radial": 2, "along": 3}}}));
        let report = solve(&with(request, "/report", json!({"first_yield_length_m": 1})));
        let updated = report.updated.unwrap();
        let crushing = report.crushing;
        let elastic = crushing.elastic.unwrap();
        [
            report.end.unwrap().load_factor,
            updated.load_factor.unwrap(),
            updated.crown.unwrap().y,
            elastic.where_largest.unwrap().tresca(),
            crushing.plastic_section.unwrap().window.unwrap().highest,
            solve(&steps).end.unwrap().load_factor,
        ]
    };
    let (one, other) = (whole(arch()), whole(bridge(1, [0.0; 2], 1e10)));
    println!("{one:?}\n{other:?}");
    one.into_iter().zip(other).for_each(|(a, b)| near(a, b, 1e-8));
    // Outwards is to the left there, and opening the intrados turns clockwise.
    for [outwards, down, turn] in [[0.02, 0.0, 0.0], [-0.01, 0.0, 0.0], [0.0, 0.03, 0.0], [0.01, -0.02, 0.5]] {
        let left = json!({"outwards_m": outwards, "downwards_m": down, "rotation_deg": turn});
        let one = solve(&with(arch(), "/analysis", json!({"settlement": {"left": left}})));
        let ground = json!([{
            "support": "ground.left", "rightwards_m": -outwards, "downwards_m": down, "rotation_deg": -turn,
        }]);
        let other = moved(bridge(1, [0.0; 2], 1e10), ground);
        let [one, other] = [&one, &other].map(first_order);
        let joints = |path: &SettlementPath| path.mechanism.hinges.iter().map(|hinge| hinge.joint).collect::<Vec<_>>();
        assert_eq!((one.end, joints(one)), (other.end, joints(other)), "{outwards} {down} {turn}");
        for (a, b) in one.points.last().unwrap().forces.iter().zip(&other.points.last().unwrap().forces) {
            assert!((a - b).norm() < 1e-6 * a.norm(), "{a} {b}");
        }
    }
}

#[test]
fn on_moving_geometry_stiff_bridges_and_walls_fall_at_the_first_order_load() {
    let followed = |modulus: f64, x_m: f64| -> (f64, UpdatedGeometry) {
        let report = solve(&with(loaded(bridge(2, [1.0, 3.0], modulus), x_m), "/geometry", json!("updated")));
        (report.end.unwrap().load_factor, report.updated.unwrap())
    };
    let lost = |modulus: f64| {
        let (first_order, updated) = followed(modulus, -5.0);
        assert!(updated.residual < 1e-9);
        1.0 - updated.load_factor.unwrap() / first_order
    };
    let [soft, stiff] = [1e9, 1e11].map(lost);
    println!("lost on moving geometry: {soft:.4}, {stiff:.6} at a hundred times the modulus");
    assert!(soft > 1e-3 && (soft / stiff / 100.0 - 1.0).abs() < 0.1);
    // The load is on one span, and so is the crown that is told of.
    let [(_, here), (_, there)] = [-5.0, 5.0].map(|x| followed(1e9, x));
    near(here.load_factor.unwrap(), there.load_factor.unwrap(), 1e-6);
    let [here, there] = [here, there].map(|updated| updated.crown.unwrap());
    assert!((here - Vec2::new(-there.x, there.y)).norm() < 1e-3 * here.norm(), "{here} {there}");
    // Rough blocks of a portal that is pushed turn over, and do not slide.
    let portal = |modulus: f64, push: f64| {
        let block = |name: &str, [x, y, w, h]: [f64; 4]| json!({"name": name, "corners_m": [[x, y], [x + w, y], [x + w, y + h], [x, y + h]]});
        let polygons =
            [block("a", [0.0, 0.0, 0.5, 2.0]), block("b", [2.0, 0.0, 0.5, 2.0]), block("c", [0.0, 2.0, 2.5, 0.5])];
        let supports = json!([{"name": "ground", "segments_m": [[[0, 0], [2.5, 0]]]}]);
        let request = standing("blocks", json!({"polygons": polygons, "supports": supports}), modulus);
        let shaken = json!({"load": {"body_acceleration": {"x_g": push}}, "scaled": true});
        let loads = json!([request["loads"][0], shaken]);
        let report = solve(&with(with(request, "/loads", loads), "/geometry", json!("updated")));
        [report.end.unwrap().load_factor, report.updated.unwrap().load_factor.unwrap()]
    };
    let [[first, soft], [_, stiff]] = [1e7, 1e9].map(|modulus| portal(modulus, 1.0));
    println!("portal: {first}, {soft}, {stiff}");
    assert!(soft < first && ((first - soft) / (first - stiff) / 100.0 - 1.0).abs() < 0.1);
    near(portal(1e7, -1.0)[1], soft, 1e-5);
}

/// A pier that moves makes one span wider and the other narrower: the least thrust and the greatest of the arch alone.
#[test]
fn a_pier_that_moves_finds_the_least_thrust_of_one_span_and_the_greatest_of_the_other() {
    let range = solve(&arch()).thrust_range.unwrap();
    let report = moved(bridge(2, [3.0, 1.0], 1e10), json!([{"support": "ground.pier0", "rightwards_m": 0.02}]));
    let (path, [left, pier, right]) = (first_order(&report), forces(&report));
    assert_eq!((path.end, report.outcome), (SettlementEnd::Follows, Outcome::FollowsMovement));
    near(left.x, range.lowest, 1e-6);
    near(-right.x, range.highest, 1e-6);
    assert!((left + pier + right).x.abs() < 1e-6 * range.highest);
    assert!(path.mechanism.hinges.len() >= 6, "{:?}", path.mechanism.hinges);
    // On moving geometry a soft bridge follows a pier that sinks; both spans do the same.
    let sinking = json!([{"support": "ground.pier0", "downwards_m": 0.02}]);
    let report = moved(with(bridge(2, [3.0, 1.0], 1e9), "/geometry", json!("updated")), sinking);
    let updated = report.settlement().unwrap().updated.as_ref().unwrap();
    assert_eq!(updated.end, SettlementEnd::Follows, "{:?}", updated.why);
    let last = &updated.points.last().unwrap().forces;
    near(last[0].x, -last[2].x, 1e-4);
    near(last[0].y, last[2].y, 1e-4);
}

fn forces<const SUPPORTS: usize>(report: &CollapseReport) -> [Vec2; SUPPORTS] {
    first_order(report).points.last().unwrap().forces.clone().try_into().unwrap()
}

fn block(name: &str, [left, bottom, width, height]: [f64; 4]) -> Value {
    let [right, top] = [left + width, bottom + height];
    json!({"name": name, "corners_m": [[left, bottom], [right, bottom], [right, top], [left, top]]})
}

#[test]
fn a_beam_whose_bearing_sinks_lies_on_the_corners_that_are_left() {
    // A beam of 4 m by 1 m with a block of 1 m by 1 m at its left end, on bearings up to x = 0.5 and from x = 3.
    let polygons = [block("beam", [0.0, 0.0, 4.0, 1.0]), block("weight", [0.0, 1.0, 1.0, 1.0])];
    let supports = json!([
        {"name": "left", "segments_m": [[[0, 0], [0.5, 0]]]}, {"name": "right", "segments_m": [[[3, 0], [4, 0]]]},
    ]);
    let request = standing("blocks", json!({"polygons": polygons, "supports": supports}), 1e10);
    let [weight, beam] = [WEIGHT, 4.0 * WEIGHT];
    // It turns about the left bearing's inner corner, and its outer corner follows the right one: the other way round, were
    // that to rise, about the outer corner on the left, while the inner one on the right is lifted.
    for (down, [from, to]) in [(0.01, [0.5, 4.0]), (-0.01, [0.0, 3.0])] {
        let report = moved(request.clone(), json!([{"support": "right", "downwards_m": down}]));
        let [left, right] = forces(&report);
        near(right.y, (beam * (2.0 - from) + weight * (0.5 - from)) / (to - from), 1e-6);
        near(left.y + right.y, weight + beam, 1e-9);
        let turned = first_order(&report).displacements[0][2];
        near(turned, -down / (to - from), 1e-3);
    }
    let settlement = json!({"settlement": {"supports": [{"support": "right", "downwards_m": 0.01}]}});
    let answer = solved(&with(request, "/analysis", settlement));
    let path = &answer["settlement"]["first_order"];
    let right = &path["history"]["supports"][1];
    assert_eq!((right["support"].as_str(), path["thrust_n_per_m"].is_null()), (Some("right"), true));
    let upwards = right["upwards_n_per_m"].as_array().unwrap().last().unwrap().as_f64().unwrap();
    near(upwards, beam * 1.5 / 3.5, 1e-6);
}

#[test]
fn a_column_moves_with_the_ground_that_it_stands_on() {
    let polygons = [block("lower", [0.0, 0.0, 1.0, 1.0]), block("upper", [0.0, 1.0, 1.0, 1.0])];
    let supports = json!([{"name": "ground", "sides": [{"block": "lower", "side": 0}]}]);
    let request = standing("blocks", json!({"polygons": polygons, "supports": supports}), 1e12);
    let ground = json!([{
        "support": "ground", "rightwards_m": 0.1, "downwards_m": 0.2, "rotation_deg": 5, "about_m": [1, 0],
    }]);
    let report = moved(with(request, "/geometry", json!("updated")), ground);
    let path = report.settlement().unwrap().updated.as_ref().unwrap();
    assert_eq!(path.end, SettlementEnd::Follows, "{:?}", path.why);
    let (sin, cos) = 5f64.to_radians().sin_cos();
    for (found, height) in path.displacements.iter().zip([0.5, 1.5]) {
        let arm = Vec2::new(-0.5, height);
        let turned = Vec2::new(cos * arm.x - sin * arm.y, sin * arm.x + cos * arm.y);
        let expected = turned - arm + Vec2::new(0.1, -0.2);
        assert!((Vec2::new(found[0], found[1]) - expected).norm() < 1e-6, "{found:?} {expected}");
        assert!((found[2] - 5f64.to_radians()).abs() < 1e-6, "{found:?}");
    }
    let force = path.points.last().unwrap().forces[0];
    assert!((force - Vec2::new(0.0, 2.0 * WEIGHT)).norm() < 1e-6 * WEIGHT, "{force}");
}

/// A wall of blocks of 1 m by 0.5 m, `courses` high and 4 m long, every other course shifted by half a block.
fn wall(courses: usize) -> Value {
    let mut polygons = Vec::new();
    for course in 0..courses {
        let shift = if course % 2 == 0 { 0.0 } else { 0.5 };
        let mut ends: Vec<f64> = (0..5).map(|k| k as f64 + shift).filter(|end| *end < 4.0).collect();
        ends.extend([0.0, 4.0].into_iter().filter(|end| !ends.contains(end)).collect::<Vec<_>>());
        ends.sort_by(f64::total_cmp);
        for pair in ends.windows(2) {
            let name = format!("b{course}.{}", pair[0]);
            polygons.push(block(&name, [pair[0], 0.5 * course as f64, pair[1] - pair[0], 0.5]));
        }
    }
    let supports = json!([{"name": "ground", "segments_m": [[[0, 0], [4, 0]]]}]);
    let request = standing("blocks", json!({"polygons": polygons, "supports": supports}), 1e9);
    with(request, "/report", json!({"stress_fields": ["unit_load"]}))
}

/// Without Poisson's effect there is no stress but the weight of what stands above.
#[test]
fn subblocks_of_a_wall_in_running_bond_have_the_stress_of_the_weight_above() {
    for [radial, along] in [[1, 1], [2, 2], [3, 4]] {
        let request = with(wall(5), "/mesh", json!({"subblocks": {"uniform": {"radial": radial, "along": along}}}));
        let report = solve(&with(request, "/stone/poissons_ratio", json!(0)));
        let subblocks = &report.stress_fields[0].subblocks;
        assert_eq!(subblocks.len(), 22 * radial * along);
        for subblock in subblocks {
            let expected = [0.0, -WEIGHT * (2.5 - subblock.centre.y), 0.0];
            let off = [0, 1, 2].map(|i| (subblock.stress[i] - expected[i]).abs() / (2.5 * WEIGHT));
            assert!(off.iter().all(|off| *off < 1e-9), "{radial} {along}: {subblock:?}, not {expected:?}");
        }
    }
}

/// A column of which a triangle and what is left of a square are a part.
#[test]
fn bodies_of_any_shape_have_their_mean_stress() {
    let polygons = [
        block("foot", [0.0, 0.0, 1.0, 1.0]),
        json!({"name": "pentagon", "corners_m": [[0, 1], [1, 1], [1, 2], [0.5, 2], [0, 1.5]]}),
        json!({"name": "triangle", "corners_m": [[0, 1.5], [0.5, 2], [0, 2]]}),
    ];
    let supports = json!([{"name": "ground", "sides": [{"block": "foot", "side": 0}]}]);
    let request = standing("blocks", json!({"polygons": polygons, "supports": supports}), 1e9);
    let request = with(request, "/report", json!({"stress_fields": ["unit_load"]}));
    let report = solve(&with(request.clone(), "/stone/poissons_ratio", json!(0)));
    let subblocks = &report.stress_fields[0].subblocks;
    assert_eq!(subblocks.iter().map(|subblock| subblock.corners.len()).collect::<Vec<_>>(), [4, 5, 3]);
    for subblock in subblocks {
        let expected = -WEIGHT * (2.0 - subblock.centre.y);
        // Statics leaves friction at the two ends of a joint open as far as it cancels out: stress along the joint, which adds the
        // same to all three at the inclined one, and to the horizontal one alone at the level one.
        let [_, vertical, shear] = subblock.stress;
        assert!((vertical - shear - expected).abs() < 1e-9 * WEIGHT, "{subblock:?}, not {expected}");
        assert!(subblock.stress[0].abs().max(shear.abs()) < 1e-1 * WEIGHT, "{subblock:?}");
    }
    let request = with(request, "/mesh", json!({"subblocks": {"uniform": {"radial": 2, "along": 2}}}));
    assert_eq!(solve(&request).stress_fields[0].subblocks.len(), 4 + 5 + 3);
    let ell = json!([[0, 0], [1, 0], [1, 1], [0.4, 1], [0.4, 0.5], [0, 0.5]]);
    let request = with(request, "/blocks/polygons/0/corners_m", ell);
    let notes = solved(&request)["notes"].to_string();
    assert!(notes.contains("One block each, with one state of stress: foot."), "{notes}");
}

/// The mean of the vertical stress over a course is the weight above its middle, and every block is its partner's mirror image.
#[test]
fn symmetric_walls_are_told_of_block_by_block() {
    let wall = std::fs::read(crate::common::folders::cases().join("wall").join("request.json")).unwrap();
    let request: Value = serde_json::from_slice(&wall).unwrap();
    let blocks = solve(&request).at_start.unwrap().blocks;
    let structure = crate::common::door::analysis(&request).unwrap().structure;
    let (height, length, weight) = (0.175, 2.0, 2000.0 * 9.81);
    for course in 0..6 {
        let middle = (course as f64 + 0.5) * height;
        let here = structure.bodies.iter().zip(&blocks).filter(|(b, _)| (b.region.centroid.y - middle).abs() < 1e-9);
        let carried: f64 = here.map(|(body, state)| state.stress[1] * body.region.area / height).sum();
        near(carried, -weight * length * (6.0 * height - middle), 1e-9);
    }
    for (body, state) in structure.bodies.iter().zip(&blocks) {
        let image = Vec2::new(length - body.region.centroid.x, body.region.centroid.y);
        let partner = structure.bodies.iter().position(|b| (b.region.centroid - image).norm() < 1e-9).unwrap();
        let there = &blocks[partner];
        assert!((state.displacement.x + there.displacement.x).abs() < 1e-15);
        assert!((state.displacement.y - there.displacement.y).abs() < 1e-15 && state.rotation == -there.rotation);
    }
}

#[test]
fn safety_of_a_bridge_is_its_collapse_load_over_the_load() {
    let request = with(loaded(bridge(2, [1.0, 3.0], 1e9), -5.0), "/loads/1/coefficient", json!(10));
    let request = with(request, "/stone/compressive_strength_pa", json!(5e6));
    let at = |reach: Reach| match reach {
        Reach::At(load_factor) => load_factor,
        other => panic!("{other:?}"),
    };
    let collapse = solve(&request);
    let safety = solve(&with(request.clone(), "/analysis", json!({"safety": {}}))).safety().copied().unwrap();
    near(at(safety.instability), collapse.end.unwrap().load_factor, 1e-9);
    let plastic = collapse.crushing.plastic_section.unwrap().window.unwrap().highest;
    near(at(safety.governing), plastic, 1e-9);
    let request = with(request, "/loads/1/per_abscissa", json!(true));
    let curve = solved(&with(request, "/analysis", json!({"safety": {"curve": {"abscissae": [0.5, 2]}}})));
    for (point, abscissa) in curve["points"].as_array().unwrap().iter().zip([0.5, 2.0]) {
        near(point["plastic_section"]["load_factor"].as_f64().unwrap(), plastic / abscissa, 1e-9);
    }
}

#[test]
fn overrides_and_accuracy_of_other_structures() {
    let polygons = [block("lower", [0.0, 0.0, 1.0, 0.2]), block("upper", [0.0, 0.2, 1.0, 0.2])];
    let supports = json!([{"name": "ground", "sides": [{"block": "lower", "side": 0}]}]);
    let request = standing("blocks", json!({"polygons": polygons, "supports": supports}), 1e9);
    let shaken = json!({"load": {"body_acceleration": {"x_g": 1}}, "scaled": true});
    let request = with(request.clone(), "/loads", json!([request["loads"][0], shaken]));
    let report = solve(&with(request.clone(), "/joint_overrides", json!([{"joint": 1, "friction_angle_deg": 20}])));
    near(report.end.unwrap().load_factor, 20f64.to_radians().tan(), 1e-9);
    let estimated = solve(&with(request, "/accuracy", json!({"collapse_intensity": 1e-3})));
    assert!(estimated.plan.unwrap().collapse_intensity.unwrap().met);
}
