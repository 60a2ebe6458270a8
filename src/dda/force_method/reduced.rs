//! Splits eliminated: each by the redundants, and what then is left of the gradient by these.

use super::compatibility::Gradient;
use super::friction::Split;
use super::{Linear, Loaded, Three, value};
use std::ops::Range;

/// So many changes may leave rounding in a gradient that follows them.
const MOST_FOLLOWED: usize = 64;

/// Splits, and the gradient by the redundants, with some splits prescribed.
#[derive(Debug, Clone)]
pub(super) struct Reduced {
    pub splits: Vec<Linear>,
    pub gradient: [Linear; 3],
}

/// Splits by the redundants and the split after them: the first the function, the second the factor.
type ByNext = (Linear, f64);

/// An elimination that follows changes at single interfaces.
#[derive(Debug)]
pub(super) struct Elimination {
    by_next: Vec<ByNext>,
    /// What every interface adds to the gradient by the redundants.
    shares: Vec<[Linear; 3]>,
    followed: usize,
}

/// Whether two functions differ by no more than rounding.
fn same(a: &Linear, b: &Linear) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 2.0 * f64::EPSILON * a.abs())
}

pub(super) fn add(sum: &mut Linear, by: f64, of: &Linear) {
    (0..5).for_each(|c| sum[c] += by * of[c]);
}

fn add_share(sum: &mut [Linear; 3], by: f64, share: &[Linear; 3]) {
    sum.iter_mut().zip(share).for_each(|(sum, row)| add(sum, by, row));
}

impl Loaded<'_> {
    /// Splits by the redundants, these prescribed and all others compatible.
    pub(super) fn reduced(&self, prescribed: &[Split]) -> Reduced {
        self.solved(prescribed, &self.by_next(prescribed))
    }

    fn by_next(&self, prescribed: &[Split]) -> Vec<ByNext> {
        let mut all: Vec<ByNext> = Vec::with_capacity(prescribed.len());
        for (k, split) in prescribed.iter().enumerate() {
            all.push(self.eliminated(k, *split, all.last()));
        }
        all
    }

    /// Split `k` by the next one, the splits before it being eliminated.
    fn eliminated(&self, k: usize, split: Split, before: Option<&ByNext>) -> ByNext {
        if let Some(row) = self.prescribed(k, split) {
            return (row, 0.0);
        }
        let Gradient { own, next, .. } = &self.gradient;
        let tie = if k > 0 { next[k - 1] } else { 0.0 };
        let (split_before, by_this) = before.copied().unwrap_or_default();
        let pivot = 1.0 / (own[k] + tie * by_this);
        let right = self.right(k);
        (std::array::from_fn(|c| -(right[c] + tie * split_before[c]) * pivot), -next[k] * pivot)
    }

    fn solved(&self, prescribed: &[Split], by_next: &[ByNext]) -> Reduced {
        let mut splits: Vec<Linear> = by_next.iter().map(|(split, _)| *split).collect();
        for k in (0..splits.len() - 1).rev() {
            let after = splits[k + 1];
            add(&mut splits[k], by_next[k].1, &after);
        }
        let mut gradient = self.without_splits();
        (0..splits.len()).for_each(|k| add_share(&mut gradient, 1.0, &self.share(k, prescribed[k], &splits)));
        Reduced { splits, gradient }
    }

    /// The gradient by the redundants without splits.
    fn without_splits(&self) -> [Linear; 3] {
        let (redundants, [fixed, scaled]) = (&self.gradient.redundants, &self.of_loads.0);
        std::array::from_fn(|a| [redundants[a][0], redundants[a][1], redundants[a][2], fixed[a], scaled[a]])
    }

    /// What the split of interface `k` adds to it; a point that does not stick is left without virtual shear.
    fn share(&self, k: usize, split: Split, splits: &[Linear]) -> [Linear; 3] {
        let mixed = self.gradient.mixed[k];
        let mut share = mixed.map(|by| splits[k].map(|x| by * x));
        if let Some(by) = self.virtual_split(k, split) {
            let off = self.off(k, splits);
            share.iter_mut().zip(by).for_each(|(row, by)| add(row, by, &off));
        }
        share
    }

    /// The gradient by split `k`, its own and its neighbours' parts left out.
    fn right(&self, k: usize) -> Linear {
        let ([a, b, c], [fixed, scaled]) = (self.gradient.mixed[k], self.of_loads.1[k]);
        [a, b, c, fixed, scaled]
    }

    /// The gradient by split `k`: what a point that does not stick has slipped by, m.
    pub(super) fn off(&self, k: usize, splits: &[Linear]) -> Linear {
        let Gradient { own, next, .. } = &self.gradient;
        let mut sum = self.right(k);
        add(&mut sum, own[k], &splits[k]);
        splits.get(k + 1).into_iter().for_each(|after| add(&mut sum, next[k], after));
        if k > 0 {
            add(&mut sum, next[k - 1], &splits[k - 1]);
        }
        sum
    }

    /// The same, this split and its neighbours being these, N/m.
    pub(super) fn off_by(&self, k: usize, [before, own, after]: Three, redundants: &Three, load_factor: f64) -> f64 {
        let Gradient { own: by_own, next, .. } = &self.gradient;
        let of_before = if k > 0 { next[k - 1] * before } else { 0.0 };
        value(&self.right(k), redundants, load_factor) + of_before + by_own[k] * own + next[k] * after
    }
}

impl Elimination {
    /// Of splits as they are.
    pub(super) fn new(chain: &Loaded, prescribed: &[Split], reduced: &Reduced) -> Self {
        let shares = prescribed.iter().enumerate().map(|(k, split)| chain.share(k, *split, &reduced.splits));
        Elimination { by_next: chain.by_next(prescribed), shares: shares.collect(), followed: 0 }
    }

    /// Takes in that interface `k` has changed; returns the interfaces that feel it.
    pub(super) fn renew(
        &mut self,
        chain: &Loaded,
        prescribed: &[Split],
        k: usize,
        reduced: &mut Reduced,
    ) -> Range<usize> {
        let n = prescribed.len();
        let mut end = k;
        while end < n {
            let renewed =
                chain.eliminated(end, prescribed[end], end.checked_sub(1).map(|before| &self.by_next[before]));
            let before = std::mem::replace(&mut self.by_next[end], renewed);
            if end > k && same(&before.0, &renewed.0) && before.1 == renewed.1 {
                break;
            }
            end += 1;
        }
        let mut start = end;
        while start > 0 {
            let (mut split, by) = self.by_next[start - 1];
            if let Some(after) = reduced.splits.get(start) {
                add(&mut split, by, after);
            }
            let before = std::mem::replace(&mut reduced.splits[start - 1], split);
            if start - 1 < k && same(&before, &split) {
                break;
            }
            start -= 1;
        }
        // Neighbours feel a split as well.
        let felt = start.saturating_sub(1)..(end + 1).min(n);
        for k in felt.clone() {
            let renewed = chain.share(k, prescribed[k], &reduced.splits);
            let before = std::mem::replace(&mut self.shares[k], renewed);
            add_share(&mut reduced.gradient, 1.0, &renewed);
            add_share(&mut reduced.gradient, -1.0, &before);
        }
        self.followed += 1;
        if self.followed.is_multiple_of(MOST_FOLLOWED) {
            reduced.gradient = chain.without_splits();
            self.shares.iter().for_each(|share| add_share(&mut reduced.gradient, 1.0, share));
        }
        felt
    }
}
