//! Friction: which point of an interface slides, so that the split of its shear is prescribed.

use super::{ChainState, Linear, Loaded, Three, is_smooth, value};
use crate::budget::{Budget, Stopped};
use crate::dda::contact::{Contact, Law};

/// How often the way between two states is halved to tell that no interface slides on it.
const HALVINGS: usize = 7;

/// How the shear through an interface is split between its points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Split {
    /// As its equation says: both points stick.
    Held,
    /// This point slides; +1 or -1: the sign of its shear.
    Slides(usize, f64),
    /// This point is open.
    Open(usize),
    /// The interface is smooth.
    Smooth,
}

fn friction(contact: &Contact) -> f64 {
    if let Law::Coulomb { friction, .. } = contact.law { friction } else { f64::INFINITY }
}

impl Loaded<'_> {
    /// Splits with which to begin.
    pub(super) fn held(&self) -> Vec<Split> {
        let split = |pair: &[Contact; 2]| if is_smooth(&pair[0]) { Split::Smooth } else { Split::Held };
        self.contacts.as_chunks::<2>().0.iter().map(split).collect()
    }

    /// The split of interface `k`, where it is prescribed.
    pub(super) fn prescribed(&self, k: usize, split: Split) -> Option<Linear> {
        let statics = &self.method.statics[k];
        let (point, bound) = match split {
            Split::Held => return None,
            Split::Smooth => return Some([0.0; 5]),
            Split::Slides(point, sign) => (point, sign * friction(&self.contacts[2 * k + point])),
            Split::Open(point) => (point, 0.0),
        };
        // The first point has V / 2 + t, the second V / 2 - t.
        let sign = if point == 0 { 1.0 } else { -1.0 };
        let row = std::array::from_fn(|c| sign * (bound * statics.normals[point][c] - 0.5 * statics.shear[c]));
        Some(self.linear(k, &row))
    }

    /// Change of the split of interface `k` with the redundants by which the point that does not stick has no virtual shear.
    pub(super) fn virtual_split(&self, k: usize, split: Split) -> Option<Three> {
        let half = match split {
            Split::Held | Split::Smooth => return None,
            Split::Slides(0, _) | Split::Open(0) => -0.5,
            Split::Slides(..) | Split::Open(_) => 0.5,
        };
        Some(self.method.statics[k].shear.map(|v| half * v))
    }

    /// The splits as the law has them in a state that was found with others.
    pub(super) fn renewed(&self, state: &ChainState) -> Vec<Split> {
        let ChainState { load_factor, redundants, splits, open, reduced } = state;
        let renewed = |(k, &split): (usize, &Split)| {
            if split == Split::Smooth {
                return split;
            }
            if let Some(opening) = open.iter().find(|opening| opening.interface == k) {
                return Split::Open(opening.point);
            }
            let at = |of: &Linear| value(of, redundants, *load_factor);
            let [least, most] = self.ends(k, state);
            match split {
                Split::Slides(0, 1.0) | Split::Slides(1, -1.0) if at(&self.off(k, &reduced.splits)) <= 0.0 => most.1,
                Split::Slides(0, -1.0) | Split::Slides(1, 1.0) if at(&self.off(k, &reduced.splits)) >= 0.0 => least.1,
                Split::Slides(..) => Split::Held,
                _ => match at(&reduced.splits[k]) {
                    here if here < least.0 => least.1,
                    here if here > most.0 => most.1,
                    _ => Split::Held,
                },
            }
        };
        splits.iter().enumerate().map(renewed).collect()
    }

    /// The least and the greatest split of interface `k` with which neither point slides, and which of them does there.
    fn ends(&self, k: usize, state: &ChainState) -> [(f64, Split); 2] {
        let (normals, shear) = self.method.statics[k].at(&self.resultant(k, &state.redundants, state.load_factor));
        let [first, second] = [0, 1].map(|p| match self.contacts[2 * k + p].law {
            Law::Bonded => f64::INFINITY,
            Law::Coulomb { friction, .. } => friction * normals[p].max(0.0),
        });
        let half = 0.5 * shear;
        let least = if -first - half >= half - second {
            (-first - half, Split::Slides(0, -1.0))
        } else {
            (half - second, Split::Slides(1, 1.0))
        };
        let most = if first - half <= half + second {
            (first - half, Split::Slides(0, 1.0))
        } else {
            (half + second, Split::Slides(1, -1.0))
        };
        [least, most]
    }

    /// Whether a whole interface slides: its shear is more than the points bear together.
    pub(super) fn slides(&self, state: &ChainState) -> bool {
        let rough = |k: &usize| state.splits[*k] != Split::Smooth;
        (0..state.splits.len()).filter(rough).any(|k| {
            let [least, most] = self.ends(k, state);
            least.0 > most.0
        })
    }

    /// Whether no whole interface slides anywhere on the way between two states.
    ///
    /// What an interface has in reserve is linear between changes of state. From the line between the two states it is taken to depart by no
    /// more than both tangents miss the other state by; else the way is halved.
    ///
    /// # Errors
    /// When stopped.
    pub fn sticks_between(&self, a: &ChainState, b: &ChainState, budget: &Budget) -> Result<bool, Stopped> {
        self.sticks(a, &self.reserves(a), b, &self.reserves(b), HALVINGS, budget)
    }

    fn sticks(
        &self,
        a: &ChainState,
        of_a: &[[f64; 2]],
        b: &ChainState,
        of_b: &[[f64; 2]],
        halvings: usize,
        budget: &Budget,
    ) -> Result<bool, Stopped> {
        let way = b.load_factor - a.load_factor;
        let sticks = |(a, b): (&[f64; 2], &[f64; 2])| {
            let missed = (a[0] + way * a[1] - b[0]).abs() + (b[0] - way * b[1] - a[0]).abs();
            a[0].min(b[0]) > missed
        };
        if of_a.iter().zip(of_b).all(sticks) {
            return Ok(true);
        }
        if halvings == 0 {
            return Ok(false);
        }
        let Some(middle) = self.state(a.load_factor + 0.5 * way, Some(b), budget)? else { return Ok(false) };
        let of_middle = self.reserves(&middle);
        Ok(self.sticks(a, of_a, &middle, &of_middle, halvings - 1, budget)?
            && self.sticks(&middle, &of_middle, b, of_b, halvings - 1, budget)?)
    }

    /// How much more shear either way every interface could bear, N/m, and the change of that with the load factor.
    fn reserves(&self, state: &ChainState) -> Vec<[f64; 2]> {
        let ChainState { load_factor, redundants, splits, open, reduced } = state;
        let Some((rate, _)) = self.rates(&reduced.gradient, open) else {
            return vec![[f64::NEG_INFINITY; 2]; splits.len()];
        };
        let mut reserves = Vec::with_capacity(2 * splits.len());
        for k in (0..splits.len()).filter(|&k| splits[k] != Split::Smooth) {
            let bears = [0, 1].map(|p| friction(&self.contacts[2 * k + p]));
            if bears.contains(&f64::INFINITY) {
                continue;
            }
            let statics = &self.method.statics[k];
            for sign in [1.0, -1.0] {
                let row: Three = std::array::from_fn(|c| {
                    bears[0] * statics.normals[0][c] + bears[1] * statics.normals[1][c] + sign * statics.shear[c]
                });
                let linear = self.linear(k, &row);
                reserves.push([
                    value(&linear, redundants, *load_factor),
                    value(&[linear[0], linear[1], linear[2], 0.0, linear[4]], &rate, 1.0),
                ]);
            }
        }
        reserves
    }
}
