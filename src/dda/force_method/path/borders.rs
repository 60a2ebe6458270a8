//! Functions of redundants and loads that are positive while interfaces stay as they are, and which of them comes to nought next.

use super::super::Linear;
use pulp::{Arch, Simd, WithSimd};
use std::iter::once;

/// Interfaces that are looked at together.
const GROUP: usize = 4;

/// Four functions of an interface; coefficient by coefficient.
pub(super) type Functions = [[f64; 4]; 5];

/// The functions of all interfaces along a path.
#[derive(Debug)]
pub(super) struct Borders {
    functions: Vec<Functions>,
    /// The interface that was found last: the next is likely to be beside it.
    last: usize,
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
    /// Of so many interfaces, whose functions are to be [put down](Self::of).
    pub(super) fn new(interfaces: usize) -> Self {
        Borders { functions: vec![Functions::default(); interfaces], last: 0 }
    }

    pub(super) fn interfaces(&self) -> usize {
        self.functions.len()
    }

    /// The functions of an interface.
    pub(super) fn of(&mut self, interface: usize) -> &mut Functions {
        &mut self.functions[interface]
    }

    /// Change of a function along the path.
    pub(super) fn rate(&self, interface: usize, which: usize, rate: &Linear) -> f64 {
        along(&self.functions[interface], rate)[which]
    }

    /// The function that comes to nought first, from this place on.
    pub(super) fn next(&mut self, here: &Linear, rate: &Linear) -> Option<Crossing> {
        let next = Arch::new().dispatch(Search { functions: &self.functions, last: self.last, here, rate });
        self.last = next.map_or(self.last, |next| next.interface);
        next
    }
}

/// A look at all functions along a way, with the processor's vectors.
struct Search<'a> {
    functions: &'a [Functions],
    /// The interface that was found last.
    last: usize,
    here: &'a Linear,
    rate: &'a Linear,
}

impl WithSimd for Search<'_> {
    type Output = Option<Crossing>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Option<Crossing> {
        let Search { functions, last, here, rate } = self;
        let (mut next, mut there): (_, Option<Linear>) = (None, None);
        let all = functions.len();
        let groups = (0..all).step_by(GROUP).map(|start| start..all.min(start + GROUP));
        for group in once(last.saturating_sub(1)..all.min(last + 2)).chain(groups) {
            // Most groups stay positive as far as to the nearest one found so far; until one is found, all are looked at.
            if there.is_some_and(|there| least(simd, &functions[group.clone()], &there) >= 0.0) {
                continue;
            }
            for interface in group {
                if let Some(nearer) = look_at(&functions[interface], interface, [here, rate], next) {
                    next = Some(nearer);
                    there = Some(std::array::from_fn(|c| here[c] + nearer.step * rate[c]));
                }
            }
        }
        next
    }
}

/// The least of the functions of some interfaces at a place.
#[inline(always)]
fn least<S: Simd>(simd: S, functions: &[Functions], place: &Linear) -> f64 {
    // The numbers of a wider vector would not belong together.
    if S::F64_LANES > 4 {
        return functions.iter().flat_map(|four| along(four, place)).fold(f64::INFINITY, f64::min);
    }
    let (place, mut least) = (place.map(|x| simd.splat_f64s(x)), simd.splat_f64s(f64::INFINITY));
    for four in functions {
        let (wide, _) = S::as_simd_f64s(four.as_flattened());
        let by = wide.len() / 5;
        for i in 0..by {
            // Not fused: rounded as in `along`, whatever the processor has.
            let mut sum = simd.mul_f64s(wide[i], place[0]);
            for c in 1..5 {
                sum = simd.add_f64s(sum, simd.mul_f64s(wide[by * c + i], place[c]));
            }
            // Of a NaN and a number the second is the least.
            least = simd.min_f64s(sum, least);
        }
    }
    simd.reduce_min_f64s(least)
}

/// The one of the functions of an interface that comes to nought first, if that is before `next`.
fn look_at(
    functions: &Functions,
    interface: usize,
    [here, rate]: [&Linear; 2],
    next: Option<Crossing>,
) -> Option<Crossing> {
    let (here, rate) = (along(functions, here), along(functions, rate));
    let (mut nearer, mut step) = (None, next.map_or(f64::INFINITY, |next| next.step));
    for which in 0..4 {
        if rate[which] < 0.0 && here[which] < -rate[which] * step {
            step = (here[which] / -rate[which]).max(0.0);
            nearer = Some(Crossing { step, interface, which });
        }
    }
    nearer
}

/// Four functions at a place, or their change along a path.
fn along(functions: &Functions, way: &Linear) -> [f64; 4] {
    let mut sums = [0.0; 4];
    for c in 0..5 {
        for i in 0..4 {
            sums[i] += functions[c][i] * way[c];
        }
    }
    sums
}

#[cfg(test)]
mod tests;
