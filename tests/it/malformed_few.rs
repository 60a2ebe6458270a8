//! The short version of `tests/load/malformed.rs`: a few thousand malformed and extreme bodies.

use crate::common::dice::{self, Dice};
use crate::common::folders;
use crate::contract::bodies;
use held::{Answers, is_small, read, seeds, solve};
use inputs::{KINDS, input};

#[path = "../load/held.rs"]
mod held;
#[path = "../load/inputs.rs"]
mod inputs;

/// How many, from seed 0.
const BODIES: u64 = 6000;

#[test]
fn malformed_bodies_are_refused_and_extreme_ones_answered() {
    let (seeds, answers) = (seeds(), Answers::new());
    let (mut accepted, mut solved) = (0, 0);
    for number in 0..BODIES {
        let mut dice = Dice::new(number);
        let kind = dice.below(KINDS.len());
        let body = input(kind, &seeds, &mut dice);
        let Some((request, question)) = read(&body) else { continue };
        accepted += 1;
        if is_small(&question) && dice.chance(0.05) {
            solve(&request, &question, 300, &answers);
            solved += 1;
        }
    }
    println!("{accepted} of {BODIES} accepted, {solved} of these solved");
    assert!((BODIES / 20..=BODIES / 2).contains(&accepted) && solved >= 10);
}
