//! Bodies in a row between two pieces of ground.

use voussoir::dda::Beside;

/// What lies before and after interface `k` of so many `bodies` in a row.
pub fn in_a_row(k: usize, bodies: usize) -> [Beside; 2] {
    let before = k.checked_sub(1).map_or(Beside::Ground(0), Beside::Body);
    [before, if k < bodies { Beside::Body(k) } else { Beside::Ground(1) }]
}
