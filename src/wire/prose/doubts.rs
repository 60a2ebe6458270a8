//! Why a load path is not taken at its word, in sentences.

use super::Digits;
use crate::collapse::Doubt;

const SLIDES_INSIDE: &str = "The arch falls by sliding as its loads come on. Limit analysis, which lets sliding joints dilate \
     (associated friction), finds equilibrium; joints that do not dilate need not reach it. Whether it stands depends on how \
     it was built.";
const NO_CERTIFICATE: &str = "Limit analysis gave no answer: rounding kept its programme from one, so nothing is known of the \
     window that the load path would be held against.";
const LOOSE_STONES: &str = "Stones that carry neither weight nor load, or loads that cancel, are free to move, so the load path \
     cannot be followed. Give the arch its self weight, or leave out what cancels it.";

/// One of the doubts.
pub fn doubted(doubt: &Doubt) -> String {
    match doubt {
        Doubt::Slender { thickness, share } => format!(
            "The arch is too slender for its load path to be followed: its thickest joint is {} m, {} of its size, and rounding \
             would decide. Check the unit of its thickness.",
            Digits(*thickness),
            Digits(*share)
        ),
        Doubt::NotLoaded => "The loads at the start could not be brought on.".into(),
        Doubt::NoCertificate => NO_CERTIFICATE.into(),
        Doubt::Unbalanced(share) => {
            format!("Equilibrium was kept to {} of the loads only, too coarse to be trusted.", Digits(*share))
        }
        Doubt::BreaksLaw { load_factor, joint, amount } => format!(
            "At load factor {} the state on the load path breaks the contact law: at joint {joint} forces of {} of the loads \
             are missing.",
            Digits(*load_factor),
            Digits(*amount)
        ),
        Doubt::Lost => "The load path could not be followed to its end.".into(),
        Doubt::StandsOutside => "The load path stands where limit analysis finds no equilibrium.".into(),
        Doubt::FallsInside => "The load path falls without sliding where limit analysis finds equilibrium.".into(),
        Doubt::SlidesInside => SLIDES_INSIDE.into(),
        Doubt::LooseStones => LOOSE_STONES.into(),
        Doubt::TurnedBack(highest) => turned_back(Digits(*highest)),
        Doubt::Stray { path, limit } => stray(Digits(*path), *limit),
        Doubt::Above { path, limit } => {
            let [path, limit] = apart([*path, *limit]);
            format!("The load path passes the limit window (load factor {path} against {limit}).")
        }
        Doubt::Short { path, limit } => {
            let [path, limit] = apart([*path, *limit]);
            format!(
                "The load path ends at load factor {path} without sliding, short of the limit window's end {limit}."
            )
        }
    }
}

/// Two numbers with so many digits that they differ.
fn apart(numbers: [f64; 2]) -> [String; 2] {
    let [a, b] = numbers.map(|number| Digits(number).to_string());
    if a == b { numbers.map(|number| number.to_string()) } else { [a, b] }
}

fn turned_back(highest: Digits) -> String {
    format!(
        "After load factor {highest}, its farthest, the load path runs back past its start: joints slide and jam there, and no \
         mechanism was found in which the arch falls. It may bear more, up to the limit window's end."
    )
}

fn stray(path: Digits, limit: f64) -> String {
    let allows = match limit.is_infinite() {
        true => "never lets the arch fall".into(),
        false => format!("allows {}", Digits(limit)),
    };
    format!(
        "The load path turns back at load factor {path} and ends in sliding joints that are not at the limit of their friction \
         there; limit analysis {allows}."
    )
}
