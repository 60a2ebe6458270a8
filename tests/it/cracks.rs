//! Joints that open as springings move, against rotations of a three-hinge arch by hand; and the forces of both springings.

use crate::common::answered::{solved, text};
use crate::common::door::{analysis, solve};
use crate::common::masonry::Ring;
use crate::common::three_hinges::Parted;
use crate::common::wire::{ask, circular};
use serde_json::{Value, json};
use voussoir::collapse::{CollapseReport, OpenJoint, SettlementEnd};
use voussoir::structure::Face;

/// Half opening, t/R, voussoirs of arches of mean radius 1 m: those of `spreading_supports.json`, and the joint that is a hinge on
/// either side of the crown.
const RINGS: [(f64, f64, usize, usize); 4] =
    [(90.0, 0.15, 20, 4), (90.0, 0.2, 20, 3), (80.0, 0.15, 16, 2), (45.0, 0.1, 12, 0)];

/// An arch of stiff stone in which no joint slides, under its weight.
fn moved(arch: Value, settlement: Value, geometry: &str) -> Value {
    let mut request = ask(arch, 80.0, &[]);
    request["stone"]["density_kg_m3"] = json!(2300.0);
    request["stone"]["youngs_modulus_pa"] = json!(1e12);
    request["stone"]["compressive_strength_pa"] = json!(1e12);
    request["analysis"] = json!({"settlement": settlement});
    request["geometry"] = json!(geometry);
    request
}

fn parted(arch: Value, spread: f64, geometry: &str) -> Value {
    let each = json!({"outwards_m": 0.5 * spread});
    moved(arch, json!({"left": each, "right": each}), geometry)
}

fn open(report: &CollapseReport, joint: usize) -> OpenJoint {
    let settlement = report.settlement().unwrap();
    let path = settlement.updated.as_ref().unwrap_or(&settlement.first_order);
    assert_eq!(path.end, SettlementEnd::Follows);
    let found = path.open_joints.iter().find(|open| open.joint == joint);
    *found.unwrap_or_else(|| panic!("joint {joint} is shut: {:?}", path.open_joints))
}

fn close(got: f64, expected: f64, tolerance: f64, what: &str) {
    println!("{what}: {got}, expected {expected}, {:.1e}", got / expected - 1.0);
    assert!((got / expected - 1.0).abs() <= tolerance, "{what}: {got} is not {expected}");
}

/// At first order both halves turn about their hinges on the intrados by d / 2 h, where d is the spread and h the height of the
/// crown's hinge above those: cracks are d t / 2 h wide at the haunches, and twice that at the crown.
#[test]
fn cracks_of_a_spreading_arch_are_the_rotations_of_three_hinges() {
    let spread = 0.01;
    for (half, t, count, hinge) in RINGS {
        let report = solve(&parted(circular(half, t, count), spread, "first_order"));
        let angle = (90.0 - half + 2.0 * half * hinge as f64 / count as f64).to_radians();
        let height = (1.0 + 0.5 * t) - (1.0 - 0.5 * t) * angle.sin();
        let width = 0.5 * spread / height * t;
        for (joint, face, expected) in [
            (hinge, Face::Extrados, width),
            (count / 2, Face::Intrados, 2.0 * width),
            (count - hinge, Face::Extrados, width),
        ] {
            let crack = open(&report, joint);
            assert_eq!(crack.face, face, "{half} {t} {joint}");
            close(crack.width, expected, 2e-4, &format!("{half} {t}, joint {joint}"));
            assert!(crack.other == 0.0 && (crack.depth / t - 1.0).abs() < 1e-3, "{crack:?}");
        }
        let first = &report.settlement().unwrap().first_order;
        assert_eq!(first.open_joints.len(), 3, "{:?}", first.open_joints);
    }
}

/// The same at finite rotations: the chain of three hinges by hand.
#[test]
fn cracks_on_moving_geometry_are_those_of_the_moved_chain() {
    for (half, t, count, hinge) in RINGS {
        let spread = 0.05;
        let report = solve(&parted(circular(half, t, count), spread, "updated"));
        let ring = Ring::circular(half, t, count);
        let hinges = [(hinge, false), (count / 2, true), (count - hinge, false)];
        let chain = Parted::new(&ring, hinges, spread).unwrap();
        for (joint, extrados) in hinges {
            let crack = open(&report, joint);
            assert_eq!(crack.face == Face::Intrados, extrados);
            // The chain measures along the normal of what lies before, as a joint on the ground does; between stones the normal
            // is in the middle of both.
            let opening = chain.opening((joint, extrados)) / t;
            let between = 2.0 * t * (0.5 * (opening / t).asin()).sin();
            let expected = if joint % count == 0 { opening } else { between };
            close(crack.width, expected, 5e-4, &format!("{half} {t}, joint {joint}"));
        }
    }
}

#[test]
fn half_an_arch_opens_as_the_whole_does() {
    let mut half = circular(90.0, 0.15, 20);
    half["half"] = json!(true);
    let whole = solve(&parted(circular(90.0, 0.15, 20), 0.02, "first_order"));
    let left = solve(&moved(half, json!({"left": {"outwards_m": 0.01}}), "first_order"));
    for joint in [4, 10] {
        let [a, b] = [&whole, &left].map(|report| open(report, joint));
        assert_eq!(a.face, b.face);
        close(b.width, a.width, 1e-5, &format!("joint {joint}"));
    }
}

#[test]
fn forces_of_springings_and_soil_balance_the_loads() {
    let mut request = json!({
        "arch": {
            "profile": {"circular": {"span_m": 6.55, "rise_m": 1.428}}, "line": "intrados", "thickness": {"constant_m": 0.22},
            "voussoirs": 21
        },
        "stone": {"density_kg_m3": 2040, "friction_angle_deg": 40, "compressive_strength_pa": 1e30},
        "backfill": {"surface_height_m": 1.813, "density_kg_m3": 2040, "passive": {"friction_angle_deg": 30}},
        "loads": [{"load": {"self_weight": {}}}],
        "analysis": {"settlement": {"right": {"outwards_m": -0.004, "rotation_deg": 0.1}, "left": {"downwards_m": 0.002}}}
    });
    for geometry in ["first_order", "updated"] {
        request["geometry"] = json!(geometry);
        let answer = solved(&request);
        let name = if geometry == "updated" { "updated_geometry" } else { geometry };
        let path = &answer["settlement"][name];
        let last = |name: &str| path["history"][name].as_array().unwrap().last().unwrap().as_f64().unwrap();
        let elements = answer["structure"]["passive_elements"].as_array().unwrap();
        let forces = path["passive_n_per_m"].as_array().unwrap();
        assert_eq!(elements.len(), forces.len());
        let push =
            |(element, force): (&Value, &Value)| element["direction"].as_f64().unwrap() * force.as_f64().unwrap();
        let soil: f64 = elements.iter().zip(forces).map(push).sum();
        let weight: f64 = analysis(&request).unwrap().fixed.iter().map(|load| load.force.y).sum();
        let (thrust, right) = (last("thrust_n_per_m"), last("right_thrust_n_per_m"));
        println!("{geometry}: left {thrust}, right {right}, soil {soil}, of {} elements", elements.len());
        assert!(soil.abs() > 1e-3 * thrust, "the soil takes part: {soil}");
        assert!((thrust + right + soil).abs() < 1e-6 * weight.abs(), "{geometry}: {thrust} {right} {soil}");
        assert!((last("left_reaction_n_per_m") + last("right_reaction_n_per_m") + weight).abs() < 1e-6 * weight.abs());
    }
    let said = text(&request);
    for words in [
        "movement left springing: 0.002 m downwards right springing: 0.004 m inwards, turned to open the intrados by 0.1 deg",
        "soil presses",
        "Open joints at the end of the movement, on moving geometry joint opens at width, mm",
    ] {
        assert!(said.contains(words), "{words} in {said}");
    }
    assert!(!said.contains("need not balance"));
}

/// The greatest thrust of a semicircle passes through the ends of both springings and of joints on both haunches: cracks on one side,
/// on the other, or on both let the springings come nearer.
#[test]
fn cracks_that_may_be_elsewhere_are_noted() {
    let noted = |settlement: Value| {
        let answer = solved(&moved(circular(90.0, 0.15, 28), settlement, "first_order"));
        answer["notes"].as_array().unwrap().iter().any(|note| note.as_str().unwrap().contains("no more than three"))
    };
    assert!(noted(json!({"left": {"outwards_m": -5e-4}, "right": {"outwards_m": -5e-4}})));
    // One that opens at both springings and at the crown can do nothing else.
    let each = json!({"outwards_m": 5e-4});
    let flat = moved(circular(45.0, 0.1, 12), json!({"left": each, "right": each}), "first_order");
    let answer = solved(&flat);
    assert!(!answer["notes"].to_string().contains("no more than three"), "{}", answer["notes"]);
}

fn soft(voussoirs: usize, half: bool, loads: Value, settlement: Value) -> CollapseReport {
    let profile = json!({"circular": {"span_m": 6, "rise_m": 2}});
    solve(&json!({
        "arch": {"profile": profile, "thickness": {"constant_m": 0.5}, "voussoirs": voussoirs, "half": half},
        "loads": loads,
        "analysis": {"settlement": settlement},
    }))
}

/// Springings that hardly move leave the state at the start, whose gaps are those between the stones.
#[test]
fn a_joint_is_open_to_where_its_stones_touch() {
    let patch = json!({"load": {"patch_load": {"centre_x_m": -1.4, "width_m": 0.3, "force_n_per_m": 15000}}});
    let loads = json!([{"load": {"self_weight": {}}}, patch]);
    let report = soft(15, false, loads, json!({"right": {"outwards_m": 1e-10}}));
    let contacts = &report.at_start.as_ref().unwrap().contacts;
    let open = &report.settlement().unwrap().first_order.open_joints;
    assert!(open.len() >= 3, "{open:?}");
    for joint in open {
        let [a, b] = [0, 1].map(|end| contacts.iter().filter(|at| at.joint == joint.joint).nth(end).unwrap().gap);
        close(joint.depth, 0.5 * a.max(b) / (a - b).abs(), 1e-6, "depth");
    }
}

#[test]
fn half_an_arch_opens_at_the_crown_as_the_whole_does() {
    let weight = json!([{"load": {"self_weight": {}}}]);
    let outwards = json!({"outwards_m": 1e-4});
    let whole = soft(16, false, weight.clone(), json!({"left": outwards, "right": outwards}));
    let half = soft(16, true, weight, json!({"left": outwards}));
    let [of_whole, of_half] = [&whole, &half].map(|report| open(report, 8));
    close(of_half.width, of_whole.width, 1e-5, "width");
    close(of_half.depth, of_whole.depth, 1e-5, "depth");
    let gaps = |report: &CollapseReport| -> Vec<f64> {
        let contacts = &report.at_start.as_ref().unwrap().contacts;
        contacts.iter().filter(|at| at.joint == 8).map(|at| at.gap).collect()
    };
    for (half, whole) in gaps(&half).into_iter().zip(gaps(&whole)) {
        close(half, whole, 1e-5, "gap");
    }
}
