//! What an outcome says is true, and every `cannot_tell` has a reason: windows that end at 0, arches that slide as built,
//! joints that part altogether, arches as thin as paper.

use crate::common::answered::{solved, text};
use crate::common::dice::Dice;
use crate::common::door;
use serde_json::{Value, json};
use voussoir::budget::Budget;
use voussoir::collapse::{CollapseReport, Mode, Note, Outcome, PathEnd};
use voussoir::geometry::Vec2;
use voussoir::structure::{Joint, Structure};

/// A semicircle whose weight is all its load, the load factor going down from 0.
fn weight_reversed() -> Value {
    json!({
        "arch": {
            "profile": {"circular": {"radius_m": 10, "opening_angle_deg": 180}},
            "thickness": {"constant_m": 1.5}, "voussoirs": 27
        },
        "loads": [{"load": {"self_weight": {}}, "scaled": true}],
        "load_factor": {"direction": "decrease"}
    })
}

#[test]
fn an_arch_whose_window_ends_at_0_collapses_there() {
    let request = weight_reversed();
    let found = solved(&request);
    assert_eq!(found["outcome"], "collapse");
    assert_eq!(found["ends"][0]["load_factor"], json!(0.0));
    assert_eq!(found["limit_window"], json!([0.0, null]));
    // Its weight reversed does work in the mechanism.
    let upwards: f64 =
        found["ends"][0]["velocities"]["y"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).sum();
    assert!(upwards > 0.0);
    let text = text(&request);
    assert!(text.contains("falls as soon as they act reversed"), "{text}");
    assert!(!text.contains("from 0 to 0"), "{text}");
}

#[test]
fn the_motion_of_an_arch_that_collapses_at_0_begins_just_beyond() {
    let mut request = weight_reversed();
    request["motion"] = json!({});
    let motion = &solved(&request)["ends"][0]["motion"];
    assert!(motion["load_factor"].as_f64().unwrap() < 0.0, "{motion}");
    let moved = motion["frames"]["largest_displacement_m"].as_array().unwrap().last().unwrap().as_f64();
    assert!(moved > Some(0.0));
}

#[test]
fn an_arch_that_stands_only_without_its_scaled_loads_is_not_safe_under_them() {
    let mut request = weight_reversed();
    request["loads"][0]["coefficient"] = json!(-1);
    request["load_factor"] = json!({});
    request["analysis"] = json!({"safety": {}});
    let found = solved(&request);
    assert_eq!(
        (&found["outcome"], &found["safety"]["governing"]["state"]),
        (&json!("collapse"), &json!("does_not_stand"))
    );
    assert!(!text(&request).contains("It stands only"));
}

/// Stones of which only two carry the load that is fixed.
#[test]
fn where_some_stones_carry_nothing_the_window_may_end_at_0_too() {
    let mut request = weight_reversed();
    // Two stones pressed down at the springings, which the rest does not need.
    let foot = |voussoir: usize| json!({"load": {"point_load": {"voussoir": voussoir, "force_n_per_m": 1e3}}});
    request["loads"].as_array_mut().unwrap().extend([foot(0), foot(26)]);
    let found = solved(&request);
    println!("{} {} {}", found["outcome"], found["ends"][0]["load_factor"], found["limit_window"]);
    assert_ne!(found["outcome"], "falls_as_built");
    assert!(!found["notes"].to_string().contains("from 0 to 0"), "{}", found["notes"]);
}

/// A stone pulled up between others, which only friction that dilates would hold.
fn pulled_up() -> Value {
    json!({
        "arch": {
            "profile": {"circular": {"radius_m": 2.0, "opening_angle_deg": 93.2}},
            "thickness": {"constant_m": 0.25}, "voussoirs": 5
        },
        "stone": {"friction_angle_deg": 29, "compressive_strength_pa": 1e30},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"point_load": {"force_n_per_m": -7114, "voussoir": 3}}}
        ]
    })
}

#[test]
fn an_arch_that_slides_where_limit_analysis_stands_has_its_own_outcome() {
    let request = pulled_up();
    let found = solved(&request);
    assert_eq!(found["outcome"], "slides_as_built");
    assert!(found["limit_window"].is_array() && !found["ends"][0]["slides"].as_array().unwrap().is_empty());
    let text = text(&request);
    assert!(text.contains("slides as its loads come on") && text.contains("depends on how it was built"), "{text}");
    let mut without_friction = request;
    without_friction["stone"]["friction_angle_deg"] = json!(0);
    let found = solved(&without_friction);
    assert_eq!((&found["outcome"], &found["limit_window"]), (&json!("falls_as_built"), &Value::Null));
}

/// Few stones, pulled up and shaken, so that joints lose all their force.
fn lifted(seed: u64) -> Value {
    let mut dice = Dice::new(seed);
    let voussoirs = 2 + dice.below(6);
    let mut loads = vec![json!({"load": {"self_weight": {}}})];
    let acceleration = json!({"x_g": dice.between(-0.3, 0.3), "y_g": dice.between(0.1, 1.0)});
    loads.push(match dice.below(3) {
        0 => {
            json!({"load": {"point_load": {"force_n_per_m": -1e3, "voussoir": dice.below(voussoirs)}}, "scaled": true})
        }
        _ => json!({"load": {"body_acceleration": acceleration}, "scaled": true}),
    });
    json!({
        "arch": {
            "profile": {"circular": {"radius_m": 2.0, "opening_angle_deg": dice.between(60.0, 180.0)}},
            "thickness": {"constant_m": dice.between(0.1, 0.8)}, "voussoirs": voussoirs
        },
        "stone": {"friction_angle_deg": dice.between(15.0, 80.0), "compressive_strength_pa": 1e30},
        "loads": loads
    })
}

/// Rates at which the ends of a joint open, from the velocities of the stones beside it: intrados, extrados.
fn openings(arch: &Structure, end: &PathEnd, k: usize) -> [f64; 2] {
    let velocity = |stone: Option<usize>, at: Vec2| match stone {
        Some(k) if k < arch.voussoirs().len() => {
            let ([u, v, spin], arm) = (end.mechanism.velocities[k], at - arch.bodies[k].region.centroid);
            Vec2::new(u - spin * arm.y, v + spin * arm.x)
        }
        _ => Vec2::zeros(),
    };
    let joint: &Joint = &arch.joints[k];
    [joint.intrados, joint.extrados]
        .map(|at| (velocity(Some(k), at) - velocity(k.checked_sub(1), at)).dot(&joint.normal()))
}

/// What is wrong with the lists of joints at one end of a path.
fn wrong_lists(arch: &Structure, end: &PathEnd) -> Option<String> {
    let mechanism = &end.mechanism;
    let largest = end.thrust_line.iter().map(|thrust| thrust.normal).fold(0.0, f64::max);
    for k in 0..arch.ring().len() {
        let [i, e] = openings(arch, end, k);
        let near = |a: f64, b: f64| (a - b).abs() < 1e-6 * arch.joints[k].length();
        let hinge = mechanism.hinges.iter().find(|hinge| hinge.joint == k);
        let lift_off = mechanism.lift_offs.iter().find(|lift_off| lift_off.joint == k);
        let slides = mechanism.slides.iter().any(|slide| slide.joint == k);
        let fits = match (hinge, lift_off) {
            (_, Some(_)) if slides => false,
            (Some(_), Some(_)) => false,
            (None, None) => near(i, 0.0) && near(e, 0.0),
            (Some(hinge), None) => {
                let opens = hinge.rotation * arch.joints[k].length();
                let expected = if hinge.face.to_string() == "intrados" { [0.0, opens] } else { [opens, 0.0] };
                near(i, expected[0]) && near(e, expected[1])
            }
            (None, Some(lift_off)) => {
                let free = end.thrust_line.get(k).is_none_or(|thrust| thrust.normal.abs() < 1e-8 * largest);
                near(i, lift_off.intrados) && near(e, lift_off.extrados) && i > 0.0 && e > 0.0 && free
            }
        };
        if !fits {
            return Some(format!("joint {k} opens by {i} and {e}: {hinge:?} {lift_off:?}"));
        }
    }
    None
}

#[test]
fn a_joint_that_parts_altogether_is_no_hinge() {
    let (mut parting, mut faults) = (0, Vec::new());
    for seed in 0..600 {
        let request = lifted(seed);
        let arch = door::analysis(&request).unwrap().structure;
        let report: CollapseReport = door::solve(&request);
        if report.outcome != Outcome::Collapse {
            continue;
        }
        for end in report.end.iter().chain(&report.other_end) {
            parting += usize::from(!end.mechanism.lift_offs.is_empty());
            faults.extend(wrong_lists(&arch, end).map(|fault| format!("{seed}: {fault}, {:?}", report.notes)));
            if !end.mechanism.lift_offs.is_empty() {
                let false_note = report.notes.contains(&Note::LaterMechanism);
                faults.extend(false_note.then(|| format!("{seed}: {:?}", report.notes)));
            }
        }
    }
    assert!(faults.is_empty(), "{} faults of {parting}:\n{}", faults.len(), faults.join("\n"));
    assert!(parting >= 20, "{parting}");
}

/// Pulled up about its left springing, whose hinge is all that holds it: in the closed form its weight is lifted with the lever
/// arms that the stones have about the extrados there.
#[test]
fn a_joint_that_parts_is_listed_with_the_rates_of_its_ends() {
    let request = json!({
        "arch": {
            "profile": {"circular": {"radius_m": 2.0, "opening_angle_deg": 62}},
            "thickness": {"constant_m": 0.5}, "voussoirs": 3
        },
        "stone": {"friction_angle_deg": 77, "compressive_strength_pa": 1e30},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"body_acceleration": {"x_g": -0.23, "y_g": 0.48}}, "scaled": true}
        ]
    });
    let found = solved(&request);
    let arch = door::analysis(&request).unwrap().structure;
    let (area, centroid) = arch.voussoirs().iter().fold((0.0, Vec2::zeros()), |(area, sum), stone| {
        (area + stone.region.area, sum + stone.region.area * stone.region.centroid)
    });
    let arm = centroid / area - arch.joints[0].extrados;
    // Weight and acceleration balance about the hinge: lambda (y_g arm_x - x_g arm_y) = arm_x.
    let expected = arm.x / (0.48 * arm.x + 0.23 * arm.y);
    let factor = found["ends"][0]["load_factor"].as_f64().unwrap();
    assert!((factor / expected - 1.0).abs() < 1e-7, "{factor} {expected}");
    let end = &found["ends"][0];
    let [hinge] = &end["hinges"].as_array().unwrap()[..] else { panic!("{}", end["hinges"]) };
    assert_eq!((&hinge["joint"], &hinge["face"]), (&json!(0), &json!("extrados")));
    let [parts] = &end["lift_offs"].as_array().unwrap()[..] else { panic!("{}", end["lift_offs"]) };
    assert_eq!(parts["joint"], 3);
    // It moves along the ground too, which no friction opposes: no joint slides.
    assert_eq!(end["slides"], json!([]));
    let rise = |at: Vec2| (at - arch.joints[0].extrados).dot(&-arch.joints[3].tangent());
    for (end, at) in [("intrados", arch.joints[3].intrados), ("extrados", arch.joints[3].extrados)] {
        // The stones turn anticlockwise at rate 1 about the hinge; the ground beyond joint 3 stays.
        let rate = parts[end].as_f64().unwrap();
        assert!((rate - rise(at).abs()).abs() < 1e-6, "{end}: {rate} {}", rise(at));
    }
    assert!(text(&request).contains("Joints that part altogether"));
}

#[test]
fn an_arch_too_thin_for_its_path_is_told_why() {
    for thickness in [2e-5, 2.7e-8, 1e-11, 1e-14] {
        let request = json!({
            "arch": {
                "profile": {"circular": {"radius_m": 4, "opening_angle_deg": 180}},
                "thickness": {"constant_m": thickness}, "voussoirs": 22
            },
            "loads": [{"load": {"self_weight": {}}}]
        });
        let found = solved(&request);
        assert_eq!(found["outcome"], "cannot_tell", "{thickness}");
        assert!(found["notes"].to_string().contains("too slender"), "{thickness}: {}", found["notes"]);
    }
}

/// An arch along a catenary, funicular to its own weight, of this thickness, m, and a span of 2 m.
fn catenary(thickness: f64) -> Value {
    let (end, count) = (1f64.sinh(), 20);
    let joint = |k: usize| {
        let slope = -end + 2.0 * end * k as f64 / f64::from(count);
        let (x, cosh) = (slope.asinh(), slope.hypot(1.0));
        let off = 0.5 * thickness / cosh;
        let at = |sign: f64| json!([x + sign * off * slope, 1f64.cosh() - cosh + sign * off]);
        [at(-1.0), at(1.0)]
    };
    let joints: Vec<[Value; 2]> = (0..=count as usize).map(joint).collect();
    let face = |i: usize| joints.iter().map(|joint| joint[i].clone()).collect::<Vec<_>>();
    json!({
        "arch": {"profile": {"surveyed": {"intrados_m": face(0), "extrados_m": face(1)}}},
        "stone": {"friction_angle_deg": 45, "compressive_strength_pa": 1e30},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"body_acceleration": {"x_g": 1}}, "scaled": true}
        ]
    })
}

#[test]
fn a_thin_arch_that_can_be_told_still_is() {
    for thickness in [1e-2, 1e-3, 1e-4] {
        let found = solved(&catenary(thickness));
        assert_eq!(found["outcome"], "collapse", "{thickness}");
    }
    assert_eq!(solved(&catenary(1e-5))["outcome"], "cannot_tell");
}

#[test]
fn every_cannot_tell_has_a_reason() {
    let mut told = 0;
    for seed in 0..400 {
        let mut request = lifted(seed);
        let mut dice = Dice::new(seed ^ 0xABCD);
        request["arch"]["thickness"]["constant_m"] = json!(dice.decades(1e-9, 0.5));
        let Ok(analysis) = door::analysis(&request) else { continue };
        let report = voussoir::collapse::run(&analysis, &Budget::unlimited()).unwrap_or_else(|e| panic!("{seed}: {e}"));
        if report.outcome == Outcome::CannotTell {
            told += 1;
            assert!(!report.notes.is_empty(), "{seed}");
        }
    }
    assert!(told > 20, "{told}");
}

/// Two spans on a slender pier: the loaded one goes down, the other one up, and nearly as fast.
#[test]
fn the_mode_is_that_of_the_loaded_span() {
    let span = json!({
        "profile": {"circular": {"span_m": 10, "rise_m": 3}}, "rings": [{"thickness_m": 0.6, "voussoirs": 31}]
    });
    for (load, crown) in [(-5.8, 15), (5.8, 46)] {
        let patch = json!({"centre_x_m": load, "width_m": 1, "force_n_per_m": 1000, "dispersal": {}});
        let report = door::solve(&json!({
            "bridge": {"spans": [span, span], "piers": [{"top_width_m": 1.6, "height_m": 9, "courses": 9}]},
            "stone": {"density_kg_m3": 2200, "friction_angle_deg": 35, "compressive_strength_pa": 6e6},
            "backfill": {"surface_height_m": 4.2, "density_kg_m3": 1800},
            "loads": [{"load": {"self_weight": {}}}, {"load": {"patch_load": patch}, "scaled": true}],
        }));
        for end in report.ends() {
            let states = [Some(end.state), end.uncrushed];
            for mechanism in states.into_iter().flatten().map(|state| &state.mechanism) {
                let down = mechanism.velocities[crown][1];
                assert!(mechanism.mode == Mode::CrownDescends && down < 0.0, "{load}: {:?}, {down}", mechanism.mode);
            }
        }
    }
}
