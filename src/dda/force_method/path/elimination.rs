//! What a change at one interface does to the splits of the others, and to the gradient by the redundants.
//!
//! Splits meet their neighbours' only, and one that is prescribed follows nobody. So a split that changes by d changes the one beside it
//! by a share of d, that one the next, and so on: every split, and with it every row of the gradient, changes by a multiple of d.

use super::super::friction::Split;
use super::super::reduced::{Reduced, add, add_by};
use super::super::{Linear, Loaded, plus};
use std::ops::Range;

/// So many changes may leave rounding in splits and gradient that follow them.
const MOST_FOLLOWED: usize = 64;
/// A smaller share of a change than this is not felt.
const FELT: f64 = 1e-16;

/// How splits follow those beside them.
#[derive(Debug)]
pub(super) struct Elimination {
    /// Change of each with the one after it, while all before it are compatible; nought where it is prescribed.
    with_after: Vec<f64>,
    /// The same with the one before it, while all after it are.
    with_before: Vec<f64>,
    followed: usize,
}

/// Whether two shares differ by no more than rounding.
fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 2.0 * f64::EPSILON * a.abs()
}

impl Elimination {
    /// Of splits that are prescribed like this.
    pub(super) fn new(chain: &Loaded, prescribed: &[Split]) -> Self {
        let n = prescribed.len();
        let mut all = Elimination { with_after: vec![0.0; n], with_before: vec![0.0; n], followed: 0 };
        (0..n).for_each(|k| all.with_after[k] = all.follows_after(chain, prescribed, k));
        (0..n).rev().for_each(|k| all.with_before[k] = all.follows_before(chain, prescribed, k));
        all
    }

    /// Resistance of split `k` to change, those before it following.
    fn with_those_before(&self, chain: &Loaded, k: usize) -> f64 {
        let before = k.checked_sub(1).map_or(0.0, |before| chain.gradient.next[before] * self.with_after[before]);
        chain.gradient.own[k] + before
    }

    /// What those after it add to that.
    fn of_those_after(&self, chain: &Loaded, k: usize) -> f64 {
        self.with_before.get(k + 1).map_or(0.0, |after| chain.gradient.next[k] * after)
    }

    fn follows_after(&self, chain: &Loaded, prescribed: &[Split], k: usize) -> f64 {
        let free = prescribed[k] == Split::Held;
        if free { -chain.gradient.next[k] / self.with_those_before(chain, k) } else { 0.0 }
    }

    fn follows_before(&self, chain: &Loaded, prescribed: &[Split], k: usize) -> f64 {
        let free = prescribed[k] == Split::Held && k > 0;
        if !free {
            return 0.0;
        }
        -chain.gradient.next[k - 1] / (chain.gradient.own[k] + self.of_those_after(chain, k))
    }

    /// Takes in that interface `k` has changed, and how it was; returns the interfaces that feel it.
    pub(super) fn renew(
        &mut self,
        chain: &Loaded,
        prescribed: &[Split],
        (k, before): (usize, Split),
        reduced: &mut Reduced,
    ) -> Range<usize> {
        self.renew_shares(chain, prescribed, k);
        self.followed += 1;
        if self.followed.is_multiple_of(MOST_FOLLOWED) {
            *reduced = chain.reduced(prescribed);
            return 0..prescribed.len();
        }
        let Reduced { splits, gradient } = reduced;
        let off = chain.off(k, splits);
        if let Some(by) = chain.virtual_split(k, before) {
            add_by(gradient, &by.map(|by| -by), &off);
        }
        let split = chain.prescribed(k, prescribed[k]).unwrap_or_else(|| {
            let resistance = self.with_those_before(chain, k) + self.of_those_after(chain, k);
            std::array::from_fn(|c| splits[k][c] - off[c] / resistance)
        });
        let change: Linear = std::array::from_fn(|c| split[c] - splits[k][c]);
        splits[k] = split;
        // How often the rows of the gradient take the change.
        let mut by_change = chain.gradient.mixed[k];
        let mut follow = |j: usize, tie: f64, with: f64, share: f64| {
            let follows = with * share;
            add(&mut splits[j], follows, &change);
            let by = match chain.virtual_split(j, prescribed[j]) {
                Some(by) => by.map(|by| by * tie * share),
                None => chain.gradient.mixed[j].map(|by| by * follows),
            };
            by_change = plus(&by_change, &by);
            follows
        };
        let (mut start, mut share) = (k, 1.0);
        while start > 0 && f64::abs(share) > FELT {
            start -= 1;
            share = follow(start, chain.gradient.next[start], self.with_after[start], share);
        }
        let (mut end, mut share) = (k + 1, 1.0);
        while end < prescribed.len() && f64::abs(share) > FELT {
            share = follow(end, chain.gradient.next[end - 1], self.with_before[end], share);
            end += 1;
        }
        add_by(gradient, &by_change, &change);
        if let Some(by) = chain.virtual_split(k, prescribed[k]) {
            add_by(gradient, &by, &chain.off(k, splits));
        }
        start..end
    }

    /// Renews who follows whom after a change at interface `k`.
    fn renew_shares(&mut self, chain: &Loaded, prescribed: &[Split], k: usize) {
        for j in k..prescribed.len() {
            let renewed = self.follows_after(chain, prescribed, j);
            let before = std::mem::replace(&mut self.with_after[j], renewed);
            if j > k && same(before, renewed) {
                break;
            }
        }
        for j in (0..=k).rev() {
            let renewed = self.follows_before(chain, prescribed, j);
            let before = std::mem::replace(&mut self.with_before[j], renewed);
            if j < k && same(before, renewed) {
                break;
            }
        }
    }
}

#[cfg(test)]
mod tests;
