//! Mechanisms from equilibria at which a structure stands.
//!
//! The friction that joints have in such an equilibrium is given to them as shear, whatever presses them then. What gives way has a load
//! of its own as a mechanism with friction. The forces with which it gives way press the joints otherwise: their friction is given next.

use super::apart::Apart;
use super::groups::partings;
use super::hunt::{Hunt, Tried};
use crate::limit::{Resultant, StaticTheorem};

/// Equilibria to start from: so many over the square of the number of joints, as programmes of many joints take long, but no fewer and no
/// more than these.
const STARTS: usize = 16_000;
const FEWEST: usize = 8;
const MOST: usize = 60;
/// The same of structures with loops of more joints than `FEW_JOINTS`, which have many more mechanisms; half as many start where some
/// joints carry nothing. (Up to 6 blocks mixed-integer programmes found none that was missed.)
const STARTS_OF_MANY: usize = 150_000;
const MOST_OF_MANY: usize = 100;
const FEW_JOINTS: usize = 12;
/// Over the square of the number of joints, too, those between rings that are taken out together: in a vault of 24 stones these are all that
/// there are.
const PARTINGS: usize = 56_000;
const MOST_PARTINGS: usize = 32;
/// Joints that carry nothing by chance: shares of all, in turn.
const PARTED: [f64; 4] = [0.05, 0.1, 0.15, 0.2];
/// So many times friction is given (measured on random structures of blocks: 10 rounds of fewer starts find no more).
const ROUNDS: usize = 4;
/// Least share of the load at the end, counted from where the path starts, at which it starts where there are few mechanisms.
const LEAST_SHARE: f64 = 0.3;
/// How many times the load factor at which scaled loads are as large as fixed ones it starts at most, counted from where the path starts.
const REACH: f64 = 30.0;
/// How far below the load at which joints give way the next forces are taken, in turn, as a share of it.
const BACK: [f64; 2] = [1e-6, 0.1];
/// Of the random weights that lead to an equilibrium with few forces most are so many times smaller, in every second one.
const LIGHT: f64 = 0.01;
/// Share of the joints whose weights are not.
const HEAVY: f64 = 0.2;
/// Largest random slack of a limit, as a share of the loads.
const SLACK: f64 = 1e-5;

impl Hunt<'_> {
    /// From random equilibria on the way to the load factor `end`; first from those in which joints carry nothing: some at random where
    /// there are loops, and parts of rings that lie on each other.
    pub(super) fn give_shear(&mut self, end: f64) {
        let search = self.search;
        let partings = partings(&search.analysis.structure, self.worth(PARTINGS, MOST_PARTINGS));
        partings.into_iter().enumerate().for_each(|(number, joints)| self.give_shear_apart(joints, number));
        for number in 0..self.random_partings() {
            let joints = (0..search.theorem.joints()).filter(|_| self.random() < PARTED[number % PARTED.len()]);
            let joints = joints.collect();
            self.give_shear_apart(joints, number);
            if search.budget.ask().is_err() {
                return;
            }
        }
        let least = if self.has_many_mechanisms() { 0.0 } else { LEAST_SHARE };
        let way = (end - search.start).abs().min(REACH * search.theorem.load_factor_scale());
        for number in 0..self.starts() {
            let at = search.start + search.sign * (least + (1.0 - least) * self.random()) * way;
            let tilts = self.tilts(search.theorem, number);
            let first = search.theorem.corner((&[], &[]), [at, search.sign], &tilts, &mut None, search.budget);
            if let Ok(Some(first)) = first {
                self.give_shear_from(None, search.theorem.resultants(&first), number);
            }
            if search.budget.ask().is_err() {
                return;
            }
        }
    }

    /// From where the structure gives way without these joints, in rising order.
    fn give_shear_apart(&mut self, joints: Vec<usize>, number: usize) {
        let search = self.search;
        let Some(apart) = Apart::new(search, joints) else { return };
        if let Ok(Some(end)) = apart.theorem.at_end(search.sign, search.budget) {
            self.give_shear_from(Some(&apart), apart.theorem.resultants(&end), number);
        }
    }

    /// How many equilibria such a structure is worth.
    pub(super) fn starts(&self) -> usize {
        match self.has_many_mechanisms() {
            true => self.worth(STARTS_OF_MANY, MOST_OF_MANY),
            false => self.worth(STARTS, MOST),
        }
    }

    /// How many times joints carry nothing by chance.
    fn random_partings(&self) -> usize {
        if self.has_many_mechanisms() { self.starts() / 2 } else { 0 }
    }

    fn has_many_mechanisms(&self) -> bool {
        let theorem = self.search.theorem;
        theorem.has_loops() && theorem.joints() > FEW_JOINTS
    }

    /// So many over the square of the number of joints, but no more than `most`.
    fn worth(&self, of_joints: usize, most: usize) -> usize {
        (of_joints / self.search.theorem.joints().pow(2).max(1)).clamp(FEWEST, most)
    }

    /// From these forces of all joints, of the structure without those that are `apart`; `number` tells apart what is taken in turn.
    pub(super) fn give_shear_from(&mut self, apart: Option<&Apart>, mut forces: Vec<Resultant>, number: usize) {
        let search = self.search;
        let theorem = apart.map_or(search.theorem, |apart| &apart.theorem);
        let tilts = self.tilts(theorem, number);
        let [mut gave_way, mut pressed] = [const { None }; 2];
        for round in 0..ROUNDS {
            let slack: Vec<[f64; 3]> = forces.iter().map(|_| [(); 3].map(|()| SLACK * self.random())).collect();
            let given = theorem.with_shear_under(&forces, &slack);
            let basis = if apart.is_some() { &mut gave_way } else { &mut self.gave_way };
            let Ok(Some(found)) = given.gives_way(search.sign, basis, search.budget) else { return };
            let motion = match apart {
                Some(apart) => apart.in_whole(search, &found.moving, &found.rates),
                None => Some((found.moving, found.rates)),
            };
            let lower = motion.is_some_and(|(moving, rates)| self.weighs(moving, rates) == Tried::Lower);
            if lower && !search.theorem.has_loops() {
                self.go_on_from_best();
            }
            let back = BACK[(number + round) % BACK.len()] * (found.load_factor - search.start);
            let from = [found.load_factor - back, search.sign];
            let next = given.corner((&[], &[]), from, &tilts, &mut pressed, search.budget);
            let Ok(Some(next)) = next else { return };
            forces = given.resultants(&next);
        }
    }

    /// Random weights that lead to forces which press little.
    fn tilts(&mut self, theorem: &StaticTheorem, number: usize) -> Vec<[f64; 3]> {
        let mut weight = || {
            let light = number % 2 == 1 && self.random() > HEAVY;
            if light { -LIGHT * self.random() } else { -self.random() }
        };
        (0..theorem.joints()).map(|_| [weight(), weight(), 0.0]).collect()
    }

    /// Between 0 and 1.
    fn random(&mut self) -> f64 {
        self.scatter.next().abs()
    }
}
