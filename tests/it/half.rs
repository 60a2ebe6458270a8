//! Half a symmetric arch answers for the whole: every symmetric case of `cases/` and random symmetric arches, each
//! solved whole and in half, through the door. With a keystone the half ends in a mirror plane, without in a wall.

mod compare;
pub mod symmetric;

use crate::common::folders::{cases, folders, name};
use compare::{Pair, solve};
use serde_json::{Value, json};

/// Load factors, intensities and thrusts of half and whole agree to this share (issue: equal to 1e-6).
const SAME: f64 = 1e-6;
/// Random symmetric arches, from seed 0.
const ARCHES: u64 = 270;

/// Prints how far half and whole are apart, and fails where that is more than `SAME`.
///
/// Where joints slide without dilating, the load depends on stiffness and on the order in which contacts change: half
/// and whole may then differ as two meshes do, and how many do is printed.
fn judge(title: &str, pairs: &[(String, Pair)]) {
    let largest = |of: fn(&Pair) -> f64| pairs.iter().map(|(_, pair)| of(pair)).fold(0.0, f64::max);
    let count = |of: fn(&Pair) -> bool| pairs.iter().filter(|(_, pair)| of(pair)).count();
    println!("{title}: {} arches, {} fall, {} to one side", pairs.len(), count(|p| p.falls), count(|p| p.lopsided));
    println!("  windows, thrusts, plastic sections differ by {:.1e} at most", largest(|p| p.statics));
    println!("  loads by {:.1e} where no joint slides", largest(|p| if p.slides { 0.0 } else { p.path }));
    let sliding = count(|p| p.slides);
    println!("  and by as little on {} of {sliding} where joints slide", count(|p| p.slides && p.path <= SAME));
    let faults: Vec<String> = pairs
        .iter()
        .flat_map(|(name, pair)| pair.faults(SAME).into_iter().map(move |f| format!("{name}: {f}")))
        .collect();
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn every_symmetric_case_has_its_half() {
    let mut pairs = Vec::new();
    for folder in folders(&cases()) {
        let mut request: Value = serde_json::from_slice(&std::fs::read(folder.join("request.json")).unwrap()).unwrap();
        if request.get("arch").is_none() {
            continue;
        }
        let name = name(&folder);
        request["arch"]["half"] = json!(false);
        let mut half = request.clone();
        half["arch"]["half"] = json!(true);
        match solve(&half) {
            Ok(half) => pairs.push((name, Pair::new(&solve(&request).unwrap(), &half))),
            Err(faults) => {
                let lopsided = ["symmetric", "mirror image"].iter().any(|words| faults.contains(words));
                assert!(lopsided, "{name}: {faults}");
            }
        }
    }
    assert!(pairs.len() >= 10);
    judge("cases", &pairs);
}

#[test]
fn random_symmetric_arches_have_their_halves() {
    let mut pairs = [Vec::new(), Vec::new()];
    for seed in 0..ARCHES {
        let request = symmetric::request(seed);
        let mut half = request.clone();
        half["arch"]["half"] = json!(true);
        let odd = request["arch"]["voussoirs"].as_u64().is_some_and(|n| n % 2 == 1);
        let pair = Pair::new(&solve(&request).unwrap(), &solve(&half).unwrap());
        pairs[usize::from(odd)].push((format!("seed {seed}"), pair));
    }
    judge("random, joint at the crown", &pairs[0]);
    judge("random, keystone", &pairs[1]);
    // The set must go on asking real questions.
    assert!(pairs.iter().all(|pairs| pairs.iter().filter(|(_, pair)| pair.falls).count() >= 60));
}
