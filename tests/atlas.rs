//! A thin slice of the atlas of hard scenes (`benches/atlas/`): ours is right in all of it, or says that it cannot tell.
#![cfg(feature = "server")]
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stdout,
    dead_code,
    reason = "the atlas is a program of its own"
)]

mod common;

#[path = "../benches/atlas/judge.rs"]
mod judge;
#[path = "../benches/atlas/maps/mod.rs"]
mod maps;
#[path = "../benches/atlas/moving.rs"]
mod moving;
#[path = "../benches/atlas/ours.rs"]
mod ours;

use judge::{Mark, Truth};
use ours::ours;

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
            if analysis.arch.voussoirs.len() > MOST {
                continue;
            }
            let truth = Truth::of(common::door::problem(&analysis));
            let place = [0, 1].map(|i| map.axes[i].values[scene.at[i]]);
            match ours(scene, &analysis, &truth).mark {
                Mark::Right => decided += 1,
                Mark::Wrong(why) => wrong.push(format!("{name} at {place:?}, {}: {why}", scene.variant)),
                Mark::GaveUp(why) => {
                    println!("{name} at {place:?}, {}: cannot tell: {why}", scene.variant);
                    gave_up += 1;
                }
                Mark::Open => {}
            }
        }
    }
    println!("{decided} right, {gave_up} cannot tell");
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(decided >= 90 && gave_up <= 2, "{decided} right, {gave_up} cannot tell");
}
