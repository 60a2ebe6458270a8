//! Random arches through the front door: the short version of `benches/random_arches.rs`.

use crate::common::verify::check;
use voussoir::collapse::Outcome;

/// How many, from seed 0.
const ARCHES: u64 = 200;

#[test]
fn random_arches_fall_where_limit_analysis_says() {
    let all: Vec<_> = (0..ARCHES).map(|seed| check(seed, true)).collect();
    let mut complaints = Vec::new();
    for checked in &all {
        complaints.extend(checked.complaints.iter().map(|words| format!("seed {}: {words}", checked.seed)));
    }
    let decided = all.iter().filter(|c| c.excess.is_some()).count() as u64;
    let compared = all.iter().filter(|c| c.window_error.is_some()).count() as u64;
    println!("{decided} of {ARCHES} fell at a finite load factor, {compared} windows held against the oracle");
    assert!(complaints.is_empty(), "{} complaints:\n{}", complaints.len(), complaints.join("\n"));
    // The set must go on asking real questions.
    assert!(decided >= ARCHES / 2 && compared >= ARCHES / 2);
}

/// One of a contact point whose gap is nought and stays so but for rounding, next to loads without end; and one at whose collapse
/// the next change of state is a hundred million spans away. The path of the first has no end; its stone crushes.
#[test]
fn rounding_is_no_change_of_state() {
    for seed in [6547, 6670] {
        let checked = check(seed, true);
        assert_eq!((checked.outcome, checked.complaints), (Some(Outcome::Collapse), Vec::new()), "seed {seed}");
    }
}
