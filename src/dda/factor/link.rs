//! Fronts of bodies in a row with two contact points a joint: four unknowns are removed and four kept, and everything has a size that
//! the compiler knows.

use super::Factor;
use crate::budget::{Budget, Stopped};
use crate::dda::elements::Elements;
use crate::dda::tree::Link;

/// A small matrix, row by row.
type Rows = [[f64; 4]; 4];

impl Factor<'_> {
    /// Eliminates a link, those that feed it being current.
    pub(super) fn eliminate_link(
        &mut self,
        k: &Elements,
        (number, link): (usize, Link),
        budget: &Budget,
    ) -> Result<(), Stopped> {
        // Halves of the rows of an element, in pairs: those of what is removed, and of what is kept.
        let [removed, kept] = if link.first { [0, 1] } else { [1, 0] };
        let (halves, _) = k.get(link.element).as_chunks::<4>();
        let half = |row: usize, i: usize, column: usize| halves[8 * row + 2 * i + column];
        let mut above = [[0.0; 8]; 4];
        for (i, row) in above.iter_mut().enumerate() {
            row[..4].copy_from_slice(&half(removed, i, removed));
            row[4..].copy_from_slice(&half(removed, i, kept));
        }
        let mut ratio = f64::INFINITY;
        if let Some(from) = link.from {
            let left = rows_of(self.left.get(from));
            (0..4).for_each(|i| (0..4).for_each(|j| above[i][j] += left[i][j]));
            ratio = self.ratio[from];
        }
        let mut x = [[0.0; 4]; 4];
        self.pivots[number].factor(above.as_flattened_mut(), 4, x.as_flattened_mut(), &[4], budget)?;
        // By columns, as substitution wants it.
        let columns = self.ahead.get_mut(number).as_chunks_mut::<4>().0;
        columns.iter_mut().enumerate().for_each(|(j, column)| *column = x.map(|row| row[j]));
        let below = self.below.get_mut(number).as_chunks_mut::<4>().0;
        let left = self.left.get_mut(number).as_chunks_mut::<4>().0;
        for (i, (below, left)) in below.iter_mut().zip(left).enumerate() {
            let (c, d) = (half(kept, i, removed), half(kept, i, kept));
            *below = c;
            *left =
                std::array::from_fn(|j| d[j] - ((c[0] * x[0][j] + c[1] * x[1][j]) + (c[2] * x[2][j] + c[3] * x[3][j])));
        }
        self.ratio[number] = ratio.min(self.pivots[number].ratio);
        self.current[number] = true;
        self.eliminated += 1;
        budget.work(64)
    }

    /// Forward substitution of a right-hand side through a link.
    pub(super) fn forward_link(&mut self, b: &[f64], (number, link): (usize, Link)) {
        let mut load: [f64; 4] = std::array::from_fn(|i| b[link.removed + i]);
        if let Some(from) = link.from {
            load.iter_mut().zip(self.forward.passed.get(from)).for_each(|(sum, part)| *sum += part);
        }
        let mut passed = [0.0; 4];
        // A force on one contact is felt on the way from there to the root only.
        if load != [0.0; 4] {
            self.pivots[number].solve(&mut load, &mut self.scratch.work);
            subtract(rows_of(self.below.get(number)), load, &mut passed);
        }
        self.forward.removed.get_mut(number).copy_from_slice(&load);
        self.forward.passed.get_mut(number).copy_from_slice(&passed);
    }

    /// Substitutes back along links, from this one on as far as they go; returns the front where they end, if there is one.
    pub(super) fn substitute_along(&self, mut number: usize, x: &mut [f64]) -> Option<usize> {
        let Some(link) = self.tree.links[number] else { return Some(number) };
        let mut known = four(&x[link.kept..]);
        while let Some(link) = self.tree.links[number] {
            let mut removed = four(self.forward.removed.get(number));
            for (column, known) in rows_of(self.ahead.get(number)).iter().zip(known) {
                (0..4).for_each(|i| removed[i] -= column[i] * known);
            }
            x[link.removed..link.removed + 4].copy_from_slice(&removed);
            // What a link removes, the one that feeds it keeps.
            (known, number) = (removed, link.from?);
        }
        Some(number)
    }
}

/// The first four numbers.
#[inline(always)]
fn four(from: &[f64]) -> [f64; 4] {
    from.first_chunk().copied().unwrap_or_default()
}

#[inline(always)]
fn rows_of(panel: &[f64]) -> Rows {
    panel.as_chunks().0.first_chunk().copied().unwrap_or_default()
}

/// y -= a x.
#[inline(always)]
fn subtract(a: Rows, x: [f64; 4], y: &mut [f64; 4]) {
    for (y, a) in y.iter_mut().zip(&a) {
        *y -= (a[0] * x[0] + a[2] * x[2]) + (a[1] * x[1] + a[3] * x[3]);
    }
}
