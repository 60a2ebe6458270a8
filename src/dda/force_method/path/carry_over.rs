//! What a change at one interface does to the splits of the others, and to the gradient by the redundants.
//!
//! Splits meet their neighbours' only, and one that is prescribed follows nobody. So a split that changes carries a share of its change
//! over to the one beside it, that one to the next, and so on: all change by multiples of one function.

use super::super::compatibility::Gradient;
use super::super::friction::Split;
use super::super::reduced::{Reduced, add, add_by};
use super::super::{ChainState, Linear, Loaded, plus};
use std::ops::Range;

/// So many changes may leave rounding in splits and gradient that follow them, each as large as the largest split that is free.
const MOST_FOLLOWED: usize = 256;
/// A smaller share of a change than this is not felt.
const FELT: f64 = 1e-16;

/// How splits follow those beside them.
#[derive(Debug)]
pub(super) struct CarryOver {
    /// The share of its change that each takes from the one after it, all before it being compatible; nought where it is prescribed.
    from_after: Vec<f64>,
    /// The same from the one before it, all after it being compatible.
    from_before: Vec<f64>,
    followed: usize,
    /// How much splits have changed since rounding was taken out, N/m.
    changed: f64,
    /// The largest split that was free whenever that was done, where that is least, N/m: a large change may be taken back.
    scale: f64,
}

/// What a change at one interface has done to the splits.
#[derive(Debug, Clone, Default)]
pub struct Felt {
    /// Interfaces that feel it.
    pub interfaces: Range<usize>,
    /// The one whose split is prescribed otherwise now.
    pub changed: usize,
    /// The change of its split.
    pub change: Linear,
    /// How often each of the interfaces takes that; nothing where all were solved for anew.
    shares: Vec<f64>,
}

impl Felt {
    /// Of a change that all take shares of.
    #[cfg(test)]
    pub fn carried(changed: usize, change: Linear, shares: Vec<f64>) -> Self {
        Felt { interfaces: 0..shares.len(), changed, change, shares }
    }

    /// How often each of some interfaces takes the change; none where it is not only carried over to these, for all were solved for
    /// anew, or the changed one is among them, or one up to which it is carried, which may be prescribed.
    pub fn carried_to(&self, some: &Range<usize>) -> Option<&[f64]> {
        let inner = self.interfaces.start + 1..self.interfaces.end.saturating_sub(1);
        let carried = inner.start <= some.start && some.end <= inner.end && !some.contains(&self.changed);
        if carried && !self.shares.is_empty() {
            let start = some.start - self.interfaces.start;
            return self.shares.get(start..start + some.len());
        }
        None
    }
}

/// Whether two shares differ by no more than rounding.
fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 2.0 * f64::EPSILON * a.abs()
}

/// What the parts of a function come to in a state, without regard to their signs.
fn size(of: &Linear, state: &ChainState) -> f64 {
    let [x, y, z] = state.redundants;
    of.iter().zip([x, y, z, 1.0, state.load_factor]).map(|(by, at)| (by * at).abs()).sum()
}

impl CarryOver {
    /// Of splits as they are prescribed in a state.
    pub(super) fn new(chain: &Loaded, state: &ChainState) -> Self {
        let (splits, n) = (&state.splits, state.splits.len());
        let free = (0..n).filter(|&k| splits[k] == Split::Held).map(|k| size(&state.reduced.splits[k], state));
        let scale = free.fold(0.0, f64::max);
        let mut all =
            CarryOver { from_after: vec![0.0; n], from_before: vec![0.0; n], followed: 0, changed: 0.0, scale };
        (0..n).for_each(|k| all.from_after[k] = all.taken_from_after(chain, splits, k));
        (0..n).rev().for_each(|k| all.from_before[k] = all.taken_from_before(chain, splits, k));
        all
    }

    /// What the equation of split `k` is off by per unit of it as those before it follow, m/N.
    fn pivot(&self, chain: &Loaded, k: usize) -> f64 {
        chain.pivot(k, k.checked_sub(1).map_or(0.0, |before| self.from_after[before]))
    }

    /// What those after it add to that as they follow.
    fn added_after(&self, chain: &Loaded, k: usize) -> f64 {
        self.from_before.get(k + 1).map_or(0.0, |from_before| chain.gradient.next[k] * from_before)
    }

    fn taken_from_after(&self, chain: &Loaded, splits: &[Split], k: usize) -> f64 {
        let free = splits[k] == Split::Held;
        if free { -chain.gradient.next[k] / self.pivot(chain, k) } else { 0.0 }
    }

    fn taken_from_before(&self, chain: &Loaded, splits: &[Split], k: usize) -> f64 {
        let (free, Gradient { own, next, .. }) = (splits[k] == Split::Held && k > 0, &chain.gradient);
        if free { -next[k - 1] / (own[k] + self.added_after(chain, k)) } else { 0.0 }
    }

    /// Changes how the split of interface `k` is prescribed.
    pub(super) fn change(&mut self, chain: &Loaded, state: &mut ChainState, k: usize, split: Split) -> Felt {
        let before = std::mem::replace(&mut state.splits[k], split);
        let off = chain.off(k, &state.reduced.splits);
        let changed = chain.prescribed(k, split).unwrap_or_else(|| {
            let pivot = self.pivot(chain, k) + self.added_after(chain, k);
            std::array::from_fn(|c| state.reduced.splits[k][c] - off[c] / pivot)
        });
        let change: Linear = std::array::from_fn(|c| changed[c] - state.reduced.splits[k][c]);
        self.followed += 1;
        self.changed += size(&change, state);
        if self.followed == MOST_FOLLOWED || self.changed > MOST_FOLLOWED as f64 * self.scale {
            state.reduced = chain.reduced(&state.splits);
            let anew = CarryOver::new(chain, state);
            *self = CarryOver { scale: anew.scale.min(self.scale), ..anew };
            return Felt { interfaces: 0..state.splits.len(), changed: k, change, shares: Vec::new() };
        }
        self.renew_shares(chain, &state.splits, k);
        let ChainState { splits: prescribed, reduced: Reduced { splits, gradient }, .. } = state;
        if let Some(by) = chain.virtual_split(k, before) {
            add_by(gradient, &by.map(|by| -by), &off);
        }
        splits[k] = changed;
        // How often the rows of the gradient take the change.
        let mut by_change = chain.gradient.mixed[k];
        // Room for all of them: there is a list for every event, and one that grows is copied again and again.
        let mut shares = Vec::with_capacity(prescribed.len());
        shares.push(1.0);
        let mut carry = |j: usize, tie: f64, from: f64, share: f64| {
            let taken = from * share;
            add(&mut splits[j], taken, &change);
            let by = match chain.virtual_split(j, prescribed[j]) {
                Some(by) => by.map(|by| by * tie * share),
                None => chain.gradient.mixed[j].map(|by| by * taken),
            };
            by_change = plus(&by_change, &by);
            shares.push(taken);
            taken
        };
        let (mut start, mut share) = (k, 1.0);
        while start > 0 && f64::abs(share) > FELT {
            start -= 1;
            share = carry(start, chain.gradient.next[start], self.from_after[start], share);
        }
        let (mut end, mut share) = (k + 1, 1.0);
        while end < prescribed.len() && f64::abs(share) > FELT {
            share = carry(end, chain.gradient.next[end - 1], self.from_before[end], share);
            end += 1;
        }
        shares[..=k - start].reverse();
        add_by(gradient, &by_change, &change);
        if let Some(by) = chain.virtual_split(k, split) {
            add_by(gradient, &by, &chain.off(k, splits));
        }
        Felt { interfaces: start..end, changed: k, change, shares }
    }

    /// Renews who takes what from whom after a change at interface `k`.
    fn renew_shares(&mut self, chain: &Loaded, splits: &[Split], k: usize) {
        // Each share waits for the division of the one before it; both ways at once take little longer than one.
        let (mut up, mut down) = (Some(k), Some(k));
        while up.or(down).is_some() {
            let goes_on = |j: &usize| self.renew_from_after(chain, splits, *j) || *j == k;
            up = up.filter(goes_on).map(|j| j + 1).filter(|&j| j < splits.len());
            let goes_on = |j: &usize| self.renew_from_before(chain, splits, *j) || *j == k;
            down = down.filter(goes_on).and_then(|j| j.checked_sub(1));
        }
    }

    /// Renews what one takes from the one after it; false where that is the same.
    fn renew_from_after(&mut self, chain: &Loaded, splits: &[Split], k: usize) -> bool {
        let renewed = self.taken_from_after(chain, splits, k);
        !same(std::mem::replace(&mut self.from_after[k], renewed), renewed)
    }

    /// Renews what one takes from the one before it; false where that is the same.
    fn renew_from_before(&mut self, chain: &Loaded, splits: &[Split], k: usize) -> bool {
        let renewed = self.taken_from_before(chain, splits, k);
        !same(std::mem::replace(&mut self.from_before[k], renewed), renewed)
    }
}

#[cfg(test)]
mod tests;
