//! Notes on the positions of a vehicle.

use super::Digits;

/// Where joints slide at the worst of them.
pub const SLIDE: &str = "Joints slide as the structure falls there. Positions are compared by limit analysis, in which they dilate; the \
     least load at which they slide without dilating is looked for at that position only, and may be lower at another.";

/// What was looked at between positions solved.
pub fn between(solved: usize, tolerance: Digits) -> String {
    format!(
        "The worst position is that of {solved} solved by limit analysis, in which sliding joints dilate. By the \
         mechanisms found there the load is lower by no more than {tolerance} of it at any position between. A mechanism that \
         governs between two neighbouring positions only, and is not like theirs, is not seen: take a smaller step_m to look \
         closer."
    )
}

/// What is not known of some of them.
pub fn unknown(count: usize) -> String {
    format!(
        "At {count} positions rounding kept limit analysis from a part of its answer: the worst position is that of what is known."
    )
}
