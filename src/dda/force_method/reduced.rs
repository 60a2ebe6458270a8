//! Splits eliminated: each by the redundants, and what then is left of the gradient by these.

use super::compatibility::Gradient;
use super::friction::Split;
use super::{Linear, Loaded, Three, value};

/// Splits, and the gradient by the redundants, with some splits prescribed.
#[derive(Debug, Clone)]
pub(super) struct Reduced {
    pub splits: Vec<Linear>,
    pub gradient: [Linear; 3],
}

/// Splits by the redundants and the split after them: the first the function, the second the factor.
type ByNext = (Linear, f64);

pub(super) fn add(sum: &mut Linear, by: f64, of: &Linear) {
    (0..5).for_each(|c| sum[c] += by * of[c]);
}

/// Adds a function as often as each row says.
pub(super) fn add_by(rows: &mut [Linear; 3], by: &Three, of: &Linear) {
    rows.iter_mut().zip(by).for_each(|(row, by)| add(row, *by, of));
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
        let next = &self.gradient.next;
        let tie = if k > 0 { next[k - 1] } else { 0.0 };
        let (split_before, by_this) = before.copied().unwrap_or_default();
        let pivot = 1.0 / self.pivot(k, by_this);
        let right = self.right(k);
        (std::array::from_fn(|c| -(right[c] + tie * split_before[c]) * pivot), -next[k] * pivot)
    }

    /// What the equation of split `k` is off by per unit of it, m/N, as the split before it takes this share of its change.
    pub(super) fn pivot(&self, k: usize, by_this: f64) -> f64 {
        let Gradient { own, next, .. } = &self.gradient;
        own[k] + k.checked_sub(1).map_or(0.0, |before| next[before] * by_this)
    }

    fn solved(&self, prescribed: &[Split], by_next: &[ByNext]) -> Reduced {
        let mut splits: Vec<Linear> = by_next.iter().map(|(split, _)| *split).collect();
        for k in (0..splits.len() - 1).rev() {
            let after = splits[k + 1];
            add(&mut splits[k], by_next[k].1, &after);
        }
        let mut gradient = self.without_splits();
        for (k, split) in splits.iter().enumerate() {
            add_by(&mut gradient, &self.gradient.mixed[k], split);
            // A point that does not stick is left without virtual shear.
            if let Some(by) = self.virtual_split(k, prescribed[k]) {
                add_by(&mut gradient, &by, &self.off(k, &splits));
            }
        }
        Reduced { splits, gradient }
    }

    /// The gradient by the redundants without splits.
    fn without_splits(&self) -> [Linear; 3] {
        let (redundants, [fixed, scaled]) = (&self.gradient.redundants, &self.of_loads.0);
        std::array::from_fn(|a| [redundants[a][0], redundants[a][1], redundants[a][2], fixed[a], scaled[a]])
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
