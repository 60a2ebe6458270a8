//! Displacements state after state along a path: which body is displaced most is told without a look at each.
//!
//! Bodies are taken in blocks. From one state to the next, no body of a block moves by more than its first one would without splits and
//! slips within the block, and all that they can differ by from that. A block in which none can have come up with the farthest needs no
//! look.

use super::super::path::Felt;
use super::super::reduced::add;
use super::super::{ChainPath, ChainState, Linear, Three, plus, value};
use super::{OfBody, Shifts, slipped};
use crate::geometry::Vec2;
use std::iter::zip;

/// Bodies that are looked at together.
const BLOCK: usize = 32;
/// A bound that is off by less than this share is off by rounding.
const ROUNDING: f64 = 1e-9;

/// Mean displacements of the bodies of a chain along a path.
#[derive(Debug)]
pub struct ShiftsAlong<'l> {
    shifts: Shifts<'l>,
    blocks: Vec<Block>,
    /// The block with the body that was displaced most last.
    first: usize,
    redundants: Three,
    load_factor: f64,
    /// Blocks within which a point is open.
    apart: Vec<usize>,
}

/// Bodies that follow one another.
#[derive(Debug)]
struct Block {
    /// Rigid motion of all bodies after it by what splits and slips within.
    passes: [Linear; 3],
    /// The most that its bodies' displacements differ by from `start`: with no splits, and by splits and slips.
    differ: [Linear; 2],
    /// The same by splits whose sizes add up to 1 N/m.
    split: f64,
    /// The same as all turns by 1 over the chain's size.
    turned: f64,
    /// Rigid motion of all bodies from its first on, by what is before it.
    moved: Three,
    /// Displacement of its first body but for its splits and what slips at its first interface, m.
    start: Vec2,
    /// None of its bodies is displaced by more, m.
    bound: f64,
}

impl<'l> ShiftsAlong<'l> {
    /// From where a path begins.
    pub fn new(shifts: Shifts<'l>, path: &ChainPath) -> Self {
        let farthest = shifts.bodies.iter().map(|body| body.turned.norm()).fold(0.0, f64::max);
        let of_block = |bodies: &[OfBody]| {
            let most = |of: &dyn Fn(&OfBody) -> f64| bodies.iter().map(of).fold(0.0, f64::max);
            let apart = |of: &dyn Fn(&OfBody) -> Vec2| most(&|body| (of(body) - of(&bodies[0])).norm());
            let passed = most(&|body| body.passed[0].hypot(body.passed[1]) + farthest * body.passed[2].abs());
            let given = most(&|body| body.splits[0].norm() + body.splits[1].norm());
            Block {
                passes: [[0.0; 5]; 3],
                differ: [std::array::from_fn(|c| apart(&|body| body.linear[c])), [0.0; 5]],
                split: passed + given,
                turned: apart(&|body| body.turned),
                moved: [0.0; 3],
                start: Vec2::zeros(),
                bound: f64::INFINITY,
            }
        };
        let blocks = shifts.bodies.chunks(BLOCK).map(of_block).collect();
        let ChainState { redundants, load_factor, .. } = *path.state();
        let mut along = ShiftsAlong { shifts, blocks, first: 0, redundants, load_factor, apart: Vec::new() };
        (0..along.blocks.len()).for_each(|b| along.renew(path.state(), b));
        along.pass(path);
        along
    }

    /// Takes in the next state of the path, which is one event on.
    pub fn pass(&mut self, path: &ChainPath) {
        let state = path.state();
        let [x, y, z]: Three = std::array::from_fn(|a| (state.redundants[a] - self.redundants[a]).abs());
        let way: Linear = [x, y, z, 0.0, (state.load_factor - self.load_factor).abs()];
        (self.redundants, self.load_factor) = (state.redundants, state.load_factor);
        for block in &mut self.blocks {
            let by = |c: usize| way[c] * (block.differ[0][c] + block.differ[1][c]);
            block.bound += (0..5).map(by).sum::<f64>();
        }
        self.follow(state, path.felt());
        self.move_starts(state);
        // Within a block that is apart, or was until now, bodies move beside its first.
        let apart = state.open.iter().map(|opening| opening.interface / BLOCK);
        let before = std::mem::replace(&mut self.apart, apart.clone().collect());
        for block in apart.chain(before) {
            self.blocks.get_mut(block).into_iter().for_each(|block| block.bound = f64::INFINITY);
        }
    }

    /// Takes in how splits have changed.
    fn follow(&mut self, state: &ChainState, felt: &Felt) {
        let bodies = self.shifts.bodies.len();
        let some = felt.interfaces.start.saturating_sub(1)..felt.interfaces.end.min(bodies);
        if some.is_empty() {
            return;
        }
        for b in some.start / BLOCK..=(some.end - 1) / BLOCK {
            let (start, end) = (b * BLOCK, bodies.min((b + 1) * BLOCK));
            let Some(shares) = felt.carried_to(&(start..end + 1)) else {
                self.renew(state, b);
                continue;
            };
            let (mut passed, mut sum) = ([0.0; 3], shares[end - start].abs());
            for (share, body) in zip(shares, &self.shifts.bodies[start..end]) {
                passed = plus(&passed, &body.passed.map(|passed| share * passed));
                sum += share.abs();
            }
            let block = &mut self.blocks[b];
            zip(&mut block.passes, passed).for_each(|(row, by)| add(row, by, &felt.change));
            add(&mut block.differ[1], sum * block.split, &felt.change.map(f64::abs));
        }
    }

    /// Renews what depends on the splits within a block.
    fn renew(&mut self, state: &ChainState, b: usize) {
        let Shifts { chain, bodies } = &self.shifts;
        let splits = &state.reduced.splits;
        let (block, start) = (&mut self.blocks[b], b * BLOCK);
        let end = bodies.len().min(start + BLOCK);
        let (mut passes, mut sums, mut slips) = ([[0.0; 5]; 3], splits[end].map(f64::abs), [0.0; 5]);
        for k in start..end {
            zip(&mut passes, bodies[k].passed).for_each(|(row, by)| add(row, by, &splits[k]));
            add(&mut sums, 1.0, &splits[k].map(f64::abs));
            let slipped = slipped(state.splits[k]);
            if slipped != 0.0 {
                let off = chain.off(k, splits);
                let shear = chain.method.statics[k].shear;
                zip(&mut passes, shear).for_each(|(row, by)| add(row, slipped * by, &off));
                // Shear is a unit vector.
                add(&mut slips, slipped.abs(), &off.map(f64::abs));
            }
        }
        add(&mut slips, block.split, &sums);
        (block.passes, block.differ[1]) = (passes, slips);
    }

    /// Moves every block to where it starts from in a state.
    fn move_starts(&mut self, state: &ChainState) {
        let Self { shifts, blocks, .. } = self;
        let mut moved = [0.0; 3];
        for (b, (block, first)) in zip(blocks, shifts.bodies.iter().step_by(BLOCK)).enumerate() {
            let start = first.without_splits(moved, state.redundants, state.load_factor);
            block.bound += (start - block.start).norm() + block.turned * (moved[2] - block.moved[2]).abs();
            (block.start, block.moved) = (start, moved);
            moved = plus(&moved, &block.passes.map(|row| value(&row, &state.redundants, state.load_factor)));
            for opening in state.open.iter().filter(|opening| opening.interface / BLOCK == b) {
                moved = plus(&moved, &shifts.opened(opening));
            }
        }
    }

    /// How far the body is that is displaced most, m, in the state that was passed last.
    pub fn largest(&mut self, state: &ChainState) -> f64 {
        let bodies = self.shifts.bodies.len();
        let look = |b: usize, block: &mut Block| {
            let (mut largest, start) = (0.0, b * BLOCK);
            self.shifts.walk(state, start..bodies.min(start + BLOCK), block.moved, |shift| {
                largest = f64::max(largest, shift.norm_squared())
            });
            block.bound = largest.sqrt();
            block.bound
        };
        // The one that was first is likely to be.
        let mut largest = look(self.first, &mut self.blocks[self.first]);
        for (b, block) in self.blocks.iter_mut().enumerate() {
            if block.bound > largest * (1.0 - ROUNDING) && b != self.first {
                let found = look(b, block);
                if found > largest {
                    (largest, self.first) = (found, b);
                }
            }
        }
        debug_assert!(
            self.all(state).iter().all(|shift| shift.norm() <= largest * (1.0 + ROUNDING)),
            "at load factor {}",
            state.load_factor
        );
        largest
    }

    /// Displacement of a body, m, in the state that was passed last.
    pub fn of(&self, state: &ChainState, body: usize) -> Vec2 {
        let (start, mut found) = (body / BLOCK * BLOCK, Vec2::zeros());
        self.shifts.walk(state, start..body + 1, self.blocks[body / BLOCK].moved, |shift| found = shift);
        found
    }

    /// Of every body, m.
    pub fn all(&self, state: &ChainState) -> Vec<Vec2> {
        self.shifts.at(state)
    }
}

#[cfg(test)]
mod tests;
