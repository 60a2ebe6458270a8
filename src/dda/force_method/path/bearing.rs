//! How much more shear the points of an interface bear, either way.

use super::super::{Linear, Loaded};
use super::borders::Border;
use crate::dda::contact::Law;

/// A function that never changes sign.
pub(super) const NEVER: Linear = [0.0, 0.0, 0.0, 1.0, 0.0];

/// Of the points of an interface that stick: of the first one in the way of its shear's sign and against it, then of the second.
pub(super) fn of(chain: &Loaded, k: usize) -> Border {
    let statics = &chain.method.statics[k];
    let shear = chain.linear(k, &statics.shear);
    let of = |which: usize| -> (Linear, f64) {
        let (point, sign) = (which / 2, [1.0, -1.0][which % 2]);
        let Law::Coulomb { friction, .. } = chain.contacts[2 * k + point].law else { return (NEVER, 0.0) };
        let normal = chain.linear(k, &statics.normals[point]);
        // The first point has V / 2 + t, the second V / 2 - t.
        let by_split = if point == 0 { -sign } else { sign };
        (std::array::from_fn(|c| friction * normal[c] - 0.5 * sign * shear[c]), by_split)
    };
    let all: [(Linear, f64); 4] = std::array::from_fn(of);
    Border::of(all.map(|(function, _)| function), all.map(|(_, by_split)| by_split))
}
