//! A thin slice of the atlas of hard scenes (`benches/atlas/`): ours is right in all of it, or says that it cannot tell.
#![allow(dead_code, reason = "the atlas is a program of its own")]

#[path = "../../benches/atlas/cells.rs"]
mod cells;
#[path = "../../benches/atlas/judge.rs"]
mod judge;
#[path = "../../benches/atlas/maps/mod.rs"]
mod maps;
#[path = "../../benches/atlas/moving.rs"]
mod moving;
#[path = "../../benches/atlas/ours.rs"]
mod ours;
#[path = "../../benches/atlas/sheet.rs"]
mod sheet;

use cells::{Cells, MARKS, Method, NOT_RUN};
use judge::{Mark, Truth};
use ours::ours;
use voussoir::collapse::Outcome;

/// Every so many scenes of a map are run, of arches of at most so many voussoirs.
const EVERY: usize = 47;
const MOST: usize = 33;

#[test]
fn hard_scenes_get_no_wrong_number() {
    let (mut wrong, mut gave_up, mut decided) = (Vec::new(), 0, 0);
    for (name, build) in maps::MAPS {
        let map = build();
        for scene in map.scenes.iter().step_by(EVERY) {
            let Ok(analysis) = scene.analysis() else { continue };
            if analysis.structure.voussoirs().len() > MOST {
                continue;
            }
            let truth = Truth::of(crate::common::door::problem(&analysis)).known(scene.stands);
            let place = [0, 1].map(|i| map.axes[i].values[scene.at[i]]);
            match ours(scene, &analysis, &truth).mark {
                Mark::Right => decided += 1,
                Mark::Wrong(why) => wrong.push(format!("{name} at {place:?}, {}: {why}", scene.variant)),
                Mark::GaveUp(why) => {
                    println!("{name} at {place:?}, {}: cannot tell: {why}", scene.variant);
                    gave_up += 1;
                }
                Mark::Unproven(_) | Mark::Open => {}
            }
        }
    }
    println!("{decided} right, {gave_up} cannot tell");
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(decided >= 100 && gave_up <= 1, "{decided} right, {gave_up} cannot tell");
}

/// Our answer in one place of a map, axis values given.
fn at(map: &str, place: [f64; 2], variant: &str) -> ours::Ours {
    let (_, build) = maps::MAPS.iter().find(|(name, _)| *name == map).expect("a map");
    let map = build();
    let here = |scene: &&maps::Scene| {
        let values = [0, 1].map(|i| map.axes[i].values[scene.at[i]]);
        scene.variant == variant && (0..2).all(|i| (values[i] - place[i]).abs() <= 1e-9 * place[i].abs())
    };
    let scene = map.scenes.iter().find(here).expect("a scene");
    let analysis = scene.analysis().expect("an arch");
    let truth = Truth::of(crate::common::door::problem(&analysis)).known(scene.stands);
    ours(scene, &analysis, &truth)
}

/// Between joints that lean by a millionth of a degree stones slide by a hundred times the arch's size until they are held.
#[test]
fn stones_that_slide_farther_than_the_arch_is_large_have_fallen() {
    let found = at("tilt", [1e-6, 10.0], "crown");
    assert_eq!((found.mark, found.outcome), (Mark::Right, Some(Outcome::SlidesAsBuilt)));
    assert!(found.slides > 0);
}

/// A lintel of length l, height h and weight W slides down between joints that lean by a until it is pressed together enough:
/// by W l / (4 E h tan(friction + a) sin a) at either end, its joints left out. Where that is many times as long as a joint, and
/// rounding of it more than is trusted of the path, it has slid out; where the path can be trusted, it is followed.
#[test]
fn stones_that_have_slid_out_of_their_joints_are_no_arch_in_doubt() {
    let slides = |lean: f64, friction: f64| {
        let ([lean, friction], weight) = ([lean, friction].map(f64::to_radians), 10.0 * 2300.0 * 9.81);
        weight * 10.0 / (4.0 * 1e10 * (friction + lean).tan() * lean.sin())
    };
    for (lean, friction, variant) in [(1e-4, 5.0, "crown"), (1e-4, 18.0, "crown"), (1e-3, 8.0, "haunch")] {
        let found = at("tilt", [lean, friction], variant);
        assert_eq!((found.mark, found.outcome), (Mark::Right, Some(Outcome::SlidesAsBuilt)));
        assert!(slides(lean, friction) > 10.0 && found.slides > 0);
    }
    let found = at("tilt", [1.0, 5.0], "haunch");
    assert_eq!((found.mark, found.outcome), (Mark::Right, Some(Outcome::Stands)));
    assert!(slides(1.0, 5.0) < 1.0);
}

/// The scaled loads do next to no work in the mechanism at a load factor of a hundred thousand: the fixed ones tell it.
#[test]
fn a_mechanism_far_out_is_found_by_the_work_of_the_fixed_loads() {
    let found = at("never", [5.0, 0.12], "rough");
    assert_eq!((found.mark, found.outcome), (Mark::Right, Some(Outcome::Collapse)));
}

/// A load a billionth below its greatest value stands, and one a billionth above it falls.
#[test]
fn loads_at_the_ends_of_the_window_are_told_apart() {
    for (near, outcome) in [(-9.0, Outcome::Stands), (9.0, Outcome::FallsAsBuilt)] {
        let found = at("window", [near, -5.0], "down");
        assert_eq!((found.mark, found.outcome), (Mark::Right, Some(outcome)));
    }
}

/// Limit analysis never lets this flat arch fall, and a path that strayed into sliding joints is no proof that it does.
#[test]
fn a_path_that_strays_into_sliding_is_no_collapse() {
    let found = at("tilt", [0.3, 60.0], "crown");
    assert!(matches!(found.mark, Mark::Right | Mark::GaveUp(_)), "{found:?}");
}

/// Beside contacts a thousand times stiffer than the stone and more, rounding of their stiffness passes for resistance of a
/// mechanism.
#[test]
fn contacts_far_stiffer_than_the_stone_do_not_hide_a_mechanism() {
    for penalty in [3.0, 3.5, 5.0, 5.5] {
        let found = at("penalty", [10f64.powf(penalty), 21.0], "haunch");
        assert_eq!((&found.mark, found.outcome), (&Mark::Right, Some(Outcome::Collapse)), "1e{penalty}");
    }
}

fn committed(name: &str) -> String {
    std::fs::read_to_string(format!("{}/cases/hard/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

/// The marks of all maps, as the bench wrote them.
fn marks() -> Vec<Cells> {
    serde_json::from_str(&committed("atlas.json")).unwrap()
}

#[test]
fn a_place_has_its_worst_mark() {
    let scenes = |at: [usize; 2]| match at {
        [0, 0] => vec![0, 4, 2],
        [1, 0] => vec![0, NOT_RUN, 0],
        [0, 1] => vec![NOT_RUN],
        _ => Vec::new(),
    };
    let method = Method::of("some", [2, 2], scenes);
    assert_eq!(method.rows, ["  ", "x."]);
    let marks = [[0, 0], [1, 0], [0, 1], [1, 1], [0, 2], [2, 0]].map(|at| method.mark(at));
    assert_eq!(marks, [4, 0, NOT_RUN, NOT_RUN, NOT_RUN, NOT_RUN]);
}

#[test]
fn marks_of_classic_methods_are_kept_where_the_map_is_the_same() {
    let earlier = marks();
    let mut now = earlier[0].clone();
    now.methods.iter_mut().for_each(|method| method.rows.iter_mut().for_each(|row| *row = row.replace(|_| true, ".")));
    let kept = now.clone().with_classic_of(&earlier);
    assert_eq!((&kept.methods[0], &kept.methods[1..]), (&now.methods[0], &earlier[0].methods[1..]));
    now.up.values[0] += 1.0;
    assert_eq!(now.clone().with_classic_of(&earlier), now);
}

#[test]
fn pages_show_the_marks() {
    let pages = sheet::pages(&marks());
    assert_eq!(pages.len(), 2);
    for (i, page) in pages.iter().enumerate() {
        let name = format!("atlas-{}.svg", i + 1);
        assert!(*page == committed(&name), "{name} is not what `cargo bench --bench atlas -- --from` draws");
    }
}

/// All letters are on the page, of eight points or more.
#[test]
fn pages_can_be_read() {
    let [width, height] = sheet::PAGE;
    assert!(((height / width) / 2f64.sqrt() - 1.0).abs() < 1e-3);
    for page in sheet::pages(&marks()) {
        for text in page.split("<text ").skip(1) {
            let number = |name: &str| -> Option<f64> {
                text.split('>').next()?.split(&format!("{name}=\"")).nth(1)?.split('"').next()?.parse().ok()
            };
            let [x, y] = ["x", "y"].map(|name| number(name).unwrap());
            let size = number("font-size").unwrap_or(sheet::LETTERS);
            let words = text.split('>').nth(1).unwrap().split('<').next().unwrap();
            // Letters are about half as wide as high.
            let long = if text.contains("text-anchor") { 0.0 } else { 0.52 * size * words.chars().count() as f64 };
            assert!(
                size >= 10.6 && x >= 0.0 && x + long <= width && y - size >= 0.0 && y <= height,
                "{words}: {x} + {long}, {y}"
            );
        }
    }
}

/// Every map is there with all its places, and in none of them is ours wrong.
#[test]
fn the_marks_are_whole() {
    let all = marks();
    let names: Vec<&str> = all.iter().map(|map| map.name.as_str()).collect();
    assert_eq!(names, maps::MAPS.map(|(name, _)| name));
    for map in &all {
        let [across, up] = [&map.across, &map.up].map(|scale| scale.values.len());
        assert_eq!(map.methods.len(), 4);
        for method in &map.methods {
            let row = |row: &String| row.len() == across && row.chars().all(|mark| MARKS.contains(&mark));
            assert!(method.rows.len() == up && method.rows.iter().all(row), "{}, {}", map.name, method.name);
        }
        let ours = map.methods[0].rows.concat();
        assert!(ours.contains('.') && !ours.contains('x'), "{}", map.name);
    }
}
