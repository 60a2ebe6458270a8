//! Bridges, walls and portals drawn at random, each held against the oracle of any structure.
//!
//! `cargo bench --bench structures` holds many more.

use crate::common::door;
use crate::common::rigid_blocks::full_solution::{Gap, measure};
use crate::common::rigid_blocks::recheck::{Reported, recheck};
use crate::common::rigid_blocks::scene::{Load, Scene, Support};
use crate::common::rigid_blocks::wall::PUBLISHED;
use crate::common::structures::{FAMILIES, Judged, analysis, judge};
use serde_json::{Value, json};
use voussoir::budget::Budget;
use voussoir::collapse::{Outcome, Thrust, run};
use voussoir::limit::StaticTheorem;

/// How many of each kind.
const SCENES: u64 = 8;
/// Most of all that may say that they cannot tell.
const CANNOT_TELL: usize = 1;

#[test]
fn random_structures_fall_where_the_oracle_says_or_below_where_joints_slide() {
    let (mut untold, mut equal) = (Vec::new(), 0);
    for (name, scene) in FAMILIES {
        for seed in 0..SCENES {
            match judge(&scene(seed)).0 {
                Judged::Wrong(why) => panic!("{name} {seed}: {why}"),
                Judged::CannotTell(why) => untold.push(format!("{name} {seed}: {why}")),
                Judged::Equal => equal += 1,
                Judged::Below(_) | Judged::Slides => {}
            }
        }
    }
    println!("{equal} of {} equal, {} untold", 3 * SCENES, untold.len());
    assert!(untold.len() <= CANNOT_TELL, "{untold:?}");
    assert!(equal > SCENES, "only {equal} equal");
}

/// Its window is found by the interior point method.
#[test]
fn a_wall_of_many_stones_is_pushed_over_as_soon_from_either_side() {
    let (columns, courses) = (30, 20);
    let course = |k: usize| {
        let edge = move |i: usize| (i as f64 - 0.5 * (k % 2) as f64).clamp(0.0, columns as f64);
        let [bottom, top] = [k, k + 1].map(|k| 0.5 * k as f64);
        let block = move |i: usize| {
            let [left, right] = [edge(i), edge(i + 1)];
            vec![[left, bottom], [right, bottom], [right, top], [left, top]]
        };
        (0..columns + k % 2).map(block)
    };
    let scene = Scene {
        blocks: (0..courses).flat_map(course).collect(),
        supports: vec![Support { name: "ground".to_owned(), sides: (0..columns).map(|block| (block, 0)).collect() }],
        scaled: vec![Load::Acceleration([1.0, 0.0])],
        density: 2000.0,
        friction_angle_deg: 35.0,
    };
    let wall = analysis(&scene);
    let theorem = StaticTheorem::new(&wall.structure, &wall.fixed, &wall.scaled).unwrap();
    // 30 joints on the ground, 60 between every two courses, 29 or 30 in a course; 30 or 31 blocks in one.
    assert_eq!(theorem.loops().len(), 30 + 19 * 60 + 10 * (29 + 30) - 10 * (30 + 31));
    let [lowest, highest] = theorem.window(&Budget::unlimited()).unwrap().ends().unwrap();
    // At the latest it slides off the ground.
    let slides = scene.friction_angle_deg.to_radians().tan();
    assert!(highest > 0.0 && highest <= slides * (1.0 + 1e-9), "{highest} beyond {slides}");
    assert!((lowest + highest).abs() < 1e-8 * highest, "{lowest} to {highest}");
}

/// A wall one stone wide of so many courses, without the right half of one: the stone above rests on its very tip.
fn on_its_tip(courses: usize, missing: usize, height: f64, strength: f64) -> Value {
    let halves = |course: usize| if course.is_multiple_of(2) { vec![[0.0, 0.4]] } else { vec![[0.0, 0.2], [0.2, 0.4]] };
    let stones = (0..courses).flat_map(|course| {
        let kept = if course == missing { 1 } else { 2 };
        halves(course).into_iter().take(kept).map(move |[left, right]| {
            let [bottom, top] = [course, course + 1].map(|rows| rows as f64 * height);
            json!({"name": format!("{course}, {left}"), "corners_m": [[left, bottom], [right, bottom], [right, top], [left, top]]})
        })
    });
    let polygons: Vec<Value> = stones.collect();
    json!({
        "blocks": {"polygons": polygons, "joints": "found", "supports": [{"name": "ground", "segments_m": [[[-1, 0], [2, 0]]]}]},
        "stone": {"friction_angle_deg": 30, "compressive_strength_pa": strength},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"body_acceleration": {"x_g": 1}}, "scaled": true}
        ]
    })
}

#[test]
fn a_stone_on_its_very_tip_falls_at_nought() {
    // No stone of usual strength is borne by its tip.
    for (strength, outcome) in [(1e7, Outcome::Crushes), (1e16, Outcome::Collapse)] {
        for (courses, missing) in [(4, 1), (5, 3), (6, 1), (7, 3)] {
            for height in [0.1, 0.2, 0.3] {
                let report = door::solve(&on_its_tip(courses, missing, height, strength));
                let highest = report.limit_window.as_ref().map(|window| window.highest);
                assert_eq!(
                    (report.outcome, highest),
                    (outcome, Some(0.0)),
                    "{courses} of {height} m: {:?}",
                    report.notes
                );
                assert!(report.end.unwrap().load_factor.abs() < 1e-15);
            }
        }
    }
}

/// What falls to one side when it is pushed there falls to the other side when it is pushed the other way.
#[test]
fn mirrored_structures_have_mirrored_answers() {
    for (name, scene) in FAMILIES {
        for seed in 0..2 {
            let (scene, image) = (scene(seed), scene(seed).mirrored());
            let [(here, one), (there, other)] = [judge(&scene), judge(&image)];
            for judged in [&here, &there] {
                assert!(!matches!(judged, Judged::Wrong(_)), "{name} {seed}: {judged:?}");
            }
            let (Judged::Equal, Judged::Equal) = (here, there) else { continue };
            let [one, other] = [one, other].map(|report| report.unwrap().end.map(|end| end.load_factor));
            match (one, other) {
                (Some(a), Some(b)) => assert!((a - b).abs() <= 1e-7 * a.abs().max(1.0), "{name} {seed}: {a}, {b}"),
                (a, b) => assert_eq!(a.is_some(), b.is_some(), "{name} {seed}"),
            }
        }
    }
}

/// Sliding that does not dilate: the least load found is a full solution, and as low as any that is known.
#[test]
fn walls_of_the_literature_fall_at_the_least_load_known() {
    for wall in &PUBLISHED {
        let scene = wall.scene();
        let (report, problem) = (run(&analysis(&scene), &Budget::unlimited()).unwrap(), scene.problem());
        let high = report.limit_window.unwrap().highest;
        assert!((high / wall.associated - 1.0).abs() < 2e-6, "wall {}: {high}", wall.number);
        let end = report.end.unwrap();
        let range = end.range.unwrap();
        println!("wall {}: {range:?}, {:.6} known", wall.number, wall.least_found);
        assert!((range.path / wall.published - 1.0).abs() < 0.01 && range.least == end.load_factor);
        // What is known is an upper estimate. Of the largest wall it is hard to come by.
        let near = if wall.number == 6 { 1.0025 } else { 1.001 };
        assert!((0.98..near).contains(&(range.least / wall.least_found)), "wall {}", wall.number);
        let forces: Vec<Reported> = end.thrust_line.iter().map(reported).collect();
        let statics = recheck(&problem, end.load_factor, &forces);
        assert!(statics.residual < 1e-9 && statics.violation < 1e-9, "wall {}: {statics:?}", wall.number);
        let motion @ Gap { entering, opens_under_force, slides_freely, power } =
            measure(&problem, end.load_factor, &forces, &end.mechanism.velocities);
        let fine = entering < 1e-7 && opens_under_force < 1e-9 && slides_freely < 1e-9 && power > 1e-3;
        assert!(fine, "wall {}: {motion:?}", wall.number);
    }
}

fn reported(thrust: &Thrust) -> Reported {
    Reported { normal: thrust.normal, shear: thrust.shear, eccentricity: thrust.eccentricity }
}
