//! Functions of redundants and loads that are positive while interfaces stay as they are, and which of them comes to nought next.

use super::super::Linear;
use super::Felt;
use pulp::{Arch, Simd, WithSimd};
use std::ops::Range;

/// Interfaces that are looked at together.
const GROUP: usize = 16;
/// Rounding of a function, as a share of what the largest parts of any near it come to, so well above.
const ROUNDING: f64 = 1e-14;

/// Four functions, coefficient by coefficient.
type Functions = [[f64; 4]; 5];

/// Four functions of an interface.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Border {
    /// Without the split.
    functions: Functions,
    /// The change of each with the split, no more than 1 either way.
    by_split: [f64; 4],
}

impl Border {
    pub(super) fn of(functions: [Linear; 4], by_split: [f64; 4]) -> Self {
        Border { functions: std::array::from_fn(|c| functions.map(|function| function[c])), by_split }
    }

    /// Puts functions of a point that does not stick, with no split in them, before those of the other.
    pub(super) fn beside(&mut self, point: usize, [first, second]: [Linear; 2]) {
        let of_other = |four: [f64; 4]| four.as_chunks::<2>().0[1 - point];
        for (c, coefficients) in self.functions.iter_mut().enumerate() {
            let other = of_other(*coefficients);
            *coefficients = [first[c], second[c], other[0], other[1]];
        }
        let other = of_other(self.by_split);
        self.by_split = [0.0, 0.0, other[0], other[1]];
    }

    /// Coefficient `c` of the functions, with the split as it is.
    #[inline(always)]
    fn with(&self, split: &Linear, c: usize) -> [f64; 4] {
        std::array::from_fn(|i| self.functions[c][i] + self.by_split[i] * split[c])
    }

    /// The functions at a place, or their change along a path, with the split as it is.
    #[inline(always)]
    fn along(&self, split: &Linear, way: &Linear) -> [f64; 4] {
        let (mut sums, mut of_split) = ([0.0; 4], 0.0);
        for c in 0..5 {
            of_split += split[c] * way[c];
            sums.iter_mut().zip(&self.functions[c]).for_each(|(sum, by)| *sum += by * way[c]);
        }
        std::array::from_fn(|i| sums[i] + self.by_split[i] * of_split)
    }
}

/// The functions of all interfaces along a path.
#[derive(Debug)]
pub(super) struct Borders {
    borders: Vec<Border>,
    groups: Vec<Group>,
    /// The interface that was found last: the next is likely to be beside it.
    last: usize,
}

/// What is known of the functions of interfaces that follow one another: while a path goes on a little, most stay positive, and one
/// bound says so of all.
#[derive(Debug, Clone)]
struct Group {
    /// The place where the functions were looked at last.
    looked: Linear,
    /// No first, second, third and fourth function is less there.
    least: [f64; 4],
    /// The middle of their coefficients, and the most that these differ from it.
    middle: Functions,
    differ: Functions,
    /// Whether functions have been put down since their coefficients were measured.
    renewed: bool,
}

/// Where a function comes to nought.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Crossing {
    /// How often the path goes its rate until then.
    pub step: f64,
    pub interface: usize,
    pub which: usize,
}

impl Borders {
    /// Of so many interfaces, whose functions are to be [put down](Self::put).
    pub(super) fn new(interfaces: usize) -> Self {
        let group =
            Group { looked: [0.0; 5], least: [0.0; 4], middle: [[0.0; 4]; 5], differ: [[0.0; 4]; 5], renewed: true };
        Borders {
            borders: vec![Border::default(); interfaces],
            groups: vec![group; interfaces.div_ceil(GROUP)],
            last: 0,
        }
    }

    pub(super) fn interfaces(&self) -> usize {
        self.borders.len()
    }

    /// Puts down the functions of an interface.
    pub(super) fn put(&mut self, interface: usize, border: Border) {
        self.groups[interface / GROUP].renewed = true;
        self.borders[interface] = border;
    }

    /// Takes in how splits have changed.
    pub(super) fn follow(&mut self, felt: &Felt) {
        if felt.interfaces.is_empty() {
            return;
        }
        let all = self.borders.len();
        for g in felt.interfaces.start / GROUP..=(felt.interfaces.end - 1) / GROUP {
            let (group, interfaces) = (&mut self.groups[g], g * GROUP..all.min((g + 1) * GROUP));
            match felt.carried_to(&interfaces) {
                Some(shares) => group.widen(shares.iter().fold(0.0, |most, share| share.abs().max(most)), &felt.change),
                None => group.renewed = true,
            }
        }
    }

    /// Change of a function along the path, with the split as it is.
    pub(super) fn rate(&self, interface: usize, which: usize, split: &Linear, rate: &Linear) -> f64 {
        self.borders[interface].along(split, rate)[which]
    }

    /// The function that comes to nought first, from this place on, with splits as they are.
    pub(super) fn next(&mut self, splits: &[Linear], here: &Linear, rate: &Linear) -> Option<Crossing> {
        let Self { borders, groups, last } = self;
        let search = Search { of: Present { borders, splits }, groups, last: *last, way: [here, rate] };
        let next = Arch::new().dispatch(search);
        *last = next.map_or(*last, |next| next.interface);
        next
    }
}

/// The functions of interfaces with their splits as they are.
#[derive(Clone, Copy)]
struct Present<'a> {
    borders: &'a [Border],
    splits: &'a [Linear],
}

/// A look at all functions along a way, with the processor's vectors; nothing is fused, so that all processors round alike.
struct Search<'a> {
    of: Present<'a>,
    groups: &'a mut [Group],
    /// The interface that was found last.
    last: usize,
    /// Where the way begins, and its rate.
    way: [&'a Linear; 2],
}

impl WithSimd for Search<'_> {
    type Output = Option<Crossing>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Option<Crossing> {
        let Search { of, groups, last, way } = self;
        let all = of.borders.len();
        let mut next = of.first(last.saturating_sub(1)..all.min(last + 2), way, None);
        for (g, group) in groups.iter_mut().enumerate() {
            let interfaces = g * GROUP..all.min((g + 1) * GROUP);
            // Most groups stay positive as far as to the nearest one found so far; until one is found, all are looked at.
            let there = next.map(|next| std::array::from_fn(|c| way[0][c] + next.step * way[1][c]));
            if !there.is_some_and(|there| group.stays_positive(of.some(interfaces.clone()), &there)) {
                next = of.first(interfaces, way, next);
            }
        }
        next
    }
}

impl Present<'_> {
    /// Of these interfaces alone.
    #[inline(always)]
    fn some(self, interfaces: Range<usize>) -> Self {
        Present { borders: &self.borders[interfaces.clone()], splits: &self.splits[interfaces] }
    }

    /// The function that comes to nought first, of those of some interfaces and the one that is known.
    #[inline(always)]
    fn first(self, some: Range<usize>, way: [&Linear; 2], mut next: Option<Crossing>) -> Option<Crossing> {
        let mut step = next.map_or(f64::INFINITY, |next| next.step);
        let Present { borders, splits } = self.some(some.clone());
        for (interface, (border, split)) in some.zip(borders.iter().zip(splits)) {
            let [here, rate] = way.map(|way| border.along(split, way));
            // Seldom is any of the four nearer.
            if least_of(std::array::from_fn(|i| here[i] + rate[i] * step)) >= 0.0 {
                continue;
            }
            for which in 0..4 {
                if rate[which] < 0.0 && here[which] < -rate[which] * step {
                    step = (here[which] / -rate[which]).max(0.0);
                    next = Some(Crossing { step, interface, which });
                }
            }
        }
        next
    }
}

impl Group {
    /// True where no function is negative at a place; they are looked at where the last look does not tell.
    #[inline(always)]
    fn stays_positive(&mut self, of: Present, place: &Linear) -> bool {
        if !self.renewed && self.bound(place) > 0.0 {
            return true;
        }
        if self.renewed {
            self.measure(of);
        }
        self.look(of, place);
        least_of(self.least) > 0.0
    }

    /// No function has become less on the way from where they were looked at.
    #[inline(always)]
    fn bound(&self, place: &Linear) -> f64 {
        let mut bounds = self.least;
        for (c, at) in place.iter().enumerate() {
            let by = at - self.looked[c];
            for (bound, (middle, differ)) in bounds.iter_mut().zip(self.middle[c].iter().zip(&self.differ[c])) {
                *bound += middle * by - differ * by.abs();
            }
        }
        least_of(bounds)
    }

    /// Takes in what the functions' coefficients are.
    #[inline(always)]
    fn measure(&mut self, Present { borders, splits }: Present) {
        let (mut least, mut least_against) = ([[f64::INFINITY; 4]; 5], [[f64::INFINITY; 4]; 5]);
        for (border, split) in borders.iter().zip(splits) {
            for c in 0..5 {
                let coefficients = border.with(split, c);
                least[c] = smaller(least[c], coefficients);
                least_against[c] = smaller(least_against[c], coefficients.map(|by| -by));
            }
        }
        for c in 0..5 {
            for i in 0..4 {
                let [low, high] = [least[c][i], -least_against[c][i]];
                let differ = 0.5 * (high - low);
                (self.middle[c][i], self.differ[c][i]) = (low + differ, differ + ROUNDING * high.abs().max(low.abs()));
            }
        }
        self.renewed = false;
    }

    /// Takes in what the functions are at a place.
    #[inline(always)]
    fn look(&mut self, Present { borders, splits }: Present, place: &Linear) {
        (self.looked, self.least) = (*place, [f64::INFINITY; 4]);
        for (border, split) in borders.iter().zip(splits) {
            self.least = smaller(self.least, border.along(split, place));
        }
        for (c, at) in place.iter().enumerate() {
            let rounding = ROUNDING * at.abs();
            for (least, (middle, differ)) in self.least.iter_mut().zip(self.middle[c].iter().zip(&self.differ[c])) {
                *least -= rounding * (middle.abs() + differ);
            }
        }
    }

    /// Takes in that splits have changed by no more than this share of a change, either way.
    fn widen(&mut self, share: f64, change: &Linear) {
        let (mut there, mut parts) = (0.0, 0.0);
        for (c, by) in change.iter().enumerate() {
            let part = by * self.looked[c];
            (there, parts) = (there + part, parts + part.abs());
            self.differ[c].iter_mut().for_each(|differ| *differ += share * by.abs());
        }
        self.least.iter_mut().for_each(|least| *least -= share * (f64::abs(there) + ROUNDING * parts));
    }
}

/// The smaller of two numbers, four times; the first where the second is NaN.
#[inline(always)]
fn smaller(first: [f64; 4], second: [f64; 4]) -> [f64; 4] {
    // As processors tell it in one instruction.
    std::array::from_fn(|i| if second[i] < first[i] { second[i] } else { first[i] })
}

/// The smallest of four numbers; all are looked at, so that they stay together in one vector.
#[inline(always)]
fn least_of([a, b, c, d]: [f64; 4]) -> f64 {
    let least = |a: f64, b: f64| if a < b { a } else { b };
    least(least(a, c), least(b, d))
}

#[cfg(test)]
mod tests;
