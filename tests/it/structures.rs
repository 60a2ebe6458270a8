//! Bridges, walls and portals drawn at random, each held against the oracle of any structure.
//!
//! `cargo bench --bench structures` holds many more.

use crate::common::structures::{FAMILIES, Judged, judge};

/// How many of each kind.
const SCENES: u64 = 12;
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

/// What falls to one side when it is pushed there falls to the other side when it is pushed the other way.
#[test]
fn mirrored_structures_have_mirrored_answers() {
    for (name, scene) in FAMILIES {
        for seed in 0..4 {
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
